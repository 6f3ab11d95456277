//! Which islands could touch something in the coming step: those go through the substeps in it, as contacts have no place in
//! an island's smooth motion.
//!
//! Two bodies may touch if their surfaces are closer than their relative speed carries them, and a little more for what changes
//! the speed. What is overlooked for that reason overlaps by less than the little at the end of the step, and is near in the next; but for
//! walls, which a body that is pulled hard could pass meanwhile: those are looked at again when the step is known.

use super::System;
use crate::engine::collide::Grid;
use crate::engine::collide::sweep::disc_hits_wall;
use crate::engine::plan::{IslandPlan, Plan};
use crate::engine::world::World;
use glam::DVec2;

/// Room beside the way, as a part of the smaller radius.
const ROOM: f64 = 0.05;
/// Bodies that reach farther than so many times the usual are tried against all others.
const LARGE: f64 = 4.0;
/// No island.
const NONE: u32 = u32::MAX;

/// Whether a body of an island came to a wall on the straight way from where the world has it.
pub(super) fn came_to_wall(world: &World, system: &System) -> bool {
    let nodes = &system.nodes;
    (0..nodes.len()).filter(|i| nodes.w[*i] > 0.0).any(|i| {
        let body = nodes.body[i];
        // Points that turn with a body have no mass, so this is one.
        let (from, radius) = (world.bodies.position[body as usize], world.bodies.radius[body as usize]);
        let path = DVec2::new(nodes.x[i], nodes.y[i]) - from;
        let (low, high) = (from.min(from + path) - DVec2::splat(radius), from.max(from + path) + DVec2::splat(radius));
        world.bodies.may_touch_walls(body as usize)
            && world.walls.iter().any(|wall| {
                let (min, max) = wall.shape.bounds();
                let apart = min.cmpgt(high).any() || max.cmplt(low).any();
                !apart && disc_hits_wall(&wall.shape, from, path, radius).is_some()
            })
    })
}

/// Scratch memory, by body.
#[derive(Debug, Default)]
pub(crate) struct Surroundings {
    /// Island of a body that may touch; NONE for all others.
    island: Vec<u32>,
    /// How far a body reaches in the step: its radius and its way [m].
    reach: Vec<f64>,
    sorted: Vec<f64>,
    large: Vec<u32>,
    grid: Grid,
    /// By island: something is near.
    pub near: Vec<bool>,
}

impl Surroundings {
    /// Finds the islands of `plan` that are near something in the next `time` seconds.
    pub fn find(&mut self, world: &World, plan: &Plan, islands: &[(IslandPlan, System)], time: f64) {
        self.near.clear();
        self.near.resize(islands.len(), false);
        if !islands.iter().any(|(island, _)| island.guarded) {
            return;
        }
        self.measure(world, islands, time);
        let Surroundings { island, reach, large, grid, near, .. } = self;
        // What gravity and others like it add on the way.
        let drop = world.gravity.length() * time * time;
        let bodies = &world.bodies;
        let mut look = |a: u32, b: u32| {
            let (i, j) = (a as usize, b as usize);
            let seen = |i: usize| island[i] == NONE || near[island[i] as usize];
            if seen(i) && seen(j) {
                return;
            }
            let way = time * (bodies.velocity[i] - bodies.velocity[j]).length();
            let room = ROOM * bodies.radius[i].min(bodies.radius[j]) + way + drop;
            let reach = bodies.radius[i] + bodies.radius[j] + room;
            let apart = (bodies.position[i] - bodies.position[j]).length_squared();
            if apart < reach * reach && world.bodies.may_touch(&plan.joined, a, b) {
                [i, j].into_iter().filter(|i| island[*i] != NONE).for_each(|i| near[island[i] as usize] = true);
            }
        };
        grid.pairs(&mut look);
        for (rank, one) in large.iter().enumerate() {
            let before = |b: &u32| large[..rank].binary_search(b).is_ok();
            let others = (0..bodies.len() as u32).filter(|b| b != one && reach[*b as usize] > 0.0 && !before(b));
            others.for_each(|b| look(*one, b));
        }
        for body in (0..bodies.len()).filter(|i| island[*i] != NONE && bodies.may_touch_walls(*i)) {
            let room = reach[body] + ROOM * bodies.radius[body] + drop;
            let (low, high) = (bodies.position[body] - DVec2::splat(room), bodies.position[body] + DVec2::splat(room));
            let meets = world.walls.iter().any(|wall| {
                let (min, max) = wall.shape.bounds();
                let apart = min.cmpgt(high).any() || max.cmplt(low).any();
                !apart && wall.shape.distance(bodies.position[body]).0 < room
            });
            near[island[body] as usize] |= meets;
        }
    }

    /// Reaches, and the grid of all that collides.
    fn measure(&mut self, world: &World, islands: &[(IslandPlan, System)], time: f64) {
        let bodies = &world.bodies;
        self.island.clear();
        self.island.resize(bodies.len(), NONE);
        for (index, (island, _)) in islands.iter().enumerate().filter(|(_, (island, _))| island.guarded) {
            island.group.bodies.iter().for_each(|body| self.island[*body as usize] = index as u32);
        }
        self.reach.clear();
        self.reach.extend(
            (0..bodies.len())
                .map(|i| if bodies.is_solid(i) { bodies.radius[i] + time * bodies.velocity[i].length() } else { 0.0 }),
        );
        self.sorted.clear();
        self.sorted.extend(self.reach.iter().copied().filter(|reach| *reach > 0.0));
        let middle = self.sorted.len() / 2;
        let usual =
            if self.sorted.is_empty() { 0.0 } else { *self.sorted.select_nth_unstable_by(middle, f64::total_cmp).1 };
        let small = |reach: f64| reach <= LARGE * usual;
        self.large.clear();
        let reach = &self.reach;
        let colliding = || (0..bodies.len()).filter(|i| reach[*i] > 0.0);
        // Written so that a NaN is large.
        self.large.extend(colliding().filter(|i| !small(reach[*i])).map(|i| i as u32));
        let widest = colliding().map(|i| reach[i]).filter(|reach| small(*reach)).fold(0.0, f64::max);
        let cell = 2.0 * (widest * (1.0 + ROOM) + world.gravity.length() * time * time);
        let inside = colliding().filter(|i| small(reach[*i]));
        self.grid.fill(cell.max(1e-9), inside.map(|i| (i as u32, bodies.position[i])));
    }
}
