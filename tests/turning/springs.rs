//! Springs with dampers at the rims of discs.

use super::independent::converged;
use super::*;

/// A spring of the tests: rest length, stiffness, damping.
const SPRING: (f64, f64, f64) = (0.6, 180.0, 3.0);

fn spring() -> Kind {
    let (rest, stiffness, damping) = SPRING;
    Kind::Spring { rest, stiffness, damping }
}

/// Force of the spring on an end at `away` from the other that moves with `speed` [N].
fn pull(away: DVec2, speed: DVec2) -> DVec2 {
    let (rest, stiffness, damping) = SPRING;
    let along = away.normalize();
    -(stiffness * (away.length() - rest) + damping * speed.dot(along)) * along
}

/// x, y, θ and their rates of a disc: where an anchor of its own axes is, and how it moves.
fn anchor(y: &[f64], local: DVec2) -> (DVec2, DVec2, DVec2) {
    let arm = DVec2::from_angle(y[2]).rotate(local);
    (v(y[0], y[1]) + arm, v(y[3], y[4]) + y[5] * arm.perp(), arm)
}

#[test]
fn a_spring_at_the_rim_turns_the_disc_that_it_pulls() {
    let (mass, radius) = (2.0, 0.5);
    let (local, hook) = (v(0.3, 0.4), v(0.2, 0.9));
    let rate = |_: f64, y: &[f64]| {
        let (at, speed, arm) = anchor(y, local);
        let force = pull(at - hook, speed);
        let inertia = 0.5 * mass * radius * radius;
        vec![y[3], y[4], y[5], force.x / mass, force.y / mass - G, arm.perp_dot(force) / inertia]
    };
    let start = [0.0, 0.0, 0.3, 0.5, -0.2, 4.0];
    let (exact, apart) = converged(rate, &start, 3.0, 480);
    println!("a disc on a spring after 3 s: the reference agrees with itself to {apart:.1e}");
    for accuracy in [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13] {
        let mut world = World::new();
        let body = Body { velocity: v(0.5, -0.2), ..disc(DVec2::ZERO, mass, radius, 0.3, 4.0) };
        let body = world.add_body(&body).unwrap();
        join(&mut world, spring(), Anchor::World(hook), Anchor::Body(body, local));
        let mut stepper = Stepper::new(by_accuracy(accuracy)).unwrap();
        (0..180).for_each(|_| drop(step(&mut world, &mut stepper)));
        let error = (world.bodies().position[0] - v(exact[0], exact[1])).length();
        let turn = (angle(&world, 0) - exact[2]).abs();
        println!("  wanted {accuracy:.0e}: {error:.1e} m, {turn:.1e} rad");
        assert!(error.max(turn) < 10.0 * allowed(accuracy), "{accuracy:e}: {error:e}, {turn:e}");
    }
}

#[test]
fn two_discs_on_pinned_centres_are_geared_by_a_spring_between_their_rims() {
    // One disc turns about its pinned centre, the other hangs by its rim: two angles, a spring between the outer rims, drag.
    let (mass, radius, drag) = (1.5, 0.3, 0.2);
    let (first, second) = (v(0.0, 0.0), v(0.9, 0.0));
    let inertia = 0.5 * mass * radius * radius;
    let rim = |centre: DVec2, angle: f64| centre + radius * DVec2::from_angle(angle);
    let rate = |_: f64, y: &[f64]| {
        let (a, b) = (rim(first, y[0]), rim(second, y[1]));
        let [along_a, along_b] = [y[0], y[1]].map(|angle| radius * DVec2::from_angle(angle));
        let force = pull(b - a, y[3] * along_b.perp() - y[2] * along_a.perp());
        // Drag acts on v and ω alike, and both centres rest.
        vec![
            y[2],
            y[3],
            -along_a.perp_dot(force) / inertia - drag * y[2],
            along_b.perp_dot(force) / inertia - drag * y[3],
        ]
    };
    let (exact, apart) = converged(rate, &[0.4, 2.0, 1.0, -3.0], 3.0, 960);
    println!("two geared discs after 3 s: the reference agrees with itself to {apart:.1e}");
    for accuracy in [1e-5, 1e-9, 1e-13] {
        let mut world = World::new();
        world.set_drag(drag).unwrap();
        let a = world.add_body(&disc(first, mass, radius, 0.4, 1.0)).unwrap();
        let b = world.add_body(&disc(second, mass, radius, 2.0, -3.0)).unwrap();
        for (body, centre) in [(a, first), (b, second)] {
            join(&mut world, Kind::Pin, Anchor::centre(body), Anchor::World(centre));
        }
        join(&mut world, spring(), Anchor::Body(a, v(radius, 0.0)), Anchor::Body(b, v(radius, 0.0)));
        let mut stepper = Stepper::new(by_accuracy(accuracy)).unwrap();
        (0..180).for_each(|_| drop(step(&mut world, &mut stepper)));
        let turn = (angle(&world, 0) - exact[0]).abs().max((angle(&world, 1) - exact[1]).abs());
        println!("  wanted {accuracy:.0e}: {turn:.1e} rad");
        assert!(turn < 30.0 * accuracy + 1e-11, "{accuracy:e}: {turn:e}");
    }
}
