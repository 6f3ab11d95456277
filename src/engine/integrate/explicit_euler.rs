//! Explicit Euler: x' = x + h v, v' = v + h a(x, v). Order 1; one force evaluation.
//!
//! It gains energy at every frequency: an oscillator grows by √(1 + h²ω²) a step. Kept because it is where everybody starts.

use super::forces::scale;
use super::{Forces, Scene, drift};
use crate::engine::state::State;

pub(super) fn begin(scene: &Scene, state: &mut State, forces: &Forces) -> f64 {
    drift(state, scene.h);
    scale(state, 1.0 - scene.world.drag * scene.h);
    forces.kick(scene, state, scene.h);
    0.0
}
