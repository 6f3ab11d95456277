//! What the analysis of a pattern found, to be shown to a user.

use super::blocks::{Part, Shape};
use super::symbolic::Count;

/// How a component of the matrix is solved, the cheapest first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Path {
    /// Single blocks, coupled with nothing.
    #[default]
    Diagonal,
    /// Blocks of this many rows, each coupled with the next.
    Chain {
        /// Rows of a block, ≥ 1.
        block: u8,
    },
    /// Elimination fills nothing in: trees, and cliques that hang together like one. Linear cost if the cliques are small.
    Tree,
    /// Everything else.
    Sparse,
}

impl Path {
    /// The name of the matrix, as shown to a user.
    pub fn name(self) -> &'static str {
        match self {
            Path::Diagonal => "diagonal",
            Path::Chain { block: 1 } => "tridiagonal",
            Path::Chain { .. } => "block tridiagonal",
            Path::Tree => "sparse, without fill",
            Path::Sparse => "sparse, with fill",
        }
    }
}

/// Connected components by [`Path`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Components {
    /// Components on [`Path::Diagonal`].
    pub diagonal: usize,
    /// Components on [`Path::Chain`], of any block size.
    pub chains: usize,
    /// Components on [`Path::Tree`].
    pub trees: usize,
    /// Components on [`Path::Sparse`].
    pub sparse: usize,
}

/// Size and cost of a pattern.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    /// Order of the matrix.
    pub rows: usize,
    /// Its diagonal blocks: groups of rows that are eliminated together.
    pub blocks: usize,
    /// Entries of L below the diagonal.
    pub nonzeros: usize,
    /// Additions, multiplications and divisions of one factorisation, Σ (c + 1)² over the columns of L with c entries below
    /// the diagonal: c products with 1 / pivot, c (c + 1) / 2 multiply-adds, one division.
    pub flops: usize,
    /// Of the most expensive component.
    pub path: Path,
    /// How many components are solved in which way.
    pub components: Components,
}

impl Summary {
    fn add_columns(&mut self, rows: u8, below: u32) {
        for row in 0..usize::from(rows) {
            let entries = usize::from(rows) - 1 - row + below as usize;
            self.nonzeros += entries;
            self.flops += (entries + 1) * (entries + 1);
        }
    }

    pub(super) fn add_part(&mut self, part: &Part) {
        let block = part.block as u8;
        let coupled = if part.shape == Shape::Chain { part.count - 1 } else { 0 };
        (0..coupled).for_each(|_| self.add_columns(block, u32::from(block)));
        (coupled..part.count).for_each(|_| self.add_columns(block, 0));
        self.path = self.path.max(match part.shape {
            Shape::Diagonal => Path::Diagonal,
            Shape::Chain => Path::Chain { block },
        });
        match part.shape {
            Shape::Diagonal => self.components.diagonal += part.count,
            Shape::Chain => self.components.chains += 1,
        }
    }

    /// Adds a component with this many coupled pairs and columns of this many rows.
    pub(super) fn add_general(&mut self, pairs: usize, columns: impl Iterator<Item = (u8, Count)>) {
        let mut blocks = 0;
        for (rows, count) in columns {
            blocks += count.blocks as usize;
            self.add_columns(rows, count.rows);
        }
        if blocks == pairs {
            self.path = self.path.max(Path::Tree);
            self.components.trees += 1;
        } else {
            self.path = self.path.max(Path::Sparse);
            self.components.sparse += 1;
        }
    }
}
