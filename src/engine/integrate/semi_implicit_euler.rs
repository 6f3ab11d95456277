//! Semi-implicit (symplectic) Euler: v' = v + h a(x), x' = x + h v'. Order 1; one force evaluation.
//!
//! Energy stays bounded for h ω < 2; phase and amplitude are off by O(h).

use super::forces::decay;
use super::{Forces, Scene};
use crate::engine::state::State;

pub(super) fn begin(scene: &Scene, state: &mut State, forces: &Forces) -> f64 {
    decay(scene, state, scene.h);
    forces.kick(scene, state, scene.h);
    scene.h
}
