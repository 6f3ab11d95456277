//! The last guard against tunnelling: no centre passes a wall, whatever pushed it there.
//!
//! A substep writes positions in many places: drifts, parted overlaps, shifts of impacts, feedback, projections. Each of them may be
//! wrong by any amount where bodies press on each other. So the straight way of every centre since it was last judged is looked at as a whole:
//! the core of a disc does not come nearer to a wall than [`CORE`] of its radius, or not nearer than it was. A centre that would is stopped
//! there and goes on along the wall; what is left is taken back. Hence by induction every centre stays on its side of every wall.
//!
//! A ball round each centre that is clear of all walls is kept for as long as the centre stays in it, so a pile costs two distances a body.
//! A way inside of a clear ball would be left as it is by the whole judgement too: the result never depends on when a ball was measured.

use super::sweep::{CORE, disc_hits_wall};
use crate::engine::shape::{Shape, Wall};
use crate::engine::state::State;
use crate::engine::world::World;
use glam::DVec2;

/// Walls along which a way goes on before what is left of it is dropped: two make a corner, a third one closes it.
const SLIDES: u32 = 3;
/// Part of a clear ball that is used, so that rounding is on the safe side.
const CLEAR: f64 = 1.0 - 1e-9;
/// Ends of a segment are longer by this part of it, so that nothing slips through where two of them are joined.
const JOINED: f64 = 1e-12;

/// Places of all centres that are on the right side of every wall, and how much room there is around them.
#[derive(Debug, Default)]
pub(crate) struct WallGuard {
    /// Where each centre was last judged [m].
    safe: Vec<DVec2>,
    /// A ball that no core leaves towards a wall: centre and radius [m]; empty where the radius is not above 0.
    clear_at: Vec<DVec2>,
    clear: Vec<f64>,
}

impl WallGuard {
    /// Forgets the clear balls, after an edit.
    pub fn reset(&mut self) {
        self.clear.clear();
    }

    /// Takes the places at the start of a step as they are.
    pub fn begin(&mut self, state: &State) {
        let n = state.len();
        self.safe.clear();
        self.safe.extend_from_slice(&state.position[..n]);
        if self.clear.len() != n {
            self.clear_at.clone_from(&self.safe);
            self.clear.clear();
            self.clear.resize(n, 0.0);
        }
    }

    /// Judges the ways since the last time, and takes back what is beyond a wall; the velocity into the wall bounces.
    pub fn hold(&mut self, world: &World, state: &mut State) {
        for i in 0..self.safe.len() {
            let (from, to) = (self.safe[i], state.position[i]);
            let (at, clear) = (self.clear_at[i], self.clear[i] * self.clear[i]);
            let inside = |place: DVec2| (place - at).length_squared() < clear;
            if from != to && !(inside(from) && inside(to)) {
                self.judge(world, state, i);
            }
            self.safe[i] = state.position[i];
        }
    }

    /// The whole judgement of body `i`. O(walls).
    fn judge(&mut self, world: &World, state: &mut State, i: usize) {
        let (from, to) = (self.safe[i], state.position[i]);
        self.clear_at[i] = from;
        self.clear[i] = f64::INFINITY;
        // A way that is no number belongs to the check for divergence.
        if !world.bodies.may_touch_walls(i) || !to.is_finite() {
            return;
        }
        let core = CORE * world.bodies.radius[i];
        let distance = |wall: &Wall| wall.shape.distance(from).0.abs();
        let nearest = world.walls.iter().map(distance).fold(f64::INFINITY, f64::min);
        self.clear[i] = (CLEAR * nearest - core).max(0.0);
        if (to - from).length() < self.clear[i] {
            return;
        }
        let mut velocity = state.velocity[i];
        let bounce = |wall: &Wall, normal: DVec2| {
            let surface = world.bodies.material(i).mixed(wall.material(), &world.tuning);
            let into = velocity.dot(normal).min(0.0);
            velocity -= (1.0 + surface.restitution) * into * normal;
        };
        if let Some(reached) = along_walls(&world.walls, from, to - from, core, bounce) {
            let passes = world.walls.iter().any(|wall| passes(&wall.shape, from, reached));
            state.position[i] = if passes { from } else { reached };
            state.velocity[i] = velocity;
        }
    }
}

/// Where a core comes to that goes by `path` and slides along the walls it meets; `None` if it meets none. `meet` is told of each.
fn along_walls(
    walls: &[Wall],
    from: DVec2,
    mut path: DVec2,
    core: f64,
    mut meet: impl FnMut(&Wall, DVec2),
) -> Option<DVec2> {
    let mut at = from;
    for slide in 0..=SLIDES {
        let Some((wall, normal, fraction)) = first_wall(walls, at, path, core) else {
            let straight = slide == 0 && !walls.iter().any(|wall| passes(&wall.shape, at, at + path));
            return (!straight).then_some(at + path);
        };
        meet(wall, normal);
        at += path * fraction;
        path *= 1.0 - fraction;
        path -= path.dot(normal) * normal;
    }
    Some(at)
}

