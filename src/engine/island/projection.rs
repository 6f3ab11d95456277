//! Back onto C = 0 and Ċ = 0: the shortest moves, in the metric of the masses.
//!
//! A μ = −C, x += M⁻¹ Jᵀ μ; A ν = −J v, v += M⁻¹ Jᵀ ν. With the matrix of the present positions one pass takes an error e to
//! O(e²); a velocity that does not fit (an edit, a rope that tightens) is what an inelastic hit would leave.

use super::System;
use super::lanes::Largest;

/// C is worth a pass of its own, with a new matrix, above this part of L².
const FAR: f64 = 1e-6;
/// Most passes for positions far off.
const MOST_PASSES: u32 = 30;
/// C that is as good as none in any case, in parts of L².
const ROUNDING: f64 = 1e-12;
/// Most passes with one matrix.
const FEW_PASSES: u32 = 5;

impl System {
    /// Moves the nodes onto the constraints, and leaves the matrix factored there. Returns whether they were reached.
    pub fn project_positions(&mut self) -> bool {
        self.factor();
        for _ in 0..MOST_PASSES {
            let far = self.position_error();
            if far == 0.0 || !far.is_finite() {
                return far == 0.0;
            }
            self.matrix.solve(&mut self.rhs);
            self.move_nodes();
            if far < FAR {
                self.take_differences();
                return self.position_error() < FAR;
            }
            self.factor();
        }
        false
    }

    /// The same at the end of a step, from positions that are `off` by what the right-hand side says and with the matrix of these;
    /// returns whether the nodes come as close as `tight`, in parts of L². One pass does but for links in a line, whose lengths hardly
    /// change with the moves that would mend them. Ropes that the moves made too long are put back as well.
    pub fn return_to_constraints(&mut self, mut off: f64, tight: f64) -> bool {
        for _ in 0..FEW_PASSES {
            self.matrix.solve(&mut self.rhs);
            self.move_nodes();
            self.take_differences();
            let left = self.position_error();
            if left <= tight {
                return self.shorten_ropes(tight);
            }
            if !(left < 0.5 * off) {
                return false;
            }
            off = left;
        }
        false
    }

    /// How far off the constraints the nodes may be by rounding, in parts of L².
    pub fn rounding_off(&self) -> f64 {
        let shortest = self.rods.length.iter().fold(self.length, |least, length| length.min(least));
        ROUNDING.max(16.0 * f64::EPSILON * self.nodes.farthest() / shortest)
    }

    /// Writes −C to the right-hand side. Returns the largest |C| in parts of L².
    pub fn position_error(&mut self) -> f64 {
        let rods = &self.rods;
        let n = rods.a.len();
        let (dx, dy, square) = (&self.dx[..n], &self.dy[..n], &rods.square[..n]);
        let (size, rhs) = (&mut self.scratch[0][..n], &mut self.rhs[..n]);
        for k in 0..n {
            rhs[k] = 0.5 * (square[k] - (dx[k] * dx[k] + dy[k] * dy[k]));
            size[k] = rhs[k].abs() / square[k];
        }
        for (r, _) in rods.held.iter().enumerate().skip(rods.first_rope).filter(|(_, held)| !**held) {
            (rhs[r], size[r]) = (0.0, 0.0);
        }
        let mut sizes = Largest::default();
        sizes.take(size);
        let mut largest = sizes.value();
        let square = self.length * self.length;
        let rows = self.rhs[rods.a.len()..].chunks_exact_mut(2);
        for ((a, b), rhs) in self.pins.a.iter().zip(&self.pins.b).zip(rows) {
            let (a, b) = (*a as usize, *b as usize);
            rhs[0] = self.nodes.x[a] - self.nodes.x[b];
            rhs[1] = self.nodes.y[a] - self.nodes.y[b];
            largest = largest.max((rhs[0] * rhs[0] + rhs[1] * rhs[1]).sqrt() * self.length / square);
        }
        largest
    }

    /// Writes −C for nodes that have moved by u to the right-hand side. Returns the largest |C| in parts of L², NaN if one of them is.
    pub fn position_error_after(&mut self, ux: &[f64], uy: &[f64]) -> f64 {
        let rods = &self.rods;
        let n = rods.a.len();
        let [ex, ey] = &mut self.scratch;
        rods.pairs.differences(ux, ex);
        rods.pairs.differences(uy, ey);
        let (dx, dy, square) = (&self.dx[..n], &self.dy[..n], &rods.square[..n]);
        let (ex, ey, rhs) = (&mut ex[..n], &ey[..n], &mut self.rhs[..n]);
        for k in 0..n {
            let (x, y) = (dx[k] + ex[k], dy[k] + ey[k]);
            let error = 0.5 * (square[k] - (x * x + y * y));
            rhs[k] = error;
            ex[k] = error.abs() / square[k];
        }
        let mut largest = Largest::default();
        largest.take(ex);
        let nodes = &self.nodes;
        let rows = self.rhs[rods.a.len()..].chunks_exact_mut(2);
        for ((a, b), rhs) in self.pins.a.iter().zip(&self.pins.b).zip(rows) {
            let (a, b) = (*a as usize, *b as usize);
            rhs[0] = (nodes.x[a] - nodes.x[b]) + (ux[a] - ux[b]);
            rhs[1] = (nodes.y[a] - nodes.y[b]) + (uy[a] - uy[b]);
            largest.take(&[rhs[0].abs() / self.length, rhs[1].abs() / self.length]);
        }
        largest.value()
    }

    /// Takes the part of the velocities away that breaks the constraints.
    pub fn project_velocities(&mut self) {
        self.velocity_error();
        self.matrix.solve(&mut self.rhs);
        self.push_velocities();
    }

    /// Writes −J v to the right-hand side. Returns the largest entry in parts of what the largest velocity could bring about, NaN if
    /// one of them is.
    pub fn velocity_error(&mut self) -> f64 {
        let (rods, nodes) = (&self.rods, &self.nodes);
        let n = rods.a.len();
        let [vx, vy] = &mut self.scratch;
        rods.pairs.differences(&nodes.vx, vx);
        rods.pairs.differences(&nodes.vy, vy);
        let (dx, dy, square) = (&self.dx[..n], &self.dy[..n], &rods.square[..n]);
        let (vx, vy, rhs) = (&mut vx[..n], &vy[..n], &mut self.rhs[..n]);
        for k in 0..n {
            rhs[k] = -(dx[k] * vx[k] + dy[k] * vy[k]);
            vx[k] = rhs[k] * rhs[k] / square[k];
        }
        let mut largest = Largest::default();
        largest.take(vx);
        for (rhs, held) in self.rhs.iter_mut().zip(&rods.held).skip(rods.first_rope) {
            *rhs = if *held { *rhs } else { 0.0 };
        }
        let rows = self.rhs[rods.a.len()..].chunks_exact_mut(2);
        for ((a, b), rhs) in self.pins.a.iter().zip(&self.pins.b).zip(rows) {
            let (a, b) = (*a as usize, *b as usize);
            rhs[0] = nodes.vx[a] - nodes.vx[b];
            rhs[1] = nodes.vy[a] - nodes.vy[b];
            largest.take(&[rhs[0] * rhs[0], rhs[1] * rhs[1]]);
        }
        let most = largest.value().sqrt();
        if most == 0.0 { 0.0 } else { most / nodes.fastest() }
    }
}
