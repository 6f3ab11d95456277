//! A dense matrix.

use std::ops::{Index, IndexMut};

/// `rows × columns` numbers, row after row. `matrix[(row, column)]`; an index outside panics.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Matrix {
    rows: usize,
    columns: usize,
    entries: Vec<f64>,
}

impl Matrix {
    /// A matrix of zeros; either number may be 0.
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self { rows, columns, entries: vec![0.0; rows * columns] }
    }

    /// Ones on the diagonal of `size × size`, zeros elsewhere.
    pub fn identity(size: usize) -> Self {
        Self::from_fn(size, size, |row, column| f64::from(row == column))
    }

    /// Every entry from its row and column.
    pub fn from_fn(rows: usize, columns: usize, mut entry: impl FnMut(usize, usize) -> f64) -> Self {
        let entries = (0..rows * columns).map(|k| entry(k / columns, k % columns)).collect();
        Self { rows, columns, entries }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// All entries, row after row.
    pub fn entries(&self) -> &[f64] {
        &self.entries
    }

    /// The entries of a row, from left to right; panics if there is no such row.
    pub fn row(&self, row: usize) -> &[f64] {
        &self.entries[row * self.columns..][..self.columns]
    }

    /// The entries of a row, to be changed; panics if there is no such row.
    pub fn row_mut(&mut self, row: usize) -> &mut [f64] {
        &mut self.entries[row * self.columns..][..self.columns]
    }

    /// Row `target`, and row `source` that is to be subtracted from it or the like; they differ.
    pub(super) fn two_rows(&mut self, target: usize, source: usize) -> (&mut [f64], &mut [f64]) {
        let n = self.columns;
        if target > source {
            let (before, after) = self.entries.split_at_mut(target * n);
            (&mut after[..n], &mut before[source * n..][..n])
        } else {
            let (before, after) = self.entries.split_at_mut(source * n);
            (&mut before[target * n..][..n], &mut after[..n])
        }
    }

    pub(super) fn swap_rows(&mut self, a: usize, b: usize) {
        if a != b {
            let (a, b) = self.two_rows(a, b);
            a.swap_with_slice(b);
        }
    }

    /// Becomes a matrix of zeros of another shape, in the memory it has.
    pub fn reshape(&mut self, rows: usize, columns: usize) {
        (self.rows, self.columns) = (rows, columns);
        self.entries.clear();
        self.entries.resize(rows * columns, 0.0);
    }

    /// Becomes a copy of another matrix, in the memory it has.
    pub fn copy_from(&mut self, other: &Self) {
        (self.rows, self.columns) = (other.rows, other.columns);
        self.entries.clone_from(&other.entries);
    }

    /// Becomes the transpose of another matrix, in the memory it has.
    pub fn transpose_from(&mut self, other: &Self) {
        (self.rows, self.columns) = (other.columns, other.rows);
        self.entries.clear();
        for column in 0..other.columns {
            self.entries.extend((0..other.rows).map(|row| other[(row, column)]));
        }
    }

    /// A x.
    ///
    /// # Panics
    /// If `x` has not as many entries as the matrix columns, or `product` not as many as rows.
    pub fn times(&self, x: &[f64], product: &mut [f64]) {
        assert_eq!(
            (x.len(), product.len()),
            (self.columns, self.rows),
            "the matrix is {} × {}",
            self.rows,
            self.columns
        );
        for (row, product) in product.iter_mut().enumerate() {
            *product = dot(self.row(row), x);
        }
    }

    pub(super) fn is_finite(&self) -> bool {
        self.entries.iter().all(|entry| entry.is_finite())
    }
}

impl Index<(usize, usize)> for Matrix {
    type Output = f64;

    fn index(&self, (row, column): (usize, usize)) -> &f64 {
        &self.row(row)[column]
    }
}

impl IndexMut<(usize, usize)> for Matrix {
    fn index_mut(&mut self, (row, column): (usize, usize)) -> &mut f64 {
        &mut self.row_mut(row)[column]
    }
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// x −= factor · y.
pub(super) fn subtract_multiple(x: &mut [f64], factor: f64, y: &[f64]) {
    x.iter_mut().zip(y).for_each(|(x, y)| *x -= factor * y);
}

/// √(Σ x²), without overflow or underflow on the way.
pub(super) fn norm(x: &[f64]) -> f64 {
    let largest = x.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return largest;
    }
    largest * x.iter().map(|x| (x / largest) * (x / largest)).sum::<f64>().sqrt()
}
