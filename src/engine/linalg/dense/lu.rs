//! P A = L U: elimination that remembers its multipliers, so that another right-hand side costs n² instead of n³.
//! Golub and Van Loan, "Matrix Computations", section 3.4.

use super::elimination::{pivot_row, square, substitute_backwards};
use super::matrix::{dot, subtract_multiple};
use super::{DenseError, Matrix};

/// The factors of the last matrix; empty at first.
#[derive(Clone, Debug, Default)]
pub struct Lu {
    /// U in the upper triangle, the multipliers of L (its diagonal is 1) below.
    factors: Matrix,
    /// Row `column` was swapped with row `swaps[column]`.
    swaps: Vec<usize>,
}

impl Lu {
    /// 2 n³ / 3 operations.
    ///
    /// # Errors
    /// As [`eliminate`](super::elimination::eliminate). The factors are then of no use.
    pub fn factor(&mut self, matrix: &Matrix) -> Result<(), DenseError> {
        let n = square(matrix)?;
        self.factors.copy_from(matrix);
        self.swaps.clear();
        for column in 0..n {
            let pivot = pivot_row(&self.factors, column)?;
            self.factors.swap_rows(column, pivot);
            self.swaps.push(pivot);
            for row in column + 1..n {
                let (target, source) = self.factors.two_rows(row, column);
                let factor = target[column] / source[column];
                target[column] = factor;
                subtract_multiple(&mut target[column + 1..], factor, &source[column + 1..]);
            }
        }
        Ok(())
    }

    /// A x = b in place, 2 n² operations.
    ///
    /// # Panics
    /// If `b` has not as many entries as the matrix rows.
    pub fn solve(&self, b: &mut [f64]) {
        assert_eq!(b.len(), self.swaps.len(), "one right-hand side a row");
        for (row, &swap) in self.swaps.iter().enumerate() {
            b.swap(row, swap);
        }
        for row in 1..b.len() {
            let (before, rest) = b.split_at_mut(row);
            rest[0] -= dot(&self.factors.row(row)[..row], before);
        }
        substitute_backwards(&self.factors, b);
    }

    /// The product of the pivots, with the sign of the swaps.
    pub fn determinant(&self) -> f64 {
        let pivots = self.swaps.iter().enumerate();
        pivots.map(|(k, &swap)| if swap == k { self.factors[(k, k)] } else { -self.factors[(k, k)] }).product()
    }
}
