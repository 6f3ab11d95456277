//! The sandbox without its window: the simulation thread, edits, undo, picking, tools, the table of actions.
#![cfg(feature = "desktop")]

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use tautline::app::drawn::Sizes;
use tautline::app::history::{History, State};
use tautline::app::{Action, Button, Camera, Command, Edit, Frame, Join, Modifiers, Phase, PointerEvent};
use tautline::app::{Session, Spawn, Tool, Tools, edit, keys, pick};
use tautline::engine::{Anchor, Body, Constraint, DVec2, Id, Kind, Method, Motion, Spin, Wall, World};
use tautline::scene::Setup;

/// Long enough for a loaded machine; a test that waits this long has failed.
const PATIENCE: Duration = Duration::from_secs(20);

fn v(x: f64, y: f64) -> DVec2 {
    DVec2::new(x, y)
}

fn setup(world: World) -> Setup {
    let (title, about) = ("Test".into(), String::new());
    let (name, method) = ("test".into(), Method::default());
    Setup {
        name,
        file: None,
        title,
        about,
        world,
        method,
        names: Default::default(),
        view: None,
        truth: None,
        pass: None,
    }
}

fn start(world: World) -> Session {
    start_setup(setup(world))
}

fn start_setup(setup: Setup) -> Session {
    Session::start(setup, || {}).expect("the system has room for a thread")
}

fn weightless() -> World {
    let mut world = World::new();
    world.set_gravity(DVec2::ZERO).expect("zero is a valid gravity");
    world
}

fn add(world: &mut World, position: DVec2) -> Id {
    world.add_body(&Body { position, ..Body::default() }).expect("a valid body")
}

fn rod(world: &mut World, length: f64, a: Id, b: Id) -> Id {
    world.add_constraint(&Constraint::between(Kind::Rod { length }, a, b)).expect("a valid rod")
}

fn change(world: &mut World, edit: Edit) -> Vec<Id> {
    edit::apply(world, &edit).expect("a valid edit")
}

/// The first frame that satisfies `wanted`.
fn wait_for(session: &Session, what: &str, wanted: impl Fn(&Frame) -> bool) -> Arc<Frame> {
    let begin = Instant::now();
    loop {
        let frame = session.frame();
        if wanted(&frame) {
            return frame;
        }
        assert!(begin.elapsed() < PATIENCE, "waited {PATIENCE:?} for {what}; fault: {:?}", frame.fault);
        std::thread::sleep(Duration::from_millis(2));
    }
}

fn pause(session: &Session) -> Arc<Frame> {
    session.send(Command::Run(false));
    wait_for(session, "the pause", |f| !f.running)
}

fn position(frame: &Frame, id: Id) -> DVec2 {
    frame.world.body(id).expect("the body is still there").position
}

#[test]
fn a_drag_moves_the_body_to_the_pointer_and_a_throw_keeps_its_velocity() {
    let mut world = weightless();
    let ball = add(&mut world, v(0.0, 0.0));
    let session = start(world);
    session.send(Command::Grab { body: ball, at: v(0.0, 0.0) });
    session.send(Command::MoveGrip(v(1.0, 0.5)));
    // 1 mm: a critically damped hold of 7.5 Hz is there after some 0.3 s.
    let near = wait_for(&session, "the body to arrive", |f| position(f, ball).distance(v(1.0, 0.5)) < 1e-3);
    assert!(near.world.time() > 0.05, "the body was teleported: it took {} s", near.world.time());

    session.send(Command::MoveGrip(v(3.0, 0.5)));
    wait_for(&session, "the body to be on its way", |f| position(f, ball).x > 1.2);
    session.send(Command::Release);
    let free = wait_for(&session, "the hold to end", |f| f.world.grip().is_none());
    let thrown = free.world.body(ball).expect("still there").velocity;
    assert!(thrown.length() > 1e-3, "the body lost its velocity when it was let go: {thrown}");
    let later = wait_for(&session, "time to pass", |f| f.world.time() > free.world.time() + 0.2);
    let kept = later.world.body(ball).expect("still there").velocity;
    // Nothing acts on it any more: 1e-9 is rounding of a few dozen substeps.
    assert!(kept.distance(thrown) < 1e-9 * thrown.length(), "{thrown} became {kept}");
}

#[test]
fn a_cut_removes_exactly_what_it_crosses() {
    let mut world = World::new();
    let nodes: Vec<Id> = (0..6).map(|i| add(&mut world, v(f64::from(i), 0.0))).collect();
    let rods: Vec<Id> = nodes.windows(2).map(|pair| rod(&mut world, 1.0, pair[0], pair[1])).collect();
    assert_eq!(change(&mut world, Edit::Cut(v(2.4, 1.0), v(2.6, -1.0))), [rods[2]]);
    assert_eq!(world.constraints().id, [rods[0], rods[1], rods[3], rods[4]]);
    assert_eq!(world.bodies().len(), 6, "a cut takes no bodies");
    // Too short to reach the rod, beside the chain, and along it: none of them crosses.
    for (from, to) in [(v(0.5, 1.0), v(0.5, 0.1)), (v(7.0, 1.0), v(7.0, -1.0)), (v(-1.0, 0.0), v(9.0, 0.0))] {
        assert!(change(&mut world, Edit::Cut(from, to)).is_empty());
    }
}

#[test]
fn a_cut_takes_a_pin_that_it_passes_close_by() {
    let mut world = World::new();
    let ball = add(&mut world, v(0.0, 0.0));
    let pin = world.add_constraint(&Constraint::to_world(Kind::Pin, ball, v(0.0, 0.0))).expect("valid");
    assert!(change(&mut world, Edit::Cut(v(-1.0, 0.5), v(1.0, 0.5))).is_empty());
    assert_eq!(change(&mut world, Edit::Cut(v(-1.0, 0.01), v(1.0, 0.01))), [pin]);
}

