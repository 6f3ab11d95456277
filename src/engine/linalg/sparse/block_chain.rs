//! Chains of 2 × 2 or 3 × 3 blocks, as a bridge of hinges or welds makes them: L D Lᵀ from both ends as in
//! [`factor_tridiagonal`](super::chain::factor_tridiagonal), with D diagonal and every block of L unit lower triangular or full.

use super::pivots::Pivots;

/// `block[row][column]`.
pub type Block<const B: usize> = [[f64; B]; B];

/// L D Lᵀ of the symmetric block tridiagonal matrix with `diagonal[n]`, of whose blocks only the lower triangles are read, and
/// `off[n - 1]`, where `off[i]` stands in block row i + 1 and block column i.
///
/// Fills `pivots[n]` with the unit lower triangles, 1 / pivot on their diagonals (0 for a dropped row), and `lower[n - 1]` with
/// the blocks of L off the diagonal: `lower[i]` is that of the block nearer to the middle, n / 2. Linear in n.
///
/// # Panics
/// If a slice is too short.
pub fn factor_block_chain<const B: usize>(
    diagonal: &[Block<B>],
    off: &[Block<B>],
    pivots: &mut [Block<B>],
    lower: &mut [Block<B>],
) -> Pivots {
    let n = diagonal.len();
    let (mut left_found, mut right_found) = (Pivots::default(), Pivots::default());
    if n == 0 {
        return left_found;
    }
    let (off, lower, middle) = (&off[..n - 1], &mut lower[..n - 1], n / 2);
    let (mut left, mut right) = ([[0.0; B]; B], [[0.0; B]; B]);
    for step in 0..middle {
        let k = step;
        pivots[k] = factor_block(&diagonal[k], &left, &mut left_found);
        (lower[k], left) = eliminate(&pivots[k], &off[k]);
        let k = n - 1 - step;
        if k > middle {
            pivots[k] = factor_block(&diagonal[k], &right, &mut right_found);
            (lower[k - 1], right) = eliminate(&pivots[k], &transpose(&off[k - 1]));
        }
    }
    for row in 0..B {
        for column in 0..B {
            left[row][column] += right[row][column];
        }
    }
    pivots[middle] = factor_block(&diagonal[middle], &left, &mut left_found);
    left_found.join(right_found);
    left_found
}

/// A x = b in place, with the factor of [`factor_block_chain`].
///
/// # Panics
/// If a slice is too short.
pub fn solve_block_chain<const B: usize>(pivots: &[Block<B>], lower: &[Block<B>], b: &mut [[f64; B]]) {
    let n = b.len();
    if n == 0 {
        return;
    }
    let middle = n / 2;
    let (mut left, mut right) = ([0.0; B], [0.0; B]);
    for step in 0..middle {
        let k = step;
        forwards(&pivots[k], &left, &mut b[k]);
        left = times(&lower[k], &b[k]);
        let k = n - 1 - step;
        if k > middle {
            forwards(&pivots[k], &right, &mut b[k]);
            right = times(&lower[k - 1], &b[k]);
        }
    }
    (0..B).for_each(|row| left[row] += right[row]);
    forwards(&pivots[middle], &left, &mut b[middle]);
    backwards(&pivots[middle], &[0.0; B], &mut b[middle]);
    (left, right) = (b[middle], b[middle]);
    for step in (0..middle).rev() {
        let k = step;
        backwards(&pivots[k], &times_transposed(&lower[k], &left), &mut b[k]);
        left = b[k];
        let k = n - 1 - step;
        if k > middle {
            backwards(&pivots[k], &times_transposed(&lower[k - 1], &right), &mut b[k]);
            right = b[k];
        }
    }
}

/// Blocks that nothing couples.
pub(super) fn factor_blocks<const B: usize>(diagonal: &[Block<B>], pivots: &mut [Block<B>]) -> Pivots {
    let mut found = Pivots::default();
    for (block, pivots) in diagonal.iter().zip(pivots) {
        *pivots = factor_block(block, &[[0.0; B]; B], &mut found);
    }
    found
}

pub(super) fn solve_blocks<const B: usize>(pivots: &[Block<B>], b: &mut [[f64; B]]) {
    for (pivots, b) in pivots.iter().zip(b) {
        forwards(pivots, &[0.0; B], b);
        backwards(pivots, &[0.0; B], b);
    }
}

/// L D Lᵀ of `diagonal - correction`.
#[inline(always)]
fn factor_block<const B: usize>(diagonal: &Block<B>, correction: &Block<B>, found: &mut Pivots) -> Block<B> {
    let mut factor = [[0.0; B]; B];
    for row in 0..B {
        // The row of L times D, for as long as the pivots are missing in it.
        let mut scaled = [0.0; B];
        let mut pivot = diagonal[row][row] - correction[row][row];
        for column in 0..row {
            scaled[column] = diagonal[row][column] - correction[row][column];
            for before in 0..column {
                scaled[column] -= scaled[before] * factor[column][before];
            }
            factor[row][column] = scaled[column] * factor[column][column];
            pivot -= factor[row][column] * scaled[column];
        }
        factor[row][row] = found.reciprocal(pivot, diagonal[row][row]);
    }
    factor
}

/// The block of L for a coupling (rows of the next block × columns of this one), and what it subtracts from the next diagonal
/// block, lower triangle.
#[inline(always)]
fn eliminate<const B: usize>(pivots: &Block<B>, coupling: &Block<B>) -> (Block<B>, Block<B>) {
    let (mut scaled, mut lower, mut correction) = (*coupling, [[0.0; B]; B], [[0.0; B]; B]);
    for row in 0..B {
        for column in 0..B {
            for before in 0..column {
                scaled[row][column] -= scaled[row][before] * pivots[column][before];
            }
            lower[row][column] = scaled[row][column] * pivots[column][column];
        }
        for other in 0..=row {
            for column in 0..B {
                correction[row][other] += lower[row][column] * scaled[other][column];
            }
        }
    }
    (lower, correction)
}

/// x = L⁻¹ (x − carried).
#[inline(always)]
fn forwards<const B: usize>(pivots: &Block<B>, carried: &[f64; B], x: &mut [f64; B]) {
    for row in 0..B {
        x[row] -= carried[row];
        for column in 0..row {
            x[row] -= pivots[row][column] * x[column];
        }
    }
}

/// x = L⁻ᵀ (D⁻¹ x − carried).
#[inline(always)]
fn backwards<const B: usize>(pivots: &Block<B>, carried: &[f64; B], x: &mut [f64; B]) {
    for row in (0..B).rev() {
        // A dropped row is 0 and stays so: its column of L is.
        x[row] = x[row] * pivots[row][row] - carried[row];
        for below in row + 1..B {
            x[row] -= pivots[below][row] * x[below];
        }
    }
}

#[inline(always)]
pub(super) fn times<const B: usize>(block: &Block<B>, x: &[f64; B]) -> [f64; B] {
    std::array::from_fn(|row| (0..B).map(|column| block[row][column] * x[column]).sum())
}

#[inline(always)]
fn times_transposed<const B: usize>(block: &Block<B>, x: &[f64; B]) -> [f64; B] {
    std::array::from_fn(|column| (0..B).map(|row| block[row][column] * x[row]).sum())
}

#[inline(always)]
fn transpose<const B: usize>(block: &Block<B>) -> Block<B> {
    std::array::from_fn(|row| std::array::from_fn(|column| block[column][row]))
}
