//! `tautline run`: steps a scene without a window and writes what happens.

use super::numbers;
use super::output::{Output, is_same, is_stdout};
use crate::engine::{Divergence, Integrator, LinearSolver, Method, Solver, StepReport, Stepper, World};
use crate::measure::Measures;
use crate::scene;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use std::io::Write;
use std::sync::OnceLock;
use std::time::Instant;

/// Steps a scene without a window and writes trajectories and measures as CSV.
///
/// Rows are written at time 0 and then every `--every` seconds, each at the step nearest to that time (never twice at the
/// same step). All units are SI; numbers are written so that they are read back with the same bits.
#[derive(Debug, clap::Args)]
#[command(allow_negative_numbers = true)]
pub struct RunArguments {
    /// Name of a shipped scene, or path of a scene file
    scene: String,
    /// Simulated time [s]
    #[arg(long, default_value = "10", value_parser = numbers::seconds)]
    seconds: f64,
    /// Time between rows [s], such as 0.1 or 1/60; every step if not given
    #[arg(long, value_parser = numbers::interval)]
    every: Option<f64>,
    /// Write time,id,x,y,angle,vx,vy,omega of every body to a file, or to standard output with `-`
    #[arg(long, value_name = "FILE")]
    csv: Option<String>,
    /// Write energies, momenta, violation, penetration, contacts and the mean time of a step to a file, or `-`
    #[arg(long, value_name = "FILE")]
    measures: Option<String>,
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

    /// Whether an option says how the integration is to be done.
    fn by_hand(&self) -> bool {
        self.integrator.is_some() || self.solver.is_some()
    }

    /// The options that name a file to write, with that name.
    fn outputs(&self) -> impl Iterator<Item = (&'static str, &str)> {
        let named = [("--csv", self.csv.as_deref()), ("--measures", self.measures.as_deref())];
        named.into_iter().filter_map(|(option, file)| Some((option, file?)))
    }

    /// Refuses to write two tables into one file, or one over the scene.
    fn check_outputs(&self) -> anyhow::Result<()> {
        if self.csv.as_deref().zip(self.measures.as_deref()).is_some_and(|(csv, measures)| is_same(csv, measures)) {
            anyhow::bail!("--csv and --measures cannot both go to the same place: give one of them another file name");
        }
        let is_scene = |file| scene::find_shipped(&self.scene).is_none() && is_same(file, &self.scene);
        if let Some((option, _)) = self.outputs().find(|(_, file)| is_scene(file)) {
            anyhow::bail!("{option} would overwrite the scene {}: give it another file name", self.scene);
        }
        Ok(())
    }

    /// Where the hash and the summary go: not between rows of CSV.
    fn says(&self, line: &str) -> std::io::Result<()> {
        let rows_on_stdout = self.outputs().any(|(_, file)| is_stdout(file));
        if rows_on_stdout { writeln!(std::io::stderr(), "{line}") } else { Output::stdout().line(line) }
    }
}

pub(super) fn execute(arguments: &RunArguments) -> anyhow::Result<()> {
    let setup = scene::open(&arguments.scene)?;
    arguments.check_outputs()?;
    let method = arguments.method(setup.method);
    let sampling = Sampling { seconds: arguments.seconds, every: arguments.every.unwrap_or(method.step_seconds()) };
    let mut trajectory = arguments.csv.as_deref().map(Output::create).transpose()?;
    let mut measures = arguments.measures.as_deref().map(Output::create).transpose()?;
    let mut rows = Rows {
        trajectory: trajectory.as_mut().map(|output| output as &mut dyn Write),
        measures: measures.as_mut().map(|output| output as &mut dyn Write),
    };
    let started = Instant::now();
    let finish = run(setup.world, method, sampling, &mut rows)?;
    let spent = started.elapsed().as_secs_f64();
    [trajectory, measures].into_iter().flatten().try_for_each(|mut output| output.flush())?;
    if let Some(divergence) = finish.divergence {
        anyhow::bail!("after {} s: {divergence}", finish.world.time());
    }
    let (steps, time) = (finish.steps, finish.world.time());
    arguments.says(&format!("{}: {steps} steps, {time:.3} s simulated in {spent:.3} s", arguments.scene))?;
    if arguments.hash {
        arguments.says(&format!("{:016x}", finish.world.hash()))?;
    }
    Ok(())
}

/// How long to run and when to write [s].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    pub seconds: f64,
    pub every: f64,
}

