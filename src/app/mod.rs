//! The sandbox without its window: the simulation thread, the commands it takes, the frames it publishes, the camera, the
//! tools of the canvas, the table of actions, undo.

pub mod blank;
pub mod camera;
pub mod command;
pub mod companion;
pub mod drawn;
pub mod edit;
mod error;
pub mod frame;
pub mod history;
pub mod keys;
pub mod laboratory;
pub mod pick;
mod plan_text;
pub mod plot_data;
pub mod rescue;
pub mod session;
mod setting;
mod simulation;
mod takeback;
pub mod tools;
pub mod trace;

pub use camera::Camera;
pub use command::{Command, Edit, Spawn};
pub use companion::{Companion, Companions};
pub use frame::{Frame, SceneInfo, Speed};
pub use keys::Action;
pub use laboratory::{Lab, LabOrder, LabReport};
pub use plot_data::{Plots, Sample};
pub use rescue::{RescueError, rescue};
pub use session::Session;
pub use simulation::{Beside, frame_after};
pub use tools::{Button, Feedback, Join, Modifiers, Phase, PointerEvent, Tool, Tools};
pub use trace::Trace;
