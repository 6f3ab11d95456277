//! Where everything stands at an instant between the last two states.

use crate::app::Frame;
use crate::engine::DVec2;
use crate::engine::constraint::WORLD;

/// A frame at a share of the way from the state before to the state now.
#[derive(Clone, Copy)]
pub(super) struct Pose<'a> {
    frame: &'a Frame,
    /// 0 shows the state before, 1 the state now.
    share: f64,
}

impl<'a> Pose<'a> {
    pub(super) fn new(frame: &'a Frame, alpha: f64) -> Pose<'a> {
        let bodies = frame.world.bodies().len();
        let known = frame.previous_position.len() == bodies && frame.previous_angle.len() == bodies;
        Pose { frame, share: if known && alpha.is_finite() { alpha.clamp(0.0, 1.0) } else { 1.0 } }
    }

    /// Centre of a body [m].
    pub(super) fn position(&self, body: usize) -> DVec2 {
        let now = self.frame.world.bodies().position[body];
        if self.share == 1.0 { now } else { self.frame.previous_position[body].lerp(now, self.share) }
    }

    /// Angle of a body [rad]; `None` for a particle.
    pub(super) fn angle(&self, body: usize) -> Option<f64> {
        let now = self.frame.world.bodies().spin(body)?.angle;
        let before = if self.share == 1.0 { now } else { self.frame.previous_angle[body] };
        Some(before + (now - before) * self.share)
    }

    /// How far a body stands from where the frame has it [m].
    pub(super) fn shift(&self, body: usize) -> DVec2 {
        self.position(body) - self.frame.world.bodies().position[body]
    }

    /// An anchor in the world [m]: `body` as constraints store it, `u32::MAX` for the world.
    pub(super) fn point(&self, body: u32, at: DVec2) -> DVec2 {
        if body == WORLD {
            return at;
        }
        let centre = self.position(body as usize);
        match self.angle(body as usize) {
            Some(angle) if at != DVec2::ZERO => centre + DVec2::from_angle(angle).rotate(at),
            _ => centre,
        }
    }
}
