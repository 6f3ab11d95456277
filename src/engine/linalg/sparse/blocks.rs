//! A part of the matrix that is one chain, or a run of single blocks: where it lies in the arrays, and its loops by block size.

use super::block_chain::{Block, factor_block_chain, factor_blocks, solve_block_chain, solve_blocks};
use super::chain::{factor_tridiagonal, solve_tridiagonal};
use super::{Pivots, gather, scatter};
use std::ops::Range;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    Diagonal,
    Chain,
}

/// `count` blocks of `block` rows each.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) shape: Shape,
    pub(super) block: usize,
    pub(super) count: usize,
    /// First diagonal block in the values; the off-diagonal ones follow.
    value: usize,
    /// First of its blocks in the factor.
    pivot: usize,
    lower: usize,
    /// Its stretch of the list of the caller's rows.
    rows: Range<usize>,
    /// If they follow each other, the first: nothing needs to be gathered.
    contiguous: Option<usize>,
}

impl Part {
    /// Appends its rows, `first_row(k)` being that of block k of the part, to `rows`.
    pub(super) fn new(
        shape: Shape,
        block: usize,
        count: usize,
        [value, pivot, lower]: [usize; 3],
        rows: &mut Vec<u32>,
        first_row: impl Fn(usize) -> u32,
    ) -> Self {
        let start = rows.len();
        for k in 0..count {
            let first = first_row(k);
            rows.extend(first..first + block as u32);
        }
        let own = &rows[start..];
        let contiguous = own.windows(2).all(|pair| pair[1] == pair[0] + 1).then_some(own[0] as usize);
        Self { shape, block, count, value, pivot, lower, rows: start..rows.len(), contiguous }
    }

    /// Where the next part begins in values, pivots and lower blocks.
    pub(super) fn end(&self) -> [usize; 3] {
        let square = self.block * self.block;
        let links = self.links() * square;
        [self.value + self.count * square + links, self.pivot + self.count * square, self.lower + links]
    }

    fn links(&self) -> usize {
        if self.shape == Shape::Chain { self.count - 1 } else { 0 }
    }

