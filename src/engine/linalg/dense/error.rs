//! Why a dense method gave up.

use thiserror::Error;

/// Rows and columns count from 0.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum DenseError {
    /// The method is for as many rows as columns.
    #[error("the matrix is {rows} × {columns}; a square one is needed (try least squares)")]
    NotSquare {
        /// Of the matrix that was handed in.
        rows: usize,
        /// Of the matrix that was handed in.
        columns: usize,
    },
    /// Every entry that is left in a column is exactly 0; rounding may hide that.
    #[error("the matrix is singular: no pivot is left in column {column}; some rows say the same (try least squares)")]
    Singular {
        /// The first column without a pivot, from 0.
        column: usize,
    },
    /// A pivot of the Cholesky factorisation is 0, negative or NaN.
    #[error("the matrix is not positive definite: pivot {row} is {pivot:e} (redundant rows? try LU or a compliance)")]
    NotPositive {
        /// The first row with such a pivot, from 0.
        row: usize,
        /// What is left on the diagonal there, before the root is taken.
        pivot: f64,
    },
    /// An entry is NaN or infinite.
    #[error("the matrix holds an entry that is no finite number")]
    NotFinite,
}
