//! Householder reflections H = I − β v vᵀ, with which a matrix is made triangular. Golub and Van Loan, "Matrix Computations",
//! section 5.1. The columns of the matrix in work are kept as rows, so that a reflection runs along memory.

use super::Matrix;
use super::matrix::{dot, norm, subtract_multiple};

/// Q R of a matrix whose columns are the rows of `columns`: R on and above the diagonal, the v (with v₀ stored, not 1) below
/// and on it; the diagonal of R stands apart.
#[derive(Clone, Debug, Default)]
pub(super) struct Reflectors {
    pub(super) columns: Matrix,
    pub(super) diagonal: Vec<f64>,
    beta: Vec<f64>,
}

impl Reflectors {
    /// Forgets the reflections, for a new matrix in `columns`.
    pub(super) fn restart(&mut self) {
        self.diagonal.clear();
        self.beta.clear();
    }

    /// Makes column k zero below its entry k and applies the reflection to the columns after it.
    pub(super) fn reflect(&mut self, k: usize) {
        let column = &mut self.columns.row_mut(k)[k..];
        let length = norm(column);
        // Away from the entry, so that nothing cancels.
        let target = if column[0] > 0.0 { -length } else { length };
        self.diagonal.push(target);
        if length == 0.0 {
            self.beta.push(0.0);
            return;
        }
        column[0] -= target;
        // v is scaled to the largest entry 1 or so: β neither over- nor underflows.
        column.iter_mut().for_each(|v| *v /= length);
        self.beta.push(2.0 / dot(column, column));
        for other in k + 1..self.columns.rows() {
            let (other, own) = self.columns.two_rows(other, k);
            let factor = self.beta[k] * dot(&own[k..], &other[k..]);
            subtract_multiple(&mut other[k..], factor, &own[k..]);
        }
    }

    fn apply(&self, k: usize, x: &mut [f64]) {
        let v = &self.columns.row(k)[k..];
        let factor = self.beta[k] * dot(v, &x[k..]);
        subtract_multiple(&mut x[k..], factor, v);
    }

    /// x = Qᵀ x.
    pub(super) fn turn_back(&self, x: &mut [f64]) {
        (0..self.beta.len()).for_each(|k| self.apply(k, x));
    }

    /// x = Q x.
    pub(super) fn turn(&self, x: &mut [f64]) {
        (0..self.beta.len()).rev().for_each(|k| self.apply(k, x));
    }

    /// R x = b in place for the leading part of R of the length of b.
    pub(super) fn solve_upper(&self, b: &mut [f64]) {
        for k in (0..b.len()).rev() {
            b[k] /= self.diagonal[k];
            let (before, x) = b.split_at_mut(k);
            subtract_multiple(before, x[0], self.columns.row(k));
        }
    }

    /// Rᵀ x = b in place for the leading part of R of the length of b.
    pub(super) fn solve_upper_transposed(&self, b: &mut [f64]) {
        for k in 0..b.len() {
            let (before, x) = b.split_at_mut(k);
            x[0] = (x[0] - dot(before, self.columns.row(k))) / self.diagonal[k];
        }
    }
}
