//! Measures setting after setting on one scene; can be stopped and resumed.

use super::candidates::candidates;
use super::point::{ErrorKind, Point};
use super::reference::Reference;
use super::setting::{Family, Setting};
use super::trial::{Motion, Stop, Trial, stride};
use crate::engine::{EngineError, Method, World};
use crate::truth::SAMPLES_PER_SECOND;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// What a sweep tries, and how much time it may take.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepOptions {
    /// Which methods are tried.
    pub families: Vec<Family>,
    /// Steps a second at which everything is tried [Hz], see [`rate_fits`]; empty for 60 Hz and a few settings at 30 and 240 Hz.
    pub rates: Vec<f64>,
    /// The longest run of a setting: what takes longer is skipped, and so is what costs more in its family.
    pub run_limit: Duration,
    /// The whole sweep ends when this is spent.
    pub budget: Duration,
    /// Timed runs of a setting at least; more where a run is short.
    pub runs: usize,
}

impl Default for SweepOptions {
    fn default() -> Self {
        SweepOptions {
            families: Family::ALL.to_vec(),
            rates: Vec::new(),
            run_limit: Duration::from_millis(300),
            budget: Duration::from_secs(15),
            runs: 5,
        }
    }
}

/// Timed runs of a short motion go on until they have taken so long together [ns], or are so many.
const ENOUGH: u64 = 40_000_000;
const MOST_RUNS: usize = 51;

/// Whether the steps of a rate and the samples of a reference meet: multiples of 60 Hz up to 100,000, and 30, 20, 15, 12, … 1.
pub fn rate_fits(hz: f64) -> bool {
    let samples = f64::from(SAMPLES_PER_SECOND);
    let whole = |ratio: f64| ratio >= 1.0 && ratio.fract() == 0.0;
    (1.0..=1e5).contains(&hz) && (whole(hz / samples) || whole(samples / hz))
}

/// What came of the next setting.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It was measured.
    Point(Point),
    /// It was not measured, or what was measured is of no use.
    Skipped(Setting, Skip),
    /// Nothing was recorded; the next call tries the same setting again.
    Cancelled,
    /// Nothing is left to try, or the budget is spent.
    Finished,
}

/// Why a setting has no point.
#[derive(Clone, Debug, PartialEq)]
pub enum Skip {
    /// It carries nothing here: what can touch, turn or slacken goes another way.
    NotTaken,
    /// Its knob changes nothing: the motion is that of a setting before.
    Same,
    /// It takes longer than a run may, or costs more than one of its family that did.
    TooSlow,
    /// The engine does not take the method.
    Refused(EngineError),
}

/// How much is done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Settings tried or skipped.
    pub done: usize,
    /// Settings of the whole sweep.
    pub total: usize,
    /// Estimate of what the rest takes [s].
    pub seconds_left: f64,
}

/// A sweep over the settings of one scene.
#[derive(Clone, Debug)]
pub struct Sweep {
    scene: String,
    world: World,
    method: Method,
    seconds: f64,
    reference: Option<Arc<Reference>>,
    options: SweepOptions,
    candidates: Vec<Setting>,
    next: usize,
    points: Vec<Point>,
    too_slow: Vec<Setting>,
    spent: Duration,
    /// Seconds that a unit of work took, by family.
    pace: [Option<f64>; Family::ALL.len()],
}

impl Sweep {
    /// A sweep on `world`, whose own method is `method`, over `seconds` or as long as the reference is known. Without a
    /// reference there are costs, violations and energies, but no errors.
    pub fn new(
        scene: &str,
        world: &World,
        method: Method,
        seconds: f64,
        reference: Option<Arc<Reference>>,
        options: SweepOptions,
    ) -> Sweep {
        let seconds = reference.as_ref().map_or(seconds, |reference| seconds.min(reference.seconds()));
        Sweep {
            scene: scene.to_owned(),
            world: world.clone(),
            method,
            // At least a sample; whole ones.
            seconds: (seconds * f64::from(SAMPLES_PER_SECOND)).round().max(1.0) / f64::from(SAMPLES_PER_SECOND),
            reference,
            candidates: candidates(&options.families, &options.rates),
            options,
            next: 0,
            points: Vec::new(),
            too_slow: Vec::new(),
            spent: Duration::ZERO,
            pace: [None; Family::ALL.len()],
        }
    }

    /// Takes over what was measured before; it is not measured again.
    pub fn resume(&mut self, points: impl IntoIterator<Item = Point>) {
        self.points.extend(points.into_iter().filter(|point| point.scene == self.scene));
    }

    /// Everything measured so far, what was taken over first.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// What errors are measured against; `None` if nothing is known of the motion.
    pub fn reference(&self) -> Option<&Reference> {
        self.reference.as_deref()
    }

    /// How much is done, and an estimate of the rest.
    pub fn progress(&self) -> Progress {
        let rest = self.candidates.iter().skip(self.next).filter(|setting| !self.is_known(setting));
        let most = self.options.run_limit.as_secs_f64() * (self.options.runs + 1) as f64;
        let guess = self.pace.iter().flatten().copied().fold(0.0, f64::max);
        let of = |setting: &Setting| (self.pace[setting.family.index()].unwrap_or(guess) * setting.work()).min(most);
        let left = self.options.budget.saturating_sub(self.spent).as_secs_f64();
        Progress { done: self.next, total: self.candidates.len(), seconds_left: rest.map(of).sum::<f64>().min(left) }
    }

