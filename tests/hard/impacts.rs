//! Free bodies from impact to impact, and contacts that last, against closed forms. Everything here opens by accuracy.

use super::{by_id, energy, open, step};
use tautline::engine::{DVec2, Touching, World};
use tautline::measure::Measures;

const G: f64 = 10.0;

/// Steps until `seconds`, with a look after every step. Nothing may go through the substeps.
fn watch(name: &str, seconds: f64, mut look: impl FnMut(&World)) -> World {
    let (mut world, mut stepper) = open(name);
    while world.time() < seconds - 1e-9 {
        let report = step(&mut world, &mut stepper);
        assert!(report.near == 0 && report.substeps == 0, "{name} at {}: {report:?}", world.time());
        look(&world);
    }
    world
}

/// Height and velocity of a ball dropped from `height` [m] with restitution `e`, from bounce to bounce.
fn bouncing(height: f64, e: f64, time: f64) -> (f64, f64) {
    let (mut speed, mut left) = ((2.0 * G * height).sqrt(), time - (2.0 * height / G).sqrt());
    if left < 0.0 {
        return (height - 0.5 * G * time * time, -G * time);
    }
    loop {
        speed *= e;
        let flight = 2.0 * speed / G;
        if left <= flight {
            return (speed * left - 0.5 * G * left * left, speed - G * left);
        }
        left -= flight;
        if flight < 1e-12 {
            return (0.0, 0.0);
        }
    }
}

#[test]
fn balls_bounce_to_the_heights_of_their_geometric_series() {
    let (mut worst, mut rising, mut apexes) = (0.0f64, false, Vec::new());
    watch("hard/bouncing_ball", 3.0, |world| {
        for (i, e) in [(0, 0.8), (1, 1.0)] {
            let exact = bouncing(1.0, e, world.time());
            let found = (by_id(world, i).y - 0.1, world.bodies().velocity[i].y);
            worst = worst.max((found.0 - exact.0).abs()).max((found.1 - exact.1).abs() / G);
        }
        // The height that the tired ball will reach or has reached.
        let v = world.bodies().velocity[0].y;
        if rising && v <= 0.0 {
            apexes.push(by_id(world, 0).y - 0.1 + v * v / (2.0 * G));
        }
        rising = v > 0.0;
    });
    let off = apexes.iter().enumerate().map(|(k, apex)| (apex - 0.64f64.powi(k as i32 + 1)).abs()).fold(0.0, f64::max);
    println!(
        "bouncing ball: {worst:.1e} m off its path in 3 s, rebound heights {off:.1e} m off, {} of them",
        apexes.len()
    );
    assert!(worst < 1e-9 && off < 1e-9 && apexes.len() >= 4);
}

#[test]
fn a_run_of_bounces_ends_in_rest_at_the_sum_of_its_series() {
    // After √(2 h/g) (1 + e)/(1 − e) it lies still.
    let end = (0.2f64).sqrt() * 9.0;
    let world = watch("hard/bouncing_ball", end + 1.0, |world| {
        let exact = bouncing(1.0, 0.8, world.time());
        let found = by_id(world, 0).y - 0.1;
        assert!((found - exact.0).abs() < 1e-9, "{found} for {} at {}", exact.0, world.time());
    });
    let contact = world.contacts().iter().find(|contact| contact.a == 0).unwrap();
    println!(
        "at rest: {:e} m, {:e} m/s, {} N",
        by_id(&world, 0).y - 0.1,
        world.bodies().velocity[0].y,
        contact.normal_force
    );
    assert!(world.bodies().velocity[0] == DVec2::ZERO && (by_id(&world, 0).y - 0.1).abs() < 1e-11);
    assert!((contact.normal_force - G).abs() < 1e-12);
}

