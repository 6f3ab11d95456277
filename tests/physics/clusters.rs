//! Free bodies by accuracy beside what is not carried: only what can be reached goes through the substeps.

use super::lab::*;
use tautline::engine::{Anchor, Body, Constraint, DVec2, Grip, Kind, Method, Motion, Spin, Stepper, Wall, World};

fn by_accuracy() -> Method {
    Method { automatic: true, ..Method::default() }
}

/// A long floor with a ball that bounces at x, for each x.
fn bouncing(at: impl IntoIterator<Item = f64>) -> World {
    let mut world = World::new();
    let floor = Wall::block(v(-1e4, -1.0), v(1e4, 0.0));
    world.add_wall(&Wall { restitution: 0.8, friction: 0.3, ..floor }).unwrap();
    for x in at {
        let body = ball(v(x, 1.0 + 0.01 * (x * 0.37).sin()), v(0.1, 0.0));
        world.add_body(&Body { friction: 0.5, spin: Some(Spin::default()), ..body }).unwrap();
    }
    world
}

/// Steps both worlds for `seconds` by accuracy and asserts that the bodies `same` of `world` keep the bits of the bodies of `alone`, in their order.
fn keeps_bits(
    name: &str,
    world: &mut World,
    same: impl Iterator<Item = usize> + Clone,
    alone: &mut World,
    seconds: f64,
) {
    let mut steppers = [(); 2].map(|()| Stepper::new(by_accuracy()).unwrap());
    for step in 0..(60.0 * seconds) as u32 {
        let report = steppers[0].step(world);
        assert!(report.divergence.is_none() && report.given_up == 0, "{name}, step {step}: {report:?}");
        let report = steppers[1].step(alone);
        assert!(report.substeps == 0 && report.given_up == 0, "{name}, step {step}, alone: {report:?}");
        for (place, body) in same.clone().enumerate() {
            let (one, other) = (world.bodies().get(body), alone.bodies().get(place));
            assert!(one == other, "{name}, step {step}, body {body}: {one:?} instead of {other:?}");
        }
    }
}

#[test]
fn a_kinematic_body_takes_only_what_it_comes_near_to() {
    for (speed, from) in [(2.0, -8.0), (-2.0, 8.0), (0.0, 3.0)] {
        let mut world = bouncing([0.0, 40.0, -55.0]);
        let pusher = ball(v(from, 0.5), v(speed, 0.0));
        world.add_body(&Body { motion: Motion::Kinematic, radius: 0.5, ..pusher }).unwrap();
        let (mut hit, mut alone) = (0, bouncing([40.0, -55.0]));
        let mut stepper = Stepper::new(by_accuracy()).unwrap();
        let few = stepper.plan(&world).few.as_ref().map(|few| few.bodies.len());
        assert_eq!(few, Some(3), "the pusher is left to the substeps, the balls are not");
        let sentence = stepper.plan(&world).sentence(&world, &by_accuracy());
        assert!(sentence.contains("those near what moves otherwise through the substeps"), "{sentence}");
        keeps_bits(&format!("a pusher at {speed} m/s"), &mut world.clone(), 1..3, &mut alone, 6.0);
        watch(&mut world, by_accuracy(), 6.0, |_, report| hit += report.near);
        println!("a pusher at {speed} m/s from {from} m is near in {hit} of 360 steps");
        assert_eq!(hit > 0, speed != 0.0, "the pusher meets the ball");
        let moved = position(&world, 0).x;
        assert!(speed == 0.0 || (moved - 0.6).abs() > 1.0 && moved * speed > 0.0, "the ball was pushed to {moved}");
    }
}

#[test]
fn more_free_bodies_than_fit_together_are_carried_where_they_cannot_meet() {
    let places = |n: u32| (0..n).map(|k| 2.0 * f64::from(k));
    let mut world = bouncing(places(300));
    let mut alone = bouncing(places(100));
    keeps_bits("300 balls", &mut world, 0..100, &mut alone, 3.0);
}

#[test]
fn joined_bodies_and_the_mouse_take_only_what_they_come_near_to() {
    let mut world = bouncing([0.0, 40.0]);
    // A pair on a rod falls beside the first ball, and the mouse holds a third one.
    let one = world.add_body(&ball(v(0.3, 1.5), DVec2::ZERO)).unwrap();
    let other = world.add_body(&ball(v(0.9, 1.5), DVec2::ZERO)).unwrap();
    let rod = Constraint { kind: Kind::Rod { length: 0.6 }, a: Anchor::centre(one), b: Anchor::centre(other) };
    world.add_constraint(&rod).unwrap();
    let held = world.add_body(&ball(v(-20.0, 1.0), DVec2::ZERO)).unwrap();
    world.set_grip(Some(Grip::new(held, DVec2::ZERO, v(-22.0, 2.0), 1.0))).unwrap();
    keeps_bits("a pair and the mouse", &mut world, 1..2, &mut bouncing([40.0]), 3.0);
    let off = position(&world, 4).distance(v(-22.0, 2.0));
    assert!(off < 0.05, "the mouse leads: {off} m off");
}

#[test]
fn a_light_ball_hit_by_a_heavy_one_meets_what_was_out_of_reach() {
    // Speeds of ways of many radii a step: the light one leaves at twice the speed of the heavy one, and hits a third that stands beyond
    // the heavy one's way.
    for (mass, speed, gap) in [(1e6, 60.0, 0.5), (1e6, -60.0, 0.5), (1e3, 45.0, 0.3), (1e6, 60.0, 1.2)] {
        let mut world = weightless();
        let elastic = |x: f64, mass: f64, speed: f64| Body { mass, restitution: 1.0, ..ball(v(x, 0.0), v(speed, 0.0)) };
        let way = f64::signum(speed);
        world.add_body(&elastic(0.0, mass, speed)).unwrap();
        world.add_body(&elastic(0.35 * way, 1.0, 0.0)).unwrap();
        world.add_body(&elastic((0.55 + gap) * way, 1.0, 0.0)).unwrap();
        let before = (momentum(&world), kinetic_energy(&world));
        let mut passed = false;
        watch(&mut world, by_accuracy(), 0.1, |world, report| {
            assert!(report.given_up == 0 && report.substeps == 0, "{report:?}");
            let x: Vec<f64> = (0..3).map(|body| way * position(world, body).x).collect();
            passed |= x[1] < x[0] + 0.2 - 1e-9 || x[2] < x[1] + 0.2 - 1e-9;
        });
        let after = (momentum(&world), kinetic_energy(&world));
        let (lost, gained) = ((after.0 - before.0).length() / before.0.length(), after.1 / before.1 - 1.0);
        println!("{mass} kg at {speed} m/s, {gap} m: momentum {lost:.1e}, energy {gained:.1e}");
        assert!(!passed && lost < 1e-12 && gained.abs() < 1e-12);
        assert!(velocity(&world, 2).length() > speed.abs(), "the last one flies ahead");
    }
}
