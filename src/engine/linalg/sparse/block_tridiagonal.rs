//! Block tridiagonal matrices that need not be symmetric nor definite, as Newton's method on a rope of rods makes them: 3 × 3
//! blocks of two coordinates and a multiplier, whose own diagonal entry is 0.
//!
//! Block elimination from both ends. Every pivot block is inverted by cofactors, or with exchange of its rows where those would
//! cancel, so that zeros on its diagonal do no harm; between blocks there is no exchange: each pivot block must be regular, which it is for a saddle point whose
//! coordinates' part is definite. Golub and Van Loan, "Matrix Computations", section 4.5.1.

use super::block_chain::{Block, times};

/// A determinant above this share of its terms has lost at most three figures to cancellation, and so have the cofactors. The
/// share does not change when rows or columns are scaled, so that units do not matter.
const SAFE: f64 = 1e-3;

/// What a factorisation found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlockPivots {
    /// Of all pivot blocks the least determinant as a share of the sum of its six terms: 1 is best, below 1e-13 the solution
    /// has lost all figures.
    pub worst: f64,
    /// False if a pivot block was singular, or an entry was not finite. The factor is then of no use.
    pub regular: bool,
}

/// L U of the matrix with blocks `diagonal[n]`, `lower[n - 1]` (`lower[i]` in block row i + 1, column i) and `upper[n - 1]`
/// (`upper[i]` in block row i, column i + 1).
///
/// Fills `inverses[n]` with the inverted pivot blocks and `multipliers[n - 1]` with the blocks of L: `multipliers[i]` belongs
/// to the block nearer to the middle, n / 2. Linear in n.
///
/// # Panics
/// If a slice is too short.
pub fn factor_block_tridiagonal(
    diagonal: &[Block<3>],
    lower: &[Block<3>],
    upper: &[Block<3>],
    inverses: &mut [Block<3>],
    multipliers: &mut [Block<3>],
) -> BlockPivots {
    let mut found = BlockPivots { worst: 1.0, regular: true };
    let n = diagonal.len();
    if n == 0 {
        return found;
    }
    let (lower, upper, multipliers) = (&lower[..n - 1], &upper[..n - 1], &mut multipliers[..n - 1]);
    let middle = n / 2;
    let (mut left, mut right) = ([[0.0; 3]; 3], [[0.0; 3]; 3]);
    for k in 0..middle {
        inverses[k] = invert(minus(&diagonal[k], &left), &mut found);
        multipliers[k] = product(&lower[k], &inverses[k]);
        left = product(&multipliers[k], &upper[k]);
        let k = n - 1 - k;
        if k > middle {
            inverses[k] = invert(minus(&diagonal[k], &right), &mut found);
            multipliers[k - 1] = product(&upper[k - 1], &inverses[k]);
            right = product(&multipliers[k - 1], &lower[k - 1]);
        }
    }
    inverses[middle] = invert(minus(&minus(&diagonal[middle], &left), &right), &mut found);
    found
}

/// A x = b in place, with the factor of [`factor_block_tridiagonal`] and the blocks it was made from.
///
/// # Panics
/// If a slice is too short.
pub fn solve_block_tridiagonal(
    inverses: &[Block<3>],
    multipliers: &[Block<3>],
    lower: &[Block<3>],
    upper: &[Block<3>],
    b: &mut [[f64; 3]],
) {
    let n = b.len();
    if n == 0 {
        return;
    }
    let middle = n / 2;
    for k in 0..middle {
        let from = b[k];
        subtract_product(&multipliers[k], &from, &mut b[k + 1]);
        let k = n - 1 - k;
        if k > middle {
            let from = b[k];
            subtract_product(&multipliers[k - 1], &from, &mut b[k - 1]);
        }
    }
    b[middle] = times(&inverses[middle], &b[middle]);
    for k in (0..middle).rev() {
        let inner = b[k + 1];
        subtract_product(&upper[k], &inner, &mut b[k]);
        b[k] = times(&inverses[k], &b[k]);
        let k = n - 1 - k;
        if k > middle {
            let inner = b[k - 1];
            subtract_product(&lower[k - 1], &inner, &mut b[k]);
            b[k] = times(&inverses[k], &b[k]);
        }
    }
}

/// By the adjugate where it is as good as elimination, at a third of the time.
#[inline(always)]
fn invert(block: Block<3>, found: &mut BlockPivots) -> Block<3> {
    let [a, b, c] = block;
    // Rows of the adjugate's transpose, and the determinant with the size of its terms.
    let cofactors = [cross(b, c), cross(c, a), cross(a, b)];
    let [(x, y, z), (u, v, w)] = [
        (a[0] * b[1] * c[2], a[1] * b[2] * c[0], a[2] * b[0] * c[1]),
        (a[2] * b[1] * c[0], a[0] * b[2] * c[1], a[1] * b[0] * c[2]),
    ];
    let determinant = (x + y + z) - (u + v + w);
    let terms = x.abs() + y.abs() + z.abs() + u.abs() + v.abs() + w.abs();
    if !(determinant.abs() > SAFE * terms && terms < f64::INFINITY) {
        return invert_with_exchange(block, determinant.abs() / terms, found);
    }
    found.worst = if determinant.abs() < found.worst * terms { determinant.abs() / terms } else { found.worst };
    let reciprocal = 1.0 / determinant;
    std::array::from_fn(|row| std::array::from_fn(|column| cofactors[column][row] * reciprocal))
}

#[inline(always)]
fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Gauss-Jordan elimination with exchange of rows.
#[cold]
fn invert_with_exchange(mut block: Block<3>, ratio: f64, found: &mut BlockPivots) -> Block<3> {
    let mut inverse: Block<3> = std::array::from_fn(|row| std::array::from_fn(|column| f64::from(row == column)));
    found.worst = if ratio < found.worst { ratio } else { found.worst };
    for column in 0..3 {
        for row in column + 1..3 {
            if block[row][column].abs() > block[column][column].abs() {
                block.swap(row, column);
                inverse.swap(row, column);
            }
        }
        let pivot = block[column][column];
        found.regular &= pivot != 0.0 && pivot.is_finite();
        for k in 0..3 {
            block[column][k] /= pivot;
            inverse[column][k] /= pivot;
        }
        for row in (0..3).filter(|&row| row != column) {
            let factor = block[row][column];
            for k in 0..3 {
                block[row][k] -= factor * block[column][k];
                inverse[row][k] -= factor * inverse[column][k];
            }
        }
    }
    found.regular &= inverse.as_flattened().iter().all(|entry| entry.is_finite());
    inverse
}

#[inline(always)]
fn minus(a: &Block<3>, b: &Block<3>) -> Block<3> {
    std::array::from_fn(|row| std::array::from_fn(|column| a[row][column] - b[row][column]))
}

#[inline(always)]
fn product(a: &Block<3>, b: &Block<3>) -> Block<3> {
    std::array::from_fn(|row| std::array::from_fn(|column| (0..3).map(|k| a[row][k] * b[k][column]).sum()))
}

#[inline(always)]
fn subtract_product(block: &Block<3>, x: &[f64; 3], from: &mut [f64; 3]) {
    for row in 0..3 {
        for column in 0..3 {
            from[row] -= block[row][column] * x[column];
        }
    }
}
