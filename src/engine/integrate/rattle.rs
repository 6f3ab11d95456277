//! RATTLE: velocity Verlet with the positions brought back onto C = 0 and the velocities onto Ċ = 0 in every step.
//!
//! ```text
//! v½ = v + ½ h a(x),   x' = x + h v½ + M⁻¹ J(x)ᵀ μ,   C(x') = 0,   v' = (x' − x)/h + ½ h a(x') + M⁻¹ J(x')ᵀ ν,   J(x') v' = 0
//! ```
//!
//! Andersen, J. Comput. Phys. 52, 24 (1983); μ by quasi-Newton iterations with the one factor of A(x) that the step before left
//! behind (SHAKE's iteration, solved for all rows at once), started from the multipliers at x. Order 2, symplectic without
//! dampers and drag: the energy stays bounded. One factorisation and some five solves a step.
//!
//! Fails where a rod turns by more than half a radian or so in a step, or where springs and tense light rods swing faster than
//! h ω = 2: the step is cut before, and halved where the iterations do not converge.

use super::outcome::{Outcome, in_parts};
use super::pace::{Pace, steps_within};
use crate::engine::island::System;

/// Largest turn of a rod and largest h ω in a step.
const TURN: f64 = 0.7;
const SWING: f64 = 1.8;
/// Steps beyond which an implicit method is cheaper: with constraints, and where there is nothing to factor.
const MOST_CONSTRAINED: f64 = 8.0;
const MOST_FREE: f64 = 40.0;
const MOST_ITERATIONS: u32 = 25;
/// C = 0 is met to this part of L².
const TIGHT: f64 = 1e-14;
/// Corrections below this that do not shrink are rounding.
const ROUNDING: f64 = 1e-10;
/// Part of the wanted local error to which constraints are met where only that much is asked for.
const LOOSE: f64 = 3e-2;
/// Times that the number of steps is corrected.
const MOST_CHANGES: u32 = 4;

/// Scratch memory, by node unless said.
#[derive(Debug, Default)]
pub(crate) struct Rattle {
    /// Accelerations by the forces at the start of a step.
    ax: Vec<f64>,
    ay: Vec<f64>,
    /// How far the nodes move in a step.
    ux: Vec<f64>,
    uy: Vec<f64>,
    load: Vec<f64>,
    start: Start,
    /// By row: what a step's constraints do beyond the multipliers of its start.
    moved: Vec<f64>,
    /// Multipliers of the rods at the start of the last step, and its length [s]; none after a change.
    before: Vec<f64>,
    last: f64,
    /// C is met to this part of L².
    tight: f64,
    /// RMS of the local error of the last step [m].
    error: f64,
}

/// An island as it was at the start.
#[derive(Debug, Default)]
struct Start {
    x: Vec<f64>,
    y: Vec<f64>,
    vx: Vec<f64>,
    vy: Vec<f64>,
    rods: Vec<f64>,
    ax: Vec<f64>,
    ay: Vec<f64>,
}

impl Rattle {
    /// Carries the island through `time` [s]. Where the pace is a tolerance and the island needs so many steps to be stable that
    /// an implicit method does better, nothing is done and the outcome says so.
    pub fn advance(&mut self, system: &mut System, time: f64, pace: Pace) -> Outcome {
        let mut outcome = Outcome { order: 2, ..Outcome::default() };
        if !self.begin(system, pace) {
            outcome.failed = true;
            return outcome;
        }
        let rates = system.rates(&mut self.load);
        let stable = libm::ceil(time * (rates.turn / TURN).max(rates.swing / SWING)).max(1.0);
        let most = if system.unconstrained() { MOST_FREE } else { MOST_CONSTRAINED };
        let mut steps = match pace {
            Pace::Steps(steps) => stable.max(f64::from(steps)),
            Pace::Within(_) if !(stable <= most) => return Outcome { stiff: true, ..outcome },
            Pace::Within(_) => stable,
        };
        if !(steps <= super::MOST_STEPS) {
            outcome.failed = true;
            return outcome;
        }
        self.start.keep(system, &self.ax, &self.ay);
        for change in 0..=MOST_CHANGES {
            let mut probed = false;
            let mut more = None;
            for _ in 0..steps as u32 {
                if !in_parts(time / steps, &mut outcome, |h| self.step(system, h)) {
                    outcome.failed = true;
                    return outcome;
                }
                outcome.error += self.error;
                if let (Pace::Within(tolerance), false, true) = (pace, probed, change < MOST_CHANGES) {
                    probed = true;
                    more = steps_within(steps, steps * self.error / tolerance, 2.0);
                    if more.is_some() {
                        break;
                    }
                }
            }
            let Some(more) = more.map(|more| more.min(super::MOST_STEPS)) else { return outcome };
            steps = more;
            outcome = Outcome { order: 2, retries: outcome.retries + 1, ..Outcome::default() };
            self.start.restore(system, &mut self.ax, &mut self.ay);
            self.last = 0.0;
        }
        outcome
    }