impl Sampling {
    /// The step nearest to sample `index`, at `hz` steps a second.
    fn step_of(&self, index: u64, hz: f64) -> u64 {
        (index as f64 * self.every * hz).round() as u64
    }
}

/// What a run ended with.
#[derive(Clone, Debug)]
pub struct Finish {
    /// The last good state.
    pub world: World,
    pub steps: u64,
    /// Set if the run ended early.
    pub divergence: Option<Divergence>,
}

/// Steps `world` for `sampling.seconds` and writes rows on the way. Stops early, rows flushed by the caller, on divergence.
pub fn run(mut world: World, method: Method, sampling: Sampling, rows: &mut Rows) -> anyhow::Result<Finish> {
    let mut stepper = Stepper::new(method)?.with_clock(nanoseconds);
    // There are no rows between steps, and a step may hold a billion samples.
    let sampling = Sampling { every: sampling.every.max(method.step_seconds()), ..sampling };
    let last = (sampling.seconds * method.hz).round() as u64;
    rows.headers()?;
    rows.write(&world, Since::default())?;
    let mut sample = 1;
    let mut since_row = Sums::default();
    for step in 1..=last {
        let report = stepper.step(&mut world);
        if let Some(divergence) = report.divergence {
            return Ok(Finish { world, steps: step - 1, divergence: Some(divergence) });
        }
        since_row.add(&report);
        if step >= sampling.step_of(sample, method.hz) {
            rows.write(&world, since_row.take())?;
            while sampling.step_of(sample, method.hz) <= step {
                sample += 1;
            }
        }
    }
    Ok(Finish { world, steps: last, divergence: None })
}

/// What the steps since the row before tell.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Since {
    /// Mean time of a step [µs].
    step_us: f64,
    /// Largest estimate of a step's local error, in parts of an island's size.
    local_error: f64,
}

#[derive(Default)]
struct Sums {
    step_us: f64,
    steps: f64,
    local_error: f64,
}

impl Sums {
    fn add(&mut self, report: &StepReport) {
        self.step_us += report.step_us;
        self.steps += 1.0;
        self.local_error = self.local_error.max(report.local_error);
    }

    fn take(&mut self) -> Since {
        let Sums { step_us, steps, local_error } = std::mem::take(self);
        Since { step_us: step_us / steps, local_error }
    }
}

/// Where the rows go.
pub struct Rows<'a> {
    /// A row a body: `time,id,x,y,angle,vx,vy,omega`.
    pub trajectory: Option<&'a mut dyn Write>,
    /// A row an instant: energies, momenta, violation, penetration, contacts, time of a step and its local error.
    pub measures: Option<&'a mut dyn Write>,
}

impl Rows<'_> {
    fn headers(&mut self) -> std::io::Result<()> {
        if let Some(out) = &mut self.trajectory {
            writeln!(out, "time,id,x,y,angle,vx,vy,omega")?;
        }
        if let Some(out) = &mut self.measures {
            write!(out, "time,kinetic,potential,elastic,momentum_x,momentum_y,angular_momentum,")?;
            writeln!(out, "violation_max,penetration_max,contacts,step_us,local_error")?;
        }
        Ok(())
    }

    /// One instant. `{:?}` writes the fewest digits that are read back to the same bits.
    fn write(&mut self, world: &World, since: Since) -> std::io::Result<()> {
        if let Some(out) = &mut self.trajectory {
            for (id, body) in world.bodies().iter() {
                let (p, v, spin) = (body.position, body.velocity, body.spin.unwrap_or_default());
                let (time, angle, omega) = (world.time(), spin.angle, spin.omega);
                writeln!(out, "{time:?},{id},{:?},{:?},{angle:?},{:?},{:?},{omega:?}", p.x, p.y, v.x, v.y)?;
            }
        }
        if let Some(out) = &mut self.measures {
            let m = Measures::of(world);
            let (time, momentum, contacts) = (m.time, m.momentum, m.contacts);
            write!(out, "{time:?},{:?},{:?},{:?},", m.kinetic, m.potential, m.elastic)?;
            write!(out, "{:?},{:?},{:?},", momentum.x, momentum.y, m.angular_momentum)?;
            let Since { step_us, local_error } = since;
            writeln!(out, "{:?},{:?},{contacts},{step_us:?},{local_error:?}", m.violation_max, m.penetration_max)?;
        }
        Ok(())
    }
}

/// Nanoseconds since the first call.
fn nanoseconds() -> u64 {
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed().as_nanos() as u64
}
