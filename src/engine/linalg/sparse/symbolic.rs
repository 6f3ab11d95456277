//! Everything about the factor that depends on the pattern alone: where fill arises, where each entry is stored, and which
//! columns a row needs. Done once per topology.
//!
//! The elimination tree says it all: the parent of column j is the row of the first entry below the diagonal of L, and row k of
//! L has an entry in exactly the columns that lie on the paths from the entries of row k of A up to k. Neighbouring columns
//! with the same rows below form a *supernode*: its rows are listed once and its entries lie in one dense panel, so that the
//! numeric part reads and writes few indices.
//!
//! Davis, "Direct Methods for Sparse Linear Systems" (2006), chapter 4; Liu, Ng and Peyton, "On finding supernodes for sparse
//! matrix computations", SIAM J. Matrix Anal. Appl. 14 (1993).

use super::blocks::{subtract_pair, subtract_symmetric};
use super::graph::Graph;
use super::ordering::order;

/// Columns `first..first + width` of L. Below its dense triangle stand the rows `rows[rows_start..][..below]`. The panel holds
/// `width + below` rows of `width` entries from `panel` on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Supernode {
    pub(super) first: u32,
    pub(super) width: u32,
    pub(super) rows_start: u32,
    pub(super) below: u32,
    pub(super) panel: usize,
}

/// A block of A left of the diagonal: its columns and its first entry in the values.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) column: u32,
    pub(super) width: u32,
    pub(super) value: usize,
}

/// Row `k` meets supernode `node` in row `position` below its triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meeting {
    pub(super) node: u32,
    pub(super) position: u32,
}

/// A row of blocks, in the order of elimination.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlockRow {
    /// First scalar row, and how many.
    pub(super) first: u32,
    pub(super) size: u32,
    /// The supernode it belongs to.
    pub(super) node: u32,
    /// First of its entries and of its meetings; the next row's first ends them.
    pub(super) entries: u32,
    pub(super) meetings: u32,
    /// First entry of the diagonal block in the values.
    pub(super) diagonal: usize,
}

/// The pattern of one matrix. All numbers of rows and columns are in the order of elimination.
#[derive(Clone, Debug, Default)]
pub(super) struct Symbolic {
    /// Block eliminated at each place.
    pub(super) order: Vec<u32>,
    pub(super) block_rows: Vec<BlockRow>,
    pub(super) entries: Vec<Entry>,
    pub(super) meetings: Vec<Meeting>,
    pub(super) nodes: Vec<Supernode>,
    pub(super) rows: Vec<u32>,
    /// Scalar rows in all, entries of all panels, entries of the values, widest supernode.
    pub(super) size: usize,
    pub(super) panels: usize,
    pub(super) values: usize,
    pub(super) widest: usize,
}

/// Of the columns of L of one block: scalar rows and blocks below it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Count {
    pub(super) rows: u32,
    pub(super) blocks: u32,
}

impl Symbolic {
    /// `values` is where the values of this part begin. Returns what each column of blocks holds.
    pub(super) fn analyse(&mut self, graph: &Graph, sizes: &[u8], values: usize) -> Vec<Count> {
        let ordered = order(graph, sizes);
        let lower = LowerPattern::new(graph, &ordered);
        let postorder = postorder(&lower.elimination_tree());
        self.order.clear();
        self.order.extend(postorder.iter().map(|&k| ordered[k as usize]));
        let lower = LowerPattern::new(graph, &self.order);
        let parent = lower.elimination_tree();
        self.place_rows(&lower, sizes, values);
        let counts = self.column_counts(&lower, &parent);
        self.find_supernodes(&parent, &counts);
        self.find_meetings(&lower, &parent);
        counts
    }

