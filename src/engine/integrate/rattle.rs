//! RATTLE: velocity Verlet with the positions brought back onto C = 0 in every step and the velocities onto Ċ = 0.
//!
//! ```text
//! u₀ = h v + ½ h² (a + M⁻¹Jᵀλ)(x₀),   uₙ = uₙ₋₁ + h² (a + M⁻¹Jᵀλ)(xₙ),   xₙ₊₁ = xₙ + uₙ,   λₙ such that C(xₙ₊₁) = 0
//! v = u/h + ½ h a(x) + M⁻¹J(x)ᵀν,   J(x) v = 0   at the end
//! ```
//!
//! Andersen, J. Comput. Phys. 52, 24 (1983). Between the steps the velocities lie half-way (SHAKE; Ryckaert, Ciccotti and Berendsen,
//! J. Comput. Phys. 23, 327 (1977)): the positions are the same whether they are projected in every step or once at the end.
//! λ follows by quasi-Newton iterations with the one factor of A(xₙ), solved for all rows at once, started from the multipliers
//! before. Order 2, symplectic without dampers and drag: the energy stays bounded. One factorisation and some three solves a step.
//!
//! Fails where a rod turns by more than half a radian or so in a step, or where springs and tense light rods swing faster than
//! h ω = 2: the step is cut before, and all steps are halved where the iterations do not converge.

use super::outcome::Outcome;
use super::pace::{Pace, SMOOTH, carried_on, steps_next, steps_within};
use crate::engine::island::System;

/// Largest turn of a rod and largest h ω in a step.
const TURN: f64 = 0.7;
const SWING: f64 = 1.8;
/// Steps beyond which an implicit method is cheaper: with constraints, and where there is nothing to factor.
const MOST_CONSTRAINED: f64 = 8.0;
const MOST_FREE: f64 = 40.0;
/// Most steps for an accuracy.
const MOST_WITHIN: f64 = 100.0;
const MOST_ITERATIONS: u32 = 25;
/// C = 0 is met to this part of L².
const TIGHT: f64 = 1e-14;
/// Corrections below this that do not shrink are rounding.
const ROUNDING: f64 = 1e-10;
/// Part of the wanted local error to which constraints are met where only that much is asked for.
const LOOSE: f64 = 0.1;
/// Most that an error counts as, in parts of what is allowed.
const MOST_EXCESS: f64 = 1e4;
/// Times that the number of steps is corrected.
const MOST_CHANGES: u32 = 4;
/// A start farther off C = 0 (in parts of L²) is projected, whatever is wanted: someone has moved a body.
const FAR: f64 = 1e-6;
/// Velocities that break Ċ = 0 by more than this part of the largest are projected.
const ASTRAY: f64 = 1e-9;

/// Scratch memory, by node unless said.
#[derive(Debug, Default)]
pub(crate) struct Rattle {
    /// Accelerations by the forces at the present positions.
    ax: Vec<f64>,
    ay: Vec<f64>,
    /// How far the nodes move in a step; and did in the step before, or would by the multipliers before.
    ux: Vec<f64>,
    uy: Vec<f64>,
    before: [Vec<f64>; 2],
    /// How far they moved in the last step, and by how much that was farther than in the one before it.
    last: [Vec<f64>; 2],
    growth: [Vec<f64>; 2],
    load: Vec<f64>,
    start: Start,
    /// By row: the mean multipliers of this step and of the one before, and h² λ of this step.
    lambda: Vec<f64>,
    lambda_before: Vec<f64>,
    total: Vec<f64>,
    /// C is met to this part of L².
    tight: f64,
}

/// An island as it was at the start.
#[derive(Debug, Default)]
struct Start {
    coordinates: [Vec<f64>; 4],
    /// By row.
    lambda: Vec<f64>,
}

/// How a run of equal steps ended.
enum Run {
    /// With an estimate of the local errors' sum [m].
    Done(f64),
    /// So many steps will do.
    Again(f64),
    Failed,
}

