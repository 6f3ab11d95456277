//! The pass of a scene that tries the engine: limits that a run, as it opens, must keep for some time.
//!
//! `pass: (seconds: 10, limits: [Gap(1e-3), Energy(1e-6)])`. A new kind of limit is a new variant here, with its name, unit and
//! bound, and an arm in `Trial::observe` that says what it measures; the window and the tests show and try it without further ado.

use serde::{Deserialize, Serialize};

/// What a run must keep to, and for how long.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pass {
    /// Simulated time from the start [s].
    pub seconds: f64,
    /// All of them.
    pub limits: Vec<Limit>,
}

/// One thing that a run must keep to: what its value stays below.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Limit {
    /// Worst violation of a rod, a taut rope or a pin, all through [m].
    Gap(f64),
    /// Worst change of the total energy, in parts of what the motion has moved of it ([`crate::measure::EnergyDrift`]).
    Energy(f64),
    /// Worst change of the angular momentum about the origin, in parts of what it was at the start.
    Spin(f64),
    /// Root mean square distance from the known motion over all bodies and known samples, in parts of the scene's length.
    Truth(f64),
    /// Worst change of the total momentum, in parts of what it was at the start.
    Momentum(f64),
    /// Deepest overlap of two surfaces, all through [m].
    Overlap(f64),
    /// Largest distance of a body from where it started, all through [m].
    Stay(f64),
    /// Worst sum of weight and contact forces on a body at the end, in parts of its weight: 0 if every contact carries what lies
    /// above it. For bodies that only contacts hold.
    Balance(f64),
    /// Bodies that move at the end are no more than so many.
    Moving(u32),
    /// Speed of the fastest body, all through [m/s].
    Speed(f64),
    /// Largest distance of a body from the origin, all through [m].
    Reach(f64),
    /// Speed of the fastest body at the end [m/s].
    Rest(f64),
    /// Redundant rows that are left unreported, of so many that the scene has for certain: none may be.
    Redundant(u32),
}

impl Limit {
    /// What the value must stay below, in [`Limit::unit`].
    pub fn bound(&self) -> f64 {
        match *self {
            Limit::Gap(bound)
            | Limit::Energy(bound)
            | Limit::Spin(bound)
            | Limit::Truth(bound)
            | Limit::Speed(bound)
            | Limit::Reach(bound)
            | Limit::Momentum(bound)
            | Limit::Overlap(bound)
            | Limit::Stay(bound)
            | Limit::Balance(bound)
            | Limit::Rest(bound) => bound,
            // No more than so many are fewer than one more.
            Limit::Moving(most) => f64::from(most) + 1.0,
            // A whole number below one is none.
            Limit::Redundant(_) => 1.0,
        }
    }

    /// "m", "m/s", or nothing for a part of something.
    pub fn unit(&self) -> &'static str {
        match self {
            Limit::Gap(_) | Limit::Reach(_) | Limit::Overlap(_) | Limit::Stay(_) => "m",
            Limit::Speed(_) | Limit::Rest(_) => "m/s",
            Limit::Energy(_)
            | Limit::Spin(_)
            | Limit::Truth(_)
            | Limit::Momentum(_)
            | Limit::Balance(_)
            | Limit::Moving(_)
            | Limit::Redundant(_) => "",
        }
    }

    /// What is measured, as a user reads it before "< 1 mm".
    pub fn name(&self) -> &'static str {
        match self {
            Limit::Gap(_) => "joint gap",
            Limit::Energy(_) => "energy drift",
            Limit::Spin(_) => "angular momentum drift",
            Limit::Truth(_) => "error against the truth",
            Limit::Momentum(_) => "momentum drift",
            Limit::Overlap(_) => "overlap",
            Limit::Stay(_) => "distance from the start",
            Limit::Balance(_) => "force not in balance at the end",
            Limit::Moving(_) => "moving bodies at the end",
            Limit::Speed(_) => "speed",
            Limit::Reach(_) => "reach",
            Limit::Rest(_) => "speed at the end",
            Limit::Redundant(_) => "redundant rows not reported",
        }
    }

    /// Whether only the value at the end counts.
    pub fn is_of_the_end(&self) -> bool {
        matches!(self, Limit::Rest(_) | Limit::Balance(_) | Limit::Moving(_))
    }
}
