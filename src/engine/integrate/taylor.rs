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
//! Time is scaled by the time that is left, so coefficient k is what term k contributes at its end.
//! Cost of a step of order P: P solves and about P² multiply-adds a rod, 6 P² a spring. It does not damp; stiff springs and
//! very tense light ropes need many steps.

mod turning;

use self::turning::TurningSeries;
use super::events::{Event, Series};
use super::outcome::Outcome;
use crate::engine::island::System;
use crate::engine::island::system::push;
use glam::DVec2;

/// Orders beyond this gain nothing in double precision.
const HIGHEST_ORDER: usize = 24;
const LOWEST_ORDER: usize = 4;
/// Part of the step that the estimate allows.
const SAFETY: f64 = 0.9;

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
    /// Of nodes, rods, rows and springs that there is room for.
    sizes: [usize; 4],
    fx: Vec<f64>,
    fy: Vec<f64>,
    gx: Vec<f64>,
    gy: Vec<f64>,
}

/// Series of the springs: d, s = |d|², p = 1/|d|, q = p², ρ = ½ ṡ q, σ = force on b over d.
#[derive(Debug, Default)]
struct SpringSeries {
    dx: Vec<Vec<f64>>,
    dy: Vec<Vec<f64>>,
    square: Vec<Vec<f64>>,
    inverse: Vec<Vec<f64>>,
    inverse_square: Vec<Vec<f64>>,
    rate: Vec<Vec<f64>>,
    factor: Vec<Vec<f64>>,
    sum: Vec<f64>,
}

/// Series of the mouse's force before the bound, its square, and 1 over its size.
#[derive(Debug, Default)]
struct GripSeries {
    u: Vec<DVec2>,
    square: Vec<f64>,
    inverse: Vec<f64>,
}

impl Taylor {
    /// Makes room for an island of `nodes`, `rods`, `rows` and `springs`.
    pub fn reserve(&mut self, system: &System) {
        self.turning.reserve(system);
        let (nodes, rods) = (system.nodes.len(), system.rods.a.len());
        let sizes = [nodes, rods, system.rhs.len(), system.springs.len()];
        if std::mem::replace(&mut self.sizes, sizes) == sizes {
            return;
        }
        let room = |series: &mut Vec<Vec<f64>>, n: usize| {
            series.resize_with(HIGHEST_ORDER + 1, Vec::new);
            series.iter_mut().for_each(|values| values.resize(n, 0.0));
        };
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
        let (s, n) = (&mut self.springs, system.springs.len());
        for series in
            [&mut s.dx, &mut s.dy, &mut s.square, &mut s.inverse, &mut s.inverse_square, &mut s.rate, &mut s.factor]
        {
            room(series, n);
        }
        s.sum.resize(n, 0.0);
        self.grip.u.resize(HIGHEST_ORDER + 1, DVec2::ZERO);
        self.grip.square.resize(HIGHEST_ORDER + 1, 0.0);
        self.grip.inverse.resize(HIGHEST_ORDER + 1, 0.0);
    }

