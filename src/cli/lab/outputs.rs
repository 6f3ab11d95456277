//! The files that points go to while they are measured.

use super::LabArguments;
use crate::cli::output::{Output, is_same, is_stdout, spare_scene};
use crate::file::{Unreadable, read_bounded};
use crate::lab::Point;
use crate::lab::report::{csv, json, svg::svg};
use crate::scene::Setup;
use crate::text::{escaped, named};
use anyhow::Context;
use std::io::{ErrorKind, Write};
use std::path::Path;

/// The largest file of points that is gone on with [bytes]: a hundred thousand of them.
const LARGEST: u64 = 64 * 1024 * 1024;

/// What is written, point after point; every point is on disk before the next is measured.
pub(super) struct Outputs {
    json: Option<Output>,
    csv: Option<Output>,
    /// Written whole at the end of the scene.
    svg: Option<Output>,
    resumed: Vec<Point>,
    /// Whether the lines of `json` hold the resumed points already.
    appends: bool,
    pub points_on_stdout: bool,
}

impl Outputs {
    /// Opens all files, after a look at whether they get in each other's way or the scenes'.
    pub fn open(arguments: &LabArguments, scenes: &[Setup]) -> anyhow::Result<Outputs> {
        let LabArguments { json, csv, svg, resume, .. } = arguments;
        // The same file for both goes on with it.
        let appends = match (json, resume) {
            (Some(json), Some(resume)) => is_same(json, resume),
            (None, Some(_)) => true,
            _ => false,
        };
        let named_files = [
            ("--resume", resume.as_deref()),
            ("--json", json.as_deref().filter(|_| !appends)),
            ("--csv", csv.as_deref()),
            ("--svg", svg.as_deref()),
        ];
        let files: Vec<(&str, &Path)> =
            named_files.into_iter().filter_map(|(option, file)| Some((option, file?))).collect();
        check(&files, scenes)?;
        let (resumed, kept) = resume.as_deref().map(read).transpose()?.unwrap_or_default();
        if let Some(stray) = resumed.iter().find(|point| scenes.iter().all(|scene| scene.name != point.scene)) {
            let file = named(resume.as_deref().unwrap_or(Path::new("")));
            anyhow::bail!("{file} has points of {}: name that scene too, or another file", escaped(&stray.scene));
        }
        let json = match (json, resume) {
            (_, Some(file)) if appends => Some(Output::journal(file, kept)?),
            (json, _) => json.as_deref().map(|file| Output::journal(file, Vec::new())).transpose()?,
        };
        let header = format!("{}\n", csv::HEADER).into_bytes();
        let csv = csv.as_deref().map(|file| Output::journal(file, header)).transpose()?;
        let svg = svg.as_deref().map(Output::create).transpose()?;
        let points_on_stdout = files.iter().any(|(_, file)| is_stdout(file));
        Ok(Outputs { json, csv, svg, resumed, appends, points_on_stdout })
    }

    /// Ends them; there may have been nothing to measure.
    pub fn finish(mut self) -> std::io::Result<()> {
        self.flush()
    }

    fn flush(&mut self) -> std::io::Result<()> {
        [&mut self.json, &mut self.csv].into_iter().flatten().try_for_each(Output::flush)
    }

    /// The points of a scene that were measured before; they are written on where they are not yet.
    pub fn resumed(&mut self, scene: &str) -> anyhow::Result<Vec<Point>> {
        let points: Vec<Point> = self.resumed.iter().filter(|point| point.scene == scene).cloned().collect();
        for point in &points {
            if !self.appends {
                self.write_json(point)?;
            }
            self.write_csv(point)?;
        }
        self.flush()?;
        Ok(points)
    }

    pub fn write(&mut self, point: &Point) -> std::io::Result<()> {
        self.write_json(point)?;
        self.write_csv(point)?;
        self.flush()
    }

    fn write_json(&mut self, point: &Point) -> std::io::Result<()> {
        let Some(out) = &mut self.json else { return Ok(()) };
        json::write(out, point)
    }

    fn write_csv(&mut self, point: &Point) -> std::io::Result<()> {
        let Some(out) = &mut self.csv else { return Ok(()) };
        csv::write(out, point)
    }

    /// Draws the scene, of which there is one where a picture is asked for.
    pub fn draw(&mut self, title: &str, points: &[Point]) -> std::io::Result<()> {
        let Some(mut out) = self.svg.take() else { return Ok(()) };
        out.write_all(svg(title, points).as_bytes())?;
        out.commit()
    }
}

/// Refuses two outputs in one place, one over a scene, and one picture of several scenes.
fn check(files: &[(&str, &Path)], scenes: &[Setup]) -> anyhow::Result<()> {
    for (index, (option, file)) in files.iter().enumerate() {
        if let Some((other, _)) = files[..index].iter().find(|(_, other)| is_same(other, file)) {
            anyhow::bail!("{other} and {option} cannot both go to the same place: give one of them another file name");
        }
        scenes.iter().try_for_each(|scene| spare_scene(option, file, scene))?;
        if *option == "--svg" && scenes.len() > 1 {
            anyhow::bail!("--svg draws one scene, and {} are named: name one, or leave it out", scenes.len());
        }
        if *option == "--resume" && is_stdout(file) {
            anyhow::bail!("--resume goes on with a file, not with standard output: name the file");
        }
    }
    Ok(())
}

/// The points in a file, and its whole lines.
fn read(file: &Path) -> anyhow::Result<(Vec<Point>, Vec<u8>)> {
    let name = named(file);
    let advice = |error: &Unreadable| match error {
        Unreadable::System(error) if error.kind() == ErrorKind::NotFound => {
            format!("; measure into it with --json {name} first")
        }
        _ => String::new(),
    };
    let bytes = read_bounded(file, LARGEST)
        .map_err(|error| anyhow::anyhow!("cannot resume from {name}: {error}{}", advice(&error)))?;
    let mut text = String::from_utf8(bytes).with_context(|| format!("cannot resume from {name}"))?;
    let (points, whole) = json::read(&text).with_context(|| format!("cannot resume from {name}"))?;
    text.truncate(whole);
    Ok((points, text.into_bytes()))
}
