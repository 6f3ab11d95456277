//! Newton's cradle: equal balls in a row, each hanging on a rod.

use super::super::error::Fault;
use super::{Generate, Layout, check_point, check_range};
use crate::engine::{Anchor, Body, Constraint, DVec2, Kind, World};
use serde::{Deserialize, Serialize};

/// `balls` balls `name.0` … from the left, the first `raised` of them lifted to the left.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Cradle {
    /// By which constraints refer to its balls.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Middle of the beam from which the rods hang [m].
    pub centre: DVec2,
    /// Number of balls, 1 … 1e6.
    pub balls: u32,
    /// How many balls are lifted, 0 … `balls`.
    pub raised: u32,
    /// How far those are lifted, from the vertical [rad].
    pub angle: f64,
    /// Length of a rod [m].
    pub length: f64,
    /// Mass of a ball [kg].
    pub mass: f64,
    /// Radius of a ball [m].
    pub radius: f64,
    /// Distance of the surfaces at rest [m].
    pub gap: f64,
    /// Coefficient of restitution of the balls, 0 … 1; they have no friction.
    pub restitution: f64,
}

impl Default for Cradle {
    fn default() -> Self {
        Cradle {
            name: None,
            centre: DVec2::ZERO,
            balls: 5,
            raised: 1,
            angle: 0.8,
            length: 2.0,
            mass: 1.0,
            radius: 0.2,
            gap: 0.002,
            restitution: 1.0,
        }
    }
}

impl Generate for Cradle {
    fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    fn layout(&self) -> Layout {
        Layout::Line(self.balls as usize)
    }

    fn check(&self) -> Result<(), Fault> {
        check_point("centre", self.centre)?;
        check_range("radius", self.radius, [0.0, 1e6], "m")?;
        check_range("balls", f64::from(self.balls), [1.0, 1e6], "")?;
        check_range("raised", f64::from(self.raised), [0.0, f64::from(self.balls)], "")?;
        check_range("angle", self.angle, [-3.2, 3.2], "rad")?;
        check_range("gap", self.gap, [0.0, 1e3], "m")?;
        check_range("length", self.length, [1e-6, 1e6], "m")
    }

    fn build(&self, world: &mut World, _: u32) -> Result<(), Fault> {
        let pitch = 2.0 * self.radius + self.gap;
        for i in 0..self.balls {
            let from_middle = f64::from(i) - f64::from(self.balls - 1) / 2.0;
            let hook = self.centre + DVec2::new(from_middle * pitch, 0.0);
            let (sin, cos) = libm::sincos(if i < self.raised { self.angle } else { 0.0 });
            let ball = world.add_body(&Body {
                position: hook - DVec2::new(sin, cos) * self.length,
                mass: self.mass,
                radius: self.radius,
                restitution: self.restitution,
                friction: 0.0,
                ..Body::default()
            })?;
            let rod = Kind::Rod { length: self.length };
            world.add_constraint(&Constraint { kind: rod, a: Anchor::World(hook), b: Anchor::centre(ball) })?;
        }
        Ok(())
    }
}
