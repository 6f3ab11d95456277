//! A stack: discs standing on each other.

use super::super::error::Fault;
use super::{Generate, Layout, check_point, check_range};
use crate::engine::{Body, DVec2, Spin, World};
use serde::{Deserialize, Serialize};

/// `count` equal discs `name.0` … from the bottom up, their surfaces touching. Round things balance only on a straight line:
/// a wall at each side makes them stand for good.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Stack {
    /// By which constraints refer to its discs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Where the lowest disc stands [m].
    pub base: DVec2,
    /// Number of discs, 1 … 1e6.
    pub count: u32,
    /// Mass of a disc [kg].
    pub mass: f64,
    /// Radius of a disc [m].
    pub radius: f64,
    /// Whether the discs turn.
    pub spin: bool,
    /// Coefficient of friction of the discs, ≥ 0.
    pub friction: f64,
    /// Coefficient of restitution of the discs, 0 … 1.
    pub restitution: f64,
}

impl Default for Stack {
    fn default() -> Self {
        Stack {
            name: None,
            base: DVec2::ZERO,
            count: 10,
            mass: 1.0,
            radius: 0.25,
            spin: true,
            friction: 0.5,
            restitution: 0.0,
        }
    }
}

impl Generate for Stack {
    fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    fn layout(&self) -> Layout {
        Layout::Line(self.count as usize)
    }

    fn check(&self) -> Result<(), Fault> {
        check_point("base", self.base)?;
        check_range("radius", self.radius, [0.0, 1e6], "m")?;
        check_range("count", f64::from(self.count), [1.0, 1e6], "")
    }

    fn build(&self, world: &mut World, _: u32) -> Result<(), Fault> {
        for i in 0..self.count {
            world.add_body(&Body {
                position: self.base + DVec2::new(0.0, self.radius * (1.0 + 2.0 * f64::from(i))),
                mass: self.mass,
                radius: self.radius,
                spin: self.spin.then(Spin::default),
                friction: self.friction,
                restitution: self.restitution,
                ..Body::default()
            })?;
        }
        Ok(())
    }
}
