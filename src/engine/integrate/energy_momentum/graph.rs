//! One step of any island: nets, cloth, loops, rods that are redundant.
//!
//! The primal form: a 2 × 2 block a node, H + ρ JᵀJ, with multipliers that follow by λ ← λ − ρ (C + J x) (the proximal form of
//! the augmented Lagrangian, Rockafellar 1976). Each iteration takes the error of a constraint down by about
//! [`FIRMNESS`]; redundant rods share the force, since nothing is inverted along them.
//!
//! Newton's matrix is not symmetric: its rods have d_m to the left and d' to the right. The factor takes d_m + δ/4 on both
//! sides, which leaves a skew part of a quarter of the turn, so that every solve gains a factor of some turn/4 with the same
//! factor of the matrix. That is cheaper than an unsymmetric factorisation up to turns of half a radian.

use super::discrete::{self, Linear};
use super::{Progress, TURN};
use crate::engine::island::System;
use crate::engine::linalg::sparse::Ldl;
use glam::DVec2;

const NONE: u32 = u32::MAX;
/// ρ over the inertia 2m/h² that a rod's ends have along it. More is lost in rounding, with less a net takes more iterations.
const FIRMNESS: f64 = 1e7;
/// An iteration that leaves more than this part of the correction before it is worth a new factor.
const SLOW: f64 = 0.2;

/// The matrix of an island, and the unknowns of a step.
#[derive(Debug, Default)]
pub(super) struct Graph {
    ldl: Ldl,
    /// Block of the matrix by node, or none.
    block: Vec<u32>,
    /// First value of the diagonal block, by block.
    diagonal_slot: Vec<u32>,
    rods: Edges,
    springs: Edges,
    pins: Edges,
    ux: Vec<f64>,
    uy: Vec<f64>,
    /// a and b of a node's own force b − a u.
    a: Vec<f64>,
    bx: Vec<f64>,
    by: Vec<f64>,
    /// Forces of the present iteration.
    gx: Vec<f64>,
    gy: Vec<f64>,
    /// Diagonal blocks: xx, xy, yy.
    diagonal: Vec<[f64; 3]>,
    /// Right-hand side and correction, two rows a block.
    rhs: Vec<f64>,
    pub lambda: Vec<f64>,
    pin_lambda: Vec<DVec2>,
    h: f64,
}

/// Constraints or springs by the pairs of nodes that they join.
#[derive(Debug, Default)]
struct Edges {
    a: Vec<u32>,
    b: Vec<u32>,
    /// First value of the block between the two nodes, or none if one of them is fixed.
    slot: Vec<u32>,
    /// Difference at the start.
    dx: Vec<f64>,
    dy: Vec<f64>,
    /// Where the matrix has its ρ s sᵀ, and ρ.
    sx: Vec<f64>,
    sy: Vec<f64>,
    rho: Vec<f64>,
    /// C.
    error: Vec<f64>,
}

impl Edges {
    fn new(a: &[u32], b: &[u32]) -> Edges {
        let room = || vec![0.0; a.len()];
        Edges {
            a: a.to_vec(),
            b: b.to_vec(),
            slot: vec![NONE; a.len()],
            dx: room(),
            dy: room(),
            sx: room(),
            sy: room(),
            rho: room(),
            error: room(),
        }
    }

    fn ends(&self, i: usize) -> (usize, usize) {
        (self.a[i] as usize, self.b[i] as usize)
    }

    fn differences(&mut self, x: &[f64], y: &[f64]) {
        let to = self.dx.iter_mut().zip(&mut self.dy);
        for ((a, b), (dx, dy)) in self.a.iter().zip(&self.b).zip(to) {
            (*dx, *dy) = (x[*b as usize] - x[*a as usize], y[*b as usize] - y[*a as usize]);
        }
    }
}

