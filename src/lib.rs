//! Tautline: a sandbox for 2D physics with constraints. The rooms, each importing only from rooms further down the list:
//!
//! - [`cli`]: the command line
//! - `window` (binary's desktop shell): the winit loop that ties `ui`, `render` and `app` together
//! - `ui`: egui panels and plots; `render`: wgpu pipelines, one per kind of mark
//! - `app`: the simulation thread, commands, camera, tools, undo
//! - [`lab`]: speed against error: sweeps, references, fronts, reports
//! - [`trial`]: the pass of a hard case, evaluated while it runs
//! - [`measure`]: energy, momentum, violation, penetration, error against a truth
//! - [`scene`]: the file format, its errors, its generators
//! - [`truth`]: closed forms and a reference solver of its own, independent of the engine's
//! - [`engine`]: the physics; knows no window, file or clock
//! - [`file`]: files written whole, read within bounds; [`text`]: text of strangers made fit to be shown; `stop`: requests of the
//!   system to end

#[cfg(feature = "desktop")]
pub mod app;
pub mod cli;
pub mod engine;
pub mod file;
pub mod lab;
pub mod measure;
#[cfg(feature = "desktop")]
pub mod render;
pub mod scene;
mod stop;
pub mod text;
pub mod trial;
pub mod truth;
#[cfg(feature = "desktop")]
pub mod ui;
#[cfg(feature = "desktop")]
pub mod window;
