//! Forces on the bodies: gravity, drag, and those springs that the substep resolves.

use super::Scene;
use crate::engine::constraint::form::{Joint, Row};
use crate::engine::state::State;
use glam::DVec2;

/// Spring forces and torques by body; empty in a scene whose springs are all rows.
#[derive(Debug, Default)]
pub(crate) struct Forces {
    /// [N]
    force: Vec<DVec2>,
    /// [N·m]; empty in a scene without spin
    torque: Vec<f64>,
    /// Multiplier of each spring of the plan [N], in its order.
    pub spring: Vec<f64>,
    /// Velocities put aside while a force is evaluated at predicted ones.
    kept_velocity: Vec<DVec2>,
    kept_omega: Vec<f64>,
}

impl Forces {
    /// Evaluates the springs at the present positions and velocities.
    pub fn evaluate(&mut self, scene: &Scene, state: &State) {
        if scene.plan.springs.is_empty() {
            return;
        }
        if scene.plan.spin { self.evaluate_as::<true>(scene, state) } else { self.evaluate_as::<false>(scene, state) }
    }

    fn evaluate_as<const SPIN: bool>(&mut self, scene: &Scene, state: &State) {
        self.force.clear();
        self.force.resize(state.position.len(), DVec2::ZERO);
        self.torque.clear();
        self.torque.resize(state.angle.len(), 0.0);
        self.spring.clear();
        for joint in &scene.plan.springs {
            let [Some(row), _] = joint.rows::<SPIN>(state) else { continue };
            let lambda = -(joint.form.stiffness * row.error + joint.form.damping * joint.speed::<SPIN>(&row, state));
            self.spring.push(lambda);
            self.add::<SPIN>(joint, &row, lambda);
        }
    }

    fn add<const SPIN: bool>(&mut self, joint: &Joint, row: &Row, lambda: f64) {
        let (a, b) = (joint.a as usize, joint.b as usize);
        self.force[a] -= lambda * row.normal;
        self.force[b] += lambda * row.normal;
        if SPIN {
            self.torque[a] -= lambda * row.arm_a;
            self.torque[b] += lambda * row.arm_b;
        }
    }

    /// Puts the velocities aside.
    pub fn remember(&mut self, state: &State) {
        self.kept_velocity.clone_from(&state.velocity);
        self.kept_omega.clone_from(&state.omega);
    }

    /// Brings the velocities put aside back.
    pub fn recall(&self, state: &mut State) {
        state.velocity.clone_from(&self.kept_velocity);
        state.omega.clone_from(&self.kept_omega);
    }

    /// v += h (g + f/m) for every dynamic body.
    pub fn kick(&self, scene: &Scene, state: &mut State, h: f64) {
        let pushed = state.velocity.iter_mut().zip(&state.inverse_mass);
        if scene.plan.springs.is_empty() {
            let change = h * scene.world.gravity;
            pushed.filter(|(_, w)| **w > 0.0).for_each(|(velocity, _)| *velocity += change);
            return;
        }
        for ((velocity, w), force) in pushed.zip(&self.force).filter(|((_, w), _)| **w > 0.0) {
            *velocity += h * (scene.world.gravity + *w * *force);
        }
        for ((omega, i), torque) in state.omega.iter_mut().zip(&state.inverse_inertia).zip(&self.torque) {
            *omega += h * i * torque;
        }
    }
}

/// Writes the springs' multipliers to the list of all constraints' [N].
pub(crate) fn add_spring_forces(forces: &Forces, springs: &[Joint], multiplier: &mut [DVec2]) {
    for (joint, lambda) in springs.iter().zip(&forces.spring) {
        multiplier[joint.index as usize] = DVec2::new(*lambda, 0.0);
    }
}

/// The exact decay of velocities under drag for `h` seconds: v · e^(−drag h).
pub(crate) fn decay(scene: &Scene, state: &mut State, h: f64) {
    if scene.world.drag > 0.0 {
        scale(state, libm::exp(-scene.world.drag * h));
    }
}

/// Multiplies the velocities of all dynamic bodies.
pub(crate) fn scale(state: &mut State, factor: f64) {
    let dynamic = state.velocity.iter_mut().zip(&state.inverse_mass).filter(|(_, w)| **w > 0.0);
    dynamic.for_each(|(velocity, _)| *velocity *= factor);
    let turning = state.omega.iter_mut().zip(&state.inverse_inertia).filter(|(_, i)| **i > 0.0);
    turning.for_each(|(omega, _)| *omega *= factor);
}
