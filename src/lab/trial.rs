//! One setting on one scene: its motion, and what its steps cost.

use super::clock::thread_nanoseconds;
use crate::engine::{DVec2, EngineError, Integrator, Method, Stepper, World};
use crate::measure::{EnergyDrift, Measures};
use crate::truth::SAMPLES_PER_SECOND;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Why a trial ended early.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stop {
    Cancelled,
    TooSlow,
}

/// A run that was watched.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    /// Centres of all bodies at time 0 and at every sample after it [m].
    pub positions: Vec<Vec<DVec2>>,
    pub violation_max: f64,
    pub energy_drift: f64,
    /// Steps that went well.
    pub steps: u64,
    pub diverged: bool,
    /// What carried the largest island in the first step.
    pub carried_by: Option<Integrator>,
}

/// A stepper at work on a world.
pub(super) struct Trial<'a> {
    start: &'a World,
    stepper: Stepper,
    hz: f64,
    cancel: &'a AtomicBool,
}

impl<'a> Trial<'a> {
    pub fn new(start: &'a World, method: Method, cancel: &'a AtomicBool) -> Result<Trial<'a>, EngineError> {
        Ok(Trial { start, stepper: Stepper::new(method)?, hz: method.hz, cancel })
    }

    /// Runs for `seconds` and watches at every sample; stops if that takes longer than `limit` of the clock
    /// of costs. `tell` hears of every sample.
    pub fn motion(&mut self, seconds: f64, limit: Duration, mut tell: impl FnMut(f64)) -> Result<Motion, Stop> {
        let begun = thread_nanoseconds();
        let every = steps_between_samples(self.hz);
        let last = (seconds * self.hz).round() as u64;
        let mut world = self.start.clone();
        let mut drift = EnergyDrift::new(&Measures::of(&world));
        let mut change: f64 = 0.0;
        let mut motion = Motion {
            positions: vec![world.bodies().position.clone()],
            violation_max: 0.0,
            energy_drift: 0.0,
            steps: 0,
            diverged: false,
            carried_by: None,
        };
        for step in 1..=last {
            let report = self.stepper.step(&mut world);
            if report.divergence.is_some() {
                motion.diverged = true;
                break;
            }
            motion.steps = step;
            if step == 1 {
                motion.carried_by = report.integrator;
            }
            self.check_cancel()?;
            if step.is_multiple_of(every) {
                let measures = Measures::of(&world);
                motion.violation_max = motion.violation_max.max(measures.violation_max);
                change = change.max((drift.see(&measures) * drift.scale()).abs());
                motion.positions.push(world.bodies().position.clone());
                tell(step as f64 / last as f64);
            }
            if u128::from(thread_nanoseconds() - begun) > limit.as_nanos() && step < last {
                return Err(Stop::TooSlow);
            }
        }
        // By the scale of the whole run: at first hardly anything has moved.
        motion.energy_drift = if change > 0.0 { change / drift.scale() } else { 0.0 };
        Ok(motion)
    }

    /// CPU time of the first `steps` steps [ns], with a stepper that has done them before.
    pub fn time(&mut self, steps: u64) -> Result<u64, Stop> {
        let mut world = self.start.clone();
        let begun = thread_nanoseconds();
        for _ in 0..steps {
            std::hint::black_box(self.stepper.step(&mut world));
            self.check_cancel()?;
        }
        Ok(thread_nanoseconds() - begun)
    }

    fn check_cancel(&self) -> Result<(), Stop> {
        if self.cancel.load(Ordering::Relaxed) { Err(Stop::Cancelled) } else { Ok(()) }
    }
}

/// Steps at `hz` between two samples, 1 where a step is longer.
fn steps_between_samples(hz: f64) -> u64 {
    (hz / f64::from(SAMPLES_PER_SECOND)).round().max(1.0) as u64
}

/// Samples of a reference between two of a run at `hz`, 1 where it has them all.
pub(super) fn stride(hz: f64) -> usize {
    (f64::from(SAMPLES_PER_SECOND) / hz).round().max(1.0) as usize
}
