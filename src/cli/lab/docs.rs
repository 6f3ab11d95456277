//! The folder with the page about accuracy: `data` (a file of JSON lines a scene, and the machine), `lab` (the diagrams), and
//! `accuracy.md`.

use crate::file::{read_bounded, write_whole};
use crate::lab::Point;
use crate::lab::report::page::{Machine, ScenePoints, page, scenes, stem};
use crate::lab::report::{json, svg::svg};
use crate::text::named;
use anyhow::Context;
use std::path::{Path, PathBuf};

const MACHINE: &str = "machine.json";
/// The largest file of data that is read [bytes].
const LARGEST: u64 = 64 * 1024 * 1024;

/// Makes the folders, before minutes are spent on what could not be kept.
pub(super) fn check(folder: &Path) -> anyhow::Result<()> {
    if !folder.is_dir() {
        anyhow::bail!("cannot write into {}: it is not a folder; create it first", named(folder));
    }
    for part in ["data", "lab"] {
        let part = folder.join(part);
        std::fs::create_dir_all(&part).with_context(|| format!("cannot create {}", named(&part)))?;
    }
    Ok(())
}

/// Writes the points of a scene.
pub(super) fn keep(folder: &Path, name: &str, points: &[Point]) -> anyhow::Result<()> {
    let mut bytes = Vec::new();
    points.iter().try_for_each(|point| json::write(&mut bytes, point))?;
    write(&data_of(folder, name), &bytes)
}

/// Writes what the points were measured on.
pub(super) fn keep_machine(folder: &Path) -> anyhow::Result<()> {
    let text = serde_json::to_string_pretty(&Machine::here())? + "\n";
    write(&folder.join("data").join(MACHINE), text.as_bytes())
}

/// Writes the page and all diagrams from the data in the folder.
pub(super) fn draw(folder: &Path) -> anyhow::Result<()> {
    let path = folder.join("data").join(MACHINE);
    let machine: Machine = serde_json::from_str(&read(&path)?)
        .with_context(|| format!("cannot read {}: measure anew without --redraw", named(&path)))?;
    check(folder)?;
    let mut measured = Vec::new();
    for shipped in scenes() {
        let path = data_of(folder, shipped.name);
        let (points, _) = json::read(&read(&path)?).with_context(|| format!("cannot read {}", named(&path)))?;
        let scene = ScenePoints { name: shipped.name.to_owned(), title: shipped.title.to_owned(), points };
        let picture = folder.join("lab").join(scene.stem()).with_extension("svg");
        write(&picture, svg(&scene.title, &scene.points).as_bytes())?;
        measured.push(scene);
    }
    write(&folder.join("accuracy.md"), page(&machine, &measured).as_bytes())
}

fn data_of(folder: &Path, name: &str) -> PathBuf {
    folder.join("data").join(stem(name)).with_extension("jsonl")
}

fn read(path: &Path) -> anyhow::Result<String> {
    let advice = || format!("cannot read {}: measure anew without --redraw", named(path));
    String::from_utf8(read_bounded(path, LARGEST).with_context(advice)?).with_context(advice)
}

fn write(path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
    write_whole(path, bytes).with_context(|| format!("cannot write {}", named(path)))
}
