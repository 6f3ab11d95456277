//! `tautline lab`: measures speed against error.

mod docs;
mod outputs;
mod progress;

use super::numbers;
use super::output::Output;
use super::stop;
use crate::lab::report::{page::scenes, table::table, text::diagram};
use crate::lab::{Family, Front, Outcome, Point, Reference, Setting, Skip, Sweep, SweepOptions, refine, scene_length};
use crate::scene::{self, Setup};
use crate::text::{escaped, named};
use outputs::Outputs;
use progress::{ProgressLine, spoken};
use std::ffi::{OsStr, OsString};
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Compared over so long where a scene does not say [s].
const SECONDS: f64 = 3.0;

/// Measures speed against error: every method over its own knobs, on each of the scenes.
///
/// Prints the front (what no other setting beats in both error and cost) as a table, and all points as a diagram. Error is
/// the RMS distance to the reference over all bodies and samples, in parts of the scene's length: to the exact motion where the
/// program has it, otherwise to the most accurate method, refined until two runs agree. Cost is CPU time of stepping alone per
/// simulated second, median of at least five runs.
///
/// Ctrl-C ends it and leaves what is measured in the files; --resume goes on from there.
#[derive(Debug, clap::Args)]
#[command(allow_negative_numbers = true)]
#[command(group(clap::ArgGroup::new("what").required(true).multiple(false).args(["scenes", "truth", "all"])))]
pub struct LabArguments {
    /// Names of shipped scenes, or paths of scene files
    #[arg(value_name = "SCENE")]
    scenes: Vec<OsString>,
    /// All scenes whose exact motion is known: it is stored in the program, or has a formula
    #[arg(long)]
    truth: bool,
    /// All shipped scenes
    #[arg(long)]
    all: bool,
    /// Write every point as a line of JSON to a file, or to standard output with `-`
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write every point as a row of CSV to a file, or `-`
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Draw the diagram of a single scene into an SVG file, or `-`
    #[arg(long, value_name = "FILE", value_parser = numbers::svg())]
    svg: Option<PathBuf>,
    /// Go on with the lines of JSON in a file that was written before, with the same options: they are not measured again, new
    /// ones are added
    #[arg(long, value_name = "FILE")]
    resume: Option<PathBuf>,
    /// Simulated time to compare over [s]; if not given that of the scene's exact motion, or 3
    #[arg(long, value_parser = numbers::seconds)]
    seconds: Option<f64>,
    /// Only these methods, with commas between them; a wrong name lists all
    #[arg(long, value_name = "METHODS", value_delimiter = ',', value_parser = numbers::family)]
    methods: Vec<Family>,
    /// Step rates, with commas between them [Hz]; if not given 60, and a few settings at 30 and 240
    #[arg(long, value_name = "RATES", value_delimiter = ',', value_parser = numbers::rate)]
    hz: Vec<f64>,
    /// Time for the sweep of a scene [s]: what does not fit is left out, the most telling settings come first
    #[arg(long, value_name = "SECONDS", default_value = "15", value_parser = numbers::budget)]
    budget: Duration,
    /// Longest run of a setting [s]: what takes longer is left out
    #[arg(long, value_name = "SECONDS", default_value = "0.3", value_parser = numbers::budget)]
    longest: Duration,
    /// Time for the reference of a scene without an exact motion [s]
    #[arg(long, value_name = "SECONDS", default_value = "2", value_parser = numbers::budget)]
    refine: Duration,
    /// Timed runs of a setting, 5 at least
    #[arg(long, default_value = "5", value_parser = numbers::runs)]
    runs: usize,
    /// Write data, diagrams and the page about accuracy into this folder; in the sources that is docs. Goes with --truth
    #[arg(
        long,
        value_name = "FOLDER",
        conflicts_with_all = ["scenes", "all", "json", "csv", "svg", "resume", "seconds", "methods", "hz"]
    )]
    docs: Option<PathBuf>,
    /// With --docs: measure nothing, draw what the data in the folder give
    #[arg(long, requires = "docs")]
    redraw: bool,
}

impl LabArguments {
    /// The scenes asked for, each once.
    fn names(&self) -> Vec<&OsStr> {
        let shipped = if self.all { scene::every_scene().to_vec() } else { scenes() };
        let mut names: Vec<&OsStr> = Vec::new();
        if self.scenes.is_empty() {
            names.extend(shipped.iter().map(|scene| OsStr::new(scene.name)))
        } else {
            names.extend(self.scenes.iter().map(OsString::as_os_str))
        }
        let mut seen = Vec::new();
        names.retain(|name| {
            !seen.contains(name) && {
                seen.push(*name);
                true
            }
        });
        names
    }

    fn options(&self) -> SweepOptions {
        let families = if self.methods.is_empty() { Family::ALL.to_vec() } else { self.methods.clone() };
        SweepOptions { families, rates: self.hz.clone(), run_limit: self.longest, budget: self.budget, runs: self.runs }
    }

    /// Time to compare over [s].
    fn seconds(&self, setup: &Setup) -> f64 {
        self.seconds.or(setup.truth.map(|truth| truth.seconds)).unwrap_or(SECONDS)
    }
}

