//! The accuracy dial on the truth scenes: what is asked for is kept, and a finer accuracy is never worse.

use tautline::engine::{Method, Stepper};
use tautline::measure::error_against;
use tautline::scene;
use tautline::truth::stored;

/// RMS distance from the truth in parts of the scene's length, by accuracy.
fn error(name: &str, accuracy: f64) -> f64 {
    let truth = stored(name).unwrap();
    let mut world = scene::open(name).unwrap().world;
    let mut stepper = Stepper::new(Method { automatic: true, accuracy, ..Method::default() }).unwrap();
    let mut motion = vec![world.bodies().position.clone()];
    for _ in 1..truth.times.len() {
        let report = stepper.step(&mut world);
        assert!(report.divergence.is_none() && report.given_up == 0, "{name}: {report:?}");
        assert_eq!(report.lapsed, 0, "{name}, wanted {accuracy:e}: {report:?}");
        motion.push(world.bodies().position.clone());
    }
    error_against(&truth.positions, &motion, truth.length).unwrap()
}

#[test]
fn every_truth_scene_is_kept_at_every_accuracy_and_finer_is_never_worse() {
    for shipped in scene::truth_scenes() {
        let mut least = f64::INFINITY;
        for accuracy in [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13] {
            let found = error(shipped.name, accuracy);
            println!("{}, wanted {accuracy:.0e}: {found:.1e}", shipped.name);
            // Local control cannot know how errors are carried on; that it is off by much would be a fault.
            assert!(found <= 2.0 * accuracy, "{}, wanted {accuracy:e}: {found:e}", shipped.name);
            assert!(found <= 1.1 * least || found < 1e-13, "{}, wanted {accuracy:e}: {found:e}", shipped.name);
            least = least.min(found);
        }
    }
}