    /// Makes room, meets the constraints, and finds accelerations and multipliers.
    fn begin(&mut self, system: &mut System, pace: Pace) -> bool {
        let nodes = system.nodes.len();
        for scratch in [&mut self.ax, &mut self.ay, &mut self.ux, &mut self.uy] {
            scratch.resize(nodes, 0.0);
        }
        self.moved.resize(system.rhs.len(), 0.0);
        self.before.resize(system.rods.a.len(), 0.0);
        self.last = 0.0;
        self.tight = match pace {
            Pace::Steps(_) => TIGHT,
            Pace::Within(tolerance) => (LOOSE * tolerance / system.length).max(TIGHT),
        };
        if !system.meet_constraints() {
            return false;
        }
        system.force_accelerations(&mut self.ax, &mut self.ay);
        // Only the multipliers are wanted; u is scratch.
        self.ux.clone_from(&self.ax);
        self.uy.clone_from(&self.ay);
        system.constrain_accelerations(&mut self.ux, &mut self.uy);
        true
    }

    /// One step of `h` seconds; changes nothing if the constraints cannot be met.
    fn step(&mut self, system: &mut System, h: f64) -> bool {
        let half = 0.5 * h;
        let nodes = &system.nodes;
        for ((u, v), a) in self.ux.iter_mut().zip(&nodes.vx).zip(&self.ax) {
            *u = h * (v + half * a);
        }
        for ((u, v), a) in self.uy.iter_mut().zip(&nodes.vy).zip(&self.ay) {
            *u = h * (v + half * a);
        }
        self.error = 0.0;
        if !system.unconstrained() && !self.meet(system, h) {
            return false;
        }
        let damped = system.damped();
        let nodes = &mut system.nodes;
        let over = 1.0 / h;
        // The velocity at half the step; what forces see of it is carried on to the end of the step.
        for (v, u) in [(&mut nodes.vx, &mut self.ux), (&mut nodes.vy, &mut self.uy)] {
            for (v, u) in v.iter_mut().zip(u) {
                let middle = over * *u;
                (*v, *u) = (if damped { 2.0 * middle - *v } else { middle }, middle);
            }
        }
        let to = |x: &mut [f64], v: &[f64]| x.iter_mut().zip(v).for_each(|(x, v)| *x += h * v);
        to(&mut nodes.x, &self.ux);
        to(&mut nodes.y, &self.uy);
        self.finish(system, h);
        true
    }

