//! The same bits in every run, thread count and build. `tests/hashes.txt` holds one hash for each shipped scene; after an
//! intended change of the physics write it anew with `TAUTLINE_WRITE_HASHES=1 cargo test --test determinism`.

use std::fmt::Write;
use std::path::Path;
use tautline::engine::{Integrator, Method, Solver, Stepper, World};
use tautline::scene;

/// Ten seconds at 60 Hz.
const STEPS: u32 = 600;

fn advance(world: &mut World, method: Method, steps: u32) {
    let mut stepper = Stepper::new(method).unwrap();
    (0..steps).for_each(|_| assert!(stepper.step(world).divergence.is_none()));
}

/// Hashes half-way and at the end of a scene, under its method with these changes.
fn hashes(name: &str, change: impl Fn(Method) -> Method, steps: u32) -> [u64; 2] {
    let setup = scene::open(name).unwrap();
    let mut world = setup.world;
    let mut stepper = Stepper::new(change(setup.method)).unwrap();
    let mut half = 0;
    for step in 0..steps {
        assert!(stepper.step(&mut world).divergence.is_none());
        if step + 1 == steps / 2 {
            half = world.hash();
        }
    }
    [half, world.hash()]
}

/// What carries islands whole.
const DIRECT: [Integrator; 8] = [
    Integrator::Taylor,
    Integrator::EnergyMomentum,
    Integrator::Rattle,
    Integrator::RungeKutta4,
    Integrator::Nystrom4,
    Integrator::Nystrom6,
    Integrator::Radau3,
    Integrator::Radau5,
];

/// Both hashes of all shipped scenes, and of those with a truth as islands, computed one after another.
fn all_hashes() -> Vec<(String, [u64; 2])> {
    let mut found: Vec<_> = scene::shipped()
        .iter()
        .map(|scene| (scene.name.to_owned(), hashes(scene.name, |method| method, STEPS)))
        .collect();
    for integrator in DIRECT {
        for scene in scene::truth_scenes() {
            let hashes = hashes(scene.name, |method| Method { integrator, ..method }, 30);
            found.push((format!("{} {}", scene.name, integrator.key()), hashes));
        }
    }
    found
}

#[test]
fn two_threads_at_once_and_every_build_find_the_committed_hashes() {
    // Two runs of everything, on two threads at the same time.
    let other = std::thread::spawn(all_hashes);
    let found = all_hashes();
    assert_eq!(found, other.join().unwrap(), "two threads differ");
    let mut table = String::new();
    for (name, [half, end]) in &found {
        writeln!(table, "{name} {half:016x} {end:016x}").unwrap();
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/hashes.txt");
    if std::env::var_os("TAUTLINE_WRITE_HASHES").is_some_and(|value| value == "1") {
        std::fs::write(&path, &table).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap();
    // Compared line by line, so that a checkout with other line ends passes.
    for (found, committed) in table.lines().zip(committed.lines()) {
        assert_eq!(found, committed, "for an intended change: TAUTLINE_WRITE_HASHES=1 cargo test --test determinism");
    }
    assert_eq!(table.lines().count(), committed.lines().count(), "one line for each scene");
}

#[test]
fn a_fresh_stepper_continues_a_clone_with_the_same_bits() {
    for shipped in scene::shipped() {
        let setup = scene::open(shipped.name).unwrap();
        // The pile is 2,000 discs: half the time is enough to have it fall, touch and roll.
        let steps = if setup.world.bodies().len() > 1000 { STEPS / 4 } else { STEPS };
        let mut world = setup.world.clone();
        advance(&mut world, setup.method, steps / 2);
        let mut branch = world.clone();
        let mut stepper = Stepper::new(setup.method).unwrap();
        for step in 0..steps / 2 {
            stepper.step(&mut world);
            // A stepper that is replaced again and again must not matter either.
            advance(&mut branch, setup.method, 1);
            assert_eq!(world.hash(), branch.hash(), "{} differs at step {}", shipped.name, steps / 2 + step + 1);
        }
    }
}

#[test]
fn a_fresh_stepper_continues_islands_with_the_same_bits() {
    for scene in scene::truth_scenes() {
        for integrator in DIRECT {
            let setup = scene::open(scene.name).unwrap();
            let method = Method { integrator, ..setup.method };
            let (mut world, mut branch) = (setup.world.clone(), setup.world);
            let mut stepper = Stepper::new(method).unwrap();
            for step in 0..40 {
                stepper.step(&mut world);
                advance(&mut branch, method, 1);
                assert_eq!(world.hash(), branch.hash(), "{}, {integrator:?} differs at step {}", scene.name, step + 1);
            }
        }
    }
}

#[test]
fn every_method_repeats_its_bits_on_the_playground() {
    let setup = scene::open("playground").unwrap();
    for integrator in Integrator::ALL {
        for solver in Solver::ALL {
            let method = Method { integrator, solver, ..setup.method };
            let [mut one, mut other] = [setup.world.clone(), setup.world.clone()];
            // Explicit Euler may diverge here; then it stops at the same state.
            let step = |world: &mut World, steps: u32| {
                let mut stepper = Stepper::new(method).unwrap();
                (0..steps).for_each(|_| drop(stepper.step(world)));
            };
            step(&mut one, 120);
            step(&mut other, 60);
            step(&mut other, 60);
            assert_eq!(one.hash(), other.hash(), "{method:?}");
            assert_ne!(one.hash(), setup.world.hash(), "something moves");
        }
    }
}
