//! Newton's systems of any island: nets, cloth, loops, rods that are redundant.
//!
//! A 2 × 2 block a node, M + h²μ² K + hμ D + ρ JᵀJ, factored as a complex symmetric matrix; the multipliers follow by
//! ζ = −ρ (d·e − s), the proximal form of the augmented Lagrangian, so that redundant rods share the force. What is not symmetric in the
//! Jacobian (the rates in a rod's row, the turn of a damper) is left out, which costs an iteration or so a step.

use super::forces;
use super::stages::{Stages, Values};
use super::tree::{add, add_scaled, row};
use crate::engine::island::System;
use crate::engine::island::forest::NONE;
use crate::engine::linalg::complex::Complex;
use crate::engine::linalg::sparse::complex_ldl::ComplexLdl;
use glam::DVec2;

/// ρ over what the ends of a rod weigh along it: an iteration takes the error of a multiplier down by about this factor, and loses as much
/// of what is across in rounding.
const FIRMNESS: f64 = 1e7;

/// Pairs of nodes that rods, springs or pins join.
#[derive(Debug, Default)]
struct Edges {
    a: Vec<u32>,
    b: Vec<u32>,
    /// First value of the block between the two, or none if one of them is fixed.
    slot: Vec<u32>,
}

/// One island; lists by node unless said.
#[derive(Debug)]
pub(super) struct Net<const S: usize, const L: usize> {
    ldl: ComplexLdl<L>,
    /// Block of the matrix, or none.
    block: Vec<u32>,
    /// First value of the diagonal block, by block.
    slot: Vec<u32>,
    rods: Edges,
    springs: Edges,
    pins: Edges,
    mass: Vec<f64>,
    force: Vec<[Values<S>; 2]>,
    /// By rod: multipliers [N/m], d at the middle stage, ρ, and s.
    lambda: Vec<Values<S>>,
    d: Vec<[f64; 2]>,
    rho: Vec<f64>,
    s: Vec<Complex<L>>,
    /// By pin: forces on b [N], and what the accelerations are apart.
    pinned: Vec<[Values<S>; 2]>,
    apart: Vec<[Complex<L>; 2]>,
    pin_rho: Vec<f64>,
    /// By block: right-hand side and solution.
    z: Vec<[Complex<L>; 2]>,
}

impl<const S: usize, const L: usize> Net<S, L> {
    /// Analyses the pattern of an island.
    pub fn new(system: &System) -> Self {
        let nodes = &system.nodes;
        let mut block = vec![NONE; nodes.len()];
        let mut blocks = 0;
        for (block, _) in block.iter_mut().zip(&nodes.w).filter(|(_, w)| **w > 0.0) {
            *block = blocks;
            blocks += 1;
        }
        let mut pairs = Vec::new();
        let lists = [
            (&system.rods.a, &system.rods.b),
            (&system.springs.a, &system.springs.b),
            (&system.pins.a, &system.pins.b),
        ];
        let blocks_of = |a: &u32, b: &u32| (block[*a as usize], block[*b as usize]);
        for (a, b) in lists.iter().flat_map(|(a, b)| a.iter().zip(*b)) {
            let (a, b) = blocks_of(a, b);
            if a != NONE && b != NONE {
                pairs.push((a, b));
            }
        }
        let mut ldl = ComplexLdl::default();
        ldl.analyse(blocks as usize, &pairs);
        let [rods, springs, pins] = lists.map(|(a, b)| Edges {
            a: a.clone(),
            b: b.clone(),
            slot: a
                .iter()
                .zip(b)
                .map(|(a, b)| match blocks_of(a, b) {
                    (a, b) if a != NONE && b != NONE => ldl.pair_slot((a, b)) as u32,
                    _ => NONE,
                })
                .collect(),
        });
        let zero = [Complex::default(); 2];
        Net {
            slot: (0..blocks as usize).map(|block| ldl.diagonal_slot(block) as u32).collect(),
            mass: nodes.w.iter().map(|w| if *w > 0.0 { 1.0 / w } else { 0.0 }).collect(),
            force: vec![[[0.0; S]; 2]; nodes.len()],
            lambda: vec![[0.0; S]; rods.a.len()],
            d: vec![[0.0; 2]; rods.a.len()],
            rho: vec![0.0; rods.a.len()],
            s: vec![Complex::default(); rods.a.len()],
            pinned: vec![[[0.0; S]; 2]; pins.a.len()],
            apart: vec![zero; pins.a.len()],
            pin_rho: vec![0.0; pins.a.len()],
            z: vec![zero; blocks as usize],
            ldl,
            block,
            rods,
            springs,
            pins,
        }
    }

