//! What the engine refuses, and why.

use super::Id;

/// A request that would have put the world into a state that no step can read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EngineError {
    /// A number is NaN, infinite or outside the range in which double precision can work with it.
    #[error("{what} is {value}, but must be {expected}")]
    BadValue {
        /// The quantity in words, such as "spring damping".
        what: &'static str,
        /// What was handed in.
        value: f64,
        /// The range that is accepted, in words and with its unit.
        expected: &'static str,
    },
    /// A body that does not exist (any more).
    #[error("there is no body {0}: it was removed or never existed")]
    NoBody(Id),
    /// A constraint that does not exist (any more).
    #[error("there is no constraint {0}: it was removed or never existed")]
    NoConstraint(Id),
    /// A wall that does not exist (any more).
    #[error("there is no wall {0}: it was removed or never existed")]
    NoWall(Id),
    /// Both ends of a constraint are the same body, or both are fixed to the world.
    #[error("a constraint needs two different ends, at least one of them a body")]
    SameEnds,
}

/// The largest coordinate that a world accepts [m]: a million kilometres, where a double still resolves 0.1 µm.
pub const LARGEST_COORDINATE: f64 = 1e9;
/// The largest speed that a world accepts [m/s]; beyond it a run counts as diverged.
pub const LARGEST_SPEED: f64 = 1e8;
/// Masses are accepted from 1e-12 to 1e12 kg: their ratios and sums stay far from overflow and total absorption.
pub const MASS_RANGE: [f64; 2] = [1e-12, 1e12];

/// `Ok` if `value` is finite and within `[low, high]`.
pub(crate) fn check(
    what: &'static str,
    value: f64,
    [low, high]: [f64; 2],
    expected: &'static str,
) -> Result<(), EngineError> {
    if value >= low && value <= high { Ok(()) } else { Err(EngineError::BadValue { what, value, expected }) }
}

/// `Ok` if both coordinates are finite and within `±LARGEST_COORDINATE`.
pub(crate) fn check_point(what: &'static str, point: glam::DVec2) -> Result<(), EngineError> {
    let range = [-LARGEST_COORDINATE, LARGEST_COORDINATE];
    check(what, point.x, range, "between -1e9 and 1e9 m")?;
    check(what, point.y, range, "between -1e9 and 1e9 m")
}