impl Rattle {
    /// Carries the island through `time` [s]. Where the pace is a tolerance and the island needs so many steps to be stable that
    /// an implicit method does better, or more than `most`, nothing is done and the outcome says so.
    pub fn advance(&mut self, system: &mut System, time: f64, pace: Pace, most: f64) -> Outcome {
        let mut outcome = Outcome { order: 2, ..Outcome::default() };
        self.reserve(system, pace);
        if !system.unconstrained() && system.rods.lambda.iter().all(|lambda| *lambda == 0.0) && !self.expect(system) {
            return Outcome { failed: true, kept: false, ..outcome };
        }
        let rates = system.rates(&mut self.load);
        let stable = libm::ceil(time * (rates.turn / TURN).max(rates.swing / SWING)).max(1.0);
        let most_stable = if system.unconstrained() { MOST_FREE } else { MOST_CONSTRAINED };
        let most = most.min(MOST_WITHIN);
        let mut steps = match pace {
            Pace::Steps(steps) => stable.max(f64::from(steps)),
            Pace::Within(_) if !(stable <= most_stable.min(most)) => return Outcome { stiff: true, ..outcome },
            Pace::Within(_) => stable.max(f64::from(system.foresight.steps).min(most)),
        };
        if !(steps <= super::MOST_STEPS && meet(system)) {
            return Outcome { failed: true, kept: false, ..outcome };
        }
        self.start.keep(system);
        let mut changes = 0;
        loop {
            let asked = if let (Pace::Within(tolerance), true) = (pace, changes < MOST_CHANGES) {
                tolerance
            } else {
                f64::INFINITY
            };
            let watched = matches!(pace, Pace::Within(_));
            match self.run(system, (time, steps), asked, watched) {
                Run::Done(error) => {
                    outcome.steps = steps as u32;
                    outcome.error = error;
                    outcome.kept = pace.keeps(error);
                    if let Pace::Within(tolerance) = pace {
                        outcome.next = steps_next(steps, error / tolerance, 2.0, SMOOTH);
                    }
                    return outcome;
                }
                Run::Again(more) => (steps, changes) = (more, changes + 1),
                Run::Failed => steps *= 2.0,
            }
            outcome.retries += 1;
            if watched && !(steps <= most) {
                self.start.restore(system);
                return Outcome { stiff: true, ..outcome };
            }
            if !(steps <= super::MOST_STEPS) {
                return Outcome { failed: true, kept: false, ..outcome };
            }
            self.start.restore(system);
        }
    }

    /// Makes room.
    fn reserve(&mut self, system: &System, pace: Pace) {
        let (nodes, rows) = (system.nodes.len(), system.rhs.len());
        let [px, py] = &mut self.before;
        let steps = self.last.iter_mut().chain(&mut self.growth);
        for scratch in [&mut self.ax, &mut self.ay, &mut self.ux, &mut self.uy, px, py].into_iter().chain(steps) {
            scratch.resize(nodes, 0.0);
        }
        for scratch in [&mut self.lambda, &mut self.lambda_before, &mut self.total] {
            scratch.resize(rows, 0.0);
        }
        self.tight = match pace {
            Pace::Steps(_) => TIGHT,
            Pace::Within(tolerance) => (LOOSE * tolerance / system.length).clamp(TIGHT, FAR),
        };
    }

    /// The multipliers where none are known: at the start of a scene. Returns whether the constraints can be met.
    fn expect(&mut self, system: &mut System) -> bool {
        let met = system.meet_constraints();
        system.force_accelerations(&mut self.ax, &mut self.ay);
        system.constrain_accelerations(&mut self.ax, &mut self.ay);
        met
    }

