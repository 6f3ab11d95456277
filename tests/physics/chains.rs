//! Chains of rods and bodies pinned to each other.

use super::figures::Figures;
use super::lab::*;
use tautline::engine::{Anchor, Body, Constraint, DVec2, Id, Integrator, Kind, Method, Solver, Spin, World};

/// A chain of `links` rods from the origin along `direction`, `length` [m] and `mass` [kg] each.
fn chain(links: u32, direction: DVec2, length: f64, mass: f64) -> World {
    let mut world = World::new();
    let mut above: Option<Id> = None;
    for i in 1..=links {
        let node = Body { mass, ..point(direction * length * f64::from(i), DVec2::ZERO) };
        let id = world.add_body(&node).unwrap();
        let rod = Kind::Rod { length };
        let constraint = match above {
            Some(above) => Constraint::between(rod, above, id),
            None => Constraint::to_world(rod, id, DVec2::ZERO),
        };
        world.add_constraint(&constraint).unwrap();
        above = Some(id);
    }
    world
}

/// Worst stretch of a rod, as a part of its length.
fn stretch(world: &World) -> f64 {
    let of = |i: usize| {
        let (a, b) = world.ends(i);
        let Kind::Rod { length } = world.constraints().kind[i] else { return 0.0 };
        (a.distance(b) / length - 1.0).abs()
    };
    (0..world.constraints().len()).map(of).fold(0.0, f64::max)
}

#[test]
fn a_hanging_chains_tension_is_the_weight_below() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 8, 30)) {
        let mut world = chain(10, v(0.0, -1.0), 0.2, 1.0);
        world.set_drag(1.0).unwrap();
        run(&mut world, method, 15.0);
        for i in 0..10 {
            let weight = G * (10 - i) as f64;
            let tension = world.constraints().tension(i);
            // What 30 sweeps leave over of the whole weight, which hardly shows when warm started.
            figures.near(&format!("{}, link {i} [N]", label(&method)), tension, weight, 0.01 * 10.0 * G);
        }
        figures.at_most(&format!("{}, stretch", label(&method)), stretch(&world), 0.01);
    }
}

#[test]
fn a_chain_of_fifty_links_stays_whole_for_a_minute() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 8, 20)) {
        let mut world = chain(50, DVec2::X, 0.1, 0.1);
        let (mut worst, mut highest) = (0.0f64, f64::NEG_INFINITY);
        watch(&mut world, method, 60.0, |world, _| {
            worst = worst.max(stretch(world));
            let height: f64 = world.bodies().position.iter().map(|at| 0.1 * G * at.y).sum();
            highest = highest.max(kinetic_energy(world) + height);
        });
        // Twenty sweeps carry a pull through twenty of the fifty links: the crack of the whip stretches a link by a part of
        // its length, but it comes back.
        figures.at_most(&format!("{}, worst stretch of a link", label(&method)), worst, 0.5);
        // It still swings, at half its length a second: what 20 sweeps leave over is a few percent.
        figures.at_most(&format!("{}, stretch in the end", label(&method)), stretch(&world), 0.05);
        // Let go from height 0 it falls 2.5 m. Baumgarte's feedback does work on what the sweeps left stretched, in the
        // crack of the whip; more than a tenth of the fall would show.
        figures.at_most(&format!("{}, highest energy [J]", label(&method)), highest, 0.1 * 5.0 * G * 2.5);
    }
}

#[test]
fn a_pin_holds_two_discs_together_off_their_centres() {
    let mut figures = Figures::default();
    for method in every_method(rate(240.0, 4, 10)) {
        let mut world = weightless();
        let disc = |at: DVec2, velocity: DVec2, omega: f64| Body {
            spin: Some(Spin { angle: 0.0, omega }),
            radius: 0.5,
            ..ball(at, velocity)
        };
        // The pinned point of both moves with (0.5, 2.2) m/s.
        let a = world.add_body(&disc(v(-0.4, 0.0), v(0.5, 1.0), 3.0)).unwrap();
        let b = world.add_body(&Body { mass: 2.0, ..disc(v(0.4, 0.0), v(0.5, 2.2), 0.0) }).unwrap();
        let pin = Constraint { kind: Kind::Pin, a: Anchor::Body(a, v(0.4, 0.0)), b: Anchor::Body(b, v(-0.4, 0.0)) };
        world.add_constraint(&pin).unwrap();
        let turning = |world: &World| -> f64 {
            let bodies = world.bodies();
            (0..2)
                .map(|i| {
                    let inertia = 0.5 * bodies.mass[i] * 0.25;
                    bodies.mass[i] * bodies.position[i].perp_dot(bodies.velocity[i])
                        + inertia * bodies.spin(i).unwrap().omega
                })
                .sum()
        };
        let (pushed, turned) = (momentum(&world), turning(&world));
        let mut worst: f64 = 0.0;
        watch(&mut world, method, 10.0, |world, _| {
            let (at_a, at_b) = world.ends(0);
            worst = worst.max(at_a.distance(at_b));
        });
        let name = label(&method);
        // The arms turn by up to 3 h in a substep, which opens the pin by ½ (3h)² 0.4 m before it is fed back.
        figures.at_most(&format!("{name}, the pin opens by [m]"), worst, 1e-4);
        // Moves of a projection are rounded at 1e-16 m and divided by h = 1 ms, 10,000 times.
        let rounding = if method.solver == Solver::Projection { 1e-9 } else { 1e-11 };
        figures.at_most(&format!("{name}, momentum off"), (momentum(&world) - pushed).length(), rounding);
        // Equal and opposite forces at points 1e-5 m apart: what that makes of a torque, and the half of a drift between
        // the points of the force and of the velocities, is first order.
        figures.near(&format!("{name}, angular momentum"), turning(&world), turned, 0.01 * turned.abs());
    }
}

