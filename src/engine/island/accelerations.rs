//! Accelerations of an island at an instant, and how fast it can swing.

use super::System;
use super::lanes::Largest;
use glam::DVec2;
use std::f64::consts::TAU;

/// Rods that are worked off side by side.
const SIDE: usize = 32;

/// A spring is watched while it is shorter than the way that its ends go in so many times the step, if they pass each other
/// at less than a part of that.
const REACH: f64 = 2.0;
const BESIDE: f64 = 0.25;

/// How fast the parts of an island move, for choosing a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Rates {
    /// Bound on the angular frequency of springs, dampers and tense rods [rad/s].
    pub swing: f64,
    /// Largest angular speed of a rod [rad/s].
    pub turn: f64,
}

impl System {
    /// Accelerations by the forces, without those of the constraints, at the present positions and velocities [m/s²].
    pub fn force_accelerations(&self, ax: &mut [f64], ay: &mut [f64]) {
        let nodes = &self.nodes;
        if self.springs.len() == 0 && self.held.is_none() && self.drag == 0.0 {
            ax.iter_mut().zip(&nodes.free).for_each(|(a, free)| *a = free * self.gravity.x);
            ay.iter_mut().zip(&nodes.free).for_each(|(a, free)| *a = free * self.gravity.y);
            return;
        }
        ax.fill(0.0);
        ay.fill(0.0);
        self.springs.add_forces(nodes, ax, ay);
        if let Some(held) = &self.held {
            let force = held.force(nodes);
            ax[held.node] += force.x;
            ay[held.node] += force.y;
        }
        let along = |a: &mut [f64], v: &[f64], gravity: f64| {
            for (((a, v), w), free) in a.iter_mut().zip(v).zip(&nodes.w).zip(&nodes.free) {
                *a = w * *a + free * (gravity - self.drag * v);
            }
        };
        along(ax, &nodes.vx, self.gravity.x);
        along(ay, &nodes.vy, self.gravity.y);
    }

    /// Adds what the constraints contribute to these accelerations, and keeps the multipliers [N/m]. The matrix must be factored
    /// at the present positions: A λ = −J a − J̇v.
    pub fn constrain_accelerations(&mut self, ax: &mut [f64], ay: &mut [f64]) {
        if self.unconstrained() {
            return;
        }
        let (nodes, rods) = (&self.nodes, &self.rods);
        let n = rods.a.len();
        let [mut vx, mut vy, mut bx, mut by] = [[0.0; SIDE]; 4];
        for block in rods.pairs.blocks::<SIDE>() {
            let range = block.range();
            let n = range.len();
            for (from, to) in [(&nodes.vx[..], &mut vx), (&nodes.vy, &mut vy), (ax, &mut bx), (ay, &mut by)] {
                block.differences(from, &mut to[..n]);
            }
            let (dx, dy, rhs) = (&self.dx[range.clone()][..n], &self.dy[range.clone()][..n], &mut self.rhs[range][..n]);
            for k in 0..n {
                rhs[k] = -(dx[k] * bx[k] + dy[k] * by[k]) - vx[k] * vx[k] - vy[k] * vy[k];
            }
        }
        for (rhs, held) in self.rhs[..n].iter_mut().zip(&rods.held).skip(rods.first_rope) {
            *rhs = if *held { *rhs } else { 0.0 };
        }
        for ((a, b), rhs) in self.pins.a.iter().zip(&self.pins.b).zip(self.rhs[n..].chunks_exact_mut(2)) {
            let (a, b) = (*a as usize, *b as usize);
            rhs[0] = ax[a] - ax[b];
            rhs[1] = ay[a] - ay[b];
        }
        self.matrix.solve(&mut self.rhs);
        self.push(ax, ay);
        self.keep_multipliers(1.0);
    }

    /// Takes `scale` times the last solution as the multipliers.
    pub fn keep_multipliers(&mut self, scale: f64) {
        let n = self.rods.a.len();
        self.rods.lambda.iter_mut().zip(&self.rhs).for_each(|(to, from)| *to = scale * from);
        for (to, from) in self.pins.lambda.iter_mut().zip(self.rhs[n..].chunks_exact(2)) {
            *to = scale * DVec2::new(from[0], from[1]);
        }
    }

