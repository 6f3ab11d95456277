//! The commands that draw. A build without the feature `desktop` has none of that and says so.

use super::ShotArguments;
use crate::scene;

/// Opens the sandbox, on the first shipped scene if none is named. A scene that is wrong is refused before a window opens.
pub(super) fn open(name: Option<&str>) -> anyhow::Result<()> {
    if let Some(name) = name {
        scene::open(name)?;
    }
    window(name)
}

/// Writes a picture.
pub(super) fn shot(arguments: &ShotArguments) -> anyhow::Result<()> {
    picture(scene::open(&arguments.scene)?, arguments)
}

#[cfg(feature = "desktop")]
fn window(name: Option<&str>) -> anyhow::Result<()> {
    crate::window::run(name)
}

#[cfg(feature = "desktop")]
fn picture(setup: scene::Setup, arguments: &ShotArguments) -> anyhow::Result<()> {
    let options = crate::window::ShotOptions {
        at: arguments.at,
        size: arguments.size,
        path: arguments.file.clone(),
        light: arguments.theme == "light",
        whole_window: arguments.window,
    };
    crate::window::shot(setup, &options)
}

#[cfg(not(feature = "desktop"))]
fn window(_name: Option<&str>) -> anyhow::Result<()> {
    no_window()
}

#[cfg(not(feature = "desktop"))]
fn picture(_setup: scene::Setup, _arguments: &ShotArguments) -> anyhow::Result<()> {
    no_window()
}

#[cfg(not(feature = "desktop"))]
fn no_window() -> anyhow::Result<()> {
    anyhow::bail!(
        "this build has no window and draws no pictures: build it with the feature `desktop` (the default). \
         `tautline run` works without it"
    )
}
