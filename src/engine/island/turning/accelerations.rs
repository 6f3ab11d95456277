//! Accelerations at an instant where anchors turn, and how fast such an island can swing.

use super::{End, NONE};
use crate::engine::island::System;
use crate::engine::island::accelerations::Rates;

impl System {
    /// Accelerations by the springs and gravity, without those of the constraints, at the present positions, by node [m/s²] and by
    /// rotor [rad/s²]. The anchors' entries are of no meaning. Neither dampers nor drag nor the hold are looked at.
    pub fn turning_accelerations(&self, ax: &mut [f64], ay: &mut [f64], alpha: &mut [f64]) {
        ax.fill(0.0);
        ay.fill(0.0);
        alpha.fill(0.0);
        let (nodes, rotors, arms) = (&self.nodes, &self.turning.rotors, &self.turning.arms);
        if self.springs.len() > 0 {
            self.springs.add_forces(nodes, ax, ay);
            for (i, (point, rotor)) in arms.point.iter().zip(&arms.rotor).enumerate() {
                let (point, rotor) = (*point as usize, *rotor as usize);
                let node = rotors.node[rotor] as usize;
                ax[node] += ax[point];
                ay[node] += ay[point];
                alpha[rotor] += rotors.inverse_inertia[rotor] * (arms.x[i] * ay[point] - arms.y[i] * ax[point]);
            }
        }
        for (i, (w, free)) in nodes.w.iter().zip(&nodes.free).enumerate() {
            ax[i] = w * ax[i] + free * self.gravity.x;
            ay[i] = w * ay[i] + free * self.gravity.y;
        }
    }

    /// Writes the multipliers [N/m and N] of these accelerations to the right-hand side: A λ = −J a − J̇v. The matrix must be factored at
    /// the present positions. The anchors' entries of `ax`, `ay` become their accelerations.
    pub fn turning_multipliers(&mut self, ax: &mut [f64], ay: &mut [f64], alpha: &[f64]) {
        let (nodes, rotors, arms) = (&self.nodes, &self.turning.rotors, &self.turning.arms);
        for (i, (point, rotor)) in arms.point.iter().zip(&arms.rotor).enumerate() {
            let (point, rotor) = (*point as usize, *rotor as usize);
            let (node, inwards) = (rotors.node[rotor] as usize, rotors.omega[rotor] * rotors.omega[rotor]);
            ax[point] = ax[node] - alpha[rotor] * arms.y[i] - inwards * arms.x[i];
            ay[point] = ay[node] + alpha[rotor] * arms.x[i] - inwards * arms.y[i];
        }
        let (rods, n) = (&self.rods, self.rods.a.len());
        for (r, rhs) in self.rhs[..n].iter_mut().enumerate() {
            let (a, b) = (rods.a[r] as usize, rods.b[r] as usize);
            let (vx, vy) = (nodes.vx[b] - nodes.vx[a], nodes.vy[b] - nodes.vy[a]);
            let along = self.dx[r] * (ax[b] - ax[a]) + self.dy[r] * (ay[b] - ay[a]);
            *rhs = -along - vx * vx - vy * vy;
        }
        for ((a, b), rhs) in self.pins.a.iter().zip(&self.pins.b).zip(self.rhs[n..].chunks_exact_mut(2)) {
            let (a, b) = (*a as usize, *b as usize);
            rhs[0] = ax[a] - ax[b];
            rhs[1] = ay[a] - ay[b];
        }
        self.matrix.solve(&mut self.rhs);
    }

    /// Rates at the present positions and velocities with the multipliers of the right-hand side; `load` is scratch.
    ///
    /// As [`System::rates`], with the mass that an anchor shows, 1/(w + e²/I), in place of the body's, and for what turns a disc
    /// with the stiffness that a pull F on an arm has, F e.
    pub fn turning_rates(&self, load: &mut Vec<f64>) -> Rates {
        let (nodes, rotors, arms) = (&self.nodes, &self.turning.rotors, &self.turning.arms);
        load.clear();
        load.resize(nodes.len() + arms.point.len(), 0.0);
        let (body, at_arm) = load.split_at_mut(nodes.len());
        // By arm, for now: what an anchor shows beyond the mass of its body.
        for (i, (rotor, more)) in arms.rotor.iter().zip(&mut *at_arm).enumerate() {
            *more = rotors.inverse_inertia[*rotor as usize] * (arms.x[i] * arms.x[i] + arms.y[i] * arms.y[i]);
        }
        let mut turn = rotors.omega.iter().fold(0.0f64, |most, omega| most.max(omega.abs()));
        let mut add = |ends: [End; 2], stiffness: f64, pull: f64| {
            for end in ends {
                let (node, mut share) = (end.node as usize, stiffness * nodes.w[end.node as usize]);
                if end.arm != NONE {
                    let arm = end.arm as usize;
                    let rotor = arms.rotor[arm] as usize;
                    let length = (arms.x[arm] * arms.x[arm] + arms.y[arm] * arms.y[arm]).sqrt();
                    share += stiffness * at_arm[arm] + pull * length * rotors.inverse_inertia[rotor];
                }
                body[node] += share;
            }
        };
        let rows = &self.turning.rows;
        let n = self.rods.a.len();
        for (r, lambda) in self.rhs[..n].iter().enumerate() {
            let (a, b) = (self.rods.a[r] as usize, self.rods.b[r] as usize);
            let (vx, vy) = (nodes.vx[b] - nodes.vx[a], nodes.vy[b] - nodes.vy[a]);
            turn = turn.max(((vx * vx + vy * vy) / self.rods.square[r]).sqrt());
            add(rows.ends[r], lambda.abs(), lambda.abs() * self.rods.square[r].sqrt());
        }
        for (p, lambda) in self.rhs[n..].chunks_exact(2).enumerate() {
            add(rows.ends[n + 2 * p], 0.0, (lambda[0] * lambda[0] + lambda[1] * lambda[1]).sqrt());
        }
        for (i, (a, b)) in self.springs.a.iter().zip(&self.springs.b).enumerate() {
            let (a, b) = (*a as usize, *b as usize);
            let (dx, dy) = (nodes.x[b] - nodes.x[a], nodes.y[b] - nodes.y[a]);
            let length = (dx * dx + dy * dy).sqrt();
            let k = self.springs.stiffness[i];
            let ends = [a, b].map(|point| self.turning.end(point as u32));
            add(
                ends,
                k * (self.springs.rest[i] / length.max(1e-9)).max(1.0),
                k * (length - self.springs.rest[i]).abs(),
            );
        }
        let swing = body.iter().fold(0.0f64, |most, load| most.max(2.0 * load)).sqrt();
        Rates { swing, turn }
    }
}
