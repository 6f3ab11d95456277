//! Hits, reflections and bounces.

use super::figures::Figures;
use super::lab::*;
use std::f64::consts::PI;
use tautline::engine::{Body, Constraint, DVec2, Integrator, Kind, Method, Wall, World};
use tautline::scene;

/// Two balls about to meet: `mass` at speed `fast` from the left, offset across by `across`, and 1 kg at rest.
fn hit(mass: f64, restitution: f64, across: f64, fast: f64) -> World {
    let mut world = weightless();
    world.add_body(&Body { mass, restitution, ..ball(v(-0.5, across), v(fast, 0.0)) }).unwrap();
    world.add_body(&Body { restitution, ..ball(v(0.0, 0.0), v(-0.25 * fast, 0.0)) }).unwrap();
    world
}

#[test]
fn head_on_hits_share_momentum_and_energy_as_newton_says() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 4, 10)) {
        for mass in [1.0, 10.0, 1000.0] {
            for e in [0.0, 0.5, 1.0] {
                let mut world = hit(mass, e, 0.0, 2.0);
                let (before, energy) = (momentum(&world), kinetic_energy(&world));
                run(&mut world, method, 1.0);
                let name = format!("{}, mass {mass}, e {e}", label(&method));
                let common = before.x / (mass + 1.0);
                let closing = 2.5;
                // One row, solved exactly; rounding alone.
                let (light, heavy) = (common + e * closing * mass / (mass + 1.0), common - e * closing / (mass + 1.0));
                figures.near(&format!("{name}, heavy [m/s]"), velocity(&world, 0).x, heavy, 1e-12);
                figures.near(&format!("{name}, light [m/s]"), velocity(&world, 1).x, light, 1e-12);
                figures.at_most(
                    &format!("{name}, momentum"),
                    (momentum(&world) - before).length() / before.length(),
                    1e-12,
                );
                if e == 1.0 {
                    figures.near(&format!("{name}, energy"), kinetic_energy(&world) / energy, 1.0, 1e-12);
                }
            }
        }
    }
}

#[test]
fn oblique_hits_keep_momentum_and_energy_and_turn_along_the_line_of_centres() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 4, 10)) {
        for (mass, across) in [(1.0, 0.1), (10.0, -0.15), (1000.0, 0.05)] {
            for e in [0.0, 0.5, 1.0] {
                // Fast, so that the path is followed to where the surfaces meet: 12 m/s make 5 cm a substep.
                let mut world = hit(mass, e, across, 12.0);
                let (before, energy) = (momentum(&world), kinetic_energy(&world));
                let normal = v((0.04f64 - across * across).sqrt(), -across) / 0.2;
                let closing = 15.0 * normal.x;
                let impulse = (1.0 + e) * closing * mass / (mass + 1.0);
                run(&mut world, method, 1.0);
                let name = format!("{}, mass {mass}, across {across}, e {e}", label(&method));
                let total = (momentum(&world) - before).length() / before.length();
                figures.at_most(&format!("{name}, momentum"), total, 1e-12);
                if e == 1.0 {
                    figures.near(&format!("{name}, energy"), kinetic_energy(&world) / energy, 1.0, 1e-12);
                }
                if e > 0.0 {
                    // The hit's normal comes from a quadratic's root: 1e-12 with its cancellation.
                    let truth = v(-3.0, 0.0) + impulse * normal;
                    figures.at_most(&format!("{name}, light [m/s]"), velocity(&world, 1).distance(truth), 1e-10);
                }
            }
        }
    }
}

#[test]
fn a_slow_oblique_hit_turns_as_the_line_of_centres_to_first_order() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 4, 10)) {
        let mut world = hit(1.0, 1.0, 0.1, 1.0);
        run(&mut world, method, 2.0);
        let normal = v(0.03f64.sqrt(), -0.1) / 0.2;
        let truth = v(-0.25, 0.0) + 1.25 * normal.x * normal;
        // The normal is that of the substep's start, off by the path of a substep over the sum of the radii.
        let off = 1.25 * method.substep_seconds() / 0.2;
        figures.at_most(&label(&method), velocity(&world, 1).distance(truth), 1.25 * 2.0 * off);
    }
}

