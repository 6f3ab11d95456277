//! The simulation without its thread: the world, its stepper and its history, and what every command does to them.

use super::blank::{self, blank};
use super::command::{Command, Edit};
use super::companion::{Beginning, Extent, Input, Links, Report, Standing, Waker};
use super::edit;
use super::error::CommandError;
use super::frame::{Frame, SLOW, SceneInfo, Speed};
use super::history::{History, State};
use super::laboratory::{Job, LabOrder, Laboratory};
use super::plan_text::PlanText;
use super::plot_data::{Plots, Sample};
use super::trace::Trace;
use super::{pick, setting};
use crate::engine::{DVec2, EngineError, Grip, Id, Method, StepReport, Stepper, World};
use crate::file::is_same;
use crate::measure::Measures;
use crate::scene::{self, Setup};
use crate::text::named;
use crate::trial::Trial;
use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

/// Speeds that can be asked for [simulated seconds a second].
pub const SPEED_RANGE: [f64; 2] = [0.01, 10.0];

/// Changes of one setting that follow each other within this time are undone as one: they are the moves of one hand.
const SETTLING: Duration = Duration::from_secs(1);

/// Everything that the simulation thread owns.
pub(super) struct Simulation {
    world: World,
    stepper: Stepper,
    plan_text: PlanText,
    /// The scene as it was opened.
    start: Arc<Setup>,
    scene: Arc<SceneInfo>,
    history: History,
    /// The setting that the last command changed, and when.
    setting: Option<(&'static str, Instant)>,
    plots: Plots,
    trace: Trace,
    report: StepReport,
    measures: Measures,
    previous_position: Vec<DVec2>,
    previous_angle: Vec<f64>,
    running: bool,
    speed: f64,
    slow: bool,
    fault: Option<String>,
    /// What happened last that a user should know.
    note: Option<Arc<str>>,
    /// The file that the scene was last written to, until it is edited or left.
    saved: Option<String>,
    /// Reports written in this session, which may be written anew.
    exported: BTreeSet<PathBuf>,
    /// It was edited since it was opened or written to a file.
    edited: bool,
    /// The last entry of the history is of the slash at hand.
    slashed: bool,
    /// What the last edit made or changed.
    touched: Arc<Vec<Id>>,
    opened: u64,
    /// The last frame that was published: a whole state to go back to.
    published: Option<Arc<Frame>>,
    /// The worlds that follow this one.
    links: Links,
    /// The truth was asked for, also where it must be computed.
    ghost: bool,
    /// The exact motion of the scene from its start is known.
    known: bool,
    laboratory: Laboratory,
    waker: Waker,
    /// Nothing but the method was changed since the scene was opened.
    untouched: bool,
    trial: Option<Trial>,
}

impl Simulation {
    /// A simulation of `setup`; `waker` makes what its companions call when they have something new to show.
    pub(super) fn new(setup: Setup, waker: Waker) -> Simulation {
        let (stepper, fault) = stepper(setup.method);
        let start = Arc::new(setup);
        let mut simulation = Simulation {
            world: start.world.clone(),
            stepper,
            plan_text: PlanText::default(),
            scene: Arc::new(info(&start, 1)),
            history: History::default(),
            setting: None,
            plots: Plots::default(),
            trace: Trace::default(),
            report: StepReport::default(),
            measures: Measures::of(&start.world),
            previous_position: Vec::new(),
            previous_angle: Vec::new(),
            running: fault.is_none(),
            speed: 1.0,
            slow: false,
            fault,
            note: None,
            saved: None,
            exported: BTreeSet::new(),
            edited: false,
            slashed: false,
            touched: Arc::default(),
            opened: 1,
            published: None,
            links: Links::default(),
            ghost: false,
            known: start.known_motion().is_some(),
            laboratory: Laboratory::default(),
            waker,
            untouched: true,
            trial: Trial::of(&start),
            start,
        };
        if let Err(error) = simulation.follow_truth() {
            simulation.fault.get_or_insert_with(|| error.to_string());
        }
        simulation
    }

