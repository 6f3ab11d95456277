//! Block tridiagonal matrices that need not be symmetric nor definite, as Newton's method on a rope of rods makes them: 3 × 3
//! blocks of two coordinates and a multiplier, whose own diagonal entry is 0.
//!
//! Block elimination from both ends. Every pivot block is inverted with exchange of its rows, so that zeros on its diagonal do
//! no harm; between blocks there is no exchange: each pivot block must be regular, which it is for a saddle point whose
//! coordinates' part is definite. Golub and Van Loan, "Matrix Computations", section 4.5.1.

use super::block_chain::{Block, times};

/// What a factorisation found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlockPivots {
    /// Least ratio, over all blocks, of the smallest to the largest scalar pivot within a block: 1 is best, below 1e-13 the
    /// solution has lost all figures.
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
pub fn factor_block_tridiagonal<const B: usize>(
    diagonal: &[Block<B>],
    lower: &[Block<B>],
    upper: &[Block<B>],
    inverses: &mut [Block<B>],
    multipliers: &mut [Block<B>],
) -> BlockPivots {
    let mut found = BlockPivots { worst: 1.0, regular: true };
    let n = diagonal.len();
    if n == 0 {
        return found;
    }
    let (lower, upper, multipliers) = (&lower[..n - 1], &upper[..n - 1], &mut multipliers[..n - 1]);
    let middle = n / 2;
    let (mut left, mut right) = ([[0.0; B]; B], [[0.0; B]; B]);
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
pub fn solve_block_tridiagonal<const B: usize>(
    inverses: &[Block<B>],
    multipliers: &[Block<B>],
    lower: &[Block<B>],
    upper: &[Block<B>],
    b: &mut [[f64; B]],
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

/// Gauss-Jordan elimination with exchange of rows.
#[inline(always)]
fn invert<const B: usize>(mut block: Block<B>, found: &mut BlockPivots) -> Block<B> {
    let mut inverse: Block<B> = std::array::from_fn(|row| std::array::from_fn(|column| f64::from(row == column)));
    let (mut smallest, mut largest) = (f64::INFINITY, 0.0);
    for column in 0..B {
        // Rows are swapped pairwise, without a branch on the data that the processor would guess wrong.
        for row in column + 1..B {
            let swap = block[row][column].abs() > block[column][column].abs();
            for k in 0..B {
                let (a, b) = (block[column][k], block[row][k]);
                (block[column][k], block[row][k]) = if swap { (b, a) } else { (a, b) };
                let (a, b) = (inverse[column][k], inverse[row][k]);
                (inverse[column][k], inverse[row][k]) = if swap { (b, a) } else { (a, b) };
            }
        }
        let pivot = block[column][column];
        let size = pivot.abs();
        found.regular &= size > 0.0 && size < f64::INFINITY;
        smallest = if size < smallest { size } else { smallest };
        largest = if size > largest { size } else { largest };
        let reciprocal = 1.0 / pivot;
        for k in 0..B {
            block[column][k] *= reciprocal;
            inverse[column][k] *= reciprocal;
        }
        for row in (0..B).filter(|&row| row != column) {
            let factor = block[row][column];
            for k in 0..B {
                block[row][k] -= factor * block[column][k];
                inverse[row][k] -= factor * inverse[column][k];
            }
        }
    }
    // Not (smallest / largest): one division less in the loop's longest chain of waits.
    if smallest < found.worst * largest {
        found.worst = smallest / largest;
    }
    inverse
}

#[inline(always)]
fn minus<const B: usize>(a: &Block<B>, b: &Block<B>) -> Block<B> {
    std::array::from_fn(|row| std::array::from_fn(|column| a[row][column] - b[row][column]))
}

#[inline(always)]
fn product<const B: usize>(a: &Block<B>, b: &Block<B>) -> Block<B> {
    std::array::from_fn(|row| std::array::from_fn(|column| (0..B).map(|k| a[row][k] * b[k][column]).sum()))
}

#[inline(always)]
fn subtract_product<const B: usize>(block: &Block<B>, x: &[f64; B], from: &mut [f64; B]) {
    for row in 0..B {
        for column in 0..B {
            from[row] -= block[row][column] * x[column];
        }
    }
}
