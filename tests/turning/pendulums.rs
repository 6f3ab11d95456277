//! Discs that hang on pins and rods off their centres.

use super::independent::{Link, chain_rate, converged};
use super::*;
use tautline::truth::closed_form::Pendulum;

/// A disc pinned at `d` from its centre, let go at `amplitude`: a pendulum of the length (I + m d²)/(m d).
fn physical(d: f64, amplitude: f64) -> (World, Pendulum) {
    let (mass, radius) = (3.0, 0.5);
    let mut world = World::new();
    let towards = DVec2::from_angle(amplitude - std::f64::consts::FRAC_PI_2);
    // The pin lies on the disc's own x axis, behind the centre.
    let body = world.add_body(&disc(d * towards, mass, radius, towards.to_angle(), 0.0)).unwrap();
    join(&mut world, Kind::Pin, Anchor::Body(body, v(-d, 0.0)), Anchor::World(DVec2::ZERO));
    let length = inertia_about(mass, radius, d) / (mass * d);
    (world, Pendulum { length, gravity: G, amplitude })
}

/// Largest distance of the centre from the closed form over 10 s, as a part of the diameter, and the largest violation [m].
fn physical_error(method: Method, d: f64, amplitude: f64) -> (f64, f64) {
    let (mut world, truth) = physical(d, amplitude);
    let mut stepper = Stepper::new(method).unwrap();
    let (mut worst, mut violated) = (0.0f64, 0.0f64);
    for _ in 0..600 {
        step(&mut world, &mut stepper);
        let exact = truth.at(world.time()) * (d / truth.length);
        worst = worst.max((world.bodies().position[0] - exact).length());
        violated = violated.max(violation(&world));
    }
    (worst, violated)
}

#[test]
fn a_disc_pinned_off_its_centre_swings_as_a_physical_pendulum() {
    for (d, amplitude) in [(0.5, 2.0), (0.2, 1.0), (0.02, 3.0)] {
        for accuracy in [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13] {
            let (error, violated) = physical_error(by_accuracy(accuracy), d, amplitude);
            println!(
                "pinned {d} m off, {amplitude} rad, wanted {accuracy:.0e}: {error:.1e} m, violation {violated:.1e} m"
            );
            // What is wanted is kept after a second or two, and grows with time; rounding is some 1e-13 after 10 s.
            assert!(error < 10.0 * allowed(accuracy), "{d}, {amplitude}, {accuracy:e}: {error:e}");
            assert!(accuracy > 1e-12 || violated < 1e-13, "{violated:e}");
        }
    }
}

#[test]
fn integrators_that_take_no_anchors_off_centres_leave_them_to_the_series() {
    let takes_none = |integrator: &Integrator| integrator.is_direct() && *integrator != Integrator::Rattle;
    for integrator in Integrator::ALL.into_iter().filter(takes_none) {
        let method = Method { integrator, accuracy: 1e-10, ..Method::default() };
        let (error, _) = physical_error(method, 0.4, 1.5);
        println!("{}: {error:.1e} m", integrator.name());
        assert!(error < 1e-9, "{integrator:?}: {error:e}");
    }
}

/// Discs of these masses and radii, each pinned by its rim to the opposite rim of the one before, in a world under gravity.
fn hanging(discs: &[(f64, f64)], angles: &[f64]) -> (World, Vec<Link>) {
    let mut world = World::new();
    let mut links = Vec::new();
    let mut at = DVec2::ZERO;
    let mut above = Anchor::World(DVec2::ZERO);
    for ((mass, radius), angle) in discs.iter().zip(angles) {
        let down = v(angle.sin(), -angle.cos());
        // Its own x axis points from the upper to the lower pin.
        let body = disc(at + *radius * down, *mass, *radius, angle - std::f64::consts::FRAC_PI_2, 0.0);
        let id = world.add_body(&body).unwrap();
        join(&mut world, Kind::Pin, above, Anchor::Body(id, v(-radius, 0.0)));
        above = Anchor::Body(id, v(*radius, 0.0));
        at += 2.0 * radius * down;
        links.push(Link { mass: *mass, inertia: 0.5 * mass * radius * radius, centre: *radius, length: 2.0 * radius });
    }
    (world, links)
}

