//! The classical Runge–Kutta method of order 4 (Kutta 1901) on the index-1 equations, the constraints solved for in every stage.
//!
//! Four factorisations a step, and a projection onto C = 0 and Ċ = 0 at its end. Not symplectic: it loses a little energy, with
//! the fifth power of h ω, and all of it where springs or tense light rods swing near h ω = 2.8, beyond which it is unstable;
//! the step is cut before.
//!
//! The accelerations of the last stage, a₄, lie where three stages lead to, those of the next step's first, a₅, where all four do. Where
//! something swings with ω they differ by h³ ω⁴ v/12, and the step is wrong by h⁵ ω⁴ v/120: the error estimate is h² |a₅ − a₄|/10.

use super::outcome::{Outcome, in_parts};
use super::pace::{Pace, steps_next, steps_within};
use crate::engine::island::System;

/// Largest turn of a rod and largest h ω in a step.
pub(crate) const TURN: f64 = 1.0;
pub(crate) const SWING: f64 = 2.0;
/// Cosine of the largest turn of a spring in all the time for an accuracy: where one flies past its anchor the force
/// changes within a step, and no stage may see it. A damped spring of no length was 130 times as wrong as asked at
/// 1e-6 without this.
const SPRING_TURN: f64 = 0.9;
/// Most steps for an accuracy. What takes more is stiff, or asks for a higher order.
const MOST_WITHIN: f64 = 64.0;
/// Times that the number of steps is corrected.
const MOST_CHANGES: u32 = 3;
/// Most that an error counts as, in parts of what is allowed.
const MOST_EXCESS: f64 = 1e4;

/// The weight of the first stage, at the start of the step; weights of the others and where they lie.
const FIRST: f64 = 1.0 / 6.0;
const STAGES: [(f64, f64); 3] = [(0.5, 1.0 / 3.0), (0.5, 1.0 / 3.0), (1.0, 1.0 / 6.0)];

/// Scratch memory, by node: two coordinates each.
#[derive(Debug, Default)]
pub(crate) struct RungeKutta {
    /// x, v and a at the start of the time, and of the step.
    start: [Vec<f64>; 6],
    before: [Vec<f64>; 6],
    sum: [Vec<f64>; 4],
    /// Accelerations now, and of the last stage.
    ax: Vec<f64>,
    ay: Vec<f64>,
    last: [Vec<f64>; 2],
    load: Vec<f64>,
}

/// How a run of equal steps ended.
enum Run {
    /// With an estimate of the local errors' sum [m].
    Done(f64),
    /// So many steps will do.
    Again(f64),
    Failed,
}

impl RungeKutta {
    /// Carries the island through `time` [s], in more steps than the pace says where they would not be stable. Where it is a tolerance
    /// that takes too many steps, or more than `most`, the outcome says that an implicit method does better.
    pub fn advance(&mut self, system: &mut System, time: f64, pace: Pace, most: f64) -> Outcome {
        self.reserve(system.nodes.len());
        let mut outcome = Outcome { order: 4, ..Outcome::default() };
        let most = most.min(MOST_WITHIN);
        let met = system.meet_constraints();
        // The multipliers, for the rates.
        self.accelerate(system);
        let rates = system.rates(&mut self.load);
        let stable = libm::ceil(time * (rates.turn / TURN).max(rates.swing / SWING)).max(1.0);
        let mut steps = match pace {
            Pace::Steps(steps) => stable.max(f64::from(steps)),
            Pace::Within(_) if !(stable <= most) => return Outcome { stiff: true, kept: false, ..outcome },
            Pace::Within(_) => stable.max(f64::from(system.foresight.steps).min(most)),
        };
        if !(met && steps <= super::MOST_STEPS) {
            return Outcome { failed: true, kept: false, ..outcome };
        }
        keep(&mut self.start, system, &self.ax, &self.ay);
        for changes in 0.. {
            match self.run(system, (time, steps), pace, changes < MOST_CHANGES, &mut outcome) {
                Run::Done(error) => {
                    outcome.error = error;
                    outcome.kept = pace.keeps(error);
                    if let Pace::Within(tolerance) = pace {
                        outcome.next = steps_next(steps, error / tolerance, 4.0, 0.0);
                    }
                    return outcome;
                }
                Run::Again(more) if more <= most => steps = more,
                Run::Again(_) => return Outcome { stiff: true, kept: false, ..outcome },
                Run::Failed => break,
            }
            outcome.retries += std::mem::take(&mut outcome.steps);
            restore(&self.start, system, &mut self.ax, &mut self.ay);
        }
        Outcome { failed: true, kept: false, ..outcome }
    }

    fn reserve(&mut self, nodes: usize) {
        let kept = self.start.iter_mut().chain(&mut self.before);
        let stages = self.sum.iter_mut().chain(&mut self.last).chain([&mut self.ax, &mut self.ay]);
        kept.chain(stages).for_each(|values| values.resize(nodes, 0.0));
    }

