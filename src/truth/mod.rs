//! The truth: closed forms, and a reference solver that shares nothing with the engine's solvers but the data of a world.
//!
//! The reference integrates the index-1 equations of a scene of particles, rods and springs in double-double arithmetic
//! (106 bits) by extrapolation, so that what is left of the error is far below what a double can show. Converged
//! trajectories of the scenes under `scenes/truth/` are stored in the program: [`stored`]. A scene whose motion has a formula
//! names it ([`ClosedForm`]), and its trajectory comes from that.

pub mod closed_form;
mod double_double;
mod extrapolation;
mod factor;
mod form;
mod reference;
mod store;
mod system;

pub use double_double::DoubleDouble;
pub use form::{ClosedForm, Motion};
pub use reference::{Reference, SAMPLES_PER_SECOND, TOLERANCES, converge};
pub use store::{StoreError, from_bytes, stored, to_bytes};

use crate::engine::DVec2;

/// A motion, sampled.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    /// When the samples were taken, ascending from 0 [s].
    pub times: Vec<f64>,
    /// A sample: the centres of all bodies, in the order of the world [m].
    pub positions: Vec<Vec<DVec2>>,
    /// By which distances are divided to make them relative [m].
    pub length: f64,
    /// RMS distance of the two finest runs, divided by the length. Where it is below 1e-16 the rounding of the samples to
    /// doubles is what is left. 0 for a closed form, which rounding alone makes inexact.
    pub agreement: f64,
}

impl Trajectory {
    /// The sample at time `t` [s], if there is one within rounding; a truth says nothing in between.
    pub fn sample_at(&self, t: f64) -> Option<&[DVec2]> {
        let index = (t * f64::from(SAMPLES_PER_SECOND)).round();
        if !(index >= 0.0) {
            return None;
        }
        let known = *self.times.get(index as usize)?;
        // Some ulps: at 1 km/s that is 1e-12 m.
        ((t - known).abs() <= 1e-15 * (1.0 + known)).then(|| self.positions[index as usize].as_slice())
    }

    /// Where bodies are at time `t` [s] for a picture, straight from sample to sample: off by up to a/8 · (1/60 s)² with an
    /// acceleration a, 0.3 mm in free fall, and never to be measured against. `None` before the start and after the end.
    pub fn drawn_at(&self, t: f64) -> Option<Vec<DVec2>> {
        let place = t * f64::from(SAMPLES_PER_SECOND);
        let last = self.positions.len().checked_sub(1)?;
        if !(place >= 0.0 && place <= last as f64) {
            return None;
        }
        let first = place.floor();
        let [before, after] = [first as usize, (first as usize + 1).min(last)];
        let (before, after) = (&self.positions[before], &self.positions[after]);
        Some(before.iter().zip(after).map(|(a, b)| a.lerp(*b, place - first)).collect())
    }
}

/// Why there is no truth.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TruthError {
    /// The scene holds what the reference has no equations for.
    #[error("{what}: the reference solver knows particles, rods and springs that touch nothing")]
    Unfit {
        /// What the reference has no equations for, in words.
        what: String,
    },
    /// The scene is not what the closed form that it names is for.
    #[error("{what}: the closed form {form} is for {holds}")]
    Misfit {
        /// Name of the closed form.
        form: &'static str,
        /// What does not fit it, in words.
        what: String,
        /// What the closed form is for, in words.
        holds: &'static str,
    },
    /// No step is small enough, as at a collision of two masses or where rods contradict each other.
    #[error("at {time} s no step is small enough: the motion is singular there, or the rods contradict each other")]
    Stalled {
        /// Simulated time that was reached [s].
        time: f64,
    },
}
