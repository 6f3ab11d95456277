//! What a factorisation found on the diagonal.

/// A pivot of at most this times the diagonal entry of its row before elimination is nothing but rounding: the row is a
/// combination of those before it, and is dropped. Rounding leaves some 1e-16 times the growth of a few hundred operations;
/// independent rows as bad as 1e-11 (a condition number beyond 1e11) are lost with a larger value, redundant rows divide by
/// noise with a smaller one.
pub const DROP: f64 = 1e-11;

/// The pivots of a factorisation, the dropped ones not counted in `smallest`, `largest` and `negative`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pivots {
    /// Least magnitude; infinite if there is no pivot.
    pub smallest: f64,
    /// Greatest magnitude; 0 if there is no pivot.
    pub largest: f64,
    /// Rows that depend on the ones before them, by [`DROP`].
    pub dropped: usize,
    /// 0 for a positive (semi)definite matrix: by Sylvester's law of inertia as many as A has negative eigenvalues.
    pub negative: usize,
    /// False if the matrix holds NaN or infinity, or the elimination overflowed. The factor is then of no use.
    pub finite: bool,
}

impl Default for Pivots {
    fn default() -> Self {
        Self { smallest: f64::INFINITY, largest: 0.0, dropped: 0, negative: 0, finite: true }
    }
}

impl Pivots {
    /// Takes note of a pivot of a row with this diagonal entry. Returns its reciprocal, 0 if it is dropped.
    #[inline(always)]
    pub(super) fn reciprocal(&mut self, pivot: f64, diagonal: f64) -> f64 {
        let size = pivot.abs();
        if size <= DROP * diagonal.abs() {
            self.dropped += 1;
            // Infinity is not more than 1e-11 times infinity either.
            self.finite &= size < f64::INFINITY;
            return 0.0;
        }
        self.smallest = if size < self.smallest { size } else { self.smallest };
        self.largest = if size > self.largest { size } else { self.largest };
        self.negative += usize::from(pivot < 0.0);
        self.finite &= size < f64::INFINITY;
        1.0 / pivot
    }

    pub(super) fn join(&mut self, other: Self) {
        self.smallest = self.smallest.min(other.smallest);
        self.largest = self.largest.max(other.largest);
        self.dropped += other.dropped;
        self.negative += other.negative;
        self.finite &= other.finite;
    }
}
