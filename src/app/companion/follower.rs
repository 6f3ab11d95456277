//! A world that follows another one's inputs, step by step, under a method of its own.

use super::Input;
use crate::app::error::Lost;
use crate::app::plan_text::PlanText;
use crate::engine::{EngineError, Method, StepReport, Stepper, World};
use std::sync::Arc;

/// The world and what steps it. Under the simulation's own method it has the simulation's bits.
pub struct Follower {
    world: World,
    stepper: Stepper,
    plan_text: PlanText,
    report: StepReport,
}

impl Follower {
    /// Follows from the state of `world` on.
    ///
    /// # Errors
    /// If the method cannot be used.
    pub fn new(world: World, method: Method) -> Result<Follower, EngineError> {
        let stepper = Stepper::new(method)?;
        Ok(Follower { world, stepper, plan_text: PlanText::default(), report: StepReport::default() })
    }

    /// The world as it stands after the last step or input.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// What it is stepped with; its rate is that of the simulation.
    pub fn method(&self) -> &Method {
        self.stepper.method()
    }

    /// What the last step told.
    pub fn report(&self) -> &StepReport {
        &self.report
    }

    /// What the plan decided, in one sentence.
    pub fn plan(&mut self) -> Arc<str> {
        self.plan_text.of(&mut self.stepper, &self.world)
    }

    /// Steps with another method from now on; its rate stays that of the simulation.
    pub fn set_method(&mut self, method: Method) -> Result<(), EngineError> {
        self.stepper.set_method(Method { hz: self.method().hz, ..method })
    }

    /// Carries out an input.
    ///
    /// # Errors
    /// If it cannot be carried out here.
    pub(super) fn apply(&mut self, input: &Input) -> Result<(), Lost> {
        if let Input::Rate(hz) = input {
            let method = Method { hz: *hz, ..*self.method() };
            return Ok(self.stepper.set_method(method)?);
        }
        input.apply(&mut self.world)
    }

    /// Takes a step.
    ///
    /// # Errors
    /// If the run diverges; the world is then as it was before.
    pub(super) fn step(&mut self) -> Result<(), Lost> {
        self.report = self.stepper.step(&mut self.world);
        match &self.report.divergence {
            Some(divergence) => Err(Lost::Diverged(divergence.clone())),
            None => Ok(()),
        }
    }
}
