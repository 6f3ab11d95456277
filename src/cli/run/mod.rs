//! `tautline run`: steps a scene without a window and writes what happens.

mod rows;
mod stepping;
mod watch;

use super::numbers;
use super::output::{Output, is_same, is_stdout, spare_scene};
use super::stop;
use crate::engine::{Integrator, LinearSolver, Method, Solver};
use crate::lab::scene_length;
use crate::measure::Growth;
use crate::scene::{self, Setup};
use crate::text::named;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use rows::Rows;
use std::ffi::OsString;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;
use stepping::{Sampling, run};
use watch::{Refined, Watch};

/// Steps a scene without a window and writes trajectories and measures as CSV.
///
/// Rows are written at time 0 and then every `--every` seconds, each at the step nearest to that time (never twice at the
/// same step). All units are SI; numbers are written so that they are read back with the same bits.
///
/// Columns of --measures: time; kinetic, potential (0 at the origin) and elastic energy [J]; momentum_x, momentum_y [kg·m/s];
/// angular_momentum about the origin [kg·m²/s]; violation_max and penetration_max, the worst of a rod, rope or pin and the
/// deepest overlap [m]; contacts; step_us, the mean time of a step since the row before [µs]; local_error, the largest estimate
/// of a step's error since then, in parts of an island's size, empty where an accuracy was wanted and a step went through the
/// substeps; violation_rms [m]; energy, the sum [J]; energy_drift, the energy
/// less that at the start, in parts of the largest kinetic energy plus the spread of the other energies so far;
/// error_rms and error_max, the distance from the exact motion over all bodies [m], and error_rms_percent and error_max_percent,
/// the same in percent of the length that the scene names; order, with --order; growth, by accuracy: by how much at most the motion
/// has let a disturbance at the start grow so far (folded chains, upright and double pendulums amplify errors, and no
/// accuracy of the steps can help that), up to where something goes through the substeps.
///
/// The error columns are empty where no exact motion is known: in scenes without a `truth` entry, after its seconds, and between
/// the samples of a truth, which are 1/60 s apart. The last line tells the error over all samples that the run has met.
///
/// A scene that opens by accuracy is run by hand where an option says how: --integrator, --solver, --substeps, --iterations,
/// --no-warm-start or --baumgarte without --accuracy.
///
/// Files appear when the run ends, whole, in place of old ones; Ctrl-C ends it early and keeps what there is.
#[derive(Debug, clap::Args)]
#[command(allow_negative_numbers = true)]
pub struct RunArguments {
    /// Name of a shipped scene, or path of a scene file
    scene: OsString,
    /// Simulated time [s]
    #[arg(long, default_value = "10", value_parser = numbers::seconds)]
    seconds: f64,
    /// Time between rows [s], such as 0.1 or 1/60; every step if not given
    #[arg(long, value_parser = numbers::interval)]
    every: Option<f64>,
    /// Write time,id,x,y,angle,vx,vy,omega of every body to a file, or to standard output with `-`
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write energies and their drift, momenta, violation, penetration, contacts, the mean time of a step and, where it is known,
    /// the error to a file, or `-`; the columns are explained above
    #[arg(long, value_name = "FILE")]
    measures: Option<PathBuf>,
    /// Steps a second, in place of the scene's
    #[arg(long, value_parser = numbers::hz)]
    hz: Option<f64>,
    /// Substeps a step, in place of the scene's
    #[arg(long, value_parser = numbers::substeps)]
    substeps: Option<u32>,
    /// Solver sweeps a substep, in place of the scene's
    #[arg(long, value_parser = numbers::iterations)]
    iterations: Option<u32>,
    /// How positions and velocities are carried on, in place of the scene's way
    #[arg(long, value_parser = integrator())]
    integrator: Option<Integrator>,
    /// How constraints and contacts are solved, in place of the scene's way
    #[arg(long, value_parser = solver())]
    solver: Option<Solver>,
    /// Wanted accuracy, 1e-14 to 0.1: error after a second or so, in parts of the scene's size; the plan chooses the rest
    #[arg(long, value_name = "TOL", value_parser = numbers::accuracy)]
    accuracy: Option<f64>,
    /// What solves the rows of islands that are carried whole; those that sweep take --iterations sweeps at most
    #[arg(long, value_parser = linear())]
    linear: Option<LinearSolver>,
    /// Start every solve from zero instead of the last multipliers
    #[arg(long)]
    no_warm_start: bool,
    /// Part of the position error that PGS feeds back in a substep, 0 to 1
    #[arg(long, value_parser = numbers::baumgarte)]
    baumgarte: Option<f64>,
    /// Repeat the run with twice the substeps (and with four times where no exact motion is known) beside it, and write the order
    /// of convergence that the errors so far show: log2 of their ratio
    #[arg(long)]
    order: bool,
    /// Print a hash over the bits of the last state: equal runs, equal hashes
    #[arg(long)]
    hash: bool,
}

fn integrator() -> impl TypedValueParser<Value = Integrator> {
    let named = |key: String| Integrator::ALL.into_iter().find(|integrator| integrator.key() == key);
    PossibleValuesParser::new(Integrator::ALL.map(Integrator::key)).map(move |key| named(key).unwrap_or_default())
}

fn linear() -> impl TypedValueParser<Value = LinearSolver> {
    let named = |key: String| LinearSolver::ALL.into_iter().find(|solver| solver.key() == key);
    PossibleValuesParser::new(LinearSolver::ALL.map(LinearSolver::key)).map(move |key| named(key).unwrap_or_default())
}

