//! Islands of bodies that can touch: solved to the accuracy while nothing is near, with contacts where something is.

use tautline::engine::{Body, Carrier, Constraint, DVec2, Integrator, Kind, Method, Shape, Stepper, Wall, World};
use tautline::measure::Measures;
use tautline::scene;

fn by_accuracy(accuracy: f64) -> Method {
    Method { automatic: true, accuracy, ..Method::default() }
}

/// A pendulum of 1 m that swings down from the left, and a disc at rest that hangs on a rod of its own where it arrives.
fn two_pendulums(collide: bool) -> World {
    let mut world = World::new();
    let disc = |x: f64, y: f64| Body {
        position: DVec2::new(x, y),
        radius: 0.1,
        collides: collide,
        restitution: 1.0,
        ..Body::default()
    };
    for (x, y, pivot) in [(-1.0, 0.0, 0.0), (0.2, -1.0, 0.2)] {
        let ball = world.add_body(&disc(x, y)).unwrap();
        world.add_constraint(&Constraint::to_world(Kind::Rod { length: 1.0 }, ball, DVec2::new(pivot, 0.0))).unwrap();
    }
    world
}

#[test]
fn a_pendulum_swings_exactly_until_it_hits_and_hands_its_speed_on() {
    let (mut world, mut free) = (two_pendulums(true), two_pendulums(false));
    let (mut stepper, mut other) =
        (Stepper::new(by_accuracy(1e-10)).unwrap(), Stepper::new(by_accuracy(1e-10)).unwrap());
    let plan = stepper.plan(&world);
    assert_eq!(plan.islands.len(), 2);
    assert!(plan.islands.iter().all(|island| island.carrier == Carrier::Cheapest && island.guarded));
    // A quarter of the period of a pendulum released at 90°, K(½) √(L/g), K(½) = 1.8541.
    let quarter = 1.854_074_677_301_372 * (1.0f64 / 9.81).sqrt();
    let mut near = 0;
    while world.time() < quarter + 0.1 {
        let report = stepper.step(&mut world);
        other.step(&mut free);
        near += report.near;
        assert!(report.divergence.is_none() && report.given_up == 0);
        if near == 0 {
            assert_eq!(world.bodies().position, free.bodies().position, "the same bits as without collisions");
        }
    }
    assert!(near > 0 && near < 20, "{near} islands near in all steps together");
    // Equal masses, head on, e = 1: the first stops, the second goes on. The contact is of first order in the substep.
    let [first, second] = [world.bodies().velocity[0], world.bodies().velocity[1]].map(|v| v.length());
    assert!(first < 0.15 && (second - (2.0f64 * 9.81).sqrt()).abs() < 0.35, "{first}, {second}");
}

#[test]
fn a_rope_of_discs_falls_freely_and_comes_to_lie_on_the_floor() {
    let mut world = World::new();
    let disc = |i: u32| Body { position: DVec2::new(0.2 * f64::from(i), 1.0), radius: 0.05, ..Body::default() };
    let ids: Vec<_> = (0..10).map(|i| world.add_body(&disc(i)).unwrap()).collect();
    for pair in ids.windows(2) {
        world.add_constraint(&Constraint::between(Kind::Rod { length: 0.2 }, pair[0], pair[1])).unwrap();
    }
    world
        .add_wall(&Wall {
            shape: Shape::Box { min: DVec2::new(-10.0, -1.0), max: DVec2::new(10.0, 0.0) },
            ..Wall::default()
        })
        .unwrap();
    let mut stepper = Stepper::new(by_accuracy(1e-12)).unwrap();
    let mut near = 0;
    for _ in 0..240 {
        let report = stepper.step(&mut world);
        near += report.near;
        let (t, y) = (world.time(), world.bodies().position[3].y);
        if near == 0 {
            assert!((y - (1.0 - 0.5 * 9.81 * t * t)).abs() < 1e-12, "{y} at {t}");
        }
        assert!(report.divergence.is_none() && report.given_up == 0);
    }
    assert!(near > 150, "{near}");
    let measures = Measures::of(&world);
    assert!(world.bodies().position.iter().all(|p| (p.y - 0.05).abs() < 2e-3), "{:?}", world.bodies().position);
    assert!(measures.kinetic < 1e-6 && measures.violation_max < 1e-3, "{measures:?}");
}

#[test]
fn what_can_touch_is_found_whatever_its_size_and_speed() {
    // A rod of two small discs in the way of a fast small one, a huge one, and a wall; each stops somewhere else.
    for (position, velocity, radius) in [((-3.0, 0.0), (200.0, 0.0), 0.05), ((-40.0, 0.0), (60.0, 0.0), 30.0)] {
        let mut world = World::new();
        world.set_gravity(DVec2::ZERO).unwrap();
        let small = |y: f64| Body { position: DVec2::new(0.0, y), radius: 0.06, ..Body::default() };
        let [a, b] = [0.0, 0.5].map(|y| world.add_body(&small(y)).unwrap());
        world.add_constraint(&Constraint::between(Kind::Rod { length: 0.5 }, a, b)).unwrap();
        world
            .add_body(&Body { position: position.into(), velocity: velocity.into(), radius, ..Body::default() })
            .unwrap();
        let mut stepper = Stepper::new(Method { integrator: Integrator::Rattle, ..Method::default() }).unwrap();
        (0..30).for_each(|_| drop(stepper.step(&mut world)));
        assert!(world.bodies().velocity[0].x > 1.0, "{:?}", world.bodies().velocity);
        let momentum = Measures::of(&world).momentum.x;
        let before = velocity.0 * world.bodies().mass[2];
        assert!((momentum - before).abs() < 1e-9 * before, "{momentum} after {before}");
    }
}

#[test]
fn colliding_scenes_go_by_accuracy_and_stay_in_one_piece() {
    for name in ["rope", "cloth", "spring_chain", "double_pendulum", "soft_body", "bridge", "playground"] {
        for accuracy in [1e-3, 1e-8] {
            let mut world = scene::open(name).unwrap().world;
            let mut stepper = Stepper::new(by_accuracy(accuracy)).unwrap();
            let (mut near, mut carried) = (0, 0);
            let start = Measures::of(&world);
            for _ in 0..180 {
                let report = stepper.step(&mut world);
                assert!(report.divergence.is_none(), "{name}: {:?}", report.divergence);
                near += report.near;
                carried += usize::from(report.integrator.is_some());
            }
            let end = Measures::of(&world);
            println!(
                "{name} to {accuracy:.0e}: carried in {carried} of 180 steps, {near} times near, violation {:.1e} m",
                end.violation_max
            );
            let energy = |m: &Measures| m.kinetic + m.potential + m.elastic;
            assert!(
                energy(&end) < energy(&start) + 0.02 * (energy(&start).abs() + 10.0),
                "{name}: {} to {}",
                energy(&start),
                energy(&end)
            );
        }
    }
}
