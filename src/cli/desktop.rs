//! The commands that draw. A build without the feature `desktop` has none of that and says so.

use super::ShotArguments;

/// Opens the sandbox.
pub(super) fn open(scene: Option<&str>) -> anyhow::Result<()> {
    if let Some(scene) = scene {
        crate::scene::open(scene)?;
    }
    no_window()
}

/// Writes a picture.
pub(super) fn shot(arguments: &ShotArguments) -> anyhow::Result<()> {
    crate::scene::open(&arguments.scene)?;
    no_window()
}

fn no_window() -> anyhow::Result<()> {
    anyhow::bail!(
        "this build has no window and draws no pictures: build it with the feature `desktop` (the default). \
         `tautline run` works without it"
    )
}
