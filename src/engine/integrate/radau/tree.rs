//! Newton's systems of an island that is a tree, or a forest: eliminated from the leaves to the roots in linear time.
//!
//! The multiplier of a rod balances the forces along it, at every stage. What is left of a rod is one equation across it: with z the
//! corrections of the accelerations by eigenvalue, e = z − z_parent and all that hangs on the node as a 2 × 2 block H and a force g,
//!
//! ```text
//! node:    H z = g − S e + d ζ,    row:   ρ·e = s,    ρ = d + h²μ² Δa + 2 hμ w
//! turn:    e = s d/(ρ·d) + t ρ⊥,   D t = d⊥·(g − (H + S) s d/(ρ·d) − H z_parent),   D = d⊥ᵀ (H + S) ρ⊥
//! parent:  Ĥ = H − H ρ⊥ d⊥ᵀ H / D,   ĝ = g − H e(z_parent = 0)
//! ```
//!
//! S holds the geometric stiffness −h²μ²λ and springs beside the rod. One more rod to a fixed point is taken in by its Schur complement.

use super::forces::{self, Block};
use super::stages::{Stages, Values};
use crate::engine::island::System;
use crate::engine::island::forest::{Forest, Join, NONE};
use crate::engine::linalg::complex::Complex;
use glam::DVec2;

/// What elimination leaves of a node.
#[derive(Clone, Copy, Debug, Default)]
struct Eliminated<const L: usize> {
    join: Join,
    /// d at the middle stage [m].
    dx: f64,
    dy: f64,
    /// ρ⊥
    rx: Complex<L>,
    ry: Complex<L>,
    /// H ρ⊥
    qx: Complex<L>,
    qy: Complex<L>,
    /// d⊥ᵀ H / D
    px: Complex<L>,
    py: Complex<L>,
    /// H d/(ρ·d)
    ux: Complex<L>,
    uy: Complex<L>,
    /// 1/(ρ·d), 1/D and d⊥ᵀ (H + S) d/(ρ·d)/D.
    over_along: Complex<L>,
    over_across: Complex<L>,
    sigma: Complex<L>,
}

/// Of a node that springs or nothing hold: (H + S)⁻¹, (H + S)⁻¹ S and S.
#[derive(Clone, Copy, Debug, Default)]
struct Loose<const L: usize> {
    inverse: Block<L>,
    follow: Block<L>,
    beside: Block<L>,
}

/// The rod that is no link, at the middle stage.
#[derive(Clone, Copy, Debug, Default)]
struct ClosingRow<const L: usize> {
    /// ρ, and 1/(ρ·z) of its unit multiplier.
    rho: [Complex<L>; 2],
    over: Complex<L>,
    s: Complex<L>,
}

/// One island; lists by place in the forest unless said.
#[derive(Debug)]
pub(super) struct Tree<const S: usize, const L: usize> {
    forest: Forest,
    mass: Vec<f64>,
    /// Place by node, or none; by rod, or none for the closing one.
    place: Vec<u32>,
    place_of_rod: Vec<u32>,
    force: Vec<[Values<S>; 2]>,
    /// Multipliers of rods, and of the closing one [N/m].
    lambda: Vec<Values<S>>,
    closing_lambda: Values<S>,
    /// Forces of pins on the node.
    pinned: Vec<[f64; 2]>,
    h: Vec<Block<L>>,
    beside: Vec<Block<L>>,
    eliminated: Vec<Eliminated<L>>,
    loose: Vec<Loose<L>>,
    g: Vec<[Complex<L>; 2]>,
    s: Vec<Complex<L>>,
    t: Vec<Complex<L>>,
    z: Vec<[Complex<L>; 2]>,
    /// z of the closing rod's unit multiplier.
    unit: Vec<[Complex<L>; 2]>,
    closing: ClosingRow<L>,
}

