//! Sweeps: what they measure, in which order, stopped and resumed.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use tautline::engine::{Integrator, Solver};
use tautline::lab::{ErrorKind, Family, Outcome, Point, Reference, Setting, Skip, Sweep, SweepOptions, rate_fits};
use tautline::scene;

/// Methods that are quick on any scene here, and time enough on a loaded machine.
fn options(families: &[Family]) -> SweepOptions {
    SweepOptions {
        families: families.to_vec(),
        run_limit: Duration::from_secs(5),
        budget: Duration::from_secs(300),
        ..SweepOptions::default()
    }
}

fn sweep(name: &str, seconds: f64, options: SweepOptions) -> Sweep {
    let setup = scene::open(name).unwrap();
    let reference = Reference::known(&setup).map(|known| Arc::new(known.until(seconds)));
    Sweep::new(name, &setup.world, setup.method, seconds, reference, options)
}

/// Runs it to its end; what was skipped.
fn finish(sweep: &mut Sweep) -> Vec<(Setting, Skip)> {
    let mut skipped = Vec::new();
    loop {
        match sweep.advance(&AtomicBool::new(false)) {
            Outcome::Finished => return skipped,
            Outcome::Skipped(setting, why) => skipped.push((setting, why)),
            Outcome::Point(_) => {}
            Outcome::Cancelled => panic!("nobody cancelled"),
        }
    }
}

/// All but the costs, which no two runs share.
fn figures(points: &[Point]) -> Vec<(Setting, Option<f64>, f64, f64)> {
    points.iter().map(|point| (point.setting(), point.error, point.violation_max, point.energy_drift)).collect()
}

const QUICK: [Family; 3] =
    [Family::Dial, Family::Direct(Integrator::Rattle), Family::Substepped(Integrator::SemiImplicitEuler, Solver::Pgs)];

#[test]
fn errors_are_those_of_runs_by_hand_and_come_in_the_same_order_every_time() {
    let mut one = sweep("truth/double_pendulum", 0.5, options(&QUICK));
    let mut other = one.clone();
    let skipped = finish(&mut one);
    finish(&mut other);
    assert_eq!(figures(one.points()), figures(other.points()));
    assert_eq!(one.points()[0].setting(), Setting::BASELINE);
    let total = one.points().len() + skipped.len();
    assert_eq!((one.progress().done, one.progress().total, one.progress().seconds_left), (total, total, 0.0));
    // A run by hand, straight from the engine.
    let setup = scene::open("truth/double_pendulum").unwrap();
    let truth = tautline::truth::stored("truth/double_pendulum").unwrap();
    for point in one.points().iter().filter(|point| point.hz == 60.0) {
        let mut world = setup.world.clone();
        let mut stepper = tautline::engine::Stepper::new(point.setting().method(setup.method)).unwrap();
        let mut motion = vec![world.bodies().position.clone()];
        for _ in 0..30 {
            stepper.step(&mut world);
            motion.push(world.bodies().position.clone());
        }
        let error = tautline::measure::error_against(&truth.positions[..31], &motion, truth.length);
        assert_eq!(point.error, error, "{:?}", point.setting());
    }
    for point in one.points() {
        println!("{}: {:.1e} at {:.0} µs/s", point.setting().label(), point.error.unwrap(), point.cpu_us_per_second);
        assert!(point.cpu_us_per_second > 0.0 && point.error_kind == ErrorKind::Stored);
    }
}

#[test]
fn errors_fall_with_the_order_of_the_method_along_its_knob() {
    let mut rattle = sweep("truth/double_pendulum", 1.0, options(&[Family::Direct(Integrator::Rattle)]));
    finish(&mut rattle);
    let error = |substeps| {
        let setting = Setting::direct(Integrator::Rattle, substeps);
        rattle.points().iter().find(|point| point.setting() == setting).unwrap().error.unwrap()
    };
    let order = (error(8) / error(32)).log2() / 2.0;
    println!("RATTLE: order {order:.2}");
    assert!((order - 2.0).abs() < 0.1, "{order}");
    // A coarse rate meets every second sample of the truth.
    let slow = rattle.points().iter().find(|point| point.hz == 30.0).unwrap();
    assert!(slow.error.unwrap() > error(1));
}

#[test]
fn a_cancelled_sweep_goes_on_where_it_was() {
    let whole = {
        let mut sweep = sweep("truth/rope", 0.5, options(&QUICK));
        finish(&mut sweep);
        sweep
    };
    let cancelled = AtomicBool::new(true);
    let mut sweep = sweep("truth/rope", 0.5, options(&QUICK));
    for _ in 0..3 {
        assert!(matches!(sweep.advance(&AtomicBool::new(false)), Outcome::Point(_)));
    }
    assert_eq!(sweep.advance(&cancelled), Outcome::Cancelled);
    assert_eq!((sweep.points().len(), sweep.progress().done), (3, 3), "nothing is lost, nothing is skipped");
    finish(&mut sweep);
    assert_eq!(figures(sweep.points()), figures(whole.points()));
}