#[test]
fn an_elastic_ball_keeps_its_energy_over_a_thousand_bounces() {
    let (mut world, mut stepper) = open("hard/bouncing_ball");
    let of_ball = |world: &World| 0.5 * world.bodies().velocity[1].length_squared() + G * (by_id(world, 1).y - 0.1);
    let (start, mut drift, mut bounces, mut falls) = (of_ball(&world), 0.0f64, 0, true);
    while bounces < 1000 {
        step(&mut world, &mut stepper);
        let now = world.bodies().velocity[1].y < 0.0;
        bounces += usize::from(falls && !now);
        falls = now;
        drift = drift.max((of_ball(&world) - start).abs() / start);
    }
    let exact = bouncing(1.0, 1.0, world.time()).0;
    let off = (by_id(&world, 1).y - 0.1 - exact).abs();
    println!("e = 1: energy within {drift:.1e} over 1000 bounces, {off:.1e} m off after {:.0} s", world.time());
    assert!(drift < 1e-9 && off < 1e-9);
}

#[test]
fn forty_balls_rebound_to_the_square_of_their_restitution() {
    let mut apex = [0.0f64; 40];
    let mut bounced = [false; 40];
    let mut worst = 0.0f64;
    watch("hard/restitution_row", 3.0, |world| {
        for i in 0..40 {
            let (y, v) = (by_id(world, i).y - 0.05, world.bodies().velocity[i].y);
            let e = f64::from(i as u32) / 39.0;
            worst = worst.max((y - bouncing(1.0, e, world.time()).0).abs());
            if v > 0.0 && !bounced[i] {
                bounced[i] = true;
                apex[i] = y + v * v / (2.0 * G);
            }
        }
    });
    // Bounces of e < 0.3 or so are over within a step or two, in which a maximum cannot be read off velocities at its ends.
    let off = (12..40).map(|i| (apex[i] - (i as f64 / 39.0).powi(2)).abs()).fold(0.0, f64::max);
    println!("restitution row: {worst:.1e} m off all paths in 3 s, rebounds {off:.1e} m off e² h");
    assert!(worst < 1e-9 && off < 1e-9);
}

/// Where a point that is reflected between −`half` and `half` is, from its straight way.
fn folded(way: f64, half: f64) -> f64 {
    let turn = (way + half).rem_euclid(4.0 * half);
    if turn < 2.0 * half { turn - half } else { 3.0 * half - turn }
}

#[test]
fn a_disc_in_a_box_keeps_its_speed_and_its_path() {
    let (mut speed, mut place) = (0.0f64, 0.0f64);
    watch("hard/bounce_box", 60.0, |world| {
        let t = world.time();
        speed = speed.max((world.bodies().velocity[0].length() / 500f64.sqrt() - 1.0).abs());
        place = place.max((by_id(world, 0) - DVec2::new(folded(10.0 * t, 9.5), folded(20.0 * t, 9.5))).length());
    });
    println!("bounce box: speed within {speed:.1e}, path within {place:.1e} m in 60 s");
    assert!(speed < 1e-9 && place < 1e-9);
}

#[test]
fn pairs_exchange_momentum_and_energy_as_newton_says() {
    let (world, _) = open("hard/two_body_exchange");
    let before = Measures::of(&world);
    let mut start: Vec<_> = world.bodies().velocity.clone();
    let world = watch("hard/two_body_exchange", 0.5, |_| {});
    let after = Measures::of(&world);
    let momentum = (after.momentum - before.momentum).length() / before.momentum.length();
    let kinetic = (after.kinetic / before.kinetic - 1.0).abs();
    let mut worst = 0.0f64;
    for pair in 0..6 {
        let (i, j) = (2 * pair, 2 * pair + 1);
        let [m, n] = [world.bodies().mass[i], world.bodies().mass[j]];
        // Head on, or with the line of centres that 0.1 m across and radii of 0.1 m make.
        let across = if pair < 3 { 0.0 } else { 0.1 };
        let normal = DVec2::new(-(0.04f64 - across * across).sqrt(), across) / 0.2;
        let impulse = -2.0 * (start[i] - start[j]).dot(normal) * m * n / (m + n);
        start[i] += impulse / m * normal;
        start[j] -= impulse / n * normal;
        for k in [i, j] {
            worst = worst.max((world.bodies().velocity[k] - start[k]).length());
        }
        let total = |v: [DVec2; 2]| m * v[0] + n * v[1];
        let old = total([DVec2::new(2.0, 0.0), DVec2::new(-1.0, 0.0)]);
        let new = total([world.bodies().velocity[i], world.bodies().velocity[j]]);
        assert!((new - old).length() <= 1e-12 * old.length().max(m + n), "pair {pair}: {new} for {old}");
    }
    println!("exchange: momentum {momentum:.1e}, energy {kinetic:.1e}, velocities {worst:.1e} m/s off");
    assert!(momentum < 1e-12 && kinetic < 1e-12 && worst < 1e-12);
}

