//! The observed order of convergence of the integrators of islands on the stored truths, and the energy of the symplectic ones
//! over a million steps.

use tautline::engine::{Body, Constraint, DVec2, Integrator, Kind, Method, Stepper, World};
use tautline::measure::{Measures, error_against};
use tautline::scene;
use tautline::truth::stored;

/// RMS distance from the truth in parts of the scene's length, and the largest violation [m].
fn error(name: &str, integrator: Integrator, substeps: u32) -> (f64, f64) {
    let truth = stored(name).unwrap();
    let mut world = scene::open(name).unwrap().world;
    let mut stepper = Stepper::new(Method { integrator, substeps, ..Method::default() }).unwrap();
    let mut motion = vec![world.bodies().position.clone()];
    let mut violation: f64 = 0.0;
    for _ in 1..truth.times.len() {
        let report = stepper.step(&mut world);
        assert!(report.divergence.is_none() && report.given_up == 0, "{name}: {report:?}");
        motion.push(world.bodies().position.clone());
        violation = violation.max(Measures::of(&world).violation_max);
    }
    (error_against(&truth.positions, &motion, truth.length).unwrap(), violation)
}

/// Asserts the order between `substeps` and twice as many.
fn converges(name: &str, integrator: Integrator, substeps: u32, order: f64) {
    let (coarse, _) = error(name, integrator, substeps);
    let (fine, violation) = error(name, integrator, 2 * substeps);
    let observed = (coarse / fine).log2();
    println!(
        "{name}, {}: {coarse:.1e} and {fine:.1e}, order {observed:.2}, violation {violation:.1e} m",
        integrator.name()
    );
    assert!((observed - order).abs() < 0.25, "{name}: {coarse:e} and {fine:e}");
    assert!(violation < 1e-11, "{name}: {violation:e}");
}

const SPRINGS: [&str; 3] = ["truth/cloth", "truth/stiff_chain", "truth/stiff_chain_1e4"];

#[test]
fn rattle_is_of_order_two_on_every_truth_scene() {
    for shipped in scene::truth_scenes() {
        // The light links of the heavy rope swing so fast that the order sets in late.
        let substeps = if shipped.name == "truth/heavy_rope" { 256 } else { 16 };
        converges(shipped.name, Integrator::Rattle, substeps, 2.0);
    }
}

#[test]
fn runge_kutta_is_of_order_four_on_every_truth_scene() {
    for shipped in scene::truth_scenes() {
        let substeps = if shipped.name == "truth/heavy_rope" { 64 } else { 16 };
        converges(shipped.name, Integrator::RungeKutta4, substeps, 4.0);
    }
}

#[test]
fn radaus_methods_are_of_order_five_and_nine_where_the_motion_is_resolved() {
    // Ropes and nets of rods, springs in a row and as a cloth: from where all modes are resolved to where rounding sets in.
    for (name, three, five) in [
        ("truth/pendulum", 1, None),
        ("truth/double_pendulum", 1, None),
        ("truth/rigid_net", 1, Some(1)),
        ("truth/stiff_chain", 2, Some(1)),
        ("truth/bridge", 2, None),
        ("truth/cloth", 8, Some(4)),
    ] {
        converges(name, Integrator::Radau3, three, 5.0);
        if let Some(substeps) = five {
            converges(name, Integrator::Radau5, substeps, 9.0);
        }
    }
}

#[test]
fn radaus_method_of_five_stages_meets_round_off_on_truth_scenes() {
    for (name, substeps) in
        [("truth/pendulum", 1), ("truth/double_pendulum", 2), ("truth/bridge", 4), ("truth/rigid_net", 2)]
    {
        let (found, violation) = error(name, Integrator::Radau5, substeps);
        println!("{name}, {substeps} a step: {found:.1e}, violation {violation:.1e} m");
        assert!(found < 1e-11, "{name}: {found:e}");
    }
}

#[test]
fn nystroms_methods_are_of_order_four_and_six_on_springs() {
    for name in SPRINGS {
        // From where the steps are no longer cut for stability to where rounding sets in.
        converges(name, Integrator::Nystrom4, 8, 4.0);
        converges(name, Integrator::Nystrom6, if name == "truth/cloth" { 8 } else { 2 }, 6.0);
    }
}

fn point(x: f64, y: f64) -> Body {
    Body { position: DVec2::new(x, y), radius: 0.0, ..Body::default() }
}

/// Mean energy over the first and the last tenth of `steps` steps, and the largest change from the start [J].
fn energies(world: &mut World, integrator: Integrator, substeps: u32, steps: usize) -> ([f64; 2], f64) {
    let energy = |world: &World| {
        let measures = Measures::of(world);
        measures.kinetic + measures.potential + measures.elastic
    };
    let mut stepper = Stepper::new(Method { integrator, substeps, ..Method::default() }).unwrap();
    let (start, tenth) = (energy(world), steps / 10);
    let (mut means, mut largest) = ([0.0; 2], 0.0f64);
    for step in 0..steps {
        let report = stepper.step(world);
        assert!(report.divergence.is_none() && report.given_up == 0, "{report:?}");
        let change = energy(world) - start;
        largest = largest.max(change.abs());
        if step < tenth {
            means[0] += change / tenth as f64;
        } else if step >= steps - tenth {
            means[1] += change / tenth as f64;
        }
    }
    (means, largest)
}

#[test]
fn rattle_keeps_the_energy_of_a_double_pendulum_bounded_over_a_million_steps() {
    let mut world = World::new();
    let a = world.add_body(&point(1.0, 0.0)).unwrap();
    let b = world.add_body(&point(2.0, 0.0)).unwrap();
    world.add_constraint(&Constraint::to_world(Kind::Rod { length: 1.0 }, a, DVec2::ZERO)).unwrap();
    world.add_constraint(&Constraint::between(Kind::Rod { length: 1.0 }, a, b)).unwrap();
    let (means, largest) = energies(&mut world, Integrator::Rattle, 10, 100_000);
    // What the fall sets free is 3 m g L = 29 J.
    println!("energy over 1e6 steps: at most {largest:.1e} J off, mean {:.1e} J, then {:.1e} J", means[0], means[1]);
    assert!(largest < 0.1 && (means[1] - means[0]).abs() < 5e-3, "{means:?}, {largest:e}");
}

#[test]
fn nystroms_methods_keep_the_energy_of_two_springs_bounded_over_a_million_steps() {
    for (integrator, bound) in [(Integrator::Nystrom4, 3e-3), (Integrator::Nystrom6, 1e-4)] {
        let mut world = World::new();
        let a = world.add_body(&point(1.0, 0.0)).unwrap();
        let b = world.add_body(&point(2.0, 0.5)).unwrap();
        let spring = |rest| Kind::Spring { rest, stiffness: 400.0, damping: 0.0 };
        world.add_constraint(&Constraint::to_world(spring(0.8), a, DVec2::ZERO)).unwrap();
        world.add_constraint(&Constraint::between(spring(1.0), a, b)).unwrap();
        let (means, largest) = energies(&mut world, integrator, 2, 500_000);
        println!("{}: at most {largest:.1e} J off, {:.1e} J, then {:.1e} J", integrator.name(), means[0], means[1]);
        assert!(largest < bound && (means[1] - means[0]).abs() < 0.1 * bound, "{means:?}, {largest:e}");
    }
}
