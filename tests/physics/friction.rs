//! Sliding, sticking and rolling on an incline.

use super::figures::Figures;
use super::lab::*;
use tautline::engine::{Body, DVec2, Method, Spin, Wall, World};

/// A disc that touches an incline of `slope` [rad] from above, with `friction`; the incline descends to the right.
fn incline(slope: f64, friction: f64, spin: Option<Spin>) -> World {
    let mut world = World::new();
    let down = DVec2::from_angle(-slope);
    world.add_wall(&Wall { friction, ..Wall::segment(-down, 100.0 * down) }).unwrap();
    world.add_body(&Body { friction, spin, ..ball(0.1 * down.perp(), DVec2::ZERO) }).unwrap();
    world
}

/// Way down the incline and distance off it after `seconds`.
fn slide(world: &mut World, slope: f64, method: Method, seconds: f64) -> (f64, f64) {
    let down = DVec2::from_angle(-slope);
    let start = position(world, 0);
    run(world, method, seconds);
    let way = position(world, 0) - start;
    (way.dot(down), way.dot(down.perp()))
}

#[test]
fn a_block_slides_down_an_incline_with_coulombs_acceleration() {
    let mut figures = Figures::default();
    let slope = 0.5f64;
    for method in every_method(rate(60.0, 4, 10)) {
        for friction in [0.0, 0.2, 0.4] {
            let acceleration = G * (slope.sin() - friction * slope.cos());
            let (way, off) = slide(&mut incline(slope, friction, None), slope, method, 2.0);
            let name = format!("{}, friction {friction}", label(&method));
            // First order, as a fall is in Euler's methods: ½ a h t. Contacts make the second-order ones no worse.
            let tolerance = 0.5 * acceleration * method.substep_seconds() * 2.0 + 1e-9;
            figures.near(&format!("{name}, way [m]"), way, 2.0 * acceleration, 1.01 * tolerance);
            // Touching all the time.
            figures.at_most(&format!("{name}, off the incline [m]"), off.abs(), 1e-4);
        }
    }
}

#[test]
fn a_block_under_the_angle_of_friction_sticks() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 4, 10)) {
        for (slope, friction) in [(0.2f64, 0.5), (0.5, 0.6)] {
            let mut world = incline(slope, friction, None);
            let (way, _) = slide(&mut world, slope, method, 10.0);
            let name = format!("{}, slope {slope}, friction {friction}", label(&method));
            // The first substep starts without knowing the normal force: h² g sin θ = 1e-4 m may be slid before it holds.
            figures.at_most(&format!("{name}, slid [m]"), way.abs(), 2e-4);
            let (creep, _) = slide(&mut world, slope, method, 10.0);
            figures.at_most(&format!("{name}, creep in the next 10 s [m]"), creep.abs(), 1e-9);
            let contact = world.contacts()[0];
            figures.near(&format!("{name}, normal force [N]"), contact.normal_force, G * slope.cos(), 1e-6 * G);
            figures.near(&format!("{name}, friction [N]"), contact.tangent_force.abs(), G * slope.sin(), 1e-6 * G);
        }
    }
}

#[test]
fn a_sliding_block_stops_where_its_energy_is_used_up() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 4, 10)) {
        let mut world = incline(0.0, 0.3, None);
        let body = Body { velocity: v(3.0, 0.0), ..world.body(world.bodies().id[0]).unwrap() };
        world.set_body(world.bodies().id[0], &body).unwrap();
        let (way, _) = slide(&mut world, 0.0, method, 3.0);
        // ½ v h is the first-order error of a braked motion.
        let tolerance = 0.5 * 3.0 * method.substep_seconds() + 1e-3;
        figures.near(&format!("{}, way [m]", label(&method)), way, 9.0 / (2.0 * 0.3 * G), tolerance);
        figures.at_most(&format!("{}, speed left [m/s]", label(&method)), velocity(&world, 0).x.abs(), 1e-9);
    }
}

#[test]
fn a_disc_rolls_down_with_two_thirds_of_the_acceleration() {
    let mut figures = Figures::default();
    let slope = 0.5f64;
    for method in every_method(rate(60.0, 4, 10)) {
        let mut world = incline(slope, 0.6, Some(Spin::default()));
        let (way, _) = slide(&mut world, slope, method, 2.0);
        let acceleration = 2.0 / 3.0 * G * slope.sin();
        // First order: ½ a h t.
        let tolerance = 1.01 * 0.5 * acceleration * method.substep_seconds() * 2.0;
        figures.near(&format!("{}, way [m]", label(&method)), way, 2.0 * acceleration, tolerance);
        let slip = velocity(&world, 0).length() + 0.1 * world.bodies().spin(0).unwrap().omega;
        // Rolling is a row of the solve: exact up to the last half kick of a substep.
        figures.at_most(&format!("{}, slip [m/s]", label(&method)), slip.abs(), 0.5 * G * method.substep_seconds());
    }
}

#[test]
fn a_disc_too_steep_to_roll_slips_and_spins_up() {
    let mut figures = Figures::default();
    let (slope, friction) = (1.0f64, 0.2);
    for method in every_method(rate(60.0, 4, 10)) {
        let mut world = incline(slope, friction, Some(Spin::default()));
        let (way, _) = slide(&mut world, slope, method, 1.0);
        let acceleration = G * (slope.sin() - friction * slope.cos());
        let tolerance = 0.51 * acceleration * method.substep_seconds() + 1e-9;
        figures.near(&format!("{}, way [m]", label(&method)), way, 0.5 * acceleration, tolerance);
        // Torque μ m g cos θ · r on ½ m r².
        let omega = -2.0 * friction * G * slope.cos() / 0.1;
        let turning = world.bodies().spin(0).unwrap().omega;
        figures.near(&format!("{}, spin [rad/s]", label(&method)), turning, omega, omega.abs() * 0.01);
    }
}
