//! An island at an instant, to go back to, and to tell the error of a step from.

use crate::engine::island::System;
use glam::DVec2;

/// Rods that are worked off side by side.
const SIDE: usize = 32;

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

    /// Velocities, x and y by node.
    pub fn velocities(&self) -> [&[f64]; 2] {
        let [_, _, vx, vy] = &self.coordinates;
        [vx, vy]
    }

    /// Estimate of the error of a step of `h` seconds that began here, RMS over the nodes [m]; `turn` is scratch.
    ///
    /// The rule leaves out h³/12 times the jerk. What a rod's force brings about turns with the rod, so that the jerk times h² is about
    /// its turn times the change of the velocity; a spring's as well. Swings that the step does not resolve change no direction and are left
    /// out. Where a spring turns over the error is the island's size.
    pub fn error(&self, system: &System, h: f64, turn: &mut Vec<f64>) -> f64 {
        let (nodes, rods) = (&system.nodes, &system.rods);
        let [x, y, vx, vy] = &self.coordinates;
        turn.clear();
        turn.resize(nodes.len(), 0.0);
        let [mut dx, mut dy, mut ex, mut ey] = [[0.0; SIDE]; 4];
        for block in rods.pairs.blocks::<SIDE>() {
            let range = block.range();
            let n = range.len();
            for (from, to) in [(x, &mut dx), (y, &mut dy), (&nodes.x, &mut ex), (&nodes.y, &mut ey)] {
                block.differences(from, &mut to[..n]);
            }
            let square = &rods.square[range][..n];
            for k in 0..n {
                let turned = (dx[k] * ey[k] - dy[k] * ex[k]) / square[k];
                dx[k] = 0.5 * turned * turned;
            }
            block.add_to_both(&dx[..n], turn);
        }
        let springs = &system.springs;
        if springs.turn_over(nodes, x, y) {
            return system.length;
        }
        for block in springs.pairs.blocks::<SIDE>() {
            let n = block.range().len();
            for (from, to) in [(x, &mut dx), (y, &mut dy), (&nodes.x, &mut ex), (&nodes.y, &mut ey)] {
                block.differences(from, &mut to[..n]);
            }
            for k in 0..n {
                let square = dx[k] * dx[k] + dy[k] * dy[k];
                let turned = (dx[k] * ey[k] - dy[k] * ex[k]) / square;
                dx[k] = if square > 0.0 { 0.5 * turned * turned } else { 0.0 };
            }
            block.add_to_both(&dx[..n], turn);
        }
        let mut sum = 0.0;
        for (i, turned) in turn.iter().enumerate() {
            let (dx, dy) = (nodes.vx[i] - vx[i], nodes.vy[i] - vy[i]);
            sum += turned * (dx * dx + dy * dy);
        }
        h / 12.0 * (sum / nodes.len() as f64).sqrt()
    }
}
