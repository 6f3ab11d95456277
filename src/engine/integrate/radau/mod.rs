//! Radau's right-hand collocation of 3 and 5 stages ("Radau IIA") on the index-1 equations: for islands that are stiff, damped or heavily
//! loaded.
//!
//! Unknowns are the accelerations A_j and multipliers Λ_j of all stages, so that no order is lost at the constraints:
//!
//! ```text
//! M A_j + Σ ± Λ_j d_j = f(Q_j, V_j),   d_j·Δa_j + |w_j|² = 0,   x' = Q_s, v' = V_s
//! ```
//!
//! Newton's method takes the Jacobian of the middle stage; with the stage matrix diagonalised the stages fall apart into one real and
//! one or two complex systems, on the island's own graph ([`tree`], [`net`]), started with the accelerations at the end of the step
//! before. One projection onto C = 0 and Ċ = 0 ends the step.
//!
//! Orders 5 and 9 where all of the motion is resolved, stiffly accurate and L-stable: what is faster than the step is damped and does not
//! limit it, and makes errors fall as h^2.2 or so while its modes are excited. The size of the last Legendre coefficient of the
//! accelerations is the error estimate; steps are halved and doubled by it. Where the fewest steps allowed do not keep the tolerance the
//! outcome says so. Fails only where Newton's method does at the finest step.
//!
//! Hairer and Wanner, "Solving Ordinary Differential Equations II" (1996), sections IV.8 and VI.1.

mod forces;
mod net;
mod scheme;
mod stages;
mod tree;

use super::events::{Event, ROUNDING as LET_GO, first_change};
use super::outcome::Outcome;
use super::pace::Pace;
use crate::engine::island::{Stretching, System};
use glam::DVec2;
use net::Net;
use scheme::{RADAU_3, RADAU_5, Scheme};
use stages::{Stages, Values};
use tree::Tree;

/// Newton iterations of a step, in terms of which the most steps are understood; and how many steps it may take in any case: ten halvings
/// that fail.
const USUAL_ITERATIONS: f64 = 3.0;
const FEWEST: f64 = 32.0;
/// Most Newton iterations of a step.
const MOST_ITERATIONS: u32 = 25;
/// Newton's method ends where what is left is less than this part of the wanted error: energy drifts by what it leaves.
const TIGHT: f64 = 2e-3;
/// Convergence slower than this is worth a Jacobian at the stages found so far, once a step.
const SLOW: f64 = 0.05;
/// Corrections below this part of the island's size that do not shrink are rounding, and nothing below the second is corrected.
const STALLED: f64 = 1e-11;
const LEAST: f64 = 1e-15;
/// The same where steps are given by hand.
const BY_HAND: f64 = 1e-15;
/// The estimate of steps of a sixtieth over the error that they leave in a second or two of motion, by number of stages. Steps of another
/// length add up as independent errors do. Measured: 3 stages 1.1–3, 5 stages 5–11 on heavily loaded ropes, more where all is damped.
const CAUTION_3: f64 = 2.0;
const CAUTION_5: f64 = 10.0;
const USUAL: f64 = 1.0 / 60.0;
/// An estimate below this part of what is allowed lets the next step be twice as long.
const SMALL: f64 = 1.0 / 7.0;
/// Parts of the time at the start, where none are known.
const FIRST: f64 = 2.0;
/// C after a step, in parts of L², beyond which the step is taken back.
const FAR: f64 = 1e-3;
/// What is left of it, in parts of what the error may be, and where steps are given by hand.
const RETURNED: f64 = 1e-2;
const LEFT_OFF: f64 = 1e-9;
/// Parts of the time that Newton's method may need, whatever the accuracy.
const FINEST: f64 = 4096.0;

/// How many stages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Member {
    Three,
    Five,
}

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Task {
    /// Equal steps, or the wanted error.
    pub pace: Pace,
    pub member: Member,
    /// Parts of the time to begin with, if they are known.
    pub parts: Option<f64>,
    /// Most steps, of three iterations each, for the sake of the accuracy; with those that Newton's method needs twice as many.
    pub most: f64,
    /// So many cost what another method does with it.
    pub rival: f64,
}

/// Scratch memory for one island.
#[derive(Debug, Default)]
pub(crate) struct Radau {
    three: Option<Box<Steps<3, 2>>>,
    five: Option<Box<Steps<5, 3>>>,
}

impl Radau {
    /// Whether it takes an island: not yet what turns.
    pub fn takes(system: &System) -> bool {
        !system.turns()
    }

