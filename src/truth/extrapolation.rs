//! Extrapolation of the explicit midpoint rule (Gragg, Bulirsch, Stoer) with order and step chosen as it goes.
//!
//! A step of length h is done with 2, 4, 6, … substeps; the error of each is a series in the square of the substep, whose
//! terms the Aitken-Neville scheme removes one by one. Column k has order 2k and costs k(k + 1) evaluations.
//! Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, section II.9. Without Gragg's smoothing,
//! which buys stability that accuracy of this kind does not need.

use super::double_double::{DoubleDouble, Vector};
use super::system::System;

/// The column that a step aims at: near the least work for tolerances around 1e-20.
const AIM: usize = 12;
/// Columns after which a step is given up.
const MOST: usize = 14;

/// A stepper with its scratch memory.
#[derive(Clone, Debug)]
pub(super) struct Extrapolation {
    /// Largest accepted estimate of a step's error, relative to the extent.
    tolerance: f64,
    /// Size of the scene [m].
    extent: f64,
    /// The last row of the scheme: entry k has order 2(k + 1).
    row: Vec<Vec<Vector>>,
    slope: Vec<Vector>,
    middle_slope: Vec<Vector>,
    /// Two consecutive states of the midpoint rule.
    pair: [Vec<Vector>; 2],
}

/// What became of a step.
pub(super) struct Outcome {
    pub accepted: bool,
    /// The length that the next one should have [s].
    pub next: f64,
}

impl Extrapolation {
    pub(super) fn new(tolerance: f64, extent: f64, size: usize) -> Extrapolation {
        let zero = vec![Vector::ZERO; size];
        Extrapolation {
            tolerance,
            extent,
            row: vec![zero.clone(); MOST],
            slope: zero.clone(),
            middle_slope: zero.clone(),
            pair: [zero.clone(), zero],
        }
    }

    /// Tries a step of `h` [s]; the state stays as it was unless it is accepted.
    pub(super) fn step(&mut self, system: &mut System, state: &mut [Vector], h: DoubleDouble) -> Outcome {
        system.derivative(state, &mut self.slope);
        let mut previous = f64::INFINITY;
        for column in 0..MOST {
            self.midpoint(system, state, h, column);
            let error = self.extrapolate(column);
            if error <= 1.0 {
                state.copy_from_slice(&self.row[column]);
                return Outcome { accepted: true, next: h.value() * growth(error, column) };
            }
            // A scheme that no longer converges, or never will: no use going on.
            let hopeless = column + 2 >= AIM && error > previous || error.is_nan();
            if hopeless {
                break;
            }
            previous = error;
        }
        Outcome { accepted: false, next: 0.4 * h.value() }
    }

    /// The explicit midpoint rule over `h` in 2(column + 1) substeps, into `pair[1]`.
    fn midpoint(&mut self, system: &mut System, state: &[Vector], h: DoubleDouble, column: usize) {
        let substeps = 2 * (column + 1);
        let substep = h / DoubleDouble::from(substeps as f64);
        let double = substep.scaled(2.0);
        let [before, now] = &mut self.pair;
        before.copy_from_slice(state);
        for ((now, start), slope) in now.iter_mut().zip(state).zip(&self.slope) {
            *now = *start + slope.times(substep);
        }
        for _ in 1..substeps {
            system.derivative(now, &mut self.middle_slope);
            for (before, slope) in before.iter_mut().zip(&self.middle_slope) {
                *before = *before + slope.times(double);
            }
            std::mem::swap(before, now);
        }
    }

    /// Adds a row that begins with `pair[1]` to the scheme and returns the distance of its last two columns, in tolerances.
    /// A velocity counts by the way that it makes in a second.
    fn extrapolate(&mut self, column: usize) -> f64 {
        let [_, new] = &mut self.pair;
        let mut error = f64::INFINITY;
        for k in 0..column {
            // T(j, k + 1) = T(j, k) + (T(j, k) − T(j − 1, k)) / ((n(j)/n(j − k − 1))² − 1), n(j) = 2(j + 1)
            let (n, m) = ((column + 1) as f64, (column - k) as f64);
            let weight = DoubleDouble::from(m * m) / DoubleDouble::from(n * n - m * m);
            let mut worst = 0.0_f64;
            for (current, above) in new.iter_mut().zip(&mut self.row[k]) {
                let correction = (*current - *above).times(weight);
                *above = *current;
                *current = *current + correction;
                let size = correction.size();
                // NaN must not be lost, as `max` would.
                worst = if size <= worst { worst } else { size };
            }
            error = worst / (self.tolerance * self.extent);
        }
        self.row[column].copy_from_slice(new);
        error
    }
}

/// By how much the next step may be longer, given the error in tolerances at the column that met it.
fn growth(error: f64, column: usize) -> f64 {
    let power = -1.0 / (2 * column + 1) as f64;
    let same_column = 0.9 * libm::pow(error.max(1e-12), power);
    // Met early: a longer step with more columns does more work an evaluation.
    if column + 1 < AIM { same_column.max(1.0) * 1.3 } else { same_column.min(1.5) }
}
