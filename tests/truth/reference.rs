//! The reference solver against closed forms, a library's dense decomposition, and the laws that it does not use.

use nalgebra::{DMatrix, DVector};
use tautline::engine::{Body, Constraint, DVec2, Kind, Motion, World};
use tautline::scene;
use tautline::truth::closed_form::{Oscillator, Pendulum, fall_with_drag};
use tautline::truth::{Reference, TOLERANCES, TruthError, converge};

fn scene_world(text: &str) -> World {
    scene::parse("text", &format!("(version: 1, {text})")).unwrap_or_else(|error| panic!("{error}")).world
}

/// A particle at a point that touches nothing.
fn particle(position: DVec2, velocity: DVec2, mass: f64) -> Body {
    Body { position, velocity, mass, radius: 0.0, collides: false, ..Body::default() }
}

#[test]
fn a_pendulum_follows_the_elliptic_functions() {
    for amplitude in [0.1, std::f64::consts::FRAC_PI_2, 2.5] {
        let pendulum = Pendulum { length: 1.0, gravity: 9.81, amplitude };
        let mut world = World::new();
        let bob = world.add_body(&particle(pendulum.at(0.0), DVec2::ZERO, 3.0)).unwrap();
        world.add_constraint(&Constraint::to_world(Kind::Rod { length: 1.0 }, bob, DVec2::ZERO)).unwrap();
        let truth = converge(&world, 10.0, 1.0).unwrap();
        let distances = truth.times.iter().zip(&truth.positions).map(|(&t, at)| (at[0] - pendulum.at(t)).length());
        let worst = distances.fold(0.0, f64::max);
        println!("pendulum from {amplitude:.2} rad: {worst:.1e} m, agreement {:.1e}", truth.agreement);
        // Five swings at an ulp of the closed form's phase each, and the ulp by which it starts elsewhere.
        assert!(worst < 1e-13 && truth.agreement < 1e-18);
    }
}

#[test]
fn a_spring_with_damping_follows_the_closed_form() {
    for damping in [0.0, 0.4, 20.0, 60.0] {
        let oscillator = Oscillator { mass: 2.0, stiffness: 50.0, damping, position: 0.25, velocity: -1.0 };
        let mut world = World::new();
        world.set_gravity(DVec2::ZERO).unwrap();
        let body = particle(DVec2::new(1.25, 0.0), DVec2::new(-1.0, 0.0), oscillator.mass);
        let body = world.add_body(&body).unwrap();
        let spring = Kind::Spring { rest: 1.0, stiffness: oscillator.stiffness, damping };
        world.add_constraint(&Constraint::to_world(spring, body, DVec2::ZERO)).unwrap();
        let mut reference = Reference::new(&world, TOLERANCES[1]).unwrap();
        for _ in 0..180 {
            reference.advance().unwrap();
            let (x, v) = oscillator.at(reference.time());
            // A few ulps of the closed form: the phase reaches 15 rad.
            assert!((reference.positions()[0].x - 1.0 - x).abs() < 1e-14);
            assert!((reference.velocities()[0].x - v).abs() < 1e-13);
        }
    }
}

#[test]
fn a_fall_with_drag_follows_the_closed_form() {
    let mut world = World::new();
    world.set_drag(0.7).unwrap();
    let (start, velocity) = (DVec2::new(1.0, 2.0), DVec2::new(10.0, 10.0));
    world.add_body(&particle(start, velocity, 0.3)).unwrap();
    let mut reference = Reference::new(&world, TOLERANCES[1]).unwrap();
    for _ in 0..120 {
        reference.advance().unwrap();
        let exact = fall_with_drag(start, velocity, world.gravity(), 0.7, reference.time());
        assert!((reference.positions()[0] - exact.0).length() < 3e-14);
    }
}