    pub(super) fn running(&self) -> bool {
        self.running
    }

    /// Speed to keep to at the moment [simulated seconds a second].
    pub(super) fn speed(&self) -> f64 {
        if self.slow { SLOW * self.speed } else { self.speed }
    }

    pub(super) fn time(&self) -> f64 {
        self.world.time()
    }

    /// Length of a step [s of simulated time].
    pub(super) fn step_seconds(&self) -> f64 {
        self.stepper.method().step_seconds()
    }

    /// A picture of it all.
    pub(super) fn publish(&mut self, sequence: u64, achieved: f64) -> Arc<Frame> {
        let frame = Arc::new(self.frame(sequence, achieved));
        self.published = Some(frame.clone());
        frame
    }

    fn frame(&mut self, sequence: u64, achieved: f64) -> Frame {
        Frame {
            sequence,
            published: Instant::now(),
            scene: self.scene.clone(),
            world: self.world.clone(),
            previous_position: self.previous_position.clone(),
            previous_angle: self.previous_angle.clone(),
            method: *self.stepper.method(),
            report: self.report.clone(),
            measures: self.measures,
            plots: self.plots.clone(),
            trace: self.trace.clone(),
            plan: self.plan_text.of(&mut self.stepper, &self.world),
            running: self.running,
            speed: Speed { wanted: self.speed, slow: self.slow, achieved },
            fault: self.fault.clone(),
            note: self.note.clone(),
            saved: self.saved.clone(),
            unsaved: self.edited.then(|| self.start.clone()),
            undo: self.history.undo_name().map(str::to_owned),
            redo: self.history.redo_name().map(str::to_owned),
            touched: self.touched.clone(),
            companions: self.links.companions(),
            lab: self.laboratory.lab(),
            trial: self.trial.as_ref().map(|trial| trial.verdict().clone()),
        }
    }

    /// Steps once. A run that diverges pauses at the last good state with a fault.
    pub(super) fn step(&mut self) {
        self.guard(Simulation::take_step);
    }

    fn take_step(&mut self) {
        self.remember_previous();
        let report = self.stepper.step(&mut self.world);
        if let Some(divergence) = &report.divergence {
            self.halt(divergence.to_string());
            self.trial.iter_mut().for_each(Trial::lost);
        } else {
            self.measures = Measures::of(&self.world);
            self.plots.push(Sample::new(self.measures, &report, self.stepper.method().automatic));
            self.trace.push(&self.world);
            self.links.step(&self.world);
            if let Some(trial) = &mut self.trial {
                trial.observe(&self.world, &self.measures, &report);
            }
        }
        self.report = report;
    }

    /// The one place where a panic is caught: a defect in a step or an edit must cost that step or edit, not the window and the
    /// user's work.
    fn guard(&mut self, act: impl FnOnce(&mut Simulation)) {
        if catch_unwind(AssertUnwindSafe(|| act(self))).is_err() {
            self.recover();
        }
    }

    /// After a panic the world may be half stepped: back to the state that was shown last.
    fn recover(&mut self) {
        let good = self.published.as_ref().map_or(&self.start.world, |frame| &frame.world).clone();
        self.restore(State { world: good, ..self.state() });
        self.halt(
            "a step failed, which is a defect of Tautline; the last state shown was kept. Try another solver.".into(),
        );
    }

    fn halt(&mut self, fault: String) {
        self.running = false;
        self.fault = Some(fault);
    }

    fn remember_previous(&mut self) {
        let bodies = self.world.bodies();
        self.previous_position.clone_from(&bodies.position);
        self.previous_angle.clear();
        self.previous_angle.extend((0..bodies.len()).map(|i| bodies.spin(i).map_or(0.0, |spin| spin.angle)));
    }

