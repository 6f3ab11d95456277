//! Floors made of pieces: what slides or rolls over their seams must not feel them.

use tautline::engine::{Body, DVec2, Integrator, Method, Solver, Spin, Stepper, Wall, World};

const RADIUS: f64 = 0.2;

/// A disc on a floor of these walls, moving to the right.
fn sliding(walls: &[Wall], speed: f64, friction: f64) -> World {
    let mut world = World::new();
    for wall in walls {
        world.add_wall(&Wall { friction, ..*wall }).unwrap();
    }
    let spin = (friction > 0.0).then_some(Spin { angle: 0.0, omega: -speed / RADIUS });
    let disc = Body {
        position: DVec2::new(0.3, RADIUS),
        velocity: DVec2::new(speed, 0.0),
        radius: RADIUS,
        friction,
        spin,
        ..Body::default()
    };
    world.add_body(&disc).unwrap();
    world
}

/// Twenty pieces of a metre, and the whole.
fn floors() -> [(Vec<Wall>, Wall); 2] {
    let x = |i: u32| f64::from(i);
    let segments = (0..20).map(|i| Wall::segment(DVec2::new(x(i), 0.0), DVec2::new(x(i + 1), 0.0))).collect();
    let blocks = (0..20).map(|i| Wall::block(DVec2::new(x(i), -0.5), DVec2::new(x(i + 1), 0.0))).collect();
    [
        (segments, Wall::segment(DVec2::ZERO, DVec2::new(20.0, 0.0))),
        (blocks, Wall::block(DVec2::new(0.0, -0.5), DVec2::new(20.0, 0.0))),
    ]
}

/// Largest distance between the same disc on both floors, until it has gone 19 m.
fn apart(method: Method, pieces: &[Wall], whole: Wall, speed: f64, friction: f64) -> f64 {
    let mut worlds = [sliding(pieces, speed, friction), sliding(&[whole], speed, friction)];
    let mut steppers = [0, 1].map(|_| Stepper::new(method).unwrap());
    let mut apart: f64 = 0.0;
    while worlds[1].bodies().position[0].x < 19.0 {
        for (world, stepper) in worlds.iter_mut().zip(&mut steppers) {
            assert!(stepper.step(world).divergence.is_none());
        }
        apart = apart.max(worlds[0].bodies().position[0].distance(worlds[1].bodies().position[0]));
    }
    apart
}

#[test]
fn a_disc_slides_and_rolls_over_the_seams_of_a_floor_as_over_one_wall() {
    for (pieces, whole) in floors() {
        for solver in Solver::ALL {
            for integrator in Integrator::ALL {
                for (speed, friction) in [(0.5, 0.0), (3.0, 0.0), (20.0, 0.0), (150.0, 0.0), (3.0, 0.5), (20.0, 0.5)] {
                    let method = Method { solver, integrator, ..Method::default() };
                    let apart = apart(method, &pieces, whole, speed, friction);
                    assert!(apart < 1e-9, "{integrator:?}, {solver:?}, {speed} m/s, friction {friction}: {apart:e} m");
                }
            }
        }
    }
}

#[test]
fn the_free_end_of_a_wall_still_holds_a_disc_up() {
    // It falls beside a floor's end, too near to pass.
    let mut world = World::new();
    world.add_wall(&Wall::segment(DVec2::ZERO, DVec2::X)).unwrap();
    world.add_wall(&Wall::segment(DVec2::X, DVec2::new(2.0, 0.0))).unwrap();
    let above = Body { position: DVec2::new(2.1, 1.0), radius: RADIUS, friction: 0.0, ..Body::default() };
    world.add_body(&above).unwrap();
    let mut stepper = Stepper::new(Method::default()).unwrap();
    let mut nearest = f64::INFINITY;
    for _ in 0..120 {
        stepper.step(&mut world);
        nearest = nearest.min(world.bodies().position[0].distance(DVec2::new(2.0, 0.0)));
    }
    // It touched the end, was pushed off and fell on.
    assert!((nearest - RADIUS).abs() < 0.01 * RADIUS, "{nearest}");
    assert!(world.bodies().position[0].y < -1.0 && world.bodies().velocity[0].x > 0.1);
}

#[test]
fn a_disc_runs_through_a_bowl_of_short_pieces_without_losing_more_than_the_turns_cost() {
    // Half a circle of radius 2 m in pieces of 3°: every seam takes the velocity across the next piece, v² sin² 3°.
    let point = |i: i32| 2.0 * DVec2::from_angle(f64::from(i).mul_add(3f64.to_radians(), std::f64::consts::PI));
    let mut world = World::new();
    for i in 0..60 {
        world.add_wall(&Wall { friction: 0.0, ..Wall::segment(point(i), point(i + 1)) }).unwrap();
    }
    let start = Body { position: DVec2::new(-1.8, 0.0), radius: RADIUS, friction: 0.0, ..Body::default() };
    world.add_body(&start).unwrap();
    let mut stepper = Stepper::new(Method { substeps: 8, ..Method::default() }).unwrap();
    let mut highest = f64::NEG_INFINITY;
    for _ in 0..150 {
        stepper.step(&mut world);
        let position = world.bodies().position[0];
        if position.x > 0.5 {
            highest = highest.max(position.y);
        }
    }
    // Kinetic energy m g h at the bottom, h = 1.8 m; a part sin² 3° = 0.27 % of what there is goes at each of 60 seams.
    assert!(highest > -1.8 * (1.0 - (1.0f64 - 0.0027).powi(60)) - 0.1 && highest < 0.02, "{highest}");
}
