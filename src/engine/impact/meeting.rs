//! When moving things meet: discs with each other and with walls, surfaces that stop rubbing, contacts that come to the end of a side.
//!
//! The distance to a convex shape is a convex function of the place, so along a path its second derivative is no less than minus the acceleration.

use super::path::{Drag, Path, Weights};
use super::root::{Rounding, Sample, first_root};
use crate::engine::shape::Shape;
use glam::DVec2;

/// First time within `end` [s] from the path's instant at which a disc meets another one: `motion` is its centre's against the other's,
/// `radius` the sum of the radii.
pub(super) fn with_disc(motion: &Path, drag: Drag, radius: f64, end: f64, rounding: Rounding) -> Option<f64> {
    let most = motion.acceleration(drag);
    if motion.position.length() - radius > way(motion, most, end) {
        return None;
    }
    first_root(end, rounding, |t| {
        let there = motion.at(motion.since + t, drag);
        let distance = there.position.length();
        let normal = if distance > 0.0 { there.position / distance } else { DVec2::Y };
        Sample { gap: distance - radius, rate: normal.dot(there.velocity), bend: -there.acceleration(drag) }
    })
}

/// First time within `end` [s] from the path's instant at which a disc meets a wall.
pub(super) fn with_wall(
    path: &Path,
    drag: Drag,
    (shape, radius): (&Shape, f64),
    end: f64,
    rounding: Rounding,
) -> Option<f64> {
    let most = path.acceleration(drag);
    let reach = DVec2::splat(radius + way(path, most, end));
    let (min, max) = shape.bounds();
    if min.cmpgt(path.position + reach).any() || max.cmplt(path.position - reach).any() {
        return None;
    }
    first_root(end, rounding, |t| {
        let there = path.at(path.since + t, drag);
        let (distance, normal) = shape.distance(there.position);
        Sample { gap: distance - radius, rate: normal.dot(there.velocity), bend: -there.acceleration(drag) }
    })
}

/// First time within `end` [s] at which a motion along a line, with `speed` [m/s] and `drive` [m/s²], has gone the `way` [m] ≥ 0.
pub(super) fn after_way(way: f64, speed: f64, drive: f64, drag: Drag, end: f64, rounding: Rounding) -> Option<f64> {
    first_root(end, rounding, |t| {
        let Weights { kept, first, second } = drag.weights(t);
        let now = kept * speed + first * drive;
        Sample { gap: way - first * speed - second * drive, rate: -now, bend: -(drive - drag.0 * now).abs() }
    })
}

/// The time [s] at which `speed` comes to nothing under `drive`, if it does.
pub(super) fn standstill(speed: f64, drive: f64, drag: Drag) -> Option<f64> {
    if speed * drive >= 0.0 {
        return None;
    }
    // kept v + first a = 0, with kept = 1 − drag first.
    let first = speed / (drag.0 * speed - drive);
    if drag.0 == 0.0 { Some(first) } else { Some(-libm::log1p(-drag.0 * first) / drag.0) }
}

/// Longest way within `end` [s] [m].
fn way(path: &Path, most: f64, end: f64) -> f64 {
    end * (path.velocity.length() + end * most)
}