    /// Carries out one command. What fails leaves the run as it was and shows a fault.
    pub(super) fn apply(&mut self, command: Command) {
        self.guard(|simulation| {
            if let Err(fault) = simulation.try_apply(command) {
                simulation.fault = Some(fault.to_string());
            }
        });
    }

    fn try_apply(&mut self, command: Command) -> Result<(), CommandError> {
        // Any other command settles a setting that was being changed.
        let setting = self.setting.take();
        match command {
            Command::Run(running) => {
                self.running = running;
                self.fault = self.fault.take().filter(|_| !running);
            }
            Command::StepOnce => {
                self.running = false;
                self.fault = None;
                self.take_step();
            }
            Command::Restart => {
                // How to step was chosen for this scene, perhaps to compare it over the same motion.
                let setup = Setup { method: *self.stepper.method(), ..(*self.start).clone() };
                let name = format!("Restart {}", setup.name);
                self.open(setup, name);
            }
            Command::Speed(speed) if speed.is_finite() => self.speed = speed.clamp(SPEED_RANGE[0], SPEED_RANGE[1]),
            Command::Speed(speed) => return Err(CommandError::Speed(speed)),
            Command::Slow(slow) => self.slow = slow,
            Command::Open(name) => self.open_scene(name.as_ref())?,
            Command::OpenFile(path) => self.open_scene(path.as_os_str())?,
            Command::New => self.open(blank(), "New scene".into()),
            Command::SaveAs(path) => self.save(&path)?,
            Command::Method(method) => {
                let name = setting::method(self.stepper.method(), &method);
                let rate = (self.stepper.method().hz != method.hz).then_some(Input::Rate(method.hz));
                self.set(name, setting, |now| now.stepper.set_method(method))?;
                rate.iter().for_each(|rate| self.tell(rate));
            }
            Command::Gravity(gravity) => {
                let name = (self.world.gravity() != gravity).then_some("gravity");
                self.set(name, setting, |now| now.world.set_gravity(gravity))?;
                name.iter().for_each(|_| self.tell(&Input::Gravity(gravity)));
            }
            Command::Drag(drag) => {
                let name = (self.world.drag() != drag).then_some("air drag");
                self.set(name, setting, |now| now.world.set_drag(drag))?;
                name.iter().for_each(|_| self.tell(&Input::Drag(drag)));
            }
            Command::Tuning(tuning) => {
                let name = setting::tuning(&self.world.tuning(), &tuning);
                self.set(name, setting, |now| now.world.set_tuning(tuning))?;
                name.iter().for_each(|_| self.tell(&Input::Tuning(tuning)));
            }
            Command::Truth(on) => {
                self.ghost = on;
                self.follow_truth()?;
            }
            Command::Rival(method) => {
                if let Some(method) = &method {
                    method.validate()?;
                }
                let beginning = self.beginning();
                self.links.set_rival(method, beginning, &self.waker).map_err(|error| no_thread("rival", error))?;
            }
            Command::Lab(order) => self.order(order)?,
            Command::Grab { body, at } => self.grab(body, at)?,
            Command::MoveGrip(target) => {
                if let Some(grip) = self.world.grip().copied() {
                    self.world.set_grip(Some(Grip { target, ..grip }))?;
                    self.tell(&Input::Move(target));
                }
            }
            Command::Release => {
                self.world.set_grip(None)?;
                self.tell(&Input::Release);
            }
            Command::Edit(edit) => {
                self.slashed = false;
                self.edit(&edit)?;
            }
            Command::Slash { from, to, first } => {
                self.slashed &= !first;
                self.edit(&Edit::Cut(from, to))?;
            }
            Command::Undo => {
                let now = self.state();
                if let Some(state) = self.history.undo(now) {
                    self.restore(state);
                }
            }
            Command::Redo => {
                let now = self.state();
                if let Some(state) = self.history.redo(now) {
                    self.restore(state);
                }
            }
            Command::DismissFault => self.fault = None,
            Command::DismissNote => self.note = None,
            Command::Quit => self.running = false,
        }
        Ok(())
    }

