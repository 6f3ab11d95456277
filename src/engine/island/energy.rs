//! The energy of an island, where nothing gives or takes any: what a method that damps loses of it in a step.

use super::System;

/// Falls of so many times the step count as motion that is to come: energy is measured by more than what moves at the
/// instant.
const FALL: f64 = 10.0;

/// Energy, and what a change of it is measured by [J].
#[derive(Clone, Copy, Debug)]
pub(super) struct Energy {
    pub total: f64,
    pub scale: f64,
}

impl System {
    /// Whether energy is conserved: no drag, damper, hold, body that is led, or rope, which takes some when it
    /// tightens.
    pub(super) fn is_conservative(&self) -> bool {
        let nodes = &self.nodes;
        let led = |i: &u32| nodes.vx[*i as usize] != 0.0 || nodes.vy[*i as usize] != 0.0;
        let ropes = self.rods.first_rope < self.rods.a.len();
        self.drag == 0.0 && self.held.is_none() && !self.springs.damped && !ropes && !nodes.fixed.iter().any(led)
    }

    /// The energy of what moves and of the springs, for steps of `time` seconds.
    pub(super) fn energy(&self, time: f64) -> Energy {
        let nodes = &self.nodes;
        let fall = 0.5 * self.gravity.length_squared() * (FALL * time) * (FALL * time);
        let mut energy = Energy { total: 0.0, scale: 0.0 };
        for i in (0..nodes.len()).filter(|i| nodes.w[*i] > 0.0) {
            let mass = 1.0 / nodes.w[i];
            let kinetic = 0.5 * mass * (nodes.vx[i] * nodes.vx[i] + nodes.vy[i] * nodes.vy[i]);
            energy.total += kinetic - mass * (self.gravity.x * nodes.x[i] + self.gravity.y * nodes.y[i]);
            energy.scale += kinetic + mass * fall;
        }
        let springs = &self.springs;
        for (i, (a, b)) in springs.a.iter().zip(&springs.b).enumerate() {
            let (a, b) = (*a as usize, *b as usize);
            let (dx, dy) = (nodes.x[b] - nodes.x[a], nodes.y[b] - nodes.y[a]);
            let stretch = (dx * dx + dy * dy).sqrt() - springs.rest[i];
            let elastic = 0.5 * springs.stiffness[i] * stretch * stretch;
            energy.total += elastic;
            energy.scale += elastic;
        }
        energy
    }
}
