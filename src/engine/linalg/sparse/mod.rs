//! A direct solver for symmetric matrices of 1 to 3-row blocks, as A = J M⁻¹ Jᵀ + α̃ of a graph of constraints: A = L D Lᵀ.
//!
//! A matrix falls into the connected components of its graph, and each is treated as what it is ([`Path`]): single blocks and
//! chains by loops of their own ([`chain`], [`block_chain`]), all else by a general sparse factorisation with a fill-reducing
//! order (`ordering`, `symbolic`, `numeric`). The pattern is analysed once per topology; afterwards factor and solve allocate
//! nothing.
//!
//! [`block_tridiagonal`] is for matrices that are not symmetric or not definite, and stands alone.
//!
//! A shall be positive (semi)definite or quasi-definite; no rows are exchanged for stability. Redundant rows are dropped, see
//! [`DROP`]. A zero on the diagonal that elimination has not filled when its turn comes is taken for a redundant row, so that
//! a saddle-point matrix needs at least a tiny −α̃ there.
//!
//! ```
//! use tautline::engine::linalg::sparse::Ldl;
//! let mut ldl = Ldl::default();
//! ldl.analyse(&[1, 1, 1], &[(0, 1), (2, 1)]);
//! let slots = [ldl.diagonal_slot(0), ldl.diagonal_slot(1), ldl.diagonal_slot(2), ldl.pair_slot(0).0, ldl.pair_slot(1).0];
//! let values = ldl.values_mut();
//! for (slot, value) in slots.into_iter().zip([2.0, 2.0, 2.0, -1.0, -1.0]) {
//!     values[slot] = value;
//! }
//! assert_eq!(ldl.factor().dropped, 0);
//! let mut x = [1.0, 0.0, 1.0];
//! ldl.solve(&mut x);
//! assert!(x.iter().all(|x| (x - 1.0).abs() < 1e-15));
//! ```

pub mod block_chain;
pub mod block_tridiagonal;
mod blocks;
pub mod chain;
mod chordal;
pub(crate) mod complex_ldl;
mod graph;
mod numeric;
mod ordering;
mod pivots;
mod summary;
mod symbolic;

pub use pivots::{DROP, Pivots};
pub use summary::{Components, Path, Summary};

use blocks::{Part, Shape};
use graph::Graph;
use numeric::Numeric;
use symbolic::{Count, Symbolic};

/// The factorisation of one matrix. May be reused for another pattern; it keeps its memory.
#[derive(Clone, Debug, Default)]
pub struct Ldl {
    /// First row of every block, in the caller's order, and the number of rows.
    first_row: Vec<u32>,
    diagonal_slots: Vec<u32>,
    pair_slots: Vec<(u32, bool)>,
    values: Vec<f64>,
    /// Single blocks and chains.
    parts: Vec<Part>,
    /// The caller's rows of all parts, then those of the general part.
    rows: Vec<u32>,
    /// Pivots and off-diagonal blocks of L of all parts.
    pivots: Vec<f64>,
    lower: Vec<f64>,
    symbolic: Symbolic,
    numeric: Numeric<f64>,
    general_rows: usize,
    /// A vector in the order of elimination; the residual.
    gathered: Vec<f64>,
    residual: Vec<f64>,
    dropped: Vec<u32>,
    graph: Graph,
}

impl Ldl {
    /// Prepares for matrices of this pattern. `sizes[k]` is the number of rows (1 to 3) of block k; `pairs` are the (i, j),
    /// i ≠ j, of blocks that share an off-diagonal block. Pairs may repeat and stand in any order and orientation.
    ///
    /// Afterwards all values are zero. Allocates; costs about as much as a few factorisations.
    ///
    /// # Panics
    /// If a pair names a block that does not exist, or a size is not 1, 2 or 3.
    pub fn analyse(&mut self, sizes: &[u8], pairs: &[(u32, u32)]) -> Summary {
        assert!(sizes.iter().all(|size| (1..=3).contains(size)), "a block has 1 to 3 rows");
        self.graph.build(sizes.len(), pairs);
        self.first_row.clear();
        self.first_row.push(0);
        let mut rows = 0;
        self.first_row.extend(sizes.iter().map(|&size| {
            rows += u32::from(size);
            rows
        }));
        let mut summary = Summary { rows: rows as usize, blocks: sizes.len(), ..Summary::default() };
        let rest = self.find_parts(sizes, &mut summary);
        self.place_general(sizes, &rest, &mut summary);
        self.place_pairs(sizes, pairs);
        for list in [&mut self.gathered, &mut self.residual] {
            list.clear();
            list.resize(rows as usize, 0.0);
        }
        self.dropped.clear();
        self.dropped.reserve(rows as usize);
        summary
    }

