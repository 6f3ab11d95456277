//! The lab beside the simulation: a sweep over every method on the open scene, in a thread of its own.

use super::companion::Waker;
use crate::engine::{Method, World};
use crate::lab::report::{csv, json, svg};
use crate::lab::{Outcome, Point, Progress, Reference, Skip, Sweep, SweepOptions, refine, scene_length};
use crate::scene::{self, SceneError, Setup};
use crate::text::named;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Time for the reference of a scene whose motion is not known.
const REFINING: Duration = Duration::from_secs(3);
/// Compared over so long where a scene does not say [s].
const SECONDS: f64 = 3.0;

/// What a user asks of the lab.
#[derive(Clone, Debug, PartialEq)]
pub enum LabOrder {
    /// Measures the open scene anew: as it was opened if nothing but the method was changed since, or else as it stands.
    Start,
    /// Ends the measuring after the step at hand; what was measured stays.
    Stop,
    /// Goes on where it was stopped.
    Resume,
    /// Writes what was measured; the ending of the name says as what: csv, jsonl or svg.
    Export(PathBuf),
}

/// What the lab is doing.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Stage {
    /// Nothing was asked for.
    #[default]
    Idle,
    /// The reference is computed: so many runs are done, and this part of the next.
    Refining {
        /// Runs that are done.
        runs: u32,
        /// Part of the next run that is done, 0 … 1.
        part: f64,
    },
    /// Settings are tried one after another.
    Measuring,
    /// It was stopped by the user and can be resumed.
    Stopped,
    /// All settings are tried, or the time for them is spent.
    Finished,
    /// It ended, and why.
    Failed(String),
}

/// Where the lab stands.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LabReport {
    /// Name of the scene that is measured.
    pub scene: String,
    /// The scene's heading, as the diagram has it.
    pub title: String,
    /// Simulated time that is compared over [s].
    pub seconds: f64,
    /// What is going on.
    pub stage: Stage,
    /// How many settings are done; `None` before the first is tried.
    pub progress: Option<Progress>,
    /// What errors are measured against, or why there are none.
    pub reference: String,
    /// What was measured, in the order in which it was.
    pub points: Arc<Vec<Point>>,
    /// Settings that take too long to be measured.
    pub slow: usize,
    /// The file that was written last.
    pub saved: Option<String>,
}

/// What the thread and the window share.
#[derive(Debug, Default)]
struct Bench {
    report: Mutex<Arc<LabReport>>,
    /// The sweep while nobody is at it.
    sweep: Mutex<Option<Sweep>>,
    cancel: AtomicBool,
}

impl Bench {
    fn report(&self) -> Arc<LabReport> {
        self.report.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    fn change(&self, change: impl FnOnce(&mut LabReport)) {
        change(Arc::make_mut(&mut self.report.lock().unwrap_or_else(PoisonError::into_inner)));
    }
}

/// The lab as a frame knows it. Cheap to clone; two are equal if they are the same one.
#[derive(Clone, Debug, Default)]
pub struct Lab(Arc<Bench>);

impl Lab {
    /// A lab that reports just this, for pictures of the panel.
    pub fn fixed(report: LabReport) -> Lab {
        let lab = Lab::default();
        lab.0.change(|now| *now = report);
        lab
    }

    /// Where it stands.
    pub fn report(&self) -> Arc<LabReport> {
        self.0.report()
    }
}

/// What is to be measured.
pub(super) struct Job {
    pub setup: Arc<Setup>,
    /// The world as it stands, if it is not the scene's own any more.
    pub touched: Option<World>,
    pub method: Method,
}

/// The lab from the simulation's side. Ends its thread, after the step at hand, when it is dropped.
#[derive(Default)]
pub(super) struct Laboratory {
    bench: Arc<Bench>,
}

impl Drop for Laboratory {
    fn drop(&mut self) {
        self.bench.cancel.store(true, Ordering::Relaxed);
    }
}

impl Laboratory {
    pub fn lab(&self) -> Lab {
        Lab(self.bench.clone())
    }

    /// Measures `job` from the beginning; what was measured before is forgotten.
    pub fn start(&mut self, job: Job, waker: &Waker) -> std::io::Result<()> {
        self.bench.cancel.store(true, Ordering::Relaxed);
        self.bench = Arc::default();
        let bench = self.bench.clone();
        let seconds = job.setup.truth.filter(|_| job.touched.is_none()).map_or(SECONDS, |truth| truth.seconds);
        bench.change(|report| {
            report.scene = job.setup.name.clone();
            report.title = job.setup.title.clone();
            report.seconds = seconds;
            report.stage = Stage::Refining { runs: 0, part: 0.0 };
        });
        spawn(bench, waker(), move |bench, wake| {
            let reference = reference(&job, seconds, bench, wake);
            let world = job.touched.as_ref().unwrap_or(&job.setup.world);
            let options = SweepOptions::default();
            let name = &job.setup.name;
            let mut sweep = Sweep::new(name, world, job.method, seconds, reference.map(Arc::new), options);
            // A sweep without the errors that were asked for would be of no use later.
            if bench.cancel.load(Ordering::Relaxed) {
                return (None, Stage::Idle);
            }
            let stage = measure(&mut sweep, bench, wake);
            (Some(sweep), stage)
        })
    }

