//! Singular values by one-sided Jacobi rotations: pairs of columns are turned in their plane until all stand at right angles;
//! their lengths are then the singular values. Slower than bidiagonalisation, but simple, and small singular values keep their
//! relative accuracy where columns are badly scaled. Demmel and Veselić, "Jacobi's method is more accurate than QR", SIAM J.
//! Matrix Anal. Appl. 13 (1992); Golub and Van Loan, "Matrix Computations", section 8.6.3.

use super::matrix::{dot, norm};
use super::{DenseError, Matrix};

/// Columns count as perpendicular below this cosine; a value is then right to about its square.
const PERPENDICULAR: f64 = 1e-10;

/// Ten sweeps are usual for some hundred columns; the limit guards against rounding that never settles.
const SWEEPS: usize = 60;

/// The singular values of the last matrix; empty at first.
#[derive(Clone, Debug, Default)]
pub struct SingularValues {
    /// The columns in work, as rows.
    columns: Matrix,
    values: Vec<f64>,
}

impl SingularValues {
    /// The min(m, n) singular values of an m × n matrix, in descending order. About 10 m n² operations a sweep.
    ///
    /// # Errors
    /// [`DenseError::NotFinite`].
    pub fn of(&mut self, matrix: &Matrix) -> Result<&[f64], DenseError> {
        if !matrix.is_finite() {
            return Err(DenseError::NotFinite);
        }
        // The fewer columns the better; the transpose has the same singular values.
        if matrix.rows() < matrix.columns() {
            self.columns.copy_from(matrix);
        } else {
            self.columns.transpose_from(matrix);
        }
        // By a power of two, so that squares neither over- nor underflow and nothing is rounded.
        let largest = self.columns.entries().iter().fold(0.0, |largest: f64, entry| largest.max(entry.abs()));
        let scale = if largest > 0.0 { f64::from_bits(largest.to_bits() & 0x7ff0_0000_0000_0000) } else { 1.0 };
        let scale = scale.max(f64::MIN_POSITIVE);
        for column in 0..self.columns.rows() {
            self.columns.row_mut(column).iter_mut().for_each(|entry| *entry /= scale);
        }
        for _ in 0..SWEEPS {
            if !self.sweep() {
                break;
            }
        }
        self.values.clear();
        self.values.extend((0..self.columns.rows()).map(|column| scale * norm(self.columns.row(column))));
        self.values.sort_unstable_by(|a, b| b.total_cmp(a));
        Ok(&self.values)
    }

    /// Turns every pair of columns once; whether any was not perpendicular yet.
    fn sweep(&mut self) -> bool {
        let mut turned = false;
        for a in 0..self.columns.rows() {
            for b in a + 1..self.columns.rows() {
                let (a, b) = self.columns.two_rows(a, b);
                turned |= make_perpendicular(a, b);
            }
        }
        turned
    }

    /// Of the last matrix, in descending order.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Largest over smallest singular value: by how much a relative error of A or b may grow in x. Infinite for a singular
    /// matrix, 1 for an empty one.
    pub fn condition_number(&self) -> f64 {
        match (self.values.first(), self.values.last()) {
            (Some(largest), Some(smallest)) if *smallest > 0.0 => largest / smallest,
            (Some(_), _) => f64::INFINITY,
            _ => 1.0,
        }
    }
}

/// Rotates two vectors in their plane so that their dot product becomes 0; false if it was, nearly.
fn make_perpendicular(a: &mut [f64], b: &mut [f64]) -> bool {
    let (aa, bb, ab) = (dot(a, a), dot(b, b), dot(a, b));
    if ab.abs() <= PERPENDICULAR * aa.sqrt() * bb.sqrt() {
        return false;
    }
    // tan of the smaller of the two angles that do it.
    let zeta = (bb - aa) / (2.0 * ab);
    let tangent = zeta.signum() / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
    let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
    let sine = cosine * tangent;
    for (a, b) in a.iter_mut().zip(b) {
        (*a, *b) = (cosine * *a - sine * *b, sine * *a + cosine * *b);
    }
    true
}