    /// Meets C = 0 at the end of the step, in `self.ux`.
    fn meet(&mut self, system: &mut System, h: f64) -> bool {
        let scale = 0.5 * h * h;
        let n = system.rods.a.len();
        // The mean over the step, as the positions see it, lies a third of the step after its start.
        let ahead = if self.last == h { 1.0 / 3.0 } else { 0.0 };
        let now = system.rods.lambda.iter().zip(&mut self.before);
        for (((lambda, before), rhs), moved) in now.zip(&mut system.rhs).zip(&mut self.moved) {
            *moved = scale * ahead * (lambda - *before);
            *rhs = scale * lambda + *moved;
            *before = *lambda;
        }
        self.moved[n..].fill(0.0);
        for (rhs, lambda) in system.rhs[n..].chunks_exact_mut(2).zip(&system.pins.lambda) {
            (rhs[0], rhs[1]) = (scale * lambda.x, scale * lambda.y);
        }
        system.push(&mut self.ux, &mut self.uy);
        let mut last = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let far = self.residual(system);
            if far <= self.tight || (far < ROUNDING && far > 0.5 * last) {
                self.take_error(system);
                return true;
            }
            if !(far < 0.9 * last) {
                break;
            }
            last = far;
            system.matrix.solve(&mut system.rhs);
            self.moved.iter_mut().zip(&system.rhs).for_each(|(sum, mu)| *sum += mu);
            system.push(&mut self.ux, &mut self.uy);
        }
        self.last = 0.0;
        false
    }

    /// Writes −C at x + u to the right-hand side. Returns the largest |C| in parts of L².
    fn residual(&mut self, system: &mut System) -> f64 {
        let (rods, ux, uy) = (&system.rods, &self.ux, &self.uy);
        let n = rods.a.len();
        let mut largest = 0.0f64;
        for (r, rhs) in system.rhs[..n].iter_mut().enumerate() {
            let (a, b) = (rods.a[r] as usize, rods.b[r] as usize);
            let (x, y) = (system.dx[r] + (ux[b] - ux[a]), system.dy[r] + (uy[b] - uy[a]));
            let error = 0.5 * (x * x + y * y - rods.square[r]);
            *rhs = -error;
            let part = error.abs() / rods.square[r];
            // Keeps a NaN.
            largest = if part <= largest { largest } else { part };
        }
        let nodes = &system.nodes;
        for ((a, b), rhs) in system.pins.a.iter().zip(&system.pins.b).zip(system.rhs[n..].chunks_exact_mut(2)) {
            let (a, b) = (*a as usize, *b as usize);
            rhs[0] = (nodes.x[a] - nodes.x[b]) + (ux[a] - ux[b]);
            rhs[1] = (nodes.y[a] - nodes.y[b]) + (uy[a] - uy[b]);
            largest = largest.max(rhs[0].abs().max(rhs[1].abs()) / system.length);
        }
        largest
    }

    /// What the iterations added to the prediction with the multipliers of the start is h³ x'''/6 of the constraints.
    fn take_error(&mut self, system: &mut System) {
        system.rhs.copy_from_slice(&self.moved);
        let nodes = system.nodes.len();
        self.load.clear();
        self.load.resize(2 * nodes, 0.0);
        let (x, y) = self.load.split_at_mut(nodes);
        system.push(x, y);
        self.error = self.load.iter().map(|e| e * e).sum();
    }

    /// The second half: forces and multipliers at the new positions.
    fn finish(&mut self, system: &mut System, h: f64) {
        system.factor_if_constrained();
        let nodes = system.nodes.len();
        self.load.resize(2 * nodes, 0.0);
        let (bx, by) = self.load.split_at_mut(nodes);
        system.force_accelerations(bx, by);
        let sixth = h * h / 6.0;
        let half = 0.5 * h;
        for (a, b) in [(&mut self.ax, bx), (&mut self.ay, by)] {
            for (a, b) in a.iter_mut().zip(b) {
                let change = sixth * (*b - *a);
                self.error += change * change;
                *a = *b;
            }
        }
        let nodes = &mut system.nodes;
        for ((v, u), a) in nodes.vx.iter_mut().zip(&self.ux).zip(&self.ax) {
            *v = u + half * a;
        }
        for ((v, u), a) in nodes.vy.iter_mut().zip(&self.uy).zip(&self.ay) {
            *v = u + half * a;
        }
        if !system.unconstrained() {
            system.project_velocities();
            system.keep_multipliers(2.0 / h);
            self.last = h;
        }
        // Half of x'''h³/6 is what the Verlet method leaves out.
        self.error = 0.5 * (self.error / system.nodes.len() as f64).sqrt();
    }
}

impl Start {
    fn keep(&mut self, system: &System, ax: &[f64], ay: &[f64]) {
        let nodes = &system.nodes;
        for (to, from) in [
            (&mut self.x, &nodes.x[..]),
            (&mut self.y, &nodes.y),
            (&mut self.vx, &nodes.vx),
            (&mut self.vy, &nodes.vy),
            (&mut self.rods, &system.rods.lambda),
            (&mut self.ax, ax),
            (&mut self.ay, ay),
        ] {
            to.clear();
            to.extend_from_slice(from);
        }
    }

    /// Puts the island back, with the matrix factored there.
    fn restore(&self, system: &mut System, ax: &mut [f64], ay: &mut [f64]) {
        let nodes = &mut system.nodes;
        nodes.x.copy_from_slice(&self.x);
        nodes.y.copy_from_slice(&self.y);
        nodes.vx.copy_from_slice(&self.vx);
        nodes.vy.copy_from_slice(&self.vy);
        system.rods.lambda.copy_from_slice(&self.rods);
        ax.copy_from_slice(&self.ax);
        ay.copy_from_slice(&self.ay);
        system.factor_if_constrained();
    }
}
