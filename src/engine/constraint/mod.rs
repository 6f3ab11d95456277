//! Constraints, all in one form: C(q), its Jacobian rows J, a compliance, and bounds on the multiplier λ.
//!
//! A multiplier is the force along the row [N]; the force on the bodies is Jᵀλ. For distances J points so that a *positive*
//! C is a stretch, hence a pull is a negative λ; [`Constraint::tension`] turns that round: positive pulls, negative pushes.

pub(crate) mod form;
pub(crate) mod grip;
mod pin;
mod rod;
mod rope;
mod spring;

use super::error::{EngineError, check, check_point};
use super::id::Id;
use super::method::Integrator;
use glam::DVec2;
use serde::{Deserialize, Serialize};

/// What a constraint asks for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Kind {
    /// Distance of the ends = `length` [m].
    Rod {
        /// Distance of the ends [m], 1e-9 … 1e9.
        length: f64,
    },
    /// Distance of the ends ≤ `length` [m].
    Rope {
        /// Largest distance of the ends [m], 1e-9 … 1e9.
        length: f64,
    },
    /// Force k (distance − rest) + c d(distance)/dt, pulling: `rest` [m], `stiffness` k [N/m], `damping` c [N·s/m].
    Spring {
        /// Distance at which it does not pull [m], ≥ 0.
        rest: f64,
        /// Force over elongation k [N/m], ≥ 0.
        stiffness: f64,
        /// Force over the speed of elongation c [N·s/m], ≥ 0.
        damping: f64,
    },
    /// The ends coincide. Bodies may turn about it.
    Pin,
}

impl Kind {
    /// The name shown to a user.
    pub fn name(&self) -> &'static str {
        match self {
            Kind::Rod { .. } => "Rod",
            Kind::Rope { .. } => "Rope",
            Kind::Spring { .. } => "Spring",
            Kind::Pin => "Pin",
        }
    }

    /// Refuses NaN, infinities and negative lengths, stiffnesses and dampings.
    pub fn validate(&self) -> Result<(), EngineError> {
        match *self {
            Kind::Rod { length } => check("rod length", length, [1e-9, 1e9], "between 1e-9 and 1e9 m"),
            Kind::Rope { length } => check("rope length", length, [1e-9, 1e9], "between 1e-9 and 1e9 m"),
            Kind::Spring { rest, stiffness, damping } => {
                check("rest length", rest, [0.0, 1e9], "between 0 and 1e9 m")?;
                check("stiffness", stiffness, [0.0, 1e15], "between 0 and 1e15 N/m")?;
                check("spring damping", damping, [0.0, 1e15], "between 0 and 1e15 N·s/m")
            }
            Kind::Pin => Ok(()),
        }
    }
}

/// One end of a constraint.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Anchor {
    /// A point of a body, in the body's own axes, from its centre [m]. For a particle it must be (0, 0).
    Body(Id, DVec2),
    /// A fixed point of the world [m].
    World(DVec2),
}

impl Anchor {
    /// The centre of a body.
    pub fn centre(id: Id) -> Anchor {
        Anchor::Body(id, DVec2::ZERO)
    }

    /// The body at this end, if any.
    pub fn body(&self) -> Option<Id> {
        match self {
            Anchor::Body(id, _) => Some(*id),
            Anchor::World(_) => None,
        }
    }

    pub(crate) fn point(&self) -> DVec2 {
        match self {
            Anchor::Body(_, point) | Anchor::World(point) => *point,
        }
    }
}

/// One constraint, whole: what a caller hands in and gets back.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Constraint {
    /// What it asks for, and its numbers.
    pub kind: Kind,
    /// First end.
    pub a: Anchor,
    /// Second end; not the same body as the first, nor both fixed.
    pub b: Anchor,
}

impl Constraint {
    /// Between the centres of two bodies.
    pub fn between(kind: Kind, a: Id, b: Id) -> Constraint {
        Constraint { kind, a: Anchor::centre(a), b: Anchor::centre(b) }
    }

    /// Between the centre of a body and a fixed point [m].
    pub fn to_world(kind: Kind, a: Id, point: DVec2) -> Constraint {
        Constraint { kind, a: Anchor::centre(a), b: Anchor::World(point) }
    }

