//! The camera as a picture needs it: places in points from the middle of the canvas, y up, and what can be seen at all.

use crate::app::Camera;
use crate::engine::DVec2;

/// Room around the canvas [points] within which marks are still drawn: more than the widest stroke.
const MARGIN: f64 = 16.0;

/// The part of the world that is seen. Everything is computed in double precision from the camera's centre.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub centre: DVec2,
    /// Points a metre.
    pub scale: f64,
    /// Half the size of the canvas, with the margin [points].
    half: DVec2,
}

impl View {
    pub(super) fn new(camera: &Camera) -> View {
        View { centre: camera.centre, scale: camera.scale, half: camera.size / 2.0 + MARGIN }
    }

    /// Where a point of the world lies.
    pub(super) fn place(&self, world: DVec2) -> DVec2 {
        (world - self.centre) * self.scale
    }

    /// Corners of what is seen, in the world.
    pub(super) fn bounds(&self) -> (DVec2, DVec2) {
        (self.centre - self.half / self.scale, self.centre + self.half / self.scale)
    }

    /// Whether any of a disc is seen.
    pub(super) fn sees_disc(&self, at: DVec2, radius: f64) -> bool {
        let outside = (at.abs() - self.half).max(DVec2::ZERO);
        outside.length() <= radius
    }

    /// The part of a segment that is seen (Liang and Barsky 1984), so that no mark reaches further than single precision
    /// can count; `None` if there is none.
    pub(super) fn clip(&self, from: DVec2, to: DVec2) -> Option<(DVec2, DVec2)> {
        let along = to - from;
        let (mut enter, mut leave) = (0.0f64, 1.0f64);
        let sides = [
            (-along.x, from.x + self.half.x),
            (along.x, self.half.x - from.x),
            (-along.y, from.y + self.half.y),
            (along.y, self.half.y - from.y),
        ];
        for (towards, room) in sides {
            if towards == 0.0 && room < 0.0 {
                return None;
            }
            if towards < 0.0 {
                enter = enter.max(room / towards);
            } else if towards > 0.0 {
                leave = leave.min(room / towards);
            }
        }
        (enter <= leave && enter.is_finite() && leave.is_finite())
            .then(|| (from + along * enter, if leave < 1.0 { from + along * leave } else { to }))
    }

    /// The part of a box that is seen; sides out of sight are moved to just outside. `None` if there is none.
    pub(super) fn clip_box(&self, low: DVec2, high: DVec2) -> Option<(DVec2, DVec2)> {
        let (low, high) = (low.max(-self.half), high.min(self.half));
        (low.x <= high.x && low.y <= high.y).then_some((low, high))
    }
}

/// In single precision, for a mark.
pub(super) fn single(point: DVec2) -> [f32; 2] {
    [point.x as f32, point.y as f32]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view() -> View {
        View::new(&Camera { centre: DVec2::ZERO, scale: 1.0, size: DVec2::new(168.0, 68.0) })
    }

    #[test]
    fn a_segment_is_cut_to_what_is_seen() {
        let cases = [
            ((-1e15, 0.0), (1e15, 0.0), Some(((-100.0, 0.0), (100.0, 0.0)))),
            ((0.0, 0.0), (0.0, 1e9), Some(((0.0, 0.0), (0.0, 50.0)))),
            ((3.0, 4.0), (3.0, 4.0), Some(((3.0, 4.0), (3.0, 4.0)))),
            ((-90.0, 60.0), (90.0, 60.0), None),
            ((90.0, 200.0), (200.0, 20.0), None),
        ];
        for ((ax, ay), (bx, by), expected) in cases {
            let found = view().clip(DVec2::new(ax, ay), DVec2::new(bx, by));
            let expected = expected.map(|((ax, ay), (bx, by))| (DVec2::new(ax, ay), DVec2::new(bx, by)));
            // 1e15 leaves a tenth in the crossing.
            let near = |(a, b): (DVec2, DVec2), (c, d): (DVec2, DVec2)| (a - c).length() + (b - d).length() < 0.5;
            assert!(
                match (found, expected) {
                    (Some(found), Some(expected)) => near(found, expected),
                    (None, None) => true,
                    _ => false,
                },
                "{found:?} instead of {expected:?}"
            );
        }
    }
}
