//! Least squares by Householder reflections with column pivoting, and of all least-squares solutions the shortest.
//!
//! A P = Q R, where always the longest column left comes next. When what is left is no longer than rounding, the rank r is
//! found, and A ≈ Q [R₁ R₂; 0 0] Pᵀ. The shortest solution comes from a second factorisation [R₁ R₂]ᵀ = Z T (the complete
//! orthogonal decomposition). Golub and Van Loan, "Matrix Computations", sections 5.4 and 5.5.

use super::matrix::norm;
use super::reflectors::Reflectors;
use super::{DenseError, Matrix};

/// The factors of the last matrix; empty at first.
#[derive(Clone, Debug, Default)]
pub struct Qr {
    q: Reflectors,
    /// Column `order[k]` of A stands at place k.
    order: Vec<usize>,
    rank: usize,
    /// Of [R₁ R₂]ᵀ; unused if the rank is full.
    z: Reflectors,
    work: Vec<f64>,
}

impl Qr {
    /// Returns the rank: columns are independent while what is left of them is longer than `tolerance` times the longest
    /// column of A (1e-12 is a good value, and 0 asks for all). Any shape; about 2 m n² operations for m × n.
    ///
    /// # Errors
    /// [`DenseError::NotFinite`].
    pub fn factor(&mut self, matrix: &Matrix, tolerance: f64) -> Result<usize, DenseError> {
        if !matrix.is_finite() {
            return Err(DenseError::NotFinite);
        }
        let (m, n) = (matrix.rows(), matrix.columns());
        self.q.columns.transpose_from(matrix);
        self.q.restart();
        self.order.clear();
        self.order.extend(0..n);
        self.work.clear();
        self.work.resize(m.max(n), 0.0);
        self.rank = 0;
        let mut longest = 0.0;
        for k in 0..m.min(n) {
            let (column, length) = self.longest_column(k);
            longest = if k == 0 { length } else { longest };
            if length <= tolerance * longest {
                break;
            }
            self.q.columns.swap_rows(k, column);
            self.order.swap(k, column);
            self.q.reflect(k);
            self.rank += 1;
        }
        if self.rank < n {
            self.factor_rest();
        }
        Ok(self.rank)
    }

    /// Of the columns from k on, the one with the longest part below row k. Computed afresh each time: as costly as the
    /// reflections, and without the cancellation of the usual update.
    fn longest_column(&self, k: usize) -> (usize, f64) {
        let (mut longest, mut length) = (k, -1.0);
        for column in k..self.order.len() {
            let found = norm(&self.q.columns.row(column)[k..]);
            if found > length {
                (longest, length) = (column, found);
            }
        }
        (longest, length)
    }

    /// Z T = [R₁ R₂]ᵀ: its columns are the rows of R.
    fn factor_rest(&mut self) {
        let (r, n) = (self.rank, self.order.len());
        self.z.columns.reshape(r, n);
        self.z.restart();
        for row in 0..r {
            for column in 0..n {
                self.z.columns[(row, column)] = match column {
                    _ if column < row => 0.0,
                    _ if column == row => self.q.diagonal[row],
                    _ => self.q.columns[(column, row)],
                };
            }
        }
        (0..r).for_each(|k| self.z.reflect(k));
    }

    /// The x of least ‖b − A x‖₂, of all of them the one with least ‖x‖₂. Returns ‖b − A x‖₂.
    ///
    /// # Panics
    /// If `b` has not as many entries as the matrix rows, or `x` not as many as columns.
    pub fn solve(&mut self, b: &[f64], x: &mut [f64]) -> f64 {
        let (m, n, r) = (b.len(), self.order.len(), self.rank);
        assert_eq!((m, x.len()), (self.q.columns.columns(), n), "one right-hand side a row, one unknown a column");
        let work = &mut self.work;
        work[..m].copy_from_slice(b);
        self.q.turn_back(&mut work[..m]);
        let residual = norm(&work[r..m]);
        if r == n {
            self.q.solve_upper(&mut work[..n]);
        } else {
            self.z.solve_upper_transposed(&mut work[..r]);
            work[r..n].fill(0.0);
            self.z.turn(&mut work[..n]);
        }
        for (entry, &column) in work.iter().zip(&self.order) {
            x[column] = *entry;
        }
        residual
    }

    /// Of the last matrix.
    pub fn rank(&self) -> usize {
        self.rank
    }

    /// x = Q x; the first `rank` columns of Q span the columns of A, the others what is at right angles to them.
    pub(super) fn rotate(&self, x: &mut [f64]) {
        self.q.turn(x);
    }
}