    /// Ends the measuring after the step at hand.
    pub fn stop(&self) {
        self.bench.cancel.store(true, Ordering::Relaxed);
    }

    /// Goes on where it was stopped, if it was.
    pub fn resume(&self, waker: &Waker) -> std::io::Result<()> {
        let sweep = self.bench.sweep.lock().unwrap_or_else(PoisonError::into_inner).take();
        let Some(mut sweep) = sweep else { return Ok(()) };
        self.bench.cancel.store(false, Ordering::Relaxed);
        spawn(self.bench.clone(), waker(), move |bench, wake| {
            let stage = measure(&mut sweep, bench, wake);
            (Some(sweep), stage)
        })
    }

    /// Writes what was measured.
    pub fn export(&self, path: &Path) -> Result<(), SceneError> {
        let report = self.bench.report();
        scene::save_text(path, &written(&report, path))?;
        self.bench.change(|report| report.saved = Some(named(path)));
        Ok(())
    }
}

/// Points as the ending of `path` wants them; CSV if it says nothing.
fn written(report: &LabReport, path: &Path) -> String {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    let mut bytes = Vec::new();
    // Writing to memory cannot fail.
    match ending.as_deref() {
        Some("svg") => return svg::svg(&report.title, &report.points),
        Some("jsonl" | "json") => report.points.iter().for_each(|point| drop(json::write(&mut bytes, point))),
        _ => {
            bytes.extend_from_slice(csv::HEADER.as_bytes());
            bytes.push(b'\n');
            report.points.iter().for_each(|point| drop(csv::write(&mut bytes, point)));
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

type Wake = dyn Fn() + Send;

/// Does `work` in a thread and keeps its sweep. A panic ends it with a word.
fn spawn(
    bench: Arc<Bench>,
    wake: Box<Wake>,
    work: impl FnOnce(&Bench, &Wake) -> (Option<Sweep>, Stage) + Send + 'static,
) -> std::io::Result<()> {
    let thread = std::thread::Builder::new().name("lab".into());
    thread.spawn(move || {
        step_aside();
        match catch_unwind(AssertUnwindSafe(|| work(&bench, &*wake))) {
            Ok((sweep, stage)) => {
                // Before it is told, so that whoever hears that it has stopped can resume it.
                *bench.sweep.lock().unwrap_or_else(PoisonError::into_inner) = sweep;
                bench.change(|report| report.stage = stage);
            }
            Err(_) => bench.change(|report| {
                report.stage = Stage::Failed("a measurement failed, which is a defect of Tautline".into());
            }),
        }
        wake();
    })?;
    Ok(())
}

/// Lets everything else come first: measuring goes by the thread's own time, and can wait.
fn step_aside() {
    // On Linux it concerns the calling thread alone; elsewhere it would slow the whole program down.
    #[cfg(target_os = "linux")]
    if let Err(error) = rustix::process::nice(5) {
        log::info!("the lab keeps its priority: {error}");
    }
}

/// What the scene is compared with: what is known of it, or a refined run.
fn reference(job: &Job, seconds: f64, bench: &Bench, wake: &Wake) -> Option<Reference> {
    if job.touched.is_none()
        && let Some(known) = Reference::known(&job.setup).filter(|known| seconds < known.seconds() + 0.5 / 60.0)
    {
        bench.change(|report| report.reference = known.label());
        return Some(known);
    }
    let world = job.touched.as_ref().unwrap_or(&job.setup.world);
    let length = job.setup.truth.map_or_else(|| scene_length(world), |truth| truth.length);
    let mut tell = |level: crate::lab::LevelReport| {
        bench.change(|report| report.stage = Stage::Refining { runs: level.level, part: level.part });
        wake();
    };
    match refine(world, job.method, seconds, length, REFINING, &bench.cancel, &mut tell) {
        Ok(reference) => {
            bench.change(|report| report.reference = reference.label());
            Some(reference)
        }
        Err(none) => {
            bench.change(|report| report.reference = none.to_string());
            None
        }
    }
}

/// Measures setting after setting until all are done or it is stopped.
fn measure(sweep: &mut Sweep, bench: &Bench, wake: &Wake) -> Stage {
    loop {
        let progress = sweep.progress();
        bench.change(|report| {
            report.progress = Some(progress);
            report.stage = Stage::Measuring;
        });
        wake();
        let stage = match sweep.advance(&bench.cancel) {
            Outcome::Point(_) => {
                let points = Arc::new(sweep.points().to_vec());
                bench.change(|report| report.points = points);
                continue;
            }
            Outcome::Skipped(_, Skip::TooSlow) => {
                bench.change(|report| report.slow += 1);
                continue;
            }
            Outcome::Skipped(..) => continue,
            Outcome::Cancelled => Stage::Stopped,
            Outcome::Finished => Stage::Finished,
        };
        bench.change(|report| report.progress = Some(sweep.progress()));
        return stage;
    }
}
