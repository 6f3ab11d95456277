//! The exact motion of a scene, where one is known.

use super::Setup;
use crate::truth::{self, Trajectory};

impl Setup {
    /// The exact motion of the scene from its start, sampled every 1/60 s: from the closed form that it names, or as it is stored
    /// in the program. `None` where neither is, and for a world that no longer starts as the stored one does.
    pub fn known_motion(&self) -> Option<Trajectory> {
        let span = self.truth?;
        match span.form {
            Some(form) => form.trajectory(&self.world, span.seconds, span.length).ok(),
            None => truth::stored(&self.name).filter(|stored| self.starts_as(stored)),
        }
    }

    /// Whether bodies are where a trajectory begins, but for the rounding of the file.
    fn starts_as(&self, trajectory: &Trajectory) -> bool {
        let own = &self.world.bodies().position;
        trajectory.positions.first().is_some_and(|start| {
            start.len() == own.len() && start.iter().zip(own).all(|(a, b)| a.distance(*b) <= 1e-9 * trajectory.length)
        })
    }
}
