//! Velocity Verlet: half a kick, a drift, half a kick at the new positions. Order 2, symplectic; two force evaluations.
//!
//! Energy stays bounded for h ω < 2. The velocities meet the constraints twice, before the drift and after the second
//! kick (as in RATTLE: Andersen, J. Comput. Phys. 52, 24 (1983)), which is why it costs two solves.

use super::forces::decay;
use super::{Forces, Scene};
use crate::engine::state::State;

pub(super) fn begin(scene: &Scene, state: &mut State, forces: &Forces) -> f64 {
    let half = scene.h / 2.0;
    decay(scene, state, half);
    forces.kick(scene, state, half);
    scene.h
}

/// The second half kick. Dampers see the velocity that the first force predicts for the end of the substep.
pub(super) fn kick_again(scene: &Scene, state: &mut State, forces: &mut Forces) {
    let half = scene.h / 2.0;
    if scene.plan.dashpots {
        forces.remember(state);
        forces.kick(scene, state, half);
        forces.evaluate(scene, state);
        forces.recall(state);
    } else {
        forces.evaluate(scene, state);
    }
    forces.kick(scene, state, half);
    decay(scene, state, half);
}