/// Two discs in a row, each pinned to the one before it (the first to the origin) by arms far outside of them; the last one starts across them.
fn pinned_outside(radius: f64, arm: f64, speed: f64, direction: DVec2) -> World {
    let mut world = weightless();
    let disc = |place: f64, velocity: DVec2| {
        let spin = Some(Spin { angle: direction.to_angle(), omega: 0.0 });
        Body { radius, spin, collides: false, ..ball(place * direction, velocity) }
    };
    let first = world.add_body(&disc(arm, DVec2::ZERO)).unwrap();
    let second = world.add_body(&disc(3.0 * arm, speed * direction.perp())).unwrap();
    let (back, ahead) = (v(-arm, 0.0), v(arm, 0.0));
    let pin = |a: Anchor, b: Anchor| Constraint { kind: Kind::Pin, a, b };
    world.add_constraint(&pin(Anchor::World(DVec2::ZERO), Anchor::Body(first, back))).unwrap();
    world.add_constraint(&pin(Anchor::Body(first, ahead), Anchor::Body(second, back))).unwrap();
    world
}

#[test]
fn light_discs_pinned_far_outside_themselves_keep_their_energy() {
    let mut figures = Figures::default();
    for (radius, arm, speed, turn) in
        [(0.005, 0.5, 3.0, 0.0), (0.005, 0.5, -3.0, 0.0), (0.01, 0.5, 2.0, 1.1), (0.02, 0.3, 1.0, 4.0)]
    {
        let direction = DVec2::from_angle(turn);
        for (method, gain, gap) in [
            // A hundredth of what a substep cannot follow.
            (Method::default(), 0.01, 0.02),
            (rate(60.0, 16, 10), 0.005, 1e-3),
            (Method { integrator: Integrator::VelocityVerlet, ..Method::default() }, 0.01, 0.02),
            (Method { automatic: true, accuracy: 1e-6, ..Method::default() }, 1e-4, 1e-9),
        ] {
            let mut world = pinned_outside(radius, arm, speed, direction);
            let start = kinetic_energy(&world);
            let (mut most, mut apart) = (0.0f64, 0.0f64);
            watch(&mut world, method, 10.0, |world, _| {
                most = most.max(kinetic_energy(world) / start);
                for pin in 0..2 {
                    let (a, b) = world.ends(pin);
                    apart = apart.max(a.distance(b));
                }
            });
            let name = format!(
                "radius {radius}, arm {arm}, {} × {}, automatic {}",
                label(&method),
                method.substeps,
                method.automatic
            );
            figures.at_most(&format!("{name}: energy gained"), most - 1.0, gain);
            figures.at_most(&format!("{name}: energy lost"), 1.0 - kinetic_energy(&world) / start, 0.05);
            figures.at_most(&format!("{name}: gap over arm"), apart / arm, gap);
        }
    }
}

#[test]
fn discs_pinned_fifty_radii_outside_themselves_stay_bounded_at_any_substeps() {
    let mut figures = Figures::default();
    for scale in [1.0, 10.0] {
        for mirror in [1.0, -1.0] {
            for substeps in [1, 2, 4, 8, 16, 64] {
                for method in every_method(rate(60.0, substeps, 10)) {
                    let mut world = weightless();
                    let m = |x: f64, y: f64| v(x, mirror * y);
                    let disc = |at: DVec2, radius: f64, velocity: DVec2| {
                        let spin = Some(Spin::default());
                        Body { radius: scale * radius, spin, collides: false, ..ball(scale * at, velocity) }
                    };
                    let one = world.add_body(&disc(m(-0.006, -0.009), 1e-4, DVec2::ZERO)).unwrap();
                    let other = world.add_body(&disc(m(-0.02, -0.009), 0.01, m(-0.7, 3.0))).unwrap();
                    let pin = |a: Anchor, b: Anchor| Constraint { kind: Kind::Pin, a, b };
                    let fixed = Anchor::World(scale * m(-0.003, -0.004));
                    world.add_constraint(&pin(fixed, Anchor::Body(one, scale * m(0.003, 0.004)))).unwrap();
                    let ahead = Anchor::Body(one, scale * m(-0.009, 4e-5));
                    world.add_constraint(&pin(ahead, Anchor::Body(other, scale * m(0.009, -4e-5)))).unwrap();
                    let (start, mut most) = (kinetic_energy(&world), 0.0f64);
                    watch(&mut world, method, 10.0, |world, _| most = most.max(kinetic_energy(world)));
                    let name = format!("× {scale}, {}, {substeps} substeps", label(&method));
                    // The first disc turns by up to a radian in a substep, so nothing is right; without the bound it is 1e14.
                    figures.at_most(&format!("{name}: energy over that of the start"), most / start, 40.0);
                }
            }
        }
    }
}
