//! RATTLE where anchors turn: the angles of the discs are coordinates like the others, with I in place of m.
//!
//! ```text
//! u₀ = h v + ½ h² (a + M⁻¹Jᵀλ)(q₀),   uₙ = uₙ₋₁ + h² (a + M⁻¹Jᵀλ)(qₙ),   qₙ₊₁ = qₙ + uₙ,   λₙ such that C(qₙ₊₁) = 0
//! v = u/h + ½ h a(q) + M⁻¹J(q)ᵀν,   J(q) v = 0   at the end
//! ```
//!
//! M is constant, so this is [`super::rattle`] word for word, of order 2 and symplectic; C depends on θ by the cosines and sines of
//! the arms, which the quasi-Newton iterations with the factor of A(qₙ) take like the rest. For islands without dampers, drag, hold and
//! ropes. Fails where a disc or rod turns by half a radian or so in a step, or where springs and pulls swing faster than h ω = 2.

use super::outcome::Outcome;
use super::pace::{Pace, steps_within};
use crate::engine::island::System;

/// Largest turn of a rod or disc, and largest h ω, in a step.
const TURN: f64 = 0.6;
const SWING: f64 = 1.6;
/// Steps beyond which the series is cheaper.
const MOST_QUICK: f64 = 8.0;
const MOST_ITERATIONS: u32 = 25;
/// C = 0 is met to this part of L²; corrections below the second that do not shrink are rounding.
const TIGHT: f64 = 1e-14;
const ROUNDING: f64 = 1e-10;
/// Part of the wanted local error to which constraints are met where only that much is asked for, and the most [in parts of L²].
const LOOSE: f64 = 0.1;
const FAR: f64 = 1e-6;
/// Times that the number of steps is corrected.
const MOST_CHANGES: u32 = 4;

/// x and y by node, and angles by rotor.
#[derive(Debug, Default)]
struct Vector {
    x: Vec<f64>,
    y: Vec<f64>,
    angle: Vec<f64>,
}

/// Scratch memory.
#[derive(Debug, Default)]
pub(crate) struct RattleTurning {
    /// Where the island began, and how fast.
    start: Vector,
    start_speed: Vector,
    /// Accelerations by the forces, and those a step later.
    a: Vector,
    next: Vector,
    /// Where a step begins; how far it goes, and would by the multipliers of its start.
    from: Vector,
    u: Vector,
    expected: Vector,
    /// By row: multipliers of the step, and h² λ.
    lambda: Vec<f64>,
    start_lambda: Vec<f64>,
    total: Vec<f64>,
    load: Vec<f64>,
    /// C is met to this part of L².
    tight: f64,
}

/// How a run of equal steps ended.
enum Run {
    /// With an estimate of the local errors' sum [m].
    Done(f64),
    /// So many steps will do.
    Again(f64),
    Failed,
}

impl RattleTurning {
    /// Whether an island's forces are of the kind that this takes.
    pub fn takes(system: &System) -> bool {
        !system.damped() && system.rods.first_rope == system.rods.a.len()
    }

    /// Carries the island through `time` [s]. Where the pace is a tolerance and the island needs so many steps that the series does
    /// better, nothing is done and the outcome says so.
    pub fn advance(&mut self, system: &mut System, time: f64, pace: Pace) -> Outcome {
        let mut outcome = Outcome { order: 2, ..Outcome::default() };
        self.reserve(system);
        self.tight = match pace {
            Pace::Steps(_) => TIGHT,
            Pace::Within(tolerance) => (LOOSE * tolerance / system.length).clamp(TIGHT, FAR),
        };
        if !system.meet_constraints() {
            return Outcome { failed: true, kept: false, ..outcome };
        }
        self.start.take_positions(system);
        self.start_speed.take_velocities(system);
        self.a.accelerate(system);
        if !system.unconstrained() {
            self.next.copy(&self.a);
            system.turning_multipliers(&mut self.next.x, &mut self.next.y, &self.next.angle);
        }
        self.start_lambda.copy_from_slice(&system.rhs);
        let rates = system.turning_rates(&mut self.load);
        let stable = libm::ceil(time * (rates.turn / TURN).max(rates.swing / SWING)).max(1.0);
        let quick = matches!(pace, Pace::Within(_));
        if quick && !(stable <= MOST_QUICK) {
            return Outcome { stiff: true, ..outcome };
        }
        let mut steps = if let Pace::Steps(steps) = pace { stable.max(f64::from(steps)) } else { stable };
        let mut changes = 0;
        while steps <= super::MOST_STEPS {
            let asked = match pace {
                Pace::Within(tolerance) if changes < MOST_CHANGES => tolerance,
                _ => f64::INFINITY,
            };
            if outcome.retries > 0 {
                self.return_to_start(system);
            }
            match self.run(system, time, steps, asked) {
                Run::Done(error) => {
                    outcome.steps = steps as u32;
                    outcome.error = error;
                    outcome.kept = pace.keeps(error);
                    return outcome;
                }
                Run::Again(more) => (steps, changes) = (more, changes + 1),
                Run::Failed => steps *= 2.0,
            }
            outcome.retries += 1;
            if quick && !(steps <= MOST_QUICK) {
                return Outcome { stiff: true, ..outcome };
            }
        }
        Outcome { failed: true, kept: false, ..outcome }
    }

