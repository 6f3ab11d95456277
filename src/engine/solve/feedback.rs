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
use glam::DVec2;

/// Takes the part `part` of every rigid joint's error away.
pub(crate) fn feed_back<const SPIN: bool>(joints: &[Joint], part: f64, state: &mut State) {
    for joint in joints.iter().filter(|joint| !joint.form.stiffness.is_finite()) {
        let rows = joint.rows::<SPIN>(state);
        let push = match &rows {
            [Some(row), None] if joint.form.high == 0.0 && row.error <= 0.0 => continue,
            [Some(row), None] => DVec2::new(-part * row.error / joint.inverse_effective_mass::<SPIN>(row, state), 0.0),
            [Some(x), Some(y)] => {
                let [xx, xy, yy] = joint.inverse_of_pin::<SPIN>([x, y], state);
                -part * DVec2::new(xx * x.error + xy * y.error, xy * x.error + yy * y.error)
            }
            _ => continue,
        };
        joint.shift::<SPIN>(&rows, push, state);
    }
}
