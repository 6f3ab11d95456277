//! A step, stage by stage.
use super::{EngineError, Method, StepReport, World};

/// Carries out a plan: `step` after `step`, with its own scratch memory.
pub struct Stepper {
    method: Method,
}

impl Stepper {
    /// A stepper for `method`.
    pub fn new(method: Method) -> Result<Stepper, EngineError> {
        method.validate()?;
        Ok(Stepper { method })
    }

    /// Hands in a clock (nanoseconds from any origin) with which the stages are timed.
    pub fn with_clock(self, _clock: fn() -> u64) -> Stepper {
        self
    }

    pub fn method(&self) -> &Method {
        &self.method
    }

    /// Changes the method; the plan follows with the next step.
    pub fn set_method(&mut self, method: Method) -> Result<(), EngineError> {
        method.validate()?;
        self.method = method;
        Ok(())
    }

    /// What the plan decided and why, in one sentence for the user.
    pub fn plan_sentence(&self) -> String {
        String::new()
    }

    /// Steps the world once (1/hz seconds). If the run diverges the world is left as it was and the report says so.
    pub fn step(&mut self, _world: &mut World) -> StepReport {
        StepReport::default()
    }
}
