//! The passes that scenes carry themselves: what the window shows beside their names.

use tautline::engine::Method;
use tautline::scene::{self, Setup};
use tautline::trial::{self, State};

/// Runs a scene's trial and prints its lines.
fn try_scene(setup: &Setup) {
    let verdict = trial::run(setup).unwrap().unwrap();
    for line in &verdict.lines {
        println!(
            "{}: {} {:.1e}, wanted {:e} {}",
            setup.name,
            line.limit.name(),
            line.value,
            line.limit.bound(),
            line.limit.unit()
        );
    }
    assert_eq!(verdict.state, State::Passed, "{}: {verdict:?}", setup.name);
}

#[test]
fn every_hard_scene_keeps_its_own_pass_as_it_opens() {
    for shipped in scene::hard_scenes() {
        let setup = scene::open(shipped.name).unwrap();
        assert!(setup.pass.is_some(), "{} has no pass", shipped.name);
        assert_eq!(shipped.pass(), setup.pass.as_ref());
        try_scene(&setup);
    }
}

#[test]
fn every_truth_scene_keeps_its_pass_by_accuracy() {
    for shipped in scene::truth_scenes() {
        let setup = scene::open(shipped.name).unwrap();
        let method = Method { automatic: true, accuracy: 1e-6, ..setup.method };
        try_scene(&Setup { method, ..setup });
    }
}

#[test]
fn a_run_that_breaks_a_limit_fails_and_goes_on_to_be_measured() {
    // One sweep a step: the rods of the heavy rope are stretched from the first step on.
    let setup = scene::open("hard/heavy_rope").unwrap();
    let method = Method { automatic: false, substeps: 1, iterations: 1, ..setup.method };
    let setup = Setup { method, ..setup };
    let (mut world, mut trial) = (setup.world.clone(), trial::Trial::of(&setup).unwrap());
    let mut stepper = tautline::engine::Stepper::new(method).unwrap();
    for step in 1..=200 {
        let report = stepper.step(&mut world);
        if report.divergence.is_some() {
            break;
        }
        trial.observe(&world, &tautline::measure::Measures::of(&world), &report);
        assert_eq!(trial.verdict().state, State::Failed);
        // Three seconds are 180 steps; what comes later is not part of it.
        assert_eq!(trial.verdict().time, world.time().min(3.0), "step {step}");
    }
}
