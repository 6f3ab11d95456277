//! Few free bodies by accuracy: closed forms of what the hard cases leave out, and random boxes of discs.

use super::lab::*;
use std::f64::consts::TAU;
use tautline::engine::{Body, DVec2, Method, Motion, Shape, Spin, Stepper, Tuning, Wall, World};
use tautline::measure::Measures;
use tautline::truth::closed_form::{Pendulum, fall_with_drag};

fn by_accuracy() -> Method {
    Method { automatic: true, ..Method::default() }
}

/// Steps for `seconds`, from event to event all the time.
fn exactly(world: &mut World, seconds: f64, mut see: impl FnMut(&World)) -> usize {
    let mut impacts = 0;
    watch(world, by_accuracy(), seconds, |world, report| {
        assert!(report.substeps == 0 && report.given_up == 0, "{report:?}");
        impacts += report.impacts;
        see(world);
    });
    impacts
}

fn floor(world: &mut World, restitution: f64, friction: f64) {
    world.add_wall(&Wall { restitution, friction, ..Wall::block(v(-50.0, -1.0), v(50.0, 0.0)) }).unwrap();
}

#[test]
fn a_ball_with_drag_bounces_where_its_exponential_meets_the_floor() {
    // Less makes the formula cancel.
    for drag in [0.05, 0.5, 3.0] {
        let mut world = World::new();
        world.set_drag(drag).unwrap();
        floor(&mut world, 0.7, 0.5);
        world.add_body(&ball(v(0.0, 1.1), v(1.0, 0.0))).unwrap();
        let gravity = v(0.0, -G);
        let fall = |t| fall_with_drag(v(0.0, 1.0), v(1.0, 0.0), gravity, drag, t);
        let (mut low, mut high) = (0.0, 2.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            *(if fall(middle).0.y > 0.0 { &mut low } else { &mut high }) = middle;
        }
        let (at, speed) = fall(low);
        let mut worst = 0.0f64;
        exactly(&mut world, 0.9, |world| {
            let t = world.time();
            let exact =
                if t < low { fall(t) } else { fall_with_drag(at, v(speed.x, -0.7 * speed.y), gravity, drag, t - low) };
            worst = worst
                .max((position(world, 0) - exact.0 - v(0.0, 0.1)).length())
                .max((velocity(world, 0) - exact.1).length());
        });
        println!("drag {drag}: {worst:.1e} off over a bounce");
        assert!(worst < 1e-12);
    }
}

/// A disc of 1 kg that turns, on the floor at x = 0.
fn disc(friction: f64, velocity: DVec2, omega: f64) -> Body {
    Body { radius: 0.2, spin: Some(Spin { angle: 0.0, omega }), friction, ..ball(v(0.0, 0.2), velocity) }
}

#[test]
fn a_sliding_disc_begins_to_roll_at_two_thirds_of_its_speed() {
    let (mu, speed) = (0.25, 3.0);
    let mut world = World::new();
    floor(&mut world, 0.0, mu);
    world.add_body(&disc(mu, v(speed, 0.0), 0.0)).unwrap();
    let rolls = speed / (3.0 * mu * G);
    let mut worst = 0.0f64;
    exactly(&mut world, 2.0, |world| {
        let t = world.time();
        let slid = t.min(rolls);
        let (fast, way) = (speed - mu * G * slid, speed * slid - 0.5 * mu * G * slid * slid);
        worst = worst.max((position(world, 0).x - way - fast * (t - slid)).abs());
        worst = worst.max((velocity(world, 0).x - fast).abs());
        let spin = world.bodies().spin(0).unwrap();
        worst = worst.max((spin.omega + 2.0 * mu * G * slid / 0.2).abs());
    });
    println!("slide to roll: {worst:.1e} off");
    assert!(worst < 1e-12);
}

#[test]
fn a_spinning_disc_bounces_off_to_the_side_as_coulomb_says() {
    for (mu, omega) in [(0.1, 30.0), (2.0, 30.0)] {
        let mut world = World::new();
        floor(&mut world, 0.5, mu);
        world.add_body(&Body { position: v(0.0, 1.2), ..disc(mu, DVec2::ZERO, omega) }).unwrap();
        // Down at √(2 g), back at half of it; the surface slides at −ω r and is stopped if μ allows it (effective mass 1/3).
        let down = (2.0 * G).sqrt();
        let rub = (omega * 0.2 / 3.0).min(mu * 1.5 * down);
        exactly(&mut world, 0.5, |_| {});
        let (found, spin) = (velocity(&world, 0), world.bodies().spin(0).unwrap());
        // The tangent of an upward normal points to the left.
        let exact = (-rub, omega - 2.0 * rub / 0.2);
        println!("mu {mu}: {:.1e} m/s, {:.1e} rad/s off", found.x - exact.0, spin.omega - exact.1);
        assert!((found.x - exact.0).abs() < 1e-12 && (spin.omega - exact.1).abs() < 1e-11);
    }
}

