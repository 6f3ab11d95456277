//! The recurrences: coefficient k + 2 of the positions from all before it.

use super::Taylor;
use super::polynomial::add_product;
use crate::engine::island::System;
use crate::engine::island::system::push;
use glam::DVec2;

/// Series of the mouse's force before the bound, its square, and 1 over its size.
#[derive(Debug, Default)]
pub(super) struct GripSeries {
    pub u: Vec<DVec2>,
    pub square: Vec<f64>,
    pub inverse: Vec<f64>,
}

impl Taylor {
    /// Coefficients 0 and 1.
    pub(super) fn expand_first(&mut self, system: &System, scale: f64) {
        let nodes = &system.nodes;
        self.x[0].clone_from(&nodes.x);
        self.y[0].clone_from(&nodes.y);
        for (to, from) in self.x[1].iter_mut().zip(&nodes.vx).chain(self.y[1].iter_mut().zip(&nodes.vy)) {
            *to = scale * from;
        }
        self.dx[0].clone_from(&system.dx);
        self.dy[0].clone_from(&system.dy);
        self.take_differences(system, 1);
        if system.turns() {
            self.turning.expand_first(system, scale);
        }
        self.springs.take_differences(system, &self.x, &self.y, 0);
        self.springs.take_differences(system, &self.x, &self.y, 1);
    }

    /// Coefficient k of the accelerations, hence k + 2 of the positions.
    pub(super) fn coefficient(&mut self, system: &mut System, scale: f64, k: usize) {
        let square = scale * scale;
        let nodes = &system.nodes;
        self.fx.fill(0.0);
        self.fy.fill(0.0);
        if system.springs.len() > 0 {
            self.springs.add_force(system, scale, k, &mut self.fx, &mut self.fy);
        }
        if system.held.is_some() {
            self.add_grip(system, scale, k);
        }
        if system.turns() {
            self.gather_turning(system, scale, k);
        }
        // From forces to accelerations.
        for (((fx, fy), w), free) in self.fx.iter_mut().zip(&mut self.fy).zip(&nodes.w).zip(&nodes.free) {
            *fx *= w;
            *fy *= w;
            if k == 0 {
                *fx += free * square * system.gravity.x;
                *fy += free * square * system.gravity.y;
            }
        }
        if system.drag > 0.0 {
            let rate = system.drag * scale * (k + 1) as f64;
            for (i, free) in nodes.free.iter().enumerate() {
                self.fx[i] -= free * rate * self.x[k + 1][i];
                self.fy[i] -= free * rate * self.y[k + 1][i];
            }
        }
        if system.turns() {
            self.know_turning(system, k);
        }
        if !system.unconstrained() {
            self.constrain(system, k);
        }
        let over = 1.0 / ((k + 1) * (k + 2)) as f64;
        for (to, f) in self.x[k + 2].iter_mut().zip(&self.fx).chain(self.y[k + 2].iter_mut().zip(&self.fy)) {
            *to = over * f;
        }
        if system.turns() {
            self.finish_turning(system, k);
        }
        self.take_differences(system, k + 2);
        self.springs.take_differences(system, &self.x, &self.y, k + 2);
    }

    /// Adds what the constraints contribute to acceleration k.
    fn constrain(&mut self, system: &mut System, k: usize) {
        let rods = &system.rods;
        let n = rods.a.len();
        if k > 0 && n > 0 && !system.turns() {
            self.know_pulls(k);
            rods.pairs.add_weighted(&system.nodes.w, &self.gx, &mut self.fx);
            rods.pairs.add_weighted(&system.nodes.w, &self.gy, &mut self.fy);
        }
        // −½ N (N−1) Σ_{0<j<N} d_j·d_{N−j} − d₀·(a_b − a_a)
        let order = k + 2;
        let sum = &mut self.gx;
        sum.fill(0.0);
        for j in 1..=(order - 1) / 2 {
            add_product(sum, &self.dx[j], &self.dx[order - j]);
            add_product(sum, &self.dy[j], &self.dy[order - j]);
        }
        let whole = ((k + 1) * (k + 2)) as f64;
        let half = order / 2;
        let even = order.is_multiple_of(2);
        let rhs = &mut self.lambda[k];
        for r in 0..n {
            let mut s = sum[r];
            if even {
                s += 0.5 * (self.dx[half][r] * self.dx[half][r] + self.dy[half][r] * self.dy[half][r]);
            }
            let (a, b) = (rods.a[r] as usize, rods.b[r] as usize);
            let along = system.dx[r] * (self.fx[b] - self.fx[a]) + system.dy[r] * (self.fy[b] - self.fy[a]);
            rhs[r] = -whole * s - along;
        }
        for (rhs, held) in rhs.iter_mut().zip(&rods.held).skip(rods.first_rope) {
            *rhs = if *held { *rhs } else { 0.0 };
        }
        for ((a, b), rhs) in system.pins.a.iter().zip(&system.pins.b).zip(rhs[n..].chunks_exact_mut(2)) {
            let (a, b) = (*a as usize, *b as usize);
            rhs[0] = self.fx[a] - self.fx[b];
            rhs[1] = self.fy[a] - self.fy[b];
        }
        system.matrix.solve(rhs);
        if system.turns() {
            return self.push_turning(system, k);
        }
        let d = (&system.dx[..], &system.dy[..]);
        push(&system.nodes.w, &system.rods, &system.pins, d, rhs, &mut self.fx, &mut self.fy);
    }

    /// What is known of the rods' pulls by their multipliers: Σ_{j=1}^{k} d_j λ_{k−j}.
    pub(super) fn know_pulls(&mut self, k: usize) {
        self.gx.fill(0.0);
        self.gy.fill(0.0);
        for j in 1..=k {
            add_product(&mut self.gx, &self.dx[j], &self.lambda[k - j]);
            add_product(&mut self.gy, &self.dy[j], &self.lambda[k - j]);
        }
    }

    /// d_k of the rods.
    fn take_differences(&mut self, system: &System, k: usize) {
        system.rods.pairs.differences(&self.x[k], &mut self.dx[k]);
        system.rods.pairs.differences(&self.y[k], &mut self.dy[k]);
    }

    /// Adds coefficient k of the mouse's force, times the scale squared.
    fn add_grip(&mut self, system: &System, scale: f64, k: usize) {
        let Some(held) = &system.held else { return };
        let (i, grip) = (held.node, &mut self.grip);
        let at = |k: usize| DVec2::new(self.x[k][i], self.y[k][i]);
        let away = if k == 0 { at(0) - held.target } else { at(k) };
        grip.u[k] = -held.stiffness * away - held.damping / scale * (k + 1) as f64 * at(k + 1);
        let mut force = grip.u[k];
        if held.bounded {
            grip.square[k] = (0..=k).map(|j| grip.u[j].dot(grip.u[k - j])).sum();
            grip.inverse[k] = if k == 0 {
                1.0 / grip.square[0].sqrt()
            } else {
                let term = |j: usize| (-0.5 * j as f64 - (k - j) as f64) * grip.square[j] * grip.inverse[k - j];
                (1..=k).map(term).sum::<f64>() / (k as f64 * grip.square[0])
            };
            force = (0..=k).map(|j| held.most * grip.inverse[j] * grip.u[k - j]).sum();
        }
        self.fx[i] += scale * scale * force.x;
        self.fy[i] += scale * scale * force.y;
    }
}
