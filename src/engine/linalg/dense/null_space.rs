//! What a matrix maps to zero. For a Jacobian, the motions its constraints leave free; for its transpose, the forces that
//! cancel: each of these is a redundant constraint.

use super::{DenseError, Matrix, Qr};

/// Rank and null space of an m × n matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct NullSpace {
    /// Number of columns of the matrix that do not depend on others, 0 … min(m, n).
    pub rank: usize,
    /// n × (n − rank): its columns have length 1, stand at right angles to one another, and A times each of them is 0 up to
    /// rounding.
    pub basis: Matrix,
}

/// With Aᵀ P = Q R of rank r, the columns of Q from r on. `tolerance` as for [`Qr::factor`].
///
/// # Errors
/// [`DenseError::NotFinite`].
pub fn null_space(matrix: &Matrix, tolerance: f64) -> Result<NullSpace, DenseError> {
    let (mut transpose, mut qr) = (Matrix::default(), Qr::default());
    transpose.transpose_from(matrix);
    let rank = qr.factor(&transpose, tolerance)?;
    let n = matrix.columns();
    let mut basis = Matrix::zeros(n, n - rank);
    let mut vector = vec![0.0; n];
    for column in rank..n {
        vector.fill(0.0);
        vector[column] = 1.0;
        qr.rotate(&mut vector);
        (0..n).for_each(|row| basis[(row, column - rank)] = vector[row]);
    }
    Ok(NullSpace { rank, basis })
}