#[test]
fn undo_and_redo_restore_the_exact_state() {
    let mut world = World::new();
    let ball = add(&mut world, v(0.1, 0.2));
    let session = start(world);
    wait_for(&session, "a few steps", |f| f.world.tick() > 3);
    let before = pause(&session);
    session.send(Command::Edit(Edit::Spawn { kind: Spawn::Cloth, at: v(1.0, 1.0), size: 0.05 }));
    let edited = wait_for(&session, "the cloth", |f| f.world.bodies().len() > 100);
    assert_eq!(edited.undo.as_deref(), Some("Add cloth"));
    session.send(Command::Edit(Edit::Delete(vec![ball])));
    wait_for(&session, "the ball to go", |f| f.world.body(ball).is_err());
    session.send(Command::Undo);
    session.send(Command::Undo);
    let undone = wait_for(&session, "both undone", |f| f.undo.is_none());
    assert_eq!(undone.world, before.world);
    assert_eq!(undone.world.hash(), before.world.hash());
    session.send(Command::Redo);
    let redone = wait_for(&session, "the cloth again", |f| f.redo.as_deref() == Some("Delete"));
    assert_eq!(redone.world, edited.world);
}

#[test]
fn undo_takes_back_the_edit_and_leaves_time_and_all_other_motion() {
    let mut world = weightless();
    let ball = world.add_body(&Body { velocity: v(1.0, 0.0), ..Body::default() }).expect("valid");
    // A pair on a rod that flies along: cut, its halves would each go their own way.
    let spinning = |y: f64, vx: f64| Body { position: v(0.0, y), velocity: v(vx, 0.0), ..Body::default() };
    let (a, b) = (world.add_body(&spinning(5.0, 1.0)), world.add_body(&spinning(6.0, -1.0)));
    let (a, b) = (a.expect("valid"), b.expect("valid"));
    let link = rod(&mut world, 1.0, a, b);
    let session = start(world);
    wait_for(&session, "some steps", |f| f.world.tick() > 10);
    session.send(Command::Edit(Edit::Cut(v(-9.0, 5.51), v(9.0, 5.49))));
    let cut = wait_for(&session, "the cut", |f| f.world.constraint(link).is_err());
    let drifted = wait_for(&session, "the halves to part", |f| position(f, a).distance(position(f, b)) > 1.2);
    session.send(Command::Undo);
    let undone = wait_for(&session, "the rod again", |f| f.world.constraint(link).is_ok());
    assert!(undone.world.time() >= drifted.world.time() && undone.world.tick() >= drifted.world.tick());
    assert!(position(&undone, ball).x >= position(&drifted, ball).x, "what the cut did not concern goes on");
    // What was torn is whole again, as it was when it was cut.
    assert!((position(&undone, a).distance(position(&undone, b)) - 1.0).abs() < 1e-3);
    assert!(undone.fault.is_none() && undone.running);
    session.send(Command::Redo);
    let redone = wait_for(&session, "the cut again", |f| f.world.constraint(link).is_err());
    assert!(redone.world.time() >= undone.world.time() && redone.undo.as_deref() == Some("Cut"));
    assert_eq!(cut.undo, redone.undo);
    // What was placed is taken away again, and nothing else.
    session.send(Command::Edit(Edit::Spawn { kind: Spawn::Rope, at: v(0.0, -9.0), size: 0.1 }));
    let placed = wait_for(&session, "the rope", |f| f.world.bodies().len() > 10);
    wait_for(&session, "time", |f| f.world.tick() > placed.world.tick() + 10);
    let before = session.frame();
    session.send(Command::Undo);
    let undone = wait_for(&session, "the rope to go", |f| f.world.bodies().len() == 3);
    assert!(undone.world.time() >= before.world.time());
    assert!(position(&undone, ball).x >= position(&before, ball).x);
}

#[test]
fn undoing_a_change_of_a_property_keeps_the_motion_since() {
    let mut world = weightless();
    let ball = world.add_body(&Body { velocity: v(1.0, 0.0), ..Body::default() }).expect("valid");
    let session = start(world);
    let body = session.frame().world.body(ball).expect("there");
    let heavy = Box::new(Body { mass: 5.0, ..body });
    session.send(Command::Edit(Edit::ChangeBody { id: ball, from: Box::new(body), to: heavy }));
    session.send(Command::Gravity(v(0.0, -1.0)));
    let later = wait_for(&session, "time", |f| f.world.tick() > 20);
    session.send(Command::Undo);
    session.send(Command::Undo);
    let undone = wait_for(&session, "both undone", |f| f.undo.is_none());
    let (was, is) = (later.world.body(ball).expect("there"), undone.world.body(ball).expect("there"));
    assert_eq!((was.mass, is.mass, undone.world.gravity()), (5.0, body.mass, DVec2::ZERO));
    assert!(is.position.x >= was.position.x && is.velocity.y <= was.velocity.y && is.velocity.y < 0.0, "{is:?}");
    assert!(undone.world.time() >= later.world.time());
}

#[test]
fn a_whole_slash_is_undone_as_one_and_two_slashes_as_two() {
    let mut world = weightless();
    let nodes: Vec<Id> = (0..6).map(|i| add(&mut world, v(f64::from(i), 0.0))).collect();
    for pair in nodes.windows(2) {
        rod(&mut world, 1.0, pair[0], pair[1]);
    }
    let session = start(world);
    let across = |x: f64, first| Command::Slash { from: v(x, 1.0), to: v(x, -1.0), first };
    // The first piece of the first slash meets nothing; the world moves on between the pieces.
    for (x, first) in [(-0.5, true), (0.5, false), (1.5, false)] {
        session.send(across(x, first));
        let tick = session.frame().world.tick();
        wait_for(&session, "time between two pieces", |f| f.world.tick() > tick + 3);
    }
    session.send(across(3.5, true));
    let cut = wait_for(&session, "three cuts", |f| f.world.constraints().len() == 2);
    assert_eq!(cut.undo.as_deref(), Some("Cut"));
    session.send(Command::Undo);
    wait_for(&session, "the second slash undone", |f| f.world.constraints().len() == 3 && f.undo.is_some());
    session.send(Command::Undo);
    let whole = wait_for(&session, "all of the first undone", |f| f.world.constraints().len() == 5);
    assert_eq!(whole.undo, None);
    session.send(Command::Redo);
    wait_for(&session, "all of the first again", |f| f.world.constraints().len() == 3);
}

