//! `tautline truth`: computes the exact motion of a scene and compares or writes it.

use super::output::{Output, spare_scene};
use crate::file::write_whole;
use crate::measure::error_against;
use crate::scene::{self, Setup, Truth};
use crate::text::named;
use crate::truth::{self, ClosedForm, Trajectory};
use anyhow::Context;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Computes the exact motion of a scene, and says how well it is known and how far the stored one is from it.
///
/// The scene must have an entry such as `truth: (seconds: 10, length: 1)`, and nothing but particles, rods and springs that
/// do not touch. Where the entry names a closed form, as in `truth: (seconds: 3, length: 1, form: Bounce)`, the motion comes from
/// that, and is compared with the computed one if both can be had. Agreement is the RMS distance of two runs of different tolerance, divided by the length. Takes from
/// milliseconds to several minutes a scene in an optimised build.
#[derive(Debug, clap::Args)]
#[command(group(clap::ArgGroup::new("what").required(true).args(["scene", "all"])))]
pub struct TruthArguments {
    /// Name of a shipped scene such as truth/rope, or path of a scene file
    scene: Option<OsString>,
    /// All shipped scenes that have a truth
    #[arg(long)]
    all: bool,
    /// Write what was computed into this folder, a file NAME.truth for each scene; in the sources that is scenes/truth
    #[arg(long, value_name = "FOLDER")]
    write: Option<PathBuf>,
    /// Fail unless what was computed is, byte for byte, what is stored in the program
    #[arg(long)]
    check: bool,
}

pub(super) fn execute(arguments: &TruthArguments) -> anyhow::Result<()> {
    let names: Vec<&OsStr> = match &arguments.scene {
        Some(scene) => vec![scene],
        None => scene::truth_scenes().iter().map(|scene| OsStr::new(scene.name)).collect(),
    };
    if let Some(folder) = arguments.write.as_deref().filter(|folder| !folder.is_dir()) {
        // Before minutes are spent on what could not be kept.
        anyhow::bail!("cannot write into {}: it is not a folder; create it first", named(folder));
    }
    for path in names {
        let setup = scene::open(path)?;
        let name = named(path);
        let target = arguments.write.as_deref().map(|folder| target(folder, path));
        if let Some(target) = &target {
            spare_scene("--write", target, &setup)?;
        }
        let Some(span) = setup.truth else {
            anyhow::bail!(
                "{name} has no truth: add `truth: (seconds: 10, length: 1)` to the scene, or name truth/rope"
            );
        };
        if let Some(form) = span.form {
            anyhow::ensure!(
                arguments.write.is_none() && !arguments.check,
                "{name} follows the closed form {}, which is never stored: leave out --write and --check",
                form.name()
            );
            say_of_form(&setup, form, span)?;
            continue;
        }
        let started = Instant::now();
        let found = truth::converge(&setup.world, span.seconds, span.length).with_context(|| name.clone())?;
        say(&setup, &found, started.elapsed().as_secs_f64())?;
        if let Some(target) = &target {
            write_whole(target, &truth::to_bytes(&found)).with_context(|| format!("cannot write {}", named(target)))?;
        }
        anyhow::ensure!(
            !arguments.check
                || truth::stored(&setup.name).is_some_and(|stored| truth::to_bytes(&stored) == truth::to_bytes(&found)),
            "{name}: what is stored is not what was computed: write it anew with --write scenes/truth"
        );
    }
    Ok(())
}

fn say(setup: &Setup, found: &Trajectory, seconds: f64) -> std::io::Result<()> {
    let (samples, bodies) = (found.positions.len(), setup.world.bodies().len());
    let stored = truth::stored(&setup.name)
        .and_then(|stored| error_against(&stored.positions, &found.positions, found.length))
        .map_or("not stored".to_owned(), |error| format!("stored one differs by {error:.1e}"));
    let agreement = found.agreement;
    Output::stdout().line(format_args!(
        "{}: agreement {agreement:.1e}, {stored}, {samples} samples of {bodies} bodies in {seconds:.1} s",
        named(&setup.name)
    ))
}

/// What is known of a scene with a closed form, and how far the reference solver is from it where that has equations.
fn say_of_form(setup: &Setup, form: ClosedForm, span: Truth) -> anyhow::Result<()> {
    let exact = form.trajectory(&setup.world, span.seconds, span.length)?;
    let check = match truth::converge(&setup.world, span.seconds, span.length) {
        Ok(found) => error_against(&exact.positions, &found.positions, span.length)
            .map_or("not comparable".to_owned(), |error| format!("the reference solver differs by {error:.1e}")),
        Err(error) => error.to_string(),
    };
    let (samples, bodies) = (exact.positions.len(), setup.world.bodies().len());
    let name = form.name();
    Ok(Output::stdout().line(format_args!(
        "{}: closed form {name}, {samples} samples of {bodies} bodies; {check}",
        named(&setup.name)
    ))?)
}

/// The file for the motion of a scene.
fn target(folder: &Path, scene: &OsStr) -> PathBuf {
    let mut name = Path::new(scene).file_stem().unwrap_or_default().to_owned();
    name.push(".truth");
    folder.join(name)
}