    /// Carries the island through `time` [s] with local errors of about `tolerance` [m].
    pub fn advance(&mut self, system: &mut System, time: f64, tolerance: f64) -> Outcome {
        self.reserve(system);
        let mut outcome = Outcome::default();
        let highest = highest_order(tolerance / system.length);
        let mut left = time;
        let mut events = 0;
        let mut decided = false;
        if !system.meet_constraints() {
            outcome.failed = true;
            return outcome;
        }
        while left > 0.0 {
            if !decided {
                system.see_bound();
            }
            self.expand_first(system, left);
            let order = self.expand(system, left, tolerance, highest);
            let mut part = self.step_part(order, tolerance);
            if !(f64::from(outcome.steps) + 1.0 / part <= super::MOST_STEPS) {
                outcome.failed = true;
                return outcome;
            }
            let most_events = 64 + 8 * (system.rods.a.len() - system.rods.first_rope);
            let event = (events < most_events).then(|| self.first_event(system, order, part)).flatten();
            if let Some((at, _)) = event {
                (part, events) = (at, events + 1);
            }
            let Some(part) = self.go(system, order, part, left, tolerance, &mut outcome) else {
                outcome.failed = true;
                return outcome;
            };
            let event = event.filter(|(at, _)| *at == part);
            // At the root itself rounding would decide on which side of its bound the hold is.
            decided = matches!(event, Some((_, Event::Hold { .. })));
            if let Some((_, event)) = event {
                event.apply(system);
            }
            outcome.steps += 1;
            outcome.order = outcome.order.max(order as u32);
            outcome.error += self.last_term(order) * powi(part, order);
            left = if part >= 1.0 { 0.0 } else { left * (1.0 - part) };
            if left < 1e-12 * time {
                left = 0.0;
            }
        }
        outcome
    }

    /// Evaluates at `part` of the time scale and projects; a step that leaves the constraints farther than the tolerance allows
    /// is halved. Returns the part that was taken.
    fn go(
        &mut self,
        system: &mut System,
        order: usize,
        mut part: f64,
        scale: f64,
        tolerance: f64,
        outcome: &mut Outcome,
    ) -> Option<f64> {
        // A series that has converged is off the constraints by its own error.
        let most = (1e3 * tolerance / system.length).max(1e-12);
        loop {
            self.evaluate(system, order, part, scale);
            if system.unconstrained() {
                return system.nodes.x.iter().sum::<f64>().is_finite().then_some(part);
            }
            system.factor();
            let off = system.position_error();
            if off <= most {
                system.matrix.solve(&mut system.rhs);
                system.move_nodes();
                system.take_differences();
                system.project_velocities();
                return Some(part);
            }
            part *= 0.5;
            outcome.retries += 1;
            if !(part * super::MOST_STEPS > 1.0) {
                return None;
            }
        }
    }

    /// Coefficients 0 and 1.
    fn expand_first(&mut self, system: &System, scale: f64) {
        let nodes = &system.nodes;
        self.x[0].clone_from(&nodes.x);
        self.y[0].clone_from(&nodes.y);
        for (to, from) in self.x[1].iter_mut().zip(&nodes.vx).chain(self.y[1].iter_mut().zip(&nodes.vy)) {
            *to = scale * from;
        }
        self.dx[0].clone_from(&system.dx);
        self.dy[0].clone_from(&system.dy);
        self.take_differences(system, 1);
        if system.turns() {
            self.turning.expand_first(system, scale);
        }
        self.springs.take_differences(system, &self.x, &self.y, 0);
        self.springs.take_differences(system, &self.x, &self.y, 1);
    }

    /// All further coefficients; returns the order at which to stop.
    fn expand(&mut self, system: &mut System, scale: f64, tolerance: f64, highest: usize) -> usize {
        let mut before = f64::INFINITY;
        let mut order = 2;
        while order <= highest {
            self.coefficient(system, scale, order - 2);
            if order - 2 == 0 && system.release_pushing_ropes(&self.lambda[0]) {
                // The rows in force changed: once more from the start, with a matrix for those that are left.
                system.factor();
                continue;
            }
            let term = self.last_term(order);
            if order >= LOWEST_ORDER && term <= tolerance && before <= tolerance {
                return order;
            }
            before = term;
            order += 1;
        }
        highest
    }

