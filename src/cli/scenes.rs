//! `tautline scenes`: lists what comes with the program.

use crate::scene::shipped;
use std::io::Write;

pub(super) fn execute() -> std::io::Result<()> {
    let mut out = std::io::stdout().lock();
    let width = shipped().iter().map(|scene| scene.name.len()).max().unwrap_or(0);
    for scene in shipped() {
        writeln!(out, "{:width$}  {}", scene.name, scene.title)?;
    }
    out.flush()
}
