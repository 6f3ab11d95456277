//! Nothing fast gets through anything.

use super::figures::Figures;
use super::lab::*;
use std::f64::consts::PI;
use tautline::engine::{Body, DVec2, Method, Motion, Wall};

/// Rates and substeps from the coarsest that anybody uses.
const RATES: [(f64, u32); 5] = [(30.0, 1), (60.0, 1), (60.0, 4), (120.0, 8), (240.0, 1)];

#[test]
fn a_bullet_never_passes_a_thin_wall() {
    let mut figures = Figures::default();
    for (hz, substeps) in RATES {
        for method in every_method(rate(hz, substeps, 10)) {
            let (mut shots, mut passed, mut turned) = (0, 0, 0.0f64);
            for i in 0..36 {
                let angle = -80.0 + 160.0 * f64::from(i) / 35.0;
                let direction = DVec2::from_angle(angle * PI / 180.0);
                for (block, e, spin) in [(true, 0.0, false), (true, 1.0, true), (false, 0.0, true), (false, 1.0, false)]
                {
                    let mut world = weightless();
                    let wall = if block {
                        Wall::block(v(0.0, -1000.0), v(0.02, 1000.0))
                    } else {
                        Wall::segment(v(0.0, -1000.0), v(0.0, 1000.0))
                    };
                    world.add_wall(&Wall { friction: 0.0, restitution: e, ..wall }).unwrap();
                    // A little way off that is no multiple of a substep's path.
                    let start = v(-0.05, 0.0) - (1.0 + 0.37 * f64::from(i)) * direction;
                    let spin = spin.then(Default::default);
                    world.add_body(&Body { radius: 0.05, spin, ..ball(start, 500.0 * direction) }).unwrap();
                    let mut inside: f64 = f64::NEG_INFINITY;
                    // Position Verlet looks a whole substep ahead from its middle and so closes a gap by halves: 40 substeps
                    // leave 500 m/s · 2⁻⁴⁰.
                    let seconds = (40.0 * method.substep_seconds()).max(0.2);
                    watch(&mut world, method, seconds, |world, _| inside = inside.max(position(world, 0).x));
                    shots += 1;
                    passed += u32::from(inside > 0.0);
                    let mirrored = 500.0 * v(-e * direction.x, direction.y);
                    turned = turned.max(velocity(&world, 0).distance(mirrored));
                }
            }
            let name = format!("{hz} Hz × {substeps}, {}, {shots} shots", label(&method));
            figures.at_most(&format!("{name}, passed"), f64::from(passed), 0.0);
            // The nearest point of a wall of 2 km is rounded at 1e-13 m, which turns a normal of 5 cm by 1e-11.
            figures.at_most(&format!("{name}, velocity after [m/s]"), turned, 1e-8);
        }
    }
}

#[test]
fn a_bullet_stays_in_an_acute_corner() {
    let mut figures = Figures::default();
    // A wedge that opens by atan ½ = 26.6°, closed at its far end.
    let (top, far) = (v(10.0, 5.0), v(10.0, 0.0));
    let beyond = |at: DVec2| (-at.y).max(top.perp_dot(at) / top.length()).max(at.x - 10.0);
    for (hz, substeps) in RATES {
        for method in every_method(rate(hz, substeps, 10)) {
            for (e, friction) in [(0.0, 0.5), (0.5, 0.0), (1.0, 0.0), (1.0, 0.5)] {
                let mut farthest = f64::NEG_INFINITY;
                for i in 0..12 {
                    let mut world = weightless();
                    for (from, to) in [(DVec2::ZERO, far), (far, top), (top, DVec2::ZERO)] {
                        world.add_wall(&Wall { restitution: e, friction, ..Wall::segment(from, to) }).unwrap();
                    }
                    let direction = DVec2::from_angle(PI + 0.464 * (f64::from(i) + 0.5) / 12.0);
                    let body = Body { radius: 0.05, friction, ..ball(v(8.0, 2.0), 200.0 * direction) };
                    world.add_body(&body).unwrap();
                    watch(&mut world, method, 0.5, |world, _| farthest = farthest.max(beyond(position(world, 0))));
                }
                let name = format!("{hz} Hz × {substeps}, {}, e {e}, friction {friction}", label(&method));
                figures.at_most(&format!("{name}, centre beyond a wall [m]"), farthest, 0.0);
            }
        }
    }
}

#[test]
fn two_bullets_do_not_pass_each_other() {
    let mut figures = Figures::default();
    for (hz, substeps) in RATES {
        for method in every_method(rate(hz, substeps, 10)) {
            for e in [0.0, 1.0] {
                let mut closest = f64::INFINITY;
                for i in 0..20 {
                    let mut world = weightless();
                    let apart = 3.0 + 0.83 * f64::from(i);
                    let bullet =
                        |x: f64, speed: f64| Body { radius: 0.05, restitution: e, ..ball(v(x, 0.0), v(speed, 0.0)) };
                    world.add_body(&bullet(-apart, 500.0)).unwrap();
                    world.add_body(&bullet(apart, -500.0)).unwrap();
                    watch(&mut world, method, 0.1, |world, _| {
                        closest = closest.min(position(world, 1).x - position(world, 0).x);
                    });
                }
                let name = format!("{hz} Hz × {substeps}, {}, e {e}", label(&method));
                // Their order is kept and nobody sees an overlap: at most half a radius deep.
                figures.at_most(&format!("{name}, overlap [m]"), 0.1 - closest, 0.025);
            }
        }
    }
}

#[test]
fn a_bullet_does_not_pass_a_small_immovable_disc() {
    let mut figures = Figures::default();
    for (hz, substeps) in RATES {
        for method in every_method(rate(hz, substeps, 10)) {
            let mut farthest = f64::NEG_INFINITY;
            for i in 0..20 {
                let mut world = weightless();
                let start = v(-2.0 - 0.41 * f64::from(i), 0.0);
                world.add_body(&Body { radius: 0.05, ..ball(start, v(500.0, 0.0)) }).unwrap();
                world
                    .add_body(&Body { radius: 0.02, motion: Motion::Static, ..ball(DVec2::ZERO, DVec2::ZERO) })
                    .unwrap();
                watch(&mut world, method, 0.1, |world, _| farthest = farthest.max(position(world, 0).x));
            }
            figures.at_most(&format!("{hz} Hz × {substeps}, {}, farthest [m]", label(&method)), farthest, 0.0);
        }
    }
}

#[test]
fn a_fast_grip_pulls_no_body_through_a_wall() {
    let mut figures = Figures::default();
    for method in every_method(Method { iterations: 1, ..rate(30.0, 1, 1) }) {
        let mut world = weightless();
        world.add_wall(&smooth(v(0.0, -5.0), v(0.0, 5.0))).unwrap();
        let id = world.add_body(&Body { radius: 0.05, ..ball(v(-1.0, 0.0), DVec2::ZERO) }).unwrap();
        let grip = tautline::engine::Grip::new(id, DVec2::ZERO, v(50.0, 0.5), 1.0);
        world.set_grip(Some(tautline::engine::Grip { max_force: 1e6, frequency: 50.0, ..grip })).unwrap();
        let mut farthest = f64::NEG_INFINITY;
        watch(&mut world, method, 3.0, |world, _| farthest = farthest.max(position(world, 0).x));
        figures.at_most(&format!("{}, farthest [m]", label(&method)), farthest, 0.0);
    }
}
