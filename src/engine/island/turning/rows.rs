//! The rows of J where anchors turn, one after another: rods, then two a pin.
//!
//! A row acts along n, a rod's d or a pin's axis, at one node a side: J = (−n, −e_a × n | n, e_b × n). Two rows that meet at a disc
//! are coupled by ± (w n·n′ + (e × n)(e′ × n′)/I), plus where it is the same end of both, so that every entry of A is a sum
//! of such terms. The row of a slack rope is 1 on the diagonal and nothing else.

use super::{NONE, Turning};
use crate::engine::island::linear::Entry;
use crate::engine::island::matrix::Matrix;
use crate::engine::island::system::{Pins, Rods};
use crate::engine::island::{Nodes, System};
use crate::engine::linalg::sparse::Ldl;
use crate::engine::method::LinearSolver;

/// A row's end: the node that has the mass, and the arm from it, or NONE.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct End {
    pub node: u32,
    pub arm: u32,
}

impl End {
    /// Whether there is an arm.
    pub fn is_off_centre(&self) -> bool {
        self.arm != NONE
    }
}

/// What the meeting of two rows at a disc adds to one entry of A.
#[derive(Clone, Copy, Debug)]
struct Term {
    slot: u32,
    rows: [u32; 2],
    /// Which end of each row, 0 or 1.
    ends: [u8; 2],
    /// ± w [1/kg] and ± 1/I [1/(kg·m²)].
    weight: f64,
    turn: f64,
}

/// Rows and entries of A of an island where something turns.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rows {
    /// By row: ends a and b.
    pub ends: Vec<[End; 2]>,
    /// n.
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    /// e × n at both ends.
    pub moment: Vec<[f64; 2]>,
    terms: Vec<Term>,
    /// Slots of the diagonals of ropes.
    rope_diagonal: Vec<u32>,
}

impl Rows {
    /// n·(M⁻¹ n) over both ends of a rod, n of unit length [1/kg].
    pub fn mobility(&self, r: usize, system: &System) -> f64 {
        let square = self.x[r] * self.x[r] + self.y[r] * self.y[r];
        let rotors = &system.turning.rotors;
        let at = |(end, moment): (&End, &f64)| {
            let turn = match end.arm {
                NONE => 0.0,
                arm => rotors.inverse_inertia[system.turning.arms.rotor[arm as usize] as usize] * moment * moment,
            };
            system.nodes.w[end.node as usize] * square + turn
        };
        self.ends[r].iter().zip(&self.moment[r]).map(at).sum::<f64>() / square
    }

    /// n and e × n for differences d of the rods.
    fn take(&mut self, turning: (&[f64], &[f64]), dx: &[f64], dy: &[f64]) {
        self.x[..dx.len()].copy_from_slice(dx);
        self.y[..dy.len()].copy_from_slice(dy);
        let (arm_x, arm_y) = turning;
        for (((ends, x), y), moment) in self.ends.iter().zip(&self.x).zip(&self.y).zip(&mut self.moment) {
            for (end, moment) in ends.iter().zip(moment) {
                if end.arm != NONE {
                    *moment = arm_x[end.arm as usize] * y - arm_y[end.arm as usize] * x;
                }
            }
        }
    }

    fn fill(&self, values: &mut [f64], rods: &Rods) {
        values.fill(0.0);
        let slack = |row: u32| (row as usize) < rods.a.len() && !rods.held[row as usize];
        for Term { slot, rows, ends, weight, turn } in &self.terms {
            if slack(rows[0]) || slack(rows[1]) {
                continue;
            }
            let [r, s] = rows.map(|row| row as usize);
            let moments = self.moment[r][ends[0] as usize] * self.moment[s][ends[1] as usize];
            values[*slot as usize] += weight * (self.x[r] * self.x[s] + self.y[r] * self.y[s]) + turn * moments;
        }
        for (rope, slot) in (rods.first_rope..).zip(&self.rope_diagonal) {
            if !rods.held[rope] {
                values[*slot as usize] = 1.0;
            }
        }
    }
}

