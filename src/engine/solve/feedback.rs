//! Baumgarte's position feedback of PGS, on the positions themselves.
//!
//! After the drift each rigid joint in turn loses a part β of its error, its bodies moved along J by their inverse masses. It is
//! the velocity β C/h of Baumgarte (Comput. Methods Appl. Mech. Eng. 1, 1 (1972)) spent at once and then forgotten. With that
//! velocity as a bias of the rows, as in the textbooks, it stays in the velocities and in the multipliers that the next
//! substep starts from: a bridge of 40 rods at rest then climbed from −131 J to +3,263 J in 60 s (4 substeps × 10 sweeps,
//! β = 0.2), more relaxation sweeps did not help, and a smaller β only delayed it. Kept apart it stays at rest, also at β = 1.
//!
//! Cost: one pass over the joints a substep, with a square root each.

use crate::engine::constraint::form::Joint;
use crate::engine::state::State;

/// Takes the part `part` of every rigid joint's error away.
pub(crate) fn feed_back<const SPIN: bool>(joints: &[Joint], part: f64, state: &mut State) {
    for joint in joints.iter().filter(|joint| !joint.form.stiffness.is_finite()) {
        for axis in 0..joint.form.rows() {
            let Some(row) = joint.rows::<SPIN>(state)[axis] else { break };
            if joint.form.high == 0.0 && row.error <= 0.0 {
                break;
            }
            let push = -part * row.error / joint.inverse_effective_mass::<SPIN>(&row, state);
            let (a, b) = (joint.a as usize, joint.b as usize);
            state.position[a] -= state.inverse_mass[a] * push * row.normal;
            state.position[b] += state.inverse_mass[b] * push * row.normal;
            if SPIN {
                state.angle[a] -= state.inverse_inertia[a] * push * row.arm_a;
                state.angle[b] += state.inverse_inertia[b] * push * row.arm_b;
            }
        }
    }
}
