//! The numbers of L and D, row by row ("up-looking"): row k of L is the solution of a triangular system with the rows above it,
//! L[..k] D[..k] lₖ = aₖ, and the pivot is what is left of the diagonal, dₖ = aₖₖ − lₖᵀ D lₖ.
//!
//! With the columns in supernodes, a row takes one supernode at a time: it solves with the dense triangle, subtracts the panel
//! times the result from the rest of the row, and appends its entries to the panel. No memory is allocated.
//!
//! Davis, "Direct Methods for Sparse Linear Systems" (2006), section 4.7 and the `LDL` package (ACM TOMS 31, 2005), which this
//! extends to supernodes.

use super::pivots::Pivots;
use super::symbolic::{BlockRow, Supernode, Symbolic};
use crate::engine::linalg::complex::Complex;
use std::ops::{Add, AddAssign, Mul, Sub, SubAssign};

/// What a matrix is made of.
pub(super) trait Scalar:
    Copy + Default + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + AddAssign + SubAssign
{
    /// 1 / a pivot of a row with this diagonal entry before elimination; 0 if it is dropped.
    fn reciprocal_pivot(self, diagonal: Self, found: &mut Pivots) -> Self;
}

impl Scalar for f64 {
    #[inline(always)]
    fn reciprocal_pivot(self, diagonal: f64, found: &mut Pivots) -> f64 {
        found.reciprocal(self, diagonal)
    }
}

/// Complex symmetric, not Hermitian; nothing is dropped.
impl<const L: usize> Scalar for Complex<L> {
    #[inline(always)]
    fn reciprocal_pivot(self, _diagonal: Self, found: &mut Pivots) -> Self {
        let reciprocal = self.reciprocal();
        found.finite &= reciprocal.is_finite();
        reciprocal
    }
}

/// The factor and the row in work. Panels as described at [`Supernode`]; their triangles have an implied unit diagonal.
#[derive(Clone, Debug, Default)]
pub(super) struct Numeric<T> {
    panels: Vec<T>,
    /// 1 / pivot of every row, 0 for a dropped one: its column of L and its unknown become 0 by themselves.
    pub(super) reciprocals: Vec<T>,
    /// The row in work at its full length; zero between two rows.
    row: Vec<T>,
    /// The part of it that belongs to one supernode.
    part: Vec<T>,
}

impl<T: Scalar> Numeric<T> {
    pub(super) fn reserve(&mut self, symbolic: &Symbolic) {
        for (list, length) in [
            (&mut self.panels, symbolic.panels),
            (&mut self.reciprocals, symbolic.size),
            (&mut self.row, symbolic.size),
            (&mut self.part, symbolic.widest),
        ] {
            list.clear();
            list.resize(length, T::default());
        }
    }

    pub(super) fn factor(&mut self, symbolic: &Symbolic, values: &[T]) -> Pivots {
        let mut pivots = Pivots::default();
        for pair in symbolic.block_rows.windows(2) {
            let (block, next) = (pair[0], pair[1]);
            for row in 0..block.size as usize {
                self.scatter(symbolic, &block, &next, row, values);
                let diagonal = values[block.diagonal + row * (block.size as usize + 1)];
                let mut pivot = diagonal;
                for meeting in &symbolic.meetings[block.meetings as usize..next.meetings as usize] {
                    let node = &symbolic.nodes[meeting.node as usize];
                    let position = meeting.position as usize + row;
                    let rows = &symbolic.rows[node.rows_start as usize..][..position];
                    pivot -= match node.width {
                        1 => self.meet_one(node, rows),
                        2 => self.meet::<2>(node, rows),
                        3 => self.meet::<3>(node, rows),
                        4 => self.meet::<4>(node, rows),
                        _ => self.meet_wide(node, rows),
                    };
                }
                let k = block.first as usize + row;
                pivot -= self.meet_own(&symbolic.nodes[block.node as usize], k);
                self.reciprocals[k] = pivot.reciprocal_pivot(diagonal, &mut pivots);
            }
        }
        pivots
    }

