//! An island at an instant, to go back to, and to tell the error of a step from.

use crate::engine::island::System;
use glam::DVec2;

/// Positions, velocities and multipliers.
#[derive(Debug, Default)]
pub(super) struct Moment {
    coordinates: [Vec<f64>; 4],
    rods: Vec<f64>,
    pins: Vec<DVec2>,
}

impl Moment {
    pub fn keep(&mut self, system: &System) {
        let nodes = &system.nodes;
        for (to, from) in self.coordinates.iter_mut().zip([&nodes.x, &nodes.y, &nodes.vx, &nodes.vy]) {
            to.clone_from(from);
        }
        self.rods.clone_from(&system.rods.lambda);
        self.pins.clone_from(&system.pins.lambda);
    }

    pub fn restore(&self, system: &mut System) {
        for (to, from) in system.nodes.coordinates().into_iter().zip(&self.coordinates) {
            to.copy_from_slice(from);
        }
        system.rods.lambda.copy_from_slice(&self.rods);
        system.pins.lambda.copy_from_slice(&self.pins);
    }

    /// Estimate of the error of a step of `h` seconds that began here, RMS over the nodes [m]; `turn` is scratch.
    ///
    /// The rule leaves out h³/12 times the jerk. What a rod's force brings about turns with the rod, so that the jerk times h² is about
    /// its turn times the change of the velocity. Swings that the step does not resolve change no direction and are left out.
    pub fn error(&self, system: &System, h: f64, turn: &mut Vec<f64>) -> f64 {
        let (nodes, rods) = (&system.nodes, &system.rods);
        let [x, y, vx, vy] = &self.coordinates;
        turn.clear();
        turn.resize(nodes.len(), 0.0);
        for (r, (a, b)) in rods.a.iter().zip(&rods.b).enumerate() {
            let (a, b) = (*a as usize, *b as usize);
            let before = (x[b] - x[a], y[b] - y[a]);
            let after = (nodes.x[b] - nodes.x[a], nodes.y[b] - nodes.y[a]);
            let turned = ((before.0 * after.1 - before.1 * after.0) / rods.square[r]).abs();
            turn[a] = turn[a].max(turned);
            turn[b] = turn[b].max(turned);
        }
        let square = |i: usize| {
            let (dx, dy) = (nodes.vx[i] - vx[i], nodes.vy[i] - vy[i]);
            turn[i] * turn[i] * (dx * dx + dy * dy)
        };
        let sum: f64 = (0..nodes.len()).map(square).sum();
        h / 12.0 * (sum / nodes.len() as f64).sqrt()
    }
}
