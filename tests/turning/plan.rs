//! What the plan says of what turns, and that it repeats.

use super::*;
use tautline::engine::{LinearSolver, Motion};
use tautline::measure::Measures;

/// A ring of discs pinned rim to rim that hangs on two rods: a net of blocks of one and two rows.
fn ring() -> World {
    let mut world = World::new();
    let count = 8;
    let radius = 0.2;
    let turn = std::f64::consts::TAU / f64::from(count);
    let out = radius / (0.5 * turn).tan();
    let ids: Vec<Id> = (0..count)
        .map(|i| {
            let at = turn * f64::from(i);
            let centre = out * DVec2::from_angle(at);
            world.add_body(&disc(centre, 1.0, radius, at + std::f64::consts::FRAC_PI_2, 0.0)).unwrap()
        })
        .collect();
    // A disc's own x axis runs along the polygon, so both its pins are on its rim at the corners.
    for (i, id) in ids.iter().enumerate() {
        let next = ids[(i + 1) % ids.len()];
        join(&mut world, Kind::Pin, Anchor::Body(*id, v(radius, 0.0)), Anchor::Body(next, v(-radius, 0.0)));
    }
    for (body, side) in [(1, 1.0), (3, -1.0)] {
        let at = world.to_world(body, v(0.0, 0.1));
        let hook = at + v(0.0 * side, 1.0);
        join(&mut world, Kind::Rod { length: 1.0 }, Anchor::World(hook), Anchor::Body(ids[body], v(0.0, 0.1)));
    }
    world
}

#[test]
fn the_plan_says_that_anchors_turn_and_what_takes_them() {
    let by_hand = |integrator| Method { integrator, ..Method::default() };
    for (method, how) in [
        (by_accuracy(1e-3), "1 island by RATTLE within 1e-3, Taylor series where it is stiff, solved directly"),
        (by_accuracy(1e-9), "1 island by Taylor series to 1e-9, solved directly"),
        (by_hand(Integrator::Rattle), "1 island by RATTLE, 4 substeps a step, solved directly"),
        (by_hand(Integrator::EnergyMomentum), "1 island by Taylor series to 1e-6, solved directly"),
    ] {
        for drag in [0.0, 0.1] {
            let mut world = ring();
            world.set_drag(drag).unwrap();
            let mut stepper = Stepper::new(method).unwrap();
            let plan = stepper.plan(&world);
            assert!(plan.islands.len() == 1 && plan.islands[0].turning == 18);
            let sentence = plan.sentence(&world, &method);
            println!("{sentence}");
            let how = if drag == 0.0 { how } else { "1 island by Taylor series" };
            assert!(sentence.contains(how) && sentence.contains("18 anchors off a centre; rotations"));
        }
    }
}

#[test]
fn linear_solvers_find_the_motion_of_a_ring_of_discs() {
    let mut reference = None;
    // Jacobi's sweeps do not converge on it: its rows are not diagonally dominant.
    for linear in LinearSolver::ALL.into_iter().filter(|linear| *linear != LinearSolver::Jacobi) {
        let mut world = ring();
        let method = Method { linear, iterations: 1000, ..by_accuracy(1e-9) };
        let mut stepper = Stepper::new(method).unwrap();
        let mut violated = 0.0f64;
        for _ in 0..30 {
            step(&mut world, &mut stepper);
            violated = violated.max(violation(&world));
        }
        let at = world.bodies().position.clone();
        let apart = reference
            .get_or_insert_with(|| at.clone())
            .iter()
            .zip(&at)
            .fold(0.0f64, |m, (a, b)| m.max((a - b).length()));
        println!("{}: {apart:.1e} m from the first, violation {violated:.1e} m", linear.name());
        assert!(apart < 1e-8 && violated < 1e-8, "{linear:?}: {apart:e}, {violated:e}");
    }
}

#[test]
fn a_fresh_stepper_goes_on_with_the_same_bits() {
    let mut world = ring();
    let mut stepper = Stepper::new(by_accuracy(1e-8)).unwrap();
    for _ in 0..20 {
        step(&mut world, &mut stepper);
    }
    let mut branch = world.clone();
    for _ in 0..20 {
        step(&mut world, &mut stepper);
        step(&mut branch, &mut Stepper::new(by_accuracy(1e-8)).unwrap());
        assert_eq!(world.hash(), branch.hash());
    }
}

#[test]
fn a_disc_on_the_rim_of_one_that_turns_by_itself_goes_round_with_it() {
    // A kinematic wheel drives a disc through a pin at its rim; the pin's centre line turns at the wheel's rate.
    let mut world = World::new();
    world.set_gravity(DVec2::ZERO).unwrap();
    let wheel = Body { motion: Motion::Kinematic, ..disc(DVec2::ZERO, 1.0, 1.0, 0.0, 3.0) };
    let wheel = world.add_body(&wheel).unwrap();
    let rider = Body { velocity: v(0.0, 3.0), ..disc(v(1.0, 0.0), 1.0, 0.2, 0.0, 0.0) };
    let rider = world.add_body(&rider).unwrap();
    join(&mut world, Kind::Pin, Anchor::Body(wheel, v(1.0, 0.0)), Anchor::centre(rider));
    let mut stepper = Stepper::new(by_accuracy(1e-12)).unwrap();
    for _ in 0..120 {
        let report = stepper.step(&mut world);
        assert!(report.divergence.is_none() && report.given_up == 0);
        let exact = DVec2::from_angle(3.0 * world.time());
        let off = (world.bodies().position[1] - exact).length();
        assert!(off < 1e-12 && (angle(&world, 0) - 3.0 * world.time()).abs() < 1e-12, "{off:e}");
    }
}

#[test]
fn a_contradiction_between_turning_anchors_is_given_up_and_said() {
    let mut world = World::new();
    let body = world.add_body(&disc(v(0.0, 0.0), 1.0, 0.5, 0.0, 0.0)).unwrap();
    // Two points of the disc a metre apart, pinned at three metres from one another.
    join(&mut world, Kind::Pin, Anchor::Body(body, v(0.5, 0.0)), Anchor::World(v(1.5, 0.0)));
    join(&mut world, Kind::Pin, Anchor::Body(body, v(-0.5, 0.0)), Anchor::World(v(-1.5, 0.0)));
    let mut stepper = Stepper::new(by_accuracy(1e-9)).unwrap();
    for _ in 0..60 {
        let report = stepper.step(&mut world);
        assert!(report.divergence.is_none() && report.given_up == 1, "{report:?}");
        // Between the pins, not nearer to either than they contradict each other.
        let at = world.bodies().position[0];
        assert!(at.length() < 1.0 && Measures::of(&world).violation_max < 1.5, "{at}");
    }
    // It has come to rest there, turned to one side: straight between the pins it is in an unstable balance.
    let (position, speed) = (world.bodies().position[0], world.bodies().velocity[0].length());
    for _ in 0..10 {
        stepper.step(&mut world);
    }
    let moved = (world.bodies().position[0] - position).length();
    assert!(speed < 1e-9 && moved < 1e-9, "{speed:e} m/s, {moved:e} m");
}