    /// Whether forces depend on velocities.
    pub fn damped(&self) -> bool {
        self.drag > 0.0 || self.springs.damped || self.held.is_some()
    }

    /// Rates at the present positions, velocities and multipliers; `load` is scratch.
    ///
    /// By Gershgorin's bound on M⁻¹K, row by row: a spring along n adds 2 w k (nₓ² + |nₓ n_y|) to a node's x, its tension and that of a
    /// rod 2 w |λ|. A damper c makes a node no faster than 2 w Σ c.
    pub fn rates(&self, load: &mut Vec<f64>) -> Rates {
        let nodes = &self.nodes;
        load.clear();
        load.resize(2 * nodes.len(), 0.0);
        let (x, y) = load.split_at_mut(nodes.len());
        let [mut vx, mut vy, mut turn] = [[0.0; SIDE], [0.0; SIDE], [0.0; SIDE]];
        let mut fastest = Largest::default();
        for block in self.rods.pairs.blocks::<SIDE>() {
            let range = block.range();
            let n = range.len();
            let (vx, vy, turn) = (&mut vx[..n], &mut vy[..n], &mut turn[..n]);
            block.differences(&nodes.vx, vx);
            block.differences(&nodes.vy, vy);
            let (lambda, square) = (&self.rods.lambda[range.clone()][..n], &self.rods.square[range][..n]);
            for k in 0..n {
                turn[k] = (vx[k] * vx[k] + vy[k] * vy[k]) / square[k];
                vx[k] = lambda[k].abs();
            }
            fastest.take(turn);
            block.add_to_both(vx, x);
        }
        if let Some(held) = &self.held {
            x[held.node] += 0.5 * held.stiffness;
        }
        y.copy_from_slice(x);
        self.springs.add_loads(nodes, x, y);
        let mut swing = largest(&nodes.w, x).max(largest(&nodes.w, y)).sqrt();
        if self.damped() {
            x.fill(0.0);
            for ((a, b), c) in self.springs.a.iter().zip(&self.springs.b).zip(&self.springs.damping) {
                x[*a as usize] += c;
                x[*b as usize] += c;
            }
            if let Some(held) = &self.held {
                x[held.node] += 0.5 * held.damping;
            }
            swing = swing.max(largest(&nodes.w, x)).max(self.drag);
        }
        Rates { swing, turn: fastest.value().sqrt() }
    }

    /// The longest period of the springs whose ends come close to each other within about `time` [s], or just did, if they go
    /// on as they do; 0 if there are none. A spring's force turns over there, which an estimate that looks at the ends of steps
    /// does not see.
    pub fn swing_through_zero(&self, time: f64) -> f64 {
        let (springs, nodes) = (&self.springs, &self.nodes);
        let (reach, mut longest) = (REACH * time, 0.0f64);
        for i in 0..springs.len() {
            let (a, b) = (springs.a[i] as usize, springs.b[i] as usize);
            let d = DVec2::new(nodes.x[b] - nodes.x[a], nodes.y[b] - nodes.y[a]);
            let rate = DVec2::new(nodes.vx[b] - nodes.vx[a], nodes.vy[b] - nodes.vy[a]);
            let square = rate.length_squared();
            // As they go on, they pass each other at |d × ḋ|/|ḋ|.
            let beside = || d.perp_dot(rate).abs() <= BESIDE * reach * square;
            let near = d.length_squared() <= reach * reach * square && beside();
            let pull = springs.stiffness[i] * (nodes.w[a] + nodes.w[b]);
            if near && springs.rest[i] > 0.0 && pull > 0.0 {
                longest = longest.max(TAU / pull.sqrt());
            }
        }
        longest
    }
}

/// Largest 2 w load.
fn largest(w: &[f64], load: &[f64]) -> f64 {
    w.iter().zip(load).fold(0.0f64, |most, (w, load)| most.max(2.0 * w * load))
}