    /// Coefficient k of the accelerations, hence k + 2 of the positions.
    fn coefficient(&mut self, system: &mut System, scale: f64, k: usize) {
        let square = scale * scale;
        let nodes = &system.nodes;
        self.fx.fill(0.0);
        self.fy.fill(0.0);
        if system.springs.len() > 0 {
            self.springs.add_force(system, scale, k, &mut self.fx, &mut self.fy);
        }
        if system.held.is_some() {
            self.add_grip(system, scale, k);
        }
        if system.turns() {
            self.gather_turning(system, scale, k);
        }
        // From forces to accelerations.
        for (((fx, fy), w), free) in self.fx.iter_mut().zip(&mut self.fy).zip(&nodes.w).zip(&nodes.free) {
            *fx *= w;
            *fy *= w;
            if k == 0 {
                *fx += free * square * system.gravity.x;
                *fy += free * square * system.gravity.y;
            }
        }
        if system.drag > 0.0 {
            let rate = system.drag * scale * (k + 1) as f64;
            for (i, free) in nodes.free.iter().enumerate() {
                self.fx[i] -= free * rate * self.x[k + 1][i];
                self.fy[i] -= free * rate * self.y[k + 1][i];
            }
        }
        if system.turns() {
            self.know_turning(system, k);
        }
        if !system.unconstrained() {
            self.constrain(system, k);
        }
        let over = 1.0 / ((k + 1) * (k + 2)) as f64;
        for (to, f) in self.x[k + 2].iter_mut().zip(&self.fx).chain(self.y[k + 2].iter_mut().zip(&self.fy)) {
            *to = over * f;
        }
        if system.turns() {
            self.finish_turning(system, k);
        }
        self.take_differences(system, k + 2);
        self.springs.take_differences(system, &self.x, &self.y, k + 2);
    }

    /// Adds what the constraints contribute to acceleration k.
    fn constrain(&mut self, system: &mut System, k: usize) {
        let rods = &system.rods;
        let n = rods.a.len();
        if k > 0 && n > 0 && !system.turns() {
            self.know_pulls(k);
            rods.pairs.add_weighted(&system.nodes.w, &self.gx, &mut self.fx);
            rods.pairs.add_weighted(&system.nodes.w, &self.gy, &mut self.fy);
        }
        // −½ N (N−1) Σ_{0<j<N} d_j·d_{N−j} − d₀·(a_b − a_a)
        let order = k + 2;
        let sum = &mut self.gx;
        sum.fill(0.0);
        for j in 1..=(order - 1) / 2 {
            add_product(sum, &self.dx[j], &self.dx[order - j]);
            add_product(sum, &self.dy[j], &self.dy[order - j]);
        }
        let whole = ((k + 1) * (k + 2)) as f64;
        let half = order / 2;
        let even = order.is_multiple_of(2);
        let rhs = &mut self.lambda[k];
        for r in 0..n {
            let mut s = sum[r];
            if even {
                s += 0.5 * (self.dx[half][r] * self.dx[half][r] + self.dy[half][r] * self.dy[half][r]);
            }
            let (a, b) = (rods.a[r] as usize, rods.b[r] as usize);
            let along = system.dx[r] * (self.fx[b] - self.fx[a]) + system.dy[r] * (self.fy[b] - self.fy[a]);
            rhs[r] = -whole * s - along;
        }
        for (rhs, held) in rhs.iter_mut().zip(&rods.held).skip(rods.first_rope) {
            *rhs = if *held { *rhs } else { 0.0 };
        }
        for ((a, b), rhs) in system.pins.a.iter().zip(&system.pins.b).zip(rhs[n..].chunks_exact_mut(2)) {
            let (a, b) = (*a as usize, *b as usize);
            rhs[0] = self.fx[a] - self.fx[b];
            rhs[1] = self.fy[a] - self.fy[b];
        }
        system.matrix.solve(rhs);
        if system.turns() {
            return self.push_turning(system, k);
        }
        let d = (&system.dx[..], &system.dy[..]);
        push(&system.nodes.w, &system.rods, &system.pins, d, rhs, &mut self.fx, &mut self.fy);
    }

