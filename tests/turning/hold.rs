//! The mouse's hold on a rim: a damped spring with a bounded force, and a torque.

use super::independent::converged;
use super::*;
use std::f64::consts::TAU;
use tautline::engine::Grip;

const MASS: f64 = 2.0;
const RADIUS: f64 = 0.4;
const LOCAL: DVec2 = DVec2::new(0.0, RADIUS);
const START: [f64; 6] = [0.1, -0.2, 0.5, 0.3, 0.0, -1.0];

/// The hold's force without and with its bound on a disc at `y` = x, y, θ and their rates; its torque.
fn force(y: &[f64], target: DVec2, most: f64) -> (f64, DVec2, f64) {
    let arm = DVec2::from_angle(y[2]).rotate(LOCAL);
    let (at, speed) = (v(y[0], y[1]) + arm, v(y[3], y[4]) + y[5] * arm.perp());
    let rate = TAU * 7.5;
    let free = -MASS * rate * rate * (at - target) - 2.0 * MASS * rate * speed;
    let bounded = free * (most / free.length()).min(1.0);
    (free.length(), bounded, arm.perp_dot(bounded))
}

fn rate(y: &[f64], target: DVec2, most: f64) -> Vec<f64> {
    let (_, force, torque) = force(y, target, most);
    let inertia = 0.5 * MASS * RADIUS * RADIUS;
    vec![y[3], y[4], y[5], force.x / MASS, force.y / MASS - G, torque / inertia]
}

fn held(target: DVec2, most: f64) -> World {
    let mut world = World::new();
    let body =
        Body { velocity: v(START[3], START[4]), ..disc(v(START[0], START[1]), MASS, RADIUS, START[2], START[5]) };
    let id = world.add_body(&body).unwrap();
    world.set_grip(Some(Grip { max_force: most, ..Grip::new(id, LOCAL, target, MASS) })).unwrap();
    world
}

/// Distance from `exact` [m or rad].
fn distance(world: &World, exact: &[f64]) -> f64 {
    (world.bodies().position[0] - v(exact[0], exact[1])).length().max((angle(world, 0) - exact[2]).abs())
}

#[test]
fn a_disc_held_at_its_rim_follows_the_mouse_to_the_wanted_accuracy() {
    // Near, where the bound is never met, and far, where it always is.
    for (target, most, seconds) in [(v(0.2, 0.3), 1e4, 1.0), (v(300.0, 200.0), 60.0, 0.5)] {
        let (exact, apart) = converged(|_, y| rate(y, target, most), &START, seconds, (960.0 * seconds) as usize);
        println!("held at the rim, at most {most:.0e} N: the reference agrees with itself to {apart:.1e}");
        for accuracy in [1e-5, 1e-8, 1e-12] {
            let (mut world, mut stepper) = (held(target, most), Stepper::new(by_accuracy(accuracy)).unwrap());
            let mut largest = 0.0f64;
            for _ in 0..(60.0 * seconds) as u32 {
                step(&mut world, &mut stepper);
                largest = largest.max(world.grip().unwrap().force.length());
            }
            let error = distance(&world, &exact);
            println!("  wanted {accuracy:.0e}: {error:.1e}, at most {largest} N");
            // Parts of the scene's length, which is that to the anchor: far below a metre.
            assert!(error < 10.0 * accuracy + 1e-12, "{accuracy:e}: {error:e}");
            assert!(largest <= most * (1.0 + 1e-15));
        }
    }
}

/// The exact motion through the instant at which the bound ceases to act: the reference is cut there.
#[test]
fn the_bound_of_the_hold_is_left_at_its_instant() {
    let (target, most, seconds) = (v(0.6, 0.5), 150.0, 0.75);
    let excess = |y: &[f64]| force(y, target, most).0 - most;
    // Pieces between changes of sign of the excess, found by bisection on the reference itself.
    let (mut t, mut y, mut changes) = (0.0, START.to_vec(), 0);
    while t < seconds {
        let h = (1.0f64 / 960.0).min(seconds - t);
        let bounded = excess(&y) > 0.0;
        let most_now = if bounded { most } else { f64::INFINITY };
        let go = |h: f64| super::independent::integrate(|_, y| smooth_rate(y, target, most_now, bounded), &y, h, 1);
        if (excess(&go(h)) > 0.0) == bounded {
            y = go(h);
            t += h;
            continue;
        }
        let (mut low, mut high) = (0.0, h);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if (excess(&go(middle)) > 0.0) == bounded { low = middle } else { high = middle }
        }
        y = go(high);
        t += high;
        changes += 1;
    }
    assert!(changes > 0, "the bound was met");
    for accuracy in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
        let (mut world, mut stepper) = (held(target, most), Stepper::new(by_accuracy(accuracy)).unwrap());
        for _ in 0..(60.0 * seconds) as u32 {
            step(&mut world, &mut stepper);
        }
        let error = distance(&world, &y);
        println!("through {changes} changes of the bound, wanted {accuracy:.0e}: {error:.1e}");
        assert!(error < 20.0 * accuracy.min(1e-5) + 1e-11, "{accuracy:e}: {error:e}");
    }
}

/// As [`rate`], but with the force continued smoothly on both sides of the bound.
fn smooth_rate(y: &[f64], target: DVec2, most: f64, bounded: bool) -> Vec<f64> {
    if !bounded {
        return rate(y, target, f64::INFINITY);
    }
    let (size, ..) = force(y, target, f64::INFINITY);
    let (_, free, torque) = force(y, target, f64::INFINITY);
    let (force, torque) = (free * (most / size), torque * (most / size));
    let inertia = 0.5 * MASS * RADIUS * RADIUS;
    vec![y[3], y[4], y[5], force.x / MASS, force.y / MASS - G, torque / inertia]
}

#[test]
fn a_hold_on_the_rim_that_moves_along_it_is_followed() {
    // The grabbed point may change without a new plan.
    let (mut world, mut stepper) = (held(v(0.1, 0.1), 1e4), Stepper::new(by_accuracy(1e-10)).unwrap());
    step(&mut world, &mut stepper);
    let body = world.bodies().id[0];
    let other = Grip::new(body, v(RADIUS, 0.0), v(0.1, 0.1), MASS);
    world.set_grip(Some(other)).unwrap();
    let mut fresh = world.clone();
    (0..30).for_each(|_| drop(step(&mut world, &mut stepper)));
    let mut stepper = Stepper::new(by_accuracy(1e-10)).unwrap();
    (0..30).for_each(|_| drop(step(&mut fresh, &mut stepper)));
    assert_eq!(world.hash(), fresh.hash(), "a fresh stepper goes on with the same bits");
    // Let go, nothing turns it any more: a free disc.
    world.set_grip(None).unwrap();
    let turning = omega(&world, 0);
    let mut stepper = Stepper::new(by_accuracy(1e-10)).unwrap();
    let plan = stepper.plan(&world);
    assert!(!plan.spin && plan.islands.iter().all(|island| island.turning == 0));
    stepper.step(&mut world);
    assert_eq!(omega(&world, 0), turning);
}
