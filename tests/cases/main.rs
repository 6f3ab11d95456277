//! Motions on which a method went wrong, one a file: a scene NAME.ron and its converged motion NAME.truth beside it, of the form of those under
//! `scenes/truth` (`tautline truth NAME.ron --write tests/cases` makes it). A new case needs no more than these two files.

mod energy;
mod held;

use std::path::{Path, PathBuf};
use tautline::engine::{Method, Stepper};
use tautline::measure::error_against;
use tautline::scene;
use tautline::truth::{Trajectory, from_bytes};

/// All scenes of this folder that have a motion beside them, in the order of their names.
fn cases() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
    let files = std::fs::read_dir(folder).expect("the folder of the cases").map(|entry| entry.unwrap().path());
    let mut cases: Vec<_> = files.filter(|file| file.extension().is_some_and(|kind| kind == "truth")).collect();
    cases.sort();
    cases
}

/// RMS distance of the scene's motion by accuracy from the truth, in parts of its length, and in how many steps something was given up.
fn run(scene: &Path, truth: &Trajectory, accuracy: f64) -> (f64, usize) {
    let mut world = scene::open(scene).unwrap().world;
    let mut stepper = Stepper::new(Method { automatic: true, accuracy, ..Method::default() }).unwrap();
    let (mut motion, mut given_up) = (vec![world.bodies().position.clone()], 0);
    for _ in 1..truth.times.len() {
        let report = stepper.step(&mut world);
        assert!(report.divergence.is_none(), "{}: {}", scene.display(), report.divergence.unwrap());
        given_up += report.given_up;
        motion.push(world.bodies().position.clone());
    }
    (error_against(&truth.positions, &motion, truth.length).unwrap(), given_up)
}

#[test]
fn every_case_is_kept_at_every_accuracy() {
    let cases = cases();
    assert!(cases.len() >= 5, "the cases are found");
    let mut wrong = Vec::new();
    for file in cases {
        let (scene, truth) = (file.with_extension("ron"), from_bytes(&std::fs::read(&file).unwrap()).unwrap());
        // Converged far beyond what is asked for, or all of this says nothing.
        assert!(truth.agreement < 1e-13, "{}: {:e}", file.display(), truth.agreement);
        let mut coarser = f64::INFINITY;
        for accuracy in [1e-3, 1e-6, 1e-9, 1e-12] {
            let (error, given_up) = run(&scene, &truth, accuracy);
            let name = file.file_stem().unwrap().to_string_lossy();
            println!("{name}, wanted {accuracy:.0e}: error {error:.1e}, {given_up} given up");
            // Finer is never worse.
            if !(error <= 10.0 * accuracy && error <= 1.1 * coarser) || given_up > 0 {
                wrong.push(format!("{name}, wanted {accuracy:e}: {error:e}, {given_up} given up"));
            }
            coarser = error;
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
