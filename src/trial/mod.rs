//! Trials: the pass of a scene, evaluated while it runs. The window's badges and the tests ask the same evaluator.

use crate::engine::{DVec2, StepReport, Touching, World};
use crate::measure::{EnergyDrift, ErrorSum, Measures};
use crate::scene::{Limit, Pass, Setup};
use crate::truth::Trajectory;
use std::sync::Arc;

/// How a trial stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum State {
    /// All limits are kept so far, and the time is not over.
    #[default]
    Running,
    /// All limits were kept until the time was over.
    Passed,
    /// A limit is broken, or the run diverged; it is measured on until the time is over.
    Failed,
    /// The scene was changed by hand, so that the run is no trial any more.
    Void,
}

impl State {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            State::Running => "not yet",
            State::Passed => "passed",
            State::Failed => "failed",
            State::Void => "changed by hand",
        }
    }
}

/// A limit and what its value has been so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// What must not be exceeded, and of what.
    pub limit: Limit,
    /// In [`Limit::unit`]; NaN where nothing can be compared yet.
    pub value: f64,
}

impl Line {
    /// Whether the limit is kept. What is not a number keeps none.
    pub fn is_kept(&self) -> bool {
        self.value < self.limit.bound()
    }
}

/// What a trial has come to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Verdict {
    /// Whether it passed, failed, or goes on.
    pub state: State,
    /// Simulated time so far [s].
    pub time: f64,
    /// Simulated time that the trial lasts [s].
    pub seconds: f64,
    /// A line a limit, in the order of the scene's pass.
    pub lines: Vec<Line>,
}

/// A run on trial.
#[derive(Clone, Debug)]
pub struct Trial {
    verdict: Arc<Verdict>,
    start: Measures,
    /// Where the bodies started [m].
    places: Vec<DVec2>,
    energy: EnergyDrift,
    /// Largest change of the total energy so far [J].
    drift: f64,
    truth: Option<Arc<Trajectory>>,
    distance: ErrorSum,
}

/// Slower bodies do not move [m/s].
const STILL: f64 = 1e-9;

/// A trial is over when a step ends less than this before its time [s].
const SAME_TIME: f64 = 1e-9;

impl Trial {
    /// The trial of a scene as it opens; `None` if it has no pass.
    pub fn of(setup: &Setup) -> Option<Trial> {
        let Pass { seconds, limits } = setup.pass.clone()?;
        let start = Measures::of(&setup.world);
        let needs_truth = limits.iter().any(|limit| matches!(limit, Limit::Truth(_)));
        let lines = limits.into_iter().map(|limit| Line { limit, value: 0.0 }).collect();
        let mut trial = Trial {
            verdict: Arc::new(Verdict { state: State::Running, time: setup.world.time(), seconds, lines }),
            energy: EnergyDrift::new(&start),
            start,
            places: setup.world.bodies().position.clone(),
            drift: 0.0,
            truth: needs_truth.then(|| setup.known_motion()).flatten().map(Arc::new),
            distance: ErrorSum::default(),
        };
        trial.compare(&setup.world);
        Some(trial)
    }

    /// What it has come to. Cheap to keep.
    pub fn verdict(&self) -> &Arc<Verdict> {
        &self.verdict
    }

    /// Takes note of a step. O(bodies).
    pub fn observe(&mut self, world: &World, measures: &Measures, report: &StepReport) {
        // A run that has failed goes on to be measured, until its time is over.
        let is_over = self.verdict.time >= self.verdict.seconds - SAME_TIME;
        if is_over || !matches!(self.verdict.state, State::Running | State::Failed) {
            return;
        }
        let drift = self.energy.see(measures);
        self.drift = greater(self.drift, drift.abs() * self.energy.scale());
        self.compare(world);
        let mut verdict = (*self.verdict).clone();
        verdict.time = world.time();
        for line in &mut verdict.lines {
            line.value = self.value(line, world, measures, report);
        }
        let over = verdict.time >= verdict.seconds - SAME_TIME;
        let kept = |line: &Line| line.is_kept() || (line.limit.is_of_the_end() && !over);
        verdict.state = match (verdict.lines.iter().all(kept), over) {
            (false, _) => State::Failed,
            (true, true) => State::Passed,
            (true, false) => State::Running,
        };
        self.verdict = Arc::new(verdict);
    }

