//! What must not change: energy, and the momenta of what nothing holds.

use super::*;

fn energy(world: &World) -> f64 {
    Measures::of(world).total_energy()
}

#[test]
fn a_chain_of_discs_keeps_its_energy() {
    let mut world = World::new();
    let radius = 0.15;
    let mut above = Anchor::World(DVec2::ZERO);
    for i in 0..12 {
        let body = world.add_body(&disc(v(radius * f64::from(2 * i + 1), 0.0), 0.5, radius, 0.0, 0.0)).unwrap();
        join(&mut world, Kind::Pin, above, Anchor::Body(body, v(-radius, 0.0)));
        above = Anchor::Body(body, v(radius, 0.0));
    }
    let (start, mut stepper) = (energy(&world), Stepper::new(by_accuracy(1e-12)).unwrap());
    let (mut drift, mut violated) = (0.0f64, 0.0f64);
    for _ in 0..600 {
        let report = step(&mut world, &mut stepper);
        assert_eq!(report.matrix.map(|path| path.name()), Some("block tridiagonal"));
        drift = drift.max((energy(&world) - start).abs());
        violated = violated.max(violation(&world));
    }
    // What the fall sets free is about 12 · 0.5 kg · g · 1.8 m = 106 J.
    println!("12 discs for 10 s at 1e-12: energy within {drift:.1e} J, violation {violated:.1e} m");
    assert!(drift < 1e-9 && violated < 1e-12, "{drift:e}, {violated:e}");
}

#[test]
fn a_free_pair_keeps_its_momenta() {
    for kind in [Kind::Pin, Kind::Rod { length: 0.4 }, Kind::Spring { rest: 0.3, stiffness: 300.0, damping: 2.0 }] {
        let mut world = World::new();
        world.set_gravity(DVec2::ZERO).unwrap();
        let one = Body { velocity: v(1.0, 2.0), ..disc(v(0.0, 0.0), 1.0, 0.3, 0.5, 5.0) };
        let gap = if kind == Kind::Pin { 0.0 } else { 0.4 };
        let rim = v(0.3 * f64::cos(0.5), 0.3 * f64::sin(0.5));
        // The second disc's own −x end is where the first one's rim is, or a gap further.
        let other = Body { velocity: v(-1.0, 0.5), ..disc(rim + v(0.2 + gap, 0.0), 3.0, 0.2, 0.0, -2.0) };
        let [a, b] = [one, other].map(|body| world.add_body(&body).unwrap());
        join(&mut world, kind, Anchor::Body(a, v(0.3, 0.0)), Anchor::Body(b, v(-0.2, 0.0)));
        let start = Measures::of(&world);
        let mut stepper = Stepper::new(by_accuracy(1e-12)).unwrap();
        (0..600).for_each(|_| drop(step(&mut world, &mut stepper)));
        let end = Measures::of(&world);
        let pushed = (end.momentum - start.momentum).length();
        let turned = (end.angular_momentum - start.angular_momentum).abs();
        println!(
            "{} between two rims for 10 s: momentum within {pushed:.1e}, angular momentum {turned:.1e}",
            kind.name()
        );
        assert!(pushed < 1e-12 && turned < 1e-11, "{kind:?}: {pushed:e}, {turned:e}");
    }
}

#[test]
fn a_disc_pinned_at_its_rim_hangs_still_and_its_pin_carries_it() {
    let mut world = World::new();
    let body = world.add_body(&disc(v(0.0, 0.0), 2.0, 0.5, 0.3, 0.0)).unwrap();
    let local = DVec2::from_angle(-0.3).rotate(v(0.0, 0.5));
    let id = join(&mut world, Kind::Pin, Anchor::World(v(0.0, 0.5)), Anchor::Body(body, local));
    let mut stepper = Stepper::new(by_accuracy(1e-12)).unwrap();
    (0..120).for_each(|_| drop(step(&mut world, &mut stepper)));
    let index = world.constraints().index_of(id).unwrap();
    let (at, load) = (world.bodies().position[0], world.constraints().force[index]);
    println!("hanging still: {:.1e} m off, pin carries {:.12} N", at.length(), load.y);
    assert!(at.length() < 1e-13 && (load - v(0.0, 2.0 * G)).length() < 1e-10, "{at}, {load}");
}

#[test]
fn rattle_keeps_the_energy_of_three_discs_bounded() {
    let mut world = World::new();
    let mut above = Anchor::World(DVec2::ZERO);
    for i in 0..3 {
        let body = world.add_body(&disc(v(0.2 * f64::from(2 * i + 1), 0.0), 1.0, 0.2, 0.0, 0.0)).unwrap();
        join(&mut world, Kind::Pin, above, Anchor::Body(body, v(-0.2, 0.0)));
        above = Anchor::Body(body, v(0.2, 0.0));
    }
    let method = Method { integrator: Integrator::Rattle, substeps: 8, ..Method::default() };
    let (start, mut stepper) = (energy(&world), Stepper::new(method).unwrap());
    let (mut early, mut late, mut violated) = (0.0f64, 0.0f64, 0.0f64);
    for i in 0..60_000 {
        step(&mut world, &mut stepper);
        let change = (energy(&world) - start).abs();
        if i < 6_000 {
            early = early.max(change)
        } else {
            late = late.max(change)
        }
        violated = violated.max(violation(&world));
    }
    // What the fall sets free is 3 kg · g · 0.6 m = 18 J; a drift would show as more at the end than at the start.
    println!("RATTLE, 480,000 steps: energy within {early:.1e} J, later {late:.1e} J, violation {violated:.1e} m");
    assert!(late < 0.05 && late < 4.0 * early && violated < 1e-12, "{early:e}, {late:e}, {violated:e}");
}
