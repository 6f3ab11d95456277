//! Bodies: particles and discs, static, kinematic or dynamic, as structs of arrays.

use super::error::{EngineError, LARGEST_SPEED, MASS_RANGE, check, check_point};
use super::id::{Id, find};
use super::material::Material;
use glam::DVec2;
use serde::{Deserialize, Serialize};

/// What may move a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Motion {
    /// Never moves.
    Static,
    /// Moves with its own velocity; nothing pushes it.
    Kinematic,
    /// Moved by forces, constraints and contacts.
    #[default]
    Dynamic,
}

/// The rotation of a body that has one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Spin {
    /// Angle from the x axis, counter-clockwise [rad].
    pub angle: f64,
    /// Angular velocity [rad/s].
    pub omega: f64,
}

/// One body, whole: what a caller hands in and gets back. The world keeps [`Bodies`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Body {
    /// What may move it.
    pub motion: Motion,
    /// Centre [m].
    pub position: DVec2,
    /// Velocity of the centre [m/s].
    pub velocity: DVec2,
    /// Mass [kg]; kept, but without effect, while the body is static or kinematic.
    pub mass: f64,
    /// Radius [m]; 0 for a point, which never touches anything.
    pub radius: f64,
    /// `None` for a particle, which has no angle; `Some` for a disc that turns (moment of inertia ½ m r²).
    pub spin: Option<Spin>,
    /// Coefficient of restitution, 0 … 1; a contact takes the larger of the two.
    pub restitution: f64,
    /// Coefficient of friction, ≥ 0; a contact takes the geometric mean of the two.
    pub friction: f64,
    /// Whether it can touch anything at all.
    pub collides: bool,
    /// Bodies of the same group other than 0 do not touch each other.
    pub group: u32,
}

impl Default for Body {
    fn default() -> Self {
        Body {
            motion: Motion::Dynamic,
            position: DVec2::ZERO,
            velocity: DVec2::ZERO,
            mass: 1.0,
            radius: 0.1,
            spin: None,
            restitution: 0.0,
            friction: 0.5,
            collides: true,
            group: 0,
        }
    }
}

impl Body {
    /// Refuses what no step could read: NaN, infinities, a mass or radius out of range, a disc that turns without a radius.
    pub fn validate(&self) -> Result<(), EngineError> {
        check_point("position", self.position)?;
        check("speed", self.velocity.length(), [0.0, LARGEST_SPEED], "finite and at most 1e8 m/s")?;
        check("mass", self.mass, MASS_RANGE, "between 1e-12 and 1e12 kg")?;
        check("radius", self.radius, [0.0, 1e6], "between 0 and 1e6 m")?;
        check("restitution", self.restitution, [0.0, 1.0], "between 0 and 1")?;
        check("friction", self.friction, [0.0, 1e3], "between 0 and 1000")?;
        if let Some(spin) = self.spin {
            check("angle", spin.angle, [-1e9, 1e9], "between -1e9 and 1e9 rad")?;
            check("angular velocity", spin.omega, [-1e8, 1e8], "between -1e8 and 1e8 rad/s")?;
            check("radius of a body with spin", self.radius, [1e-9, 1e6], "between 1e-9 and 1e6 m")?;
        }
        Ok(())
    }

    /// 1/m [1/kg], 0 if nothing can push it.
    pub fn inverse_mass(&self) -> f64 {
        if self.motion == Motion::Dynamic { 1.0 / self.mass } else { 0.0 }
    }

    /// Moment of inertia about the centre of a solid disc, ½ m r² [kg·m²].
    pub fn inertia(&self) -> f64 {
        0.5 * self.mass * self.radius * self.radius
    }

    /// 1/I [1/(kg·m²)]; 0 if nothing can turn it.
    pub fn inverse_inertia(&self) -> f64 {
        match (self.motion, self.spin) {
            (Motion::Dynamic, Some(_)) => 1.0 / self.inertia(),
            _ => 0.0,
        }
    }
}

/// Index into [`Rotors`] of a body without rotation.
pub(crate) const NO_ROTOR: u32 = u32::MAX;