    /// Carries the island through `time` [s]; returns with the outcome in how many parts the next time should begin. For one island
    /// only: the first call takes its topology.
    pub fn advance(&mut self, system: &mut System, time: f64, task: &Task) -> (Outcome, f64) {
        match task.member {
            Member::Three => {
                let steps = self.three.get_or_insert_with(|| Box::new(Steps::new(&RADAU_3, system)));
                steps.advance(system, time, task, CAUTION_3)
            }
            Member::Five => {
                let steps = self.five.get_or_insert_with(|| Box::new(Steps::new(&RADAU_5, system)));
                steps.advance(system, time, task, CAUTION_5)
            }
        }
    }
}

#[derive(Debug)]
enum Solver<const S: usize, const L: usize> {
    Tree(Box<Tree<S, L>>),
    Net(Box<Net<S, L>>),
}

impl<const S: usize, const L: usize> Solver<S, L> {
    fn new(system: &System) -> Self {
        match Tree::new(system) {
            Some(tree) => Solver::Tree(Box::new(tree)),
            None => Solver::Net(Box::new(Net::new(system))),
        }
    }

    /// Takes the island's multipliers to begin with.
    fn begin(&mut self, system: &System) {
        match self {
            Solver::Tree(tree) => tree.begin(system),
            Solver::Net(net) => net.begin(system),
        }
    }

    /// Factors at the present stages; returns whether there is a factor.
    fn factor(&mut self, system: &System, stages: &Stages<S, L>) -> bool {
        match self {
            Solver::Tree(tree) => tree.factor(system, stages),
            Solver::Net(net) => net.factor(system, stages),
        }
    }

    /// One iteration of Newton's; returns how far the farthest node moves [m].
    fn iterate(&mut self, system: &System, stages: &mut Stages<S, L>) -> f64 {
        match self {
            Solver::Tree(tree) => {
                tree.residual(system, stages);
                tree.solve(system, stages)
            }
            Solver::Net(net) => {
                net.residual(system, stages);
                net.solve(system, stages)
            }
        }
    }

    /// Multipliers of a rod by stage.
    fn lambda(&self, rod: usize) -> &Values<S> {
        match self {
            Solver::Tree(tree) => tree.lambda(rod),
            Solver::Net(net) => net.lambda(rod),
        }
    }

    /// Writes the multipliers at the end of the step.
    fn store(&self, system: &mut System) {
        match self {
            Solver::Tree(tree) => tree.store(system),
            Solver::Net(net) => net.store(system),
        }
    }
}

/// Steps of one number of stages.
#[derive(Debug)]
struct Steps<const S: usize, const L: usize> {
    stages: Stages<S, L>,
    solver: Solver<S, L>,
    /// Accelerations at the start of the step, by node.
    ax: Vec<f64>,
    ay: Vec<f64>,
    /// Coordinates and multipliers at the start of the step.
    start: [Vec<f64>; 4],
    start_lambda: Vec<f64>,
    start_pins: Vec<DVec2>,
    /// Newton iterations of all steps.
    solves: u32,
}

impl<const S: usize, const L: usize> Steps<S, L> {
    fn new(scheme: &'static Scheme<S, L>, system: &System) -> Self {
        let n = system.nodes.len();
        Steps {
            stages: Stages::new(scheme),
            solver: Solver::new(system),
            ax: vec![0.0; n],
            ay: vec![0.0; n],
            start: std::array::from_fn(|_| Vec::new()),
            start_lambda: Vec::new(),
            start_pins: Vec::new(),
            solves: 0,
        }
    }