/// Largest error of an angle and of its rate [rad, rad/s] after `seconds` at these accuracies.
fn chain_errors(discs: &[(f64, f64)], angles: &[f64], seconds: f64, accuracies: &[f64]) -> Vec<f64> {
    let (world, links) = hanging(discs, angles);
    let n = discs.len();
    let start: Vec<f64> = angles.iter().copied().chain(vec![0.0; n]).collect();
    let (exact, apart) = converged(|_, y| chain_rate(&links, G, y), &start, seconds, (160.0 * seconds) as usize);
    println!("{n} discs after {seconds} s: the reference agrees with itself to {apart:.1e}");
    let run = |accuracy: &f64| {
        let (mut world, mut stepper) = (world.clone(), Stepper::new(by_accuracy(*accuracy)).unwrap());
        let (mut violated, mut steps) = (0.0f64, 0);
        for _ in 0..(60.0 * seconds) as u32 {
            steps += step(&mut world, &mut stepper).island_steps;
            violated = violated.max(violation(&world));
        }
        let off = |i: usize| {
            let turned = angle(&world, i) + std::f64::consts::FRAC_PI_2;
            (turned - exact[i]).abs().max((omega(&world, i) - exact[n + i]).abs())
        };
        let error = (0..n).map(off).fold(0.0, f64::max);
        println!("  wanted {accuracy:.0e}: {error:.1e} rad or rad/s in {steps} steps, violation {violated:.1e} m");
        assert!(*accuracy > 1e-9 || violated < 1e-10, "{violated:e}");
        error
    };
    accuracies.iter().map(run).collect()
}

const ACCURACIES: [f64; 6] = [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13];

#[test]
fn two_discs_pinned_rim_to_rim_are_a_compound_double_pendulum() {
    let errors = chain_errors(&[(2.0, 0.5), (1.0, 0.3)], &[2.0, 1.2], 3.0, &ACCURACIES);
    for (error, accuracy) in errors.iter().zip(ACCURACIES) {
        // The rates are some ten times the lengths over which the accuracy is kept, and two swings stretch errors.
        assert!(*error < 100.0 * allowed(accuracy), "{accuracy:e}: {error:e}");
    }
    // Local errors are kept at a fixed part of what is wanted, so the error must fall with it, within the jumps of the order.
    assert!(errors[1..5].windows(2).all(|pair| pair[1] < 0.1 * pair[0]), "{errors:?}");
}

#[test]
fn a_chain_of_ten_discs_pinned_rim_to_rim_follows_its_minimal_coordinates() {
    let discs = [(1.0, 0.1); 10];
    let angles: Vec<f64> = (0..10).map(|i| 1.5 - 0.05 * f64::from(i)).collect();
    let errors = chain_errors(&discs, &angles, 1.0, &[1e-5, 1e-9, 1e-13]);
    assert!(errors[0] < 1e-3 && errors[1] < 1e-7 && errors[2] < 1e-9, "{errors:?}");
}

#[test]
fn a_disc_hung_by_a_rod_from_its_rim_is_a_double_pendulum_of_a_rod_without_mass() {
    let (length, mass, radius, rod, turned) = (1.0, 2.0, 0.4, 1.3, -0.7);
    let rim = length * v(f64::sin(rod), -f64::cos(rod));
    let down = v(f64::sin(turned), -f64::cos(turned));
    let links = [
        Link { mass: 0.0, inertia: 0.0, centre: length, length },
        Link { mass, inertia: 0.5 * mass * radius * radius, centre: radius, length: 0.0 },
    ];
    let (exact, apart) = converged(|_, y| chain_rate(&links, G, y), &[rod, turned, 0.0, 0.0], 1.5, 480);
    println!("a disc on a rod after 1.5 s: the reference agrees with itself to {apart:.1e}");
    for accuracy in ACCURACIES {
        let mut world = World::new();
        let body = world
            .add_body(&disc(rim + radius * down, mass, radius, turned - std::f64::consts::FRAC_PI_2, 0.0))
            .unwrap();
        join(&mut world, Kind::Rod { length }, Anchor::World(DVec2::ZERO), Anchor::Body(body, v(-radius, 0.0)));
        let mut stepper = Stepper::new(by_accuracy(accuracy)).unwrap();
        let mut violated = 0.0f64;
        for _ in 0..90 {
            step(&mut world, &mut stepper);
            violated = violated.max(violation(&world));
        }
        let expected = length * v(exact[0].sin(), -exact[0].cos()) + radius * v(exact[1].sin(), -exact[1].cos());
        let error = (world.bodies().position[0] - expected).length();
        let turn = (angle(&world, 0) + std::f64::consts::FRAC_PI_2 - exact[1]).abs();
        println!("  wanted {accuracy:.0e}: {error:.1e} m, {turn:.1e} rad, violation {violated:.1e} m");
        assert!(error.max(turn) < 3.0 * allowed(accuracy), "{accuracy:e}: {error:e}, {turn:e}");
        assert!(accuracy > 1e-9 || violated < 1e-10, "{violated:e}");
    }
}