#[test]
fn reflection_keeps_the_speed_and_mirrors_the_path_at_every_angle() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 4, 10)) {
        let (mut speeds, mut directions, mut places) = (0.0f64, 0.0f64, 0.0f64);
        for i in 0..24 {
            let (wall_turn, incidence) = (f64::from(i) * PI / 12.0, -1.3 + 0.11 * f64::from(i));
            let normal = DVec2::from_angle(wall_turn);
            let along = 50.0 * normal.perp();
            let mut world = weightless();
            world.add_wall(&Wall { restitution: 1.0, ..smooth(-along, along) }).unwrap();
            let direction = DVec2::from_angle(wall_turn + PI + incidence);
            // Meets the wall, at the origin of its surface, after 1 s.
            world.add_body(&ball(0.1 * normal - 2.0 * direction, 2.0 * direction)).unwrap();
            run(&mut world, method, 2.0);
            let mirrored = 2.0 * (direction - 2.0 * direction.dot(normal) * normal);
            speeds = speeds.max((velocity(&world, 0).length() - 2.0).abs());
            directions = directions.max(velocity(&world, 0).distance(mirrored));
            places = places.max(position(&world, 0).distance(0.1 * normal + mirrored));
        }
        // The wall's normal is rounded at 1e-16 of a wall 100 m long.
        figures.at_most(&format!("{}, speed", label(&method)), speeds, 1e-12);
        figures.at_most(&format!("{}, velocity", label(&method)), directions, 1e-12);
        // The impact is taken at its own time within the substep, so the path is not early or late.
        figures.at_most(&format!("{}, place 1 s later [m]", label(&method)), places, 1e-9);
    }
}

#[test]
fn a_bouncing_ball_loses_the_same_part_of_its_height_every_time() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 8, 10)) {
        for e in [0.8, 1.0] {
            let mut world = World::new();
            world.add_wall(&Wall { restitution: e, ..smooth(v(-1.0, 0.0), v(1.0, 0.0)) }).unwrap();
            world.add_body(&ball(v(0.0, 1.1), DVec2::ZERO)).unwrap();
            let mut apexes = Vec::new();
            let mut rising = false;
            let mut apex: f64 = 0.0;
            watch(&mut world, method, 4.0, |world, _| {
                let up = velocity(world, 0).y > 0.0;
                apex = if up && !rising { 0.0 } else { apex };
                apex = apex.max(position(world, 0).y - 0.1);
                if rising && !up {
                    apexes.push(apex);
                }
                rising = up;
            });
            assert!(apexes.len() >= 4, "{}: {apexes:?}", label(&method));
            for (bounce, apex) in apexes.iter().take(4).enumerate() {
                let truth = e.powi(2 * (bounce as i32 + 1));
                // Speed at the impact is that of the substep's start or end: off by up to g h, which in the height of a
                // bounce from 1 m is 2 g h/√(2g) of it, and more of the lower ones in the ratio of the speeds. An Euler
                // step's own rise and fall are off by as much.
                let slower = e.powi(-(bounce as i32));
                let tolerance =
                    truth * slower * (bounce + 1) as f64 * 2.0 * (2.0 * G).sqrt() * method.substep_seconds();
                figures.near(&format!("{}, e {e}, bounce {bounce}", label(&method)), *apex, truth, tolerance);
            }
        }
    }
}