    /// Measures the next setting. Looks at `cancel` after every step of the world.
    pub fn advance(&mut self, cancel: &AtomicBool) -> Outcome {
        let begun = Instant::now();
        while self.candidates.get(self.next).is_some_and(|setting| self.is_known(setting)) {
            self.next += 1;
        }
        let Some(setting) = self.candidates.get(self.next).copied() else { return Outcome::Finished };
        if self.spent >= self.options.budget {
            self.next = self.candidates.len();
            return Outcome::Finished;
        }
        let outcome = self.try_setting(setting, cancel);
        let took = begun.elapsed();
        self.spent += took;
        match &outcome {
            Outcome::Cancelled => return outcome,
            Outcome::Point(point) => {
                self.points.push(point.clone());
                self.pace[setting.family.index()] = Some(took.as_secs_f64() / setting.work());
            }
            Outcome::Skipped(_, Skip::TooSlow) => self.too_slow.push(setting),
            _ => {}
        }
        self.next += 1;
        outcome
    }

    fn is_known(&self, setting: &Setting) -> bool {
        self.points.iter().any(|point| point.setting() == *setting)
    }

    fn try_setting(&self, setting: Setting, cancel: &AtomicBool) -> Outcome {
        let slower = |slow: &Setting| slow.family == setting.family && slow.work() <= setting.work();
        if self.too_slow.iter().any(slower) {
            return Outcome::Skipped(setting, Skip::TooSlow);
        }
        let mut trial = match Trial::new(&self.world, setting.method(self.method), cancel) {
            Ok(trial) => trial,
            Err(error) => return Outcome::Skipped(setting, Skip::Refused(error)),
        };
        match self.measure(setting, &mut trial) {
            Ok(outcome) => outcome,
            Err(Stop::TooSlow) => Outcome::Skipped(setting, Skip::TooSlow),
            Err(Stop::Cancelled) => Outcome::Cancelled,
        }
    }

    fn measure(&self, setting: Setting, trial: &mut Trial) -> Result<Outcome, Stop> {
        // Samples of a rate below 60 Hz end with its last whole step.
        let seconds = (self.seconds * setting.hz + 1e-9).floor().max(1.0) / setting.hz;
        let motion = trial.motion(seconds, self.options.run_limit, |_| {})?;
        if matches!(setting.family, Family::Direct(asked) if motion.carried_by != Some(asked)) {
            return Ok(Outcome::Skipped(setting, Skip::NotTaken));
        }
        let (error, error_kind) = self.error(&motion, setting);
        let (violation_max, energy_drift) = (motion.violation_max, motion.energy_drift);
        let mut point = Point {
            scene: self.scene.clone(),
            method: setting.family,
            hz: setting.hz,
            substeps: setting.substeps,
            iterations: setting.iterations,
            tolerance: setting.tolerance,
            cpu_us_per_second: 0.0,
            error,
            error_kind,
            violation_max,
            energy_drift,
        };
        let same = |other: &Point| {
            let figures = |point: &Point| (point.error, point.violation_max, point.energy_drift);
            other.method == point.method && other.hz == point.hz && figures(other) == figures(&point)
        };
        if self.points.iter().any(same) {
            return Ok(Outcome::Skipped(setting, Skip::Same));
        }
        // A run that diverges at once costs what its first step does.
        let steps = motion.steps.max(1);
        point.cpu_us_per_second = self.median_of_runs(trial, steps)? / 1e3 / (steps as f64 / setting.hz);
        Ok(Outcome::Point(point))
    }

    /// RMS distance to the reference, and what it was measured against.
    fn error(&self, motion: &Motion, setting: Setting) -> (Option<f64>, ErrorKind) {
        if motion.diverged {
            return (None, ErrorKind::Diverged);
        }
        let Some(reference) = &self.reference else { return (None, ErrorKind::None) };
        let stride = stride(setting.hz);
        let samples = (motion.positions.len() - 1) * stride + 1;
        let error = if samples == reference.positions.len() {
            reference.error(&motion.positions, stride)
        } else {
            let shorter = Reference::clone(reference).until((samples - 1) as f64 / f64::from(SAMPLES_PER_SECOND));
            shorter.error(&motion.positions, stride)
        };
        match error.filter(|error| error.is_finite()) {
            Some(error) => (Some(error), reference.kind()),
            None => (None, ErrorKind::None),
        }
    }

    /// Median time of the runs [ns].
    fn median_of_runs(&self, trial: &mut Trial, steps: u64) -> Result<f64, Stop> {
        let mut times = Vec::with_capacity(MOST_RUNS);
        while times.len() < self.options.runs || times.iter().sum::<u64>() < ENOUGH && times.len() < MOST_RUNS {
            times.push(trial.time(steps)?);
        }
        times.sort_unstable();
        let middle = times.len() / 2;
        Ok(if times.len() % 2 == 1 { times[middle] as f64 } else { 0.5 * (times[middle - 1] + times[middle]) as f64 })
    }
}
