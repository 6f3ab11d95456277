//! Integrators, one a file. Each splits a substep in two: `begin` runs up to the point where the velocities meet the
//! constraints, `finish` runs from the solved velocities to the end of the substep.
//!
//! The order stated is that of smooth motion under forces; what constraints add is the solver's error. Drag is split off
//! and decays the velocity exactly (Strang splitting in the second-order methods).

pub(crate) mod energy_momentum;
mod events;
mod explicit_euler;
mod forces;
pub(crate) mod nystrom;
pub(crate) mod outcome;
pub(crate) mod pace;
mod position_verlet;
pub(crate) mod radau;
pub(crate) mod rattle;
pub(crate) mod rattle_turning;
pub(crate) mod runge_kutta;
mod semi_implicit_euler;
pub(crate) mod taylor;
mod velocity_verlet;

pub(crate) use forces::{Forces, add_spring_forces};

use super::collide::sweep::drift;
use super::method::Integrator;
use super::plan::Plan;
use super::state::State;
use super::world::World;

/// Most steps of an island in one call. What needs more does not run in real time, and is left to a method that does not have to
/// follow all that is fast.
const MOST_STEPS: f64 = 1000.0;
/// The same as a budget that is handed in.
pub(crate) const BUDGET: u32 = MOST_STEPS as u32;

/// What an integrator needs to know of the scene in a substep.
pub(crate) struct Scene<'a> {
    pub world: &'a World,
    pub plan: &'a Plan,
    /// Length of the substep [s].
    pub h: f64,
}

/// Up to the velocities that the constraints then correct, from forces evaluated at the start. Returns the part of the substep that is still to be drifted.
pub(crate) fn begin(integrator: Integrator, scene: &Scene, state: &mut State, forces: &mut Forces) -> f64 {
    match integrator {
        Integrator::ExplicitEuler => explicit_euler::begin(scene, state, forces),
        Integrator::SemiImplicitEuler => semi_implicit_euler::begin(scene, state, forces),
        Integrator::PositionVerlet => position_verlet::begin(scene, state, forces),
        Integrator::VelocityVerlet => velocity_verlet::begin(scene, state, forces),
        _ => unreachable!("the plan gives what can touch an integrator with substeps"),
    }
}

/// Whether the forces at the start of the substep are used.
pub(crate) fn evaluates_first(integrator: Integrator) -> bool {
    integrator != Integrator::PositionVerlet
}

/// Whether positions move before the velocities have met the constraints.
pub(crate) fn drifts_first(integrator: Integrator) -> bool {
    matches!(integrator, Integrator::ExplicitEuler | Integrator::PositionVerlet)
}

/// Whether a second kick follows the drift, after which the velocities have to meet the constraints once more.
pub(crate) fn kicks_again(integrator: Integrator) -> bool {
    integrator == Integrator::VelocityVerlet
}

/// The second kick, at the new positions.
pub(crate) fn kick_again(scene: &Scene, state: &mut State, forces: &mut Forces) {
    velocity_verlet::kick_again(scene, state, forces);
}