    /// What is known of the rods' pulls by their multipliers: Σ_{j=1}^{k} d_j λ_{k−j}.
    fn know_pulls(&mut self, k: usize) {
        self.gx.fill(0.0);
        self.gy.fill(0.0);
        for j in 1..=k {
            add_product(&mut self.gx, &self.dx[j], &self.lambda[k - j]);
            add_product(&mut self.gy, &self.dy[j], &self.lambda[k - j]);
        }
    }

    /// d_k of the rods.
    fn take_differences(&mut self, system: &System, k: usize) {
        system.rods.pairs.differences(&self.x[k], &mut self.dx[k]);
        system.rods.pairs.differences(&self.y[k], &mut self.dy[k]);
    }

    /// Adds coefficient k of the mouse's force, times the scale squared.
    fn add_grip(&mut self, system: &System, scale: f64, k: usize) {
        let Some(held) = &system.held else { return };
        let (i, grip) = (held.node, &mut self.grip);
        let at = |k: usize| DVec2::new(self.x[k][i], self.y[k][i]);
        let away = if k == 0 { at(0) - held.target } else { at(k) };
        grip.u[k] = -held.stiffness * away - held.damping / scale * (k + 1) as f64 * at(k + 1);
        let mut force = grip.u[k];
        if held.bounded {
            grip.square[k] = (0..=k).map(|j| grip.u[j].dot(grip.u[k - j])).sum();
            grip.inverse[k] = if k == 0 {
                1.0 / grip.square[0].sqrt()
            } else {
                let term = |j: usize| (-0.5 * j as f64 - (k - j) as f64) * grip.square[j] * grip.inverse[k - j];
                (1..=k).map(term).sum::<f64>() / (k as f64 * grip.square[0])
            };
            force = (0..=k).map(|j| held.most * grip.inverse[j] * grip.u[k - j]).sum();
        }
        self.fx[i] += scale * scale * force.x;
        self.fy[i] += scale * scale * force.y;
    }

    /// Largest contribution of the term of this order at the end of the time scale [m].
    fn last_term(&self, order: usize) -> f64 {
        let largest = |values: &[f64]| values.iter().fold(0.0f64, |m, v| m.max(v.abs()));
        largest(&self.x[order]).max(largest(&self.y[order])).max(self.turning.last_term(order))
    }

