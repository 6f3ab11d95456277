//! Why a dense method gave up.

use thiserror::Error;

/// Rows and columns count from 0.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum DenseError {
    #[error("the matrix is {rows} × {columns}; a square one is needed (try least squares)")]
    NotSquare { rows: usize, columns: usize },
    #[error("the matrix is singular: no pivot is left in column {column}; some rows say the same (try least squares)")]
    Singular { column: usize },
    #[error("the matrix is not positive definite: pivot {row} is {pivot:e} (redundant rows? try LU or a compliance)")]
    NotPositive { row: usize, pivot: f64 },
    #[error("the matrix holds an entry that is no finite number")]
    NotFinite,
}