impl Graph {
    /// Analyses the pattern of an island.
    pub fn new(system: &System) -> Graph {
        let nodes = &system.nodes;
        let mut graph = Graph {
            rods: Edges::new(&system.rods.a, &system.rods.b),
            springs: Edges::new(&system.springs.a, &system.springs.b),
            pins: Edges::new(&system.pins.a, &system.pins.b),
            block: vec![NONE; nodes.len()],
            ..Graph::default()
        };
        let mut blocks = 0;
        for (block, _) in graph.block.iter_mut().zip(&nodes.w).filter(|(_, w)| **w > 0.0) {
            *block = blocks;
            blocks += 1;
        }
        let mut pairs = Vec::new();
        for edges in [&graph.rods, &graph.springs, &graph.pins] {
            for (a, b) in edges.a.iter().zip(&edges.b) {
                let (a, b) = (graph.block[*a as usize], graph.block[*b as usize]);
                if a != NONE && b != NONE {
                    pairs.push((a, b));
                }
            }
        }
        graph.ldl.analyse(&vec![2; blocks as usize], &pairs);
        let mut pair = 0;
        for edges in [&mut graph.rods, &mut graph.springs, &mut graph.pins] {
            for ((a, b), slot) in edges.a.iter().zip(&edges.b).zip(&mut edges.slot) {
                if graph.block[*a as usize] != NONE && graph.block[*b as usize] != NONE {
                    *slot = graph.ldl.pair_slot(pair).0 as u32;
                    pair += 1;
                }
            }
        }
        graph.diagonal_slot = (0..blocks as usize).map(|block| graph.ldl.diagonal_slot(block) as u32).collect();
        for values in
            [&mut graph.ux, &mut graph.uy, &mut graph.a, &mut graph.bx, &mut graph.by, &mut graph.gx, &mut graph.gy]
        {
            values.resize(nodes.len(), 0.0);
        }
        graph.diagonal = vec![[0.0; 3]; nodes.len()];
        graph.rhs = vec![0.0; 2 * blocks as usize];
        graph.lambda = vec![0.0; system.rods.a.len()];
        graph.pin_lambda = vec![DVec2::ZERO; system.pins.a.len()];
        graph
    }

    /// Solves for a step of `h` seconds; the island is left as it is. Returns whether it went well, and in how many iterations.
    pub fn solve(&mut self, system: &System, h: f64, tight: f64) -> (bool, u32) {
        self.begin(system, h);
        let mut progress = Progress { tight, ..Progress::default() };
        let mut refactor = true;
        while progress.goes_on() {
            self.own_forces(system);
            self.rod_forces(system, refactor);
            self.spring_forces(system, refactor);
            self.pin_forces(refactor);
            if refactor {
                self.factor(system);
            }
            let moved = self.correct(system);
            refactor = progress.linear(moved) > SLOW;
        }
        (progress.converged && self.turned_little(system), progress.iterations)
    }

    fn begin(&mut self, system: &System, h: f64) {
        self.h = h;
        let nodes = &system.nodes;
        let inertia = 2.0 / (h * h);
        for i in 0..nodes.len() {
            (self.ux[i], self.uy[i]) = (h * nodes.vx[i], h * nodes.vy[i]);
            if nodes.w[i] > 0.0 {
                let mass = 1.0 / nodes.w[i];
                self.a[i] = mass * (inertia + system.drag / h);
                self.bx[i] = mass * (inertia * self.ux[i] + system.gravity.x);
                self.by[i] = mass * (inertia * self.uy[i] + system.gravity.y);
            }
        }
        for edges in [&mut self.rods, &mut self.springs, &mut self.pins] {
            edges.differences(&nodes.x, &nodes.y);
        }
        let reduced = |a: u32, b: u32| FIRMNESS * inertia / (nodes.w[a as usize] + nodes.w[b as usize]);
        let rods = &mut self.rods;
        for (r, square) in system.rods.square.iter().enumerate() {
            rods.rho[r] = if system.rods.held[r] { reduced(rods.a[r], rods.b[r]) / square } else { 0.0 };
            self.lambda[r] = if system.rods.held[r] { system.rods.lambda[r] } else { 0.0 };
        }
        let pins = &mut self.pins;
        for (p, rho) in pins.rho.iter_mut().enumerate() {
            *rho = reduced(pins.a[p], pins.b[p]);
            self.pin_lambda[p] = system.pins.lambda[p];
        }
    }