    fn reserve(&mut self, system: &System) {
        let (nodes, rotors) = (system.nodes.len(), system.turning.rotors.angle.len());
        let RattleTurning { start, start_speed, a, next, from, u, expected, .. } = self;
        for vector in [start, start_speed, a, next, from, u, expected] {
            vector.x.resize(nodes, 0.0);
            vector.y.resize(nodes, 0.0);
            vector.angle.resize(rotors, 0.0);
        }
        for rows in [&mut self.lambda, &mut self.start_lambda, &mut self.total] {
            rows.resize(system.rhs.len(), 0.0);
        }
    }

    fn return_to_start(&mut self, system: &mut System) {
        self.start.give_positions(system);
        system.factor_if_constrained();
        self.a.accelerate(system);
    }

    /// So many equal steps from the start. Ends after the first one if its error says that `tolerance` [m] takes more of them.
    fn run(&mut self, system: &mut System, time: f64, steps: f64, tolerance: f64) -> Run {
        let h = time / steps;
        self.lambda.copy_from_slice(&self.start_lambda);
        self.u.scaled(h, &self.start_speed);
        let mut error = 0.0;
        for step in 0..steps as u32 {
            let weight = if step == 0 { 0.5 * h * h } else { h * h };
            self.u.add(weight, &self.a);
            self.from.take_positions(system);
            if system.unconstrained() {
                self.move_by_u(system);
            } else if !self.meet(system, weight) {
                return Run::Failed;
            }
            self.next.accelerate(system);
            if step == 0 {
                error = steps * self.error(system, h);
                if let Some(more) = steps_within(steps, error / tolerance, 2.0) {
                    return Run::Again(more);
                }
            }
            std::mem::swap(&mut self.a, &mut self.next);
            system.factor_if_constrained();
        }
        self.u.give_velocities(system, 1.0 / h, &self.a, 0.5 * h);
        if !system.unconstrained() {
            system.project_velocities();
            system.keep_multipliers(2.0 / h);
        }
        Run::Done(error)
    }

