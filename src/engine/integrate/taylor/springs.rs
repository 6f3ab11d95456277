//! Series of springs and their dampers.

use super::polynomial::add_product;
use super::room;
use crate::engine::island::System;

/// Series of the springs: d, s = |d|², p = 1/|d|, q = p², ρ = ½ ṡ q, σ = force on b over d.
#[derive(Debug, Default)]
pub(super) struct SpringSeries {
    pub dx: Vec<Vec<f64>>,
    pub dy: Vec<Vec<f64>>,
    pub square: Vec<Vec<f64>>,
    inverse: Vec<Vec<f64>>,
    inverse_square: Vec<Vec<f64>>,
    rate: Vec<Vec<f64>>,
    factor: Vec<Vec<f64>>,
    sum: Vec<f64>,
    /// Pulls and dampers that do not act for now, as coinciding ends have none.
    pub hidden: Vec<bool>,
}

impl SpringSeries {
    /// Makes room for n springs.
    pub fn reserve(&mut self, n: usize) {
        for series in [
            &mut self.dx,
            &mut self.dy,
            &mut self.square,
            &mut self.inverse,
            &mut self.inverse_square,
            &mut self.rate,
            &mut self.factor,
        ] {
            room(series, n);
        }
        self.sum.resize(n, 0.0);
        self.hidden.resize(n, false);
    }

    pub fn take_differences(&mut self, system: &System, x: &[Vec<f64>], y: &[Vec<f64>], k: usize) {
        system.springs.pairs.differences(&x[k], &mut self.dx[k]);
        system.springs.pairs.differences(&y[k], &mut self.dy[k]);
    }

    /// Adds coefficient k of the springs' forces, times the scale squared.
    pub fn add_force(&mut self, system: &System, scale: f64, k: usize, fx: &mut [f64], fy: &mut [f64]) {
        let springs = &system.springs;
        if k == 0 {
            self.take_square(0);
        }
        if springs.damped {
            self.take_square(k + 1);
        } else if k > 0 {
            self.take_square(k);
        }
        self.take_inverse(k);
        let square = scale * scale;
        for i in 0..springs.len() {
            let constant = if k == 0 { -springs.stiffness[i] } else { 0.0 };
            self.factor[k][i] = square * (constant + springs.stiffness[i] * springs.rest[i] * self.inverse[k][i]);
        }
        if springs.damped {
            self.take_rate(k);
            for i in 0..springs.len() {
                self.factor[k][i] -= scale * springs.damping[i] * self.rate[k][i];
            }
        }
        for (d, f) in [(&self.dx, fx), (&self.dy, fy)] {
            self.sum.fill(0.0);
            for j in 0..=k {
                add_product(&mut self.sum, &self.factor[j], &d[k - j]);
            }
            springs.pairs.add(&self.sum, f);
        }
    }

    /// s_k = Σ d_j·d_{k−j}
    fn take_square(&mut self, k: usize) {
        let to = &mut self.square[k];
        to.fill(0.0);
        for j in 0..=k {
            add_product(to, &self.dx[j], &self.dx[k - j]);
            add_product(to, &self.dy[j], &self.dy[k - j]);
        }
    }

    /// p = s^(−½): p_k = Σ_{j=1}^{k} (−½ j − (k − j)) s_j p_{k−j} / (k s₀); 0 for coinciding ends, which have no direction, and
    /// where it is hidden.
    fn take_inverse(&mut self, k: usize) {
        let (before, after) = self.inverse.split_at_mut(k);
        let to = &mut after[0];
        if k == 0 {
            for ((p, s), hidden) in to.iter_mut().zip(&self.square[0]).zip(&self.hidden) {
                *p = if *s > 0.0 && !hidden { 1.0 / s.sqrt() } else { 0.0 };
            }
            return;
        }
        to.fill(0.0);
        for j in 1..=k {
            let weight = -0.5 * j as f64 - (k - j) as f64;
            for ((to, s), p) in to.iter_mut().zip(&self.square[j]).zip(&before[k - j]) {
                *to += weight * s * p;
            }
        }
        for (to, s) in to.iter_mut().zip(&self.square[0]) {
            *to = if *s > 0.0 { *to / (k as f64 * s) } else { 0.0 };
        }
    }

    /// ρ_k = ½ Σ (j + 1) s_{j+1} q_{k−j}, q = p².
    fn take_rate(&mut self, k: usize) {
        let to = &mut self.inverse_square[k];
        to.fill(0.0);
        (0..=k).for_each(|j| add_product(to, &self.inverse[j], &self.inverse[k - j]));
        let to = &mut self.rate[k];
        to.fill(0.0);
        for j in 0..=k {
            let weight = 0.5 * (j + 1) as f64;
            for ((to, s), q) in to.iter_mut().zip(&self.square[j + 1]).zip(&self.inverse_square[k - j]) {
                *to += weight * s * q;
            }
        }
    }
}