#[test]
fn of_a_row_of_five_only_the_last_ball_leaves() {
    let world = watch("hard/cradle", 1.0, |_| {});
    // Arriving ball from −1 to −0.2 at 5 m/s, then the last one from 0.6.
    let mut worst = 0.0f64;
    for (i, x) in [-0.2, 0.0, 0.2, 0.4, 0.6 + 5.0 * (1.0 - 0.16)].into_iter().enumerate() {
        let speed = if i == 4 { 5.0 } else { 0.0 };
        worst = worst.max((by_id(&world, i) - DVec2::new(x, 0.1)).length());
        worst = worst.max((world.bodies().velocity[i] - DVec2::new(speed, 0.0)).length());
    }
    println!("cradle: {worst:.1e} off");
    assert!(worst < 1e-9);
}

/// Unit vector down a ramp.
fn down(angle: f64) -> DVec2 {
    DVec2::new(angle.cos(), -angle.sin())
}

#[test]
fn blocks_slide_and_stick_on_a_ramp() {
    let angle = 30f64.to_radians();
    let start = open("hard/slide").0;
    let mut worst = 0.0f64;
    let mut crept = 0.0f64;
    watch("hard/slide", 10.0, |world| {
        let t = world.time();
        if t <= 2.0 + 1e-9 {
            let way = 0.5 * G * (angle.sin() - 0.3 * angle.cos()) * t * t;
            worst = worst.max((by_id(world, 0) - by_id(&start, 0) - way * down(angle)).length());
        }
        crept = crept.max((by_id(world, 1) - by_id(&start, 1)).length());
    });
    println!("slide: {worst:.1e} m off in 2 s; stuck: {crept:.1e} m in 10 s");
    assert!(worst < 1e-6 && crept < 1e-9);
}

#[test]
fn a_disc_rolls_down_a_ramp_at_two_thirds_of_the_pull() {
    let angle = 20f64.to_radians();
    let start = open("hard/roll").0;
    let mut worst = 0.0f64;
    let world = watch("hard/roll", 3.0, |world| {
        let way = 0.5 * (2.0 / 3.0) * G * angle.sin() * world.time() * world.time();
        worst = worst.max((by_id(world, 0) - by_id(&start, 0) - way * down(angle)).length());
        let turned = world.bodies().spin(0).unwrap().angle;
        worst = worst.max((turned * 0.25 + way).abs());
    });
    let contact = world.contacts()[0];
    let mass = world.bodies().mass[0];
    println!("roll: {worst:.1e} m off in 3 s, normal force {:e} N", contact.normal_force);
    assert!(worst < 1e-6);
    assert!((contact.normal_force / (mass * G * angle.cos()) - 1.0).abs() < 1e-9);
    assert!((contact.tangent_force.abs() / (mass * G * angle.sin() / 3.0) - 1.0).abs() < 1e-9);
}