#[test]
fn a_closed_box_of_elastic_discs_keeps_its_energy_for_a_minute() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 1, 10)) {
        let mut world = weightless();
        let corners = [v(-1.0, -1.0), v(1.0, -1.0), v(1.0, 1.0), v(-1.0, 1.0)];
        for i in 0..4 {
            world.add_wall(&Wall { restitution: 1.0, ..smooth(corners[i], corners[(i + 1) % 4]) }).unwrap();
        }
        for i in 0..36 {
            let (column, row) = (f64::from(i % 6), f64::from(i / 6));
            let velocity = 2.0 * DVec2::from_angle(f64::from(i) * 2.4);
            let mass = 1.0 + f64::from(i % 3);
            let at = v(-0.8 + 0.32 * column, -0.8 + 0.32 * row);
            world.add_body(&Body { mass, radius: 0.05, restitution: 1.0, ..ball(at, velocity) }).unwrap();
        }
        let energy = kinetic_energy(&world);
        let (mut hits, mut outside) = (0, 0.0f64);
        watch(&mut world, method, 60.0, |world, report| {
            hits += report.impacts;
            outside = world.bodies().position.iter().map(|at| at.abs().max_element()).fold(outside, f64::max);
        });
        assert!(hits > 5_000, "only {hits} impacts");
        let name = format!("{}, {hits} impacts", label(&method));
        // Every impact rounds at 1e-16.
        figures.near(&format!("{name}, energy"), kinetic_energy(&world) / energy, 1.0, 1e-12);
        figures.at_most(&format!("{name}, farthest centre [m]"), outside, 1.0);
    }
}

#[test]
fn discs_that_collide_in_empty_space_keep_momentum_and_energy() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 1, 10)) {
        let mut world = weightless();
        for i in 0..36 {
            let at = (0.5 + 0.03 * f64::from(i)) * DVec2::from_angle(f64::from(i) * 2.4);
            let mass = 1.0 + f64::from(i % 3);
            // All towards one point, and all of it carried to the right.
            let body = Body { mass, radius: 0.05, restitution: 1.0, ..ball(at, v(3.0, 0.0) - 2.0 * at.normalize()) };
            world.add_body(&body).unwrap();
        }
        let (before, energy) = (momentum(&world), kinetic_energy(&world));
        let mut hits = 0;
        watch(&mut world, method, 4.0, |_, report| hits += report.impacts);
        assert!(hits > 50, "only {hits} impacts");
        let name = format!("{}, {hits} impacts", label(&method));
        // Every impact rounds at 1e-16.
        figures.at_most(&format!("{name}, momentum"), momentum(&world).distance(before) / before.length(), 1e-12);
        figures.near(&format!("{name}, energy"), kinetic_energy(&world) / energy, 1.0, 1e-12);
    }
}

#[test]
fn a_row_of_balls_passes_a_hit_to_its_last_ball_alone() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 4, 10)) {
        for reversed in [false, true] {
            let mut world = weightless();
            let mut places: Vec<f64> = (0..5).map(|i| 0.2 * f64::from(i)).collect();
            if reversed {
                places.reverse();
            }
            let arriving = if reversed { 4 } else { 0 };
            for (i, x) in places.iter().enumerate() {
                let (back, speed) = if i == arriving { (0.5, 1.0) } else { (0.0, 0.0) };
                world.add_body(&Body { restitution: 1.0, ..ball(v(x - back, 0.0), v(speed, 0.0)) }).unwrap();
            }
            run(&mut world, method, 1.0);
            for i in 0..5 {
                let expected = if i == 4 - arriving { 1.0 } else { 0.0 };
                let name = format!("{}, reversed {reversed}, ball {i} [m/s]", label(&method));
                figures.near(&name, velocity(&world, i).x, expected, 1e-12);
            }
        }
    }
}

#[test]
fn newtons_cradle_swings_out_only_its_last_ball() {
    let mut figures = Figures::default();
    let (length, radius, lift) = (1.0, 0.1, 0.5f64);
    for method in every_method(rate(60.0, 16, 20)) {
        let mut world = World::new();
        for i in 0..5 {
            let hook = v(2.0 * radius * f64::from(i), 0.0);
            let turn = if i == 0 { lift } else { 0.0 };
            let at = hook + length * v(-turn.sin(), -turn.cos());
            let id = world.add_body(&Body { restitution: 1.0, ..ball(at, DVec2::ZERO) }).unwrap();
            world.add_constraint(&Constraint::to_world(Kind::Rod { length }, id, hook)).unwrap();
        }
        // A quarter of a swing takes 0.51 s: by 0.75 s the last ball is on its way up.
        run(&mut world, method, 0.75);
        let moved = |i: usize| position(&world, i).x - 2.0 * radius * i as f64;
        let out: f64 = (0..4).map(|i| moved(i).abs()).fold(0.0, f64::max);
        let last = moved(4);
        // One percent of the arc: the rods' error at these steps is of first order.
        figures.at_most(&format!("{}, others [m]", label(&method)), out, 0.01);
        assert!(last > 0.3, "{}: the last ball is {last} m out", label(&method));
        let mut highest: f64 = 0.0;
        watch(&mut world, method, 0.6, |world, _| highest = highest.max(position(world, 4).y + length));
        let truth = length * (1.0 - lift.cos());
        // First-order methods at h = 1 ms change the height of a swing by a few percent; more would be seen.
        figures.near(&format!("{}, height of the last [m]", label(&method)), highest, truth, 0.04 * truth);
    }
}

