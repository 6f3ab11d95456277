//! Events on a Taylor polynomial: a slack rope that tightens, a taut one that would have to push, the mouse's force that meets its
//! bound or leaves it.
//!
//! Found as the first change of sign of |d|² − L², of λ or of |u|² − f² among equally spaced samples, then bisected. Two changes
//! between two samples are missed, which leaves a rope longer by less than the tolerance or goes unnoticed.

use crate::engine::island::System;
use glam::DVec2;

/// Samples within a step.
const SAMPLES: u32 = 8;
/// A rope that was just let go is at its length but for rounding; it tightens anew only beyond this part of L².
pub(super) const ROUNDING: f64 = 1e-13;

/// What happens, to which rope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Event {
    Rope { rope: usize, taut: bool },
    Hold { bounded: bool },
}

impl Event {
    /// Switches the rope's row; a rope that tightens takes the speed away that would stretch it.
    pub fn apply(self, system: &mut System) {
        match self {
            Event::Rope { rope, taut: true } => system.take_in(rope),
            Event::Rope { rope, taut: false } => {
                system.rods.held[rope] = false;
                system.rods.lambda[rope] = 0.0;
                system.factor();
            }
            Event::Hold { bounded } => {
                if let Some(held) = &mut system.held {
                    held.bounded = bounded;
                }
            }
        }
    }
}

/// The polynomials of a step.
pub(crate) struct Series<'a> {
    pub dx: &'a [Vec<f64>],
    pub dy: &'a [Vec<f64>],
    pub lambda: &'a [Vec<f64>],
    /// The hold's force before its bound.
    pub hold: &'a [DVec2],
}

impl Series<'_> {
    /// The first event in (0, `part`].
    pub fn first_event(&self, system: &System, part: f64) -> Option<(f64, Event)> {
        let mut first: Option<(f64, Event)> = None;
        for rope in system.rods.first_rope..system.rods.a.len() {
            let until = first.map_or(part, |(at, _)| at);
            let taut = system.rods.held[rope];
            // Positive once it has happened.
            let sign = |t: f64| {
                if taut {
                    value(self.lambda, rope, t)
                } else {
                    let (x, y) = (value(self.dx, rope, t), value(self.dy, rope, t));
                    let beyond = x * x + y * y - (1.0 + ROUNDING) * system.rods.square[rope];
                    // One that was let go a little too long, and grows shorter, does not tighten.
                    let parting = x * rate(self.dx, rope, t) + y * rate(self.dy, rope, t);
                    beyond.min(parting)
                }
            };
            if let Some(at) = first_change(sign, until) {
                first = Some((at, Event::Rope { rope, taut: !taut }));
            }
        }
        // A bound of nothing has no direction to come back from.
        if let Some(held) = system.held.as_ref().filter(|held| held.most > 0.0) {
            let until = first.map_or(part, |(at, _)| at);
            let excess = |t: f64| {
                let force = self.hold.iter().rev().fold(DVec2::ZERO, |sum, c| sum * t + *c) / held.most;
                let excess = force.length_squared() - 1.0;
                if held.bounded { -excess } else { excess }
            };
            if let Some(at) = first_change(excess, until) {
                first = Some((at, Event::Hold { bounded: !held.bounded }));
            }
        }
        first
    }
}

fn value(series: &[Vec<f64>], i: usize, t: f64) -> f64 {
    series.iter().rev().fold(0.0, |sum, c| sum * t + c[i])
}

/// The derivative of the same.
fn rate(series: &[Vec<f64>], i: usize, t: f64) -> f64 {
    series.iter().enumerate().skip(1).rev().fold(0.0, |sum, (k, c)| sum * t + k as f64 * c[i])
}

/// The first instant in (0, `until`] at which `sign` turns positive.
pub(super) fn first_change(sign: impl Fn(f64) -> f64, until: f64) -> Option<f64> {
    let mut low = 0.0;
    for sample in 1..=SAMPLES {
        let mut high = until * f64::from(sample) / f64::from(SAMPLES);
        if sign(high) > 0.0 {
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if middle <= low || middle >= high {
                    break;
                }
                if sign(middle) > 0.0 { high = middle } else { low = middle }
            }
            return (high > 0.0).then_some(high);
        }
        low = high;
    }
    None
}
