//! A = J M⁻¹ Jᵀ of an island, filled in place and factored by the sparse LDLᵀ.
//!
//! Two rods r, s that share a node of inverse mass w are coupled by ± w d_r·d_s: plus where the node is the same end of both.
//! The row of a slack rope is 1 on the diagonal and nothing else, so its λ is 0 and the pattern stays.

use super::Nodes;
use super::linear::{Entry, Linear};
use super::system::{Pins, Rods};
use crate::engine::linalg::sparse::{Ldl, Pivots, Summary};
use crate::engine::method::LinearSolver;

/// Two rods with a common node.
#[derive(Clone, Copy, Debug)]
struct RodRod {
    slot: u32,
    r: u32,
    s: u32,
    /// ± inverse mass of the node [1/kg].
    weight: f64,
}

/// A rod and a pin with a common node: a 2 × 1 block, or 1 × 2 if it is stored transposed, which is the same two numbers.
#[derive(Clone, Copy, Debug)]
struct RodPin {
    slot: u32,
    r: u32,
    weight: f64,
}

/// The matrix of one island.
#[derive(Clone, Debug, Default)]
pub(crate) struct Matrix {
    ldl: Ldl,
    pub summary: Summary,
    pub pivots: Pivots,
    /// Slots of the rods' diagonals and w_a + w_b.
    diagonal: Vec<(u32, f64)>,
    /// The same of the pins, 2 × 2 blocks.
    pin_diagonal: Vec<(u32, f64)>,
    rod_rod: Vec<RodRod>,
    rod_pin: Vec<RodPin>,
    /// Diagonal blocks ± w 1 of two pins with a common node.
    pin_pin: Vec<(u32, f64)>,
    /// ± inverse masses between neighbours, where the rows are one chain in their order: the matrix is then filled by a plain loop.
    chain: Vec<f64>,
    /// What solves in place of the sparse LDLᵀ, if something does.
    pub linear: Option<Box<Linear>>,
}

impl Matrix {
    pub fn new(nodes: &Nodes, rods: &Rods, pins: &Pins, (solver, iterations): (LinearSolver, u32)) -> Matrix {
        let mut matrix = Matrix::default();
        let sizes: Vec<u8> = rods.a.iter().map(|_| 1).chain(pins.a.iter().map(|_| 2)).collect();
        let ends = || rods.a.iter().zip(&rods.b).chain(pins.a.iter().zip(&pins.b));
        // By node: the rows that meet there, with the sign of the node's end.
        let mut at_node: Vec<Vec<(u32, f64)>> = vec![Vec::new(); nodes.len()];
        for (k, (a, b)) in ends().enumerate() {
            for (node, sign) in [(*a, -1.0), (*b, 1.0)] {
                if nodes.w[node as usize] > 0.0 {
                    at_node[node as usize].push((k as u32, sign));
                }
            }
        }
        let mut pairs = Vec::new();
        let mut weights = Vec::new();
        for (node, meeting) in at_node.iter().enumerate() {
            for (i, (r, sign_r)) in meeting.iter().enumerate() {
                for (s, sign_s) in &meeting[i + 1..] {
                    // Both ends of one constraint on one node would be refused by the world.
                    pairs.push((*r, *s));
                    weights.push(sign_r * sign_s * nodes.w[node]);
                }
            }
        }
        matrix.summary = matrix.ldl.analyse(&sizes, &pairs);
        let sum = |a: u32, b: u32| nodes.w[a as usize] + nodes.w[b as usize];
        for (k, (a, b)) in ends().enumerate() {
            let entry = (matrix.ldl.diagonal_slot(k) as u32, sum(*a, *b));
            if k < rods.a.len() { matrix.diagonal.push(entry) } else { matrix.pin_diagonal.push(entry) }
        }
        if solver != LinearSolver::SparseLdl {
            let rows = rods.a.len() + 2 * pins.a.len();
            matrix.linear = Some(Box::new(Linear::new(solver, iterations, rows, matrix.entries(rods.a.len(), &pairs))));
        }
        for (p, ((r, s), weight)) in pairs.iter().zip(weights).enumerate() {
            let slot = matrix.ldl.pair_slot(p).0 as u32;
            let is_pin = |k: u32| k as usize >= rods.a.len();
            match (is_pin(*r), is_pin(*s)) {
                (false, false) => matrix.rod_rod.push(RodRod { slot, r: *r, s: *s, weight }),
                (false, true) => matrix.rod_pin.push(RodPin { slot, r: *r, weight }),
                (true, false) => matrix.rod_pin.push(RodPin { slot, r: *s, weight }),
                (true, true) => matrix.pin_pin.push((slot, weight)),
            }
        }
        matrix.chain = matrix.find_chain();
        matrix
    }

    /// A matrix whose values others fill in, analysed already; `entries` as for [`Linear::new`].
    pub fn of_entries(
        ldl: Ldl,
        summary: Summary,
        (solver, iterations): (LinearSolver, u32),
        rows: usize,
        entries: Vec<Entry>,
    ) -> Matrix {
        let other =
            (solver != LinearSolver::SparseLdl).then(|| Box::new(Linear::new(solver, iterations, rows, entries)));
        Matrix { ldl, summary, linear: other, ..Matrix::default() }
    }

