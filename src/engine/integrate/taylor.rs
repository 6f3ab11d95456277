//! Taylor series of the index-1 equations, with one factorisation a step.
//!
//! M a = f + Jᵀλ and J a = −J̇v are differentiated by recurrences on the coefficients of x, d = x_b − x_a and λ. Of every
//! order only the highest coefficient is unknown, and it is solved for with the same A = J M⁻¹ Jᵀ:
//!
//! ```text
//! |d|² = L²   ⇒   2 d₀·d_N = −Σ_{0<j<N} d_j·d_{N−j},   N (N−1) x_N = a_{N−2},   a_k = w (f_k ± Σ_j d_j λ_{k−j})
//! ```
//!
//! Order and step follow from the tolerance and the size of the last coefficients (Jorba and Zou, "A software package for the
//! numerical integration of ODEs by means of high-order Taylor methods", Experimental Mathematics 14 (2005)); the order ends
//! earlier where the rest of the time converges sooner. The polynomial is dense output: the instants at which ropes tighten or
//! slacken, and the mouse's force meets its bound, are roots of it. After each step one projection onto C = 0 and Ċ = 0.
//!
//! The last coefficients are a guess: orders vanish at rest and by symmetry, and what swings fast has its largest terms behind
//! them. A step is judged by what it leaves of the equations: the accelerations where it ends, which the next step begins with,
//! less the second derivative of the polynomial (the defect). What is too far off is taken back, to the highest order or smaller.
//!
//! Time is scaled by the time that is left, so coefficient k is what term k contributes at its end.
//! Cost of a step of order P: P solves and about P² multiply-adds a rod, 6 P² a spring. It does not damp; stiff springs and
//! very tense light ropes need many steps.

mod coefficients;
mod judge;
mod passage;
mod polynomial;
mod springs;
mod turning;

use self::coefficients::GripSeries;
use self::judge::{Judge, Verdict};
use self::passage::Passage;
use self::polynomial::{horner, horner_rate};
use self::springs::SpringSeries;
use self::turning::TurningSeries;
use super::events::{Event, Series};
use super::outcome::Outcome;
use super::pace::SLACK;
use crate::engine::island::{Stretching, System};
use glam::DVec2;

/// Orders beyond this gain nothing in double precision.
const HIGHEST_ORDER: usize = 24;
const LOWEST_ORDER: usize = 4;
/// Part of the step that the last terms allow, before it is known what steps leave.
const TRUST: f64 = 0.9;
/// Part of what is allowed that the terms behind the last may be expected to be. At 0.03 a pendulum's phase is 1.0e-6 off after
/// 10 s at 1e-6.
const END: f64 = 0.005;
/// What a step may be wrong by in parts of the shortest rod: what swings fast on a short rod gains energy where it is not followed at all.
const FINE: f64 = 1e-3;
/// What rounding leaves of a step, in parts of the farthest coordinate.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// What a step may leave the constraints off, in parts of what they may be off before the nodes are put back.
const RETURNED: f64 = 1e-5;

/// Coefficients by order, then by node, rod or spring.
#[derive(Debug, Default)]
pub(crate) struct Taylor {
    x: Vec<Vec<f64>>,
    y: Vec<Vec<f64>>,
    dx: Vec<Vec<f64>>,
    dy: Vec<Vec<f64>>,
    /// Rows of A, in units of 1/(time scale)².
    lambda: Vec<Vec<f64>>,
    springs: SpringSeries,
    grip: GripSeries,
    turning: TurningSeries,
    judge: Judge,
    /// Of the hop at hand.
    passages: Vec<Passage>,
    /// In what time the springs swing that come near zero length in the run [s], 0 if there are none.
    near_zero: f64,
    /// Of nodes, rods, rows and springs that there is room for.
    sizes: [usize; 4],
    fx: Vec<f64>,
    fy: Vec<f64>,
    gx: Vec<f64>,
    gy: Vec<f64>,
}

/// A run through some time, as far as it has come.
struct Run {
    /// [s]
    time: f64,
    left: f64,
    /// What the local errors may add up to over `time`, and the least that a step is held to, by rounding [m].
    tolerance: f64,
    rounding: f64,
    /// How far a step may end off the constraints at least [L²].
    tight: f64,
    budget: u32,
    highest: usize,
    /// The part of the time left that the last terms allow, and how much of that is made use of: as it went in the step before.
    allowed: f64,
    trust: f64,
    /// The next series goes to the highest order.
    whole: bool,
    events: usize,
    outcome: Outcome,
}

