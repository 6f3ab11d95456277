//! Events on a Taylor polynomial: a slack rope that tightens, a taut one that would have to push.
//!
//! Found as the first change of sign of |d|² − L² or of λ among equally spaced samples, then bisected. Two changes between two
//! samples are missed, which leaves a rope longer by less than the tolerance or goes unnoticed.

use crate::engine::island::System;

/// Samples within a step.
const SAMPLES: u32 = 8;

/// What happens to which rope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Event {
    rope: usize,
    taut: bool,
}

impl Event {
    /// Switches the rope's row; a rope that tightens takes the speed away that would stretch it.
    pub fn apply(self, system: &mut System) {
        system.rods.held[self.rope] = self.taut;
        system.factor();
        if self.taut {
            system.settle_velocities();
        } else {
            system.rods.lambda[self.rope] = 0.0;
        }
    }
}

/// The polynomials of a step.
pub(crate) struct Series<'a> {
    pub dx: &'a [Vec<f64>],
    pub dy: &'a [Vec<f64>],
    pub lambda: &'a [Vec<f64>],
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
                    x * x + y * y - system.rods.square[rope]
                }
            };
            if let Some(at) = first_change(sign, until) {
                first = Some((at, Event { rope, taut: !taut }));
            }
        }
        first
    }
}

fn value(series: &[Vec<f64>], i: usize, t: f64) -> f64 {
    series.iter().rev().fold(0.0, |sum, c| sum * t + c[i])
}

/// The first instant in (0, `until`] at which `sign` turns positive.
fn first_change(sign: impl Fn(f64) -> f64, until: f64) -> Option<f64> {
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
