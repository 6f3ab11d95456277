//! Springs that pass through zero length.
//!
//! There the direction of a spring's force turns over, and no series goes on behind: the polynomial stays on the branch that it began on.
//! A step ends just before such a passage, and the next `hop` goes across it in a time so short that the ends move in a straight line:
//! with d = d* + ḋ t, d* across ḋ, the pull k rest d/|d| gives the impulse
//!
//! ```text
//! k rest [ (√(y² + v² τ₂²) − √(y² + v² τ₁²)) n + (asinh(v τ₁/y) + asinh(v τ₂/y)) d* ] / v,   y = |d*|, v = |ḋ|, n = ḋ/v
//! ```
//!
//! from τ₁ before to τ₂ after the passage. All other forces act as in any step. Where the ends pass at a distance that a step can
//! resolve, the series does so by itself: its radius of convergence is y/v.

use super::polynomial::{value, value_rate};
use super::{Run, Taylor};
use crate::engine::island::System;
use glam::DVec2;

/// Samples within a step.
const SAMPLES: u32 = 8;
/// Way that the pull takes off a hop, in parts of the tolerance.
const PART: f64 = 1e-2;
/// A hop goes this often as far as the ends miss each other.
const NARROW: f64 = 10.0;
/// Order of the series that goes on without the pull.
const ORDER: usize = 4;

impl Taylor {
    /// Half the time of the hop that a spring needs [s].
    fn hop_time(&self, system: &System, spring: usize, run: &Run) -> f64 {
        let springs = &system.springs;
        let (a, b) = (springs.a[spring] as usize, springs.b[spring] as usize);
        let pull = springs.stiffness[spring] * springs.rest[spring] * (system.nodes.w[a] + system.nodes.w[b]);
        (PART * run.tolerance.max(run.rounding) / pull).sqrt()
    }

    /// The part of the time scale up to the hop of the first spring that passes through zero length within `part`, 0 where that lies at its
    /// start, and half the time of the hop [s].
    pub(super) fn first_passage(&mut self, system: &System, order: usize, part: f64, run: &Run) -> Option<(f64, f64)> {
        let springs = &system.springs;
        let mut first: Option<(f64, f64)> = None;
        for i in (0..springs.len()).filter(|i| springs.rest[*i] > 0.0 && springs.stiffness[*i] > 0.0) {
            if !self.comes_near(i, part) {
                continue;
            }
            let Some(at) = self.closest(i, order, first.map_or(part, |(until, _)| until)) else { continue };
            let time = self.hop_time(system, i, run);
            if !(time > 0.0) {
                continue;
            }
            let d = self.difference(i, order, at);
            let rate = self.difference_rate(i, order, at) / run.left;
            if NARROW * d.length() <= rate.length() * time {
                // Symmetric about the passage, within what is left of the time.
                let half = (time / run.left).min(1.0 - at).min(at);
                if half > 0.0 {
                    first = Some((at - half, half * run.left));
                }
            }
        }
        first
    }

    /// Whether a spring's ends may meet within `part` of the time scale, by the first terms of their difference.
    fn comes_near(&self, i: usize, part: f64) -> bool {
        let (mut most, mut power) = (0.0, 1.0);
        for k in 1..=3 {
            power *= part;
            let (x, y) = (power * self.springs.dx[k][i], power * self.springs.dy[k][i]);
            most += x * x + y * y;
        }
        // (a + b + c)² ≤ 3 (a² + b² + c²), and twice as far for what follows.
        self.springs.square[0][i] <= 12.0 * most
    }

