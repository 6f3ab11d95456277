//! The mouse's hold on a body.

use super::figures::{Figures, order};
use super::lab::*;
use std::f64::consts::TAU;
use tautline::engine::{Body, Constraint, DVec2, Grip, Kind, Method, Motion, Spin, World};

/// Angular frequency of the hold [rad/s].
const OMEGA: f64 = TAU * 7.5;

/// A weightless body of `mass` held at its centre, `away` from the target at the origin.
fn held(mass: f64, away: DVec2) -> World {
    let mut world = weightless();
    let id = world.add_body(&Body { mass, ..ball(away, DVec2::ZERO) }).unwrap();
    world.set_grip(Some(Grip::new(id, DVec2::ZERO, DVec2::ZERO, mass))).unwrap();
    world
}

/// Worst distance from x₀ (1 + ω t) e^(−ω t) over a fifth of a second, as a part of x₀.
fn error(method: Method) -> f64 {
    let away = v(0.12, 0.16);
    let mut world = held(1.0, away);
    let mut worst: f64 = 0.0;
    watch(&mut world, method, 0.2, |world, _| {
        let turn = OMEGA * world.time();
        worst = worst.max((position(world, 0) - away * (1.0 + turn) * (-turn).exp()).length());
    });
    worst / 0.2
}

#[test]
fn a_held_body_comes_to_the_mouse_as_a_critically_damped_spring() {
    let mut figures = Figures::default();
    for base in every_method(rate(240.0, 4, 10)) {
        let errors = [4, 8, 16, 32].map(|substeps| error(Method { substeps, ..base }));
        let name = format!("{}: errors {errors:.2?}", label(&base));
        // The hold is solved with implicit Euler, of order 1 with an error of h ω/2 at most (it peaks at (h ω) e⁻²·2).
        figures.at_most(&format!("{name}, 7,680 substeps/s"), errors[3], 0.5 * OMEGA / 7680.0);
        // The coarsest step is still a little off its leading term.
        figures.at_most(&format!("{name}, missing of first order"), 0.9 - order(&errors), 0.0);
    }
}

#[test]
fn a_gram_and_a_tonne_follow_the_mouse_alike() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 4, 10)) {
        let away = v(0.2, -0.1);
        let (mut light, mut heavy) = (held(1e-3, away), held(1e3, away));
        let mut worst: f64 = 0.0;
        for _ in 0..12 {
            run(&mut light, method, 1.0 / 60.0);
            run(&mut heavy, method, 1.0 / 60.0);
            worst = worst.max(position(&light, 0).distance(position(&heavy, 0)));
        }
        figures.at_most(&format!("{}, apart, as a part of the way", label(&method)), worst / away.length(), 0.01);
    }
}

#[test]
fn the_grip_never_pulls_harder_than_its_cap() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 4, 10)) {
        let mut world = held(2.0, v(8.0, 6.0));
        let cap = 100.0 * 9.81 * 2.0;
        let (mut hardest, mut fastest) = (0.0f64, 0.0f64);
        let mut before = DVec2::ZERO;
        watch(&mut world, method, 1.0, |world, _| {
            hardest = hardest.max(world.grip().unwrap().force.length());
            fastest = fastest.max(2.0 * (velocity(world, 0) - before).length() * method.hz);
            before = velocity(world, 0);
        });
        // Rounding of a division.
        figures.at_most(&format!("{}, force over the cap", label(&method)), hardest / cap, 1.0 + 1e-9);
        figures.at_most(&format!("{}, acceleration over the cap's", label(&method)), fastest / cap, 1.0 + 1e-9);
        // From 10 m the cap is reached, or this would prove nothing.
        assert!(hardest > 0.99 * cap, "{}: {hardest} N", label(&method));
        figures.at_most(&format!("{}, away after 1 s [m]", label(&method)), position(&world, 0).length(), 1e-3);
    }
}

#[test]
fn a_disc_held_at_its_rim_hangs_below_the_mouse() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 4, 10)) {
        let mut world = World::new();
        world.set_drag(3.0).unwrap();
        let disc = Body { mass: 3.0, radius: 0.2, spin: Some(Spin::default()), ..ball(DVec2::ZERO, DVec2::ZERO) };
        let id = world.add_body(&disc).unwrap();
        world.set_grip(Some(Grip::new(id, v(0.2, 0.0), v(0.2, 0.0), 3.0))).unwrap();
        run(&mut world, method, 12.0);
        let held_at = world.to_world(0, v(0.2, 0.0));
        let name = label(&method);
        let sag = G / (OMEGA * OMEGA);
        // At rest the hold gives way by g/ω² = 4.4 mm; drag has damped the swing to e⁻¹⁸ of it. Drag that is split off takes
        // its part of what gravity adds in a substep before the hold does: up to drag · h = 1.3 % of the force.
        let split = 3.0 * method.substep_seconds();
        figures.at_most(&format!("{name}, held point off [m]"), held_at.distance(v(0.2, -sag)), 1e-5 + split * sag);
        figures.at_most(
            &format!("{name}, centre below it [m]"),
            position(&world, 0).distance(held_at - v(0.0, 0.2)),
            1e-5,
        );
        figures.at_most(
            &format!("{name}, force [N]"),
            world.grip().unwrap().force.distance(v(0.0, 3.0 * G)),
            (1e-3 + split) * 3.0 * G,
        );
    }
}

#[test]
fn a_body_let_go_keeps_its_velocity() {
    for method in every_method(rate(60.0, 4, 10)) {
        let mut world = held(1.0, v(0.3, 0.0));
        run(&mut world, method, 0.05);
        let thrown = velocity(&world, 0);
        assert!(thrown.length() > 1.0, "{}: it is on its way", label(&method));
        world.set_grip(None).unwrap();
        run(&mut world, method, 1.0);
        assert_eq!(velocity(&world, 0), thrown, "{}", label(&method));
    }
}

#[test]
fn a_pinned_body_follows_the_mouse_and_stays_where_it_is_let_go() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 4, 10)) {
        let mut world = weightless();
        let pinned = world.add_body(&Body { motion: Motion::Static, ..point(v(0.0, 0.0), DVec2::ZERO) }).unwrap();
        let hanging = world.add_body(&point(v(1.0, 0.0), DVec2::ZERO)).unwrap();
        world.add_constraint(&Constraint::between(Kind::Rod { length: 1.0 }, pinned, hanging)).unwrap();
        world.set_grip(Some(Grip::new(pinned, DVec2::ZERO, v(0.0, 0.5), 1.0))).unwrap();
        run(&mut world, method, 1.0);
        // Critically damped at 7.5 Hz: (1 + ωt) e^(−ωt) after one second is far below rounding.
        figures.at_most(
            &format!("{}, off the mouse [m]", label(&method)),
            position(&world, 0).distance(v(0.0, 0.5)),
            1e-9,
        );
        let stretch = position(&world, 0).distance(position(&world, 1)) - 1.0;
        figures.at_most(&format!("{}, rod stretched [m]", label(&method)), stretch.abs(), 1e-3);
        world.set_grip(None).unwrap();
        let before = position(&world, 0);
        run(&mut world, method, 0.5);
        assert_eq!(position(&world, 0), before, "{}: a pinned body moves by itself", label(&method));
    }
}