/// All bodies, an array a property, in ascending order of id. Arrays are public for reading; the world keeps them consistent.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Bodies {
    /// Ids, ascending.
    pub id: Vec<Id>,
    /// What may move each body.
    pub motion: Vec<Motion>,
    /// Centres [m].
    pub position: Vec<DVec2>,
    /// Velocities [m/s].
    pub velocity: Vec<DVec2>,
    /// Masses [kg].
    pub mass: Vec<f64>,
    /// 1/m [1/kg], 0 unless dynamic.
    pub inverse_mass: Vec<f64>,
    /// Radii [m].
    pub radius: Vec<f64>,
    /// Coefficients of restitution, 0 … 1.
    pub restitution: Vec<f64>,
    /// Coefficients of friction, ≥ 0.
    pub friction: Vec<f64>,
    /// Whether each body can touch anything at all.
    pub collides: Vec<bool>,
    /// Collision groups; bodies of the same one other than 0 do not touch each other.
    pub group: Vec<u32>,
    /// Index of the body's rotation in `rotors`, or `NO_ROTOR`.
    pub(crate) rotor: Vec<u32>,
    pub(crate) rotors: Rotors,
}

/// The rotations of those bodies that have one; a particle takes no room here.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Rotors {
    /// Index of the body.
    pub body: Vec<u32>,
    /// [rad]
    pub angle: Vec<f64>,
    /// [rad/s]
    pub omega: Vec<f64>,
    /// About the centre [kg·m²]; without effect while the body is static or kinematic.
    pub inertia: Vec<f64>,
    /// [1/(kg·m²)], 0 unless dynamic
    pub inverse_inertia: Vec<f64>,
}

impl Bodies {
    /// Number of bodies.
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// Dense index of a body, if it exists. O(log n).
    pub fn index_of(&self, id: Id) -> Option<usize> {
        find(&self.id, id)
    }

    /// What body `index` is made of.
    pub fn material(&self, index: usize) -> Material {
        Material { restitution: self.restitution[index], friction: self.friction[index] }
    }

    /// Moment of inertia of body `index` about its centre [kg·m²]; `None` for a particle.
    pub fn inertia(&self, index: usize) -> Option<f64> {
        let rotor = self.rotor[index];
        (rotor != NO_ROTOR).then(|| self.rotors.inertia[rotor as usize])
    }

    /// The rotation of body `index`, `None` for a particle.
    pub fn spin(&self, index: usize) -> Option<Spin> {
        let rotor = self.rotor[index];
        (rotor != NO_ROTOR)
            .then(|| Spin { angle: self.rotors.angle[rotor as usize], omega: self.rotors.omega[rotor as usize] })
    }

    /// Body `index`, whole.
    pub fn get(&self, index: usize) -> Body {
        Body {
            motion: self.motion[index],
            position: self.position[index],
            velocity: self.velocity[index],
            mass: self.mass[index],
            radius: self.radius[index],
            spin: self.spin(index),
            restitution: self.restitution[index],
            friction: self.friction[index],
            collides: self.collides[index],
            group: self.group[index],
        }
    }

    /// Number of bodies with a rotation.
    pub fn spinning(&self) -> usize {
        self.rotors.body.len()
    }

    pub(crate) fn push(&mut self, id: Id, body: &Body) {
        self.id.push(id);
        self.motion.push(body.motion);
        self.position.push(body.position);
        self.velocity.push(body.velocity);
        self.mass.push(body.mass);
        self.inverse_mass.push(body.inverse_mass());
        self.radius.push(body.radius);
        self.restitution.push(body.restitution);
        self.friction.push(body.friction);
        self.collides.push(body.collides);
        self.group.push(body.group);
        self.rotor.push(match body.spin {
            Some(spin) => self.rotors.push(self.id.len() - 1, spin, body),
            None => NO_ROTOR,
        });
    }

    /// Rebuilds the arrays from whole bodies: the slow, simple way to change any of them. O(n).
    pub(crate) fn rebuild(&mut self, bodies: impl Iterator<Item = (Id, Body)>) {
        let mut new = Bodies::default();
        for (id, body) in bodies {
            new.push(id, &body);
        }
        *self = new;
    }

    /// Every body with its id.
    pub fn iter(&self) -> impl Iterator<Item = (Id, Body)> + '_ {
        (0..self.len()).map(|index| (self.id[index], self.get(index)))
    }
}

impl Rotors {
    fn push(&mut self, index: usize, spin: Spin, body: &Body) -> u32 {
        self.body.push(index as u32);
        self.angle.push(spin.angle);
        self.omega.push(spin.omega);
        self.inertia.push(body.inertia());
        self.inverse_inertia.push(body.inverse_inertia());
        (self.body.len() - 1) as u32
    }
}
