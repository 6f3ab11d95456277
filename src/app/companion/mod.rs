//! Companions: worlds that follow the inputs of the simulation under another method, each on a thread of its own.
//!
//! The simulation tells what happens to its world, in order: an [`Input`] when a hand or a setting changes it, and where its
//! bodies are after every step. A companion carries out the same inputs between the same steps and measures how far the
//! simulation is from it. There are two:
//! - the truth: the exact motion where it is known and nothing was touched, otherwise the most
//!   accurate method and one that is coarser, whose distance says how far the finer one can be believed;
//! - the rival, "B": one world under the method that the user chose, shown beside the simulation.
//!
//! Nothing here holds the simulation up: it copies positions into a queue and goes on. A companion that falls too far behind
//! is given up and says so.

mod follower;
mod input;
mod link;
mod reference;
mod report;
mod rival;
mod separation;
mod thread;

pub use follower::Follower;
pub use input::Input;
pub use reference::{PARTED, reference_methods};
pub use report::{Companion, Companions, Report, Standing};
pub use separation::{Gap, Offsets, Parting, VISIBLE};

pub(super) use link::{Links, Waker};

use super::frame::SceneInfo;
use crate::engine::{DVec2, World};
use crate::lab::scene_length;
use crate::scene::Setup;
use std::sync::Arc;

/// Where the bodies of a world are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pose {
    /// Number of the step.
    pub tick: u64,
    /// Simulated time [s].
    pub time: f64,
    /// Centres by body index [m].
    pub position: Vec<DVec2>,
    /// Angles by body index [rad]; empty if nothing turns.
    pub angle: Vec<f64>,
}

impl Pose {
    /// The pose of `world`.
    pub fn of(world: &World) -> Pose {
        let bodies = world.bodies();
        let angle = |i| bodies.spin(i).map_or(0.0, |spin| spin.angle);
        Pose {
            tick: world.tick(),
            time: world.time(),
            position: bodies.position.clone(),
            angle: if bodies.spinning() > 0 { (0..bodies.len()).map(angle).collect() } else { Vec::new() },
        }
    }
}

/// How far the truth goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// As long as the motion is known: costs nothing, so that every such scene is told how wrong it is.
    Known,
    /// Further, where it must be computed.
    Computed,
}

/// Where a companion begins to follow.
#[derive(Clone, Debug)]
pub struct Beginning {
    /// The simulation's world at that moment.
    pub world: World,
    /// The scene that was opened.
    pub start: Arc<Setup>,
    /// What the window says of that scene.
    pub scene: Arc<SceneInfo>,
    /// Nothing but the method was changed since the scene was opened: what is known of its motion holds.
    pub untouched: bool,
    /// Steps a second [Hz].
    pub hz: f64,
}

impl Beginning {
    /// The length by which distances are divided [m]: the scene's own, or else that of everything in it.
    pub fn length(&self) -> f64 {
        self.start.truth.map_or_else(|| scene_length(&self.world), |truth| truth.length)
    }
}