impl<const S: usize, const L: usize> Tree<S, L> {
    /// None if rods or springs close loops.
    pub fn new(system: &System) -> Option<Self> {
        let forest = Forest::new(system)?;
        let n = forest.len();
        let mut place = vec![NONE; system.nodes.len()];
        forest.node.iter().enumerate().for_each(|(t, node)| place[*node as usize] = t as u32);
        let mut place_of_rod = vec![NONE; system.rods.a.len()];
        let links = forest.tie.iter().enumerate().filter(|(_, tie)| tie.join == Join::Rod);
        links.for_each(|(t, tie)| place_of_rod[tie.index as usize] = t as u32);
        let zero = [Complex::default(); 2];
        let sprung = if forest.springs.is_empty() { 0 } else { n };
        Some(Tree {
            mass: forest.node.iter().map(|node| 1.0 / system.nodes.w[*node as usize]).collect(),
            place,
            place_of_rod,
            force: vec![[[0.0; S]; 2]; n],
            lambda: vec![[0.0; S]; n],
            closing_lambda: [0.0; S],
            pinned: vec![[0.0; 2]; n],
            h: vec![[Complex::default(); 4]; n],
            beside: vec![[Complex::default(); 4]; sprung],
            eliminated: vec![Eliminated::default(); n],
            loose: vec![Loose::default(); n],
            g: vec![zero; n],
            s: vec![Complex::default(); n],
            t: vec![Complex::default(); n],
            z: vec![zero; n],
            unit: if forest.closing.is_some() { vec![zero; n] } else { Vec::new() },
            closing: ClosingRow::default(),
            forest,
        })
    }

    /// The multipliers to begin with: those of the island.
    pub fn begin(&mut self, system: &System) {
        for (t, tie) in self.forest.tie.iter().enumerate() {
            let held = tie.join == Join::Rod && system.rods.held[tie.index as usize];
            self.lambda[t] = [if held { system.rods.lambda[tie.index as usize] } else { 0.0 }; S];
        }
        if let Some(closing) = self.forest.closing {
            self.closing_lambda = [system.rods.lambda[closing.rod as usize]; S];
        }
    }

    /// What holds the node at place t in this step.
    fn join(&self, system: &System, t: usize) -> Join {
        let tie = self.forest.tie[t];
        match tie.join {
            Join::Rod if !system.rods.held[tie.index as usize] => Join::Free,
            join => join,
        }
    }

    /// What the equations are off by, at the present stages.
    pub fn residual(&mut self, system: &System, stages: &Stages<S, L>) {
        for (t, node) in self.forest.node.iter().enumerate() {
            self.force[t] = forces::own(system, stages, *node as usize, self.mass[t]);
        }
        if let Some(held) = &system.held
            && let Some(t) = self.place.get(held.node).filter(|t| **t != NONE)
        {
            add(&mut self.force[*t as usize], &forces::hold(held, stages));
        }
        self.spring_forces(system, stages);
        if let Some(closing) = self.forest.closing.filter(|closing| system.rods.held[closing.rod as usize]) {
            let (at, ground) = (closing.at as usize, closing.ground as usize);
            let [d, w, a] = stages.between(ground, self.forest.node[at] as usize);
            add_scaled(&mut self.force[at], &self.closing_lambda, &d);
            self.closing.s = stages.to_eigen(&row(&d, &w, &a));
        }
        for t in (0..self.forest.len()).rev() {
            let (node, parent) = (self.forest.node[t] as usize, self.forest.parent[t] as usize);
            match self.join(system, t) {
                Join::Rod => {
                    let [d, w, a] = stages.between(self.forest.parent_node[t] as usize, node);
                    let f = &mut self.force[t];
                    let lambda: Values<S> = std::array::from_fn(|j| {
                        let square = d[0][j] * d[0][j] + d[1][j] * d[1][j];
                        -(d[0][j] * f[0][j] + d[1][j] * f[1][j]) / square
                    });
                    add_scaled(f, &lambda, &d);
                    self.lambda[t] = lambda;
                    if parent != NONE as usize {
                        add_scaled(&mut self.force[parent], &lambda.map(|lambda| -lambda), &d);
                    }
                    self.s[t] = stages.to_eigen(&row(&d, &w, &a));
                }
                Join::Pin => {
                    let force = std::mem::replace(&mut self.force[t], [[0.0; S]; 2]);
                    self.pinned[t] = [-force[0][S - 1], -force[1][S - 1]];
                    if parent != NONE as usize {
                        add(&mut self.force[parent], &force);
                    }
                }
                Join::Free => {}
            }
            self.g[t] = [stages.to_eigen(&self.force[t][0]), stages.to_eigen(&self.force[t][1])];
        }
    }