    /// Lays row `row` of a block row of A, left of the diagonal, into the row in work.
    fn scatter(&mut self, symbolic: &Symbolic, block: &BlockRow, next: &BlockRow, row: usize, values: &[T]) {
        for entry in &symbolic.entries[block.entries as usize..next.entries as usize] {
            let (column, width) = (entry.column as usize, entry.width as usize);
            self.row[column..column + width].copy_from_slice(&values[entry.value + row * width..][..width]);
        }
        let (first, from) = (block.first as usize, block.diagonal + row * block.size as usize);
        self.row[first..first + row].copy_from_slice(&values[from..from + row]);
    }

    /// Eliminates a supernode of one column from the row in work, whose entry comes below `rows`. Returns its part of lᵀ D l.
    fn meet_one(&mut self, node: &Supernode, rows: &[u32]) -> T {
        let first = node.first as usize;
        let part = std::mem::take(&mut self.row[first]);
        let column = &mut self.panels[node.panel + 1..][..rows.len() + 1];
        for (&row, entry) in rows.iter().zip(&*column) {
            self.row[row as usize] -= *entry * part;
        }
        let entry = part * self.reciprocals[first];
        column[rows.len()] = entry;
        entry * part
    }

    /// The same for a few columns.
    fn meet<const W: usize>(&mut self, node: &Supernode, rows: &[u32]) -> T {
        let first = node.first as usize;
        let panel = &mut self.panels[node.panel..][..(W + rows.len() + 1) * W];
        let (panel, _) = panel.as_chunks_mut::<W>();
        let mut part = [T::default(); W];
        part.copy_from_slice(&self.row[first..first + W]);
        self.row[first..first + W].fill(T::default());
        for c in 1..W {
            for b in 0..c {
                let known = panel[c][b] * part[b];
                part[c] -= known;
            }
        }
        for (&row, entries) in rows.iter().zip(&panel[W..]) {
            let mut sum = T::default();
            for c in 0..W {
                sum += entries[c] * part[c];
            }
            self.row[row as usize] -= sum;
        }
        let reciprocals = &self.reciprocals[first..first + W];
        let entries = &mut panel[W + rows.len()];
        let mut square = T::default();
        for c in 0..W {
            entries[c] = part[c] * reciprocals[c];
            square += entries[c] * part[c];
        }
        square
    }

    /// The same for any number of columns.
    fn meet_wide(&mut self, node: &Supernode, rows: &[u32]) -> T {
        let (first, width) = (node.first as usize, node.width as usize);
        let panel = &mut self.panels[node.panel..][..(width + rows.len() + 1) * width];
        let (triangle, below) = panel.split_at_mut(width * width);
        let part = &mut self.part[..width];
        part.copy_from_slice(&self.row[first..first + width]);
        self.row[first..first + width].fill(T::default());
        solve_unit_lower(triangle, width, part);
        let (above, new) = below.split_at_mut(rows.len() * width);
        for (&row, entries) in rows.iter().zip(above.chunks_exact(width)) {
            self.row[row as usize] -= dot(entries, part);
        }
        append(new, part, &self.reciprocals[first..first + width])
    }

    /// The columns of the row's own supernode that are left of it.
    fn meet_own(&mut self, node: &Supernode, k: usize) -> T {
        let (first, width) = (node.first as usize, node.width as usize);
        let above = k - first;
        if above == 0 {
            return T::default();
        }
        let triangle = &mut self.panels[node.panel..][..(above + 1) * width];
        let (triangle, new) = triangle.split_at_mut(above * width);
        let part = &mut self.part[..above];
        part.copy_from_slice(&self.row[first..k]);
        self.row[first..k].fill(T::default());
        solve_unit_lower(triangle, width, part);
        append(&mut new[..above], part, &self.reciprocals[first..k])
    }

