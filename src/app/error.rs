//! Why a command cannot be carried out. Its words are shown as they are.

use super::edit::EditError;
use crate::engine::{Divergence, EngineError};
use crate::scene::SceneError;
use thiserror::Error;

/// Why a command cannot be carried out; the run is then as it was before.
#[derive(Debug, Error)]
pub(super) enum CommandError {
    /// The engine does not take a value, or something is gone.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// An edit cannot be carried out.
    #[error(transparent)]
    Edit(#[from] EditError),
    /// A scene or a report cannot be read or written.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A speed that is no number.
    #[error("speed is {0}, but must be between 0.01 and 10")]
    Speed(f64),
    /// A report is to be written over the open scene, which is called so.
    #[error("{0} is the open scene. Choose another name.")]
    OpenScene(String),
    /// A report is to be written over a file, which is called so, that is none of this session's reports.
    #[error("{0} is there already. Choose another name, or remove it first.")]
    Exists(String),
    /// The system gives no thread for it.
    #[error("the {what} cannot be started: {why}. Close other programs and try again.")]
    NoThread {
        /// What was to run on it.
        what: &'static str,
        /// Why not.
        why: std::io::Error,
    },
}

/// Why a companion does not follow any more.
#[derive(Debug, Error)]
pub(super) enum Lost {
    /// The engine does not take its method, or an input.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// An edit cannot be carried out on its world.
    #[error(transparent)]
    Edit(#[from] EditError),
    /// Its run diverged.
    #[error("{0}")]
    Diverged(Divergence),
    /// It was left before it had caught up.
    #[error("it was left")]
    Left,
    /// More inputs wait than it may have.
    #[error("it cannot keep up with this scene. Slow the run down, or restart it")]
    Overrun,
    /// A panic.
    #[error("a step failed, which is a defect of Tautline")]
    Failed,
}
