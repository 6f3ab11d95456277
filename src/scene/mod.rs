//! Scenes: the file format, its errors, its generators, and the scenes that come with the program.

use crate::engine::{DVec2, Method, World};

/// A scene ready to run.
#[derive(Clone, Debug)]
pub struct Setup {
    /// Shipped name ("bridge") or path.
    pub name: String,
    pub title: String,
    pub about: String,
    pub world: World,
    pub method: Method,
    /// Rectangle to show: centre and height [m].
    pub view: Option<(DVec2, f64)>,
}
