//! `tautline scenes`: lists what comes with the program.

use super::output::Output;
use crate::scene::{every_scene, sections};
use std::io::Write;

pub(super) fn execute() -> std::io::Result<()> {
    let mut out = Output::stdout();
    let width = every_scene().iter().map(|scene| scene.name.len()).max().unwrap_or(0);
    for (title, scenes) in sections() {
        writeln!(out, "{title}:")?;
        for scene in scenes {
            writeln!(out, "  {:width$}  {}", scene.name, scene.title)?;
        }
    }
    out.flush()
}
