//! Ropes of different lengths against the reference solver, which shares no numerics with the engine.

use tautline::engine::{Body, Constraint, DVec2, Kind, Method, Motion, Stepper, World};
use tautline::measure::{Measures, error_against};
use tautline::truth::converge;

/// A rope of rigid links, let go from the horizontal; one kilogram a metre.
fn rope(links: u32, link: f64) -> World {
    let mut world = World::new();
    let mut last = None;
    for i in 0..=links {
        let motion = if i == 0 { Motion::Static } else { Motion::Dynamic };
        let position = DVec2::new(f64::from(i) * link, 0.0);
        let node = Body { position, motion, mass: link, radius: 0.0, collides: false, ..Body::default() };
        let node = world.add_body(&node).unwrap();
        if let Some(before) = last.replace(node) {
            world.add_constraint(&Constraint::between(Kind::Rod { length: link }, before, node)).unwrap();
        }
    }
    world
}

#[test]
fn ropes_of_ten_and_a_hundred_links_are_carried_to_what_is_wanted() {
    for (links, link) in [(10, 0.1), (100, 0.1), (10, 0.5), (100, 0.05)] {
        let world = rope(links, link);
        let length = f64::from(links) * link;
        let truth = converge(&world, 0.75, length).unwrap();
        for (accuracy, most) in [(1e-3, 3e-4), (1e-9, 1e-9)] {
            let mut world = world.clone();
            let mut stepper = Stepper::new(Method { automatic: true, accuracy, ..Method::default() }).unwrap();
            let mut motion = vec![world.bodies().position.clone()];
            for _ in 1..truth.times.len() {
                assert_eq!(stepper.step(&mut world).given_up, 0);
                motion.push(world.bodies().position.clone());
            }
            let error = error_against(&truth.positions, &motion, length).unwrap();
            println!("{links} links of {link} m, wanted {accuracy:.0e}: error {error:.1e}");
            assert!(error < most, "{links} links of {link} m: {error:e}");
        }
    }
}

#[test]
fn a_rope_of_ten_thousand_links_keeps_its_links_and_its_energy() {
    let mut world = rope(10_000, 0.1);
    let mut stepper = Stepper::new(Method { automatic: true, accuracy: 1e-3, ..Method::default() }).unwrap();
    let energy = |world: &World| {
        let measures = Measures::of(world);
        (measures.kinetic + measures.potential, measures.kinetic)
    };
    let start = energy(&world).0;
    for _ in 0..30 {
        let report = stepper.step(&mut world);
        assert!(report.divergence.is_none() && report.given_up == 0, "{report:?}");
    }
    let (end, kinetic) = energy(&world);
    assert!((end - start).abs() < 1e-4 * kinetic, "{} of {kinetic}", end - start);
    assert!(Measures::of(&world).violation_max < 1e-6);
}