#[test]
fn undone_in_a_pile_that_has_settled_an_edit_does_not_disturb_it() {
    let mut world = World::new();
    world.add_wall(&Wall::block(v(-9.0, -1.0), v(9.0, 0.0))).expect("a floor");
    let disc = |y: f64| Body { position: v(0.0, y), radius: 0.5, ..Body::default() };
    let discs: Vec<Id> = (0..4).map(|i| world.add_body(&disc(0.5 + f64::from(i))).expect("valid")).collect();
    let far = add(&mut world, v(7.0, 0.5));
    let session = start(world);
    wait_for(&session, "rest", |f| f.world.tick() > 60);
    // Removed before the others, so that their indices differ before and after.
    session.send(Command::Edit(Edit::Delete(vec![discs[0]])));
    let fallen = wait_for(&session, "the stack to fall", |f| f.world.body(discs[0]).is_err() && f.world.tick() > 200);
    session.send(Command::Edit(Edit::Delete(vec![far])));
    wait_for(&session, "the far one to go", |f| f.world.body(far).is_err());
    session.send(Command::Undo);
    let undone = wait_for(&session, "the far one", |f| f.world.body(far).is_ok());
    let later = wait_for(&session, "time", |f| f.world.tick() > undone.world.tick() + 30);
    for id in &discs[1..] {
        let (was, is) = (position(&fallen, *id), position(&later, *id));
        assert!(was.distance(is) < 0.01, "{id}: {was} became {is}");
    }
}

#[test]
fn a_new_scene_is_empty_by_accuracy_and_named_and_what_was_left_unsaved_comes_back() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut world = World::new();
    add(&mut world, v(0.0, 0.0));
    let session = start(world);
    session.send(Command::New);
    let empty = wait_for(&session, "the new scene", |f| f.scene.title == "New scene");
    assert!(empty.world.bodies().is_empty() && empty.world.tick() < 60 && !empty.scene.about.is_empty());
    assert!(empty.method.automatic && empty.method.accuracy == 1e-3);
    assert_eq!((empty.note.as_deref(), empty.undo.as_deref()), (None, Some("New scene")), "nothing unsaved was left");
    session.send(Command::Edit(Edit::Spawn { kind: Spawn::Disc, at: v(0.0, 1.0), size: 0.1 }));
    wait_for(&session, "the disc", |f| f.world.bodies().len() == 1);
    session.send(Command::Open("pendulum".into()));
    let other = wait_for(&session, "another scene", |f| f.scene.name == "pendulum");
    let note = other.note.clone().expect("it says what was left");
    assert!(note.contains("New scene") && note.contains("Ctrl-Z"), "{note}");
    session.send(Command::Undo);
    let back = wait_for(&session, "the new scene again", |f| f.scene.title == "New scene");
    assert_eq!((back.world.bodies().len(), back.note.as_deref()), (1, None));
    let path = folder.path().join("mobile.ron");
    session.send(Command::SaveAs(path.clone()));
    let saved = wait_for(&session, "the file", |f| f.saved.is_some());
    assert_eq!(
        (saved.scene.title.as_str(), saved.scene.opened),
        ("mobile", back.scene.opened),
        "called after its file"
    );
    session.send(Command::Open("pendulum".into()));
    let other = wait_for(&session, "another scene", |f| f.scene.name == "pendulum");
    assert_eq!(other.note, None, "nothing is unsaved");
    session.send(Command::Open(path.display().to_string()));
    let read = wait_for(&session, "the file", |f| f.scene.name == path.display().to_string());
    assert_eq!(read.scene.title, "mobile");
}

#[test]
fn the_choice_by_accuracy_reaches_the_simulation_and_is_undone_by_name() {
    let session = start(World::new());
    let by_accuracy = Method { automatic: true, ..session.frame().method };
    session.send(Command::Method(by_accuracy));
    let chosen = wait_for(&session, "by accuracy", |f| f.method.automatic);
    assert_eq!(chosen.undo.as_deref(), Some("Change choice by accuracy"));
    session.send(Command::Method(Method { accuracy: 1e-9, ..by_accuracy }));
    wait_for(&session, "a finer one", |f| f.method.accuracy == 1e-9);
}

#[test]
fn a_change_of_a_setting_is_undone_as_one_and_by_its_name() {
    let mut world = World::new();
    let ball = add(&mut world, v(0.1, 0.2));
    let session = start(world);
    pause(&session);
    for y in [-9.0, -5.0, -1.0] {
        session.send(Command::Gravity(v(0.0, y)));
    }
    let changed = wait_for(&session, "the last gravity", |f| f.world.gravity().y == -1.0);
    assert_eq!(changed.undo.as_deref(), Some("Change gravity"));
    // The energy follows at once: a kilogram at some 0.2 m, less what it fell before the pause.
    let (potential, height) = (changed.measures.potential, changed.world.body(ball).expect("the ball").position.y);
    assert!((potential - height).abs() < 1e-15, "{potential} J at {height} m");
    session.send(Command::Gravity(v(0.0, -1.0)));
    session.send(Command::Method(Method { substeps: 3, ..Method::default() }));
    session.send(Command::Edit(Edit::Delete(vec![ball])));
    wait_for(&session, "the ball to go", |f| f.world.body(ball).is_err());
    session.send(Command::Undo);
    let undone = wait_for(&session, "the ball again", |f| f.world.body(ball).is_ok());
    assert_eq!((undone.world.gravity().y, undone.method.substeps), (-1.0, 3), "undo takes back what it names only");
    assert_eq!(undone.undo.as_deref(), Some("Change substeps"));
    session.send(Command::Undo);
    session.send(Command::Undo);
    let undone = wait_for(&session, "everything undone", |f| f.undo.is_none());
    assert_eq!((undone.world.gravity().y, undone.method), (-9.81, Method::default()));
    session.send(Command::Redo);
    wait_for(&session, "the last gravity again", |f| f.world.gravity().y == -1.0);
}

#[test]
fn restart_and_open_can_be_undone() {
    let mut world = World::new();
    add(&mut world, v(0.0, 0.0));
    let session = start(world);
    wait_for(&session, "a few steps", |f| f.world.tick() > 3);
    session.send(Command::Method(Method { automatic: true, accuracy: 1e-9, ..Method::default() }));
    let before = pause(&session);
    session.send(Command::Restart);
    let fresh = wait_for(&session, "the restart", |f| f.world.tick() == 0);
    assert!(fresh.method.automatic && fresh.method.accuracy == 1e-9, "the solver's settings are kept");
    assert!(fresh.scene.opened > before.scene.opened, "the window must know that the scene was started anew");
    session.send(Command::Undo);
    assert_eq!(wait_for(&session, "the undo", |f| f.world.tick() > 0).world, before.world);
    session.send(Command::Open("pendulum".into()));
    wait_for(&session, "another scene", |f| f.scene.name == "pendulum");
    session.send(Command::Undo);
    assert_eq!(wait_for(&session, "the first scene", |f| f.scene.name == "test").world, before.world);
}

