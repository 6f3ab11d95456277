//! The series of discs that turn: θ, its cosine and sine, arms e = R(θ) r, and the forces at their ends.
//!
//! ```text
//! c = cos θ, s = sin θ   ⇒   N c_N = −Σ_{j=1}^{N} j θ_j s_{N−j},   N s_N = Σ_{j=1}^{N} j θ_j c_{N−j}
//! N (N−1) θ_N = α_{N−2},   α_k = (1/I) Σ_ends Σ_j e_j × F_{k−j}
//! ```
//!
//! Of order N = k + 2 only θ_N is unknown, and it enters e_N as θ_N ⊥e₀ (⊥ turns by 90°): the acceleration of an anchor is that of
//! the centre plus α_k ⊥e₀ plus what is known, so A = J M⁻¹ Jᵀ with the arms of the start is the matrix of all orders. An anchor's
//! coefficients stand among those of the nodes, so rods, springs and the hold take them as they take any other's.

use super::judge::largest_difference;
use super::polynomial::{horner, horner_rate, horner_second};
use super::{Taylor, room};
use crate::engine::island::System;

/// Coefficients by order, then by rotor or arm.
#[derive(Debug, Default)]
pub(super) struct TurningSeries {
    /// Whether anything turns in the island at hand.
    active: bool,
    angle: Vec<Vec<f64>>,
    cos: Vec<Vec<f64>>,
    sin: Vec<Vec<f64>>,
    /// Arms.
    x: Vec<Vec<f64>>,
    y: Vec<Vec<f64>>,
    /// Forces at the arms' ends, in units of kg m / (time scale)².
    fx: Vec<Vec<f64>>,
    fy: Vec<Vec<f64>>,
    /// By arm.
    torque: Vec<f64>,
    /// By rotor: torque, then angular acceleration.
    alpha: Vec<f64>,
    radius: Vec<f64>,
    /// By rotor: angular acceleration as the polynomial has it at the end of a step.
    expected: Vec<f64>,
}

impl TurningSeries {
    /// Makes room for the rotors and arms of an island.
    pub fn reserve(&mut self, system: &System) {
        self.active = system.turns();
        if !self.active {
            return;
        }
        let (rotors, arms) = (system.turning.rotors.angle.len(), system.turning.arms.x.len());
        for series in [&mut self.angle, &mut self.cos, &mut self.sin] {
            room(series, rotors);
        }
        for series in [&mut self.x, &mut self.y, &mut self.fx, &mut self.fy] {
            room(series, arms);
        }
        self.torque.resize(arms, 0.0);
        self.alpha.resize(rotors, 0.0);
        self.expected.resize(rotors, 0.0);
        self.radius.clone_from(&system.turning.rotors.radius);
    }

    /// Coefficients 0 and 1.
    pub fn expand_first(&mut self, system: &System, scale: f64) {
        let (rotors, arms) = (&system.turning.rotors, &system.turning.arms);
        self.angle[0].clone_from(&rotors.angle);
        self.angle[1].iter_mut().zip(&rotors.omega).for_each(|(to, omega)| *to = scale * omega);
        self.cos[0].clone_from(&rotors.cos);
        self.sin[0].clone_from(&rotors.sin);
        self.x[0].clone_from(&arms.x);
        self.y[0].clone_from(&arms.y);
        self.know_circle(1);
        self.turn(1);
        self.take_arms(system, 1);
    }

    /// Largest way of a rim by the term of this order [m].
    pub fn last_term(&self, order: usize) -> f64 {
        if !self.active {
            return 0.0;
        }
        self.angle[order]
            .iter()
            .zip(&self.radius)
            .fold(0.0f64, |most, (angle, radius)| most.max((angle * radius).abs()))
    }

    /// Takes the second derivatives of the angles at `part` of the time scale.
    pub fn expect(&mut self, order: usize, part: f64, scale: f64) {
        if self.active {
            horner_second(&self.angle, order, part, scale, &mut self.expected);
        }
    }

