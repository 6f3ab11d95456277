//! The sandbox without its window: the simulation thread, the commands it takes, the frames it publishes, the camera, undo.

pub mod camera;
pub mod command;
pub mod frame;

pub use camera::Camera;
pub use command::{Command, Edit, Spawn};
pub use frame::{Frame, SceneInfo, Speed};