    /// Where every block of A stands in the values: row after row, the diagonal block last in its row.
    fn place_rows(&mut self, lower: &LowerPattern, sizes: &[u8], values: usize) {
        self.block_rows.clear();
        self.entries.clear();
        let (mut first, mut value) = (0, values);
        for (k, &block) in self.order.iter().enumerate() {
            let size = u32::from(sizes[block as usize]);
            let entries = self.entries.len() as u32;
            for &column in lower.row(k) {
                let BlockRow { first: column, size: width, .. } = self.block_rows[column as usize];
                self.entries.push(Entry { column, width, value });
                value += (size * width) as usize;
            }
            self.block_rows.push(BlockRow { first, size, node: 0, entries, meetings: 0, diagonal: value });
            value += (size * size) as usize;
            first += size;
        }
        self.size = first as usize;
        self.values = value - values;
        // A last row of no size, so that every row's entries and meetings end where the next one's begin.
        let entries = self.entries.len() as u32;
        self.block_rows.push(BlockRow { first, size: 0, node: 0, entries, meetings: 0, diagonal: value });
    }

    /// First value of the block in block row `row` and block column `column` < `row`, both in the order of elimination. It
    /// must be part of the pattern.
    pub(super) fn slot(&self, row: usize, column: usize) -> usize {
        let entries = &self.entries[self.block_rows[row].entries as usize..self.block_rows[row + 1].entries as usize];
        let at = entries.binary_search_by_key(&self.block_rows[column].first, |entry| entry.column);
        entries[at.expect("every pair given to the analysis has a block")].value
    }

    /// r −= A x, where `rows[k]` is the place in x and r of row k in the order of elimination.
    pub(super) fn subtract_product(&self, values: &[f64], rows: &[u32], x: &[f64], r: &mut [f64]) {
        for pair in self.block_rows.windows(2) {
            let (block, next) = (&pair[0], &pair[1]);
            let size = block.size as usize;
            let own = &rows[block.first as usize..][..size];
            subtract_symmetric(&values[block.diagonal..], own, x, r);
            for entry in &self.entries[block.entries as usize..next.entries as usize] {
                let columns = &rows[entry.column as usize..][..entry.width as usize];
                subtract_pair(&values[entry.value..][..size * columns.len()], own, columns, x, r);
            }
        }
    }

    /// Walks every row of L once through the tree.
    fn column_counts(&self, lower: &LowerPattern, parent: &[u32]) -> Vec<Count> {
        let n = self.order.len();
        let mut counts = vec![Count::default(); n];
        let mut met = vec![u32::MAX; n];
        for k in 0..n {
            met[k] = k as u32;
            for &from in lower.row(k) {
                let mut column = from as usize;
                while met[column] != k as u32 {
                    met[column] = k as u32;
                    counts[column].rows += self.block_rows[k].size;
                    counts[column].blocks += 1;
                    column = parent[column] as usize;
                }
            }
        }
        counts
    }

    /// A column joins the one before it if that one's first row below is it and the rest of the rows are the same.
    fn find_supernodes(&mut self, parent: &[u32], counts: &[Count]) {
        self.nodes.clear();
        let (mut rows, mut panel) = (0, 0);
        let mut k = 0;
        while k < self.order.len() {
            let start = k;
            while parent[k] == k as u32 + 1 && counts[k].rows == counts[k + 1].rows + self.block_rows[k + 1].size {
                k += 1;
            }
            let first = self.block_rows[start].first;
            let width = self.block_rows[k + 1].first - first;
            let below = counts[k].rows;
            for row in &mut self.block_rows[start..=k] {
                row.node = self.nodes.len() as u32;
            }
            self.nodes.push(Supernode { first, width, rows_start: rows, below, panel });
            rows += below;
            panel += (width as usize) * (width + below) as usize;
            k += 1;
        }
        self.rows.clear();
        self.rows.resize(rows as usize, 0);
        self.panels = panel;
        self.widest = self.nodes.iter().map(|node| node.width as usize).max().unwrap_or(0);
    }