    fn accelerate(&mut self, system: &mut System) {
        system.force_accelerations(&mut self.ax, &mut self.ay);
        system.constrain_accelerations(&mut self.ax, &mut self.ay);
    }

    /// So many equal steps. Ends early where the errors so far say that it takes more of them, if they may `change`.
    fn run(
        &mut self,
        system: &mut System,
        (time, steps): (f64, f64),
        pace: Pace,
        change: bool,
        outcome: &mut Outcome,
    ) -> Run {
        let mut sum = 0.0;
        for step in 0..steps as u32 {
            let took = |h: f64| {
                let went_well = self.step(system, h);
                if went_well {
                    sum += self.error(system, h);
                }
                went_well
            };
            if !in_parts(time / steps, outcome, took) {
                return Run::Failed;
            }
            let Pace::Within(tolerance) = pace else { continue };
            // The first step tells what the others will be like; they tell themselves whether they were.
            let expected = sum * steps / f64::from(step + 1);
            if change && !pace.keeps(if step == 0 { expected } else { sum }) {
                let more = steps_within(steps, (expected / tolerance).min(MOST_EXCESS), 4.0);
                return Run::Again(more.unwrap_or(steps + 1.0));
            }
        }
        let [x, y, ..] = &self.start;
        if matches!(pace, Pace::Within(_)) && system.springs.turn_beyond(&system.nodes, x, y, SPRING_TURN) {
            sum = system.length;
        }
        Run::Done(sum)
    }

    /// One step of `h` seconds; changes nothing if the constraints cannot be met at its end.
    fn step(&mut self, system: &mut System, h: f64) -> bool {
        keep(&mut self.before, system, &self.ax, &self.ay);
        for (sum, rate) in self.sum.iter_mut().zip(&self.before[2..]) {
            sum.iter_mut().zip(rate).for_each(|(sum, rate)| *sum = FIRST * rate);
        }
        for (at, weight) in STAGES {
            self.go(system, at * h);
            system.factor_if_constrained();
            self.accelerate(system);
            let nodes = &system.nodes;
            for (sum, rate) in self.sum.iter_mut().zip([&nodes.vx, &nodes.vy, &self.ax, &self.ay]) {
                sum.iter_mut().zip(rate).for_each(|(sum, rate)| *sum += weight * rate);
            }
        }
        for (to, from) in self.last.iter_mut().zip([&self.ax, &self.ay]) {
            to.copy_from_slice(from);
        }
        for (values, (start, sum)) in system.nodes.coordinates().into_iter().zip(self.before.iter().zip(&self.sum)) {
            values.iter_mut().zip(start.iter().zip(sum)).for_each(|(to, (from, rate))| *to = from + h * rate);
        }
        if system.meet_constraints() {
            self.accelerate(system);
            return true;
        }
        restore(&self.before, system, &mut self.ax, &mut self.ay);
        false
    }

    /// Estimate of the error of the step just taken, RMS over the nodes [m].
    fn error(&self, system: &System, h: f64) -> f64 {
        let square = |(a, b): (&Vec<f64>, &Vec<f64>)| a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
        let sum: f64 = [&self.ax, &self.ay].into_iter().zip(&self.last).map(square).sum();
        0.1 * h * h * (sum / system.nodes.len() as f64).sqrt()
    }

    /// From the start of the step by `t` seconds with the last stage's rates.
    fn go(&self, system: &mut System, t: f64) {
        let nodes = &mut system.nodes;
        let [x, y, vx, vy, ..] = &self.before;
        // Positions first, with the velocities of the last stage.
        for (to, (from, rate)) in [(&mut nodes.x, (x, &nodes.vx)), (&mut nodes.y, (y, &nodes.vy))] {
            to.iter_mut().zip(from.iter().zip(rate)).for_each(|(to, (from, rate))| *to = from + t * rate);
        }
        for (to, (from, rate)) in [(&mut nodes.vx, (vx, &self.ax)), (&mut nodes.vy, (vy, &self.ay))] {
            to.iter_mut().zip(from.iter().zip(rate)).for_each(|(to, (from, rate))| *to = from + t * rate);
        }
    }
}

fn keep(to: &mut [Vec<f64>; 6], system: &System, ax: &[f64], ay: &[f64]) {
    let nodes = &system.nodes;
    for (to, from) in to.iter_mut().zip([&nodes.x[..], &nodes.y, &nodes.vx, &nodes.vy, ax, ay]) {
        to.copy_from_slice(from);
    }
}

fn restore(from: &[Vec<f64>; 6], system: &mut System, ax: &mut [f64], ay: &mut [f64]) {
    let [x, y, vx, vy] = system.nodes.coordinates();
    for (to, from) in [x, y, vx, vy, ax, ay].into_iter().zip(from) {
        to.copy_from_slice(from);
    }
    system.factor_if_constrained();
}