    /// Refuses bad numbers and two equal or two fixed ends.
    pub fn validate(&self) -> Result<(), EngineError> {
        self.kind.validate()?;
        check_point("first anchor", self.a.point())?;
        check_point("second anchor", self.b.point())?;
        match (self.a.body(), self.b.body()) {
            (None, None) => Err(EngineError::SameEnds),
            (a, b) if a == b => Err(EngineError::SameEnds),
            _ => Ok(()),
        }
    }
}

/// Dense index that stands for the immovable world at an end of a constraint.
pub(crate) const WORLD: u32 = u32::MAX;

/// All constraints, an array a property, in ascending order of id.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Constraints {
    /// Ids, ascending.
    pub id: Vec<Id>,
    /// What each of them asks for.
    pub kind: Vec<Kind>,
    /// Dense index of the first body, or `u32::MAX` for the world.
    pub a: Vec<u32>,
    /// Dense index of the second body, or `u32::MAX` for the world.
    pub b: Vec<u32>,
    /// Anchor in the axes of `a`, or the fixed point [m].
    pub at_a: Vec<DVec2>,
    /// Anchor in the axes of `b`, or the fixed point [m].
    pub at_b: Vec<DVec2>,
    /// The multipliers that the last substep found [N]: for distances (λ, 0), for pins the force on `b`.
    pub force: Vec<DVec2>,
    /// Carried whole with its island in the last step: `force` is then that of an instant, and no start for sweeps.
    pub(crate) carried: Vec<bool>,
    /// What its island found in the last step about the steps to come.
    pub(crate) foresight: Vec<Foresight>,
}

/// What an island found in a step about those to come, so that a fresh stepper goes on as the old one would.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Foresight {
    /// What carried it; none if nothing is known, or nothing could.
    pub integrator: Option<Integrator>,
    /// Steps between the last two contests of methods, and to the next one; or steps for which it is left to the substeps.
    pub interval: u32,
    pub due: u32,
    /// Contests in a row in which no method kept the accuracy.
    pub lapses: u32,
    /// Parts that Radau's methods of 3 and 5 stages cut the step into; 0 if they did not.
    pub parts: [f64; 2],
    /// Equal steps to begin with, if what carried it takes such and an accuracy is asked for; 0 if nothing is known.
    pub steps: u32,
    /// Work of what carried it when methods were last compared [ns].
    pub work: f64,
    /// How many times the accuracy it was carried with, where nothing could carry it with that; 0 if it could.
    #[serde(default)]
    pub coarser: f64,
}

impl Constraints {
    /// Number of constraints.
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// Dense index of a constraint, if it exists. O(log n).
    pub fn index_of(&self, id: Id) -> Option<usize> {
        super::id::find(&self.id, id)
    }

    /// Tension of constraint `index` [N], from the multiplier of the last substep: positive pulls, negative pushes.
    /// For a pin the magnitude of its force.
    pub fn tension(&self, index: usize) -> f64 {
        match self.kind[index] {
            Kind::Pin => self.force[index].length(),
            _ => -self.force[index].x,
        }
    }
}

/// The mouse's hold on a body: a spring and damper from a point of the body to the target, with a bounded force.
///
/// Critically damped by default, and scaled by the body's mass, so that it feels the same for a gram and for a tonne. A static
/// body is led to the target as if nothing else acted on it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Grip {
    /// The body that is held.
    pub body: Id,
    /// Grabbed point in the body's axes, from its centre [m]; (0, 0) for a particle.
    pub local: DVec2,
    /// Where that point is pulled to [m].
    pub target: DVec2,
    /// Natural frequency of the hold [Hz].
    pub frequency: f64,
    /// 1 is critical damping.
    pub damping_ratio: f64,
    /// Largest force [N].
    pub max_force: f64,
    /// Force of the last substep on the body [N].
    pub force: DVec2,
}

impl Grip {
    /// 7.5 Hz, critically damped, at most 100 times the weight of `mass` under 9.81 m/s².
    pub fn new(body: Id, local: DVec2, target: DVec2, mass: f64) -> Grip {
        Grip {
            body,
            local,
            target,
            frequency: 7.5,
            damping_ratio: 1.0,
            max_force: 100.0 * 9.81 * mass,
            force: DVec2::ZERO,
        }
    }

    /// Part of the largest force that is in use, 0 … 1.
    pub fn load(&self) -> f64 {
        if self.max_force > 0.0 { (self.force.length() / self.max_force).min(1.0) } else { 0.0 }
    }
}