/// Largest distance of a centre from where it must be [m] after a second of a chain of ten discs, and the time of the steps [µs], the
/// least of some runs.
fn quick_chain(method: Method) -> (f64, f64) {
    let discs = [(1.0, 0.1); 10];
    let angles: Vec<f64> = (0..10).map(|i| 1.5 - 0.05 * f64::from(i)).collect();
    let (world, links) = hanging(&discs, &angles);
    let start: Vec<f64> = angles.iter().copied().chain(vec![0.0; 10]).collect();
    let (exact, _) = converged(|_, y| chain_rate(&links, G, y), &start, 1.0, 160);
    let (mut error, mut cost) = (0.0f64, f64::INFINITY);
    for _ in 0..9 {
        let (mut world, mut stepper) = (world.clone(), Stepper::new(method).unwrap());
        stepper.plan(&world);
        let begin = std::time::Instant::now();
        (0..60).for_each(|_| drop(stepper.step(&mut world)));
        cost = cost.min(begin.elapsed().as_secs_f64() * 1e6);
        let mut at = DVec2::ZERO;
        for (i, angle) in exact[..10].iter().enumerate() {
            let down = 0.1 * v(angle.sin(), -angle.cos());
            error = error.max((world.bodies().position[i] - at - down).length());
            at += 2.0 * down;
        }
    }
    (error, cost)
}

#[test]
fn a_chain_of_discs_is_far_closer_than_with_sweeps() {
    let sweeps = |substeps, iterations| Method { substeps, iterations, ..Method::default() };
    let mut found = Vec::new();
    for (name, method) in [
        ("PGS, 4 x 10", sweeps(4, 10)),
        ("PGS, 16 x 10", sweeps(16, 10)),
        ("PGS, 64 x 20", sweeps(64, 20)),
        ("accuracy 1e-3", by_accuracy(1e-3)),
        ("accuracy 1e-5", by_accuracy(1e-5)),
        ("accuracy 1e-9", by_accuracy(1e-9)),
        ("accuracy 1e-13", by_accuracy(1e-13)),
    ] {
        let (error, cost) = quick_chain(method);
        println!("ten discs for 1 s, {name}: {error:.1e} m at {cost:.0} us/s");
        found.push(error);
    }
    // The accuracy is in parts of the chain of two metres.
    assert!(found[3] < 2e-3 && found[4] < 1e-5 && found[5] < 1e-9 && found[6] < 1e-11, "{found:?}");
    assert!(found[4] < 1e-2 * found[2], "{found:?}");
}

#[test]
fn rattle_is_of_order_two_with_angles() {
    let by_steps = |substeps| Method { integrator: Integrator::Rattle, substeps, ..Method::default() };
    let errors = [8, 16, 32].map(|substeps| physical_error(by_steps(substeps), 0.3, 1.5).0);
    let chain = [16, 32, 64].map(|substeps| quick_chain(by_steps(substeps)).0);
    for (name, errors) in [("a pinned disc", errors), ("ten discs", chain)] {
        let orders = [(errors[0] / errors[1]).log2(), (errors[1] / errors[2]).log2()];
        println!("RATTLE, {name}: [{:.1e}, {:.1e}, {:.1e}], orders {orders:.2?}", errors[0], errors[1], errors[2]);
        assert!((orders[1] - 2.0).abs() < 0.1, "{name}: {errors:?}");
    }
}
