//! The files that points go to while they are measured.

use super::LabArguments;
use crate::cli::output::{Output, is_same, is_stdout};
use crate::lab::Point;
use crate::lab::report::{csv, json, svg::svg};
use crate::scene::find_shipped;
use anyhow::Context;
use std::io::{ErrorKind, Write};

/// What is written, point after point; every point is on disk before the next is measured.
pub(super) struct Outputs {
    json: Option<Output>,
    csv: Option<Output>,
    /// The name: it is written whole at the end of a scene.
    svg: Option<Output>,
    resumed: Vec<Point>,
    /// Whether the lines of `json` hold the resumed points already.
    appends: bool,
    pub points_on_stdout: bool,
}

impl Outputs {
    /// Opens all files, after a look at whether they get in each other's way or the scenes'.
    pub fn open(arguments: &LabArguments, scenes: &[&str]) -> anyhow::Result<Outputs> {
        let LabArguments { json, csv, svg, resume, .. } = arguments;
        // The same file for both goes on with it.
        let appends = match (json, resume) {
            (Some(json), Some(resume)) => is_same(json, resume),
            (None, Some(_)) => true,
            _ => false,
        };
        let named = [
            ("--resume", resume.as_deref()),
            ("--json", json.as_deref().filter(|_| !appends)),
            ("--csv", csv.as_deref()),
            ("--svg", svg.as_deref()),
        ];
        let named: Vec<(&str, &str)> = named.into_iter().filter_map(|(option, file)| Some((option, file?))).collect();
        check(&named, scenes)?;
        let (resumed, whole) = resume.as_deref().map(read).transpose()?.unwrap_or_default();
        if let Some(stray) = resumed.iter().find(|point| !scenes.contains(&point.scene.as_str())) {
            let file = resume.as_deref().unwrap_or_default();
            anyhow::bail!("{file} has points of {}: name that scene too, or another file", stray.scene);
        }
        let json = match (json, resume) {
            (_, Some(file)) if appends => Some(Output::append(file, whole)?),
            (json, _) => json.as_deref().map(Output::create).transpose()?,
        };
        let mut csv = csv.as_deref().map(Output::create).transpose()?;
        if let Some(out) = &mut csv {
            writeln!(out, "{}", csv::HEADER)?;
            out.flush()?;
        }
        let svg = svg.as_deref().map(Output::create).transpose()?;
        let points_on_stdout = named.iter().any(|(_, file)| is_stdout(file));
        Ok(Outputs { json, csv, svg, resumed, appends, points_on_stdout })
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
        Ok(points)
    }

    pub fn write(&mut self, point: &Point) -> std::io::Result<()> {
        self.write_json(point)?;
        self.write_csv(point)
    }

    fn write_json(&mut self, point: &Point) -> std::io::Result<()> {
        let Some(out) = &mut self.json else { return Ok(()) };
        json::write(out, point)?;
        out.flush()
    }

    fn write_csv(&mut self, point: &Point) -> std::io::Result<()> {
        let Some(out) = &mut self.csv else { return Ok(()) };
        csv::write(out, point)?;
        out.flush()
    }

    /// Draws the scene.
    pub fn draw(&mut self, title: &str, points: &[Point]) -> std::io::Result<()> {
        let Some(out) = &mut self.svg else { return Ok(()) };
        out.write_all(svg(title, points).as_bytes())?;
        out.flush()
    }
}

/// Refuses two outputs in one place, one over a scene, and one picture of several scenes.
fn check(named: &[(&str, &str)], scenes: &[&str]) -> anyhow::Result<()> {
    for (index, (option, file)) in named.iter().enumerate() {
        if let Some((other, _)) = named[..index].iter().find(|(_, other)| is_same(other, file)) {
            anyhow::bail!("{other} and {option} cannot both go to the same place: give one of them another file name");
        }
        if let Some(scene) = scenes.iter().find(|scene| find_shipped(scene).is_none() && is_same(file, scene)) {
            anyhow::bail!("{option} would overwrite the scene {scene}: give it another file name");
        }
        if *option == "--svg" && scenes.len() > 1 {
            anyhow::bail!("--svg draws one scene, and {} are named: name one, or leave it out", scenes.len());
        }
        if *option == "--resume" && is_stdout(file) {
            anyhow::bail!("--resume goes on with a file, not with standard output: name the file");
        }
    }
    Ok(())
}

/// The points in a file, and how many of its bytes are whole lines.
fn read(file: &str) -> anyhow::Result<(Vec<Point>, u64)> {
    let advice = |error: &std::io::Error| match error.kind() {
        ErrorKind::NotFound => format!("; measure into it with --json {file} first"),
        _ => String::new(),
    };
    let text = std::fs::read_to_string(file)
        .map_err(|error| anyhow::anyhow!("cannot resume from {file}: {error}{}", advice(&error)))?;
    let (points, whole) = json::read(&text).with_context(|| format!("cannot resume from {file}"))?;
    Ok((points, whole as u64))
}