    /// Inertia, drag, gravity, the hold.
    fn own_forces(&mut self, system: &System) {
        for i in 0..self.a.len() {
            self.gx[i] = self.bx[i] - self.a[i] * self.ux[i];
            self.gy[i] = self.by[i] - self.a[i] * self.uy[i];
            self.diagonal[i] = [self.a[i], 0.0, self.a[i]];
        }
        if let Some(held) = &system.held {
            let (i, nodes) = (held.node, &system.nodes);
            let (start, u) = (DVec2::new(nodes.x[i], nodes.y[i]), DVec2::new(self.ux[i], self.uy[i]));
            let Linear { fx, fy, k } = discrete::hold(held, start, u, self.h);
            self.gx[i] += fx;
            self.gy[i] += fy;
            (self.diagonal[i][0], self.diagonal[i][1]) = (self.diagonal[i][0] + k[0], self.diagonal[i][1] + k[1]);
            self.diagonal[i][2] += k[3];
        }
    }

    /// Forces λ d_m and the shares of the errors; with `matrix` the stiffness too.
    fn rod_forces(&mut self, system: &System, matrix: bool) {
        if matrix {
            self.ldl.values_mut().fill(0.0);
        }
        let values = self.ldl.values_mut();
        let rods = &mut self.rods;
        for (r, square) in system.rods.square.iter().enumerate() {
            let (a, b) = (rods.a[r] as usize, rods.b[r] as usize);
            let (dx, dy) = (rods.dx[r], rods.dy[r]);
            let (ex, ey) = (self.ux[b] - self.ux[a], self.uy[b] - self.uy[a]);
            let (rho, lambda) = (rods.rho[r], self.lambda[r]);
            // C = ½ (|d|² − L²) + d_m·δ
            let error = 0.5 * (dx * dx + dy * dy - square) + (dx + 0.5 * ex) * ex + (dy + 0.5 * ey) * ey;
            rods.error[r] = error;
            if matrix {
                let (sx, sy) = (dx + 0.75 * ex, dy + 0.75 * ey);
                (rods.sx[r], rods.sy[r]) = (sx, sy);
                let geometric = -0.5 * lambda;
                let k = [geometric + rho * sx * sx, rho * sx * sy, geometric + rho * sy * sy];
                couple(&mut self.diagonal, values, (a, b, rods.slot[r]), k);
            }
            let push = -rho * error;
            let fx = lambda * (dx + 0.5 * ex) + push * rods.sx[r];
            let fy = lambda * (dy + 0.5 * ey) + push * rods.sy[r];
            self.gx[a] -= fx;
            self.gy[a] -= fy;
            self.gx[b] += fx;
            self.gy[b] += fy;
        }
    }

    fn spring_forces(&mut self, system: &System, matrix: bool) {
        let values = self.ldl.values_mut();
        let springs = &self.springs;
        for i in 0..springs.a.len() {
            let (a, b) = springs.ends(i);
            let e = (self.ux[b] - self.ux[a], self.uy[b] - self.uy[a]);
            let Linear { fx, fy, k } = discrete::spring(&system.springs, i, (springs.dx[i], springs.dy[i]), e, self.h);
            if matrix {
                let k = [k[0], 0.5 * (k[1] + k[2]), k[3]];
                couple(&mut self.diagonal, values, (a, b, springs.slot[i]), k);
            }
            self.gx[a] -= fx;
            self.gy[a] -= fy;
            self.gx[b] += fx;
            self.gy[b] += fy;
        }
    }

    fn pin_forces(&mut self, matrix: bool) {
        let values = self.ldl.values_mut();
        let pins = &self.pins;
        for p in 0..pins.a.len() {
            let (a, b) = pins.ends(p);
            let off = DVec2::new(pins.dx[p] + self.ux[b] - self.ux[a], pins.dy[p] + self.uy[b] - self.uy[a]);
            let rho = pins.rho[p];
            if matrix {
                couple(&mut self.diagonal, values, (a, b, pins.slot[p]), [rho, 0.0, rho]);
            }
            let force = self.pin_lambda[p] - rho * off;
            self.gx[a] -= force.x;
            self.gy[a] -= force.y;
            self.gx[b] += force.x;
            self.gy[b] += force.y;
        }
    }

    /// Puts the diagonal blocks in and factors.
    fn factor(&mut self, system: &System) {
        let values = self.ldl.values_mut();
        let blocks = self.block.iter().zip(&self.diagonal).filter(|(block, _)| **block != NONE);
        for ((_, diagonal), slot) in blocks.zip(&self.diagonal_slot) {
            let slot = *slot as usize;
            values[slot] = diagonal[0];
            (values[slot + 1], values[slot + 2]) = (diagonal[1], diagonal[1]);
            values[slot + 3] = diagonal[2];
        }
        self.ldl.factor();
        debug_assert_eq!(self.block.len(), system.nodes.len());
    }

