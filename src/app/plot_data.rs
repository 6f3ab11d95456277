//! What the plots show: the measures and stage times of every step of the last 20 s, frames published or not.

use crate::engine::StepReport;
use crate::measure::Measures;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// How far back the plots reach [s of simulated time].
pub const PLOT_SECONDS: f64 = 20.0;
/// At most this many steps are kept, so that 100,000 steps a second fill 4 MB and not 400.
const MOST_SAMPLES: usize = 24_000;

/// One step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The world's measures after the step; `measures.time` is the sample's time [s].
    pub measures: Measures,
    /// Time that each stage took [µs], in the order of `Stage::ALL`.
    pub stage_us: [f64; 6],
    /// Time of the whole step [µs].
    pub step_us: f64,
    /// Estimate of the step's local error, in parts of an island's size; 0 where nothing estimates it.
    pub local_error: f64,
    /// By accuracy: it was not kept everywhere, as [`StepReport::fell_short`] says. The status bar and the plot ask
    /// here; the panel says why.
    pub fell_short: bool,
}

impl Sample {
    /// What a step left behind.
    pub fn new(measures: Measures, report: &StepReport, automatic: bool) -> Sample {
        Sample {
            measures,
            stage_us: report.stage_us,
            step_us: report.step_us,
            local_error: report.local_error,
            fell_short: automatic && report.fell_short(),
        }
    }
}

/// A ring of samples that the simulation thread writes and the window reads. Clones share it.
#[derive(Clone, Debug, Default)]
pub struct Plots(Arc<Mutex<VecDeque<Sample>>>);

impl Plots {
    /// The samples, oldest first, times ascending. The simulation waits while the guard lives: read and let go.
    pub fn read(&self) -> MutexGuard<'_, VecDeque<Sample>> {
        // A poisoned ring still holds whole samples: they are `Copy` and pushed in one piece.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Appends a sample and forgets those that are too old.
    pub fn push(&self, sample: Sample) {
        let mut samples = self.read();
        let oldest = sample.measures.time - PLOT_SECONDS;
        while samples.len() >= MOST_SAMPLES || samples.front().is_some_and(|first| first.measures.time < oldest) {
            samples.pop_front();
        }
        samples.push_back(sample);
    }

    /// Forgets what lies after `time` [s]: the world went back.
    pub fn rewind(&self, time: f64) {
        self.read().retain(|sample| sample.measures.time <= time);
    }

    /// Forgets everything.
    pub fn clear(&self) {
        self.read().clear();
    }
}
