//! What the runs on a scene are compared with.

use super::point::ErrorKind;
use crate::engine::{DVec2, World};
use crate::measure::error_against;
use crate::scene::Setup;
use crate::truth::{SAMPLES_PER_SECOND, Trajectory};

/// Smallest error that is told, in parts of the length.
const ROUNDING: f64 = 1e-16;

/// A motion that is known well enough to compare others with, sampled [`SAMPLES_PER_SECOND`] times a second from 0 on.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// How the motion became known.
    pub source: Source,
    /// RMS distance from the true motion that it may have, in parts of `length`: the distance of the two finest runs.
    pub known_to: f64,
    /// By which distances are divided to make them relative [m].
    pub length: f64,
    /// A sample: the centres of all bodies, in the order of the world [m].
    pub positions: Vec<Vec<DVec2>>,
    /// Why the samples end before the time that was asked for, if they do.
    pub lost: Option<Lost>,
}

/// Where a reference comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The converged motion stored in the program.
    Stored,
    /// A formula that the scene names.
    ClosedForm,
    /// Runs of the engine's most accurate method that agree.
    Refined,
}

/// From when on two finest runs do not agree [s].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lost {
    /// Refining does not bring them closer.
    Chaotic(f64),
    /// Refining would bring them closer, but not within the time that was given.
    NotConverged(f64),
}

impl std::fmt::Display for Lost {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Lost::Chaotic(after) => write!(f, "no reference: chaotic after {after:.1} s"),
            Lost::NotConverged(after) => {
                write!(f, "no reference: not converged after {after:.1} s; give it more time to refine")
            }
        }
    }
}

impl Reference {
    /// The motion of a scene whose truth is stored in the program or has a formula; `None` if there is neither.
    pub fn known(setup: &Setup) -> Option<Reference> {
        let source = if setup.truth?.form.is_some() { Source::ClosedForm } else { Source::Stored };
        let Trajectory { positions, length, agreement, .. } = setup.known_motion()?;
        // Samples are doubles, whatever they were computed with.
        Some(Reference { source, known_to: agreement.max(ROUNDING), length, positions, lost: None })
    }

    /// Until when it is known [s].
    pub fn seconds(&self) -> f64 {
        self.positions.len().saturating_sub(1) as f64 / f64::from(SAMPLES_PER_SECOND)
    }

    /// Only its first `seconds`.
    pub fn until(mut self, seconds: f64) -> Reference {
        let samples = (seconds * f64::from(SAMPLES_PER_SECOND)).round() as usize + 1;
        self.positions.truncate(samples);
        self
    }

    /// RMS distance of `motion`, whose samples are those of every `stride`-th sample here, in parts of the length; never below
    /// what the reference is known to. `None` if the two cannot be compared.
    pub fn error(&self, motion: &[Vec<DVec2>], stride: usize) -> Option<f64> {
        let error = if stride == 1 {
            error_against(&self.positions, motion, self.length)
        } else {
            let samples: Vec<_> = self.positions.iter().step_by(stride).cloned().collect();
            error_against(&samples, motion, self.length)
        };
        error.map(|error| error.max(self.known_to))
    }

    /// What an error against it is called in a file.
    pub fn kind(&self) -> ErrorKind {
        match self.source {
            Source::Stored => ErrorKind::Stored,
            Source::ClosedForm => ErrorKind::ClosedForm,
            Source::Refined => ErrorKind::Converged(round_up(self.known_to)),
        }
    }

    /// What a user reads: "stored truth", "converged to 3e-12", "converged to 1e-6 until 2.1 s; no reference: chaotic after 2.1 s".
    pub fn label(&self) -> String {
        let known = match self.source {
            Source::Stored => return "stored truth".to_owned(),
            Source::ClosedForm => return "closed form".to_owned(),
            Source::Refined => self.kind(),
        };
        match self.lost {
            None => known.to_string(),
            Some(lost) => format!("{known} until {:.1} s; {lost}", self.seconds()),
        }
    }
}

/// The next number of one digit: 2.3e-9 becomes 3e-9. A bound may only grow when it is rounded.
fn round_up(value: f64) -> f64 {
    let exponent = libm::floor(libm::log10(value)) as i32;
    if !value.is_normal() || !(-300..=300).contains(&exponent) {
        return value;
    }
    // Within rounding of a digit counts as that digit; parsing gives the nearest number to what a user reads.
    let digit = (value / libm::pow(10.0, f64::from(exponent)) - 1e-9).ceil();
    format!("{digit}e{exponent}").parse().unwrap_or(value)
}

/// The length by which the distances of a world's runs are divided where its scene states none: the diagonal of the box round
/// the centres of all bodies and the fixed ends of constraints [m]; 1 m where that is a point.
pub fn scene_length(world: &World) -> f64 {
    let ends = (0..world.constraints().len()).map(|i| world.ends(i)).flat_map(|(a, b)| [a, b]);
    let points = world.bodies().position.iter().copied().chain(ends);
    let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let (low, high) = points.fold(empty, |(low, high), point| (low.min(point), high.max(point)));
    let length = (high - low).length();
    if length.is_finite() && length > 1e-6 { length } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_rounded_up_to_a_digit() {
        for (value, expected) in [(2.3e-9, 3e-9), (3e-9, 3e-9), (9.5e-12, 1e-11), (1e-5, 1e-5), (1.0, 1.0), (0.0, 0.0)]
        {
            assert_eq!(round_up(value), expected);
        }
    }

    #[test]
    fn the_length_of_a_scene_counts_fixed_ends_and_is_never_zero() {
        let pendulum = crate::scene::open("truth/pendulum").unwrap();
        assert_eq!(scene_length(&pendulum.world), 1.0);
        assert_eq!(scene_length(&World::new()), 1.0);
    }
}