    /// Sorts the components: single blocks, chains, and the blocks of all others.
    fn find_parts(&mut self, sizes: &[u8], summary: &mut Summary) -> Vec<Vec<u32>> {
        self.parts.clear();
        self.rows.clear();
        self.diagonal_slots.clear();
        self.diagonal_slots.resize(sizes.len(), 0);
        let mut singles: [Vec<u32>; 3] = Default::default();
        let (mut chains, mut rest) = (Vec::new(), Vec::new());
        for component in self.graph.components() {
            let size = sizes[component[0] as usize];
            let alike = component.iter().all(|&block| sizes[block as usize] == size);
            match self.graph.path(&component).filter(|_| alike) {
                Some(path) if path.len() == 1 => singles[size as usize - 1].push(path[0]),
                Some(path) => chains.push(path),
                None => rest.push(component),
            }
        }
        let (mut value, mut pivot, mut lower) = (0, 0, 0);
        let singles = singles.iter().filter(|blocks| !blocks.is_empty()).map(|blocks| (blocks, Shape::Diagonal));
        for (blocks, shape) in singles.chain(chains.iter().map(|blocks| (blocks, Shape::Chain))) {
            let block = sizes[blocks[0] as usize] as usize;
            let part = Part::new(shape, block, blocks.len(), [value, pivot, lower], &mut self.rows, |k| {
                self.first_row[blocks[k] as usize]
            });
            for (k, &name) in blocks.iter().enumerate() {
                self.diagonal_slots[name as usize] = (value + k * block * block) as u32;
            }
            [value, pivot, lower] = part.end();
            summary.add_part(&part);
            self.parts.push(part);
        }
        for (list, length) in [(&mut self.values, value), (&mut self.pivots, pivot), (&mut self.lower, lower)] {
            list.clear();
            list.resize(length, 0.0);
        }
        rest
    }

    /// Everything that is no chain, as one matrix.
    fn place_general(&mut self, sizes: &[u8], components: &[Vec<u32>], summary: &mut Summary) {
        let mut blocks: Vec<u32> = components.iter().flatten().copied().collect();
        blocks.sort_unstable();
        let mut place = vec![u32::MAX; sizes.len()];
        blocks.iter().enumerate().for_each(|(k, &block)| place[block as usize] = k as u32);
        let mut edges = Vec::new();
        for &block in &blocks {
            let above = self.graph.neighbours(block as usize).iter().filter(|&&other| other < block);
            edges.extend(above.map(|&other| (place[block as usize], place[other as usize])));
        }
        let mut graph = Graph::default();
        graph.build(blocks.len(), &edges);
        let general_sizes: Vec<u8> = blocks.iter().map(|&block| sizes[block as usize]).collect();
        let counts = self.symbolic.analyse(&graph, &general_sizes, self.values.len());
        self.numeric.reserve(&self.symbolic);
        self.values.resize(self.values.len() + self.symbolic.values, 0.0);
        self.general_rows = self.rows.len();
        let mut of_block = vec![Count::default(); sizes.len()];
        for (k, count) in counts.into_iter().enumerate() {
            let block = blocks[self.symbolic.order[k] as usize];
            // From here on the order names the caller's blocks.
            self.symbolic.order[k] = block;
            of_block[block as usize] = count;
            self.diagonal_slots[block as usize] = self.symbolic.block_rows[k].diagonal as u32;
            let first = self.first_row[block as usize];
            self.rows.extend(first..first + u32::from(sizes[block as usize]));
        }
        for component in components {
            let edges = component.iter().map(|&block| self.graph.degree(block as usize)).sum::<usize>() / 2;
            summary.add_general(edges, component.iter().map(|&k| (sizes[k as usize], of_block[k as usize])));
        }
    }

    /// Finds for every pair the block that was placed for it.
    fn place_pairs(&mut self, sizes: &[u8], pairs: &[(u32, u32)]) {
        // Where a block stands: in a chain, or in the general part.
        let mut chain_places = vec![(u32::MAX, 0); sizes.len()];
        let block_at = {
            let mut block_at = vec![0; self.rows.len()];
            self.first_row.windows(2).enumerate().for_each(|(k, row)| block_at[row[0] as usize] = k);
            block_at
        };
        for (p, part) in self.parts.iter().enumerate() {
            for (k, row) in part.first_rows(&self.rows).enumerate() {
                chain_places[block_at[row as usize]] = (p as u32, k);
            }
        }
        let mut general_places = vec![0; sizes.len()];
        self.symbolic.order.iter().enumerate().for_each(|(k, &block)| general_places[block as usize] = k);
        self.pair_slots.clear();
        self.pair_slots.extend(pairs.iter().map(|&(i, j)| {
            let (i, j) = (i as usize, j as usize);
            if i == j {
                return (self.diagonal_slots[i], false);
            }
            let ((part, a), (_, b)) = (chain_places[i], chain_places[j]);
            if part != u32::MAX {
                return (self.parts[part as usize].off_slot(a.min(b)) as u32, a < b);
            }
            let (a, b) = (general_places[i], general_places[j]);
            (self.symbolic.slot(a.max(b), a.min(b)) as u32, a < b)
        }));
    }

