//! Chains: tridiagonal matrices, factored from both ends.
//!
//! A rope of rods couples every row with its two neighbours only, so that elimination runs along it: each row costs one
//! division, and waits for the one before it. Started at both ends and met in the middle ("twisted" factorisation), two
//! divisions are always under way at the same time. It is the same elimination with the middle row last, as stable as any
//! other order; neither fill nor work grows.
//!
//! Meurant, "A review on the inverse of symmetric tridiagonal and block tridiagonal matrices", SIAM J. Matrix Anal. Appl. 13
//! (1992); van der Vorst, "Large tridiagonal and block tridiagonal linear systems on vector and parallel computers" (1987).

use super::pivots::Pivots;

/// L D Lᵀ of the symmetric tridiagonal matrix with `diagonal[n]` and, between rows i and i + 1, `off[n - 1]`.
///
/// Fills `reciprocals[n]` with 1 / pivot (0 for a dropped row) and `lower[n - 1]` with the multipliers: `lower[i]` is that of
/// the row nearer to the middle, n / 2. Linear in n; n = 0 is fine.
///
/// # Panics
/// If a slice is too short.
pub fn factor_tridiagonal(diagonal: &[f64], off: &[f64], reciprocals: &mut [f64], lower: &mut [f64]) -> Pivots {
    let n = diagonal.len();
    let mut pivots = Pivots::default();
    if n == 0 {
        return pivots;
    }
    let (off, reciprocals, lower) = (&off[..n - 1], &mut reciprocals[..n], &mut lower[..n - 1]);
    let (left_off, right_off) = off.split_at(n / 2);
    let (left_lower, right_lower) = lower.split_at_mut(n / 2);
    let (left_diagonal, right_diagonal) = diagonal.split_at(n / 2);
    let (left_reciprocals, right_reciprocals) = reciprocals.split_at_mut(n / 2);
    // What the rows before subtract from the next pivot of either half. With n even, the left half has one row more.
    let (mut left, mut right, mut from) = (0.0, 0.0, 0);
    if n.is_multiple_of(2) {
        let reciprocal = pivots.reciprocal(diagonal[0], diagonal[0]);
        left_reciprocals[0] = reciprocal;
        left_lower[0] = left_off[0] * reciprocal;
        left = left_off[0] * left_off[0] * reciprocal;
        from = 1;
    }
    let mut other = Pivots::default();
    let left_rows = left_diagonal[from..].iter().zip(&left_off[from..]);
    let left_factor = left_reciprocals[from..].iter_mut().zip(&mut left_lower[from..]);
    let right_rows = right_diagonal[1..].iter().zip(right_off).rev();
    let right_factor = right_reciprocals[1..].iter_mut().zip(right_lower).rev();
    for ((a, fa), (b, fb)) in left_rows.zip(left_factor).zip(right_rows.zip(right_factor)) {
        let reciprocal_a = pivots.reciprocal(a.0 - left, *a.0);
        let reciprocal_b = other.reciprocal(b.0 - right, *b.0);
        (*fa.0, *fb.0) = (reciprocal_a, reciprocal_b);
        (*fa.1, *fb.1) = (a.1 * reciprocal_a, b.1 * reciprocal_b);
        // The square first: it does not wait for the division.
        (left, right) = (a.1 * a.1 * reciprocal_a, b.1 * b.1 * reciprocal_b);
    }
    right_reciprocals[0] = pivots.reciprocal(right_diagonal[0] - left - right, right_diagonal[0]);
    pivots.join(other);
    pivots
}

/// A x = b in place, with the factor of [`factor_tridiagonal`].
///
/// # Panics
/// If a slice is too short.
pub fn solve_tridiagonal(reciprocals: &[f64], lower: &[f64], b: &mut [f64]) {
    let n = b.len();
    if n == 0 {
        return;
    }
    let (left_lower, right_lower) = lower[..n - 1].split_at(n / 2);
    let (left_reciprocals, right_reciprocals) = reciprocals[..n].split_at(n / 2);
    let (left_b, right_b) = b.split_at_mut(n / 2);
    let (middle, right_b) = right_b.split_first_mut().expect("n / 2 < n");
    let from = usize::from(n.is_multiple_of(2));
    let (mut left, mut right) = (0.0, 0.0);
    if from == 1 {
        left = left_lower[0] * left_b[0];
    }
    let left_rows = left_b[from..].iter_mut().zip(&left_lower[from..]);
    let right_rows = right_b.iter_mut().zip(right_lower).rev();
    for ((xa, la), (xb, lb)) in left_rows.zip(right_rows) {
        (*xa, *xb) = (*xa - left, *xb - right);
        (left, right) = (*xa * la, *xb * lb);
    }
    *middle = (*middle - left - right) * right_reciprocals[0];
    (left, right) = (*middle, *middle);
    let left_rows = left_b[from..].iter_mut().zip(left_reciprocals[from..].iter().zip(&left_lower[from..])).rev();
    let right_rows = right_b.iter_mut().zip(right_reciprocals[1..].iter().zip(right_lower));
    for ((xa, (ra, la)), (xb, (rb, lb))) in left_rows.zip(right_rows) {
        (left, right) = (*xa * ra - la * left, *xb * rb - lb * right);
        (*xa, *xb) = (left, right);
    }
    if from == 1 {
        left_b[0] = left_b[0] * left_reciprocals[0] - left_lower[0] * left;
    }
}
