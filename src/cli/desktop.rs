//! The commands that draw. A build without the feature `desktop` has none of that and says so.

use super::ShotArguments;
use std::ffi::OsStr;

/// Opens the sandbox. A scene that is wrong is refused before any window is asked for.
#[cfg(feature = "desktop")]
pub(super) fn open(scene: Option<&OsStr>) -> anyhow::Result<()> {
    if let Some(scene) = scene {
        crate::scene::open(scene)?;
    }
    crate::window::run(scene)
}

/// Writes a picture.
#[cfg(feature = "desktop")]
pub(super) fn shot(arguments: &ShotArguments) -> anyhow::Result<()> {
    let setup = crate::scene::open(&arguments.scene)?;
    super::output::spare_scene("the picture", &arguments.file, &setup)?;
    let by = |accuracy| crate::engine::Method { automatic: true, accuracy, ..setup.method };
    let beside = crate::app::Beside { truth: arguments.ghost, rival: arguments.beside.map(by) };
    let options = crate::window::ShotOptions {
        at: arguments.at,
        size: arguments.size,
        path: arguments.file.clone(),
        light: arguments.theme == "light",
        whole_window: arguments.window,
        beside,
    };
    crate::window::shot(setup, &options)
}

/// Opens nothing, and says why.
#[cfg(not(feature = "desktop"))]
pub(super) fn open(scene: Option<&OsStr>) -> anyhow::Result<()> {
    if let Some(scene) = scene {
        crate::scene::open(scene)?;
    }
    no_window()
}

/// Draws nothing, and says why.
#[cfg(not(feature = "desktop"))]
pub(super) fn shot(arguments: &ShotArguments) -> anyhow::Result<()> {
    crate::scene::open(&arguments.scene)?;
    no_window()
}

#[cfg(not(feature = "desktop"))]
fn no_window() -> anyhow::Result<()> {
    anyhow::bail!(
        "this build has no window and draws no pictures: build it with the feature `desktop` (the default). \
         `tautline run` works without it"
    )
}