    /// So many equal steps. Ends after the first one if its error says that `tolerance` [m] takes more of them, and after the last one if the
    /// sum does, which is known if the steps are `watched`.
    fn run(&mut self, system: &mut System, (time, steps): (f64, f64), tolerance: f64, watched: bool) -> Run {
        let h = time / steps;
        let damped = system.damped();
        self.lambda.copy_from_slice(&self.start.lambda);
        system.factor_if_constrained();
        system.force_accelerations(&mut self.ax, &mut self.ay);
        let nodes = &system.nodes;
        for (u, v) in [(&mut self.ux, &nodes.vx), (&mut self.uy, &nodes.vy)] {
            u.iter_mut().zip(v).for_each(|(u, v)| *u = h * v);
        }
        let mut error = 0.0;
        for step in 0..steps as u32 {
            let weight = if step == 0 { 0.5 * h * h } else { h * h };
            if damped {
                self.remember();
            }
            let kick = |u: &mut [f64], a: &[f64]| u.iter_mut().zip(a).for_each(|(u, a)| *u += weight * a);
            kick(&mut self.ux, &self.ax);
            kick(&mut self.uy, &self.ay);
            if !system.unconstrained() {
                self.predict(system, step, weight);
                if step == 0 && !damped {
                    self.remember();
                }
                if !self.meet(system, weight) {
                    return Run::Failed;
                }
            }
            let nodes = &mut system.nodes;
            for (x, u) in [(&mut nodes.x, &self.ux), (&mut nodes.y, &self.uy)] {
                x.iter_mut().zip(u).for_each(|(x, u)| *x += u);
            }
            if damped {
                self.estimate_velocities(system, step, h);
            }
            if step == 0 {
                error = self.renew_accelerations_and_tell(system, h, damped);
                let expected = carried_on(steps, SMOOTH) * steps * error;
                if let Some(more) = steps_within(steps, expected / tolerance, 2.0) {
                    return Run::Again(more);
                }
            } else {
                system.force_accelerations(&mut self.ax, &mut self.ay);
            }
            if watched {
                error += self.tell(step, h);
            }
            system.factor_if_constrained();
        }
        let [x, y, ..] = &self.start.coordinates;
        if watched && system.springs.turn_over(&system.nodes, x, y) {
            // Nothing tells how long it was on the wrong side.
            error = system.length;
        }
        error *= carried_on(steps, SMOOTH);
        if let Some(more) = steps_within(steps, (error / tolerance).min(MOST_EXCESS), 2.0) {
            return Run::Again(more);
        }
        self.finish(system, h);
        Run::Done(error)
    }

    /// Estimate of the error of a step beyond what the first one tells of itself, RMS over the nodes [m]: h² (a' − a)/12 as there, with the
    /// accelerations of forces and constraints together, which are what a step goes farther than the one before.
    fn tell(&mut self, step: u32, h: f64) -> f64 {
        let [_, _, vx, vy] = &self.start.coordinates;
        let mut sum = 0.0;
        let [lx, ly] = &mut self.last;
        let [gx, gy] = &mut self.growth;
        for (u, v, last, growth) in [(&self.ux, vx, lx, gx), (&self.uy, vy, ly, gy)] {
            for i in 0..u.len() {
                // The first step has half of what it would go farther than one before it.
                let now = if step == 0 { 2.0 * (u[i] - h * v[i]) } else { u[i] - last[i] };
                let change = if step == 0 { 0.0 } else { now - growth[i] };
                sum += change * change;
                growth[i] = now;
                last[i] = u[i];
            }
        }
        (sum / self.ux.len() as f64).sqrt() / 12.0
    }

    /// Keeps u.
    fn remember(&mut self) {
        self.before[0].copy_from_slice(&self.ux);
        self.before[1].copy_from_slice(&self.uy);
    }

    /// Adds to u what the constraints do with the multipliers expected: those before, drawn on in a straight line. The first step's
    /// are those of its start; its mean, as the positions see it, lies a third of the step later.
    fn predict(&mut self, system: &mut System, step: u32, weight: f64) {
        let ahead = match step {
            0 => 0.0,
            1 => 2.0,
            2 => 1.5,
            _ => 1.0,
        };
        let rows = self.lambda.len();
        let (lambda, before) = (&mut self.lambda[..rows], &mut self.lambda_before[..rows]);
        let (total, rhs) = (&mut self.total[..rows], &mut system.rhs[..rows]);
        for k in 0..rows {
            let now = lambda[k];
            let expected = if step == 0 { now } else { now + ahead * (now - before[k]) };
            before[k] = now;
            total[k] = weight * expected;
            rhs[k] = total[k];
        }
        system.push(&mut self.ux, &mut self.uy);
    }

