//! Mouse grip: a point of a body on a damped spring to a target, with a bounded force.
//!
//! C = p − target (2 rows), k = m ω², c = 2 ζ m ω with m the body's mass, so that a gram and a tonne follow alike; |f| ≤ f_max.
//! Solved implicitly with the velocities: (K + γ) λ = −(J v + bias), λ then scaled back to the disc |λ| ≤ h f_max.
//! K = w 1 + (1/I) ( r_y², −r_x r_y; −r_x r_y, r_x² ).

use super::Grip;
use crate::engine::body::Motion;
use crate::engine::state::State;
use crate::engine::world::World;
use glam::{DMat2, DVec2};
use std::f64::consts::TAU;

/// The grip of this substep, ready to be solved.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GripRows {
    body: usize,
    arm: DVec2,
    /// (K + γ)⁻¹ [kg]
    mass: DMat2,
    /// γ [1/kg]
    softness: f64,
    /// k C / (h k + c) [m/s]
    bias: DVec2,
    /// h f_max [N·s]
    max_impulse: f64,
    /// [N·s]
    pub impulse: DVec2,
}

impl GripRows {
    /// The rows of the world's grip, if it holds a body that can be moved, in a substep of `h` seconds of which `share` is
    /// solved for. `warm` is the force to start from [N].
    pub fn assemble<const SPIN: bool>(
        world: &World,
        state: &State,
        h: f64,
        share: f64,
        warm: DVec2,
    ) -> Option<GripRows> {
        let grip = world.grip.as_ref()?;
        let body = world.bodies.index_of(grip.body)?;
        let inverse_mass = state.inverse_mass[body];
        if inverse_mass == 0.0 {
            return None;
        }
        let arm = state.arm::<SPIN>(body as u32, grip.local);
        let omega = TAU * grip.frequency;
        let stiffness = omega * omega / inverse_mass;
        let damping = 2.0 * grip.damping_ratio * omega / inverse_mass;
        let softness = 1.0 / (share * h * (h * stiffness + damping));
        let inverse_inertia = if SPIN { state.inverse_inertia[body] } else { 0.0 };
        let cross = -inverse_inertia * arm.x * arm.y;
        let k = DMat2::from_cols(
            DVec2::new(inverse_mass + inverse_inertia * arm.y * arm.y + softness, cross),
            DVec2::new(cross, inverse_mass + inverse_inertia * arm.x * arm.x + softness),
        );
        let error = state.position[body] + arm - grip.target;
        Some(GripRows {
            body,
            arm,
            mass: k.inverse(),
            softness,
            bias: error * (stiffness / (h * stiffness + damping)),
            max_impulse: share * h * grip.max_force,
            impulse: clamp_length(warm * h, share * h * grip.max_force),
        })
    }

    /// Adds the impulse that the solve starts from.
    pub fn warm_start<const SPIN: bool>(&self, state: &mut State) {
        self.apply::<SPIN>(self.impulse, state);
    }

    /// One Gauss-Seidel visit.
    pub fn solve<const SPIN: bool>(&mut self, state: &mut State) {
        let mut velocity = state.velocity[self.body];
        if SPIN {
            velocity += state.omega[self.body] * self.arm.perp();
        }
        let wanted = self.impulse - self.mass * (velocity + self.bias + self.softness * self.impulse);
        let impulse = clamp_length(wanted, self.max_impulse);
        let change = impulse - self.impulse;
        self.impulse = impulse;
        self.apply::<SPIN>(change, state);
    }

    fn apply<const SPIN: bool>(&self, impulse: DVec2, state: &mut State) {
        state.velocity[self.body] += state.inverse_mass[self.body] * impulse;
        if SPIN {
            state.omega[self.body] += state.inverse_inertia[self.body] * self.arm.perp_dot(impulse);
        }
    }
}

/// Leads a static body that is held, such as the pinned end of a rope, along the same damped spring; it feels nothing else.
pub(crate) fn lead_static(world: &World, state: &mut State, h: f64) {
    let Some(grip) = world.grip.as_ref() else { return };
    let Some(body) = world.bodies.index_of(grip.body) else { return };
    if world.bodies.motion[body] == Motion::Static {
        let error = state.position[body] + world.arm(body, grip.local) - grip.target;
        state.velocity[body] = led(grip, error, state.velocity[body], h);
        state.moves[body] = true;
    }
}

/// Velocity with which static body `body` is led for the next `h` seconds [m/s]; zero if it is not held.
pub(crate) fn led_velocity(world: &World, body: usize, h: f64) -> DVec2 {
    match world.grip.as_ref().filter(|grip| grip.body == world.bodies.id[body]) {
        Some(grip) => {
            let error = world.to_world(body, grip.local) - grip.target;
            led(grip, error, world.bodies.velocity[body], h)
        }
        None => DVec2::ZERO,
    }
}

/// Implicit Euler of v' = −ω² error − 2 ζ ω v.
fn led(grip: &Grip, error: DVec2, velocity: DVec2, h: f64) -> DVec2 {
    let omega = TAU * grip.frequency;
    let slowed = 1.0 + 2.0 * grip.damping_ratio * omega * h + omega * omega * h * h;
    (velocity - h * omega * omega * error) / slowed
}

/// `v`, shortened to `longest` if it is longer.
fn clamp_length(v: DVec2, longest: f64) -> DVec2 {
    let length = v.length();
    if length > longest { v * (longest / length) } else { v }
}
