//! Which ropes are in force at an instant: the active set.

use super::System;

/// A rope closer to its length than this part of L² counts as taut.
const TIGHT: f64 = 1e-12;
/// Ends that approach slower than this part of the fastest node's speed may only seem to, by round-off.
const STILL: f64 = 1e-9;

impl System {
    fn ropes(&self) -> std::ops::Range<usize> {
        self.rods.first_rope..self.rods.a.len()
    }

    /// Factors at the present positions; an edit's positions and velocities are projected onto the constraints.
    /// Returns whether there is a position that meets them.
    pub fn meet_constraints(&mut self) -> bool {
        if self.unconstrained() {
            return true;
        }
        self.tighten();
        self.factor();
        if self.position_error() > TIGHT && !self.project_positions() {
            return false;
        }
        self.settle_velocities();
        true
    }

    /// Takes those ropes in force that have reached their length and do not come together. What it decides follows from
    /// positions and velocities alone; a rope that it holds wrongly would push, and is let go for that.
    fn tighten(&mut self) {
        let speed = self.nodes.fastest();
        for r in self.ropes() {
            let (a, b) = (self.rods.a[r] as usize, self.rods.b[r] as usize);
            let nodes = &self.nodes;
            let (dx, dy) = (nodes.x[b] - nodes.x[a], nodes.y[b] - nodes.y[a]);
            let square = self.rods.square[r];
            let tight = dx * dx + dy * dy >= square * (1.0 - 2.0 * TIGHT);
            let parting = dx * (nodes.vx[b] - nodes.vx[a]) + dy * (nodes.vy[b] - nodes.vy[a]);
            self.rods.held[r] = tight && parting >= -STILL * speed * square.sqrt();
        }
    }

    /// Projects the velocities; a rope whose impulse would push is let go and the projection made again.
    pub fn settle_velocities(&mut self) {
        let speed = self.nodes.fastest();
        for _ in 0..=self.ropes().len() {
            self.velocity_error();
            self.matrix.solve(&mut self.rhs);
            let pushes = |r: &usize| {
                let noise = 1e-12 * speed / self.rods.square[*r].sqrt();
                self.rods.held[*r] && self.rhs[*r] * self.mobility(*r) > noise
            };
            let Some(first) = self.ropes().find(pushes) else { break };
            self.rods.held[first] = false;
            self.factor();
        }
        self.push_velocities();
    }

    /// Lets go of the rope that pushes hardest with these multipliers; returns whether there is one.
    pub fn release_pushing_ropes(&mut self, lambda: &[f64]) -> bool {
        let mut worst = (0.0, None);
        for r in self.ropes().filter(|r| self.rods.held[*r]) {
            if lambda[r] > worst.0 {
                worst = (lambda[r], Some(r));
            }
        }
        if let (_, Some(r)) = worst {
            self.rods.held[r] = false;
            self.rods.lambda[r] = 0.0;
            return true;
        }
        false
    }
}
