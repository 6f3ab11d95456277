//! Continuous detection: where a moving disc first meets something, and the drift that stops there as the last resort.

use super::may_touch_walls;
use crate::engine::shape::{Shape, Wall};
use crate::engine::state::State;
use crate::engine::world::World;
use glam::DVec2;

/// Part of a disc's radius that must never get through a wall. Contacts stop the full disc; this catches what a solver that
/// did not converge, or an edit, lets through. Smaller lets discs sink in deeper before it acts.
pub(crate) const CORE: f64 = 0.5;
/// Newton steps along a path; a handful suffices. A path that still has not met the wall then grazes a corner of it.
const ADVANCES: u32 = 64;

/// First meeting of a disc at `offset` from another, moving by `path`, when their radii add up to `radius`: the unit normal
/// towards the moving disc there, and the fraction of the path. `None` if they do not meet or part.
pub(super) fn disc_hits_disc(offset: DVec2, path: DVec2, radius: f64) -> Option<(DVec2, f64)> {
    // |offset + t path| = radius, the smaller root, in the form that does not cancel.
    let (a, b, c) = (path.length_squared(), offset.dot(path), offset.length_squared() - radius * radius);
    let discriminant = b * b - a * c;
    if b >= 0.0 || c < 0.0 || discriminant < 0.0 {
        return None;
    }
    let t = c / (-b + discriminant.sqrt());
    (t <= 1.0).then(|| ((offset + t * path) / radius, t))
}

/// First meeting of a disc of `radius` at `position` with a wall, moving by `path`: the outward unit normal there and the
/// fraction of the path.
///
/// Newton's method on the distance, which along a straight path past a convex shape is a convex function of the way: from
/// outside, a step along its tangent never jumps over the first meeting, and converges quadratically also where the path
/// grazes. (Conservative advancement, by the distance itself, needs hundreds of steps there.)
pub(super) fn disc_hits_wall(shape: &Shape, position: DVec2, path: DVec2, radius: f64) -> Option<(DVec2, f64)> {
    let tolerance = 1e-9 * radius;
    let mut t = 0.0;
    for _ in 0..ADVANCES {
        let (distance, normal) = shape.distance(position + t * path);
        let (gap, closing) = (distance - radius, -path.dot(normal));
        if !(closing > 0.0) {
            return None;
        }
        if gap <= tolerance {
            return Some((normal, t));
        }
        t += gap / closing;
        if !(t <= 1.0) {
            return None;
        }
    }
    let (distance, normal) = shape.distance(position + t * path);
    (distance - radius <= 1e-3 * radius && path.dot(normal) < 0.0).then_some((normal, t))
}

/// Moves every body that moves along its velocity for `h` seconds.
pub(crate) fn drift(state: &mut State, h: f64) {
    for ((position, velocity), moves) in state.position.iter_mut().zip(&state.velocity).zip(&state.moves) {
        if *moves {
            *position += h * *velocity;
        }
    }
    for (angle, omega) in state.angle.iter_mut().zip(&state.omega) {
        *angle += h * omega;
    }
}

/// Puts a body back to where its core met a wall on the straight way from `start`; there its velocity into the wall bounces.
pub(crate) fn keep_out_of_walls(world: &World, state: &mut State, start: &[DVec2]) {
    for (i, from) in start.iter().enumerate().take(state.len()) {
        let path = state.position[i] - *from;
        let core = CORE * world.bodies.radius[i];
        if path.length_squared() > core * core
            && may_touch_walls(world, i as u32)
            && let Some((wall, normal, fraction)) = first_wall(world, *from, path, core)
        {
            state.position[i] = *from + path * fraction;
            let own = world.bodies.restitution[i].max(wall.restitution);
            let into = state.velocity[i].dot(normal).min(0.0);
            state.velocity[i] -= (1.0 + world.tuning.restitution.unwrap_or(own)) * into * normal;
        }
    }
}

/// The first wall that a disc of radius `core` meets on `path` from outside of it, its normal there, the fraction of the path.
fn first_wall(world: &World, from: DVec2, path: DVec2, core: f64) -> Option<(&Wall, DVec2, f64)> {
    let (low, high) = (from.min(from + path), from.max(from + path));
    let mut first: Option<(&Wall, DVec2, f64)> = None;
    for wall in &world.walls {
        let (min, max) = wall.shape.bounds();
        let near = min.cmple(high + DVec2::splat(core)).all() && max.cmpge(low - DVec2::splat(core)).all();
        if near
            && wall.shape.distance(from).0 > core
            && let Some((normal, fraction)) = disc_hits_wall(&wall.shape, from, path, core)
            && first.is_none_or(|first| fraction < first.2)
        {
            first = Some((wall, normal, fraction));
        }
    }
    first
}