/// Accelerations by a library: M a = f + Jᵀλ with unit vectors as rows of J, λ of least norm by singular values.
fn dense_accelerations(world: &World) -> Vec<DVec2> {
    let (bodies, constraints) = (world.bodies(), world.constraints());
    let n = bodies.len();
    let mut free = DVector::zeros(2 * n);
    for i in 0..n {
        let a = world.gravity() * f64::from(world.is_dynamic(i));
        (free[2 * i], free[2 * i + 1]) = (a.x, a.y);
    }
    let rods: Vec<usize> =
        (0..constraints.len()).filter(|&c| matches!(constraints.kind[c], Kind::Rod { .. })).collect();
    let (mut j, mut rate) = (DMatrix::zeros(rods.len(), 2 * n), DVector::zeros(rods.len()));
    for c in 0..constraints.len() {
        let (a, b) = world.ends(c);
        let (distance, along) = ((b - a).length(), (b - a).normalize());
        let velocity = |body: u32| bodies.velocity.get(body as usize).copied().unwrap_or_default();
        let relative = velocity(constraints.b[c]) - velocity(constraints.a[c]);
        for (end, sign) in [(constraints.a[c], -1.0), (constraints.b[c], 1.0)] {
            let Some(&w) = bodies.inverse_mass.get(end as usize) else { continue };
            match constraints.kind[c] {
                Kind::Spring { rest, stiffness, damping } => {
                    let force = -stiffness * (distance - rest) - damping * relative.dot(along);
                    free[2 * end as usize] += sign * w * force * along.x;
                    free[2 * end as usize + 1] += sign * w * force * along.y;
                }
                _ => {
                    let row = rods.iter().position(|&rod| rod == c).unwrap();
                    j[(row, 2 * end as usize)] = sign * along.x;
                    j[(row, 2 * end as usize + 1)] = sign * along.y;
                    // d/dt of the unit vector, times the relative velocity: what is across, squared, over the distance.
                    let across = relative.perp_dot(along);
                    rate[row] = across * across / distance;
                }
            }
        }
    }
    let mut total = free.clone();
    if !rods.is_empty() {
        let w = DMatrix::from_diagonal(&DVector::from_fn(2 * n, |i, _| bodies.inverse_mass[i / 2]));
        let a = &j * &w * j.transpose();
        // Singular values below this part of the largest are those of redundant rods.
        let smallest = 1e-12 * a.amax();
        let lambda = a.svd(true, true).solve(&-(&rate + &j * &free), smallest).unwrap();
        total += w * j.transpose() * lambda;
    }
    (0..n).map(|i| DVec2::new(total[2 * i], total[2 * i + 1])).collect()
}

/// The world as the reference has it: bodies where it has them, with the velocities that their rods allow.
fn placed(mut world: World, reference: &Reference) -> World {
    let ids: Vec<_> = world.bodies().id.clone();
    for ((id, position), velocity) in ids.into_iter().zip(reference.positions()).zip(reference.velocities()) {
        let body = world.body(id).unwrap();
        world.set_body(id, &Body { position, velocity, ..body }).unwrap();
    }
    world
}

/// Worst distance of the solver's accelerations from the library's, relative to the largest.
fn acceleration_error(world: World, mut reference: Reference) -> f64 {
    let expected = dense_accelerations(&placed(world, &reference));
    let size = expected.iter().map(|a| a.length()).fold(1.0, f64::max);
    let found = reference.accelerations();
    found.iter().zip(&expected).map(|(a, b)| (*a - *b).length()).fold(0.0, f64::max) / size
}

#[test]
fn accelerations_in_full_motion_are_those_of_a_dense_decomposition() {
    for name in ["truth/double_pendulum", "truth/rope", "truth/bridge", "truth/stiff_chain"] {
        let world = scene::open(name).unwrap().world;
        let mut reference = Reference::new(&world, 1e-16).unwrap();
        (0..30).for_each(|_| reference.advance().unwrap());
        let error = acceleration_error(world, reference);
        println!("{name}: {error:.1e}");
        // Doubles, with condition numbers of the matrix up to 1e5.
        assert!(error < 1e-10, "{name}: {error:e}");
    }
}

