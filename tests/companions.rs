//! The worlds that follow the simulation: the truth and the rival.
#![cfg(feature = "desktop")]

use std::sync::Arc;
use std::time::{Duration, Instant};
use tautline::app::companion::{PARTED, Report, Standing, VISIBLE};
use tautline::app::laboratory::Stage;
use tautline::app::{Beside, Command, Companion, Edit, Frame, Session, Spawn, frame_after};
use tautline::app::{LabOrder, LabReport};
use tautline::engine::{Body, DVec2, Id, Integrator, Method, Wall, World};
use tautline::lab::ErrorKind;
use tautline::scene::{self, Setup};
use tautline::truth;

/// Long enough for a loaded machine; a test that waits this long has failed.
const PATIENCE: Duration = Duration::from_secs(60);

fn v(x: f64, y: f64) -> DVec2 {
    DVec2::new(x, y)
}

fn open(name: &str) -> Setup {
    scene::open(name).expect("a shipped scene")
}

fn start(setup: Setup) -> Session {
    Session::start(setup, || {}).expect("the system has room for a thread")
}

fn wait_for<T>(what: &str, found: impl Fn() -> Option<T>) -> T {
    let begin = Instant::now();
    loop {
        if let Some(found) = found() {
            return found;
        }
        assert!(begin.elapsed() < PATIENCE, "waited {PATIENCE:?} for {what}");
        std::thread::sleep(Duration::from_millis(2));
    }
}

fn at_tick(session: &Session, tick: u64) -> Arc<Frame> {
    wait_for("steps", || Some(session.frame()).filter(|frame| frame.world.tick() >= tick || frame.fault.is_some()))
}

fn pause(session: &Session) -> Arc<Frame> {
    session.send(Command::Run(false));
    wait_for("the pause", || Some(session.frame()).filter(|frame| !frame.running))
}

/// The report of a companion that has come as far as the frame.
fn caught_up(frame: &Frame, companion: impl Fn(&Frame) -> &Option<Companion>) -> Arc<Report> {
    let companion = companion(frame).as_ref().expect("it was asked for");
    wait_for("the companion", || Some(companion.report()).filter(|report| report.tick == frame.world.tick()))
}

fn rival(frame: &Frame) -> Arc<Report> {
    caught_up(frame, |frame| &frame.companions.rival)
}

fn truth_of(frame: &Frame) -> Arc<Report> {
    caught_up(frame, |frame| &frame.companions.truth)
}

#[test]
fn a_rival_under_the_same_method_has_the_same_bits_whatever_the_hands_do() {
    for name in ["bridge", "playground", "rope", "cloth"] {
        let setup = open(name);
        let method = setup.method;
        let session = start(setup);
        at_tick(&session, 5);
        // It begins in the middle of a run.
        session.send(Command::Rival(Some(method)));
        let frame = at_tick(&session, 12);
        let dynamic = |index: &usize| frame.world.is_dynamic(*index);
        let index = (0..frame.world.bodies().len()).filter(dynamic).nth(3).expect("some bodies move");
        let (body, at) = (frame.world.bodies().id[index], frame.world.bodies().position[index]);
        session.send(Command::Grab { body, at });
        for i in 1..10 {
            session.send(Command::MoveGrip(at + v(0.05, 0.04) * f64::from(i)));
            at_tick(&session, 12 + 2 * i as u64);
        }
        session.send(Command::Edit(Edit::Spawn { kind: Spawn::Rope, at: at + v(0.0, 1.0), size: 0.05 }));
        session.send(Command::Edit(Edit::Cut(at - v(5.0, 0.013), at + v(5.0, 0.017))));
        session.send(Command::Release);
        session.send(Command::Gravity(v(1.0, -7.0)));
        session.send(Command::Method(Method { hz: 90.0, ..method }));
        session.send(Command::Edit(Edit::Pin(vec![body], true)));
        let frame = session.frame();
        at_tick(&session, frame.world.tick() + 20);
        let frame = pause(&session);
        assert_eq!(frame.fault, None, "{name}");
        let report = rival(&frame);
        assert_eq!(report.standing, Standing::Following, "{name}");
        let other = report.frame.as_ref().expect("a rival has a picture");
        assert_eq!(other.world.hash(), frame.world.hash(), "{name}");
        assert_eq!(other.world, frame.world, "{name}");
        let gap = report.gap.expect("compared");
        assert_eq!((gap.max, report.so_far, report.parting), (0.0, 0.0, None), "{name}");
    }
}

