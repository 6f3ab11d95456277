//! Loops, redundant rods, and what turns for ever.

use super::{energy, error_at_its_own_pace, open, step, violation};
use tautline::engine::{DVec2, World};
use tautline::measure::Measures;
use tautline::truth::closed_form::Pendulum;

#[test]
fn a_rigid_net_holds() {
    let error = error_at_its_own_pace("hard/rigid_net", "truth/rigid_net", |method| method);
    println!("hard/rigid_net: {error:.1e}");
    assert!(error < 1e-9, "{error:e}");
    let (mut world, mut stepper) = open("hard/rigid_net");
    let (start, mut worst) = (energy(&world), 0.0f64);
    for _ in 0..120 {
        step(&mut world, &mut stepper);
        worst = worst.max(violation(&world));
    }
    let drift = (energy(&world) - start).abs();
    println!("violation {worst:.1e} m, energy within {drift:.1e} J");
    assert!(worst < 1e-6 && drift < 1e-6, "{worst:e}, {drift:e}");
}

/// The mass, its centre, and the moment of inertia about the origin.
fn as_one_body(world: &World) -> (f64, DVec2, f64) {
    let bodies = world.bodies();
    let mut sum = (0.0, DVec2::ZERO, 0.0);
    for (position, mass) in bodies.position.iter().zip(&bodies.mass) {
        sum = (sum.0 + mass, sum.1 + mass * *position, sum.2 + mass * position.length_squared());
    }
    (sum.0, sum.1 / sum.0, sum.2)
}

#[test]
fn a_net_with_redundant_diagonals_swings_as_one_body() {
    let (mut world, mut stepper) = open("hard/braced_net");
    let (mass, centre, inertia) = as_one_body(&world);
    let amplitude = centre.x.atan2(-centre.y);
    assert!(amplitude > 0.5, "it swings: {amplitude} rad");
    // Steiner: the pendulum of this length, in the direction of the centre of mass.
    let pendulum = Pendulum { length: inertia / (mass * centre.length()), gravity: 10.0, amplitude };
    let start = energy(&world);
    let (mut off, mut worst, mut drift) = (0.0f64, 0.0f64, 0.0f64);
    for _ in 0..120 {
        let report = step(&mut world, &mut stepper);
        // 1482 rods and a pin's two rows on 400 particles, which as one pinned body have one way to move: 1484 − (800 − 1).
        assert_eq!(report.redundant, 685);
        let exact = centre.length() / pendulum.length * pendulum.at(world.time());
        off = off.max((as_one_body(&world).1 - exact).length());
        worst = worst.max(violation(&world));
        drift = drift.max((energy(&world) - start).abs());
    }
    println!("centre {off:.1e} m off, violation {worst:.1e} m, energy within {drift:.1e} J");
    assert!(off < 1e-8 && worst < 1e-8 && drift < 1e-7, "{off:e}, {worst:e}, {drift:e}");
}

#[test]
fn a_joint_grid_of_ten_thousand_keeps_its_joints() {
    let (mut world, mut stepper) = open("hard/joint_grid");
    let start = energy(&world);
    let begin = std::time::Instant::now();
    let mut most = f64::NEG_INFINITY;
    for _ in 0..60 {
        step(&mut world, &mut stepper);
        most = most.max(energy(&world) - start);
        assert!(violation(&world) < 1e-5, "{:e}", violation(&world));
    }
    let frame = begin.elapsed().as_secs_f64() * 1e3 / 60.0;
    let (moved, lost) = (Measures::of(&world).kinetic, start - energy(&world));
    println!(
        "joint grid: {moved:e} J moves, gaps {:.1e} m, energy {lost:.1e} J below the start at the end and {most:.1e} J at most above it, {frame:.0} ms a frame",
        violation(&world),
    );
    // Nothing drives it, and little of what has come to move is lost.
    assert!(most <= 1e-9 * moved && lost.abs() <= 1e-5 * moved, "{most:e}, {lost:e} of {moved:e}");
}

#[test]
fn a_braced_wheel_turns_for_ever() {
    let (mut world, mut stepper) = open("hard/wheel");
    let before = Measures::of(&world);
    let mut drift = 0.0f64;
    for _ in 0..3600 {
        let report = step(&mut world, &mut stepper);
        assert_eq!(report.redundant, 1, "sixteen rods on nine particles, which have three ways to move as one");
        drift = drift.max((energy(&world) - before.kinetic).abs() / before.kinetic);
    }
    let after = Measures::of(&world);
    let turned = (after.angular_momentum - before.angular_momentum).abs() / before.angular_momentum;
    println!("wheel: energy within {drift:.1e}, angular momentum within {turned:.1e} in a minute");
    assert!(drift < 1e-9 && turned < 1e-9 && after.violation_max < 1e-10);
}