#[test]
fn a_file_that_cannot_be_opened_keeps_the_running_scene() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("broken.ron");
    std::fs::write(&path, "(version: 1, bodies: [Particle(mass: -1.0)])").expect("writable");
    let mut world = World::new();
    let ball = add(&mut world, v(0.0, 0.0));
    let session = start(world);
    session.send(Command::Open(path.display().to_string()));
    let frame = wait_for(&session, "the fault", |f| f.fault.is_some());
    assert!(frame.fault.as_deref().is_some_and(|fault| fault.contains("broken.ron")), "{:?}", frame.fault);
    assert!(frame.running && frame.world.body(ball).is_ok());
    let tick = frame.world.tick();
    wait_for(&session, "the scene to run on", |f| f.world.tick() > tick + 5);
    session.send(Command::DismissFault);
    wait_for(&session, "the fault to go", |f| f.fault.is_none());
}

#[test]
fn what_is_saved_opens_again_as_it_was() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("mine.ron");
    let mut world = weightless();
    let ball = add(&mut world, v(1.0 / 3.0, 0.2));
    let session = start(world);
    session.send(Command::Run(false));
    session.send(Command::SaveAs(path.clone()));
    wait_for(&session, "word that it was saved", |f| f.saved.as_deref() == path.to_str());
    session.send(Command::Open(path.display().to_string()));
    let frame = wait_for(&session, "the file to open", |f| f.scene.name == path.display().to_string());
    assert_eq!(frame.fault, None);
    assert_eq!(position(&frame, ball), v(1.0 / 3.0, 0.2));
}

#[test]
fn a_paused_session_publishes_nothing_and_sleeps() {
    let mut world = World::new();
    add(&mut world, v(0.0, 0.0));
    let wakes = Arc::new(AtomicUsize::new(0));
    let counted = wakes.clone();
    let count = move || {
        counted.fetch_add(1, Ordering::Relaxed);
    };
    let session = Session::start(setup(world), count).expect("room for a thread");
    let paused = pause(&session);
    let seen = wakes.load(Ordering::Relaxed);
    std::thread::sleep(Duration::from_millis(400));
    assert_eq!(session.frame().sequence, paused.sequence);
    assert_eq!(wakes.load(Ordering::Relaxed), seen);
    session.send(Command::StepOnce);
    let stepped = wait_for(&session, "one step", |f| f.world.tick() == paused.world.tick() + 1);
    assert!(!stepped.running);
    assert_eq!(stepped.sequence, paused.sequence + 1, "one frame a command");
}

/// Touching discs, a cloth and a rope with so many sweeps that a step takes far longer than it lasts.
fn overload() -> Setup {
    let mut world = World::new();
    for (kind, x) in [(Spawn::Pile, 0.0), (Spawn::Cloth, 5.0), (Spawn::Rope, 9.0)] {
        change(&mut world, Edit::Spawn { kind, at: v(x, 1.0), size: 0.1 });
    }
    world.add_wall(&Wall::block(v(-5.0, -1.0), v(5.0, 0.0))).expect("a floor");
    Setup { method: Method { iterations: 100_000, ..Method::default() }, ..setup(world) }
}

#[test]
fn an_overloaded_session_answers_at_once_and_says_that_it_is_slow() {
    let session = start_setup(overload());
    let (begin, mut worst) = (Instant::now(), Duration::ZERO);
    while begin.elapsed() < Duration::from_millis(1500) {
        let asked = Instant::now();
        session.frame();
        session.send(Command::MoveGrip(v(0.0, 0.0)));
        worst = worst.max(asked.elapsed());
        std::thread::sleep(Duration::from_millis(1));
    }
    let frame = wait_for(&session, "a measured speed", |f| f.speed.achieved < f.speed.wanted);
    println!("worst answer {worst:?} while a step takes {} µs; speed {:?}", frame.report.step_us, frame.speed);
    // A few frames of a display; the machine may be running other tests meanwhile.
    assert!(worst < Duration::from_millis(100), "a frame took {worst:?}");
    assert!(frame.speed.achieved < 0.5 * frame.speed.wanted, "{:?}", frame.speed);
}

#[test]
fn a_run_that_diverges_pauses_at_the_last_good_state() {
    let mut world = weightless();
    // Leaves the coordinates that a world accepts after a tenth of a second.
    let lost = Body { position: v(9.9e8, 0.0), velocity: v(9e7, 0.0), ..Body::default() };
    let lost = world.add_body(&lost).expect("within the limits");
    let session = start(world);
    let frame = wait_for(&session, "the divergence", |f| f.fault.is_some());
    println!("{:?}", frame.fault);
    assert!(!frame.running);
    assert_eq!(frame.report.divergence.as_ref().map(|divergence| divergence.body), Some(lost));
    assert!(position(&frame, lost).x <= 1e9, "the last good state is within the limits");
    assert!(frame.world.tick() > 0);
    session.send(Command::Restart);
    wait_for(&session, "the fault to be resolved", |f| f.fault.is_none() && f.world.tick() == 0);
}

#[test]
fn speed_scales_simulated_time() {
    let mut world = World::new();
    add(&mut world, v(0.0, 0.0));
    let session = start(world);
    session.send(Command::Speed(0.1));
    let first = wait_for(&session, "the new speed", |f| f.speed.wanted == 0.1);
    std::thread::sleep(Duration::from_secs(1));
    let passed = session.frame().world.time() - first.world.time();
    // A tenth of the second, a step (1/60 s) either way at the ends; a busy machine can only make it less.
    assert!(passed > 0.02 && passed < 0.15, "{passed} s simulated in 1 s");
    session.send(Command::Speed(f64::NAN));
    wait_for(&session, "the fault", |f| f.fault.is_some() && f.speed.wanted == 0.1);
}

