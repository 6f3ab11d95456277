//! The implicit midpoint rule in the form that conserves energy and both momenta, one to three Newton iterations a step.
//!
//! x' = x + h (v + v')/2, M (v' − v)/h = f + Jᵀλ with every force along the mid difference d_m = (d + d')/2, so that
//! ½ (|d'|² − |d|²) = d_m·(d' − d): rods are met at the end of the step, C(x') = 0, and their forces do no work; a spring's
//! −k (ℓ' + ℓ − 2 rest)/(ℓ' + ℓ) d_m does exactly the work that its energy gives (Simo and Tarnow, "The discrete energy-momentum
//! method", ZAMP 43 (1992); Gonzalez, "Time integration and discrete Hamiltonian systems", J. Nonlinear Sci. 6 (1996)).
//! Dampers, drag and the mouse's hold act at mid velocity and position.
//!
//! Order 2. Nothing is damped, neither the motion nor what of a start does not fit the step; stiff parts do not limit the
//! step, fast turns do: a rod that would turn by more than some 70° makes the step halve. Linear cost for trees ([`tree`]),
//! a sparse factorisation for all else ([`graph`]).

mod discrete;
mod graph;
mod moment;
mod tree;
mod unresolved;

use super::outcome::{Outcome, in_parts};
use super::pace::{Pace, SMOOTH, SMOOTH_NET, carried_on, steps_next, steps_within};
use crate::engine::island::System;
use graph::Graph;
use moment::Moment;
use tree::Tree;
use unresolved::Unresolved;

/// Cosine of the largest turn of a rod in a step.
const TURN: f64 = 0.35;
/// Times that the number of steps is corrected.
const MOST_CHANGES: u32 = 3;
/// What counts of swings that are not resolved: unlike other errors they do not add up from step to step.
const UNRESOLVED: f64 = 0.2;
/// Most steps for an accuracy.
const MOST_WITHIN: f64 = 40.0;
/// Most Newton iterations of a step; and those that all steps may take in any case.
const MOST_ITERATIONS: u32 = 15;
const FEWEST: f64 = 100.0;
/// What the next correction would have to change to be worth making, in parts of a rod's length. Well above the rounding of a
/// long chain's solve, well below what energy shows: its error is the square of what is left.
const TIGHT: f64 = 1e-13;
/// The same where an accuracy is wanted, as a part of it.
const LOOSE: f64 = 1e-2;
/// Corrections below this that do not shrink are rounding.
const ROUNDING: f64 = 1e-9;
/// A start farther off C = 0 (in parts of L²) is projected: someone has moved a body.
const OFF: f64 = 1e-6;
/// Corrections are made down to this, whatever is wanted.
const FAR: f64 = 1e-7;

/// Scratch memory for one island.
#[derive(Debug, Default)]
pub(crate) struct EnergyMomentum {
    solver: Solver,
    /// The island at the start of the time, and of the step.
    start: Moment,
    before: Moment,
    /// By node: turns of the rods that end there.
    turn: Vec<f64>,
    unresolved: Unresolved,
    /// Newton iterations so far, and at most.
    solves: u32,
    most: f64,
}

#[derive(Debug, Default)]
enum Solver {
    #[default]
    None,
    Tree(Box<Tree>),
    Graph(Box<Graph>),
}

impl EnergyMomentum {
    /// Carries the island through `time` [s] in equal steps, some of them cut where they fail, in about `most` Newton
    /// iterations; fails where they do not do. No more than `dearest` steps are tried for an accuracy. For one island
    /// only: the first call takes its topology.
    pub fn advance(&mut self, system: &mut System, time: f64, pace: Pace, (most, dearest): (f64, f64)) -> Outcome {
        (self.solves, self.most) = (0, most.max(FEWEST));
        if matches!(self.solver, Solver::None) {
            self.solver = match Tree::new(system) {
                Some(tree) => Solver::Tree(Box::new(tree)),
                None => Solver::Graph(Box::new(Graph::new(system))),
            };
        }
        let (mut steps, tight) = match pace {
            Pace::Steps(steps) => (steps, TIGHT),
            Pace::Within(tolerance) => {
                let steps = system.foresight.steps.clamp(1, MOST_WITHIN as u32);
                (steps, (LOOSE * tolerance / system.length).clamp(TIGHT, FAR))
            }
        };
        let mut changes = 0;
        if !meet(system) {
            return Outcome { order: 2, failed: true, kept: false, ..Outcome::default() };
        }
        self.start.keep(system);
        self.unresolved.reserve(system);
        loop {
            let before = self.solves;
            let mut outcome = self.run(system, time, steps, (pace, tight));
            outcome.retries += changes;
            outcome.solves = self.solves - before;
            outcome.kept = !outcome.failed && pace.keeps(outcome.error);
            let Pace::Within(tolerance) = pace else { return outcome };
            outcome.next = steps_next(f64::from(steps), outcome.error / tolerance, 2.0, self.smooth());
            let more = steps_within(f64::from(steps), outcome.error / tolerance, 2.0);
            let Some(more) = more.filter(|_| !outcome.failed && changes < MOST_CHANGES) else { return outcome };
            if more > MOST_WITHIN.min(dearest) {
                // What flies about so fast is carried better by a method of higher order.
                return outcome;
            }
            (steps, changes) = (more as u32, changes + 1);
            self.start.restore(system);
        }
    }