    /// Which supernodes each row meets, in ascending order, and with that the rows of every supernode.
    fn find_meetings(&mut self, lower: &LowerPattern, parent: &[u32]) {
        self.meetings.clear();
        let mut filled = vec![0; self.nodes.len()];
        let mut met = vec![u32::MAX; self.nodes.len()];
        let mut above = vec![u32::MAX; self.nodes.len()];
        for (k, &parent) in parent.iter().enumerate() {
            // The last column of a supernode writes last.
            above[self.block_rows[k].node as usize] =
                if parent == u32::MAX { u32::MAX } else { self.block_rows[parent as usize].node };
        }
        for k in 0..self.order.len() {
            let BlockRow { first, size, node: own, .. } = self.block_rows[k];
            let start = self.meetings.len();
            self.block_rows[k].meetings = start as u32;
            for &from in lower.row(k) {
                let mut node = self.block_rows[from as usize].node;
                while node != own && met[node as usize] != k as u32 {
                    met[node as usize] = k as u32;
                    let position: &mut u32 = &mut filled[node as usize];
                    self.meetings.push(Meeting { node, position: *position });
                    let at = (self.nodes[node as usize].rows_start + *position) as usize;
                    (0..size).for_each(|row| self.rows[at + row as usize] = first + row);
                    *position += size;
                    node = above[node as usize];
                }
            }
            self.meetings[start..].sort_unstable_by_key(|meeting| meeting.node);
        }
        self.block_rows[self.order.len()].meetings = self.meetings.len() as u32;
    }
}

/// The pattern left of the diagonal, row by row, in a given order.
struct LowerPattern {
    start: Vec<u32>,
    columns: Vec<u32>,
}

impl LowerPattern {
    fn new(graph: &Graph, order: &[u32]) -> Self {
        let mut place = vec![0; order.len()];
        order.iter().enumerate().for_each(|(k, &block)| place[block as usize] = k as u32);
        let (mut start, mut columns) = (vec![0], Vec::new());
        for (k, &block) in order.iter().enumerate() {
            let from = columns.len();
            let places = graph.neighbours(block as usize).iter().map(|&other| place[other as usize]);
            columns.extend(places.filter(|&column| (column as usize) < k));
            columns[from..].sort_unstable();
            start.push(columns.len() as u32);
        }
        Self { start, columns }
    }

    fn row(&self, k: usize) -> &[u32] {
        &self.columns[self.start[k] as usize..self.start[k + 1] as usize]
    }

    /// The parent of every column, `u32::MAX` for a root. Liu's algorithm: paths that were walked are cut short.
    fn elimination_tree(&self) -> Vec<u32> {
        let n = self.start.len() - 1;
        let mut parent = vec![u32::MAX; n];
        let mut shortcut = vec![u32::MAX; n];
        for k in 0..n {
            for &from in self.row(k) {
                let mut column = from as usize;
                while column != k {
                    let next = std::mem::replace(&mut shortcut[column], k as u32);
                    if next == u32::MAX {
                        parent[column] = k as u32;
                        break;
                    }
                    column = next as usize;
                }
            }
        }
        parent
    }
}

/// The nodes of the forest so that every subtree stands together and before its root. It changes neither fill nor work.
fn postorder(parent: &[u32]) -> Vec<u32> {
    let n = parent.len();
    let (mut child, mut sibling) = (vec![u32::MAX; n], vec![u32::MAX; n]);
    let mut stack = Vec::new();
    for k in (0..n).rev() {
        match parent[k] {
            u32::MAX => stack.push(k as u32),
            above => sibling[k] = std::mem::replace(&mut child[above as usize], k as u32),
        }
    }
    let mut order = Vec::with_capacity(n);
    while let Some(&top) = stack.last() {
        match std::mem::replace(&mut child[top as usize], u32::MAX) {
            u32::MAX => {
                order.push(top);
                stack.pop();
            }
            first => {
                // The siblings of the first child follow once it is done.
                child[top as usize] = sibling[first as usize];
                stack.push(first);
            }
        }
    }
    order
}
