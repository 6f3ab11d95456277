//! A = L Lᵀ of a symmetric positive definite matrix: half the work of LU, and no exchange of rows is needed. It fails exactly
//! if the matrix is not positive definite, and is the cheapest test for that. Golub and Van Loan, "Matrix Computations",
//! section 4.2.

use super::elimination::square;
use super::matrix::dot;
use super::{DenseError, Matrix};

/// The factor of the last matrix; empty at first.
#[derive(Clone, Debug, Default)]
pub struct Cholesky {
    /// L in the lower triangle with the diagonal.
    factor: Matrix,
}

impl Cholesky {
    /// n³ / 3 operations. Only the lower triangle is read.
    ///
    /// # Errors
    /// [`DenseError::NotSquare`], [`DenseError::NotFinite`], or [`DenseError::NotPositive`] with the first row whose pivot is
    /// not positive: its constraint follows from those before it, or the matrix is indefinite. The factor is then of no use.
    pub fn factor(&mut self, matrix: &Matrix) -> Result<(), DenseError> {
        let n = square(matrix)?;
        self.factor.copy_from(matrix);
        for row in 0..n {
            for column in 0..row {
                let (own, above) = self.factor.two_rows(row, column);
                own[column] = (own[column] - dot(&own[..column], &above[..column])) / above[column];
            }
            let own = self.factor.row_mut(row);
            let pivot = own[row] - dot(&own[..row], &own[..row]);
            if !(pivot > 0.0) {
                return Err(DenseError::NotPositive { row, pivot });
            }
            own[row] = pivot.sqrt();
        }
        Ok(())
    }

    /// A x = b in place, 2 n² operations.
    ///
    /// # Panics
    /// If `b` has not as many entries as the matrix rows.
    pub fn solve(&self, b: &mut [f64]) {
        assert_eq!(b.len(), self.factor.rows(), "one right-hand side a row");
        for row in 0..b.len() {
            let (before, rest) = b.split_at_mut(row);
            let entries = self.factor.row(row);
            rest[0] = (rest[0] - dot(&entries[..row], before)) / entries[row];
        }
        for row in (0..b.len()).rev() {
            let entries = self.factor.row(row);
            let (before, rest) = b.split_at_mut(row);
            rest[0] /= entries[row];
            before.iter_mut().zip(entries).for_each(|(x, entry)| *x -= entry * rest[0]);
        }
    }
}