#[test]
fn slow_motion_is_a_tenth_of_the_speed_and_leaves_it_as_it_was() {
    let session = start(weightless());
    session.send(Command::Speed(2.0));
    session.send(Command::Slow(true));
    let slow = wait_for(&session, "slow motion", |f| f.speed.slow);
    assert_eq!((slow.speed.wanted, slow.speed.rate()), (2.0, 0.2));
    std::thread::sleep(Duration::from_secs(1));
    let passed = session.frame().world.time() - slow.world.time();
    // A fifth of the second, a step (1/60 s) either way at the ends; a busy machine can only make it less.
    assert!(passed > 0.02 && passed < 0.25, "{passed} s simulated in 1 s");
    session.send(Command::Slow(false));
    let fast = wait_for(&session, "the speed", |f| !f.speed.slow);
    assert_eq!(fast.speed.rate(), 2.0);
}

#[test]
fn the_plots_hold_every_step_even_those_without_a_frame() {
    let mut world = World::new();
    add(&mut world, v(0.0, 0.0));
    let method = Method { hz: 1000.0, substeps: 1, ..Method::default() };
    let session = start_setup(Setup { method, ..setup(world) });
    wait_for(&session, "300 steps", |f| f.world.tick() >= 300);
    let frame = pause(&session);
    let samples = frame.plots.read();
    assert_eq!(samples.len() as u64, frame.world.tick());
    assert!(frame.sequence < frame.world.tick(), "{} frames of {} steps", frame.sequence, frame.world.tick());
    assert!(samples.iter().zip(samples.iter().skip(1)).all(|(a, b)| a.measures.time < b.measures.time));
}

#[test]
fn the_history_forgets_the_oldest_edits_but_never_the_last() {
    let mut history = History::default();
    let start = Arc::new(setup(World::new()));
    let state = State { world: World::new(), method: Method::default(), start, edited: false };
    for edit in 0..1000 {
        history.record(format!("edit {edit}"), state.clone(), state.clone());
    }
    let mut kept = 0;
    while history.undo(state.clone()).is_some() {
        kept += 1;
    }
    assert_eq!(kept, 200);
    assert_eq!(history.redo_name(), Some("edit 800"));
    history.redo(state.clone()).expect("there is something to redo");
    history.record("another".into(), state.clone(), state);
    assert_eq!((history.undo_name(), history.redo_name()), (Some("another"), None));
}

/// Distance that a constraint wants between its ends [m].
fn rest_length(kind: Kind) -> f64 {
    match kind {
        Kind::Rod { length } | Kind::Rope { length } => length,
        Kind::Spring { rest, .. } => rest,
        Kind::Pin => 0.0,
    }
}

#[test]
fn every_spawn_is_valid_at_any_size_and_at_rest() {
    for (kind, size) in Spawn::ALL.into_iter().flat_map(|kind| [1e-3, 0.1, 100.0].map(|size| (kind, size))) {
        let mut world = World::new();
        let made = change(&mut world, Edit::Spawn { kind, at: v(3.0, 4.0), size });
        assert!(!made.is_empty());
        assert!(made.iter().all(|id| pick::item(&world, *id).is_some()));
        for i in 0..world.constraints().len() {
            let (a, b) = world.ends(i);
            // 1e-12: rounding of coordinates a few dozen lengths from the origin.
            let stretch = a.distance(b) - rest_length(world.constraints().kind[i]);
            assert!(stretch.abs() < 1e-12 * (size + 1.0) * 10.0, "{kind:?} of {size} m: {stretch}");
        }
    }
}

#[test]
fn a_failed_edit_changes_nothing_and_says_why() {
    let mut world = World::new();
    let ball = add(&mut world, v(0.0, 0.0));
    let session = start(world);
    let before = pause(&session);
    // The rope's far end would lie outside the world, after its first particles were added.
    session.send(Command::Edit(Edit::Spawn { kind: Spawn::Rope, at: v(1e9 - 1.0, 0.0), size: 0.1 }));
    let after = wait_for(&session, "the fault", |f| f.fault.is_some());
    assert_eq!(after.world, before.world);
    assert_eq!(after.undo, None);
    let (from, to) = (Box::new(Body::default()), Box::new(Body { mass: -1.0, ..Body::default() }));
    session.send(Command::Edit(Edit::ChangeBody { id: ball, from, to }));
    let after = wait_for(&session, "the other fault", |f| f.fault.as_deref().is_some_and(|text| text.contains("mass")));
    assert_eq!(after.world, before.world);
}

#[test]
fn a_duplicate_has_its_own_bodies_constraints_and_walls() {
    let mut world = World::new();
    let (a, b) = (add(&mut world, v(0.0, 0.0)), add(&mut world, v(1.0, 0.0)));
    rod(&mut world, 1.0, a, b);
    world.add_constraint(&Constraint::to_world(Kind::Pin, a, v(0.0, 0.0))).expect("valid");
    let wall = world.add_wall(&Wall::segment(v(0.0, -1.0), v(1.0, -1.0))).expect("valid");
    let made = change(&mut world, Edit::Duplicate(vec![a, b, wall], v(0.0, 5.0)));
    assert_eq!(made.len(), 5, "two bodies, a rod, a pin, a wall");
    assert_eq!(world.ends(2), (v(0.0, 5.0), v(1.0, 5.0)));
    assert_eq!(world.ends(3), (v(0.0, 5.0), v(0.0, 5.0)));
    assert_eq!(world.walls()[1].shape.bounds(), (v(0.0, 4.0), v(1.0, 4.0)));
}

#[test]
fn pinning_stops_a_body_and_freeing_lets_it_go_from_rest() {
    let mut world = World::new();
    let ball = world.add_body(&Body { velocity: v(3.0, 0.0), ..Body::default() }).expect("valid");
    assert_eq!(change(&mut world, Edit::Pin(vec![ball], true)), [ball]);
    assert_eq!(world.body(ball).expect("there").motion, Motion::Static);
    assert!(change(&mut world, Edit::Pin(vec![ball], true)).is_empty(), "it is pinned already");
    change(&mut world, Edit::Pin(vec![ball], false));
    let freed = world.body(ball).expect("there");
    assert_eq!((freed.motion, freed.velocity), (Motion::Dynamic, DVec2::ZERO));
}

fn camera() -> Camera {
    Camera { centre: DVec2::ZERO, scale: 100.0, size: v(800.0, 600.0) }
}

