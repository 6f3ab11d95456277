//! Scenes: the file format, its errors, its generators, and the scenes that come with the program.
//!
//! A scene file is RON (`scenes/*.ron`): a [`Document`] lists bodies, constraints, walls and generators by kind, and
//! [`Document::build`] turns it into a [`Setup`]. A new kind of body or constraint is a new variant in `document.rs` and a
//! new arm in `build.rs`; a new generator is a new file under `generator/`.

pub mod build;
pub mod capture;
pub mod document;
pub mod error;
pub mod generator;
mod known;
mod locate;
mod names;
mod nearest;
mod pass;
mod random;
mod read;
mod save;
mod shipped;

pub use capture::capture;
pub use document::{BodyEntry, BodyFields, ConstraintEntry, Document, End, Settings, Truth, View, WallEntry};
pub(crate) use error::shown;
pub use error::{Place, SceneError};
pub use generator::Generator;
pub use pass::{Limit, Pass};
pub use read::{LARGEST_FILE, open, parse, read_file};
pub use save::{save, save_text, to_ron};
pub use shipped::{Shipped, every_scene, find_shipped, hard_scenes, sections, shipped, truth_scenes};

use crate::engine::{DVec2, Id, Method, World};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// A scene ready to run.
#[derive(Clone, Debug)]
pub struct Setup {
    /// Shipped name ("bridge") or path, as far as that is text.
    pub name: String,
    /// The file that it was read from, if it was.
    pub file: Option<PathBuf>,
    /// Heading for the user; the name where the file has none.
    pub title: String,
    /// One or two sentences for the user: what it shows, what to try; may be empty.
    pub about: String,
    /// The world at time 0.
    pub world: World,
    /// How the scene asks to be stepped.
    pub method: Method,
    /// Names that the file gives to bodies, of those that have one.
    pub names: BTreeMap<Id, String>,
    /// Rectangle to show: centre and height [m].
    pub view: Option<(DVec2, f64)>,
    /// What its exact motion is compared over, if it has one.
    pub truth: Option<Truth>,
    /// What a run must keep to, if the scene is a trial of the engine.
    pub pass: Option<Pass>,
}