fn solver() -> impl TypedValueParser<Value = Solver> {
    PossibleValuesParser::new(["projection", "pgs"])
        .map(|name| if name == "projection" { Solver::Projection } else { Solver::Pgs })
}

impl RunArguments {
    fn method(&self, scene: Method) -> Method {
        Method {
            hz: self.hz.unwrap_or(scene.hz),
            substeps: self.substeps.unwrap_or(scene.substeps),
            iterations: self.iterations.unwrap_or(scene.iterations),
            integrator: self.integrator.unwrap_or(scene.integrator),
            solver: self.solver.unwrap_or(scene.solver),
            linear: self.linear.unwrap_or(scene.linear),
            warm_start: scene.warm_start && !self.no_warm_start,
            baumgarte: self.baumgarte.unwrap_or(scene.baumgarte),
            automatic: self.accuracy.is_some() && self.integrator.is_none() || scene.automatic && !self.by_hand(),
            accuracy: self.accuracy.unwrap_or(scene.accuracy),
        }
    }

    /// An option that changes nothing beside the others, if there is one.
    fn without_effect(&self, method: &Method) -> Option<String> {
        let integrator = method.integrator.name();
        if self.accuracy.is_some() && !method.automatic && method.integrator != Integrator::Taylor {
            return Some(format!(
                "--accuracy has no effect beside --integrator: {integrator} takes the steps that it is given"
            ));
        }
        (self.linear.is_some() && !method.automatic && !method.integrator.is_direct()).then(|| {
            format!(
                "--linear has no effect: {integrator} carries no island whole; give --accuracy, or another --integrator"
            )
        })
    }

    /// Whether an option says how the integration is to be done. Beside --linear, --iterations are those of the linear solver.
    fn by_hand(&self) -> bool {
        let sweeps = self.iterations.is_some() && self.linear.is_none();
        let substeps = self.substeps.is_some() || self.no_warm_start || self.baumgarte.is_some();
        self.integrator.is_some() || self.solver.is_some() || substeps || sweeps
    }

    /// The options that name a file to write, with that name.
    fn outputs(&self) -> impl Iterator<Item = (&'static str, &Path)> {
        let named = [("--csv", self.csv.as_deref()), ("--measures", self.measures.as_deref())];
        named.into_iter().filter_map(|(option, file)| Some((option, file?)))
    }

    /// Refuses to write two tables into one file, or one over the scene.
    fn check_outputs(&self, setup: &Setup) -> anyhow::Result<()> {
        if self.csv.as_deref().zip(self.measures.as_deref()).is_some_and(|(csv, measures)| is_same(csv, measures)) {
            anyhow::bail!("--csv and --measures cannot both go to the same place: give one of them another file name");
        }
        self.outputs().try_for_each(|(option, file)| spare_scene(option, file, setup))
    }

    /// Where the hash and the summary go: not between rows of CSV.
    fn says(&self, line: &str) -> std::io::Result<()> {
        let rows_on_stdout = self.outputs().any(|(_, file)| is_stdout(file));
        if rows_on_stdout { writeln!(std::io::stderr(), "{line}") } else { Output::stdout().line(line) }
    }
}

pub(super) fn execute(arguments: &RunArguments) -> anyhow::Result<ExitCode> {
    let setup = scene::open(&arguments.scene)?;
    arguments.check_outputs(&setup)?;
    let method = arguments.method(setup.method);
    if let Some(note) = arguments.without_effect(&method) {
        writeln!(std::io::stderr(), "note: {note}")?;
    }
    let sampling = Sampling { seconds: arguments.seconds, every: arguments.every.unwrap_or(method.step_seconds()) };
    let exact = setup.known_motion();
    let refined =
        if arguments.order { Refined::new(&setup.world, method, exact.is_none())? } else { Refined::default() };
    let mut trajectory = arguments.csv.as_deref().map(Output::create).transpose()?;
    let mut measures = arguments.measures.as_deref().map(Output::create).transpose()?;
    let mut rows = Rows {
        trajectory: trajectory.as_mut().map(|output| output as &mut dyn Write),
        measures: measures.as_mut().map(|output| output as &mut dyn Write),
    };
    let length = setup.truth.map_or_else(|| scene_length(&setup.world), |truth| truth.length);
    let growth = method.automatic.then(|| Growth::new(&setup.world, &method, length)).transpose()?;
    let mut watch = Watch::new(&setup.world, exact, refined, growth);
    stop::listen();
    let started = Instant::now();
    let finish = run(setup.world, method, sampling, &mut rows, &mut watch)?;
    let spent = started.elapsed().saturating_sub(watch.beside).as_secs_f64();
    // What a run has is kept, however it ended.
    [trajectory, measures].into_iter().flatten().try_for_each(Output::commit)?;
    if let Some(divergence) = finish.divergence {
        anyhow::bail!("after {} s: {divergence}", finish.world.time());
    }
    let (steps, time) = (finish.steps, finish.world.time());
    let stopped = if finish.stopped { "stopped early, with what there was written; " } else { "" };
    let found = watch.summary() + &finish.lapses.summary(steps);
    let name = named(&arguments.scene);
    arguments.says(&format!("{name}: {stopped}{steps} steps, {time:.3} s simulated in {spent:.3} s{found}"))?;
    if arguments.hash {
        arguments.says(&format!("{:016x}", finish.world.hash()))?;
    }
    Ok(if finish.stopped { stop::code() } else { ExitCode::SUCCESS })
}
