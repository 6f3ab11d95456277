//! What was measured of one setting on one scene.

use super::setting::{Family, Setting};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;

/// One measurement: a line of JSON, a row of CSV, a mark in a diagram.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Point {
    /// Name of a shipped scene, or path of a scene file.
    pub scene: String,
    /// What the world was stepped with.
    pub method: Family,
    /// Steps a second [Hz].
    pub hz: f64,
    /// Knobs that the method does not have are empty, see [`Setting`].
    pub substeps: Option<u32>,
    /// Sweeps a substep; empty for methods that do not sweep.
    pub iterations: Option<u32>,
    /// Wanted accuracy, in parts of an island's size; empty for methods without one.
    pub tolerance: Option<f64>,
    /// CPU time per simulated second [µs/s].
    pub cpu_us_per_second: f64,
    /// RMS distance to the reference in parts of the scene's length, never below what the reference is known to; empty if the
    /// run diverged or there is no reference.
    pub error: Option<f64>,
    /// What the error was measured against, or why there is none.
    pub error_kind: ErrorKind,
    /// Worst violation of a rod, rope or pin at any sample [m].
    pub violation_max: f64,
    /// Largest change of the total energy at any sample, in parts of the scale of the energies. What drag, dampers, friction
    /// and impacts take counts too: compare it between methods, not with zero.
    pub energy_drift: f64,
}

impl Point {
    /// The method and its knobs, without what was measured.
    pub fn setting(&self) -> Setting {
        let Point { method: family, hz, substeps, iterations, tolerance, .. } = *self;
        Setting { family, hz, substeps, iterations, tolerance }
    }
}

/// What an error was measured against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ErrorKind {
    /// The converged motion stored in the program.
    Stored,
    /// A formula that the scene names.
    ClosedForm,
    /// A refined run that agrees with a coarser one to so much, in parts of the scene's length.
    Converged(f64),
    /// The run left the range of numbers in which it means anything.
    Diverged,
    /// There is no reference.
    None,
}

const CONVERGED: &str = "converged to ";

impl fmt::Display for ErrorKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ErrorKind::Stored => f.write_str("stored"),
            ErrorKind::ClosedForm => f.write_str("closed form"),
            ErrorKind::Converged(to) => write!(f, "{CONVERGED}{to:e}"),
            ErrorKind::Diverged => f.write_str("diverged"),
            ErrorKind::None => f.write_str("none"),
        }
    }
}

impl Serialize for ErrorKind {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for ErrorKind {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<ErrorKind, D::Error> {
        let text = String::deserialize(deserializer)?;
        let plain = [ErrorKind::Stored, ErrorKind::ClosedForm, ErrorKind::Diverged, ErrorKind::None];
        let converged = || text.strip_prefix(CONVERGED)?.parse().ok().map(ErrorKind::Converged);
        let found = plain.into_iter().find(|kind| kind.to_string() == text).or_else(converged);
        found.ok_or_else(|| D::Error::custom(format!("there is no kind of error {text:?}")))
    }
}