    fn spring_forces(&mut self, system: &System, stages: &Stages<S, L>) {
        for place in &self.forest.springs {
            let at = place.at as usize;
            let along = place.ground == NONE;
            let other = if along { self.forest.parent_node[at] } else { place.ground } as usize;
            let [d, w, _] = stages.between(other, self.forest.node[at] as usize);
            let factor = forces::spring_factor(&system.springs, place.spring as usize, &d, &w);
            add_scaled(&mut self.force[at], &factor, &d);
            let parent = self.forest.parent[at];
            if along && parent != NONE {
                add_scaled(&mut self.force[parent as usize], &factor.map(|factor| -factor), &d);
            }
        }
    }

    /// Eliminates with the Jacobian at the middle stage; the residual is to be taken anew. Returns whether there is a factor.
    pub fn factor(&mut self, system: &System, stages: &Stages<S, L>) -> bool {
        let rate = stages.scheme.eigenvalues.scaled(stages.h);
        let square = rate * rate;
        let middle = Stages::<S, L>::MIDDLE;
        self.stiffness(system, stages, (rate, square));
        let mut regular = true;
        for t in (0..self.forest.len()).rev() {
            let join = self.join(system, t);
            self.eliminated[t].join = join;
            let h = self.h[t];
            let mut to = match join {
                Join::Rod => {
                    let (p, node) = (self.forest.parent_node[t] as usize, self.forest.node[t] as usize);
                    let mut beside = self.beside.get(t).copied().unwrap_or_default();
                    let geometric = square.scaled(-self.lambda[t][middle]);
                    (beside[0], beside[3]) = (beside[0] + geometric, beside[3] + geometric);
                    let [d, w, a] = stages.between_at(p, node, middle);
                    let rho: [Complex<L>; 2] =
                        std::array::from_fn(|k| (square.scaled(a[k]) + rate.scaled(2.0 * w[k])).plus(d[k]));
                    self.eliminated[t].take(&h, &beside, d, rho)
                }
                Join::Pin => h,
                Join::Free => self.loose[t].take(&h, self.beside.get(t)),
            };
            regular &= to.iter().all(Complex::is_finite);
            let parent = self.forest.parent[t];
            if parent != NONE {
                let into = &mut self.h[parent as usize];
                into.iter_mut().zip(&mut to).for_each(|(into, to)| *into += *to);
            }
        }
        regular && self.close(system, stages, (rate, square))
    }

    /// Inertia, drag, springs, the hold and the closing rod, before elimination.
    fn stiffness(&mut self, system: &System, stages: &Stages<S, L>, (rate, square): (Complex<L>, Complex<L>)) {
        let middle = Stages::<S, L>::MIDDLE;
        for (h, mass) in self.h.iter_mut().zip(&self.mass) {
            let own = rate.scaled(mass * system.drag).plus(*mass);
            *h = [own, Complex::default(), Complex::default(), own];
        }
        self.beside.fill([Complex::default(); 4]);
        for place in &self.forest.springs {
            let at = place.at as usize;
            let along = place.ground == NONE;
            let other = if along { self.forest.parent_node[at] } else { place.ground } as usize;
            let [d, w, _] = stages.between_at(other, self.forest.node[at] as usize, middle);
            let block = forces::spring_slopes(&system.springs, place.spring as usize, d, w).block(rate, square);
            let to = if along { &mut self.beside[at] } else { &mut self.h[at] };
            to.iter_mut().zip(block).for_each(|(to, block)| *to += block);
        }
        if let Some(held) = &system.held
            && let Some(t) = self.place.get(held.node).filter(|t| **t != NONE)
        {
            let block = forces::hold_slopes(held, stages, middle).block(rate, square);
            self.h[*t as usize].iter_mut().zip(block).for_each(|(to, block)| *to += block);
        }
        if let Some(closing) = self.forest.closing.filter(|closing| system.rods.held[closing.rod as usize]) {
            let geometric = square.scaled(-self.closing_lambda[middle]);
            let h = &mut self.h[closing.at as usize];
            (h[0], h[3]) = (h[0] + geometric, h[3] + geometric);
        }
    }