/// The first wall that a core meets on `path`, its normal there, the fraction of the path. A wall that is nearer than the core already counts as
/// met where it comes nearer still.
fn first_wall(walls: &[Wall], from: DVec2, path: DVec2, core: f64) -> Option<(&Wall, DVec2, f64)> {
    let (low, high) = (from.min(from + path), from.max(from + path));
    let mut first: Option<(&Wall, DVec2, f64)> = None;
    for wall in walls {
        let (min, max) = wall.shape.bounds();
        if !(min.cmple(high + DVec2::splat(core)).all() && max.cmpge(low - DVec2::splat(core)).all()) {
            continue;
        }
        let nearest = wall.shape.distance(from).0.min(core);
        if nearest > 0.0
            && let Some((normal, fraction)) = disc_hits_wall(&wall.shape, from, path, nearest)
            && first.is_none_or(|first| fraction < first.2)
        {
            first = Some((wall, normal, fraction));
        }
    }
    first
}

/// Whether the straight way between two points ends on the other side of a shape, or on it, or goes through it. What starts on it may leave to
/// either side.
fn passes(shape: &Shape, start: DVec2, end: DVec2) -> bool {
    match *shape {
        Shape::Segment { from, to } => {
            let along = to - from;
            let (before, after) = (along.perp_dot(start - from), along.perp_dot(end - from));
            if before == 0.0 || after != 0.0 && before.signum() == after.signum() {
                return false;
            }
            let met = start + (end - start) * (before / (before - after));
            let part = (met - from).dot(along) / along.length_squared();
            (-JOINED..=1.0 + JOINED).contains(&part)
        }
        Shape::Box { min, max } => {
            let (mut enters, mut leaves) = (0.0f64, 1.0f64);
            for axis in 0..2 {
                let (at, way) = (start[axis], end[axis] - start[axis]);
                if way == 0.0 {
                    if !(at > min[axis] && at < max[axis]) {
                        return false;
                    }
                    continue;
                }
                let (one, other) = ((min[axis] - at) / way, (max[axis] - at) / way);
                enters = enters.max(one.min(other));
                leaves = leaves.min(one.max(other));
            }
            // From inside of it anything may leave.
            let inside = start.cmpgt(min).all() && start.cmplt(max).all();
            !inside && enters < leaves
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways_pass_a_segment_only_between_its_ends() {
        let shape = Shape::Segment { from: DVec2::ZERO, to: DVec2::new(2.0, 0.0) };
        for (x, within) in [(1.0, true), (0.0, true), (2.0, true), (-1e-6, false), (2.0 + 1e-6, false)] {
            for sign in [1.0, -1.0] {
                let (near, far) = (DVec2::new(x, sign), DVec2::new(x, -1e-12 * sign));
                assert_eq!(passes(&shape, near, far), within, "{x}");
                assert_eq!(passes(&shape, near, DVec2::new(x, 0.0)), within, "{x}: on it");
                assert!(!passes(&shape, near, DVec2::new(x, 1e-12 * sign)) && !passes(&shape, far, far));
                assert!(!passes(&shape, DVec2::new(x, 0.0), far), "what lies on it may go anywhere");
            }
        }
    }

    #[test]
    fn ways_pass_a_box_by_entering_it() {
        let shape = Shape::Box { min: DVec2::new(0.0, -1.0), max: DVec2::new(1e-3, 1.0) };
        let v = DVec2::new;
        assert!(passes(&shape, v(-1.0, 0.0), v(1.0, 0.5)) && passes(&shape, v(-1.0, 0.0), v(5e-4, 0.0)));
        assert!(!passes(&shape, v(-1.0, 0.0), v(-1e-9, 0.9)) && !passes(&shape, v(-1.0, 1.5), v(1.0, 1.5)));
        assert!(!passes(&shape, v(0.0, -0.5), v(0.0, 0.5)), "along a side");
        assert!(!passes(&shape, v(5e-4, 0.0), v(1.0, 0.0)), "out of it");
    }

    #[test]
    fn a_core_pushed_at_a_wall_slides_on_and_stays_where_two_walls_meet() {
        let v = DVec2::new;
        let walls = [Wall::segment(v(-1.0, 0.0), v(1.0, 0.0)), Wall::segment(v(1.0, -1.0), v(1.0, 1.0))];
        let way = |from: DVec2, path: DVec2| along_walls(&walls, from, path, 0.1, |_, _| {});
        assert_eq!(way(v(0.0, 0.5), v(0.2, -0.3)), None);
        let on = way(v(0.0, 0.5), v(0.2, -2.0)).unwrap();
        assert!((on - v(0.2, 0.1)).length() < 1e-9, "{on}");
        // Nearer than the core already: not nearer.
        let on = way(v(0.0, 0.01), v(0.3, -0.3)).unwrap();
        assert!((on - v(0.3, 0.01)).length() < 1e-9, "{on}");
        let corner = way(v(0.5, 0.5), v(3.0, -3.0)).unwrap();
        assert!((corner - v(0.9, 0.1)).length() < 1e-8, "{corner}");
    }
}
