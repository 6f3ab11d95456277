//! A = L D Lᵀ of a symmetric positive semidefinite matrix in envelope storage: a row reaches from its first entry to the
//! diagonal, and nothing fills in outside (Jennings, A compact storage scheme for the solution of symmetric linear
//! simultaneous equations, 1966).

use super::double_double::DoubleDouble;

/// A pivot below this part of its diagonal entry is rounding: the row depends on those before it and is left out, as
/// is right for a constraint that the others imply. Far above the rounding of double-double (1e-31 times the growth of a
/// few hundred rows), far below the square of any angle between constraints that doubles can express by intention.
const DEPENDENT: f64 = 1e-22;

/// The matrix, then its factor, in place.
#[derive(Clone, Debug)]
pub(super) struct Factor {
    /// First column of each row.
    first: Vec<usize>,
    /// Where each row begins in `entries`.
    start: Vec<usize>,
    /// Rows from their first column to the diagonal.
    entries: Vec<DoubleDouble>,
    /// 1/dᵢ, 0 for a row left out.
    inverse_pivot: Vec<DoubleDouble>,
}

impl Factor {
    /// A zero matrix whose rows begin at the given columns.
    pub(super) fn new(first: Vec<usize>) -> Factor {
        let mut start = Vec::with_capacity(first.len());
        let mut count = 0;
        for (row, column) in first.iter().enumerate() {
            start.push(count);
            count += row + 1 - column;
        }
        let (entries, inverse_pivot) = (vec![DoubleDouble::ZERO; count], vec![DoubleDouble::ZERO; first.len()]);
        Factor { first, start, entries, inverse_pivot }
    }

    /// Sets every entry to zero.
    pub(super) fn clear(&mut self) {
        self.entries.fill(DoubleDouble::ZERO);
    }

    /// Adds to entry (row, column), column ≤ row, inside the envelope.
    pub(super) fn add(&mut self, row: usize, column: usize, value: DoubleDouble) {
        self.entries[self.start[row] + column - self.first[row]] += value;
    }

    /// Turns the matrix into its factor. O(rows · width²).
    pub(super) fn factorise(&mut self) {
        for row in 0..self.first.len() {
            let (before, rest) = self.entries.split_at_mut(self.start[row]);
            let (first, own) = (self.first[row], &mut rest[..=row - self.first[row]]);
            // First U = L D, entry by entry, which needs U of this row and L of the rows above …
            for column in first..row {
                let shared = first.max(self.first[column]);
                let above = &before[self.start[column] + shared - self.first[column]..][..column - shared];
                let sum = dot(above, &own[shared - first..column - first]);
                own[column - first] -= sum;
            }
            // … then L, and the pivot.
            let diagonal = own[row - first];
            let mut pivot = diagonal;
            for column in first..row {
                let u = own[column - first];
                let l = u * self.inverse_pivot[column];
                pivot -= u * l;
                own[column - first] = l;
            }
            let depends = pivot.value() <= DEPENDENT * diagonal.value();
            self.inverse_pivot[row] = if depends { DoubleDouble::ZERO } else { DoubleDouble::from(1.0) / pivot };
        }
    }

    /// Solves A x = b in place; x is 0 in the rows left out.
    pub(super) fn solve(&self, x: &mut [DoubleDouble]) {
        for row in 0..x.len() {
            let first = self.first[row];
            let sum = dot(&self.entries[self.start[row]..][..row - first], &x[first..row]);
            x[row] -= sum;
        }
        for row in (0..x.len()).rev() {
            // The entries above are final once D is divided out, so the row is spread over them.
            x[row] = x[row] * self.inverse_pivot[row];
        }
        for row in (0..x.len()).rev() {
            let (first, value) = (self.first[row], x[row]);
            for (l, x) in self.entries[self.start[row]..][..row - first].iter().zip(&mut x[first..row]) {
                *x -= *l * value;
            }
        }
    }
}

fn dot(a: &[DoubleDouble], b: &[DoubleDouble]) -> DoubleDouble {
    a.iter().zip(b).fold(DoubleDouble::ZERO, |sum, (a, b)| sum + *a * *b)
}