#[test]
fn picking_takes_the_smallest_exact_hit_else_the_nearest_within_reach() {
    let mut world = World::new();
    let large = world.add_body(&Body { radius: 1.0, ..Body::default() }).expect("valid");
    let small = world.add_body(&Body { radius: 0.2, ..Body::default() }).expect("valid");
    let (a, b) = (add(&mut world, v(-3.0, -2.0)), add(&mut world, v(3.0, -2.0)));
    let rod = rod(&mut world, 6.0, a, b);
    let at = |x: f64, y: f64| pick::pick(&world, &camera(), camera().to_canvas(v(x, y)));
    assert_eq!(at(0.1, 0.0), Some(small));
    assert_eq!(at(0.5, 0.0), Some(large));
    // 1 m are 100 points: the reach of 8 points is 0.08 m.
    assert_eq!(at(1.07, 0.0), Some(large));
    assert_eq!(at(1.09, 0.0), None);
    assert_eq!(at(0.0, -2.07), Some(rod));
    assert_eq!(pick::pick_body(&world, &camera(), camera().to_canvas(v(0.0, -2.0))), None);
    assert_eq!(pick::within(&world, v(-0.5, -0.5), v(0.5, 0.5)), [large, small]);
}

#[test]
fn a_rod_among_the_beads_that_hide_it_is_picked_by_its_line_and_the_beads_elsewhere() {
    let mut world = World::new();
    let bead = |x: f64| Body { position: v(x, 0.0), radius: 0.14, ..Body::default() };
    let beads: Vec<Id> = (0..5).map(|i| world.add_body(&bead(0.2 * f64::from(i))).expect("valid")).collect();
    let rods: Vec<Id> = beads.windows(2).map(|pair| rod(&mut world, 0.2, pair[0], pair[1])).collect();
    let bob = world.add_body(&Body { position: v(0.0, -3.0), radius: 0.4, ..Body::default() }).expect("valid");
    let hanger = Constraint::to_world(Kind::Rod { length: 2.0 }, bob, v(0.0, -1.0));
    let hanger = world.add_constraint(&hanger).expect("valid");
    // 1 m are 80 points: a rod is 3.2 points wide.
    let camera = Camera { scale: 80.0, ..camera() };
    let at = |x: f64, y: f64| pick::pick(&world, &camera, camera.to_canvas(v(x, y)));
    assert_eq!((at(0.3, 0.0), at(0.3, 0.01)), (Some(rods[1]), Some(rods[1])));
    assert_eq!((at(0.2, 0.0), at(0.4, 0.0)), (Some(beads[1]), Some(beads[2])));
    assert_eq!(at(0.24, 0.08), Some(beads[1]));
    // A lone rod is drawn below its bob, and cannot be hit there.
    assert_eq!((at(0.0, -2.0), at(0.0, -2.7)), (Some(hanger), Some(bob)));
    let mut hand = Hand { camera, ..Hand::with(Tool::Drag) };
    hand.drag(&world, v(0.3, 0.0), v(0.3, 0.0));
    assert_eq!(hand.tools.selection(), [rods[1]], "a click with the drag tool selects what lies on top");
}

/// Tools with their canvas, as a window would drive them.
struct Hand {
    tools: Tools,
    camera: Camera,
    modifiers: Modifiers,
}

impl Hand {
    fn with(tool: Tool) -> Hand {
        let mut tools = Tools::default();
        tools.set_tool(tool);
        Hand { tools, camera: camera(), modifiers: Modifiers::default() }
    }

    fn event(&mut self, world: &World, phase: Phase, at: DVec2) -> Vec<Command> {
        let event = PointerEvent { canvas: self.camera.to_canvas(at), phase, modifiers: self.modifiers };
        self.tools.pointer(&event, world, &mut self.camera)
    }

    /// A drag with the left button from one point of the world to another.
    fn drag(&mut self, world: &World, from: DVec2, to: DVec2) -> Vec<Command> {
        let mut commands = self.event(world, Phase::Press(Button::Left), from);
        commands.extend(self.event(world, Phase::Move, to));
        commands.extend(self.event(world, Phase::Release(Button::Left), to));
        commands
    }
}

#[test]
fn the_drag_tool_grips_a_body_and_draws_a_selection_box_on_empty_ground() {
    let mut world = World::new();
    let ball = add(&mut world, v(1.0, 1.0));
    let mut hand = Hand::with(Tool::Drag);
    match &hand.drag(&world, v(1.05, 1.0), v(2.0, 2.0))[..] {
        [Command::Grab { body, at }, Command::MoveGrip(target), Command::Release] => {
            assert_eq!(*body, ball);
            assert!(at.distance(v(1.05, 1.0)) < 1e-9 && target.distance(v(2.0, 2.0)) < 1e-9, "{at} {target}");
        }
        other => panic!("{other:?}"),
    }
    assert!(hand.tools.selection().is_empty(), "a drag does not select");
    assert!(hand.drag(&world, v(0.0, 0.0), v(2.0, 2.0)).is_empty());
    assert_eq!(hand.tools.selection(), [ball]);
    hand.drag(&world, v(-2.0, -2.0), v(-2.0, -2.0));
    assert!(hand.tools.selection().is_empty(), "a click on nothing selects nothing");
    hand.drag(&world, v(1.0, 1.0), v(1.0, 1.0));
    assert_eq!(hand.tools.selection(), [ball], "a click selects");
}

#[test]
fn a_rod_is_held_anywhere_along_it_and_led_so_that_the_place_follows_the_pointer() {
    let mut world = World::new();
    let (a, b) = (add(&mut world, v(-2.0, 0.0)), add(&mut world, v(2.0, 0.0)));
    let link = rod(&mut world, 4.0, a, b);
    let hook = add(&mut world, v(0.0, 2.0));
    let fixed = world.body(hook).expect("there");
    world.set_body(hook, &Body { motion: Motion::Static, ..fixed }).expect("valid");
    let hung = add(&mut world, v(3.0, 2.0));
    let hanger = world.add_constraint(&Constraint::between(Kind::Rope { length: 3.0 }, hook, hung)).expect("valid");
    for (press, held, end) in [
        (v(-0.5, 0.0), a, v(-2.0, 0.0)),
        (v(0.5, 0.0), b, v(2.0, 0.0)),
        // The nearer end is fixed: the other one is held.
        (v(0.5, 2.0), hung, v(3.0, 2.0)),
    ] {
        let mut hand = Hand::with(Tool::Drag);
        let target = press + v(0.3, 0.7);
        match &hand.drag(&world, press, target)[..] {
            [Command::Grab { body, at }, Command::MoveGrip(to), Command::Release] => {
                assert_eq!(*body, held, "{press}");
                assert!(at.distance(end) < 1e-9 && to.distance(target + end - press) < 1e-9, "{press}: {at} {to}");
            }
            other => panic!("{press}: {other:?}"),
        }
        assert!(hand.tools.selection().is_empty(), "a drag does not select");
    }
    let mut hand = Hand::with(Tool::Drag);
    hand.drag(&world, v(-0.5, 0.0), v(-0.5, 0.0));
    assert_eq!(hand.tools.selection(), [link], "a click selects the rod");
    // Both ends fixed: there is nothing to take hold of.
    let fixed = world.body(hung).expect("there");
    world.set_body(hung, &Body { motion: Motion::Static, ..fixed }).expect("valid");
    assert!(hand.drag(&world, v(0.5, 2.0), v(1.0, 3.0)).is_empty());
    hand.drag(&world, v(0.5, 2.0), v(0.5, 2.0));
    assert_eq!(hand.tools.selection(), [hanger]);
}