#[test]
fn of_five_blocks_on_ramps_three_stick_and_two_slide() {
    let angle = 0.25f64;
    let start = open("hard/ramp_row").0;
    let mut worst = [0.0f64; 5];
    watch("hard/ramp_row", 2.0, |world| {
        for (i, own) in [0.75f64, 0.5, 0.35, 0.1, 0.0].into_iter().enumerate() {
            let pull = G * (angle.sin() - (0.2 * own).sqrt() * angle.cos()).max(0.0);
            let way = 0.5 * pull * world.time() * world.time();
            worst[i] = worst[i].max((by_id(world, i) - by_id(&start, i) - way * down(angle)).length());
        }
    });
    println!("ramp row: {:.1e} m off at most in 2 s", worst.into_iter().fold(0.0, f64::max));
    assert!(worst.iter().all(|worst| *worst < 1e-9), "{worst:?}");
}

#[test]
fn every_contact_of_a_stack_carries_the_weight_above_it() {
    let world = watch("hard/weighing", 1.0, |_| {});
    let mut worst = 0.0f64;
    let mut seen = 0;
    for contact in world.contacts() {
        let upper = match contact.b {
            Touching::Body(b) => contact.a.max(b),
            Touching::Wall(_) => contact.a,
        };
        let last = if upper < 10 { 9 } else { 19 };
        let above: f64 = (upper..=last).map(|i| world.bodies().mass[i as usize] * G).sum();
        worst = worst.max((contact.normal_force / above - 1.0).abs());
        seen += 1;
    }
    println!("weighing: {seen} contacts, forces {worst:.1e} off");
    assert!(seen == 20 && worst < 1e-3, "{seen}, {worst:e}");
    let start = open("hard/weighing").0;
    assert!((0..20).all(|i| (by_id(&world, i) - by_id(&start, i)).length() < 1e-12));
}

#[test]
fn discs_exactly_above_each_other_stand_until_something_touches_them() {
    let start = open("hard/circle_stack").0;
    let world = watch("hard/circle_stack", 60.0, |_| {});
    let moved = (0..10).map(|i| (by_id(&world, i) - by_id(&start, i)).length()).fold(0.0, f64::max);
    println!("circle stack: {moved:.1e} m in 60 s");
    assert!(moved < 1e-12);
    // A push sideways on the seventh.
    let (mut world, mut stepper) = open("hard/circle_stack");
    let id = world.bodies().id[6];
    let mut body = world.body(id).unwrap();
    body.velocity = DVec2::new(0.1, 0.0);
    world.set_body(id, &body).unwrap();
    let before = energy(&world);
    for _ in 0..600 {
        let report = stepper.step(&mut world);
        assert!(report.divergence.is_none());
    }
    let fallen = by_id(&world, 9).y;
    println!("pushed: the top at {fallen:.2} m, energy {:.3e} of {before:.3e} J", energy(&world));
    assert!(fallen < 10.0 && energy(&world) < before);
}

#[test]
fn nothing_passes_a_thin_wall_or_leaves_a_wedge() {
    let (mut worst, mut hits) = (0.0f64, 0);
    for hz in [60.0, 30.0, 1000.0] {
        let (mut world, stepper) = open("hard/bullet");
        let mut stepper = tautline::engine::Stepper::new(tautline::engine::Method { hz, ..*stepper.method() }).unwrap();
        while world.time() < 1.0 {
            hits += step(&mut world, &mut stepper).impacts;
            let x = by_id(&world, 0).x;
            worst = worst.max(x + 0.05).max(-4.45 - x);
            assert!((-4.45 - 1e-9..=-0.05 + 1e-9).contains(&x), "{x}");
        }
    }
    let slope = DVec2::new(-26.6f64.to_radians().sin(), 26.6f64.to_radians().cos());
    let mut inside = f64::INFINITY;
    let world = watch("hard/wedge", 5.0, |world| {
        let at = by_id(world, 0);
        inside = inside.min(at.y - 0.3).min(-slope.dot(at) - 0.3);
    });
    println!("bullet: {hits} hits; wedge: surfaces {inside:.1e} m apart at least, at the end {}", by_id(&world, 0));
    assert!(hits >= 15 && inside > -1e-9);
}