    /// The run diverged.
    pub fn lost(&mut self) {
        if self.verdict.state == State::Running {
            Arc::make_mut(&mut self.verdict).state = State::Failed;
        }
    }

    /// The scene was changed by hand.
    pub fn void(&mut self) {
        if self.verdict.state == State::Running {
            Arc::make_mut(&mut self.verdict).state = State::Void;
        }
    }

    fn value(&self, line: &Line, world: &World, measures: &Measures, report: &StepReport) -> f64 {
        let fastest = || world.bodies().velocity.iter().fold(0.0, |most, v| greater(most, v.length()));
        match line.limit {
            Limit::Gap(_) => greater(line.value, measures.violation_max),
            Limit::Energy(_) => ratio(self.drift, self.energy.scale()),
            Limit::Spin(_) => {
                let change = (measures.angular_momentum - self.start.angular_momentum).abs();
                greater(line.value, ratio(change, self.start.angular_momentum.abs()))
            }
            Limit::Truth(_) => match &self.truth {
                Some(truth) => self.distance.rms() / truth.length,
                None => f64::NAN,
            },
            Limit::Momentum(_) => {
                let change = (measures.momentum - self.start.momentum).length();
                greater(line.value, ratio(change, self.start.momentum.length()))
            }
            Limit::Overlap(_) => greater(line.value, measures.penetration_max),
            Limit::Stay(_) => {
                let pairs = self.places.iter().zip(&world.bodies().position);
                let furthest = pairs.fold(0.0, |most, (start, now)| greater(most, start.distance(*now)));
                greater(line.value, furthest)
            }
            Limit::Balance(_) => out_of_balance(world),
            Limit::Moving(_) => {
                let speeds = world.bodies().velocity.iter().map(|velocity| velocity.length());
                // Not at rest is what is not below the limit, so that what is not a number counts too.
                speeds.filter(|speed| !(*speed < STILL)).count() as f64
            }
            Limit::Speed(_) => greater(line.value, fastest()),
            Limit::Reach(_) => {
                let furthest = world.bodies().position.iter().fold(0.0, |most, p| greater(most, p.length()));
                greater(line.value, furthest)
            }
            Limit::Rest(_) => fastest(),
            Limit::Redundant(least) => greater(line.value, f64::from(least) - report.redundant as f64),
        }
    }

    /// Adds a sample of the distance from the truth, where there is one at this time.
    fn compare(&mut self, world: &World) {
        let Some(truth) = &self.truth else { return };
        if let Some(sample) = truth.sample_at(world.time()) {
            self.distance.add(sample, &world.bodies().position);
        }
    }
}

/// Largest sum of weight and contact forces on a body, in parts of its weight.
fn out_of_balance(world: &World) -> f64 {
    let bodies = world.bodies();
    let mut force: Vec<DVec2> = bodies.mass.iter().map(|mass| *mass * world.gravity()).collect();
    for contact in world.contacts() {
        let push = contact.normal_force * contact.normal + contact.tangent_force * contact.normal.perp();
        force[contact.a as usize] += push;
        if let Touching::Body(other) = contact.b {
            force[other as usize] -= push;
        }
    }
    let dynamic = (0..bodies.len()).filter(|index| world.is_dynamic(*index));
    dynamic.fold(0.0, |most, i| greater(most, ratio(force[i].length(), bodies.mass[i] * world.gravity().length())))
}

/// The larger one; what is not a number is larger than anything.
fn greater(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// `part` of `whole`; nothing is no part of anything.
fn ratio(part: f64, whole: f64) -> f64 {
    if part == 0.0 { 0.0 } else { part / whole }
}

/// Runs a scene as it opens to the end of its trial; the verdict, or what a step said when it diverged.
pub fn run(setup: &Setup) -> Result<Option<Arc<Verdict>>, String> {
    let Some(mut trial) = Trial::of(setup) else { return Ok(None) };
    let mut world = setup.world.clone();
    let mut stepper = crate::engine::Stepper::new(setup.method).map_err(|error| error.to_string())?;
    while trial.verdict().state == State::Running {
        let report = stepper.step(&mut world);
        if let Some(divergence) = report.divergence {
            return Err(divergence.to_string());
        }
        trial.observe(&world, &Measures::of(&world), &report);
    }
    Ok(Some(trial.verdict().clone()))
}
