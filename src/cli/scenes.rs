//! `tautline scenes`: lists what comes with the program.

use super::output::Output;
use crate::scene::{Shipped, shipped, truth_scenes};
use std::io::Write;

pub(super) fn execute() -> std::io::Result<()> {
    let mut out = Output::stdout();
    let sections: [(&str, &[Shipped]); 2] = [("Sandbox", shipped()), ("Truth", truth_scenes())];
    let names = sections.iter().flat_map(|(_, scenes)| *scenes).map(|scene| scene.name.len());
    let width = names.max().unwrap_or(0);
    for (title, scenes) in sections {
        writeln!(out, "{title}:")?;
        for scene in scenes {
            writeln!(out, "  {:width$}  {}", scene.name, scene.title)?;
        }
    }
    out.flush()
}