    /// Meets C = 0 at the end of the step, in `self.ux`.
    fn meet(&mut self, system: &mut System, weight: f64) -> bool {
        let mut last = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let far = system.position_error_after(&self.ux, &self.uy);
            if far <= self.tight || (far < ROUNDING && far > 0.5 * last) {
                let over = 1.0 / weight;
                self.lambda.iter_mut().zip(&self.total).for_each(|(lambda, total)| *lambda = over * total);
                return true;
            }
            if !(far < 0.9 * last) {
                return false;
            }
            last = far;
            system.matrix.solve(&mut system.rhs);
            self.total.iter_mut().zip(&system.rhs).for_each(|(sum, mu)| *sum += mu);
            system.push(&mut self.ux, &mut self.uy);
        }
        false
    }

    /// The velocities at the end of a step, for forces that depend on them: from its middle on, with the acceleration of the step.
    fn estimate_velocities(&self, system: &mut System, step: u32, h: f64) {
        let over = 1.0 / h;
        let nodes = &mut system.nodes;
        let [px, py] = &self.before;
        for (v, (u, before)) in [(&mut nodes.vx, (&self.ux, px)), (&mut nodes.vy, (&self.uy, py))] {
            let share = if step == 0 { over } else { 0.5 * over };
            for (v, (u, before)) in v.iter_mut().zip(u.iter().zip(before)) {
                *v = over * u + share * (u - before);
            }
        }
    }

    /// Forces at the end of the first step. Returns an estimate of the step's error, RMS over the nodes [m].
    ///
    /// Half of x'''h³/6 is what the Verlet method leaves out: h² (a' − a)/6 of the forces, and of the constraints what u got beyond
    /// the multipliers of the start.
    fn renew_accelerations_and_tell(&mut self, system: &System, h: f64, damped: bool) -> f64 {
        let nodes = system.nodes.len();
        self.load.resize(2 * nodes, 0.0);
        let (bx, by) = self.load.split_at_mut(nodes);
        system.force_accelerations(bx, by);
        let sixth = h * h / 6.0;
        let constrained = !system.unconstrained() && !damped;
        let mut sum = 0.0;
        let [px, py] = &self.before;
        for (a, b, u, before) in [(&mut self.ax, bx, &self.ux, px), (&mut self.ay, by, &self.uy, py)] {
            for i in 0..nodes {
                let mut change = sixth * (b[i] - a[i]);
                if constrained {
                    change += u[i] - before[i];
                }
                sum += change * change;
            }
            a.copy_from_slice(b);
        }
        0.5 * (sum / nodes as f64).sqrt()
    }

    /// Velocities and multipliers at the end.
    fn finish(&mut self, system: &mut System, h: f64) {
        let (over, half) = (1.0 / h, 0.5 * h);
        let nodes = &mut system.nodes;
        for (v, (u, a)) in [(&mut nodes.vx, (&self.ux, &self.ax)), (&mut nodes.vy, (&self.uy, &self.ay))] {
            for (v, (u, a)) in v.iter_mut().zip(u.iter().zip(a)) {
                *v = over * u + half * a;
            }
        }
        if !system.unconstrained() {
            system.project_velocities();
            system.keep_multipliers(2.0 * over);
        }
    }
}

/// Projects what an edit has left off the constraints. Returns whether there is a position that meets them.
fn meet(system: &mut System) -> bool {
    if system.unconstrained() {
        return true;
    }
    system.factor();
    if !(system.position_error() <= FAR) {
        return system.meet_constraints();
    }
    if !(system.velocity_error() <= ASTRAY) {
        system.project_velocities();
    }
    true
}

impl Start {
    fn keep(&mut self, system: &System) {
        let nodes = &system.nodes;
        for (to, from) in self.coordinates.iter_mut().zip([&nodes.x, &nodes.y, &nodes.vx, &nodes.vy]) {
            to.clone_from(from);
        }
        self.lambda.clone_from(&system.rods.lambda);
        self.lambda.extend(system.pins.lambda.iter().flat_map(|lambda| [lambda.x, lambda.y]));
    }

    fn restore(&self, system: &mut System) {
        for (to, from) in system.nodes.coordinates().into_iter().zip(&self.coordinates) {
            to.copy_from_slice(from);
        }
    }
}
