//! Whether a finished step is believed: what it leaves of the equations where it ends.
//!
//! With x = p + c t^(P+1) + … the polynomial p of order P leaves x'' − p'' = P (P + 1) c t^(P−1), so that the error of a step of h seconds
//! is h²/(P (P + 1)) times what is left at its end. That holds whatever the terms before looked like: where orders vanish, where a
//! stiff part has decayed out of sight, where a force has a corner.

use super::Run;
use super::polynomial::horner_second;
use crate::engine::island::System;

/// A step that is taken back grows shorter by at least the first, by at most the second.
const SHRINK: [f64; 2] = [0.7, 0.1];
/// Part of the step that would be just as wrong as allowed.
const SAFETY: f64 = 0.85;
/// How fast trust in the terms grows from step to step, and the most.
const GROWTH: f64 = 1.25;
const MOST_TRUST: f64 = 2.0;
/// Where the defect is smaller than this part of the farthest coordinate over h², and shrinks no faster with the step than rounding
/// does, there is nothing to gain from smaller steps.
const NOISE: f64 = 1e-12;

/// What to do with a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    Taken,
    /// To be done once more from its start.
    Refused,
}

/// The island at the start of a step, and what the step says of the accelerations at its end.
#[derive(Debug, Default)]
pub(super) struct Judge {
    start: [Vec<f64>; 4],
    angle: Vec<f64>,
    omega: Vec<f64>,
    ax: Vec<f64>,
    ay: Vec<f64>,
    /// Error and part of the attempt before, from the same start.
    refused: Option<(f64, f64)>,
}

impl Judge {
    /// Makes room for the island.
    pub fn reserve(&mut self, system: &System) {
        let (nodes, rotors) = (system.nodes.len(), system.turning.rotors.angle.len());
        self.start.iter_mut().chain([&mut self.ax, &mut self.ay]).for_each(|values| values.resize(nodes, 0.0));
        [&mut self.angle, &mut self.omega].into_iter().for_each(|values| values.resize(rotors, 0.0));
    }

    /// Forgets all attempts: a run begins.
    pub fn forget(&mut self) {
        self.refused = None;
    }

    /// Keeps the start of a step.
    pub fn keep(&mut self, system: &System) {
        let nodes = &system.nodes;
        for (to, from) in self.start.iter_mut().zip([&nodes.x, &nodes.y, &nodes.vx, &nodes.vy]) {
            to.copy_from_slice(from);
        }
        if system.turns() {
            self.angle.copy_from_slice(&system.turning.rotors.angle);
            self.omega.copy_from_slice(&system.turning.rotors.omega);
        }
    }

    /// Goes back to it.
    pub fn restore(&self, system: &mut System) {
        for (to, from) in system.nodes.coordinates().into_iter().zip(&self.start) {
            to.copy_from_slice(from);
        }
        if system.turns() {
            system.turning.rotors.angle.copy_from_slice(&self.angle);
            system.turning.rotors.omega.copy_from_slice(&self.omega);
            system.turning.place(&mut system.nodes);
        }
        system.factor_if_constrained();
    }

    /// Takes the second derivatives of the polynomials at `part` of the time scale.
    pub fn expect(&mut self, x: &[Vec<f64>], y: &[Vec<f64>], order: usize, part: f64, scale: f64) {
        for (to, from) in [(&mut self.ax, x), (&mut self.ay, y)] {
            horner_second(from, order, part, scale, to);
        }
    }

    /// Largest difference of the accelerations from what was expected [m/s²], which are 2/scale² times their coefficients; infinite if one
    /// of them is no number.
    pub fn defect(&self, x: &[f64], y: &[f64], scale: f64) -> f64 {
        largest_difference(&self.ax, x, scale).max(largest_difference(&self.ay, y, scale))
    }

    /// Whether a step of this order over `part` of the time left with this error [m] is taken; one that is not changes what the next
    /// attempt does.
    pub fn verdict(&mut self, error: f64, (order, part): (usize, f64), run: &mut Run) -> Verdict {
        let share = run.share(part);
        let before = self.refused.take();
        if error <= share || self.is_noise(error, (order, part), before, run) {
            run.whole = false;
            let longer = libm::pow(share / error.max(1e-3 * share), 1.0 / order as f64);
            let trust = SAFETY * longer * part / run.allowed;
            // Never less than it was for a step that was taken: where rounding is all that is left, steps would only shrink.
            run.trust = trust.clamp(run.trust.min(super::TRUST), run.trust * GROWTH).min(MOST_TRUST);
            return Verdict::Taken;
        }
        if order < run.highest && !run.whole {
            // Orders have vanished: the series ended too early.
            run.whole = true;
            return Verdict::Refused;
        }
        self.refused = Some((error, part));
        let shorter = libm::pow(share / error, 1.0 / order as f64);
        run.trust *= shorter.clamp(SHRINK[1], SHRINK[0]);
        Verdict::Refused
    }

    /// Whether an error is what rounding leaves: it has not shrunk with the step as an error of this order does.
    fn is_noise(&self, error: f64, (order, part): (usize, f64), before: Option<(f64, f64)>, run: &Run) -> bool {
        let defect = error * (order * (order + 1)) as f64;
        let shrunk = |(error_before, part_before): (f64, f64)| {
            let by = part / part_before;
            error > error_before * by * by * by
        };
        defect < NOISE / super::ROUNDING * run.rounding && before.is_some_and(shrunk)
    }
}

/// The largest |2 c/scale² − a|, infinite if one is no number.
pub(super) fn largest_difference(a: &[f64], c: &[f64], scale: f64) -> f64 {
    let factor = 2.0 / (scale * scale);
    a.iter().zip(c).fold(0.0f64, |most, (a, c)| {
        let difference = (factor * c - a).abs();
        // Written so that a NaN counts as the largest.
        if difference <= most {
            most
        } else if difference.is_nan() {
            f64::INFINITY
        } else {
            difference
        }
    })
}
