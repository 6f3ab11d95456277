//! Motion that no constraint touches.

use super::figures::Figures;
use super::lab::*;
use tautline::engine::{Body, Integrator, Motion, Spin, World};

#[test]
fn a_thrown_body_follows_its_parabola() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 4, 10)) {
        let mut world = World::new();
        world.add_body(&point(v(0.0, 1.0), v(3.0, 4.0))).unwrap();
        run(&mut world, method, 2.0);
        let (t, h) = (2.0, method.substep_seconds());
        // Summing h g over the substeps of an Euler step is off by half a substep's fall at each: ½ g h t in all.
        let late = match method.integrator {
            Integrator::ExplicitEuler => 0.5 * G * h * t,
            Integrator::SemiImplicitEuler => -0.5 * G * h * t,
            _ => 0.0,
        };
        let truth = v(3.0 * t, 1.0 + 4.0 * t - 0.5 * G * t * t);
        let at = position(&world, 0);
        // 480 additions of numbers up to 10 round by 480 · 1e-15 at the very most.
        figures.near(&format!("{}, x [m]", label(&method)), at.x, truth.x, 1e-12);
        figures.near(
            &format!("{}, y [m], first-order error {late:.4} known", label(&method)),
            at.y,
            truth.y + late,
            1e-12,
        );
        figures.near(&format!("{}, vy [m/s]", label(&method)), velocity(&world, 0).y, 4.0 - G * t, 1e-12);
    }
}

#[test]
fn a_body_that_nothing_pushes_keeps_its_velocity_and_spin() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 4, 10)) {
        let mut world = weightless();
        let spin = Some(Spin { angle: 0.5, omega: 3.0 });
        world.add_body(&Body { spin, ..ball(v(1.0, 2.0), v(-3.0, 0.7)) }).unwrap();
        run(&mut world, method, 10.0);
        let turned = world.bodies().spin(0).unwrap();
        // 2,400 additions of numbers up to 30.
        figures.at_most(&label(&method), position(&world, 0).distance(v(-29.0, 9.0)), 1e-11);
        figures.near(&format!("{}, angle [rad]", label(&method)), turned.angle, 30.5, 1e-11);
        assert_eq!((velocity(&world, 0), turned.omega), (v(-3.0, 0.7), 3.0), "nothing may touch the velocity");
    }
}

#[test]
fn kinematic_bodies_move_unpushed_and_static_ones_stay() {
    for method in every_method(rate(60.0, 4, 10)) {
        let mut world = World::new();
        let at = v(2.0, 1.0);
        world.add_body(&Body { motion: Motion::Static, ..ball(at, v(1.0, 0.0)) }).unwrap();
        world.add_body(&Body { motion: Motion::Kinematic, ..ball(v(0.0, 0.0), v(0.25, 0.5)) }).unwrap();
        // Something that falls on both.
        world.add_body(&ball(v(2.05, 1.5), v(0.0, 0.0))).unwrap();
        world.add_body(&ball(v(0.2, 1.0), v(0.0, 0.0))).unwrap();
        run(&mut world, method, 2.0);
        assert_eq!(position(&world, 0), at, "{}", label(&method));
        assert_eq!(velocity(&world, 1), v(0.25, 0.5), "{}", label(&method));
        // 480 additions.
        assert!(position(&world, 1).distance(v(0.5, 1.0)) < 1e-12, "{}", label(&method));
    }
}

#[test]
fn a_fall_with_drag_reaches_its_limiting_speed_along_the_exact_curve() {
    let mut figures = Figures::default();
    let (drag, t) = (0.5, 3.0);
    let limit = G / drag;
    let fallen = -limit * (t - (1.0 - (-drag * t).exp()) / drag);
    for method in every_method(rate(60.0, 4, 10)) {
        let mut world = World::new();
        world.set_drag(drag).unwrap();
        world.add_body(&point(v(0.0, 0.0), v(0.0, 0.0))).unwrap();
        run(&mut world, method, t);
        // Errors of one order: about ½ g t h, of the other: g t drag h².
        let h = method.substep_seconds();
        let tolerance = if second_order(&method) { G * t * drag * h * h } else { 0.6 * G * t * h };
        figures.near(&format!("{}, y [m]", label(&method)), position(&world, 0).y, fallen, tolerance);
        run(&mut world, method, 60.0);
        // The limit of the discrete motion is off by drag · h/2 for an Euler step.
        let tolerance = if second_order(&method) { limit * (drag * h).powi(2) } else { limit * drag * h };
        figures.near(&format!("{}, limiting speed [m/s]", label(&method)), -velocity(&world, 0).y, limit, tolerance);
    }
}
