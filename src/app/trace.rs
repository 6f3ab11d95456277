//! Where every body was after each of the last steps, frames drawn or not: what trails are made of.

use crate::engine::{DVec2, World};
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// At most this many steps are kept: a fifth of a second at 1000 steps a second, and longer than any window takes to draw.
const MOST_STEPS: usize = 200;
/// At most this many positions: 1.6 MB.
const MOST_POSITIONS: usize = 100_000;

/// All bodies after one step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Moment {
    /// Number of the step.
    pub tick: u64,
    /// Simulated time [s].
    pub time: f64,
    /// By body index [m].
    pub positions: Vec<DVec2>,
}

/// A ring of moments that the simulation thread writes and the window reads. Clones share it.
#[derive(Clone, Debug, Default)]
pub struct Trace(Arc<Mutex<VecDeque<Moment>>>);

impl Trace {
    /// The moments, oldest first, all of the same bodies. The simulation waits while the guard lives: read and let go.
    pub fn read(&self) -> MutexGuard<'_, VecDeque<Moment>> {
        // A poisoned ring is one that a panic left between two moments; each is whole.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Takes note of a world after a step. Reuses the memory of the moment that it forgets.
    pub fn push(&self, world: &World) {
        let positions = &world.bodies().position;
        let most = (MOST_POSITIONS / positions.len().max(1)).clamp(1, MOST_STEPS);
        let mut moments = self.read();
        let mut moment = Moment::default();
        while moments.len() >= most {
            moment = moments.pop_front().unwrap_or_default();
        }
        moment.tick = world.tick();
        moment.time = world.time();
        moment.positions.clone_from(positions);
        moments.push_back(moment);
    }

    /// Forgets everything: the bodies are others now, or elsewhere.
    pub fn clear(&self) {
        self.read().clear();
    }
}