pub(super) fn execute(arguments: &LabArguments) -> anyhow::Result<ExitCode> {
    if let Some(folder) = arguments.docs.as_deref().filter(|_| arguments.redraw) {
        docs::draw(folder)?;
        return Ok(ExitCode::SUCCESS);
    }
    let names = arguments.names();
    // Before minutes are spent: every scene must open, and every file.
    let setups = names.iter().map(scene::open).collect::<Result<Vec<Setup>, _>>()?;
    if let Some(folder) = &arguments.docs {
        docs::check(folder)?;
    }
    let mut outputs = Outputs::open(arguments, &setups)?;
    stop::listen();
    let begun = Instant::now();
    for (index, setup) in setups.iter().enumerate() {
        let place = Place { name: &setup.name, index, count: setups.len(), begun, budget: arguments.budget };
        let points = measure(arguments, setup, &place, &mut outputs)?;
        if let Some(folder) = arguments.docs.as_deref().filter(|_| !stop::asked()) {
            docs::keep(folder, &setup.name, &points)?;
        }
        if stop::asked() {
            let told = outputs.points_on_stdout;
            outputs.finish()?;
            say(
                told,
                "stopped: what was measured is in the files that were asked for; --resume goes on from a file of --json",
            )?;
            return Ok(stop::code());
        }
    }
    outputs.finish()?;
    if let Some(folder) = &arguments.docs {
        docs::keep_machine(folder)?;
        docs::draw(folder)?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Where in the list a scene stands.
struct Place<'a> {
    name: &'a str,
    index: usize,
    count: usize,
    begun: Instant,
    budget: Duration,
}

impl Place<'_> {
    /// What is left of a scene, and of those after it if they take what those before did.
    fn left(&self, seconds: f64) -> String {
        let scene = spoken(seconds);
        if self.index + 1 == self.count {
            return format!("{scene} left");
        }
        let mean = match self.index {
            0 => self.budget.as_secs_f64(),
            before => self.begun.elapsed().as_secs_f64() / (before + 1) as f64,
        };
        let all = seconds + mean * (self.count - self.index - 1) as f64;
        format!("{scene} left, {} in all", spoken(all))
    }
}

impl std::fmt::Display for Place<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} ({} of {})", escaped(self.name), self.index + 1, self.count)
    }
}

/// Measures one scene and prints what comes out.
fn measure(
    arguments: &LabArguments,
    setup: &Setup,
    place: &Place,
    outputs: &mut Outputs,
) -> anyhow::Result<Vec<Point>> {
    let mut line = ProgressLine::new();
    let (reference, label) = reference(arguments, setup, place, &mut line);
    let seconds = arguments.seconds(setup);
    let mut sweep =
        Sweep::new(&setup.name, &setup.world, setup.method, seconds, reference.map(Arc::new), arguments.options());
    sweep.resume(outputs.resumed(&setup.name)?);
    let mut slow = 0;
    loop {
        let progress = sweep.progress();
        line.tell(|| {
            let left = place.left(progress.seconds_left);
            format!("{place}: {} of {} settings, {left}", progress.done, progress.total)
        });
        match sweep.advance(&stop::ASKED) {
            Outcome::Point(point) => outputs.write(&point)?,
            Outcome::Skipped(_, Skip::TooSlow) => slow += 1,
            Outcome::Skipped(..) => {}
            Outcome::Cancelled | Outcome::Finished => break,
        }
    }
    line.clear();
    outputs.draw(&setup.title, sweep.points())?;
    let skipped = if slow > 0 { format!("; {slow} settings are too slow to be measured") } else { String::new() };
    outputs.say(&format!("{}: {} points{skipped}; {label}", named(&setup.name), sweep.points().len()))?;
    outputs.say(&summary(sweep.points()))?;
    Ok(sweep.points().to_vec())
}

/// What the scene is compared with, and what that is called.
fn reference(
    arguments: &LabArguments,
    setup: &Setup,
    place: &Place,
    line: &mut ProgressLine,
) -> (Option<Reference>, String) {
    let seconds = arguments.seconds(setup);
    // Half a sample more or less does not make a motion unknown.
    if let Some(known) = Reference::known(setup).filter(|known| seconds < known.seconds() + 0.5 / 60.0) {
        let known = known.until(seconds);
        let label = known.label();
        return (Some(known), label);
    }
    let length = setup.truth.map_or_else(|| scene_length(&setup.world), |truth| truth.length);
    let found = refine(&setup.world, setup.method, seconds, length, arguments.refine, &stop::ASKED, &mut |report| {
        line.tell(|| format!("{place}: reference, run {}, {:.0} %", report.level + 1, 100.0 * report.part));
    });
    match found {
        Ok(reference) => {
            let label = format!("errors against a refined run, {}", reference.label());
            (Some(reference), label)
        }
        Err(none) => (None, none.to_string()),
    }
}

/// Table, diagram, and what follows from them.
fn summary(points: &[Point]) -> String {
    let front = Front::of(points);
    let mut text = table(points) + "\n" + &diagram(points);
    if !front.points().is_empty() {
        for wanted in [1e-3, 1e-6, 1e-9] {
            text += &format!("{}\n", front.advice_for_error(wanted));
        }
    }
    if let Some(gain) = front.gain(points, Setting::BASELINE) {
        text += &format!("{}\n", gain.sentence());
    }
    text
}

impl Outputs {
    /// Prints a text where it does not stand between points.
    fn say(&self, text: &str) -> std::io::Result<()> {
        say(self.points_on_stdout, text)
    }
}

/// On standard error where points are on standard output.
fn say(points_on_stdout: bool, text: &str) -> std::io::Result<()> {
    if points_on_stdout { writeln!(std::io::stderr(), "{text}") } else { Output::stdout().line(text) }
}