    fn order(&mut self, order: LabOrder) -> Result<(), CommandError> {
        match order {
            LabOrder::Start => {
                let mut touched = (!self.untouched).then(|| self.world.clone());
                // A hand is no part of a scene.
                touched.iter_mut().for_each(|world| world.set_grip(None).expect("letting go is always possible"));
                let job = Job { setup: self.start.clone(), touched, method: *self.stepper.method() };
                self.laboratory.start(job, &self.waker).map_err(|error| no_thread("lab", error))
            }
            LabOrder::Stop => {
                self.laboratory.stop();
                Ok(())
            }
            LabOrder::Resume => self.laboratory.resume(&self.waker).map_err(|error| no_thread("lab", error)),
            LabOrder::Export(path) => {
                if self.start.file.as_ref().is_some_and(|scene| is_same(scene, &path)) {
                    return Err(CommandError::OpenScene(named(&path)));
                }
                if path.exists() && !self.exported.contains(&path) {
                    return Err(CommandError::Exists(named(&path)));
                }
                self.laboratory.export(&path)?;
                self.exported.insert(path);
                Ok(())
            }
        }
    }

    /// Tells the companions what was done to the world.
    fn tell(&mut self, input: &Input) {
        self.links.input(input);
        if input.touches() {
            self.untouched = false;
            self.trial.iter_mut().for_each(Trial::void);
        }
    }

    /// Lets the truth follow as far as it is wanted: what is known costs nothing.
    fn follow_truth(&mut self) -> Result<(), CommandError> {
        let extent = match (self.ghost, self.known) {
            (true, _) => Some(Extent::Computed),
            (false, true) => Some(Extent::Known),
            (false, false) => None,
        };
        let beginning = self.beginning();
        self.links.set_truth(extent, beginning, &self.waker).map_err(|error| no_thread("truth", error))
    }

    /// Where a companion would begin to follow now.
    fn beginning(&self) -> Beginning {
        Beginning {
            world: self.world.clone(),
            start: self.start.clone(),
            scene: self.scene.clone(),
            untouched: self.untouched,
            hz: self.stepper.method().hz,
        }
    }

    fn state(&self) -> State {
        let (world, method) = (self.world.clone(), *self.stepper.method());
        State { world, method, start: self.start.clone(), edited: self.edited }
    }

    fn open_scene(&mut self, name_or_path: &OsStr) -> Result<(), CommandError> {
        let setup = scene::open(name_or_path)?;
        let name = format!("Open {}", setup.name);
        self.open(setup, name);
        Ok(())
    }

    /// Starts a scene, which can be undone. A method that cannot be used shows a fault and changes nothing.
    fn open(&mut self, setup: Setup, name: String) {
        let before = self.state();
        let (world, method) = (setup.world.clone(), setup.method);
        let state = State { world, method, start: Arc::new(setup), edited: false };
        self.history.record_leap(name, before);
        let title = if self.scene.title.is_empty() { &self.scene.name } else { &self.scene.title };
        let lost = self.edited.then(|| title.clone());
        self.restore(state);
        self.note = lost.map(|title| {
            format!("“{title}” had changes that were not saved. Undo [Ctrl-Z] brings it back as it was.").into()
        });
    }

    /// Writes the scene as it stands to a file. A new scene is called after its first one.
    fn save(&mut self, path: &Path) -> Result<(), CommandError> {
        let mut setup = Setup { world: self.world.clone(), method: *self.stepper.method(), ..(*self.start).clone() };
        let is_new = setup.name == blank::NAME;
        if let Some(stem) = path.file_stem().filter(|_| is_new) {
            (setup.title, setup.about) = (stem.to_string_lossy().into_owned(), String::new());
        }
        scene::save(path, &scene::capture(&setup))?;
        if is_new {
            let (name, file) = (path.to_string_lossy().into_owned(), Some(path.to_owned()));
            let (title, about) = (setup.title, setup.about);
            self.start = Arc::new(Setup { name, file, title, about, ..(*self.start).clone() });
            self.scene = Arc::new(info(&self.start, self.opened));
        }
        self.saved = Some(named(path));
        (self.edited, self.note) = (false, None);
        Ok(())
    }