impl Taylor {
    /// Makes room for an island of `nodes`, `rods`, `rows` and `springs`.
    pub fn reserve(&mut self, system: &System) {
        self.turning.reserve(system);
        self.judge.reserve(system);
        let (nodes, rods) = (system.nodes.len(), system.rods.a.len());
        let sizes = [nodes, rods, system.rhs.len(), system.springs.len()];
        if std::mem::replace(&mut self.sizes, sizes) == sizes {
            return;
        }
        room(&mut self.x, nodes);
        room(&mut self.y, nodes);
        room(&mut self.dx, rods);
        room(&mut self.dy, rods);
        room(&mut self.lambda, system.rhs.len());
        for scratch in [&mut self.fx, &mut self.fy] {
            scratch.resize(nodes, 0.0);
        }
        for scratch in [&mut self.gx, &mut self.gy] {
            scratch.resize(rods, 0.0);
        }
        self.springs.reserve(system.springs.len());
        self.passages.reserve(system.springs.len());
        self.grip.u.resize(HIGHEST_ORDER + 1, DVec2::ZERO);
        self.grip.square.resize(HIGHEST_ORDER + 1, 0.0);
        self.grip.inverse.resize(HIGHEST_ORDER + 1, 0.0);
    }

    /// Carries the island through `time` [s] with local errors that add up to about `tolerance` [m], in at most `budget` steps, those
    /// taken back among them; fails where these do not do.
    pub fn advance(&mut self, system: &mut System, time: f64, tolerance: f64, budget: u32) -> Outcome {
        self.reserve(system);
        let shortest = system.rods.length.iter().fold(f64::INFINITY, |least, length| length.min(least));
        let fine = tolerance.min(FINE * shortest);
        let highest = highest_order(fine / system.length);
        let rounding = ROUNDING * system.nodes.farthest();
        let tight = system.rounding_off();
        let outcome = Outcome::default();
        let mut run = Run {
            time,
            left: time,
            tolerance: fine,
            rounding,
            tight,
            budget,
            highest,
            allowed: 1.0,
            trust: TRUST,
            whole: false,
            events: 0,
            outcome,
        };
        if !system.meet_constraints() {
            return run.fail();
        }
        self.near_zero = system.swing_through_zero(time);
        self.judge.forget();
        system.see_bound();
        self.begin(system, time);
        while run.left > 0.0 {
            if run.is_spent() || !self.step(system, &mut run) {
                return run.fail();
            }
        }
        run.outcome.kept = run.outcome.error <= SLACK * tolerance.max(run.rounding);
        run.outcome
    }

    /// The start of a step, its accelerations known: coefficients 0 to 2.
    fn begin(&mut self, system: &mut System, scale: f64) {
        self.expand_first(system, scale);
        self.coefficient(system, scale, 0);
        self.choose_ropes(system, scale);
    }

    /// Lets go of ropes that would push and takes in those that would stretch, the accelerations being known.
    fn choose_ropes(&mut self, system: &mut System, scale: f64) {
        for _ in 0..system.most_changes() {
            let of = |k: usize, r: usize| [self.dx[k][r], self.dy[k][r]];
            let stretching = |_: &System, r: usize| Stretching::new(of(0, r), of(1, r), of(2, r).map(|d| 2.0 * d));
            if !system.choose_rope(&self.lambda[0], stretching) {
                break;
            }
            // The rows in force changed: once more, with a matrix for those that are left.
            system.factor();
            self.coefficient(system, scale, 0);
        }
    }

