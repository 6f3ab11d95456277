//! Discs that pins turn.

use super::{energy, open, step, violation};
use tautline::truth::closed_form::Pendulum;

#[test]
fn a_disc_pinned_off_its_centre_swings_by_elliptic_functions() {
    let (mut world, mut stepper) = open("hard/physical_pendulum");
    // (I + m d²)/(m d) with I = ½ m r², d = 0.3 m, r = 0.5 m.
    let length = (0.5 * 0.5 * 0.5 + 0.3 * 0.3) / 0.3;
    let truth = Pendulum { length, gravity: 9.81, amplitude: std::f64::consts::FRAC_PI_2 };
    let mut worst: f64 = 0.0;
    for _ in 0..600 {
        step(&mut world, &mut stepper);
        let exact = truth.at(world.time()) * (0.3 / length);
        worst = worst.max((world.bodies().position[0] - exact).length());
    }
    println!("hard/physical_pendulum: {worst:.1e} m off in 10 s");
    assert!(worst < 1e-9, "{worst:e}");
}

#[test]
fn light_discs_pinned_rim_to_rim_carry_a_heavy_one() {
    let (mut world, mut stepper) = open("hard/heavy_disc_chain");
    let (start, mut drift, mut worst, mut steps) = (energy(&world), 0.0f64, 0.0f64, 0);
    for _ in 0..180 {
        steps += step(&mut world, &mut stepper).island_steps;
        drift = drift.max((energy(&world) - start).abs());
        worst = worst.max(violation(&world));
    }
    // What the fall sets free is some 100 kg · g · 4.4 m = 4300 J.
    println!("hard/heavy_disc_chain: violation {worst:.1e} m, energy within {drift:.1e} J, {steps} steps in 3 s");
    assert!(worst < 1e-10 && drift < 1e-5, "{worst:e}, {drift:e}");
}