    /// Largest difference of the rims' accelerations from what was expected [m/s²], coefficient 2 of the angles being known there.
    pub fn defect(&self, scale: f64) -> f64 {
        if !self.active {
            return 0.0;
        }
        let differences = self.expected.iter().zip(&self.angle[2]).zip(&self.radius);
        differences.fold(0.0f64, |most, ((expected, angle), radius)| {
            most.max(radius * largest_difference(std::slice::from_ref(expected), std::slice::from_ref(angle), scale))
        })
    }

    /// Angles, angular velocities and with them the anchors at `part` of the time scale.
    pub fn evaluate(&self, system: &mut System, order: usize, part: f64, scale: f64) {
        horner(&self.angle, order, part, &mut system.turning.rotors.angle);
        horner_rate(&self.angle, order, part, scale, &mut system.turning.rotors.omega);
        system.turning.place(&mut system.nodes);
    }

    /// What is known of the cosines and sines of this order without θ of this order.
    fn know_circle(&mut self, order: usize) {
        let (cos_before, cos) = self.cos.split_at_mut(order);
        let (sin_before, sin) = self.sin.split_at_mut(order);
        cos[0].fill(0.0);
        sin[0].fill(0.0);
        for j in 1..order {
            let weight = j as f64 / order as f64;
            let before = self.angle[j].iter().zip(&cos_before[order - j]).zip(&sin_before[order - j]);
            for (((angle, c), s), (cos, sin)) in before.zip(cos[0].iter_mut().zip(&mut sin[0])) {
                let rate = weight * angle;
                *cos -= rate * s;
                *sin += rate * c;
            }
        }
    }

    /// Adds the rest, with θ of this order.
    fn turn(&mut self, order: usize) {
        for i in 0..self.alpha.len() {
            let angle = self.angle[order][i];
            self.cos[order][i] -= angle * self.sin[0][i];
            self.sin[order][i] += angle * self.cos[0][i];
        }
    }

    /// e of this order from cosines and sines.
    fn take_arms(&mut self, system: &System, order: usize) {
        let arms = &system.turning.arms;
        for (i, (rotor, local)) in arms.rotor.iter().zip(&arms.local).enumerate() {
            let (cos, sin) = (self.cos[order][*rotor as usize], self.sin[order][*rotor as usize]);
            (self.x[order][i], self.y[order][i]) = (cos * local.x - sin * local.y, sin * local.x + cos * local.y);
        }
    }

    /// Takes the forces at the anchors, in `fx` and `fy` by node, to their bodies: coefficient k of the forces there, and of the angular
    /// accelerations.
    fn gather(&mut self, system: &System, scale: f64, k: usize, fx: &mut [f64], fy: &mut [f64]) {
        let (rotors, arms) = (&system.turning.rotors, &system.turning.arms);
        for (i, (point, rotor)) in arms.point.iter().zip(&arms.rotor).enumerate() {
            let (point, node) = (*point as usize, rotors.node[*rotor as usize] as usize);
            (self.fx[k][i], self.fy[k][i]) = (fx[point], fy[point]);
            fx[node] += fx[point];
            fy[node] += fy[point];
        }
        self.torque.fill(0.0);
        for j in 0..=k {
            let force = self.fx[k - j].iter().zip(&self.fy[k - j]);
            for (torque, ((x, y), (fx, fy))) in self.torque.iter_mut().zip(self.x[j].iter().zip(&self.y[j]).zip(force))
            {
                *torque += x * fy - y * fx;
            }
        }
        self.alpha.fill(0.0);
        for (torque, rotor) in self.torque.iter().zip(&arms.rotor) {
            self.alpha[*rotor as usize] += torque;
        }
        let rate = system.drag * scale * (k + 1) as f64;
        for (i, alpha) in self.alpha.iter_mut().enumerate() {
            *alpha = rotors.inverse_inertia[i] * *alpha - rotors.free[i] * rate * self.angle[k + 1][i];
        }
    }