impl Turning {
    /// Finds rows and entries, and analyses their pattern.
    fn analyse(&mut self, nodes: &Nodes, rods: &Rods, pins: &Pins, linear: (LinearSolver, u32)) -> Matrix {
        let rod_count = rods.a.len();
        let blocks: Vec<[End; 2]> = rods
            .a
            .iter()
            .zip(&rods.b)
            .chain(pins.a.iter().zip(&pins.b))
            .map(|(a, b)| [self.end(*a), self.end(*b)])
            .collect();
        let sizes: Vec<u8> = (0..blocks.len()).map(|k| if k < rod_count { 1 } else { 2 }).collect();
        let first = |k: usize| if k < rod_count { k } else { 2 * k - rod_count };
        let mut ldl = Ldl::default();
        let meetings = self.meetings(nodes, &blocks);
        let pairs: Vec<(u32, u32)> = meetings.iter().map(|m| (m.blocks[0] as u32, m.blocks[1] as u32)).collect();
        let summary = ldl.analyse(&sizes, &pairs);
        let mut rows = Rows::default();
        for (ends, size) in blocks.iter().zip(&sizes) {
            for row in 0..*size {
                rows.ends.push(*ends);
                rows.x.push(if *size == 2 && row == 0 { 1.0 } else { 0.0 });
                rows.y.push(if *size == 2 && row == 1 { 1.0 } else { 0.0 });
                rows.moment.push([0.0; 2]);
            }
        }
        let mut entries = Vec::new();
        for (p, meeting) in meetings.iter().enumerate() {
            let [k, l] = meeting.blocks;
            let (slot, transposed) = ldl.pair_slot(p);
            for i in 0..usize::from(sizes[k]) {
                for j in 0..usize::from(sizes[l]) {
                    let (own_diagonal, below) = (k == l, j <= i);
                    if own_diagonal && !below {
                        continue;
                    }
                    let at = if transposed { j * usize::from(sizes[k]) + i } else { i * usize::from(sizes[l]) + j };
                    let term = meeting.term((slot + at) as u32, [first(k) + i, first(l) + j]);
                    let [row, column] = term.rows;
                    entries.extend([(row, column), (column, row)].map(|(row, column)| Entry {
                        row,
                        column,
                        slot: term.slot,
                    }));
                    rows.terms.push(term);
                }
            }
        }
        rows.rope_diagonal = (rods.first_rope..rod_count).map(|k| ldl.diagonal_slot(k) as u32).collect();
        let count = rows.ends.len();
        self.rows = rows;
        Matrix::of_entries(ldl, summary, linear, count, entries)
    }

    /// All pairs of blocks that meet at a body, a block with itself among them.
    fn meetings(&self, nodes: &Nodes, blocks: &[[End; 2]]) -> Vec<Meeting> {
        let mut at_node: Vec<Vec<(usize, u8)>> = vec![Vec::new(); nodes.len()];
        for (k, ends) in blocks.iter().enumerate() {
            for (which, end) in (0..).zip(ends) {
                if nodes.w[end.node as usize] > 0.0 {
                    at_node[end.node as usize].push((k, which));
                }
            }
        }
        let turn = |(k, which): (usize, u8)| match blocks[k][usize::from(which)].arm {
            NONE => 0.0,
            arm => self.rotors.inverse_inertia[self.arms.rotor[arm as usize] as usize],
        };
        let mut meetings = Vec::new();
        for (node, meeting) in at_node.iter().enumerate() {
            for (i, one) in meeting.iter().enumerate() {
                for other in &meeting[i..] {
                    let sign = if one.1 == other.1 { 1.0 } else { -1.0 };
                    meetings.push(Meeting {
                        blocks: [one.0, other.0],
                        ends: [one.1, other.1],
                        weight: sign * nodes.w[node],
                        // Zero unless both have arms.
                        turn: sign * turn(*one).min(turn(*other)),
                    });
                }
            }
        }
        meetings
    }

    /// Adds M⁻¹ Jᵀ λ, with the n and arms that the matrix was filled for, to vectors by node and by rotor.
    pub fn push(&self, w: &[f64], lambda: &[f64], x: &mut [f64], y: &mut [f64], turn: &mut [f64]) {
        let rows = &self.rows;
        for (row, lambda) in lambda.iter().enumerate() {
            let (fx, fy) = (lambda * rows.x[row], lambda * rows.y[row]);
            for (end, (moment, sign)) in rows.ends[row].iter().zip(rows.moment[row].iter().zip([-1.0, 1.0])) {
                let node = end.node as usize;
                x[node] += sign * w[node] * fx;
                y[node] += sign * w[node] * fy;
                if end.arm != NONE {
                    let rotor = self.arms.rotor[end.arm as usize] as usize;
                    turn[rotor] += sign * self.rotors.inverse_inertia[rotor] * moment * lambda;
                }
            }
        }
    }
}

/// Two blocks that meet at a body.
struct Meeting {
    blocks: [usize; 2],
    ends: [u8; 2],
    weight: f64,
    turn: f64,
}

impl Meeting {
    fn term(&self, slot: u32, rows: [usize; 2]) -> Term {
        let rows = rows.map(|row| row as u32);
        Term { slot, rows, ends: self.ends, weight: self.weight, turn: self.turn }
    }
}

impl System {
    /// Fills the matrix for the present positions, of which the differences are taken, and factors it.
    pub(in crate::engine::island) fn factor_turning(&mut self, linear: (LinearSolver, u32)) {
        if !self.matrix.analysed() {
            self.matrix = self.turning.analyse(&self.nodes, &self.rods, &self.pins, linear);
        }
        let Turning { rows, arms, .. } = &mut self.turning;
        rows.take((&arms.x, &arms.y), &self.dx, &self.dy);
        self.matrix.refactor(|values| self.turning.rows.fill(values, &self.rods));
    }
}