    /// What the closing rod's unit multiplier does.
    fn close(&mut self, system: &System, stages: &Stages<S, L>, (rate, square): (Complex<L>, Complex<L>)) -> bool {
        let Some(closing) = self.forest.closing.filter(|closing| system.rods.held[closing.rod as usize]) else {
            return true;
        };
        let at = closing.at as usize;
        let node = self.forest.node[at] as usize;
        let [d, w, a] = stages.between_at(closing.ground as usize, node, Stages::<S, L>::MIDDLE);
        let rho: [Complex<L>; 2] = std::array::from_fn(|k| (square.scaled(a[k]) + rate.scaled(2.0 * w[k])).plus(d[k]));
        self.g.fill([Complex::default(); 2]);
        self.s.fill(Complex::default());
        self.g[at] = d.map(Complex::real);
        self.sweep();
        self.unit.copy_from_slice(&self.z);
        let along = rho[0] * self.unit[at][0] + rho[1] * self.unit[at][1];
        self.closing = ClosingRow { rho, over: along.reciprocal(), s: Complex::default() };
        self.closing.over.is_finite()
    }

    /// Solves for the residual at hand and corrects the stages. Returns how far the farthest end moves [m].
    pub fn solve(&mut self, system: &System, stages: &mut Stages<S, L>) -> f64 {
        self.sweep();
        if let Some(closing) = self.forest.closing.filter(|closing| system.rods.held[closing.rod as usize]) {
            let (at, row) = (closing.at as usize, &self.closing);
            let zeta = (row.s - row.rho[0] * self.z[at][0] - row.rho[1] * self.z[at][1]) * row.over;
            for (z, unit) in self.z.iter_mut().zip(&self.unit) {
                (z[0], z[1]) = (z[0] + zeta * unit[0], z[1] + zeta * unit[1]);
            }
            let change = stages.by_stage(&zeta);
            (0..S).for_each(|j| self.closing_lambda[j] += change[j]);
        }
        let mut largest = 0.0;
        for (node, z) in self.forest.node.iter().zip(&self.z) {
            let moved = stages.correct(*node as usize, z);
            // Written so that a NaN is kept.
            largest = if moved <= largest { largest } else { moved };
        }
        largest
    }

    /// z of the forces g and rows s: from the leaves to the roots and back.
    fn sweep(&mut self) {
        for t in (0..self.forest.len()).rev() {
            let g = self.g[t];
            let to = match self.eliminated[t].join {
                Join::Rod => {
                    let e = &self.eliminated[t];
                    let across = g[1].scaled(e.dx) - g[0].scaled(e.dy);
                    let s = self.s[t];
                    let turn = across * e.over_across - s * e.sigma;
                    self.t[t] = turn;
                    [g[0] - s * e.ux - turn * e.qx, g[1] - s * e.uy - turn * e.qy]
                }
                Join::Pin => g,
                Join::Free => {
                    let c = times(&self.loose[t].inverse, &g);
                    self.z[t] = c;
                    times(&self.loose[t].beside, &c)
                }
            };
            let parent = self.forest.parent[t];
            if parent != NONE {
                let into = &mut self.g[parent as usize];
                (into[0], into[1]) = (into[0] + to[0], into[1] + to[1]);
            }
        }
        for t in 0..self.forest.len() {
            let parent = self.forest.parent[t];
            let from = if parent == NONE { [Complex::default(); 2] } else { self.z[parent as usize] };
            self.z[t] = match self.eliminated[t].join {
                Join::Rod => {
                    let e = &self.eliminated[t];
                    let turn = self.t[t] - e.px * from[0] - e.py * from[1];
                    let along = self.s[t] * e.over_along;
                    [from[0] + along.scaled(e.dx) + turn * e.rx, from[1] + along.scaled(e.dy) + turn * e.ry]
                }
                Join::Pin => from,
                Join::Free => {
                    let follow = times(&self.loose[t].follow, &from);
                    [self.z[t][0] + follow[0], self.z[t][1] + follow[1]]
                }
            };
        }
    }

    /// Multipliers of a rod by stage.
    pub fn lambda(&self, rod: usize) -> &Values<S> {
        match self.place_of_rod[rod] {
            NONE => &self.closing_lambda,
            place => &self.lambda[place as usize],
        }
    }

