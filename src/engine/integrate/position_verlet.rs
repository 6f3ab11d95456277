//! Position Verlet: half a drift, a kick at the middle, half a drift. Order 2, symplectic; one force evaluation, two where
//! springs have dampers (Tuckerman, Berne, Martyna, J. Chem. Phys. 97, 1990 (1992)).
//!
//! Energy stays bounded for h ω < 2.

use super::forces::decay;
use super::{Forces, Scene, drift};
use crate::engine::state::State;

pub(super) fn begin(scene: &Scene, state: &mut State, forces: &mut Forces) -> f64 {
    let half = scene.h / 2.0;
    drift(state, half);
    forces.evaluate(scene, state);
    decay(scene, state, half);
    if scene.plan.dashpots {
        kick_with_damping(scene, state, forces);
    } else {
        forces.kick(scene, state, scene.h);
    }
    decay(scene, state, half);
    half
}

/// A kick by the force at the velocity halfway through it (explicit midpoint), which keeps the order with dampers.
fn kick_with_damping(scene: &Scene, state: &mut State, forces: &mut Forces) {
    let half = scene.h / 2.0;
    forces.remember(state);
    forces.kick(scene, state, half);
    forces.evaluate(scene, state);
    forces.recall(state);
    forces.kick(scene, state, scene.h);
}