    /// The first instant up to `until` at which a spring stops growing shorter.
    fn closest(&self, i: usize, order: usize, until: f64) -> Option<f64> {
        let grows = |t: f64| self.difference(i, order, t).dot(self.difference_rate(i, order, t)) >= 0.0;
        let mut low = 0.0;
        if grows(low) {
            return None;
        }
        for sample in 1..=SAMPLES {
            let mut high = until * f64::from(sample) / f64::from(SAMPLES);
            if grows(high) {
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if middle <= low || middle >= high {
                        break;
                    }
                    if grows(middle) { high = middle } else { low = middle }
                }
                return Some(high);
            }
            low = high;
        }
        None
    }

    fn difference(&self, i: usize, order: usize, t: f64) -> DVec2 {
        DVec2::new(value(&self.springs.dx[..=order], i, t), value(&self.springs.dy[..=order], i, t))
    }

    fn difference_rate(&self, i: usize, order: usize, t: f64) -> DVec2 {
        DVec2::new(value_rate(&self.springs.dx[..=order], i, t), value_rate(&self.springs.dy[..=order], i, t))
    }

    /// Whether the ends of some spring coincide and part, its series having no direction.
    pub(super) fn starts_at_zero(&self, system: &System) -> Option<usize> {
        let springs = &system.springs;
        let moves = |i: usize| self.springs.dx[1][i] != 0.0 || self.springs.dy[1][i] != 0.0;
        let pulls = |i: usize| springs.rest[i] > 0.0 && springs.stiffness[i] > 0.0;
        (0..springs.len()).find(|i| self.springs.square[0][*i] == 0.0 && pulls(*i) && moves(*i))
    }

    /// Goes on for the time of a hop from a start at zero length; `spring` tells how long.
    pub(super) fn hop_from_zero(&mut self, system: &mut System, spring: usize, run: &mut Run) {
        let time = self.hop_time(system, spring, run);
        self.hop(system, time, run);
    }

    /// Goes on for `time` [s], or what is left, across the zero length of all springs that pass through it.
    pub(super) fn hop(&mut self, system: &mut System, time: f64, run: &mut Run) {
        let scale = run.left;
        let part = (time / scale).min(1.0);
        let time = part * scale;
        let springs = &system.springs;
        self.passages.clear();
        self.springs.hidden.fill(false);
        for i in (0..springs.len()).filter(|i| springs.rest[*i] > 0.0) {
            let passage = Passage::of(system, i, time);
            if let Some(passage) = passage {
                self.passages.push(passage);
                self.springs.hidden[i] = true;
            }
        }
        self.expand_first(system, scale);
        (0..=ORDER - 2).for_each(|k| self.coefficient(system, scale, k));
        self.springs.hidden.fill(false);
        self.evaluate(system, ORDER, part, scale);
        if !system.turns() {
            self.passages.iter().for_each(|passage| passage.apply(system));
        }
        if !system.unconstrained() {
            system.project_positions();
            system.take_differences();
            system.project_velocities();
        }
        run.outcome.steps += 1;
        run.left = if part >= 1.0 { 0.0 } else { scale - time };
        if run.left > 0.0 {
            system.factor_if_constrained();
            self.begin(system, run.left);
        }
    }
}

/// What a spring's pull and damper do in a hop.
#[derive(Clone, Copy, Debug)]
pub(super) struct Passage {
    spring: usize,
    /// Impulse on b [N·s], and what moves it, to be divided by its mass [N·s²].
    impulse: DVec2,
    moment: DVec2,
}

impl Passage {
    /// Of spring i in the next `time` [s], if it passes through zero length.
    fn of(system: &System, i: usize, time: f64) -> Option<Passage> {
        let (nodes, springs) = (&system.nodes, &system.springs);
        let (a, b) = (springs.a[i] as usize, springs.b[i] as usize);
        let d = DVec2::new(nodes.x[b] - nodes.x[a], nodes.y[b] - nodes.y[a]);
        let rate = DVec2::new(nodes.vx[b] - nodes.vx[a], nodes.vy[b] - nodes.vy[a]);
        let square = rate.length_squared();
        // Written so that a NaN is none.
        if !(square > 0.0) {
            return None;
        }
        let before = -d.dot(rate) / square;
        if !(before >= 0.0 && before < time) {
            return None;
        }
        let (v, after) = (square.sqrt(), time - before);
        let n = rate / v;
        let across = d - n * d.dot(n);
        let y = across.length();
        let pull = springs.stiffness[i] * springs.rest[i];
        let reach = |t: f64| libm::hypot(y, v * t);
        let mut impulse = pull * (reach(after) - reach(before)) / v * n;
        if y > 0.0 {
            impulse += pull * (libm::asinh(v * before / y) + libm::asinh(v * after / y)) / v * across;
        }
        // Against the motion before, with it after the passage.
        let mut moment = pull * (0.5 * after * after - 0.5 * before * before - before * after) * n;
        impulse -= springs.damping[i] * time * rate;
        moment -= 0.5 * springs.damping[i] * time * time * rate;
        Some(Passage { spring: i, impulse, moment })
    }

    fn apply(&self, system: &mut System) {
        let (a, b) = (system.springs.a[self.spring] as usize, system.springs.b[self.spring] as usize);
        let nodes = &mut system.nodes;
        for (node, sign) in [(a, -1.0), (b, 1.0)] {
            let w = sign * nodes.w[node];
            nodes.vx[node] += w * self.impulse.x;
            nodes.vy[node] += w * self.impulse.y;
            nodes.x[node] += w * self.moment.x;
            nodes.y[node] += w * self.moment.y;
        }
    }
}