    /// Meets C = 0 at the end of the step, the multipliers being expected to stay as they were.
    fn meet(&mut self, system: &mut System, weight: f64) -> bool {
        self.total.iter_mut().zip(&self.lambda).for_each(|(total, lambda)| *total = weight * lambda);
        self.u.push(system, &self.total);
        self.expected.copy(&self.u);
        let mut last = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            self.move_by_u(system);
            system.take_differences();
            let far = system.position_error();
            if far <= self.tight || (far < ROUNDING && far > 0.5 * last) {
                self.lambda.iter_mut().zip(&self.total).for_each(|(lambda, total)| *lambda = total / weight);
                return true;
            }
            if !(far < 0.9 * last) {
                return false;
            }
            last = far;
            system.matrix.solve(&mut system.rhs);
            self.total.iter_mut().zip(&system.rhs).for_each(|(total, mu)| *total += mu);
            self.u.push(system, &system.rhs);
        }
        false
    }

    fn move_by_u(&self, system: &mut System) {
        let (nodes, rotors) = (&mut system.nodes, &mut system.turning.rotors);
        for (q, (from, u)) in [
            (&mut nodes.x, (&self.from.x, &self.u.x)),
            (&mut nodes.y, (&self.from.y, &self.u.y)),
            (&mut rotors.angle, (&self.from.angle, &self.u.angle)),
        ] {
            for (q, (from, u)) in q.iter_mut().zip(from.iter().zip(u)) {
                *q = from + u;
            }
        }
        system.turning.place_positions(nodes);
    }

    /// Half of what the Verlet method leaves out of the first step, RMS over the bodies [m]: h² (a' − a)/6 of the forces, and of the
    /// constraints what u got beyond the multipliers of the start. A disc's turn counts as the way of its rim.
    fn error(&self, system: &System, h: f64) -> f64 {
        let sixth = h * h / 6.0;
        let (nodes, rotors) = (&system.nodes, &system.turning.rotors);
        let constrained = !system.unconstrained();
        let change = |i: usize, next: &[f64], a: &[f64], u: &[f64], expected: &[f64]| {
            sixth * (next[i] - a[i]) + if constrained { u[i] - expected[i] } else { 0.0 }
        };
        let (next, a, u, e) = (&self.next, &self.a, &self.u, &self.expected);
        let (mut sum, mut count) = (0.0, 0.0);
        for i in (0..nodes.len()).filter(|i| nodes.w[*i] > 0.0) {
            let (x, y) = (change(i, &next.x, &a.x, &u.x, &e.x), change(i, &next.y, &a.y, &u.y, &e.y));
            sum += x * x + y * y;
            count += 1.0;
        }
        for (i, radius) in rotors.radius.iter().enumerate() {
            let way = radius * change(i, &next.angle, &a.angle, &u.angle, &e.angle);
            sum += way * way;
        }
        0.5 * (sum / f64::max(count, 1.0)).sqrt()
    }
}

impl Vector {
    fn parts(&mut self) -> [&mut Vec<f64>; 3] {
        [&mut self.x, &mut self.y, &mut self.angle]
    }

    fn copy(&mut self, from: &Vector) {
        self.scaled(1.0, from);
    }

    fn scaled(&mut self, factor: f64, from: &Vector) {
        for (to, from) in self.parts().into_iter().zip([&from.x, &from.y, &from.angle]) {
            to.iter_mut().zip(from).for_each(|(to, from)| *to = factor * from);
        }
    }

    fn add(&mut self, factor: f64, other: &Vector) {
        for (to, other) in self.parts().into_iter().zip([&other.x, &other.y, &other.angle]) {
            to.iter_mut().zip(other).for_each(|(to, other)| *to += factor * other);
        }
    }

    fn push(&mut self, system: &System, lambda: &[f64]) {
        system.turning.push(&system.nodes.w, lambda, &mut self.x, &mut self.y, &mut self.angle);
    }

    fn accelerate(&mut self, system: &System) {
        system.turning_accelerations(&mut self.x, &mut self.y, &mut self.angle);
    }

    fn take_positions(&mut self, system: &System) {
        self.x.copy_from_slice(&system.nodes.x);
        self.y.copy_from_slice(&system.nodes.y);
        self.angle.copy_from_slice(&system.turning.rotors.angle);
    }

    fn give_positions(&self, system: &mut System) {
        system.nodes.x.copy_from_slice(&self.x);
        system.nodes.y.copy_from_slice(&self.y);
        system.turning.rotors.angle.copy_from_slice(&self.angle);
        system.turning.place(&mut system.nodes);
    }

    fn take_velocities(&mut self, system: &System) {
        self.x.copy_from_slice(&system.nodes.vx);
        self.y.copy_from_slice(&system.nodes.vy);
        self.angle.copy_from_slice(&system.turning.rotors.omega);
    }

    /// Velocities `over` u + `half` a.
    fn give_velocities(&self, system: &mut System, over: f64, a: &Vector, half: f64) {
        let (nodes, rotors) = (&mut system.nodes, &mut system.turning.rotors);
        for (v, (u, a)) in [
            (&mut nodes.vx, (&self.x, &a.x)),
            (&mut nodes.vy, (&self.y, &a.y)),
            (&mut rotors.omega, (&self.angle, &a.angle)),
        ] {
            for (v, (u, a)) in v.iter_mut().zip(u.iter().zip(a)) {
                *v = over * u + half * a;
            }
        }
        system.turning.place_velocities(nodes);
    }
}