    /// Changes the setting `name`, if any is another one than before. `last` is the setting that the command before changed,
    /// and when: a run of changes of the same one is undone as one.
    fn set(
        &mut self,
        name: Option<&'static str>,
        last: Option<(&'static str, Instant)>,
        change: impl FnOnce(&mut Simulation) -> Result<(), EngineError>,
    ) -> Result<(), EngineError> {
        let Some(name) = name else {
            self.setting = last;
            return Ok(());
        };
        let now = Instant::now();
        let goes_on = last.is_some_and(|(last, when)| last == name && now.duration_since(when) <= SETTLING);
        let before = self.state();
        change(self)?;
        self.note_edit(format!("Change {name}"), before, goes_on);
        self.setting = Some((name, now));
        // Energies follow gravity and stiffness at once, also while paused.
        self.measures = Measures::of(&self.world);
        Ok(())
    }

    fn edit(&mut self, edit: &Edit) -> Result<(), CommandError> {
        let before = self.state();
        match edit::apply(&mut self.world, edit) {
            Ok(touched) if touched.is_empty() => {}
            Ok(touched) => {
                self.tell(&Input::of_edit(edit, &touched));
                self.touched = Arc::new(touched);
                self.note_edit(edit.name(), before, self.slashed);
                self.slashed = matches!(edit, Edit::Cut(..));
                self.measure_anew();
            }
            Err(error) => {
                self.world = before.world;
                return Err(error.into());
            }
        }
        Ok(())
    }

    /// Keeps what is needed to take back the edit just made; one that goes on is taken back with the part before it.
    fn note_edit(&mut self, name: String, before: State, goes_on: bool) {
        self.saved = None;
        self.note = None;
        self.edited = true;
        let after = self.state();
        if goes_on {
            self.history.extend(&before, after);
        } else {
            self.history.record(name, before, after);
        }
    }

    /// Takes up a state from the history or the start of a scene. A hold is let go: it belongs to the other state.
    fn restore(&mut self, state: State) {
        if !Arc::ptr_eq(&state.start, &self.start) {
            self.opened += 1;
            self.scene = Arc::new(info(&state.start, self.opened));
            self.known = state.start.known_motion().is_some();
            self.plots.clear();
        }
        self.world = state.world;
        self.start = state.start;
        self.world.set_grip(None).expect("letting go is always possible");
        // A new stepper: the old one's plan and memory belong to another world.
        (self.stepper, self.fault) = stepper(state.method);
        self.plots.rewind(self.world.time());
        (self.saved, self.note) = (None, None);
        self.edited = state.edited;
        self.slashed = false;
        self.report = StepReport::default();
        self.measure_anew();
        // A state from the history may be of an untouched run, but only its start is known to be.
        self.untouched = self.world.tick() == self.start.world.tick() && self.world == self.start.world;
        self.trial = Trial::of(&self.start).filter(|_| self.untouched);
        if self.links.any() {
            let beginning = self.beginning();
            self.links.begin(&beginning);
        }
        if let Err(error) = self.follow_truth() {
            self.fault.get_or_insert_with(|| error.to_string());
        }
    }

    fn measure_anew(&mut self) {
        self.measures = Measures::of(&self.world);
        self.previous_position.clear();
        self.previous_angle.clear();
        self.trace.clear();
    }

    fn grab(&mut self, id: Id, at: DVec2) -> Result<(), EngineError> {
        let index = self.world.bodies().index_of(id).ok_or(EngineError::NoBody(id))?;
        let local = self.world.to_local(index, at);
        let mass = self.world.bodies().mass[index];
        let grip = Grip::new(id, local, at, mass);
        self.world.set_grip(Some(grip))?;
        self.tell(&Input::Hold(grip));
        Ok(())
    }
}

/// The frame of a scene after `seconds` of simulated time (rounded to whole steps), stepped here and now, without a thread. If
/// the run diverges, the last good one, with the fault.
///
/// What is wanted beside it has caught up then, or is given up after a minute.
pub fn frame_after(setup: Setup, seconds: f64, beside: &Beside) -> Arc<Frame> {
    let mut simulation = Simulation::new(setup, Box::new(|| Box::new(|| ())));
    if beside.truth {
        simulation.apply(Command::Truth(true));
    }
    if let Some(method) = beside.rival {
        simulation.apply(Command::Rival(Some(method)));
    }
    while simulation.running && simulation.time() + 0.5 * simulation.step_seconds() <= seconds {
        simulation.step();
    }
    let frame = simulation.publish(0, simulation.speed());
    let deadline = Instant::now() + CATCHING_UP;
    let companions = [&frame.companions.truth, &frame.companions.rival];
    for companion in companions.into_iter().flatten() {
        let behind = |report: &Report| {
            report.tick < frame.world.tick() && !matches!(report.standing, Standing::Lost(_))
                || report.standing == Standing::Waiting
        };
        while behind(&companion.report()) && Instant::now() < deadline {
            std::thread::sleep(Duration::from_millis(2));
        }
    }
    frame
}

/// How long a picture waits for the companions of its scene.
const CATCHING_UP: Duration = Duration::from_secs(60);

/// What a picture shows beside the simulation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Beside {
    /// The truth, as a ghost.
    pub truth: bool,
    /// The same scene under this method.
    pub rival: Option<Method>,
}

fn no_thread(what: &'static str, why: std::io::Error) -> CommandError {
    CommandError::NoThread { what, why }
}

/// A stepper with a clock; if the method cannot be used, the default one and why.
fn stepper(method: Method) -> (Stepper, Option<String>) {
    match Stepper::new(method) {
        Ok(stepper) => (stepper.with_clock(nanoseconds), None),
        Err(error) => {
            let default = Stepper::new(Method::default()).expect("the default method is valid");
            (default.with_clock(nanoseconds), Some(error.to_string()))
        }
    }
}

/// Nanoseconds since the first call.
fn nanoseconds() -> u64 {
    static ORIGIN: OnceLock<Instant> = OnceLock::new();
    ORIGIN.get_or_init(Instant::now).elapsed().as_nanos() as u64
}

fn info(setup: &Setup, opened: u64) -> SceneInfo {
    SceneInfo {
        name: setup.name.clone(),
        title: setup.title.clone(),
        about: setup.about.clone(),
        view: setup.view,
        bounds: pick::bounds(&setup.world, &[]),
        opened,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::Body;

    #[test]
    fn after_a_panic_the_run_pauses_at_the_state_shown_last() {
        let mut world = World::new();
        world.add_body(&Body::default()).expect("a sound body");
        let about = String::new();
        let setup = Setup {
            name: "test".into(),
            file: None,
            title: about.clone(),
            about,
            world,
            method: Method::default(),
            names: Default::default(),
            view: None,
            truth: None,
            pass: None,
        };
        let mut simulation = Simulation::new(setup, Box::new(|| Box::new(|| ())));
        simulation.step();
        let shown = simulation.publish(1, 1.0);
        simulation.guard(|simulation| {
            simulation.take_step();
            panic!("on purpose, by a test");
        });
        assert_eq!(simulation.world, shown.world);
        assert!(!simulation.running && simulation.fault.is_some());
        simulation.apply(Command::Run(true));
        simulation.step();
        assert_eq!(simulation.world.tick(), 2);
    }
}
