//! The new, empty scene.

use crate::engine::{DVec2, Method, World};
use crate::scene::Setup;

/// Its name; no shipped scene and no path is called so.
pub const NAME: &str = "new scene";

/// An empty world under gravity, stepped by accuracy: quick, a thousandth of what is built.
pub fn blank() -> Setup {
    Setup {
        name: NAME.into(),
        file: None,
        title: "New scene".into(),
        about: "Empty: choose something under Add, or by a key 1 … 7, and click where it goes.".into(),
        world: World::new(),
        method: Method { automatic: true, accuracy: 1e-3, ..Method::default() },
        names: Default::default(),
        view: Some((DVec2::ZERO, 8.0)),
        truth: None,
        pass: None,
    }
}