    /// The multipliers to begin with: those of the island.
    pub fn begin(&mut self, system: &System) {
        let rods = system.rods.lambda.iter().zip(&system.rods.held);
        for (to, (lambda, held)) in self.lambda.iter_mut().zip(rods) {
            *to = [if *held { *lambda } else { 0.0 }; S];
        }
        for (to, lambda) in self.pinned.iter_mut().zip(&system.pins.lambda) {
            *to = [[lambda.x; S], [lambda.y; S]];
        }
    }

    /// What the equations are off by, at the present stages.
    pub fn residual(&mut self, system: &System, stages: &Stages<S, L>) {
        for i in 0..self.force.len() {
            self.force[i] = forces::own(system, stages, i, self.mass[i]);
        }
        if let Some(held) = &system.held {
            add(&mut self.force[held.node], &forces::hold(held, stages));
        }
        for r in (0..self.rods.a.len()).filter(|r| system.rods.held[*r]) {
            let (a, b) = (self.rods.a[r] as usize, self.rods.b[r] as usize);
            let [d, w, acceleration] = stages.between(a, b);
            self.s[r] = stages.to_eigen(&row(&d, &w, &acceleration));
            self.pull(a, b, &self.lambda[r].clone(), &d);
        }
        for i in 0..self.springs.a.len() {
            let (a, b) = (self.springs.a[i] as usize, self.springs.b[i] as usize);
            let [d, w, _] = stages.between(a, b);
            let factor = forces::spring_factor(&system.springs, i, &d, &w);
            self.pull(a, b, &factor, &d);
        }
        for p in 0..self.pins.a.len() {
            let (a, b) = (self.pins.a[p] as usize, self.pins.b[p] as usize);
            let [_, _, acceleration] = stages.between(a, b);
            self.apart[p] = acceleration.map(|a| -stages.to_eigen(&a));
            let force = self.pinned[p];
            add(&mut self.force[b], &force);
            add(&mut self.force[a], &force.map(|values| values.map(|value| -value)));
        }
        for (force, block) in self.force.iter().zip(&self.block).filter(|(_, block)| **block != NONE) {
            self.z[*block as usize] = [stages.to_eigen(&force[0]), stages.to_eigen(&force[1])];
        }
        self.push_rows(system);
    }

    /// Force factor · d on b, and the opposite on a.
    #[inline(always)]
    fn pull(&mut self, a: usize, b: usize, factor: &Values<S>, d: &[Values<S>; 2]) {
        add_scaled(&mut self.force[b], factor, d);
        add_scaled(&mut self.force[a], &factor.map(|factor| -factor), d);
    }

    /// ρ Jᵀ s on the right-hand side.
    fn push_rows(&mut self, system: &System) {
        for r in (0..self.rods.a.len()).filter(|r| system.rods.held[*r]) {
            let push = self.d[r].map(|d| self.s[r].scaled(self.rho[r] * d));
            push_pair(&mut self.z, &self.block, (self.rods.a[r], self.rods.b[r]), push);
        }
        for p in 0..self.pins.a.len() {
            let push = self.apart[p].map(|apart| apart.scaled(self.pin_rho[p]));
            push_pair(&mut self.z, &self.block, (self.pins.a[p], self.pins.b[p]), push);
        }
    }

    /// Factors with the Jacobian at the middle stage; the residual is to be taken anew. Returns whether there is a factor.
    pub fn factor(&mut self, system: &System, stages: &Stages<S, L>) -> bool {
        let rate = stages.scheme.eigenvalues.scaled(stages.h);
        let square = rate * rate;
        let middle = Stages::<S, L>::MIDDLE;
        let nodes = &system.nodes;
        self.ldl.values.fill(Complex::default());
        let values = &mut self.ldl.values;
        for (block, mass) in self.block.iter().zip(&self.mass).filter(|(block, _)| **block != NONE) {
            let slot = self.slot[*block as usize] as usize;
            let own = rate.scaled(mass * system.drag).plus(*mass);
            (values[slot], values[slot + 3]) = (own, own);
        }
        if let Some(held) = &system.held {
            let k = forces::hold_slopes(held, stages, middle).block(rate, square);
            let slot = self.slot[self.block[held.node] as usize] as usize;
            (0..4).for_each(|i| values[slot + i] += k[i]);
        }
        let place =
            |node: u32| (self.block[node as usize] != NONE).then(|| self.slot[self.block[node as usize] as usize]);
        let reduced = |a: u32, b: u32| FIRMNESS / (nodes.w[a as usize] + nodes.w[b as usize]);
        for r in (0..self.rods.a.len()).filter(|r| system.rods.held[*r]) {
            let (a, b) = (self.rods.a[r], self.rods.b[r]);
            let [d, ..] = stages.between_at(a as usize, b as usize, middle);
            let rho = reduced(a, b) / (d[0] * d[0] + d[1] * d[1]);
            (self.d[r], self.rho[r]) = (d, rho);
            let geometric = square.scaled(-self.lambda[r][middle]);
            let cross = Complex::real(rho * d[0] * d[1]);
            let k = [geometric.plus(rho * d[0] * d[0]), cross, cross, geometric.plus(rho * d[1] * d[1])];
            couple(values, [place(a), place(b)], self.rods.slot[r], &k);
        }
        for i in 0..self.springs.a.len() {
            let (a, b) = (self.springs.a[i], self.springs.b[i]);
            let [d, w, _] = stages.between_at(a as usize, b as usize, middle);
            let k = forces::spring_slopes(&system.springs, i, d, w).symmetric().block(rate, square);
            couple(values, [place(a), place(b)], self.springs.slot[i], &k);
        }
        for p in 0..self.pins.a.len() {
            let (a, b) = (self.pins.a[p], self.pins.b[p]);
            self.pin_rho[p] = reduced(a, b);
            let rho = Complex::real(self.pin_rho[p]);
            let k = [rho, Complex::default(), Complex::default(), rho];
            couple(values, [place(a), place(b)], self.pins.slot[p], &k);
        }
        self.ldl.factor()
    }