    /// One step, or one taken back. Returns whether the run can go on.
    fn step(&mut self, system: &mut System, run: &mut Run) -> bool {
        let scale = run.left;
        if let Some(spring) = self.starts_at_zero(system) {
            self.hop_from_zero(system, spring, run);
            return true;
        }
        self.judge.keep(system);
        let order = self.expand(system, run);
        run.allowed = if order < run.highest && !run.whole { 1.0 } else { self.allowed_part(order, run) };
        // The time left is cut into equal steps.
        let mut part = if run.allowed >= 1.0 && run.trust >= TRUST {
            1.0
        } else {
            1.0 / libm::ceil(1.0 / (run.trust * run.allowed))
        };
        if !(part > 0.0) {
            return false;
        }
        let most_events = 64 + 8 * (system.rods.a.len() - system.rods.first_rope);
        let event = self.first_event(system, order, part);
        if event.is_some() && run.events >= most_events {
            return false;
        }
        part = event.map_or(part, |(at, _)| at);
        let mut hop = None;
        if let Some((until, half)) = self.first_passage(system, order, part, run) {
            if until <= 0.0 {
                self.hop(system, 2.0 * half, run);
                return true;
            }
            (part, hop) = (until, Some((until, half)));
        }
        let Some(part) = self.go(system, order, part, run) else { return false };
        let event = event.filter(|(at, _)| *at == part);
        self.judge.expect(&self.x, &self.y, order, part, scale);
        self.turning.expect(order, part, scale);
        let left = if part >= 1.0 || scale * (1.0 - part) < 1e-12 * run.time { 0.0 } else { scale * (1.0 - part) };
        let next = if left > 0.0 { left } else { scale };
        self.expand_first(system, next);
        self.coefficient(system, next, 0);
        let h = part * scale;
        let defect = self.judge.defect(&self.x[2], &self.y[2], next).max(self.turning.defect(next));
        // Near a zero of a spring's length steps are short beside all that follows: there the velocity counts.
        let reach = self.near_zero.max(h);
        let orders = order as f64;
        // So it does where one step is as long as the run; shorter ones are those of fast swings, in which it comes to nothing.
        let error = defect * h / orders * (reach / (orders + 1.0) + h * h / run.time);
        match self.judge.verdict(error, (order, part), run) {
            Verdict::Refused => {
                self.judge.restore(system);
                run.outcome.retries += 1;
                self.begin(system, scale);
                return true;
            }
            Verdict::Taken => {}
        }
        run.left = left;
        run.events += usize::from(event.is_some());
        run.outcome.steps += 1;
        run.outcome.order = run.outcome.order.max(order as u32);
        run.outcome.error += error;
        if let Some((_, half)) = hop.filter(|(until, _)| *until == part) {
            self.hop(system, 2.0 * half, run);
            return true;
        }
        self.go_on(system, event.map(|(_, event)| event), left);
        true
    }

    /// From the end of a step to the start of the next one, whose coefficients up to the second are known unless an event changes them.
    fn go_on(&mut self, system: &mut System, event: Option<Event>, left: f64) {
        if let Some(event) = event {
            event.apply(system);
        }
        // At the root itself rounding would decide on which side of its bound the hold is.
        let decided = matches!(event, Some(Event::Hold { .. }));
        let changed = !decided && system.see_bound();
        if left == 0.0 {
            return;
        }
        if event.is_some() || changed { self.begin(system, left) } else { self.choose_ropes(system, left) }
    }

    /// Evaluates at `part` of the time scale and projects; a step that leaves the constraints farther than the tolerance allows
    /// is halved. Returns the part that was taken.
    fn go(&mut self, system: &mut System, order: usize, mut part: f64, run: &mut Run) -> Option<f64> {
        // A series that has converged is off the constraints by its own error.
        let most = (1e3 * run.tolerance / system.length).max(run.tight);
        loop {
            self.evaluate(system, order, part, run.left);
            if system.unconstrained() {
                return system.nodes.x.iter().sum::<f64>().is_finite().then_some(part);
            }
            system.factor();
            let off = system.position_error();
            if off <= most && system.return_to_constraints(off, (RETURNED * most).max(run.tight)) {
                system.project_velocities();
                return Some(part);
            }
            part *= 0.5;
            run.trust *= 0.5;
            run.outcome.retries += 1;
            if run.is_spent() {
                return None;
            }
        }
    }