    fn advance(&mut self, system: &mut System, time: f64, task: &Task, caution: f64) -> (Outcome, f64) {
        let mut outcome = Outcome { order: self.stages.scheme.order, kept: true, ..Outcome::default() };
        self.solves = 0;
        let failed = |outcome: Outcome| (Outcome { failed: true, ..outcome }, FIRST);
        let tolerance = match task.pace {
            Pace::Steps(_) => f64::INFINITY,
            Pace::Within(tolerance) => tolerance,
        };
        let tight = match task.pace {
            Pace::Steps(_) => BY_HAND * system.length,
            Pace::Within(tolerance) => (TIGHT * tolerance).max(LEAST * system.length),
        };
        let returned = match task.pace {
            Pace::Steps(_) => LEFT_OFF,
            Pace::Within(tolerance) => RETURNED * tolerance / system.length,
        };
        let returned = returned.max(system.rounding_off());
        let mut h = match task.pace {
            Pace::Steps(steps) => time / f64::from(steps),
            Pace::Within(_) => time / task.parts.unwrap_or(FIRST).clamp(1.0, task.most.max(1.0)),
        };
        let longest = if tolerance == f64::INFINITY { h } else { time };
        let (mut left, mut events, mut squares, mut careful) = (time, 0, 0.0, false);
        let most_events = 64 + 8 * (system.rods.a.len() - system.rods.first_rope);
        if !system.meet_constraints() || !self.accelerate(system) {
            return failed(outcome);
        }
        while left > 1e-12 * time {
            let step = left / libm::ceil(left / h * (1.0 - 1e-9)).max(1.0);
            self.keep(system);
            let solved = self.solve(system, step, tight);
            let error = if solved { self.stages.estimate() / caution } else { f64::INFINITY };
            let excess = error * (USUAL / step).sqrt() / tolerance;
            // Smaller steps are worth their cost as long as there are not too many.
            let spent = f64::from(outcome.steps + outcome.retries).max(f64::from(self.solves) / USUAL_ITERATIONS);
            let finer = spent + 2.0 * left / step <= task.most;
            let refused = !solved || (!(excess <= 1.0) && finer);
            let ahead = if refused { 2.0 * left / step } else { 0.0 };
            if spent + ahead > task.rival {
                return (
                    Outcome { stiff: true, kept: false, solves: self.solves, ..outcome },
                    (time / step).min(FINEST),
                );
            }
            let event = if refused { None } else { self.first_event(system) };
            if event.is_some() && events >= most_events {
                return failed(outcome);
            }
            let part = event.map_or(1.0, |(at, _)| at);
            let cut = !refused && (part == 1.0 || self.solve(system, part * step, tight));
            if !(cut && self.finish(system, returned)) {
                self.restore(system);
                outcome.retries += 1;
                (h, careful) = (0.5 * step, true);
                if spent > 2.0 * task.most + FEWEST || !(h * FINEST >= time) {
                    return failed(outcome);
                }
                continue;
            }
            outcome.kept &= excess <= 1.0;
            outcome.steps += 1;
            squares += error * error;
            left -= part * step;
            h = if (excess < SMALL || !finer) && !careful { (2.0 * step).min(longest) } else { step };
            careful = false;
            self.stages.last_accelerations(&mut self.ax, &mut self.ay);
            if let Some((_, event)) = event {
                events += 1;
                event.apply(system);
                if !self.accelerate(system) {
                    return failed(outcome);
                }
            }
        }
        outcome.error = squares.sqrt();
        outcome.solves = self.solves;
        (outcome, (time / h).clamp(1.0, FINEST))
    }

    /// Accelerations and multipliers at the present instant; ropes that would push are let go, those that would stretch taken in.
    fn accelerate(&mut self, system: &mut System) -> bool {
        for left in (0..=system.most_changes()).rev() {
            system.force_accelerations(&mut self.ax, &mut self.ay);
            system.constrain_accelerations(&mut self.ax, &mut self.ay);
            let (lambda, ax, ay) = (std::mem::take(&mut system.rhs), &self.ax, &self.ay);
            let changed = left > 0 && system.choose_rope(&lambda, |system, r| stretching(system, r, ax, ay));
            system.rhs = lambda;
            if !changed {
                break;
            }
            system.factor();
        }
        self.ax.iter().chain(&self.ay).sum::<f64>().is_finite()
    }

    /// Solves a step of `h` seconds from the island's present state, which is left as it is.
    fn solve(&mut self, system: &System, h: f64, tight: f64) -> bool {
        self.stages.begin(system, (&self.ax, &self.ay), h);
        self.solver.begin(system);
        let factored = self.solver.factor(system, &self.stages);
        let (mut last, mut before, mut renewed) = (f64::INFINITY, f64::INFINITY, false);
        for iteration in 0..if factored { MOST_ITERATIONS } else { 0 } {
            let moved = self.solver.iterate(system, &mut self.stages);
            self.solves += 1;
            // Nothing is known of the convergence in the first iteration.
            let part = if iteration == 0 { 1.0 } else { moved / last };
            let next = if part < 1.0 { moved * part / (1.0 - part) } else { moved };
            if next < tight || (part > 0.5 && moved < STALLED * system.length) {
                return true;
            }
            // Corrections may shrink by turns; written so that a NaN fails.
            if !(moved < 0.8 * before && moved < 1e3 * system.length) {
                return false;
            }
            if iteration > 0 && part > SLOW && !renewed {
                renewed = true;
                self.solver.factor(system, &self.stages);
            }
            (before, last) = (last, moved);
        }
        false
    }