    /// Writes what is known of the accelerations of the anchors to `ax` and `ay` by node, those of the centres being there.
    fn know_accelerations(&mut self, system: &System, k: usize, ax: &mut [f64], ay: &mut [f64]) {
        let (rotors, arms) = (&system.turning.rotors, &system.turning.arms);
        self.know_circle(k + 2);
        self.take_arms(system, k + 2);
        let whole = ((k + 1) * (k + 2)) as f64;
        for (i, (point, rotor)) in arms.point.iter().zip(&arms.rotor).enumerate() {
            let (node, alpha) = (rotors.node[*rotor as usize] as usize, self.alpha[*rotor as usize]);
            ax[*point as usize] = ax[node] - alpha * self.y[0][i] + whole * self.x[k + 2][i];
            ay[*point as usize] = ay[node] + alpha * self.x[0][i] + whole * self.y[k + 2][i];
        }
    }

    /// Adds M⁻¹ Jᵀ λ to the accelerations, and λ of this order to the forces at the anchors.
    fn push(&mut self, system: &System, k: usize, lambda: &[f64], ax: &mut [f64], ay: &mut [f64]) {
        let turning = &system.turning;
        turning.push(&system.nodes.w, lambda, ax, ay, &mut self.alpha);
        let rows = &turning.rows;
        for (row, lambda) in lambda.iter().enumerate() {
            for (end, signed) in rows.ends[row].iter().zip([-lambda, *lambda]) {
                if end.is_off_centre() {
                    self.fx[k][end.arm as usize] += signed * rows.x[row];
                    self.fy[k][end.arm as usize] += signed * rows.y[row];
                }
            }
        }
    }

    /// Coefficient k + 2 of the angles and arms, and of the anchors among the nodes.
    fn finish(&mut self, system: &System, k: usize, x: &mut [f64], y: &mut [f64]) {
        let (rotors, arms) = (&system.turning.rotors, &system.turning.arms);
        let over = 1.0 / ((k + 1) * (k + 2)) as f64;
        self.angle[k + 2].iter_mut().zip(&self.alpha).for_each(|(to, alpha)| *to = over * alpha);
        self.turn(k + 2);
        self.take_arms(system, k + 2);
        for (i, (point, rotor)) in arms.point.iter().zip(&arms.rotor).enumerate() {
            let node = rotors.node[*rotor as usize] as usize;
            x[*point as usize] = x[node] + self.x[k + 2][i];
            y[*point as usize] = y[node] + self.y[k + 2][i];
        }
    }
}

impl Taylor {
    /// From coefficient k of the springs' and the hold's forces by node to that of all that is known of them at the bodies.
    pub(super) fn gather_turning(&mut self, system: &System, scale: f64, k: usize) {
        if k > 0 && !system.rods.a.is_empty() {
            // Σ_{j=1}^{k} d_j λ_{k−j}
            self.know_pulls(k);
            let ends = system.rods.a.iter().zip(&system.rods.b);
            for (((a, b), gx), gy) in ends.zip(&self.gx).zip(&self.gy) {
                let (a, b) = (*a as usize, *b as usize);
                self.fx[a] -= gx;
                self.fy[a] -= gy;
                self.fx[b] += gx;
                self.fy[b] += gy;
            }
        }
        self.turning.gather(system, scale, k, &mut self.fx, &mut self.fy);
    }

    /// The accelerations of anchors, before the constraints are solved for.
    pub(super) fn know_turning(&mut self, system: &System, k: usize) {
        self.turning.know_accelerations(system, k, &mut self.fx, &mut self.fy);
    }

    /// What the constraints add to the accelerations.
    pub(super) fn push_turning(&mut self, system: &System, k: usize) {
        self.turning.push(system, k, &self.lambda[k], &mut self.fx, &mut self.fy);
    }

    /// Coefficient k + 2 of all that turns.
    pub(super) fn finish_turning(&mut self, system: &System, k: usize) {
        self.turning.finish(system, k, &mut self.x[k + 2], &mut self.y[k + 2]);
    }
}
