//! Arms far outside of a small disc.
//!
//! A joint pulls along an arm as it stands at the start of a substep. The force F at an anchor r from the centre of a disc holds the arm like a
//! spring of F r [N·m/rad]; where the disc's moment of inertia I is so small that h² F r > I, the substep cannot follow that oscillation, and the
//! explicit step along the arm's tangent feeds it: light discs pinned far outside themselves reached 1e8 m/s from rest energy. There the solve
//! uses the moment h² F r instead, with the forces of the last substep, so that no arm turns by more than about a radian by it. (As the geometric
//! stiffness of Andrews, Teichmann and Kry, "Geometric stiffness for real-time constrained multibody dynamics", Comput. Graph. Forum 36(2), 2017,
//! on the diagonal alone.) Bounded, not right: what is to be right needs smaller substeps, or an accuracy.
//!
//! Corrections of positions may move bodies by any weights. With the true ones, all joints of such a disc turn it first, each against the others, and
//! a gap takes hundreds of substeps to close; there it weighs as much as a part of m r².

use crate::engine::constraint::form::Joint;
use crate::engine::state::State;
use glam::DVec2;
use std::mem::swap;

/// Part of h² F r that the moment of inertia is at least in a solve.
const STEADY: f64 = 1.0;
/// Part of m r² that it is at least in corrections of positions. Arms within 1.4 radii of the disc are left as they are.
const HEAVY: f64 = 0.25;

/// Inverse moments of inertia by body [1/(kg·m²)]; empty where no joint has an arm.
#[derive(Debug, Default)]
pub(crate) struct Arms {
    /// As they are.
    own: Vec<f64>,
    /// For corrections of positions.
    heavy: Vec<f64>,
    /// F r, summed over the joints [N·m].
    load: Vec<f64>,
}

impl Arms {
    /// Reads the bodies of `state` at the start of a step; `any` says whether there are arms at all.
    pub fn read(&mut self, joints: &[Joint], any: bool, state: &State) {
        self.own.clear();
        self.heavy.clear();
        if !any || state.inverse_inertia.is_empty() {
            return;
        }
        self.own.extend_from_slice(&state.inverse_inertia);
        self.heavy.extend_from_slice(&state.inverse_inertia);
        for (end, at) in joints.iter().flat_map(ends) {
            // Where the world or a body that does not move is at the end, both are 0.
            let (heavy, w) = (&mut self.heavy[end], state.inverse_mass[end]);
            *heavy = heavy.min(w / (HEAVY * at.length_squared()));
        }
    }

    /// Sets the moments that the solve of a substep of `h` seconds uses, from the forces of all constraints in the last substep [N].
    pub fn steady(&mut self, joints: &[Joint], force: &[DVec2], h: f64, state: &mut State) {
        if self.own.is_empty() {
            return;
        }
        self.load.clear();
        self.load.resize(self.own.len(), 0.0);
        for joint in joints {
            let pull = force[joint.index as usize].length();
            ends(joint).into_iter().for_each(|(end, at)| self.load[end] += pull * at.length());
        }
        for ((inverse, own), load) in state.inverse_inertia.iter_mut().zip(&self.own).zip(&self.load) {
            let least = STEADY * h * h * *load;
            *inverse = if least * own > 1.0 { 1.0 / least } else { *own };
        }
    }

    /// Changes to the moments for corrections of positions, and back again.
    pub fn exchange(&mut self, state: &mut State) {
        if !self.own.is_empty() {
            swap(&mut self.heavy, &mut state.inverse_inertia);
        }
    }
}

/// Both ends of a joint that are off a centre: body and anchor. An anchor in the world is no arm, but turns nothing either.
fn ends(joint: &Joint) -> impl IntoIterator<Item = (usize, DVec2)> {
    [(joint.a as usize, joint.at_a), (joint.b as usize, joint.at_b)]
}
