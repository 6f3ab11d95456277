//! Ropes at the rims of discs: the instant at which they tighten, and what that takes.

use super::*;

#[test]
fn a_rope_at_the_side_of_a_falling_disc_sets_it_turning() {
    let (mass, radius, drop) = (2.0, 0.5, 0.8);
    let mut world = World::new();
    let body = world.add_body(&disc(DVec2::ZERO, mass, radius, 0.0, 0.0)).unwrap();
    // Straight up from the rightmost point of the rim, slack by the drop.
    let rope = Kind::Rope { length: 1.0 };
    join(&mut world, rope, Anchor::World(v(radius, 1.0 - drop)), Anchor::Body(body, v(radius, 0.0)));
    let mut stepper = Stepper::new(by_accuracy(1e-12)).unwrap();
    let fall = (2.0 * drop / G).sqrt();
    let speed = G * fall;
    // The end stops, m_eff = 1/(1/m + r²/I) = m/3: two thirds of the speed and of the energy are left, ω = 2 v/(3 r) to the left.
    let left = 0.5 * mass * speed * speed * 2.0 / 3.0 - mass * G * drop;
    let mut taut = 0;
    while world.time() < fall + 0.3 {
        step(&mut world, &mut stepper);
        let (t, measures) = (world.time(), Measures::of(&world));
        if t < fall {
            assert!((world.bodies().position[0] - v(0.0, -0.5 * G * t * t)).length() < 1e-13);
            continue;
        }
        if taut == 0 {
            // Just after: the centre has gone on at 2/3 of the speed, the disc turned to the left.
            println!("just after: omega {:.3}, expected about {:.3}", omega(&world, 0), 2.0 * speed / (3.0 * radius));
            assert!(omega(&world, 0) > 0.0);
        }
        let off = (measures.total_energy() - left).abs();
        assert!(off < 1e-10 && measures.violation_max < 1e-12, "{off:e} J at {t}");
        taut += 1;
    }
    assert!(taut > 5);
    println!("a rope at the rim: energy right to 1e-10 J for {taut} steps after it tightened");
}
