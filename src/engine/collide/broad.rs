//! Broad phase: pairs that may come to touch, kept for as long as they are a proven superset of those that do.
//!
//! A list is built with room to spare: every pair closer than `2·travel + margin`. It holds while no body has moved, and
//! will move in this substep, by more than `travel` (Verlet's neighbour list). The few bodies that are faster are tried
//! one by one. Which pairs come out of the narrow phase hence depends on the present state only, never on when
//! the list was built.

use super::grid::Grid;
use crate::engine::plan::Plan;
use crate::engine::shape::Shape;
use crate::engine::state::State;
use crate::engine::world::World;
use glam::DVec2;

/// Gap below which a pair is handed to the solver even when it does not close, as a part of the smaller radius: room for
/// velocities that the solve itself changes. Larger costs rows, smaller lets pairs overlap for a substep.
pub(crate) const MARGIN: f64 = 0.05;
/// Room to move, as a part of the usual radius: large enough to keep a list for many substeps, small enough to add few pairs.
const ROOM: f64 = 0.15;
/// One body in so many may leave its room before the lists are built anew; these few are looked up one by one.
const FEW: usize = 64;
/// Bodies up to so many times the usual radius share the grid; larger ones are tried against everything at a build.
const LARGE: f64 = 2.0;

/// Candidate pairs and what they were built from.
#[derive(Debug, Default)]
pub(crate) struct BroadPhase {
    grid: Grid,
    /// (a, b) with a < b, ascending.
    pub pairs: Vec<(u32, u32)>,
    /// (body, wall), ascending.
    pub walls: Vec<(u32, u32)>,
    /// Bodies that leave their room in this substep, ascending, and a flag for each body.
    pub fast: Vec<u32>,
    pub is_fast: Vec<bool>,
    /// Positions at the last build; empty if there is none that still holds.
    built_at: Vec<DVec2>,
    /// Distance that a body may move from there [m].
    travel: f64,
    /// Radius of the largest body in the grid [m].
    grid_radius: f64,
    sorted: Vec<f64>,
    large: Vec<u32>,
}

impl BroadPhase {
    /// Forgets the list, after an edit.
    pub fn reset(&mut self) {
        self.built_at.clear();
    }

    /// Makes the lists valid for a substep of `h` seconds with the state's velocities. Returns whether they were built anew.
    pub fn update(&mut self, world: &World, plan: &Plan, state: &State, h: f64) -> bool {
        if !self.built_at.is_empty() {
            self.find_fast(state, h);
            if self.fast.len() <= few(state.len()) {
                return false;
            }
        }
        self.build(world, plan, state, h);
        self.find_fast(state, h);
        true
    }

    /// Calls `visit` for every body that is not fast and may come as close as `reach` to the box from `low` to `high`.
    pub fn near(&self, low: DVec2, high: DVec2, reach: f64, mut visit: impl FnMut(u32)) {
        let reach = DVec2::splat(reach + self.grid_radius + self.travel);
        let slow = |body: u32| !self.is_fast[body as usize];
        let everything = |_, _| (f64::NEG_INFINITY, f64::INFINITY);
        self.grid.in_box(low - reach, high + reach, everything, |body| {
            if slow(body) {
                visit(body);
            }
        });
        self.large.iter().copied().filter(|body| slow(*body)).for_each(visit);
    }

    fn find_fast(&mut self, state: &State, h: f64) {
        let n = state.len();
        self.fast.clear();
        self.is_fast.clear();
        self.is_fast.resize(n, false);
        for i in 0..n {
            let moved = (state.position[i] - self.built_at[i]).length() + h * state.velocity[i].length();
            // Written so that a NaN counts as fast.
            if !(moved <= self.travel) {
                self.is_fast[i] = true;
                self.fast.push(i as u32);
            }
        }
    }

