//! Gaussian elimination with partial pivoting: of all rows left, the one with the largest entry in the column eliminates it
//! from the others, so that no multiplier exceeds 1. Golub and Van Loan, "Matrix Computations", section 3.4.

use super::matrix::{dot, subtract_multiple};
use super::{DenseError, Matrix};

/// A x = b: the solution replaces `b`, and the matrix is used up (it becomes upper triangular). 2 n³ / 3 operations.
///
/// # Errors
/// [`DenseError::NotSquare`], [`DenseError::NotFinite`], or [`DenseError::Singular`] if a whole column is exactly 0. Rounding
/// mostly leaves a singular matrix some tiny pivot; whether a solution can be trusted, the condition number says.
///
/// # Panics
/// If `b` has not as many entries as the matrix rows.
pub fn eliminate(matrix: &mut Matrix, b: &mut [f64]) -> Result<(), DenseError> {
    let n = square(matrix)?;
    assert_eq!(b.len(), n, "one right-hand side a row");
    for column in 0..n {
        let pivot = pivot_row(matrix, column)?;
        matrix.swap_rows(column, pivot);
        b.swap(column, pivot);
        for row in column + 1..n {
            let (target, source) = matrix.two_rows(row, column);
            let factor = target[column] / source[column];
            target[column] = 0.0;
            subtract_multiple(&mut target[column + 1..], factor, &source[column + 1..]);
            b[row] -= factor * b[column];
        }
    }
    substitute_backwards(matrix, b);
    Ok(())
}

/// The number of rows of a square matrix of finite numbers.
pub(super) fn square(matrix: &Matrix) -> Result<usize, DenseError> {
    if matrix.rows() != matrix.columns() {
        return Err(DenseError::NotSquare { rows: matrix.rows(), columns: matrix.columns() });
    }
    if !matrix.is_finite() {
        return Err(DenseError::NotFinite);
    }
    Ok(matrix.rows())
}

/// The row from `column` on with the largest entry in that column.
pub(super) fn pivot_row(matrix: &Matrix, column: usize) -> Result<usize, DenseError> {
    let mut pivot = column;
    for row in column + 1..matrix.rows() {
        if matrix[(row, column)].abs() > matrix[(pivot, column)].abs() {
            pivot = row;
        }
    }
    if matrix[(pivot, column)] == 0.0 { Err(DenseError::Singular { column }) } else { Ok(pivot) }
}

/// U x = b for the upper triangle of a matrix.
pub(super) fn substitute_backwards(upper: &Matrix, b: &mut [f64]) {
    for row in (0..b.len()).rev() {
        let (head, tail) = b.split_at_mut(row + 1);
        let entries = &upper.row(row)[row..];
        head[row] = (head[row] - dot(&entries[1..], tail)) / entries[0];
    }
}