    /// The part of the time scale that the last two terms allow; the time left is cut into equal steps.
    fn step_part(&self, order: usize, tolerance: f64) -> f64 {
        let allowed = |order: usize| {
            let term = self.last_term(order);
            if term > 0.0 { libm::pow(tolerance / term, 1.0 / order as f64) } else { f64::INFINITY }
        };
        let part = SAFETY * allowed(order).min(allowed(order - 1));
        if allowed(order) >= 1.0 && allowed(order - 1) >= 1.0 { 1.0 } else { 1.0 / libm::ceil(1.0 / part) }
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

impl SpringSeries {
    fn take_differences(&mut self, system: &System, x: &[Vec<f64>], y: &[Vec<f64>], k: usize) {
        system.springs.pairs.differences(&x[k], &mut self.dx[k]);
        system.springs.pairs.differences(&y[k], &mut self.dy[k]);
    }

    /// Adds coefficient k of the springs' forces, times the scale squared.
    fn add_force(&mut self, system: &System, scale: f64, k: usize, fx: &mut [f64], fy: &mut [f64]) {
        let springs = &system.springs;
        if k == 0 {
            self.take_square(0);
        }
        if springs.damped {
            self.take_square(k + 1);
        } else if k > 0 {
            self.take_square(k);
        }
        self.take_inverse(k);
        let square = scale * scale;
        for i in 0..springs.len() {
            let constant = if k == 0 { -springs.stiffness[i] } else { 0.0 };
            self.factor[k][i] = square * (constant + springs.stiffness[i] * springs.rest[i] * self.inverse[k][i]);
        }
        if springs.damped {
            self.take_rate(k);
            for i in 0..springs.len() {
                self.factor[k][i] -= scale * springs.damping[i] * self.rate[k][i];
            }
        }
        for (d, f) in [(&self.dx, fx), (&self.dy, fy)] {
            self.sum.fill(0.0);
            for j in 0..=k {
                add_product(&mut self.sum, &self.factor[j], &d[k - j]);
            }
            springs.pairs.add(&self.sum, f);
        }
    }

    /// s_k = Σ d_j·d_{k−j}
    fn take_square(&mut self, k: usize) {
        let to = &mut self.square[k];
        to.fill(0.0);
        for j in 0..=k {
            add_product(to, &self.dx[j], &self.dx[k - j]);
            add_product(to, &self.dy[j], &self.dy[k - j]);
        }
    }

    /// p = s^(−½): p_k = Σ_{j=1}^{k} (−½ j − (k − j)) s_j p_{k−j} / (k s₀); 0 for coinciding ends, which have no direction.
    fn take_inverse(&mut self, k: usize) {
        let (before, after) = self.inverse.split_at_mut(k);
        let to = &mut after[0];
        if k == 0 {
            to.iter_mut().zip(&self.square[0]).for_each(|(p, s)| *p = if *s > 0.0 { 1.0 / s.sqrt() } else { 0.0 });
            return;
        }
        to.fill(0.0);
        for j in 1..=k {
            let weight = -0.5 * j as f64 - (k - j) as f64;
            for ((to, s), p) in to.iter_mut().zip(&self.square[j]).zip(&before[k - j]) {
                *to += weight * s * p;
            }
        }
        for (to, s) in to.iter_mut().zip(&self.square[0]) {
            *to = if *s > 0.0 { *to / (k as f64 * s) } else { 0.0 };
        }
    }

    /// ρ_k = ½ Σ (j + 1) s_{j+1} q_{k−j}, q = p².
    fn take_rate(&mut self, k: usize) {
        let to = &mut self.inverse_square[k];
        to.fill(0.0);
        (0..=k).for_each(|j| add_product(to, &self.inverse[j], &self.inverse[k - j]));
        let to = &mut self.rate[k];
        to.fill(0.0);
        for j in 0..=k {
            let weight = 0.5 * (j + 1) as f64;
            for ((to, s), q) in to.iter_mut().zip(&self.square[j + 1]).zip(&self.inverse_square[k - j]) {
                *to += weight * s * q;
            }
        }
    }
}

/// The order that costs least at a tolerance, given as a part of the size: −½ ln ε + 1 (Jorba and Zou).
fn highest_order(tolerance: f64) -> usize {
    let order = 1.0 - 0.5 * libm::log(tolerance.max(1e-18));
    (libm::ceil(order) as usize).clamp(LOWEST_ORDER, HIGHEST_ORDER)
}

#[inline]
fn add_product(to: &mut [f64], a: &[f64], b: &[f64]) {
    for ((to, a), b) in to.iter_mut().zip(a).zip(b) {
        *to += a * b;
    }
}

/// Σ c_k tᵏ
fn horner(c: &[Vec<f64>], order: usize, t: f64, to: &mut [f64]) {
    to.copy_from_slice(&c[order]);
    for k in (0..order).rev() {
        to.iter_mut().zip(&c[k]).for_each(|(to, c)| *to = *to * t + c);
    }
}

/// Σ k c_k tᵏ⁻¹ / scale
fn horner_rate(c: &[Vec<f64>], order: usize, t: f64, scale: f64, to: &mut [f64]) {
    to.iter_mut().zip(&c[order]).for_each(|(to, c)| *to = order as f64 * c);
    for k in (1..order).rev() {
        to.iter_mut().zip(&c[k]).for_each(|(to, c)| *to = *to * t + k as f64 * c);
    }
    to.iter_mut().for_each(|to| *to /= scale);
}

fn powi(base: f64, exponent: usize) -> f64 {
    (0..exponent).fold(1.0, |product, _| product * base)
}