    fn build(&mut self, world: &World, plan: &Plan, state: &State, h: f64) {
        let n = state.len();
        let radius = &world.bodies.radius;
        let usual = |values: &mut Vec<f64>| {
            let rank = values.len().saturating_sub(1 + few(values.len()));
            if values.is_empty() { 0.0 } else { *values.select_nth_unstable_by(rank, f64::total_cmp).1 }
        };
        let colliding = || (0..n).filter(|i| world.bodies.is_solid(*i));
        self.sorted.clear();
        self.sorted.extend(colliding().map(|i| radius[i]));
        let usual_radius = usual(&mut self.sorted).max(1e-9);
        let of_grid = |radius: &f64| *radius <= LARGE * usual_radius;
        self.grid_radius = self.sorted.iter().copied().filter(of_grid).fold(usual_radius, f64::max);
        self.sorted.clear();
        self.sorted.extend(colliding().map(|i| h * state.velocity[i].length()));
        let usual_step = usual(&mut self.sorted);
        self.travel = (4.0 * usual_step).min(0.5 * usual_radius).max(1.1 * usual_step).max(ROOM * usual_radius);
        self.built_at.clone_from(&state.position);
        self.large.clear();
        self.large.extend(colliding().filter(|i| radius[*i] > self.grid_radius).map(|i| i as u32));
        let cell = 2.0 * self.grid_radius + self.reach(self.grid_radius);
        let small = colliding().filter(|i| radius[*i] <= self.grid_radius);
        self.grid.fill(cell, small.map(|i| (i as u32, state.position[i])));
        self.list_pairs(world, plan, state);
        self.list_walls(world, state);
    }

    /// Distance of two surfaces, the smaller of radius `radius`, below which the pair is listed [m].
    fn reach(&self, radius: f64) -> f64 {
        2.0 * self.travel + MARGIN * radius
    }

    fn list_pairs(&mut self, world: &World, plan: &Plan, state: &State) {
        let mut pairs = std::mem::take(&mut self.pairs);
        pairs.clear();
        let radius = &world.bodies.radius;
        let mut add = |a: u32, b: u32| {
            let (i, j) = (a as usize, b as usize);
            let near = radius[i] + radius[j] + self.reach(radius[i].min(radius[j]));
            if (state.position[i] - state.position[j]).length_squared() < near * near
                && world.bodies.may_touch(&plan.joined, a, b)
            {
                pairs.push((a.min(b), a.max(b)));
            }
        };
        self.grid.pairs(&mut add);
        for (rank, large) in self.large.iter().enumerate() {
            let larger_before = |b: &u32| self.large[..rank].binary_search(b).is_ok();
            let others = (0..state.len() as u32).filter(|b| b != large && !larger_before(b));
            others.for_each(|b| add(*large, b));
        }
        pairs.sort_unstable();
        self.pairs = pairs;
    }

    fn list_walls(&mut self, world: &World, state: &State) {
        let mut walls = std::mem::take(&mut self.walls);
        walls.clear();
        for (index, wall) in world.walls.iter().enumerate() {
            let mut add = |body: u32| {
                let radius = world.bodies.radius[body as usize];
                let distance = wall.shape.distance(state.position[body as usize]).0;
                if distance < radius * (1.0 + MARGIN) + self.travel && world.bodies.may_touch_walls(body as usize) {
                    walls.push((body, index as u32));
                }
            };
            let reach = self.grid_radius * (1.0 + MARGIN) + self.travel;
            let (min, max) = wall.shape.bounds();
            let (min, max) = (min - DVec2::splat(reach), max + DVec2::splat(reach));
            self.grid.in_box(min, max, |low, high| row_of(&wall.shape, low, high, reach), &mut add);
            self.large.iter().for_each(|body| add(*body));
        }
        walls.sort_unstable();
        self.walls = walls;
    }
}

/// Number of bodies among `n` that may be exceptions.
fn few(n: usize) -> usize {
    (n / FEW).max(8)
}

/// The part of x within `reach` of a shape between two heights: keeps a long slanting segment from visiting its whole box.
fn row_of(shape: &Shape, low: f64, high: f64, reach: f64) -> (f64, f64) {
    let (min, max) = shape.bounds();
    let Shape::Segment { from, to } = *shape else { return (min.x - reach, max.x + reach) };
    let rise = to.y - from.y;
    if rise.abs() < 1e-9 * (to.x - from.x).abs() || rise == 0.0 {
        return (min.x - reach, max.x + reach);
    }
    let at = |y: f64| from.x + (to.x - from.x) * ((y - from.y) / rise).clamp(0.0, 1.0);
    let (one, other) = (at(low - reach), at(high + reach));
    (one.min(other) - reach, one.max(other) + reach)
}
