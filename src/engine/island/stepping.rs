//! Carries all islands of a plan through a step.

use super::System;
use crate::engine::body::NO_ROTOR;
use crate::engine::constraint::WORLD;
use crate::engine::error::{LARGEST_COORDINATE, LARGEST_SPEED};
use crate::engine::integrate::taylor::Taylor;
use crate::engine::plan::{IslandPlan, Plan};
use crate::engine::report::{Divergence, StepReport};
use crate::engine::world::World;

/// The islands of a plan, and the scratch memory that they share.
#[derive(Debug, Default)]
pub(crate) struct Islands {
    islands: Vec<(IslandPlan, System)>,
    taylor: Taylor,
}

impl Islands {
    /// Makes the islands of `plan` anew.
    pub fn build(&mut self, world: &World, plan: &Plan) {
        self.islands.clear();
        for plan in &plan.islands {
            let system = System::new(world, &plan.group.bodies, &plan.group.constraints);
            self.islands.push((plan.clone(), system));
        }
    }

    /// Carries all islands through `time` [s], without touching the world.
    pub fn advance(&mut self, world: &World, time: f64, report: &mut StepReport) -> Option<Divergence> {
        for (plan, system) in &mut self.islands {
            system.load(world, time);
            let outcome = self.taylor.advance(system, time, plan.tolerance * system.length);
            report.island_steps = report.island_steps.max(outcome.steps);
            report.retries += outcome.retries;
            report.order = report.order.max(outcome.order);
            report.local_error = report.local_error.max(outcome.error / system.length);
            report.redundant += system.matrix.pivots.dropped;
            if let Some(divergence) = find_divergence(world, system, outcome.failed) {
                return Some(divergence);
            }
        }
        None
    }

    /// Writes the islands back; what turns freely turns on for `time` [s].
    pub fn store(&self, world: &mut World, time: f64) {
        for (_, system) in &self.islands {
            system.store(world);
            for body in system.nodes.body.iter().filter(|body| **body != WORLD) {
                let rotor = world.bodies.rotor[*body as usize];
                if rotor != NO_ROTOR && world.bodies.inverse_mass[*body as usize] > 0.0 {
                    let (decay, rotors) = (system.drag, &mut world.bodies.rotors);
                    let omega = rotors.omega[rotor as usize];
                    // ω' = −drag ω
                    let kept = libm::exp(-decay * time);
                    let mean = if decay > 0.0 { -libm::expm1(-decay * time) / decay } else { time };
                    rotors.angle[rotor as usize] += omega * mean;
                    rotors.omega[rotor as usize] = omega * kept;
                }
            }
        }
    }
}

/// A node out of the range in which numbers mean anything, or an island that could not be solved.
fn find_divergence(world: &World, system: &System, failed: bool) -> Option<Divergence> {
    let nodes = &system.nodes;
    let beyond = |value: f64, most: f64| !(value.abs() <= most);
    for i in (0..nodes.len()).filter(|i| nodes.body[*i] != WORLD) {
        let far = beyond(nodes.x[i], LARGEST_COORDINATE) || beyond(nodes.y[i], LARGEST_COORDINATE);
        let fast = beyond(nodes.vx[i], LARGEST_SPEED) || beyond(nodes.vy[i], LARGEST_SPEED);
        if !far && !fast && !failed {
            continue;
        }
        let (quantity, value) =
            if far { ("position", nodes.x[i].hypot(nodes.y[i])) } else { ("velocity", nodes.vx[i].hypot(nodes.vy[i])) };
        let advice = "Its constraints contradict each other or its springs are too stiff for the wanted accuracy: \
                      move it to where the constraints can hold, or ask for less accuracy.";
        return Some(Divergence {
            body: world.bodies.id[nodes.body[i] as usize],
            quantity,
            value,
            substep: 0,
            advice: advice.into(),
        });
    }
    None
}
