//! The panels around the scene: pure functions of an immutable frame that answer with commands. egui only: no window, no
//! graphics device; the scene itself is drawn below, in the rectangle that [`ShellOutput::canvas`] names.

mod actions;
mod badge;
mod canvas;
mod companions;
mod draft;
mod fault;
pub mod finder;
pub mod format;
mod help;
mod icon;
mod inspector;
pub mod lab;
mod overlay;
mod palette;
mod plots;
pub mod scenes;
pub mod settings;
pub mod shell;
pub mod state;
mod status;
pub mod theme;
mod transport;
mod turns;
mod view;
mod widgets;

pub use overlay::Ranges;
pub use shell::{Shell, ShellOutput};
pub use theme::Theme;