    /// The first row of each of its blocks.
    pub(super) fn first_rows<'a>(&self, rows: &'a [u32]) -> impl Iterator<Item = u32> + use<'a> {
        rows[self.rows.clone()].iter().copied().step_by(self.block)
    }

    /// First value of the block between blocks k and k + 1: row k + 1, column k.
    pub(super) fn off_slot(&self, k: usize) -> usize {
        self.value + (self.count + k) * self.block * self.block
    }

    pub(super) fn factor(&self, values: &[f64], pivots: &mut [f64], lower: &mut [f64]) -> Pivots {
        match self.block {
            1 => {
                let [diagonal, off] = self.split::<1>(values);
                let (pivots, lower) = (&mut pivots[self.pivot..][..self.count], &mut lower[self.lower..]);
                match self.shape {
                    Shape::Chain => factor_tridiagonal(
                        diagonal.as_flattened().as_flattened(),
                        off.as_flattened().as_flattened(),
                        pivots,
                        lower,
                    ),
                    Shape::Diagonal => factor_blocks(diagonal, as_blocks_mut(pivots)),
                }
            }
            2 => self.factor_by::<2>(values, pivots, lower),
            _ => self.factor_by::<3>(values, pivots, lower),
        }
    }

    fn factor_by<const B: usize>(&self, values: &[f64], pivots: &mut [f64], lower: &mut [f64]) -> Pivots {
        let [diagonal, off] = self.split::<B>(values);
        let pivots = &mut as_blocks_mut(&mut pivots[self.pivot..])[..self.count];
        match self.shape {
            Shape::Chain => factor_block_chain(diagonal, off, pivots, as_blocks_mut(&mut lower[self.lower..])),
            Shape::Diagonal => factor_blocks(diagonal, pivots),
        }
    }

    /// Its diagonal and off-diagonal blocks of A.
    fn split<'a, const B: usize>(&self, values: &'a [f64]) -> [&'a [Block<B>]; 2] {
        let blocks = &as_blocks::<B>(&values[self.value..])[..self.count + self.links()];
        let (diagonal, off) = blocks.split_at(self.count);
        [diagonal, off]
    }

    pub(super) fn solve(&self, pivots: &[f64], lower: &[f64], rows: &[u32], gathered: &mut [f64], b: &mut [f64]) {
        let length = self.rows.len();
        if let Some(first) = self.contiguous {
            self.solve_in_order(pivots, lower, &mut b[first..first + length]);
        } else {
            let (rows, x) = (&rows[self.rows.clone()], &mut gathered[..length]);
            gather(rows, b, x);
            self.solve_in_order(pivots, lower, x);
            scatter(rows, x, b);
        }
    }

    fn solve_in_order(&self, pivots: &[f64], lower: &[f64], x: &mut [f64]) {
        let (pivots, lower) = (&pivots[self.pivot..], &lower[self.lower..]);
        match (self.block, self.shape) {
            (1, Shape::Chain) => solve_tridiagonal(pivots, lower, x),
            (2, Shape::Chain) => solve_block_chain::<2>(as_blocks(pivots), as_blocks(lower), x.as_chunks_mut().0),
            (_, Shape::Chain) => solve_block_chain::<3>(as_blocks(pivots), as_blocks(lower), x.as_chunks_mut().0),
            (1, Shape::Diagonal) => solve_blocks::<1>(as_blocks(pivots), x.as_chunks_mut().0),
            (2, Shape::Diagonal) => solve_blocks::<2>(as_blocks(pivots), x.as_chunks_mut().0),
            (_, Shape::Diagonal) => solve_blocks::<3>(as_blocks(pivots), x.as_chunks_mut().0),
        }
    }

    /// Appends the caller's rows whose pivot was dropped.
    pub(super) fn list_dropped(&self, pivots: &[f64], rows: &[u32], dropped: &mut Vec<u32>) {
        let own = pivots[self.pivot..].chunks_exact(self.block * self.block);
        for (block, rows) in own.zip(rows[self.rows.clone()].chunks_exact(self.block)) {
            let diagonal = block.iter().step_by(self.block + 1);
            dropped.extend(rows.iter().zip(diagonal).filter(|(_, pivot)| **pivot == 0.0).map(|(&row, _)| row));
        }
    }

    /// r −= A x for its rows.
    pub(super) fn subtract_product(&self, values: &[f64], rows: &[u32], x: &[f64], r: &mut [f64]) {
        let (rows, square) = (&rows[self.rows.clone()], self.block * self.block);
        let (diagonal, off) = values[self.value..].split_at(self.count * square);
        for (k, block) in diagonal.chunks_exact(square).enumerate() {
            let own = &rows[k * self.block..][..self.block];
            subtract_symmetric(block, own, x, r);
            if k > 0 && self.shape == Shape::Chain {
                let before = &rows[(k - 1) * self.block..][..self.block];
                subtract_pair(&off[(k - 1) * square..][..square], own, before, x, r);
            }
        }
    }
}

/// r −= D x for a diagonal block, of which the lower triangle counts.
pub(super) fn subtract_symmetric(block: &[f64], rows: &[u32], x: &[f64], r: &mut [f64]) {
    for (i, &row) in rows.iter().enumerate() {
        for (j, &column) in rows.iter().enumerate() {
            r[row as usize] -= block[i.max(j) * rows.len() + i.min(j)] * x[column as usize];
        }
    }
}

/// r −= B x and Bᵀ x for a block off the diagonal.
pub(super) fn subtract_pair(block: &[f64], rows: &[u32], columns: &[u32], x: &[f64], r: &mut [f64]) {
    for (&row, entries) in rows.iter().zip(block.chunks_exact(columns.len())) {
        for (&column, entry) in columns.iter().zip(entries) {
            r[row as usize] -= entry * x[column as usize];
            r[column as usize] -= entry * x[row as usize];
        }
    }
}

fn as_blocks<const B: usize>(values: &[f64]) -> &[Block<B>] {
    values.as_chunks().0.as_chunks().0
}

fn as_blocks_mut<const B: usize>(values: &mut [f64]) -> &mut [Block<B>] {
    values.as_chunks_mut().0.as_chunks_mut().0
}
