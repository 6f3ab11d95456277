//! Gauss-Seidel projection of the predicted positions: position-based dynamics as of 2006 (Müller, Heidelberger, Hennix,
//! Ratcliff, "Position Based Dynamics", VRIPHYS 2006; before it Jakobsen, GDC 2001).
//!
//! Each constraint in turn is made to hold by moving its bodies along its own J, weighted by their inverse masses, with J
//! and C evaluated anew at every visit; the velocities then get the moves divided by the substep.
//!
//! A spring k with a damper c takes the part s = 1 − 1/(1 + σ h (h k + c) K) of its distance to C* away, which is implicit
//! Euler's answer for a spring alone, spread over n sweeps as 1 − (1 − s)^(1/n). C* = C₀ c/(h k + c), with C₀ at the start of
//! the substep: the damper holds C where it was, the spring pulls it to zero. σ is the share of the substep's impulse that
//! moves positions, ½ in velocity Verlet. Cost: O(constraints) a sweep, with a square root each. First order; it damps, and a
//! chain looks stretched or soft where the sweeps do not suffice.

use super::overlap::Planes;
use super::pgs::Task;
use crate::engine::constraint::form::Joint;
use crate::engine::state::State;
use glam::DVec2;

/// Scratch of the projection.
#[derive(Debug, Default)]
pub(crate) struct Projection {
    /// Positions and angles before the projection.
    start: Vec<DVec2>,
    start_angle: Vec<f64>,
    /// C of each joint at the start of the substep [m].
    before: Vec<f64>,
    /// What a visit does to each joint: the part of its distance to an aim that it takes away, and the aim [m].
    pull: Vec<(f64, f64)>,
    /// Largest change of a constraint's value in the last sweep [m].
    pub residual: f64,
}

impl Projection {
    /// Keeps the values of the constraints at the start of a substep.
    pub fn remember<const SPIN: bool>(&mut self, joints: &[Joint], state: &State) {
        self.before.clear();
        self.before.extend(joints.iter().map(|joint| joint.rows::<SPIN>(state)[0].map_or(0.0, |row| row.error)));
    }

    /// Projects `state`, whose positions are predictions, and corrects its velocities. Multipliers [N] are added to `force`,
    /// impulses to the rows of the contacts. Returns the number of sweeps.
    pub fn solve<const SPIN: bool>(
        &mut self,
        joints: &[Joint],
        planes: &mut Planes,
        state: &mut State,
        task: &Task,
        force: &mut [DVec2],
    ) -> u32 {
        if joints.is_empty() && planes.rows.is_empty() {
            return 0;
        }
        self.start.clone_from(&state.position);
        self.start_angle.clone_from(&state.angle);
        self.divide_stiffness::<SPIN>(joints, state, task);
        let Task { h, iterations, .. } = *task;
        for _ in 0..iterations {
            self.residual = 0.0;
            for (joint, pull) in joints.iter().zip(&self.pull) {
                let moved = project::<SPIN>(joint, *pull, state, h, force);
                self.residual = self.residual.max(moved);
            }
            for i in 0..planes.rows.len() {
                self.residual = self.residual.max(planes.project::<SPIN>(i, state, h));
            }
        }
        (0..planes.rows.len()).for_each(|i| planes.guard::<SPIN>(i, state));
        self.correct_velocities(state, h);
        iterations
    }

    fn divide_stiffness<const SPIN: bool>(&mut self, joints: &[Joint], state: &State, task: &Task) {
        let Task { h, iterations, share, .. } = *task;
        self.pull.clear();
        for (joint, before) in joints.iter().zip(&self.before) {
            let pull = match joint.rows::<SPIN>(state)[0] {
                Some(row) if joint.form.stiffness.is_finite() => {
                    let k = joint.inverse_effective_mass::<SPIN>(&row, state);
                    let soft = h * joint.form.stiffness + joint.form.damping;
                    let left = 1.0 / (1.0 + share * h * soft * k);
                    (1.0 - libm::pow(left, 1.0 / f64::from(iterations)), before * joint.form.damping / soft)
                }
                _ => (1.0, 0.0),
            };
            self.pull.push(pull);
        }
    }

    fn correct_velocities(&self, state: &mut State, h: f64) {
        for (i, start) in self.start.iter().enumerate().take(state.len()) {
            state.velocity[i] += (state.position[i] - *start) / h;
        }
        for (i, start) in self.start_angle.iter().enumerate() {
            state.omega[i] += (state.angle[i] - start) / h;
        }
    }
}

/// One visit; returns by how much it changed C [m].
fn project<const SPIN: bool>(
    joint: &Joint,
    (part, aim): (f64, f64),
    state: &mut State,
    h: f64,
    force: &mut [DVec2],
) -> f64 {
    let rows = joint.rows::<SPIN>(state);
    let lambda = match &rows {
        [Some(row), None] if joint.form.high == 0.0 && row.error <= 0.0 => return 0.0,
        [Some(row), None] => {
            DVec2::new(part * (aim - row.error) / joint.inverse_effective_mass::<SPIN>(row, state), 0.0)
        }
        [Some(x), Some(y)] => {
            let [xx, xy, yy] = joint.inverse_of_pin::<SPIN>([x, y], state);
            -part * DVec2::new(xx * x.error + xy * y.error, xy * x.error + yy * y.error)
        }
        _ => return 0.0,
    };
    joint.shift::<SPIN>(&rows, lambda, state);
    force[joint.index as usize] += lambda / (h * h);
    rows.iter().flatten().map(|row| (part * (aim - row.error)).abs()).fold(0.0, f64::max)
}