    /// A x = b in place, in the order of elimination: L z = b, then Lᵀ x = D⁻¹ z.
    pub(super) fn solve(&self, symbolic: &Symbolic, x: &mut [T]) {
        for node in &symbolic.nodes {
            self.solve_forwards(symbolic, node, x);
        }
        for node in symbolic.nodes.iter().rev() {
            self.solve_backwards(symbolic, node, x);
        }
    }

    fn solve_forwards(&self, symbolic: &Symbolic, node: &Supernode, x: &mut [T]) {
        let (width, rows) = (node.width as usize, node_rows(symbolic, node));
        let panel = &self.panels[node.panel..][..(width + rows.len()) * width];
        let (own, below) = x[node.first as usize..].split_at_mut(width);
        let offset = node.first + node.width;
        if width == 1 {
            for (&row, entry) in rows.iter().zip(&panel[1..]) {
                below[(row - offset) as usize] -= *entry * own[0];
            }
            return;
        }
        solve_unit_lower(panel, width, own);
        for (&row, entries) in rows.iter().zip(panel[width * width..].chunks_exact(width)) {
            below[(row - offset) as usize] -= dot(entries, own);
        }
    }

    fn solve_backwards(&self, symbolic: &Symbolic, node: &Supernode, x: &mut [T]) {
        let (first, width, rows) = (node.first as usize, node.width as usize, node_rows(symbolic, node));
        let panel = &self.panels[node.panel..][..(width + rows.len()) * width];
        let (own, below) = x[first..].split_at_mut(width);
        let offset = node.first + node.width;
        for (x, reciprocal) in own.iter_mut().zip(&self.reciprocals[first..first + width]) {
            *x = *x * *reciprocal;
        }
        if width == 1 {
            for (&row, entry) in rows.iter().zip(&panel[1..]) {
                own[0] -= *entry * below[(row - offset) as usize];
            }
            return;
        }
        for (&row, entries) in rows.iter().zip(panel[width * width..].chunks_exact(width)) {
            subtract_multiple(own, entries, below[(row - offset) as usize]);
        }
        for c in (1..width).rev() {
            let (before, x) = own.split_at_mut(c);
            subtract_multiple(before, &panel[c * width..][..c], x[0]);
        }
    }
}

fn node_rows<'a>(symbolic: &'a Symbolic, node: &Supernode) -> &'a [u32] {
    &symbolic.rows[node.rows_start as usize..][..node.below as usize]
}

/// T x = b in place for the unit lower triangle in the first rows of a panel of this width.
fn solve_unit_lower<T: Scalar>(panel: &[T], width: usize, x: &mut [T]) {
    for c in 1..x.len() {
        let (before, after) = x.split_at_mut(c);
        after[0] -= dot(&panel[c * width..][..c], before);
    }
}

/// New entries of L: `part` divided by the pivots. Returns Σ entry · part.
fn append<T: Scalar>(new: &mut [T], part: &[T], reciprocals: &[T]) -> T {
    let mut square = T::default();
    for ((entry, part), reciprocal) in new.iter_mut().zip(part).zip(reciprocals) {
        *entry = *part * *reciprocal;
        square += *entry * *part;
    }
    square
}

/// Σ a b in four interleaved sums, always the same four, so that additions need not wait for one another.
#[inline(always)]
fn dot<T: Scalar>(a: &[T], b: &[T]) -> T {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<4>(), b.as_chunks::<4>());
    let mut sums = [T::default(); 4];
    for (a, b) in a.iter().zip(b) {
        for k in 0..4 {
            sums[k] += a[k] * b[k];
        }
    }
    let rest = a_rest.iter().zip(b_rest).fold(T::default(), |sum, (a, b)| sum + *a * *b);
    (sums[0] + sums[2]) + (sums[1] + sums[3]) + rest
}

/// x −= factor · row.
#[inline(always)]
fn subtract_multiple<T: Scalar>(x: &mut [T], row: &[T], factor: T) {
    for (x, entry) in x.iter_mut().zip(row) {
        *x -= factor * *entry;
    }
}