#[test]
fn moving_nets_of_rods_and_damped_springs_have_the_accelerations_of_a_dense_decomposition() {
    let mut world = scene_world(
        r#"bodies: [Particle(name: "end", position: (1.5, 0.5), mass: 2, radius: 0)],
           generators: [
               Net(name: "net", columns: 5, rows: 4, chord: 0.9, radius: 0),
               Rope(name: "rope", from: (0, -1), to: (2, -2), links: 6, link: Spring(stiffness: 40, damping: 3), radius: 0),
           ],
           constraints: [Rod(a: "end", b: "net.4.2"), Spring(a: "net.2.3", b: (3, 1), rest: 1, stiffness: 9, damping: 1)]"#,
    );
    // Any velocities: the solver takes out of them what the rods forbid.
    let ids: Vec<_> = world.bodies().id.clone();
    for (i, id) in ids.into_iter().enumerate() {
        let body = world.body(id).unwrap();
        let velocity = if body.motion == Motion::Dynamic { DVec2::from_angle(i as f64) } else { DVec2::ZERO };
        world.set_body(id, &Body { velocity, ..body }).unwrap();
    }
    let reference = Reference::new(&world, 1e-16).unwrap();
    let error = acceleration_error(world, reference);
    println!("{error:.1e}");
    assert!(error < 1e-11, "{error:e}");
}

#[test]
fn redundant_rods_change_nothing() {
    // A square with both diagonals hangs from a corner: five rods are enough to make it rigid.
    let square = |more: &str| {
        let (a, b) =
            (r#"Rod(a: (0, 0), b: "a"), Rod(a: "a", b: "b"), Rod(a: "b", b: "c"), "#, r#"Rod(a: "a", b: "c"),"#);
        scene_world(&format!(
            r#"bodies: [
                Particle(name: "a", position: (1, 0), radius: 0), Particle(name: "b", position: (2, 0), radius: 0),
                Particle(name: "c", position: (2, 1), radius: 0), Particle(name: "d", position: (1, 1), radius: 0)],
            constraints: [{a} {b} Rod(a: "c", b: "d"), Rod(a: "d", b: "a"), {more}]"#
        ))
    };
    let [plain, braced] =
        [square(""), square(r#"Rod(a: "b", b: "d")"#)].map(|world| converge(&world, 1.0, 1.0).unwrap());
    let worst = plain.positions.iter().flatten().zip(braced.positions.iter().flatten());
    let worst = worst.map(|(a, b)| (*a - *b).length()).fold(0.0, f64::max);
    println!("{worst:.1e} m, agreement {:.1e}", braced.agreement);
    // The last diagonal's length is √2 rounded: 1e-16 off.
    assert!(worst < 1e-14 && braced.agreement < 1e-15);
}

#[test]
fn what_has_no_equations_is_named() {
    let refused = |text: &str| match Reference::new(&scene_world(text), 1e-20) {
        Err(TruthError::Unfit { what }) => what,
        other => panic!("{text}: {other:?}"),
    };
    assert!(refused("bodies: [Disc(radius: 1)]").contains("turns"));
    assert!(refused("bodies: [Particle(motion: Kinematic)]").contains("kinematic"));
    assert!(refused("bodies: [Particle(), Particle(position: (5, 0))]").contains("each other"));
    assert!(refused("bodies: [Particle()], walls: [Box(min: (0, -3), max: (1, -2))]").contains("wall"));
    assert!(refused("generators: [Rope(link: Rope)]").contains("Rope"));
}

#[test]
fn rods_that_contradict_each_other_stall_instead_of_running_on() {
    let world = scene_world(
        r#"bodies: [Particle(name: "a", position: (1, 0), radius: 0)],
           constraints: [Rod(a: (0, 0), b: "a", length: 1), Rod(a: (3, 0), b: "a", length: 1)]"#,
    );
    let mut reference = Reference::new(&world, TOLERANCES[1]).unwrap();
    let end = (0..60).try_for_each(|_| reference.advance());
    assert!(matches!(end, Err(TruthError::Stalled { .. })), "{end:?}");
}