    fn run(&mut self, system: &mut System, time: f64, steps: u32, (pace, tight): (Pace, f64)) -> Outcome {
        let mut outcome = Outcome { order: 2, ..Outcome::default() };
        let watched = matches!(pace, Pace::Within(_));
        let (mut error, mut first, mut last) = (0.0, true, 0.0);
        for _ in 0..steps {
            let step = |h: f64| {
                if watched && !first {
                    self.before.keep(system);
                }
                let solved = self.solve(system, h, tight);
                if solved {
                    self.apply(system, h);
                    let before = if first { &self.start } else { &self.before };
                    if watched {
                        error += before.error(system, h, &mut self.turn);
                        error += UNRESOLVED * self.unresolved.change(system, before, h, first);
                    }
                    (first, last) = (false, h);
                }
                solved
            };
            if !in_parts(time / f64::from(steps), &mut outcome, step) {
                outcome.failed = true;
                break;
            }
        }
        if watched && !outcome.failed && matches!(self.solver, Solver::Tree(_)) {
            // A net's matrix costs too much for this.
            let before = if outcome.steps == 1 { &self.start } else { &self.before };
            error += UNRESOLVED * self.unresolved.error(system, before, last);
        }
        outcome.error = carried_on(f64::from(steps), self.smooth()) * error;
        outcome
    }

    fn smooth(&self) -> f64 {
        if matches!(self.solver, Solver::Graph(_)) { SMOOTH_NET } else { SMOOTH }
    }

    fn solve(&mut self, system: &System, h: f64, tight: f64) -> bool {
        if f64::from(self.solves) > self.most {
            return false;
        }
        let (solved, iterations) = match &mut self.solver {
            Solver::None => (false, 0),
            Solver::Tree(tree) => tree.solve(system, h, tight),
            Solver::Graph(graph) => graph.solve(system, h, tight),
        };
        self.solves += iterations;
        solved
    }

    fn apply(&self, system: &mut System, h: f64) {
        match &self.solver {
            Solver::None => {}
            Solver::Tree(tree) => tree.apply(system),
            Solver::Graph(graph) => graph.apply(system),
        }
        // Led bodies.
        let nodes = &mut system.nodes;
        for i in (0..nodes.len()).filter(|i| nodes.w[*i] == 0.0) {
            nodes.x[i] += h * nodes.vx[i];
            nodes.y[i] += h * nodes.vy[i];
        }
    }
}

/// Projects what an edit has left off the constraints. Returns whether there is a position that meets them.
fn meet(system: &mut System) -> bool {
    if system.unconstrained() {
        return true;
    }
    system.take_differences();
    system.position_error() <= OFF || system.meet_constraints()
}

/// How the iterations go.
#[derive(Clone, Copy, Debug, Default)]
struct Progress {
    /// Corrections below this need not be made.
    tight: f64,
    iterations: u32,
    last: f64,
    converged: bool,
    failed: bool,
}

impl Progress {
    fn goes_on(&self) -> bool {
        !self.converged && !self.failed
    }

    /// Takes note of a correction where the next one is of the order of its square.
    fn quadratic(&mut self, moved: f64) {
        let part = if self.iterations == 0 { 1.0 } else { (moved / (self.last * self.last)).min(1.0) };
        self.note(moved, part * moved * moved);
    }

    /// Takes note of a correction where each is a part of the one before; returns that part.
    fn linear(&mut self, moved: f64) -> f64 {
        let part = if self.iterations == 0 { 0.0 } else { moved / self.last };
        let next = if self.iterations == 0 { moved } else { part * moved };
        self.note(moved, next);
        part
    }

    fn note(&mut self, moved: f64, next: f64) {
        let stalls = self.iterations > 0 && moved > 0.5 * self.last && moved < ROUNDING;
        self.iterations += 1;
        self.converged = next < self.tight || stalls;
        self.failed = !self.converged && (!(moved < 1e3) || self.iterations == MOST_ITERATIONS);
        self.last = moved;
    }
}