    /// The weights of [`Matrix::chain`], none if the rows are no chain of rods in their order.
    fn find_chain(&self) -> Vec<f64> {
        let n = self.diagonal.len();
        let in_place = |(k, entry): (usize, &(u32, f64))| entry.0 as usize == k;
        let follows =
            |(k, pair): (usize, &RodRod)| (pair.slot as usize, pair.r as usize, pair.s as usize) == (n + k, k, k + 1);
        let chain = self.pin_diagonal.is_empty()
            && n > 1
            && self.rod_rod.len() + 1 == n
            && self.diagonal.iter().enumerate().all(in_place)
            && self.rod_rod.iter().enumerate().all(follows);
        if chain { self.rod_rod.iter().map(|pair| pair.weight).collect() } else { Vec::new() }
    }

    fn fill_chain(&mut self, dx: &[f64], dy: &[f64]) {
        let n = self.diagonal.len();
        let (diagonal, off) = self.ldl.values_mut().split_at_mut(n);
        let (dx, dy, entries) = (&dx[..n], &dy[..n], &self.diagonal[..n]);
        for k in 0..n {
            diagonal[k] = entries[k].1 * (dx[k] * dx[k] + dy[k] * dy[k]);
        }
        let (off, chain) = (&mut off[..n - 1], &self.chain[..n - 1]);
        for k in 0..n - 1 {
            off[k] = chain[k] * (dx[k] * dx[k + 1] + dy[k] * dy[k + 1]);
        }
    }

    /// Whether the pattern is known.
    pub fn analysed(&self) -> bool {
        self.summary.rows > 0
    }

    /// All entries, of both triangles: rows of rods, then two a pin, whose blocks have no entries off their diagonals.
    fn entries(&self, rods: usize, pairs: &[(u32, u32)]) -> Vec<Entry> {
        let mut entries = Vec::new();
        let row = |k: u32| if (k as usize) < rods { k } else { 2 * k - rods as u32 };
        let mut add = |row: u32, column: u32, slot: u32| {
            entries.extend([Entry { row, column, slot }, Entry { row: column, column: row, slot }]);
        };
        for (r, (slot, _)) in self.diagonal.iter().enumerate() {
            add(r as u32, r as u32, *slot);
        }
        for (p, (slot, _)) in self.pin_diagonal.iter().enumerate() {
            let first = row((rods + p) as u32);
            add(first, first, *slot);
            add(first + 1, first + 1, slot + 3);
        }
        for (p, (r, s)) in pairs.iter().enumerate() {
            let slot = self.ldl.pair_slot(p).0 as u32;
            let (rod, other) = (*r.min(s), *r.max(s));
            match ((rod as usize) < rods, (other as usize) < rods) {
                (true, true) => add(rod, other, slot),
                (true, false) => (0..2).for_each(|i| add(rod, row(other) + i, slot + i)),
                _ => (0..2).for_each(|i| add(row(rod) + i, row(other) + i, slot + 3 * i)),
            }
        }
        entries
    }

    /// The values for differences d of the rods.
    fn fill(&mut self, rods: &Rods, dx: &[f64], dy: &[f64]) {
        let ropes = rods.first_rope < rods.a.len();
        let values = self.ldl.values_mut();
        values.fill(0.0);
        for (((slot, weight), dx), dy) in self.diagonal.iter().zip(dx).zip(dy) {
            values[*slot as usize] = weight * (dx * dx + dy * dy);
        }
        for RodRod { slot, r, s, weight } in &self.rod_rod {
            let (r, s) = (*r as usize, *s as usize);
            if !ropes || (rods.held[r] && rods.held[s]) {
                values[*slot as usize] += weight * (dx[r] * dx[s] + dy[r] * dy[s]);
            }
        }
        for r in rods.first_rope..rods.a.len() {
            if !rods.held[r] {
                values[self.diagonal[r].0 as usize] = 1.0;
            }
        }
        for (slot, weight) in &self.pin_diagonal {
            values[*slot as usize] = *weight;
            values[*slot as usize + 3] = *weight;
        }
        for RodPin { slot, r, weight } in &self.rod_pin {
            let (r, slot) = (*r as usize, *slot as usize);
            if rods.held[r] {
                values[slot] += weight * dx[r];
                values[slot + 1] += weight * dy[r];
            }
        }
        for (slot, weight) in &self.pin_pin {
            values[*slot as usize] += weight;
            values[*slot as usize + 3] += weight;
        }
    }

    /// Fills in the values for differences d of the rods, and factors.
    pub fn factor(&mut self, rods: &Rods, dx: &[f64], dy: &[f64]) {
        if self.chain.is_empty() || rods.first_rope < rods.a.len() {
            self.fill(rods, dx, dy);
        } else {
            self.fill_chain(dx, dy);
        }
        self.factor_values();
    }

    /// Fills the values in by `fill`, and factors.
    pub fn refactor(&mut self, fill: impl FnOnce(&mut [f64])) {
        fill(self.ldl.values_mut());
        self.factor_values();
    }

    fn factor_values(&mut self) {
        self.pivots = match &mut self.linear {
            Some(linear) => Pivots { dropped: linear.factor(self.ldl.values()), ..Pivots::default() },
            None => self.ldl.factor(),
        };
    }

    /// Solves A x = b in place: rods, then two rows a pin.
    #[inline]
    pub fn solve(&mut self, b: &mut [f64]) {
        match &mut self.linear {
            Some(linear) => linear.solve(b),
            None => self.ldl.solve(b),
        }
    }
}