    /// All coefficients from the third on; returns the order at which to stop: where the terms behind it, should they go on to shrink as
    /// those before, are a fraction of what the rest of the time may be wrong by.
    fn expand(&mut self, system: &mut System, run: &Run) -> usize {
        let enough = END * run.share(1.0);
        // Of the last four orders; in pairs, as every second one may vanish.
        let mut terms = [0.0, 0.0, 0.0, self.last_term(2)];
        for order in 3..=run.highest {
            self.coefficient(system, run.left, order - 2);
            terms = [terms[1], terms[2], terms[3], self.last_term(order)];
            let (before, last) = (terms[0].max(terms[1]), terms[2].max(terms[3]));
            // last · √(last/before)
            let shrinks = last <= before && last * last * last <= enough * enough * before;
            if order >= LOWEST_ORDER && (last <= enough || shrinks && order > LOWEST_ORDER) && !run.whole {
                return order;
            }
        }
        run.highest
    }

    /// Largest contribution of the term of this order at the end of the time scale [m].
    fn last_term(&self, order: usize) -> f64 {
        let largest = |values: &[f64]| values.iter().fold(0.0f64, |m, v| m.max(v.abs()));
        largest(&self.x[order]).max(largest(&self.y[order])).max(self.turning.last_term(order))
    }

    /// The part of the time scale that the last two terms allow.
    fn allowed_part(&self, order: usize, run: &Run) -> f64 {
        let allowed = |order: usize| {
            let term = self.last_term(order);
            if term <= run.share(1.0) {
                return 1.0;
            }
            // A step's share shrinks with it, down to rounding.
            let part = libm::pow(run.share(1.0) / term, 1.0 / (order - 1) as f64);
            part.max(libm::pow(run.rounding / term, 1.0 / order as f64))
        };
        allowed(order).min(allowed(order - 1))
    }

    /// Positions, velocities and multipliers at `part` of the time scale.
    fn evaluate(&self, system: &mut System, order: usize, part: f64, scale: f64) {
        horner(&self.x, order, part, &mut system.nodes.x);
        horner(&self.y, order, part, &mut system.nodes.y);
        horner_rate(&self.x, order, part, scale, &mut system.nodes.vx);
        horner_rate(&self.y, order, part, scale, &mut system.nodes.vy);
        if system.turns() {
            self.turning.evaluate(system, order, part, scale);
        }
        if system.unconstrained() {
            return;
        }
        let n = system.rods.a.len();
        horner(&self.lambda, order - 2, part, &mut system.rhs);
        let square = 1.0 / (scale * scale);
        for (to, from) in system.rods.lambda.iter_mut().zip(&system.rhs) {
            *to = square * from;
        }
        for (to, from) in system.pins.lambda.iter_mut().zip(system.rhs[n..].chunks_exact(2)) {
            *to = square * DVec2::new(from[0], from[1]);
        }
    }

    /// The first event up to `part`.
    fn first_event(&self, system: &System, order: usize, part: f64) -> Option<(f64, Event)> {
        let series = Series {
            dx: &self.dx[..=order],
            dy: &self.dy[..=order],
            lambda: &self.lambda[..=order - 2],
            hold: &self.grip.u[..=order - 2],
        };
        series.first_event(system, part)
    }
}

impl Run {
    fn fail(mut self) -> Outcome {
        self.outcome.failed = true;
        self.outcome.kept = false;
        self.outcome
    }

    /// Whether all steps have been taken that may be.
    fn is_spent(&self) -> bool {
        self.outcome.steps + self.outcome.retries >= self.budget
    }

    /// What a step over `part` of the time left may be wrong by [m].
    fn share(&self, part: f64) -> f64 {
        (self.tolerance * part * self.left / self.time).max(self.rounding)
    }
}

/// Makes room for n values of every order.
fn room(series: &mut Vec<Vec<f64>>, n: usize) {
    series.resize_with(HIGHEST_ORDER + 1, Vec::new);
    series.iter_mut().for_each(|values| values.resize(n, 0.0));
}

/// Order up to which terms are always looked at: what swings faster than the step can follow limits steps of lower order more than the
/// tolerance does, so that they cost more (heavy rope: 12 steps of order 7, 7 of order 10).
const STABLE_ORDER: usize = 10;

/// The order that costs least at a tolerance, given as a part of the size: −½ ln ε + 1 (Jorba and Zou).
fn highest_order(tolerance: f64) -> usize {
    let order = 1.0 - 0.5 * libm::log(tolerance.max(1e-18));
    (libm::ceil(order) as usize).clamp(STABLE_ORDER, HIGHEST_ORDER)
}
