//! Ropes and chains under loads.

use super::{by_id, energy, error_at_its_own_pace, open, step, violation};
use tautline::engine::{Integrator, Method};
use tautline::scene;

#[test]
fn a_rope_is_exact_as_it_opens_and_of_second_order_in_the_step() {
    let (scene, truth) = ("hard/rope", "truth/rope");
    let as_opened = error_at_its_own_pace(scene, truth, |method| method);
    let rattle = |substeps| move |_| Method { integrator: Integrator::Rattle, substeps, ..Method::default() };
    let [coarse, fine] = [16, 32].map(|substeps| error_at_its_own_pace(scene, truth, rattle(substeps)));
    println!("{scene}: {as_opened:.1e} as opened; RATTLE {coarse:.1e} and {fine:.1e}");
    assert!(as_opened < 1e-9 && ((coarse / fine).log2() - 2.0).abs() < 0.1);
}

#[test]
fn a_heavy_rope_holds_its_load() {
    let (scene, truth) = ("hard/heavy_rope", "truth/heavy_rope");
    let error = error_at_its_own_pace(scene, truth, |method| method);
    let (mut world, mut stepper) = open(scene);
    let mut worst = 0.0f64;
    for _ in 0..180 {
        step(&mut world, &mut stepper);
        worst = worst.max(violation(&world));
    }
    println!("{scene}: {error:.1e}, links {worst:.1e} m off");
    assert!(error < 1e-9 && worst < 1e-9);
}

#[test]
fn balls_on_chains_stay_on_them() {
    for name in ["hard/ball_and_chain", "hard/ball_and_chain_light"] {
        let (mut world, mut stepper) = open(name);
        let (start, mut gap, mut drift) = (energy(&world), 0.0f64, 0.0f64);
        let mut released = 0.0f64;
        for _ in 0..600 {
            step(&mut world, &mut stepper);
            gap = gap.max(violation(&world));
            released = released.max(tautline::measure::Measures::of(&world).kinetic);
            drift = drift.max((energy(&world) - start).abs());
        }
        println!("{name}: gaps {gap:.1e} m, energy within {:.1e} of what is set free", drift / released);
        assert!(gap < 1e-3 && drift < 1e-6 * released, "{gap:e}, {drift:e}");
    }
}

#[test]
fn a_stretched_chain_meets_its_lengths_and_flings_nothing_away() {
    let (mut world, mut stepper) = open("hard/stretched_chain");
    step(&mut world, &mut stepper);
    assert!(violation(&world) < 1e-9, "{:e}", violation(&world));
    let top = energy(&world);
    for _ in 0..600 {
        step(&mut world, &mut stepper);
        // Nothing is faster than what falls freely by twice the chain's length, but for the whip of a light end.
        let fastest = world.bodies().velocity.iter().fold(0.0f64, |most, v| most.max(v.length()));
        assert!(fastest < 10.0 * (2.0f64 * 10.0 * 80.0).sqrt(), "{fastest} m/s at {}", world.time());
        assert!(violation(&world) < 1e-9, "{:e}", violation(&world));
        // Forty discs of 0.126 kg fall by twenty metres on average.
        let gained = (energy(&world) - top) / (40.0 * 0.126 * 10.0 * 20.0);
        assert!(gained < 1e-6, "{gained:e} of what is set free at {}", world.time());
        assert!(world.bodies().position.iter().all(|p| p.length() < 40.0 + 1e-6));
    }
}

#[test]
fn a_far_chain_moves_as_one_at_the_origin() {
    let (mut far, mut stepper) = open("hard/far_chain");
    let mut near = far.clone();
    let origin = by_id(&far, 0);
    for i in 0..near.bodies().len() {
        let id = near.bodies().id[i];
        let mut body = near.body(id).unwrap();
        body.position -= origin;
        near.set_body(id, &body).unwrap();
    }
    let mut other = tautline::engine::Stepper::new(scene::open("hard/far_chain").unwrap().method).unwrap();
    let mut worst = 0.0f64;
    for _ in 0..120 {
        step(&mut far, &mut stepper);
        step(&mut near, &mut other);
        for (a, b) in far.bodies().position.iter().zip(&near.bodies().position) {
            worst = worst.max((*a - origin - *b).length());
        }
    }
    println!("far chain: {worst:.1e} m from the one at the origin after two seconds");
    assert!(worst < 1e-6, "{worst:e}");
}
