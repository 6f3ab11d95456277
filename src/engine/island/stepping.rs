//! Carries all islands of a plan through a step.

use super::System;
use super::ladder::Ladder;
use super::near::{Surroundings, came_to_wall};
use crate::engine::body::NO_ROTOR;
use crate::engine::constraint::WORLD;
use crate::engine::error::{LARGEST_COORDINATE, LARGEST_SPEED};
use crate::engine::impact::{Fared, Few};
use crate::engine::plan::{IslandPlan, Plan};
use crate::engine::report::StepReport;
use crate::engine::world::World;
use glam::DVec2;

/// The islands of a plan, and what carries them.
#[derive(Debug, Default)]
pub(crate) struct Islands {
    islands: Vec<(IslandPlan, System)>,
    ladder: Ladder,
    surroundings: Surroundings,
    /// Free bodies that can touch, if the plan has them carried; after the islands.
    few: Few,
    /// Indices of the islands that could not be carried in this step, ascending.
    given_up: Vec<usize>,
}

impl Islands {
    /// Makes the islands of `plan` anew.
    pub fn build(&mut self, world: &World, plan: &Plan) {
        self.islands.clear();
        self.given_up.clear();
        self.ladder.clear();
        for plan in &plan.islands {
            let system = System::new(world, &plan.group.bodies, &plan.group.constraints, plan.linear);
            self.ladder.add(&system);
            self.islands.push((plan.clone(), system));
        }
        self.few.build(plan.few.as_ref());
    }

    /// Carries all islands through `time` [s], without touching the world. Those that something is near to, and those whose equations cannot be solved to the
    /// tolerance (contradicting constraints, springs too stiff to be followed in real time) are given up for this step.
    pub fn advance(&mut self, world: &World, plan: &Plan, time: f64, report: &mut StepReport) {
        self.given_up.clear();
        self.surroundings.find(world, plan, &self.islands, time);
        let mut largest = 0;
        for index in 0..self.islands.len() {
            if self.surroundings.near[index] {
                self.given_up.push(index);
                report.near += 1;
                continue;
            }
            let (plan, system) = &mut self.islands[index];
            let (integrator, outcome) = self.ladder.carry(index, (plan, system), world, time);
            report.retries += outcome.retries;
            if let Some(linear) = &mut self.islands[index].1.matrix.linear {
                let quality = std::mem::take(&mut linear.quality);
                report.linear_residual = report.linear_residual.max(quality.residual);
                report.sweeps = report.sweeps.max(quality.sweeps);
            }
            let system = &self.islands[index].1;
            let within = system.nodes.within(LARGEST_COORDINATE, LARGEST_SPEED)
                && system.turning.within(LARGEST_COORDINATE * LARGEST_SPEED);
            if outcome.failed || !within {
                self.given_up.push(index);
                continue;
            }
            if self.islands[index].0.guarded && came_to_wall(world, system) {
                self.given_up.push(index);
                report.near += 1;
                continue;
            }
            if system.nodes.len() > largest {
                largest = system.nodes.len();
                report.integrator = Some(integrator);
                report.matrix = system.matrix.analysed().then_some(system.matrix.summary.path);
            }
            report.island_steps = report.island_steps.max(outcome.steps);
            report.order = report.order.max(outcome.order);
            report.local_error = report.local_error.max(outcome.error / system.length);
            report.lapsed += usize::from(!outcome.kept);
            report.redundant += system.matrix.pivots.dropped;
        }
        report.given_up = self.given_up.len() - report.near;
        let Fared { left, lost, .. } = self.few.advance(world, plan, time, report);
        if left || lost > 0 {
            self.given_up.push(self.islands.len());
        }
        report.near += usize::from(left);
        report.given_up += lost;
    }

    /// Says in `flags` which of the free bodies were carried from event to event in this step.
    pub fn mark_carried(&self, flags: &mut [bool]) {
        self.few.mark_carried(flags);
    }

    /// Islands that the last [`Islands::advance`] gave up, by index in the plan, ascending.
    pub fn given_up(&self) -> &[usize] {
        &self.given_up
    }

    /// Clears the multipliers of islands that go through the substeps in this step and were carried whole in the last. Those of a
    /// rigid chain at an instant may be a peak, which sweeps that start from it take many substeps to work off; meanwhile the chain
    /// is pulled on, and gains energy.
    pub fn forget_pulls(&self, world: &World, force: &mut [DVec2]) {
        for index in self.given_up.iter().filter(|index| **index < self.islands.len()) {
            let constraints = self.islands[*index].0.group.constraints.iter().map(|constraint| *constraint as usize);
            constraints.filter(|c| world.constraints.carried[*c]).for_each(|c| force[c] = DVec2::ZERO);
        }
    }

    /// Writes the islands back, but for those given up; what turns freely turns on for `time` [s].
    pub fn store(&mut self, world: &mut World, time: f64) {
        self.few.store(world);
        let given_up = |index: &usize| self.given_up.binary_search(index).is_ok();
        for (index, (_, system)) in self.islands.iter().enumerate().filter(|(index, _)| !given_up(index)) {
            if !world.bodies.rotors.omega.is_empty() {
                turn_freely(system, world, time);
            }
            // After that, as it knows better of what does not turn freely.
            system.store(world);
            for constraint in &self.islands[index].0.group.constraints {
                world.constraints.carried[*constraint as usize] = true;
            }
        }
        // Also of those given up, so that they wait; one that something is near to holds what an earlier step found.
        let near = &self.surroundings.near;
        for ((plan, system), _) in self.islands.iter().zip(near).filter(|(_, near)| !**near) {
            for constraint in &plan.group.constraints {
                world.constraints.foresight[*constraint as usize] = system.foresight;
            }
        }
    }
}

/// Turns all discs of an island on for `time` [s] as if nothing turned them: ω' = −drag ω.
fn turn_freely(system: &System, world: &mut World, time: f64) {
    let decay = system.drag;
    let kept = libm::exp(-decay * time);
    let mean = if decay > 0.0 { -libm::expm1(-decay * time) / decay } else { time };
    let bodies = &mut world.bodies;
    for body in system.nodes.body.iter().filter(|body| **body != WORLD) {
        let rotor = bodies.rotor[*body as usize];
        if rotor != NO_ROTOR && bodies.inverse_mass[*body as usize] > 0.0 {
            let omega = bodies.rotors.omega[rotor as usize];
            bodies.rotors.angle[rotor as usize] += omega * mean;
            bodies.rotors.omega[rotor as usize] = omega * kept;
        }
    }
}