#[test]
fn the_distance_of_an_untouched_run_is_that_from_the_stored_truth() {
    let setup = open("truth/pendulum");
    let frame = frame_after(setup, 3.0, &Beside { truth: true, rival: None });
    let report = truth_of(&frame);
    let known = truth::stored("truth/pendulum").expect("stored");
    assert_eq!(report.standing, Standing::Exact { error: known.agreement });
    // 3 s are 180 samples.
    let squares = known.positions[180].iter().zip(&frame.world.bodies().position);
    let square = squares.map(|(a, b)| (*a - *b).length_squared()).sum::<f64>() / 2.0;
    let gap = report.gap.expect("3 s are a sample");
    println!("pendulum as it opens: {:.3e} m RMS, {:.3e} m max after 3 s", gap.rms, gap.max);
    assert!((gap.rms - square.sqrt()).abs() < 1e-15 && gap.rms > 1e-6, "{}", gap.rms);
    assert_eq!(report.length, 1.0);
    assert_eq!(report.offsets.shift[1], known.positions[180][1] - frame.world.bodies().position[1]);
}

#[test]
fn a_run_by_accuracy_is_as_near_to_the_computed_reference_as_to_the_truth() {
    // The same scene under a name that nothing is stored for.
    let known = truth::stored("truth/rope").expect("stored");
    let setup = open("truth/rope");
    let method = Method { automatic: true, accuracy: 1e-6, ..setup.method };
    let setup = Setup { name: "mine".into(), method, ..setup };
    let frame = frame_after(setup, 1.0, &Beside { truth: true, rival: None });
    let report = truth_of(&frame);
    let Standing::Converged { to } = report.standing else { panic!("{:?}", report.standing) };
    let gap = report.gap.expect("compared");
    let pairs = known.positions[60].iter().zip(&frame.world.bodies().position);
    let count = frame.world.bodies().len() as f64;
    let exact = (pairs.map(|(a, b)| (*a - *b).length_squared()).sum::<f64>() / count).sqrt();
    println!(
        "rope by 1e-6 after 1 s: {exact:.3e} m from the truth, {:.3e} m from the reference, converged to {to:.1e}",
        gap.rms
    );
    // What it says of itself covers what it is off by, with a factor of two for chance.
    assert!((gap.rms - exact).abs() <= 2.0 * gap.uncertainty, "{} and {exact}, ± {}", gap.rms, gap.uncertainty);
    assert!(to < 1e-6, "{to}");
}

#[test]
fn a_touched_run_is_followed_by_a_reference_from_the_same_start() {
    let setup = open("truth/pendulum");
    let method = Method { automatic: true, accuracy: 1e-9, ..setup.method };
    let session = start(Setup { method, ..setup });
    session.send(Command::Truth(true));
    let frame = at_tick(&session, 20);
    session.send(Command::Gravity(v(0.0, -3.0)));
    at_tick(&session, frame.world.tick() + 30);
    let frame = pause(&session);
    let report = truth_of(&frame);
    let Standing::Converged { to } = report.standing else { panic!("{:?}", report.standing) };
    let gap = report.gap.expect("compared");
    println!("a pendulum under another gravity: {:.1e} m off, converged to {to:.1e}", gap.rms);
    // The reference began where it was asked for, in the first steps of the run, so it carries the run's error before the touch too;
    // wanted were 1e-9 a second.
    assert!(gap.rms < 1e-7 && to < 1e-7 && report.since < 0.2, "{report:?}");
    session.send(Command::Restart);
    let fresh = wait_for("the restart", || Some(session.frame()).filter(|frame| frame.world.tick() == 0));
    let report = truth_of(&fresh);
    assert!(matches!(report.standing, Standing::Exact { .. } | Standing::Waiting), "{:?}", report.standing);
    // What is known costs nothing and stays.
    session.send(Command::Truth(false));
    session.send(Command::Run(true));
    at_tick(&session, 5);
    let report = truth_of(&pause(&session));
    assert!(matches!(report.standing, Standing::Exact { .. }), "{:?}", report.standing);
}

