//! Continuous detection: where a moving disc first meets something, and the drift.

use crate::engine::shape::Shape;
use crate::engine::state::State;
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
pub(crate) fn disc_hits_wall(shape: &Shape, position: DVec2, path: DVec2, radius: f64) -> Option<(DVec2, f64)> {
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
