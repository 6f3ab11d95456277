//! Bodies at rest on each other.

use super::figures::Figures;
use super::lab::*;
use tautline::engine::{Body, DVec2, Solver, Touching, Wall, World};

/// `count` discs of 0.25 m and 1 kg on each other on the ground.
fn stack(count: u32) -> World {
    let mut world = World::new();
    world.add_wall(&Wall::block(v(-3.0, -0.3), v(3.0, 0.0))).unwrap();
    for i in 0..count {
        let body = Body { radius: 0.25, friction: 0.5, ..ball(v(0.0, 0.25 + 0.5 * f64::from(i)), DVec2::ZERO) };
        world.add_body(&body).unwrap();
    }
    world
}

#[test]
fn a_stack_of_ten_stands_still_and_each_contact_carries_the_weight_above() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 4, 10)) {
        let mut world = stack(10);
        run(&mut world, method, 10.0);
        let name = label(&method);
        let sunk = (0..10).map(|i| (position(&world, i).y - 0.25 - 0.5 * i as f64).abs()).fold(0.0, f64::max);
        // One percent of a radius is what nobody sees.
        figures.at_most(&format!("{name}, moved in 10 s [m]"), sunk, 0.0025);
        let top = position(&world, 9);
        run(&mut world, method, 10.0);
        figures.at_most(&format!("{name}, creep in the next 10 s [m]"), position(&world, 9).distance(top), 1e-4);
        // A projection mends positions: the velocities may keep what gravity adds in a substep, g h.
        let rest = if method.solver == Solver::Projection { 1.01 * G * method.substep_seconds() } else { 1e-3 };
        figures.at_most(&format!("{name}, speed [m/s]"), velocity(&world, 9).length(), rest);
        for contact in world.contacts() {
            let below = match contact.b {
                Touching::Body(b) => contact.a.min(b) + 1,
                Touching::Wall(_) => 0,
            };
            let weight = G * f64::from(10 - below);
            // The sweeps leave a part of a percent of the whole weight.
            figures.near(&format!("{name}, under disc {below} [N]"), contact.normal_force, weight, 0.01 * 10.0 * G);
        }
        assert_eq!(world.contacts().len(), 10, "{name}");
    }
}

#[test]
fn bodies_spawned_inside_each_other_part_without_being_launched() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 4, 10)) {
        let mut world = stack(1);
        for i in 0..8 {
            let at = v(0.02 * f64::from(i), 0.25 + 0.01 * f64::from(i % 3));
            world.add_body(&Body { radius: 0.25, ..ball(at, DVec2::ZERO) }).unwrap();
        }
        let mut highest: f64 = 0.0;
        watch(&mut world, method, 2.0, |world, _| {
            highest = world.bodies().position.iter().map(|at| at.y).fold(highest, f64::max);
        });
        // Nine discs of 0.5 m on each other are 4.5 m high; whatever is thrown higher was launched.
        figures.at_most(&format!("{}, highest centre [m]", label(&method)), highest, 4.5);
    }
}