#[test]
fn a_rod_dragged_by_its_middle_comes_along_in_the_simulation() {
    let mut world = weightless();
    let (a, b) = (add(&mut world, v(-2.0, 0.0)), add(&mut world, v(2.0, 0.0)));
    rod(&mut world, 4.0, a, b);
    let session = start(world);
    let mut hand = Hand::with(Tool::Drag);
    let send = |commands: Vec<Command>| commands.into_iter().for_each(|command| session.send(command));
    send(hand.event(&session.frame().world, Phase::Press(Button::Left), v(-0.5, 0.0)));
    send(hand.event(&session.frame().world, Phase::Move, v(-0.5, 1.5)));
    wait_for(&session, "the end to follow", |f| position(f, a).distance(v(-2.0, 1.5)) < 0.05);
    let frame = session.frame();
    assert!((position(&frame, a).distance(position(&frame, b)) - 4.0).abs() < 0.05, "the other end is still on it");
    let (place, pointer) = hand.tools.rod_held(&frame.world).expect("it is held by a rod");
    assert_eq!(pointer, v(-0.5, 1.5));
    assert!((place.distance(position(&frame, a)) - 1.5).abs() < 0.05, "{place} is where the rod was grabbed");
    send(hand.event(&session.frame().world, Phase::Release(Button::Left), v(-0.5, 1.5)));
    wait_for(&session, "the hold to end", |f| f.world.grip().is_none());
    assert_eq!(hand.tools.rod_held(&session.frame().world), None);
}

#[test]
fn the_bob_of_a_point_mass_is_taken_hold_of_where_it_is_drawn() {
    let mut world = World::new();
    let point = |x: f64| Body { position: v(x, 0.0), radius: 0.0, ..Body::default() };
    let bob = world.add_body(&point(1.0)).expect("valid");
    let lone = world.add_body(&point(-1.0)).expect("valid");
    world.add_constraint(&Constraint::to_world(Kind::Rod { length: 1.0 }, bob, v(0.0, 0.0))).expect("valid");
    let sizes = Sizes::of(&world);
    let [of_bob, of_lone] = [bob, lone].map(|id| {
        let index = world.bodies().index_of(id).expect("there");
        sizes.radius(&world, index, camera().scale)
    });
    assert!(of_bob >= 2.0 * of_lone && of_lone > 0.0, "{of_bob} and {of_lone} points");
    // 1 m are 100 points: within the bob, the body; beyond it, the rod.
    let at = |points: f64| pick::pick(&world, &camera(), camera().to_canvas(v(1.0, 0.0)) - v(points, 0.0));
    assert_eq!(at(0.8 * of_bob), Some(bob));
    assert_ne!(at(of_bob + 12.0), Some(bob));
}

#[test]
fn a_slash_cuts_what_swings_away_before_it_is_let_go() {
    let mut world = World::new();
    let (a, b) = (add(&mut world, v(0.0, 1.0)), add(&mut world, v(0.0, -1.0)));
    world.add_constraint(&Constraint::between(Kind::Rod { length: 2.0 }, a, b)).unwrap();
    let mut hand = Hand::with(Tool::Cut);
    assert!(hand.event(&world, Phase::Press(Button::Left), v(-1.0, 0.0)).is_empty());
    assert!(matches!(hand.event(&world, Phase::Move, v(-0.5, 0.0))[..], [Command::Slash { first: true, .. }]));
    let [Command::Slash { from, to, first: false }] = hand.event(&world, Phase::Move, v(0.5, 0.0))[..] else {
        panic!("a piece of the slash");
    };
    assert!(from.distance(v(-0.5, 0.0)) < 1e-9 && to.distance(v(0.5, 0.0)) < 1e-9, "{from} {to}");
    assert_eq!(change(&mut world, Edit::Cut(from, to)).len(), 1, "the piece has met the rod");
    let [Command::Slash { from, to, first: false }] = hand.event(&world, Phase::Release(Button::Left), v(1.0, 0.0))[..]
    else {
        panic!("the whole slash, as it was drawn");
    };
    assert!(from.distance(v(-1.0, 0.0)) < 1e-9 && to.distance(v(1.0, 0.0)) < 1e-9, "{from} {to}");
}

#[test]
fn giving_up_a_hold_lets_go() {
    let mut world = World::new();
    add(&mut world, v(0.0, 0.0));
    let mut hand = Hand::with(Tool::Drag);
    hand.event(&world, Phase::Press(Button::Left), v(0.0, 0.0));
    assert!(matches!(hand.tools.escape()[..], [Command::Release]));
    hand.event(&world, Phase::Press(Button::Left), v(0.0, 0.0));
    assert!(matches!(hand.event(&world, Phase::Leave, v(0.0, 0.0))[..], [Command::Release]));
}

#[test]
fn the_right_button_pans_and_the_wheel_zooms_to_the_cursor() {
    let world = World::new();
    let mut hand = Hand::with(Tool::Drag);
    let under = hand.camera.to_world(v(100.0, 100.0));
    let event = |phase, canvas| PointerEvent { canvas, phase, modifiers: Modifiers::default() };
    hand.tools.pointer(&event(Phase::Press(Button::Right), v(100.0, 100.0)), &world, &mut hand.camera);
    hand.tools.pointer(&event(Phase::Move, v(300.0, 250.0)), &world, &mut hand.camera);
    hand.tools.pointer(&event(Phase::Release(Button::Right), v(300.0, 250.0)), &world, &mut hand.camera);
    // 1e-12: rounding of metres.
    assert!(hand.camera.to_world(v(300.0, 250.0)).distance(under) < 1e-12);
    hand.tools.wheel(&mut hand.camera, v(300.0, 250.0), 3.0);
    assert!(hand.camera.to_world(v(300.0, 250.0)).distance(under) < 1e-12);
    assert!((hand.camera.scale - 100.0 * 1.1f64.powi(3)).abs() < 1e-9);
}