#[test]
fn a_scene_whose_motion_is_known_is_compared_without_being_asked_until_it_is_changed() {
    for name in ["truth/rope", "hard/pendulum"] {
        let session = start(open(name));
        at_tick(&session, 20);
        let frame = pause(&session);
        let report = truth_of(&frame);
        assert!(matches!(report.standing, Standing::Exact { .. }), "{name}: {:?}", report.standing);
        assert!(report.gap.is_some_and(|gap| gap.rms > 0.0), "{name}");
        session.send(Command::Gravity(v(0.0, -3.0)));
        wait_for("the other gravity", || Some(session.frame()).filter(|frame| frame.world.gravity().y == -3.0));
        session.send(Command::StepOnce);
        let frame = at_tick(&session, frame.world.tick() + 1);
        // Nothing is computed that was not asked for.
        let report = truth_of(&frame);
        assert!(matches!(report.standing, Standing::Over { touched: true, .. }), "{name}: {:?}", report.standing);
        assert!(report.gap.is_none() && report.offsets.bodies.is_empty(), "{name}");
        session.send(Command::Truth(true));
        session.send(Command::StepOnce);
        let frame = at_tick(&session, frame.world.tick() + 1);
        let report = truth_of(&frame);
        assert!(matches!(report.standing, Standing::Converged { .. }), "{name}: {:?}", report.standing);
        session.send(Command::Open("bridge".into()));
        session.send(Command::Truth(false));
        wait_for("no truth", || {
            Some(session.frame()).filter(|f| f.scene.name == "bridge" && f.companions.truth.is_none())
        });
        session.send(Command::Undo);
        wait_for("the truth again", || Some(session.frame()).filter(|f| f.companions.truth.is_some()));
    }
}

#[test]
fn where_what_is_known_ends_the_error_until_then_is_kept() {
    let setup = open("truth/rope");
    let seconds = setup.truth.expect("it has a truth").seconds;
    let frame = frame_after(setup, seconds + 0.25, &Beside::default());
    let report = truth_of(&frame);
    let Standing::Over { after, touched: false } = report.standing else { panic!("{:?}", report.standing) };
    // The first step beyond the last sample, 1/60 s later at most.
    assert!(after > seconds && after < seconds + 0.02, "{after}");
    println!("exact rope as it opens: {:.3e} m RMS over its {seconds} s", report.so_far);
    assert!(report.so_far > 0.0);
}

/// Balls that hit each other in a box.
fn billiards() -> Setup {
    let mut world = World::new();
    world.set_gravity(DVec2::ZERO).expect("zero is valid");
    for i in 0..9 {
        let (x, y) = (f64::from(i % 3), f64::from(i / 3));
        let velocity = v(3.0 - 1.7 * x, 2.0 * y - 1.0 + 0.3 * x);
        let ball =
            Body { position: v(x, y), velocity, radius: 0.3, restitution: 1.0, friction: 0.0, ..Body::default() };
        world.add_body(&ball).expect("a good body");
    }
    for (from, to) in [
        (v(-1.0, -1.0), v(3.0, -1.0)),
        (v(3.0, -1.0), v(3.0, 3.0)),
        (v(3.0, 3.0), v(-1.0, 3.0)),
        (v(-1.0, 3.0), v(-1.0, -1.0)),
    ] {
        let shape = tautline::engine::Shape::Segment { from, to };
        world.add_wall(&Wall { shape, restitution: 1.0, friction: 0.0 }).expect("a good wall");
    }
    Setup { name: "billiards".into(), world, truth: None, pass: None, ..open("pendulum") }
}

