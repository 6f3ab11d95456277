//! The loop of a run: step, look, write.

use super::rows::Rows;
use super::watch::Watch;
use crate::engine::{Divergence, Method, StepReport, Stepper, World};
use std::sync::OnceLock;
use std::time::Instant;

/// How long to run and when to write [s].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sampling {
    pub seconds: f64,
    pub every: f64,
}

impl Sampling {
    /// The step nearest to sample `index`, at `hz` steps a second.
    fn step_of(&self, index: u64, hz: f64) -> u64 {
        (index as f64 * self.every * hz).round() as u64
    }
}

/// What a run ended with.
#[derive(Clone, Debug)]
pub(super) struct Finish {
    /// The last good state.
    pub world: World,
    pub steps: u64,
    /// Set if the run ended early.
    pub divergence: Option<Divergence>,
}

/// Steps `world` for `sampling.seconds` and writes rows on the way. Stops early, rows flushed by the caller, on divergence.
pub(super) fn run(
    mut world: World,
    method: Method,
    sampling: Sampling,
    rows: &mut Rows,
    watch: &mut Watch,
) -> anyhow::Result<Finish> {
    let mut stepper = Stepper::new(method)?.with_clock(nanoseconds);
    // There are no rows between steps, and a step may hold a billion samples.
    let sampling = Sampling { every: sampling.every.max(method.step_seconds()), ..sampling };
    let last = (sampling.seconds * method.hz).round() as u64;
    rows.headers()?;
    rows.write(&world, &watch.look(&world), Since::default())?;
    let mut sample = 1;
    let mut since_row = Sums::default();
    for step in 1..=last {
        let report = stepper.step(&mut world);
        if let Some(divergence) = report.divergence {
            return Ok(Finish { world, steps: step - 1, divergence: Some(divergence) });
        }
        since_row.add(&report);
        watch.step();
        let seen = watch.look(&world);
        if step >= sampling.step_of(sample, method.hz) {
            rows.write(&world, &seen, since_row.take())?;
            while sampling.step_of(sample, method.hz) <= step {
                sample += 1;
            }
        }
    }
    Ok(Finish { world, steps: last, divergence: None })
}

/// What the steps since the row before tell.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Since {
    /// Mean time of a step [µs].
    pub step_us: f64,
    /// Largest estimate of a step's local error, in parts of an island's size.
    pub local_error: f64,
}

#[derive(Default)]
struct Sums {
    step_us: f64,
    steps: f64,
    local_error: f64,
}

impl Sums {
    fn add(&mut self, report: &StepReport) {
        self.step_us += report.step_us;
        self.steps += 1.0;
        self.local_error = self.local_error.max(report.local_error);
    }

    fn take(&mut self) -> Since {
        let Sums { step_us, steps, local_error } = std::mem::take(self);
        Since { step_us: step_us / steps, local_error }
    }
}

/// Nanoseconds since the first call.
fn nanoseconds() -> u64 {
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed().as_nanos() as u64
}