#[test]
fn the_join_tool_joins_bodies_and_points_and_hangs_a_particle_between_two_points() {
    let mut world = World::new();
    let (a, b) = (add(&mut world, v(0.0, 0.0)), add(&mut world, v(2.0, 0.0)));
    let mut hand = Hand::with(Tool::Join(Join::Rod));
    match &hand.drag(&world, v(0.05, 0.0), v(2.0, 0.05))[..] {
        [Command::Edit(Edit::Join(joined))] => {
            assert_eq!(*joined, Constraint::between(Kind::Rod { length: 2.0 }, a, b));
        }
        other => panic!("{other:?}"),
    }
    match &hand.drag(&world, v(0.0, 0.0), v(0.0, 1.0))[..] {
        [Command::Edit(Edit::Join(joined))] => assert!(matches!(joined.b, Anchor::World(_)), "{joined:?}"),
        other => panic!("{other:?}"),
    }
    let hang = match &hand.drag(&world, v(-1.0, 1.0), v(-2.0, 1.0))[..] {
        [Command::Edit(hang @ Edit::Hang { .. })] => hang.clone(),
        other => panic!("{other:?}"),
    };
    let before = world.bodies().len();
    let mut hung = world.clone();
    assert_eq!(change(&mut hung, hang).len(), 2, "the particle and its rod");
    assert_eq!((hung.bodies().len(), hung.bodies().position[before]), (before + 1, v(-2.0, 1.0)));
    assert_eq!((hung.ends(0), hung.constraints().kind[0]), ((v(-2.0, 1.0), v(-1.0, 1.0)), Kind::Rod { length: 1.0 }));
    assert!(hand.drag(&world, v(-1.0, 1.0), v(-1.01, 1.0)).is_empty(), "a click between two points joins nothing");
    assert!(hand.drag(&world, v(0.0, 0.0), v(0.02, 0.0)).is_empty(), "both ends would be the same body");
}

#[test]
fn alt_joins_a_disc_at_the_exact_point() {
    let mut world = World::new();
    let disc = Body { spin: Some(Spin::default()), radius: 0.5, ..Body::default() };
    let disc = world.add_body(&disc).expect("valid");
    let mut hand = Hand::with(Tool::Join(Join::Rope));
    hand.modifiers.alt = true;
    match &hand.drag(&world, v(0.05, 0.0), v(2.0, 0.0))[..] {
        [Command::Edit(Edit::Join(Constraint { a: Anchor::Body(id, local), .. }))] => {
            assert_eq!(*id, disc);
            assert!(local.distance(v(0.05, 0.0)) < 1e-9, "{local}");
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn shift_snaps_to_centres_and_to_the_grid_and_turns_walls_by_15_degrees() {
    let mut world = World::new();
    add(&mut world, v(1.234, 1.0));
    let mut hand = Hand::with(Tool::Wall);
    hand.modifiers.shift = true;
    match &hand.drag(&world, v(1.30, 1.02), v(3.3, 1.1))[..] {
        [Command::Edit(Edit::AddWall(wall))] => {
            let (low, high) = wall.shape.bounds();
            assert_eq!(low, v(1.234, 1.0), "starts at the centre");
            assert!((high.y - 1.0).abs() < 1e-12, "was turned level: {high}");
        }
        other => panic!("{other:?}"),
    }
    let mut hand = Hand { tools: Hand::with(Tool::Spawn(Spawn::Particle)).tools, ..hand };
    let mut spawned_at = |alt: bool| {
        hand.modifiers.alt = alt;
        match &hand.event(&world, Phase::Press(Button::Left), v(-1.45, -2.1))[..] {
            [Command::Edit(Edit::Spawn { at, .. })] => *at,
            other => panic!("{other:?}"),
        }
    };
    // The grid is 0.5 m wide at 100 points a metre.
    assert!(spawned_at(false).distance(v(-1.5, -2.0)) < 1e-12);
    assert!(spawned_at(true).distance(v(-1.45, -2.1)) < 1e-9);
}

#[test]
fn no_two_actions_share_a_shortcut_and_every_tool_is_in_the_table() {
    let mut bound: Vec<keys::Shortcut> = Vec::new();
    for entry in keys::ENTRIES {
        for key in entry.shortcuts {
            assert!(!bound.contains(key), "{key} is bound twice");
            bound.push(*key);
        }
        assert!(entry.action.tooltip().ends_with(']'), "every action has a shortcut: {}", entry.name);
    }
    let zoom_out = Action::ZoomOut.entry().shortcuts[0];
    assert_eq!(
        (zoom_out.to_string(), Action::Slower.entry().shortcuts[0].to_string()),
        ("Ctrl-Minus".into(), "−".into())
    );
    let joins = [Join::Rod, Join::Spring, Join::Rope].map(Tool::Join);
    let others = [Tool::Drag, Tool::Select, Tool::Cut, Tool::Wall];
    for tool in joins.into_iter().chain(others).chain(Spawn::ALL.map(Tool::Spawn)) {
        assert!(!Action::Tool(tool).entry().help.is_empty());
    }
}

#[test]
fn a_changed_property_keeps_the_motion_since_it_was_read() {
    let mut world = World::new();
    let ball = world.add_body(&Body { velocity: v(1.0, 2.0), ..Body::default() }).unwrap();
    let read = world.body(ball).unwrap();
    world.set_body(ball, &Body { position: v(7.0, 8.0), ..read }).unwrap();
    let (from, to) = (Box::new(read), Box::new(Body { mass: 5.0, spin: Some(Spin::default()), ..read }));
    change(&mut world, Edit::ChangeBody { id: ball, from, to });
    let body = world.body(ball).unwrap();
    assert_eq!((body.position, body.velocity, body.mass), (v(7.0, 8.0), v(1.0, 2.0), 5.0));
    assert_eq!(body.spin, Some(Spin::default()));
}
