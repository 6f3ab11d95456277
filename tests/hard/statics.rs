//! What comes to rest, against its static solution.

use super::{open, step};
use tautline::engine::{DVec2, Integrator, Method, Stepper};
use tautline::measure::error_against;
use tautline::scene;
use tautline::truth::closed_form::Hanging;

#[test]
fn a_hanging_chain_comes_to_rest_as_a_catenary() {
    let (mut world, mut stepper) = open("hard/hanging_chain");
    (0..1800).for_each(|_| drop(step(&mut world, &mut stepper)));
    let (nodes, tensions) = Hanging::chain(100, 0.1, 1.0, DVec2::ZERO, DVec2::new(8.0, 0.0)).balance().unwrap();
    // The generators make both halves in order: nodes 0 … 50 and 51 … 100, links 0 … 49 and 50 … 98, and the link that joins
    // them last.
    let at = world.bodies().position.iter();
    let off = at.zip(&nodes).fold(0.0f64, |most, (p, q)| most.max((*p - *q).length()));
    let place = |i: usize| {
        if i < 50 {
            i
        } else if i == 50 {
            99
        } else {
            i - 1
        }
    };
    let slack = (0..100)
        .fold(0.0f64, |most, i| most.max((world.constraints().tension(place(i)) - tensions[i]).abs() / tensions[i]));
    println!("hanging chain: nodes {:.1e} of the span, tensions {slack:.1e} off", off / 8.0);
    assert!(off < 1e-6 * 8.0 && slack < 1e-6, "{off:e}, {slack:e}");
}

#[test]
fn stiff_springs_with_soft_ones_keep_their_balance_their_energy_and_their_order() {
    let setup = scene::open("hard/stiff_with_soft").unwrap();
    // At rest spring i carries all below it, and is longer by that over its stiffness.
    let mut hanging = setup.world.clone();
    let mut y = 0.0;
    for i in 1..=20 {
        let stiffness = if i % 2 == 1 { 1e4 } else { 1.0 };
        y -= 0.5 + f64::from(21 - i) * 0.1 / stiffness;
        let id = hanging.bodies().id[i as usize];
        let mut body = hanging.body(id).unwrap();
        body.position = DVec2::new(0.0, y);
        hanging.set_body(id, &body).unwrap();
    }
    let start = hanging.bodies().position.clone();
    let mut stepper = Stepper::new(setup.method).unwrap();
    for _ in 0..600 {
        step(&mut hanging, &mut stepper);
    }
    let moved = start.iter().zip(&hanging.bodies().position).fold(0.0f64, |most, (a, b)| most.max((*a - *b).length()));
    // It hangs straight, which nothing disturbs sideways but rounding.
    assert!(moved < 1e-10, "{moved:e}");
    // One step of the midpoint rule a frame for ten minutes.
    let mut world = setup.world.clone();
    let midpoint = Method { integrator: Integrator::EnergyMomentum, substeps: 1, ..Method::default() };
    let mut stepper = Stepper::new(midpoint).unwrap();
    let (first, mut drift) = (super::energy(&world), 0.0f64);
    for _ in 0..36_000 {
        step(&mut world, &mut stepper);
        drift = drift.max((super::energy(&world) - first).abs());
    }
    println!("stiff with soft: at rest within {moved:.1e} m, energy within {drift:.1e} J in ten minutes");
    assert!(drift < 1e-6, "{drift:e}");
    // The order, against the reference solver, which shares nothing with the engine.
    let truth = tautline::truth::converge(&setup.world, 2.0, 10.0).unwrap();
    let error = |method| {
        let (mut world, mut stepper) = (setup.world.clone(), Stepper::new(method).unwrap());
        let mut motion = vec![world.bodies().position.clone()];
        for _ in 1..truth.times.len() {
            step(&mut world, &mut stepper);
            motion.push(world.bodies().position.clone());
        }
        error_against(&truth.positions, &motion, 10.0).unwrap()
    };
    let by_nystrom = Method { integrator: Integrator::Nystrom4, ..Method::default() };
    let [coarse, fine] = [2, 4].map(|substeps| error(Method { substeps, ..by_nystrom }));
    println!("error {:.1e} as opened; Nyström of order 4 {coarse:.1e} and {fine:.1e}", error(setup.method));
    assert!(error(setup.method) < 1e-9);
    assert!(((coarse / fine).log2() - 4.0).abs() < 0.2, "{coarse:e}, {fine:e}");
}