#[test]
fn the_shipped_cradle_passes_the_swing_to_the_other_side() {
    let setup = scene::open("newtons_cradle").unwrap();
    let mut world = setup.world;
    let balls = world.bodies().len();
    let start = world.bodies().position.clone();
    let first = (0..balls).max_by(|a, b| start[*a].y.total_cmp(&start[*b].y)).unwrap();
    assert!(first == 0 || first == balls - 1, "an outer ball is pulled out");
    let last = balls - 1 - first;
    run(&mut world, setup.method, 0.8);
    let moved = |i: usize| (position(&world, i) - start[i]).length();
    let middle: f64 = (1..balls - 1).map(moved).fold(0.0, f64::max);
    println!("the last ball moved {:.3} m, those between at most {middle:.4} m", moved(last));
    assert!(moved(last) > 10.0 * middle, "only the last ball may leave");
}

#[test]
fn a_ball_with_e_1_keeps_its_energy_under_any_gravity() {
    let mut figures = Figures::default();
    for gravity in [9.81, 100.0, 1000.0, 1e4] {
        for substeps in [1, 4, 16] {
            let base = rate(60.0, substeps, 10);
            let h = base.substep_seconds();
            for integrator in Integrator::SUBSTEPPED {
                let method = Method { integrator, ..base };
                let (mut low, mut high) = (f64::INFINITY, 0.0f64);
                for k in 0..10 {
                    let height = 1.0 + 0.037 * f64::from(k);
                    // Where a bounce lasts only a few substeps it ends in rest.
                    if (2.0 * height / gravity).sqrt() < 4.0 * h {
                        continue;
                    }
                    for turn in [0.0, 0.7, 2.5] {
                        let up = DVec2::from_angle(turn).perp();
                        let mut world = weightless();
                        world.set_gravity(-gravity * up).unwrap();
                        world
                            .add_wall(&Wall { restitution: 1.0, ..smooth(9.0 * up.perp(), -9.0 * up.perp()) })
                            .unwrap();
                        let body = Body { restitution: 1.0, ..ball((0.1 + height) * up, DVec2::ZERO) };
                        world.add_body(&body).unwrap();
                        watch(&mut world, method, 10.0, |world, _| {
                            let (y, speed) = (up.dot(position(world, 0)) - 0.1, up.dot(velocity(world, 0)));
                            // Velocities of the methods of the first order belong to half a substep before the positions, or after them.
                            let later = match integrator {
                                Integrator::SemiImplicitEuler => -0.5 * h,
                                Integrator::ExplicitEuler => 0.5 * h,
                                _ => 0.0,
                            };
                            let energy = 0.5 * speed * speed + gravity * (y + later * speed);
                            let energy = energy / (gravity * height);
                            (low, high) = (low.min(energy), high.max(energy));
                        });
                    }
                }
                if high > 0.0 {
                    let name = format!("{gravity} m/s², {substeps} substeps, {}", label(&method));
                    // Bounces that last only some twenty substeps are not shifted whole where a part of the drift comes first.
                    let long = (2.0 / gravity).sqrt() > 16.0 * h
                        || !matches!(integrator, Integrator::ExplicitEuler | Integrator::PositionVerlet);
                    figures.at_most(&format!("{name}: energy gained"), high - 1.0, if long { 1e-12 } else { 0.01 });
                    if long {
                        figures.at_most(&format!("{name}: energy lost"), 1.0 - low, 1e-12);
                    }
                }
            }
        }
    }
}