#[test]
fn where_neighbouring_motions_part_there_is_no_reference_any_more() {
    let frame = frame_after(billiards(), 30.0, &Beside { truth: true, rival: None });
    let report = truth_of(&frame);
    let Standing::Parted { after, .. } = report.standing else { panic!("{:?}", report.standing) };
    println!("billiards: no reference after {after:.2} s");
    assert!(after > 0.1 && after < 30.0);
    assert!(report.gap.is_none() && report.offsets.bodies.is_empty(), "a ghost of nothing must not be drawn");
    // The truth is given up before the simulation would seem to leave it by itself.
    const { assert!(PARTED < VISIBLE) };
}

#[test]
fn two_methods_part_at_a_moment_that_is_kept() {
    let setup = open("truth/double_pendulum");
    let by = Method { automatic: true, accuracy: 1e-9, ..setup.method };
    let euler = Method { integrator: Integrator::ExplicitEuler, substeps: 1, automatic: false, ..setup.method };
    let frame = frame_after(Setup { method: euler, ..setup }, 3.0, &Beside { truth: false, rival: Some(by) });
    let report = rival(&frame);
    let parting = report.parting.expect("explicit Euler leaves the motion within three seconds");
    println!("explicit Euler parts at {:.2} s: {} from {}", parting.time, parting.here, parting.there);
    let apart = parting.here.distance(parting.there);
    // The first step at which it is seen: beyond the limit, and not by much.
    assert!(apart > VISIBLE * report.length && apart < 3.0 * VISIBLE * report.length, "{apart}");
    assert!(parting.time > 0.0 && parting.time <= 3.0 && parting.body != Id(0));
    let other = report.frame.as_ref().expect("a picture");
    assert_eq!(other.world.time(), frame.world.time());
    assert!(other.method.automatic && !frame.method.automatic);
}

#[test]
fn a_rivals_method_can_be_changed_and_a_bad_one_is_refused() {
    let setup = open("rope");
    let method = setup.method;
    let session = start(setup);
    session.send(Command::Rival(Some(Method { substeps: 0, ..method })));
    let frame = wait_for("the fault", || Some(session.frame()).filter(|frame| frame.fault.is_some()));
    assert!(frame.companions.rival.is_none());
    session.send(Command::DismissFault);
    session.send(Command::Rival(Some(method)));
    session.send(Command::Rival(Some(Method { substeps: 2, ..method })));
    wait_for("two substeps", || {
        let frame = session.frame();
        let report = frame.companions.rival.as_ref()?.report();
        report.frame.as_ref().filter(|frame| frame.method.substeps == 2).map(drop)
    });
    session.send(Command::Rival(None));
    wait_for("the rival to go", || Some(session.frame()).filter(|frame| frame.companions.rival.is_none()));
}

#[test]
fn a_simulation_is_the_same_with_companions_and_without() {
    let run = |beside| frame_after(open("playground"), 2.0, &beside).world.hash();
    let method = open("playground").method;
    let alone = run(Beside::default());
    assert_eq!(run(Beside { truth: true, rival: Some(Method { substeps: 1, ..method }) }), alone);
}

fn lab_when(session: &Session, what: &str, wanted: impl Fn(&LabReport) -> bool) -> Arc<LabReport> {
    wait_for(what, || Some(session.frame().lab.report()).filter(|report| wanted(report)))
}