    /// One solve; nodes and multipliers follow. Returns the largest change of a difference, in parts of its length.
    fn correct(&mut self, system: &System) -> f64 {
        let movable = |block: &u32| *block != NONE;
        for ((_, g), rhs) in self
            .block
            .iter()
            .zip(self.gx.iter().zip(&self.gy))
            .filter(|(block, _)| movable(block))
            .zip(self.rhs.chunks_exact_mut(2))
        {
            (rhs[0], rhs[1]) = (*g.0, *g.1);
        }
        self.ldl.solve(&mut self.rhs);
        let mut largest = 0.0f64;
        for (i, block) in self.block.iter().enumerate() {
            // From here on g is the correction.
            (self.gx[i], self.gy[i]) = (0.0, 0.0);
            if movable(block) {
                let at = 2 * *block as usize;
                (self.gx[i], self.gy[i]) = (self.rhs[at], self.rhs[at + 1]);
                self.ux[i] += self.gx[i];
                self.uy[i] += self.gy[i];
                largest = keep(largest, self.gx[i].abs().max(self.gy[i].abs()) / system.length);
            }
        }
        if !self.rhs.iter().sum::<f64>().is_finite() {
            return f64::NAN;
        }
        let (x, y) = (&self.gx, &self.gy);
        let rods = &self.rods;
        for (r, square) in system.rods.square.iter().enumerate() {
            let (a, b) = (rods.a[r] as usize, rods.b[r] as usize);
            let (ex, ey) = (x[b] - x[a], y[b] - y[a]);
            self.lambda[r] -= rods.rho[r] * (rods.error[r] + rods.sx[r] * ex + rods.sy[r] * ey);
            if system.rods.held[r] {
                largest = keep(largest, ((ex * ex + ey * ey) / square).sqrt());
            }
        }
        for p in 0..self.pins.a.len() {
            let (a, b) = self.pins.ends(p);
            // With the corrections: the error that is left.
            let off = DVec2::new(self.pins.dx[p] + self.ux[b] - self.ux[a], self.pins.dy[p] + self.uy[b] - self.uy[a]);
            self.pin_lambda[p] -= self.pins.rho[p] * off;
        }
        largest
    }

    fn turned_little(&self, system: &System) -> bool {
        (0..self.rods.a.len()).filter(|r| system.rods.held[*r]).all(|r| {
            let (a, b) = self.rods.ends(r);
            let (ex, ey) = (self.ux[b] - self.ux[a], self.uy[b] - self.uy[a]);
            self.rods.dx[r] * ex + self.rods.dy[r] * ey > (TURN - 1.0) * system.rods.square[r]
        })
    }

    /// Moves the island to the end of the step.
    pub fn apply(&self, system: &mut System) {
        let over = 2.0 / self.h;
        let nodes = &mut system.nodes;
        for i in (0..self.block.len()).filter(|i| self.block[*i] != NONE) {
            nodes.x[i] += self.ux[i];
            nodes.y[i] += self.uy[i];
            nodes.vx[i] = over * self.ux[i] - nodes.vx[i];
            nodes.vy[i] = over * self.uy[i] - nodes.vy[i];
        }
        system.rods.lambda.copy_from_slice(&self.lambda);
        system.pins.lambda.copy_from_slice(&self.pin_lambda);
    }
}

/// The larger, NaN if the second is.
#[inline]
fn keep(largest: f64, value: f64) -> f64 {
    if value <= largest { largest } else { value }
}

/// Adds the stiffness xx, xy, yy between two nodes.
#[inline]
fn couple(diagonal: &mut [[f64; 3]], values: &mut [f64], (a, b, slot): (usize, usize, u32), k: [f64; 3]) {
    (0..3).for_each(|i| diagonal[a][i] += k[i]);
    (0..3).for_each(|i| diagonal[b][i] += k[i]);
    if slot != NONE {
        let slot = slot as usize;
        values[slot] -= k[0];
        values[slot + 1] -= k[1];
        values[slot + 2] -= k[1];
        values[slot + 3] -= k[2];
    }
}
