//! A pile: discs of random size strewn over a rectangle, ready to be poured.

use super::super::build::disc_mass;
use super::super::error::{Fault, Problem};
use super::super::random::Random;
use super::{Generate, Layout, check_point, check_range};
use crate::engine::{Body, DVec2, Spin, World};
use serde::{Deserialize, Serialize};

/// `count` discs `name.0` …, row by row from the bottom of the rectangle. Each has a cell of its own in a square lattice, in
/// which it lies at random: none overlap.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Pile {
    /// By which constraints refer to its discs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Number of discs, 1 … 1e6; the rectangle must have a cell for each.
    pub count: u32,
    /// Lower left corner of the rectangle [m].
    pub min: DVec2,
    /// Upper right corner of the rectangle [m].
    pub max: DVec2,
    /// Smallest and largest radius [m].
    pub radius: (f64, f64),
    /// [kg/m²]
    pub density: f64,
    /// The same seed gives the same pile.
    pub seed: u64,
    /// Whether the discs turn.
    pub spin: bool,
    /// Coefficient of friction of the discs, ≥ 0.
    pub friction: f64,
    /// Coefficient of restitution of the discs, 0 … 1.
    pub restitution: f64,
}

impl Default for Pile {
    fn default() -> Self {
        Pile {
            name: None,
            count: 100,
            min: DVec2::new(-1.5, 0.0),
            max: DVec2::new(1.5, 3.0),
            radius: (0.05, 0.1),
            density: 10.0,
            seed: 1,
            spin: false,
            friction: 0.5,
            restitution: 0.0,
        }
    }
}

impl Generate for Pile {
    fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    fn layout(&self) -> Layout {
        Layout::Line(self.count as usize)
    }

    fn check(&self) -> Result<(), Fault> {
        check_point("min", self.min)?;
        check_point("max", self.max)?;
        check_range("count", f64::from(self.count), [1.0, 1e6], "")?;
        let (smallest, largest) = self.radius;
        check_range("radius", smallest, [1e-6, 1e6], "m")?;
        check_range("radius", largest, [smallest, 1e6], "m, the smaller one first")?;
        let room = self.columns() * self.rows();
        if room >= f64::from(self.count) {
            return Ok(());
        }
        let found = format!("a count of {} in a rectangle with room for {}", self.count, room);
        let mend = "Enlarge the rectangle from min to max, or take fewer or smaller discs.";
        Err(Fault::new(Some("count"), Problem::new(found, "a rectangle that holds them all", mend)))
    }

    fn build(&self, world: &mut World, _: u32) -> Result<(), Fault> {
        let mut random = Random::new(self.seed);
        let cell = 2.0 * self.radius.1;
        // At least the count, which is at most a million: exact as an integer.
        let columns = self.columns().min(f64::from(self.count)) as u32;
        for i in 0..self.count {
            let radius = random.between(self.radius.0, self.radius.1);
            let corner = self.min + DVec2::new(f64::from(i % columns), f64::from(i / columns)) * cell;
            let x = random.between(radius, cell - radius);
            let y = random.between(radius, cell - radius);
            world.add_body(&Body {
                position: corner + DVec2::new(x, y),
                mass: disc_mass(self.density, radius)?,
                radius,
                spin: self.spin.then(Spin::default),
                friction: self.friction,
                restitution: self.restitution,
                ..Body::default()
            })?;
        }
        Ok(())
    }
}

impl Pile {
    fn columns(&self) -> f64 {
        ((self.max.x - self.min.x) / (2.0 * self.radius.1)).floor().max(0.0)
    }

    fn rows(&self) -> f64 {
        ((self.max.y - self.min.y) / (2.0 * self.radius.1)).floor().max(0.0)
    }
}
