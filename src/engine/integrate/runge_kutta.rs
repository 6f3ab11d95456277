//! The classical Runge–Kutta method of order 4 (Kutta 1901) on the index-1 equations, the constraints solved for in every stage.
//!
//! Four factorisations a step, and a projection onto C = 0 and Ċ = 0 at its end. Not symplectic: it loses a little energy, with
//! the fifth power of h ω, and all of it where springs or tense light rods swing near h ω = 2.8, beyond which it is unstable;
//! the step is cut before.

use super::outcome::{Outcome, in_parts};
use crate::engine::island::System;

/// Largest turn of a rod and largest h ω in a step.
const TURN: f64 = 1.0;
const SWING: f64 = 2.0;

/// Weights of the stages and where they lie.
const STAGES: [(f64, f64); 4] = [(0.0, 1.0 / 6.0), (0.5, 1.0 / 3.0), (0.5, 1.0 / 3.0), (1.0, 1.0 / 6.0)];

/// Scratch memory, by node: two coordinates each.
#[derive(Debug, Default)]
pub(crate) struct RungeKutta {
    start: [Vec<f64>; 4],
    sum: [Vec<f64>; 4],
    ax: Vec<f64>,
    ay: Vec<f64>,
    load: Vec<f64>,
}

impl RungeKutta {
    /// Carries the island through `time` [s] in `steps` steps, or more where they would not be stable.
    pub fn advance(&mut self, system: &mut System, time: f64, steps: u32) -> Outcome {
        let nodes = system.nodes.len();
        let scratch = self.start.iter_mut().chain(&mut self.sum).chain([&mut self.ax, &mut self.ay]);
        scratch.for_each(|values| values.resize(nodes, 0.0));
        let mut outcome = Outcome { order: 4, ..Outcome::default() };
        outcome.failed = !system.meet_constraints();
        // The multipliers, for the rates.
        system.force_accelerations(&mut self.ax, &mut self.ay);
        system.constrain_accelerations(&mut self.ax, &mut self.ay);
        let rates = system.rates(&mut self.load);
        let stable = libm::ceil(time * (rates.turn / TURN).max(rates.swing / SWING));
        let steps = stable.max(f64::from(steps));
        outcome.failed |= !(steps <= super::MOST_STEPS);
        if outcome.failed {
            outcome.kept = false;
            return outcome;
        }
        for _ in 0..steps as u32 {
            if !in_parts(time / steps, &mut outcome, |h| self.step(system, h)) {
                outcome.failed = true;
                break;
            }
        }
        outcome.kept = !outcome.failed;
        outcome
    }

    /// One step of `h` seconds; changes nothing if the constraints cannot be met at its end.
    fn step(&mut self, system: &mut System, h: f64) -> bool {
        let nodes = &mut system.nodes;
        for (to, from) in self.start.iter_mut().zip([&nodes.x, &nodes.y, &nodes.vx, &nodes.vy]) {
            to.copy_from_slice(from);
        }
        self.sum.iter_mut().for_each(|sum| sum.fill(0.0));
        for (stage, (at, weight)) in STAGES.into_iter().enumerate() {
            if stage > 0 {
                self.go(system, at * h);
                system.factor_if_constrained();
            }
            system.force_accelerations(&mut self.ax, &mut self.ay);
            system.constrain_accelerations(&mut self.ax, &mut self.ay);
            let nodes = &system.nodes;
            for (sum, rate) in self.sum.iter_mut().zip([&nodes.vx, &nodes.vy, &self.ax, &self.ay]) {
                sum.iter_mut().zip(rate).for_each(|(sum, rate)| *sum += weight * rate);
            }
        }
        for (values, (start, sum)) in system.nodes.coordinates().into_iter().zip(self.start.iter().zip(&self.sum)) {
            values.iter_mut().zip(start.iter().zip(sum)).for_each(|(to, (from, rate))| *to = from + h * rate);
        }
        if system.meet_constraints() {
            return true;
        }
        for (values, start) in system.nodes.coordinates().into_iter().zip(&self.start) {
            values.copy_from_slice(start);
        }
        system.factor_if_constrained();
        false
    }

    /// From the start of the step by `t` seconds with the last stage's rates.
    fn go(&self, system: &mut System, t: f64) {
        let nodes = &mut system.nodes;
        let [x, y, vx, vy] = &self.start;
        // Positions first, with the velocities of the last stage.
        for (to, (from, rate)) in [(&mut nodes.x, (x, &nodes.vx)), (&mut nodes.y, (y, &nodes.vy))] {
            to.iter_mut().zip(from.iter().zip(rate)).for_each(|(to, (from, rate))| *to = from + t * rate);
        }
        for (to, (from, rate)) in [(&mut nodes.vx, (vx, &self.ax)), (&mut nodes.vy, (vy, &self.ay))] {
            to.iter_mut().zip(from.iter().zip(rate)).for_each(|(to, (from, rate))| *to = from + t * rate);
        }
    }
}