    /// Moves the island to the end of the solved step and projects it onto its constraints.
    fn finish(&mut self, system: &mut System, returned: f64) -> bool {
        self.stages.apply(system);
        self.solver.store(system);
        if system.unconstrained() {
            return system.nodes.x.iter().sum::<f64>().is_finite();
        }
        system.factor();
        let off = system.position_error();
        if !(off <= FAR && system.return_to_constraints(off, returned)) {
            return false;
        }
        system.project_velocities();
        true
    }

    fn keep(&mut self, system: &System) {
        let nodes = &system.nodes;
        for (to, from) in self.start.iter_mut().zip([&nodes.x, &nodes.y, &nodes.vx, &nodes.vy]) {
            to.clone_from(from);
        }
        self.start_lambda.clone_from(&system.rods.lambda);
        self.start_pins.clone_from(&system.pins.lambda);
    }

    fn restore(&self, system: &mut System) {
        for (to, from) in system.nodes.coordinates().into_iter().zip(&self.start) {
            to.copy_from_slice(from);
        }
        system.rods.lambda.copy_from_slice(&self.start_lambda);
        system.pins.lambda.copy_from_slice(&self.start_pins);
        system.take_differences();
    }

    /// The first rope that tightens or slackens in the solved step, and when, in parts of it.
    fn first_event(&self, system: &System) -> Option<(f64, Event)> {
        let (rods, nodes) = (&system.rods, &system.nodes);
        let mut first: Option<(f64, Event)> = None;
        for rope in rods.first_rope..rods.a.len() {
            let until = first.map_or(1.0, |(at, _)| at);
            let taut = rods.held[rope];
            let at = if taut {
                let lambda = Interpolation::new(&self.stages.scheme.nodes, self.solver.lambda(rope));
                first_change(|t| lambda.at(t), until)
            } else {
                let (a, b) = (rods.a[rope] as usize, rods.b[rope] as usize);
                let [d, w, _] = self.stages.between(a, b);
                let scheme = &self.stages.scheme.nodes;
                let x = Interpolation::from_start(scheme, &d[0], nodes.x[b] - nodes.x[a]);
                let y = Interpolation::from_start(scheme, &d[1], nodes.y[b] - nodes.y[a]);
                let vx = Interpolation::from_start(scheme, &w[0], nodes.vx[b] - nodes.vx[a]);
                let vy = Interpolation::from_start(scheme, &w[1], nodes.vy[b] - nodes.vy[a]);
                let square = (1.0 + LET_GO) * rods.square[rope];
                // One that was let go a little too long, and grows shorter, does not tighten.
                let tightens = |t: f64| {
                    let (x, y) = (x.at(t), y.at(t));
                    (x * x + y * y - square).min(x * vx.at(t) + y * vy.at(t))
                };
                first_change(tightens, until)
            };
            if let Some(at) = at {
                first = Some((at, Event::Rope { rope, taut: !taut }));
            }
        }
        first
    }
}

/// The polynomial through the stages, in Newton's form; the nodes are those of the scheme, after 0 if the start is one of them.
struct Interpolation<const S: usize> {
    nodes: [f64; S],
    differences: [f64; S],
    /// The value at the start, if the polynomial is start + t · (the rest).
    start: Option<f64>,
}

impl<const S: usize> Interpolation<S> {
    fn new(nodes: &[f64; S], values: &Values<S>) -> Self {
        let mut differences = *values;
        for order in 1..S {
            for k in (order..S).rev() {
                differences[k] = (differences[k] - differences[k - 1]) / (nodes[k] - nodes[k - order]);
            }
        }
        Interpolation { nodes: *nodes, differences, start: None }
    }

    fn from_start(nodes: &[f64; S], values: &Values<S>, start: f64) -> Self {
        let slopes = std::array::from_fn(|j| (values[j] - start) / nodes[j]);
        Interpolation { start: Some(start), ..Interpolation::new(nodes, &slopes) }
    }

    fn at(&self, t: f64) -> f64 {
        let mut sum = 0.0;
        for k in (0..S).rev() {
            sum = sum * (t - self.nodes[k]) + self.differences[k];
        }
        self.start.map_or(sum, |start| start + t * sum)
    }
}

/// How a rope's length changes with these accelerations.
fn stretching(system: &System, r: usize, ax: &[f64], ay: &[f64]) -> Stretching {
    let (a, b, nodes) = (system.rods.a[r] as usize, system.rods.b[r] as usize, &system.nodes);
    let between = |x: &[f64], y: &[f64]| [x[b] - x[a], y[b] - y[a]];
    Stretching::new([system.dx[r], system.dy[r]], between(&nodes.vx, &nodes.vy), between(ax, ay))
}