#[test]
fn a_block_slides_over_the_seams_of_its_floor_and_off_its_end() {
    let (mu, speed) = (0.2, 4.0);
    let pieces: [fn(f64) -> Wall; 2] =
        [|x| Wall::segment(v(x, 0.0), v(x + 0.7, 0.0)), |x| Wall::block(v(x, -0.3), v(x + 0.7, 0.0))];
    for piece in pieces {
        let mut world = World::new();
        for i in 0..4 {
            world.add_wall(&Wall { friction: mu, ..piece(-0.5 + 0.7 * f64::from(i)) }).unwrap();
        }
        world.add_body(&Body { friction: mu, ..ball(v(0.0, 0.1), v(speed, 0.0)) }).unwrap();
        // It leaves at x = 2.3, fast enough not to tip over the edge: v² > g r.
        let leaves = (speed - (speed * speed - 2.0 * mu * G * 2.3).sqrt()) / (mu * G);
        let mut worst = 0.0f64;
        exactly(&mut world, 1.0, |world| {
            let slid = world.time().min(leaves);
            let flown = world.time() - slid;
            let x = speed * slid - 0.5 * mu * G * slid * slid + (speed - mu * G * slid) * flown;
            worst = worst.max((position(world, 0) - v(x, 0.1 - 0.5 * G * flown * flown)).length());
        });
        println!("seams: {worst:.1e} m off over three seams and an edge");
        assert!(worst < 1e-9);
    }
}

#[test]
fn a_ball_slides_down_a_disc_as_a_pendulum_and_leaves_it_at_two_thirds_of_the_height() {
    let (tilt, length) = (0.3f64, 0.6);
    let (leaving, pendulum) =
        ((tilt.cos() / 1.5).acos(), Pendulum { length, gravity: G, amplitude: std::f64::consts::PI - tilt });
    let speed = (2.0 * G * length * (tilt.cos() - leaving.cos())).sqrt();
    for (accuracy, allowed) in [(1e-4, 1e-6), (1e-9, 1e-8)] {
        let mut world = World::new();
        let below = Body { motion: Motion::Static, radius: 0.5, ..ball(DVec2::ZERO, DVec2::ZERO) };
        world.add_body(&below).unwrap();
        world.add_body(&ball(length * v(tilt.sin(), tilt.cos()), DVec2::ZERO)).unwrap();
        let (mut worst, mut flies) = (0.0f64, false);
        watch(&mut world, Method { accuracy, ..by_accuracy() }, 1.0, |world, report| {
            assert!(report.substeps == 0, "{report:?}");
            if velocity(world, 1).x < speed * leaving.cos() - 1e-3 && !flies {
                worst = worst.max((position(world, 1) - pendulum.at(world.time())).length());
            }
            flies = world.contacts().is_empty();
        });
        let across = (velocity(&world, 1).x - speed * leaving.cos()).abs();
        println!("down a disc to {accuracy:.0e}: {worst:.1e} m off the pendulum, {across:.1e} m/s off after leaving");
        assert!(flies && worst < allowed && across < allowed);
    }
}

#[test]
fn a_disc_rolls_off_another_one_at_the_angle_of_its_energy() {
    // Rolling: v² = 4/3 g L (cos θ₀ − cos θ), and nothing presses at g cos θ = v²/L: cos θ = 4/7 cos θ₀. Friction must hold until
    // then, which it does to the end only if it is unbounded; 1000 is near enough.
    let (tilt, length) = (0.3f64, 0.6);
    let mut world = World::new();
    world.set_tuning(Tuning { friction: Some(1000.0), ..Tuning::default() }).unwrap();
    world.add_body(&Body { motion: Motion::Static, radius: 0.5, ..ball(DVec2::ZERO, DVec2::ZERO) }).unwrap();
    let spin = Some(Spin::default());
    world.add_body(&Body { spin, ..ball(length * v(tilt.sin(), tilt.cos()), DVec2::ZERO) }).unwrap();
    watch(&mut world, Method { accuracy: 1e-9, ..by_accuracy() }, 1.0, |_, report| assert!(report.substeps == 0));
    let leaving = (tilt.cos() * 4.0 / 7.0).acos();
    let speed = (4.0 / 3.0 * G * length * (tilt.cos() - leaving.cos())).sqrt();
    let (across, turned) = (velocity(&world, 1).x - speed * leaving.cos(), world.bodies().spin(1).unwrap().omega);
    println!("rolling off: {across:.1e} m/s off, spin {:.1e} rad/s off", turned + speed / 0.1);
    // Friction gives way a little before the end, where the pressure is a thousandth of the weight: by 1e-4 of the speed.
    assert!(across.abs() < 1e-4 && (turned + speed / 0.1).abs() < 1e-4 * speed / 0.1);
}

