//! Measures of a world: energy by kind, momentum, how far constraints are violated and surfaces overlap,
//! and of a motion: how far it is from the truth.

mod drift;
mod error;
mod growth;
mod uncertain;

pub use drift::EnergyDrift;
pub use error::{Distance, ErrorSum, error_against, observed_order};
pub use growth::{Growth, SENSITIVE};
pub use uncertain::Uncertain;

use crate::engine::constraint::Constraints;
use crate::engine::{DVec2, Kind, World};

/// All measures of one instant, in SI units. Static and kinematic bodies carry no energy or momentum here.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measures {
    /// [s]
    pub time: f64,
    /// Of translation and rotation [J].
    pub kinetic: f64,
    /// In gravity, zero at the origin [J].
    pub potential: f64,
    /// In springs [J].
    pub elastic: f64,
    /// [kg·m/s]
    pub momentum: DVec2,
    /// About the origin [kg·m²/s].
    pub angular_momentum: f64,
    /// Worst violation of a rod, a taut rope or a pin [m].
    pub violation_max: f64,
    /// Root mean square of the violations of all rods, ropes and pins, slack ropes counting as 0 [m].
    pub violation_rms: f64,
    /// Deepest overlap of two surfaces [m].
    pub penetration_max: f64,
    /// Contacts whose surfaces touch or carry a force.
    pub contacts: usize,
}

impl Measures {
    /// Measures `world` as it stands. O(bodies + constraints + contacts).
    pub fn of(world: &World) -> Measures {
        let mut measures = Measures { time: world.time(), ..Measures::default() };
        measures.add_bodies(world);
        measures.add_constraints(world);
        measures.add_contacts(world);
        measures
    }

    /// Sum of the kinetic, potential and elastic energy [J].
    pub fn total_energy(&self) -> f64 {
        self.kinetic + self.potential + self.elastic
    }

    fn add_bodies(&mut self, world: &World) {
        let bodies = world.bodies();
        for i in (0..bodies.len()).filter(|&i| world.is_dynamic(i)) {
            let (mass, position, velocity) = (bodies.mass[i], bodies.position[i], bodies.velocity[i]);
            self.kinetic += 0.5 * mass * velocity.length_squared();
            self.potential -= mass * world.gravity().dot(position);
            self.momentum += mass * velocity;
            self.angular_momentum += mass * position.perp_dot(velocity);
            if let (Some(spin), Some(inertia)) = (bodies.spin(i), bodies.inertia(i)) {
                self.kinetic += 0.5 * inertia * spin.omega * spin.omega;
                self.angular_momentum += inertia * spin.omega;
            }
        }
    }

    fn add_constraints(&mut self, world: &World) {
        let constraints: &Constraints = world.constraints();
        let (mut sum, mut count) = (0.0, 0_u32);
        for (i, kind) in constraints.kind.iter().enumerate() {
            let (a, b) = world.ends(i);
            let distance = (b - a).length();
            let violation = match *kind {
                Kind::Rod { length } => (distance - length).abs(),
                Kind::Rope { length } => (distance - length).max(0.0),
                Kind::Pin => distance,
                Kind::Spring { rest, stiffness, .. } => {
                    let stretch = distance - rest;
                    self.elastic += 0.5 * stiffness * world.tuning().stiffness * stretch * stretch;
                    continue;
                }
            };
            self.violation_max = self.violation_max.max(violation);
            sum += violation * violation;
            count += 1;
        }
        self.violation_rms = (sum / f64::from(count.max(1))).sqrt();
    }

    fn add_contacts(&mut self, world: &World) {
        for contact in world.contacts() {
            let gap = world.gap(contact);
            self.penetration_max = self.penetration_max.max(-gap);
            self.contacts += usize::from(gap <= 0.0 || contact.normal_force > 0.0);
        }
    }
}