    /// First entry, in the values, of diagonal block k: row-major, of which the lower triangle with the diagonal is read.
    pub fn diagonal_slot(&self, k: usize) -> usize {
        self.diagonal_slots[k] as usize
    }

    /// First entry, in the values, of the block of pair p as given to [`analyse`](Self::analyse), and whether it is stored as
    /// block (j, i) of the pair (i, j), that is transposed. Row-major; repeated pairs share one block, to which each adds.
    pub fn pair_slot(&self, p: usize) -> (usize, bool) {
        let (slot, transposed) = self.pair_slots[p];
        (slot as usize, transposed)
    }

    /// The matrix. They stay as they are until changed: fill with 0 first where entries are added up. Blocks of a chain stand
    /// one after another, first the n on the diagonal, then the n − 1 between them.
    pub fn values_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// The matrix as it was last written.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Factors the matrix that the values hold; they are kept. Linear cost for chains and trees.
    pub fn factor(&mut self) -> Pivots {
        let mut pivots = self.numeric.factor(&self.symbolic, &self.values);
        for part in &self.parts {
            pivots.join(part.factor(&self.values, &mut self.pivots, &mut self.lower));
        }
        self.dropped.clear();
        if pivots.dropped > 0 {
            self.list_dropped();
        }
        pivots
    }

    fn list_dropped(&mut self) {
        for part in &self.parts {
            part.list_dropped(&self.pivots, &self.rows, &mut self.dropped);
        }
        let general = self.rows[self.general_rows..].iter().zip(&self.numeric.reciprocals);
        self.dropped.extend(general.filter(|(_, reciprocal)| **reciprocal == 0.0).map(|(&row, _)| row));
        self.dropped.sort_unstable();
    }

    /// The rows that the last factorisation dropped, ascending; their unknowns are 0.
    pub fn dropped_rows(&self) -> &[u32] {
        &self.dropped
    }

    /// A x = b in place, with the last factor; `b` holds the rows of block 0, 1, … one after another.
    ///
    /// Dropped unknowns are 0. If rows depend on one another, the equations of the dropped ones hold if b is consistent.
    ///
    /// # Panics
    /// If `b` is too short.
    pub fn solve(&mut self, b: &mut [f64]) {
        for part in &self.parts {
            part.solve(&self.pivots, &self.lower, &self.rows, &mut self.gathered, b);
        }
        let rows = &self.rows[self.general_rows..];
        if !rows.is_empty() {
            let x = &mut self.gathered[..rows.len()];
            gather(rows, b, x);
            self.numeric.solve(&self.symbolic, x);
            scatter(rows, x, b);
        }
    }

    /// r = b − A x. Returns the greatest magnitude in r, NaN if one of them is.
    ///
    /// # Panics
    /// If a slice is too short.
    pub fn residual(&self, b: &[f64], x: &[f64], r: &mut [f64]) -> f64 {
        let rows = self.gathered.len();
        r[..rows].copy_from_slice(&b[..rows]);
        for part in &self.parts {
            part.subtract_product(&self.values, &self.rows, x, r);
        }
        self.symbolic.subtract_product(&self.values, &self.rows[self.general_rows..], x, r);
        r[..rows].iter().fold(0.0, |most: f64, r| if r.abs() <= most { most } else { r.abs() })
    }

    /// One step of iterative refinement: x += A⁻¹ (b − A x). Returns ‖b − A x‖∞ of the x handed in. After one step the
    /// backward error is at the level of rounding (Skeel 1980) even where dropped or tiny pivots have let entries grow.
    ///
    /// # Panics
    /// If a slice is too short.
    pub fn refine(&mut self, b: &[f64], x: &mut [f64]) -> f64 {
        let mut r = std::mem::take(&mut self.residual);
        let found = self.residual(b, x, &mut r);
        self.solve(&mut r);
        x.iter_mut().zip(&r).for_each(|(x, r)| *x += r);
        self.residual = r;
        found
    }
}

fn gather(rows: &[u32], from: &[f64], to: &mut [f64]) {
    to.iter_mut().zip(rows).for_each(|(to, &row)| *to = from[row as usize]);
}

fn scatter(rows: &[u32], from: &[f64], to: &mut [f64]) {
    from.iter().zip(rows).for_each(|(from, &row)| to[row as usize] = *from);
}
