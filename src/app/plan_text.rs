//! The plan in words, put together anew only when the plan is.

use crate::engine::world::Revision;
use crate::engine::{Stepper, World};
use std::sync::Arc;

/// The last sentence, and which plan it is of.
#[derive(Debug, Default)]
pub(super) struct PlanText {
    text: Option<(Revision, Arc<str>)>,
}

impl PlanText {
    /// What the stepper's plan for the world decided, in one sentence.
    pub fn of(&mut self, stepper: &mut Stepper, world: &World) -> Arc<str> {
        let method = *stepper.method();
        let plan = stepper.plan(world);
        if let Some((_, text)) = self.text.as_ref().filter(|(version, _)| version.same(plan.version())) {
            return text.clone();
        }
        let text: Arc<str> = plan.sentence(world, &method).into();
        self.text = Some((plan.version(), text.clone()));
        text
    }
}