/// SplitMix64, as in tests/robustness.rs.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

/// A box of discs and particles of all materials, thrown about.
fn random_box(seed: u64) -> World {
    let mut r = Random(seed);
    let mut world = if seed.is_multiple_of(3) { weightless() } else { World::new() };
    if seed % 4 == 1 {
        world.set_drag(r.between(0.0, 2.0)).unwrap();
    }
    let corners = [v(-2.0, -2.0), v(2.0, -2.0), v(2.0, 2.0), v(-2.0, 2.0)];
    for i in 0..4 {
        let shape = Shape::Segment { from: corners[i], to: corners[(i + 1) % 4] };
        world.add_wall(&Wall { shape, restitution: r.unit(), friction: r.unit() }).unwrap();
    }
    world.add_wall(&Wall { restitution: r.unit(), ..Wall::block(v(-0.3, -0.4), v(0.3, -0.1)) }).unwrap();
    for i in 0..2 + seed % 13 {
        let at = v(-1.6 + 0.8 * (i % 5) as f64, 0.3 + 0.65 * (i / 5) as f64);
        let spin = (r.unit() < 0.6).then(|| Spin { angle: 0.0, omega: r.between(-20.0, 20.0) });
        let restitution = if r.unit() < 0.3 { 0.0 } else { r.unit() };
        let mass = 10f64.powf(r.between(-2.0, 2.0));
        let velocity = r.between(0.0, 6.0) * DVec2::from_angle(r.between(0.0, TAU));
        let motion = if i == 7 { Motion::Static } else { Motion::Dynamic };
        let friction = r.unit();
        world
            .add_body(&Body {
                position: at,
                velocity,
                mass,
                radius: 0.25,
                spin,
                restitution,
                friction,
                motion,
                ..Body::default()
            })
            .unwrap();
    }
    world
}

/// Largest overlap of two surfaces [m].
fn overlap(world: &World) -> f64 {
    let (at, radius) = (&world.bodies().position, &world.bodies().radius);
    let mut most = 0.0f64;
    for i in 0..at.len() {
        for j in 0..i {
            most = most.max(radius[i] + radius[j] - (at[i] - at[j]).length());
        }
        for wall in world.walls() {
            most = most.max(radius[i] - wall.shape.distance(at[i]).0);
        }
    }
    most
}

#[test]
fn random_boxes_never_overlap_or_gain_energy_and_repeat_their_bits() {
    let (mut steps, mut lost, mut events) = (0, 0, 0);
    for seed in 1..=30 {
        let mut world = random_box(seed);
        let mut branch = world.clone();
        let mut stepper = Stepper::new(by_accuracy()).unwrap();
        let total = |world: &World| {
            let measures = Measures::of(world);
            measures.kinetic + measures.potential
        };
        let scale = Measures::of(&world).kinetic + 1.0;
        let (mut before, mut exact) = (total(&world), true);
        let mut of_seed = 0;
        for step in 0..300 {
            let report = stepper.step(&mut world);
            assert!(report.divergence.is_none(), "seed {seed}");
            steps += 1;
            events += report.events;
            of_seed += report.given_up;
            exact &= report.given_up == 0;
            let now = total(&world);
            if report.given_up == 0 {
                assert!(now <= before + 1e-9 * scale, "seed {seed}, step {step}: {before} to {now} J");
            }
            if exact {
                // Where discs roll over each other meetings are found to 3e-8 of a radius.
                assert!(overlap(&world) < 1e-7, "seed {seed}, step {step}: {:e} m", overlap(&world));
            }
            before = now;
            Stepper::new(by_accuracy()).unwrap().step(&mut branch);
            assert_eq!(world.hash(), branch.hash(), "seed {seed}, step {step}");
        }
        lost += of_seed;
        println!(
            "seed {seed}: {} bodies, {of_seed} of 300 steps through the substeps, overlap {:.1e}",
            world.bodies().len(),
            overlap(&world)
        );
    }
    println!("random boxes: {events} events, {lost} of {steps} steps through the substeps");
}
