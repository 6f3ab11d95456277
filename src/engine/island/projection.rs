//! Back onto C = 0 and Ċ = 0: the shortest moves, in the metric of the masses.
//!
//! A μ = −C, x += M⁻¹ Jᵀ μ; A ν = −J v, v += M⁻¹ Jᵀ ν. With the matrix of the present positions one pass takes an error e to
//! O(e²); a velocity that does not fit (an edit, a rope that tightens) is what an inelastic hit would leave.

use super::System;

/// C is worth a pass of its own, with a new matrix, above this part of L².
const FAR: f64 = 1e-6;
/// Most passes for positions far off.
const MOST_PASSES: u32 = 30;

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

    /// Writes −C to the right-hand side. Returns the largest |C| in parts of L².
    pub fn position_error(&mut self) -> f64 {
        let mut largest: f64 = 0.0;
        let rods = &self.rods;
        for (r, rhs) in self.rhs.iter_mut().enumerate().take(rods.a.len()) {
            let error = 0.5 * (self.dx[r] * self.dx[r] + self.dy[r] * self.dy[r] - rods.square[r]);
            *rhs = if rods.held[r] { -error } else { 0.0 };
            largest = largest.max(rhs.abs() / rods.square[r]);
        }
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

    /// Takes the part of the velocities away that breaks the constraints.
    pub fn project_velocities(&mut self) {
        self.velocity_error();
        self.matrix.solve(&mut self.rhs);
        self.push_velocities();
    }

    /// Writes −J v to the right-hand side.
    pub fn velocity_error(&mut self) {
        let (rods, nodes) = (&self.rods, &self.nodes);
        for (r, rhs) in self.rhs.iter_mut().enumerate().take(rods.a.len()) {
            let (a, b) = (rods.a[r] as usize, rods.b[r] as usize);
            let speed = self.dx[r] * (nodes.vx[b] - nodes.vx[a]) + self.dy[r] * (nodes.vy[b] - nodes.vy[a]);
            *rhs = if rods.held[r] { -speed } else { 0.0 };
        }
        let rows = self.rhs[rods.a.len()..].chunks_exact_mut(2);
        for ((a, b), rhs) in self.pins.a.iter().zip(&self.pins.b).zip(rows) {
            let (a, b) = (*a as usize, *b as usize);
            rhs[0] = nodes.vx[a] - nodes.vx[b];
            rhs[1] = nodes.vy[a] - nodes.vy[b];
        }
    }
}
