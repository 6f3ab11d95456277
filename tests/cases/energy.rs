//! Springs whose ends pass through each other, or close by: what is conserved is kept.

use tautline::engine::{Body, Constraint, DVec2, Integrator, Kind, Method, Stepper, World};
use tautline::measure::Measures;

fn spring(rest: f64, stiffness: f64) -> Kind {
    Kind::Spring { rest, stiffness, damping: 0.0 }
}

fn body(position: DVec2, velocity: DVec2, mass: f64) -> Body {
    Body { position, velocity, mass, radius: 0.0, collides: false, ..Body::default() }
}

fn empty() -> World {
    let mut world = World::new();
    world.set_gravity(DVec2::ZERO).unwrap();
    world
}

/// A mass on a spring from the origin, thrown at it from `angle` [rad] so that it passes at `miss` [m].
fn thrown(angle: f64, miss: f64, speed: f64) -> World {
    let mut world = empty();
    let (along, across) = (DVec2::from_angle(angle), DVec2::from_angle(angle).perp());
    let mass = world.add_body(&body(along + miss * across, -speed * along, 1.0)).unwrap();
    world.add_constraint(&Constraint::to_world(spring(0.5, 100.0), mass, DVec2::ZERO)).unwrap();
    world
}

/// Two masses on a spring that fly through each other, and on to others that they hang on by springs.
fn chain_through_itself() -> World {
    let mut world = empty();
    let places = [(-2.0, -3.0), (-1.0, 8.0), (1.0, -8.0), (2.0, 3.0)];
    let masses = [1.0, 0.5, 0.5, 1.0];
    let ids: Vec<_> = places
        .iter()
        .zip(masses)
        .map(|((x, v), mass)| world.add_body(&body(DVec2::new(*x, 0.0), DVec2::new(*v, 0.0), mass)).unwrap())
        .collect();
    for pair in ids.windows(2) {
        world.add_constraint(&Constraint::between(spring(0.7, 150.0), pair[0], pair[1])).unwrap();
    }
    world
}

/// Four masses on springs of one anchor that pass through it at one instant.
fn star() -> World {
    let mut world = empty();
    for (angle, k) in [(0.3, 100.0), (1.7, 100.0), (3.0, 40.0), (5.1, 250.0)] {
        let along = DVec2::from_angle(angle);
        let mass = world.add_body(&body(along, -10.0 * along, 1.0)).unwrap();
        world.add_constraint(&Constraint::to_world(spring(0.5, k), mass, DVec2::ZERO)).unwrap();
    }
    let first = world.bodies().id[0];
    let second = world.bodies().id[1];
    world.add_constraint(&Constraint::between(spring(0.4, 30.0), first, second)).unwrap();
    world
}

/// A mass that starts where its spring is anchored.
fn from_the_anchor() -> World {
    let mut world = empty();
    let mass = world.add_body(&body(DVec2::ZERO, DVec2::new(3.0, 4.0), 2.0)).unwrap();
    world.add_constraint(&Constraint::to_world(spring(0.5, 100.0), mass, DVec2::ZERO)).unwrap();
    world
}

/// Largest change of the energy in ten seconds, in parts of the energy at the start.
fn drift(world: &World, method: Method) -> f64 {
    let energy = |world: &World| Measures::of(world).total_energy();
    let (mut world, start) = (world.clone(), energy(world));
    let mut stepper = Stepper::new(method).unwrap();
    let mut worst = 0.0f64;
    for _ in 0..600 {
        let report = stepper.step(&mut world);
        assert!(report.divergence.is_none() && report.given_up == 0, "{report:?}");
        worst = worst.max((energy(&world) - start).abs() / start);
    }
    worst
}

#[test]
fn springs_through_zero_length_keep_their_energy_at_every_accuracy() {
    let scenes = [
        ("along an axis", thrown(0.0, 0.0, 10.0)),
        ("aslant", thrown(2.2, 0.0, 10.0)),
        ("slowly", thrown(0.9, 0.0, 0.1)),
        ("a millimetre beside", thrown(0.0, 1e-3, 10.0)),
        ("a micrometre beside", thrown(4.0, 1e-6, 7.0)),
        ("a nanometre beside", thrown(4.0, -1e-9, 7.0)),
        ("a picometre beside", thrown(1.0, 1e-12, 7.0)),
        ("four masses in a row", chain_through_itself()),
        ("four masses at one instant", star()),
        ("from the anchor", from_the_anchor()),
    ];
    for (name, world) in &scenes {
        for accuracy in [1e-3, 1e-6, 1e-9, 1e-12] {
            let drift = drift(world, Method { automatic: true, accuracy, ..Method::default() });
            println!("{name}, wanted {accuracy:.0e}: energy kept to {drift:.1e}");
            // The energy of a method of order 2 swings about its mean without getting lost.
            let allowed = if accuracy >= 1e-3 { 1e-2 } else { accuracy.max(2e-12) };
            assert!(drift <= allowed, "{name}, wanted {accuracy:e}: {drift:e}");
        }
    }
}

#[test]
fn a_mass_thrown_through_its_anchor_moves_as_its_closed_form() {
    // Beyond the anchor the spring pushes it on: x'' = −k/m (x − rest sign x), symmetric about each passage.
    let (k, rest, speed) = (100.0f64, 0.5f64, 10.0f64);
    let omega = k.sqrt();
    // From 1 m inwards: (x − rest) = 0.5 cos ωt − v/ω sin ωt until x = 0.
    let amplitude = 0.5f64.hypot(speed / omega);
    let phase = (speed / omega).atan2(0.5);
    let inside = ((-rest / amplitude).acos() - phase) / omega;
    // Then from 0 out and back to 0, time after time.
    let half = 2.0 * (std::f64::consts::PI - (rest / amplitude).acos()) / omega;
    let exact = |t: f64| {
        if t < inside {
            return rest + amplitude * (omega * t + phase).cos();
        }
        let (n, s) = (((t - inside) / half).floor(), (t - inside) % half);
        // It leaves zero outwards.
        let out = rest - amplitude * (omega * s + (rest / amplitude).acos()).cos();
        if n % 2.0 == 0.0 { -out } else { out }
    };
    let mut world = thrown(0.0, 0.0, speed);
    let mut stepper = Stepper::new(Method { automatic: true, accuracy: 1e-12, ..Method::default() }).unwrap();
    let mut worst = 0.0f64;
    for _ in 0..120 {
        stepper.step(&mut world);
        worst = worst.max((world.bodies().position[0].x - exact(world.time())).abs());
    }
    println!("{worst:.1e} m off after 2 s");
    assert!(worst < 1e-11, "{worst:e}");
}

#[test]
fn methods_by_hand_stay_bounded_where_springs_pass_through_zero_length() {
    for integrator in [
        Integrator::Taylor,
        Integrator::EnergyMomentum,
        Integrator::Rattle,
        Integrator::RungeKutta4,
        Integrator::Nystrom4,
        Integrator::Nystrom6,
    ] {
        for (name, world) in [("through it", thrown(0.4, 0.0, 10.0)), ("a millimetre beside", thrown(0.4, 1e-3, 10.0))]
        {
            let drift = drift(&world, Method { integrator, substeps: 16, ..Method::default() });
            println!("{}, {name}: energy to {drift:.1e}", integrator.name());
            assert!(drift < 0.05, "{}, {name}: {drift:e}", integrator.name());
        }
    }
}