#[test]
fn a_cancel_is_heard_within_a_step() {
    let setup = scene::open("hard/joint_grid").unwrap();
    let cancel = Arc::new(AtomicBool::new(false));
    let mut sweep = Sweep::new("grid", &setup.world, setup.method, 1e4, None, options(&Family::ALL));
    let worker = std::thread::spawn({
        let cancel = cancel.clone();
        move || sweep.advance(&cancel)
    });
    std::thread::sleep(Duration::from_millis(300));
    cancel.store(true, Ordering::Relaxed);
    assert_eq!(worker.join().unwrap(), Outcome::Cancelled);
}

#[test]
fn what_was_measured_before_is_not_measured_again() {
    let mut whole = sweep("truth/rope", 0.5, options(&QUICK));
    finish(&mut whole);
    let before: Vec<Point> = whole.points()[..5].to_vec();
    let mut resumed = sweep("truth/rope", 0.5, options(&QUICK));
    // Points of other scenes are none of its business.
    let stray = Point { scene: "truth/bridge".to_owned(), ..before[0].clone() };
    resumed.resume(before.iter().cloned().chain([stray]));
    finish(&mut resumed);
    assert_eq!(figures(resumed.points()), figures(whole.points()));
    let costs = |points: &[Point]| points.iter().map(|point| point.cpu_us_per_second).collect::<Vec<_>>();
    assert_eq!(costs(&resumed.points()[..5]), costs(&before), "the costs of then, to the bit");
}

#[test]
fn what_a_scene_cannot_take_and_knobs_without_effect_are_left_out() {
    // Springs and rods: no Nyström method; nothing to sweep over where nothing is joined.
    let nystrom = [Family::Direct(Integrator::Nystrom4), Family::Direct(Integrator::Nystrom6)];
    let mut rope = sweep("truth/rope", 0.2, options(&nystrom));
    let skipped = finish(&mut rope);
    assert!(rope.points().is_empty() && skipped.iter().all(|(_, why)| *why == Skip::NotTaken));
    let free = scene::parse("free", "(version: 1, bodies: [Particle(velocity: (3, 4), radius: 0)])").unwrap();
    let verlet = Family::Substepped(Integrator::VelocityVerlet, Solver::Pgs);
    let mut flight = Sweep::new("free", &free.world, free.method, 0.5, None, options(&[verlet]));
    let skipped = finish(&mut flight);
    let of = |substeps, iterations| Setting::substepped(Integrator::VelocityVerlet, Solver::Pgs, substeps, iterations);
    assert!(skipped.contains(&(of(4, 10), Skip::Same)), "{skipped:?}");
    assert!(flight.points().iter().any(|point| point.setting() == of(4, 1)));
    assert!(flight.points().iter().all(|point| point.error.is_none() && point.error_kind == ErrorKind::None));
}

#[test]
fn what_is_too_slow_is_left_out_with_all_that_costs_more() {
    let limited = SweepOptions { run_limit: Duration::from_micros(1), ..options(&QUICK) };
    let mut sweep = sweep("truth/rope", 1.5, limited);
    let skipped = finish(&mut sweep);
    assert!(sweep.points().is_empty() && skipped.iter().all(|(_, why)| *why == Skip::TooSlow), "{skipped:?}");
}

#[test]
fn a_spent_budget_ends_a_sweep() {
    let mut sweep = sweep("truth/rope", 1.5, SweepOptions { budget: Duration::ZERO, ..options(&QUICK) });
    assert_eq!(sweep.advance(&AtomicBool::new(false)), Outcome::Finished);
    assert_eq!(sweep.progress().seconds_left, 0.0);
}

#[test]
fn a_run_that_diverges_is_a_point_without_an_error() {
    // Falls at a million m/s² from just below the largest speed that a world accepts: reached after a second.
    let text = r#"(version: 1, settings: (gravity: (0, -1e6)), bodies: [Particle(velocity: (0, -9.9e7))])"#;
    let wild = scene::parse("wild", text).unwrap();
    let euler = Family::Substepped(Integrator::SemiImplicitEuler, Solver::Pgs);
    let mut sweep = Sweep::new("wild", &wild.world, wild.method, 3.0, None, options(&[euler]));
    finish(&mut sweep);
    let point = &sweep.points()[0];
    assert_eq!((point.error, point.error_kind), (None, ErrorKind::Diverged));
    assert!(point.cpu_us_per_second > 0.0 && point.energy_drift.is_finite());
}

#[test]
fn rates_meet_the_samples_or_are_refused() {
    for good in [60.0, 120.0, 99_960.0, 30.0, 20.0, 12.0, 1.0] {
        assert!(rate_fits(good), "{good}");
    }
    for wrong in [0.0, 0.5, 7.0, 59.0, 90.0, 100.0, 1e6, f64::NAN, f64::INFINITY, -60.0] {
        assert!(!rate_fits(wrong), "{wrong}");
    }
}
