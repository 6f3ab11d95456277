//! The hard cases under `scenes/hard`, each with its pass, as they open: settings included. Figures are printed; `--nocapture`.

mod closed_forms;
mod impacts;
mod nets;
mod passes;
mod ropes;
mod statics;
mod turning;

use tautline::engine::{DVec2, Method, StepReport, Stepper, World};
use tautline::measure::{Measures, error_against};
use tautline::scene;
use tautline::truth::stored;

/// A scene as it opens, and what it is stepped with.
fn open(name: &str) -> (World, Stepper) {
    let setup = scene::open(name).unwrap();
    (setup.world, Stepper::new(setup.method).unwrap())
}

/// Steps once; nothing may diverge or be given up.
fn step(world: &mut World, stepper: &mut Stepper) -> StepReport {
    let report = stepper.step(world);
    assert!(report.divergence.is_none() && report.given_up == 0, "{report:?}");
    report
}

fn energy(world: &World) -> f64 {
    let measures = Measures::of(world);
    measures.kinetic + measures.potential + measures.elastic
}

fn violation(world: &World) -> f64 {
    Measures::of(world).violation_max
}

/// RMS distance of a scene under g = 10 m/s² from the stored truth of the same bodies under 9.81 m/s², in parts of its length.
///
/// From rest without damping a motion under another gravity is the same motion at another pace: x(t √(g/g')).
fn error_at_its_own_pace(name: &str, truth: &str, method: impl Fn(Method) -> Method) -> f64 {
    let truth = stored(truth).unwrap();
    let setup = scene::open(name).unwrap();
    let method = method(setup.method);
    let mut world = setup.world;
    let mut stepper = Stepper::new(Method { hz: 60.0 * (10.0f64 / 9.81).sqrt(), ..method }).unwrap();
    let mut motion = vec![world.bodies().position.clone()];
    for _ in 1..truth.times.len() {
        step(&mut world, &mut stepper);
        motion.push(world.bodies().position.clone());
    }
    error_against(&truth.positions, &motion, truth.length).unwrap()
}

fn by_id(world: &World, index: usize) -> DVec2 {
    world.bodies().position[index]
}

#[test]
fn every_hard_scene_gives_the_same_bits_twice() {
    for shipped in scene::hard_scenes() {
        let steps = if shipped.name == "hard/joint_grid" { 3 } else { 30 };
        let [first, second] = [(), ()].map(|()| {
            let (mut world, mut stepper) = open(shipped.name);
            for i in 0..steps {
                if i == steps / 2 {
                    stepper = Stepper::new(*stepper.method()).unwrap();
                }
                step(&mut world, &mut stepper);
            }
            world.hash()
        });
        assert_eq!(first, second, "{}", shipped.name);
    }
}