    /// Solves for the residual at hand and corrects the stages. Returns how far the farthest end moves [m].
    pub fn solve(&mut self, system: &System, stages: &mut Stages<S, L>) -> f64 {
        self.ldl.solve(&mut self.z);
        let z = &self.z;
        let of = |node: u32| match self.block[node as usize] {
            NONE => [Complex::default(); 2],
            block => z[block as usize],
        };
        for r in (0..self.rods.a.len()).filter(|r| system.rods.held[*r]) {
            let (a, b, d) = (of(self.rods.a[r]), of(self.rods.b[r]), self.d[r]);
            let along = (b[0] - a[0]).scaled(d[0]) + (b[1] - a[1]).scaled(d[1]);
            let change = stages.by_stage(&(self.s[r] - along).scaled(self.rho[r]));
            (0..S).for_each(|j| self.lambda[r][j] += change[j]);
        }
        for p in 0..self.pins.a.len() {
            let (a, b) = (of(self.pins.a[p]), of(self.pins.b[p]));
            for k in 0..2 {
                let change = stages.by_stage(&(self.apart[p][k] - (b[k] - a[k])).scaled(self.pin_rho[p]));
                (0..S).for_each(|j| self.pinned[p][k][j] += change[j]);
            }
        }
        let mut largest = 0.0;
        for (node, block) in self.block.iter().enumerate().filter(|(_, block)| **block != NONE) {
            let moved = stages.correct(node, &z[*block as usize]);
            // Written so that a NaN is kept.
            largest = if moved <= largest { largest } else { moved };
        }
        largest
    }

    /// Multipliers of a rod by stage.
    pub fn lambda(&self, rod: usize) -> &Values<S> {
        &self.lambda[rod]
    }

    /// Writes the multipliers at the end of the step.
    pub fn store(&self, system: &mut System) {
        for (rod, held) in system.rods.held.iter().enumerate() {
            system.rods.lambda[rod] = if *held { self.lambda[rod][S - 1] } else { 0.0 };
        }
        for (to, force) in system.pins.lambda.iter_mut().zip(&self.pinned) {
            *to = DVec2::new(force[0][S - 1], force[1][S - 1]);
        }
    }
}

#[inline(always)]
fn push_pair<const L: usize>(z: &mut [[Complex<L>; 2]], block: &[u32], (a, b): (u32, u32), push: [Complex<L>; 2]) {
    if block[a as usize] != NONE {
        let z = &mut z[block[a as usize] as usize];
        (z[0], z[1]) = (z[0] - push[0], z[1] - push[1]);
    }
    if block[b as usize] != NONE {
        let z = &mut z[block[b as usize] as usize];
        (z[0], z[1]) = (z[0] + push[0], z[1] + push[1]);
    }
}

/// Adds a stiffness between two nodes to the blocks on the diagonal and, negative, between them.
#[inline(always)]
fn couple<const L: usize>(values: &mut [Complex<L>], ends: [Option<u32>; 2], slot: u32, k: &[Complex<L>; 4]) {
    for at in ends.into_iter().flatten() {
        (0..4).for_each(|i| values[at as usize + i] += k[i]);
    }
    if slot != NONE {
        (0..4).for_each(|i| values[slot as usize + i] -= k[i]);
    }
}