#[test]
fn the_lab_measures_beside_the_simulation_and_is_stopped_resumed_and_written() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let session = start(open("truth/pendulum"));
    session.send(Command::Lab(LabOrder::Start));
    let tick = session.frame().world.tick();
    let first = lab_when(&session, "points", |report| report.points.len() >= 3);
    assert_eq!((first.stage.clone(), first.scene.as_str()), (Stage::Measuring, "truth/pendulum"));
    assert!(first.points.iter().all(|point| point.error_kind == ErrorKind::Stored), "{:?}", first.points);
    at_tick(&session, tick + 10);
    session.send(Command::Lab(LabOrder::Stop));
    let stopped = lab_when(&session, "the stop", |report| report.stage == Stage::Stopped);
    let count = stopped.points.len();
    for (ending, line) in [("csv", "scene,method,hz"), ("jsonl", "{\"scene\":\"truth/pendulum\""), ("svg", "<svg")] {
        let path = folder.path().join(format!("lab.{ending}"));
        session.send(Command::Lab(LabOrder::Export(path.clone())));
        lab_when(&session, "the file", |report| report.saved == Some(path.display().to_string()));
        let text = std::fs::read_to_string(&path).expect("it was written");
        assert!(text.starts_with(line), "{text}");
        assert!(ending != "jsonl" || text.lines().count() == count);
    }
    // A report of this session is written anew, another file is not replaced.
    session.send(Command::Lab(LabOrder::Export(folder.path().join("lab.csv"))));
    let diary = folder.path().join("diary.csv");
    std::fs::write(&diary, "dear diary").expect("a file");
    session.send(Command::Lab(LabOrder::Export(diary.clone())));
    let frame = wait_for("the fault", || Some(session.frame()).filter(|frame| frame.fault.is_some()));
    let fault = frame.fault.as_deref().expect("there is one");
    assert!(fault.contains("diary.csv is there already"), "{fault}");
    assert_eq!(std::fs::read_to_string(&diary).expect("the file"), "dear diary");
    session.send(Command::DismissFault);
    wait_for("no fault", || Some(session.frame()).filter(|frame| frame.fault.is_none()));
    session.send(Command::Lab(LabOrder::Export(folder.path().join("no/such/folder.csv"))));
    let frame = wait_for("the fault", || Some(session.frame()).filter(|frame| frame.fault.is_some()));
    assert!(frame.fault.as_deref().is_some_and(|fault| fault.contains("no such folder")), "{:?}", frame.fault);
    session.send(Command::DismissFault);
    session.send(Command::Lab(LabOrder::Resume));
    let resumed = lab_when(&session, "more points", |report| report.points.len() > count);
    assert_eq!(resumed.points[..count], stopped.points[..], "what was measured is kept");
    session.send(Command::Lab(LabOrder::Stop));
    lab_when(&session, "the stop", |report| report.stage == Stage::Stopped);
}

#[test]
fn a_scene_that_was_changed_is_measured_against_a_refined_run() {
    let session = start(open("truth/double_pendulum"));
    session.send(Command::Gravity(v(0.0, -2.0)));
    wait_for("the gravity", || Some(session.frame()).filter(|frame| frame.world.gravity().y == -2.0));
    session.send(Command::Lab(LabOrder::Start));
    let report = lab_when(&session, "a point", |report| !report.points.is_empty());
    println!("errors against: {}", report.reference);
    assert!(report.points.iter().all(|point| matches!(point.error_kind, ErrorKind::Converged(_))), "{report:?}");
    session.send(Command::Lab(LabOrder::Stop));
    lab_when(&session, "the stop", |report| report.stage == Stage::Stopped);
}

#[test]
fn the_truth_says_when_the_motion_itself_lets_errors_grow() {
    let pendulum = |y: f64| {
        let bob = format!("bodies: [Particle(name: \"bob\", position: (0, {y}), radius: 0)]");
        let text = format!("(version: 1, {bob}, constraints: [Rod(a: (0, 0), b: \"bob\")])");
        scene::parse("pendulum.ron", &text).expect("a sound scene")
    };
    let growth = |y: f64| {
        let session = start(pendulum(y));
        session.send(Command::Truth(true));
        at_tick(&session, 120);
        truth_of(&pause(&session)).growth.clone()
    };
    // sinh(2 s √(9.81/s²)) is 262; the pause comes a step or more later.
    let fold = growth(1.0).expect("it stands on its head");
    let factor: f64 = fold.strip_suffix("-fold").and_then(|factor| factor.parse().ok()).expect("a factor");
    assert!(factor > 200.0, "{fold}");
    assert_eq!(growth(-1.0), None, "it hangs");
}