    /// Writes the multipliers at the end of the step.
    pub fn store(&self, system: &mut System) {
        for (rod, held) in system.rods.held.iter().enumerate() {
            system.rods.lambda[rod] = if *held { self.lambda(rod)[S - 1] } else { 0.0 };
        }
        for (t, tie) in self.forest.tie.iter().enumerate().filter(|(_, tie)| tie.join == Join::Pin) {
            let index = tie.index as usize;
            let sign = if system.pins.b[index] == self.forest.node[t] { 1.0 } else { -1.0 };
            system.pins.lambda[index] = sign * DVec2::from(self.pinned[t]);
        }
    }
}

impl<const L: usize> Eliminated<L> {
    /// Eliminates a node on a rod; returns what its parent feels.
    #[inline(always)]
    fn take(&mut self, h: &Block<L>, beside: &Block<L>, d: [f64; 2], rho: [Complex<L>; 2]) -> Block<L> {
        let [dx, dy] = d;
        (self.dx, self.dy) = (dx, dy);
        (self.rx, self.ry) = (-rho[1], rho[0]);
        let both: Block<L> = std::array::from_fn(|i| h[i] + beside[i]);
        let across = |k: &Block<L>| [k[2].scaled(dx) - k[0].scaled(dy), k[3].scaled(dx) - k[1].scaled(dy)];
        let (own, all) = (across(h), across(&both));
        self.over_along = (rho[0].scaled(dx) + rho[1].scaled(dy)).reciprocal();
        self.over_across = (all[0] * self.rx + all[1] * self.ry).reciprocal();
        (self.px, self.py) = (own[0] * self.over_across, own[1] * self.over_across);
        (self.qx, self.qy) = (h[0] * self.rx + h[1] * self.ry, h[2] * self.rx + h[3] * self.ry);
        self.ux = (h[0].scaled(dx) + h[1].scaled(dy)) * self.over_along;
        self.uy = (h[2].scaled(dx) + h[3].scaled(dy)) * self.over_along;
        self.sigma = (all[0].scaled(dx) + all[1].scaled(dy)) * self.over_along * self.over_across;
        [h[0] - self.qx * self.px, h[1] - self.qx * self.py, h[2] - self.qy * self.px, h[3] - self.qy * self.py]
    }
}

impl<const L: usize> Loose<L> {
    /// Eliminates a node on springs, or on nothing; returns what its parent feels.
    fn take(&mut self, h: &Block<L>, beside: Option<&Block<L>>) -> Block<L> {
        let s = beside.copied().unwrap_or_default();
        let [a, b, c, d]: Block<L> = std::array::from_fn(|i| h[i] + s[i]);
        let over = (a * d - b * c).reciprocal();
        self.inverse = [d * over, -b * over, -c * over, a * over];
        self.beside = s;
        self.follow = product(&self.inverse, &s);
        product(h, &self.follow)
    }
}

/// −(d·Δa + |w|²) by stage.
#[inline(always)]
pub(super) fn row<const S: usize>(d: &[Values<S>; 2], w: &[Values<S>; 2], a: &[Values<S>; 2]) -> Values<S> {
    std::array::from_fn(|j| -(d[0][j] * a[0][j] + d[1][j] * a[1][j] + w[0][j] * w[0][j] + w[1][j] * w[1][j]))
}

#[inline(always)]
pub(super) fn add<const S: usize>(to: &mut [Values<S>; 2], more: &[Values<S>; 2]) {
    for k in 0..2 {
        (0..S).for_each(|j| to[k][j] += more[k][j]);
    }
}

/// Adds factor · d by stage.
#[inline(always)]
pub(super) fn add_scaled<const S: usize>(to: &mut [Values<S>; 2], factor: &Values<S>, d: &[Values<S>; 2]) {
    for k in 0..2 {
        (0..S).for_each(|j| to[k][j] += factor[j] * d[k][j]);
    }
}

#[inline(always)]
fn times<const L: usize>(m: &Block<L>, x: &[Complex<L>; 2]) -> [Complex<L>; 2] {
    [m[0] * x[0] + m[1] * x[1], m[2] * x[0] + m[3] * x[1]]
}

#[inline(always)]
fn product<const L: usize>(a: &Block<L>, b: &Block<L>) -> Block<L> {
    [a[0] * b[0] + a[1] * b[2], a[0] * b[1] + a[1] * b[3], a[2] * b[0] + a[3] * b[2], a[2] * b[1] + a[3] * b[3]]
}
