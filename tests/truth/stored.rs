//! What is stored of the truth: it begins as its scene does, keeps what the motion keeps, and comes out again bit by bit.

use tautline::engine::{DVec2, Kind, World};
use tautline::measure::error_against;
use tautline::scene;
use tautline::truth::closed_form::Pendulum;
use tautline::truth::{Reference, StoreError, TOLERANCES, Trajectory, from_bytes, stored, to_bytes};

fn all() -> impl Iterator<Item = (&'static str, scene::Setup, Trajectory)> {
    scene::truth_scenes().iter().map(|shipped| {
        let setup = scene::open(shipped.name).unwrap();
        (shipped.name, setup, stored(shipped.name).expect("a stored truth"))
    })
}

#[test]
fn every_truth_scene_has_a_truth_of_its_own_length_and_duration_from_its_own_start() {
    for (name, setup, truth) in all() {
        let span = setup.truth.expect("a truth entry");
        println!("{name}: agreement {:.1e}", truth.agreement);
        assert_eq!(truth.length, span.length, "{name}");
        assert_eq!(truth.times.last(), Some(&span.seconds), "{name}");
        assert_eq!(truth.times.len(), truth.positions.len(), "{name}");
        assert_eq!(truth.times[1], 1.0 / 60.0);
        // The start is put on its constraints, from which the file may be an ulp of 10 m away.
        let start = error_against(&truth.positions[..1], &[setup.world.bodies().position.clone()], 1.0);
        assert!(start.is_some_and(|error| error < 2e-15), "{name}: {start:?}");
        // So good that the rounding of the samples is all that is left.
        assert!(truth.agreement < 1e-17, "{name}: {:e}", truth.agreement);
    }
    assert_eq!(stored("rope"), None, "the scene of the sandbox has none");
}

#[test]
fn every_rod_keeps_its_length_in_every_sample() {
    for (name, setup, truth) in all() {
        let constraints = setup.world.constraints();
        let mut worst = 0.0_f64;
        for sample in &truth.positions {
            for (c, kind) in constraints.kind.iter().enumerate() {
                if let Kind::Rod { length } = kind {
                    let [a, b] = [constraints.a[c], constraints.b[c]].map(|body| sample[body as usize]);
                    worst = worst.max(((b - a).length() - length).abs());
                }
            }
        }
        println!("{name}: {worst:.1e} m");
        // Each of four coordinates of up to 10 m is rounded by up to 0.9e-15.
        assert!(worst < 4e-15, "{name}: {worst:e}");
    }
}

/// Energy from stored positions; velocities by central differences of eighth order over 1/60 s.
fn energy(world: &World, samples: &[Vec<DVec2>], k: usize) -> f64 {
    const WEIGHTS: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let (bodies, constraints) = (world.bodies(), world.constraints());
    let of_body = |i: usize| {
        let step = |(n, weight): (usize, &f64)| (samples[k + n + 1][i] - samples[k - n - 1][i]) * (60.0 * weight);
        let velocity: DVec2 = WEIGHTS.iter().enumerate().map(step).sum();
        bodies.mass[i] * (0.5 * velocity.length_squared() - world.gravity().dot(samples[k][i]))
    };
    let of_constraint = |c: usize| {
        let Kind::Spring { rest, stiffness, .. } = constraints.kind[c] else { return 0.0 };
        let [a, b] = [constraints.a[c], constraints.b[c]].map(|body| samples[k][body as usize]);
        0.5 * stiffness * ((b - a).length() - rest).powi(2)
    };
    let kept: f64 = (0..bodies.len()).filter(|&i| world.is_dynamic(i)).map(of_body).sum();
    kept + (0..constraints.len()).map(of_constraint).sum::<f64>()
}

#[test]
fn energy_of_stored_positions_is_kept_as_far_as_differences_can_tell() {
    // The difference's error is (ω/60)⁸/630 of a velocity that changes at the rate ω: some 15/s in the first two, 50/s in the
    // others, whose energies are 10 to 1000 J. The scenes left out have parts that are too fast for it; they are run anew below.
    for (name, tolerance) in [
        ("truth/pendulum", 1e-7),
        ("truth/stiff_chain_1e4", 1e-6),
        ("truth/rigid_net", 1e-5),
        ("truth/cloth", 1e-4),
        ("truth/heavy_rope", 2e-2),
    ] {
        let (world, truth) = (scene::open(name).unwrap().world, stored(name).unwrap());
        let range = 4..truth.positions.len() - 4;
        let energies: Vec<f64> = range.map(|k| energy(&world, &truth.positions, k)).collect();
        let (low, high) = energies.iter().fold((f64::MAX, f64::MIN), |(l, h), &e| (l.min(e), h.max(e)));
        println!("{name}: {:.1e} J", high - low);
        assert!(high - low < tolerance, "{name}: {:e} J", high - low);
    }
}

#[test]
fn the_stored_pendulum_is_the_closed_form() {
    let truth = stored("truth/pendulum").unwrap();
    let pendulum = Pendulum { length: 1.0, gravity: 9.81, amplitude: std::f64::consts::FRAC_PI_2 };
    let exact: Vec<Vec<DVec2>> = truth.times.iter().map(|&t| vec![DVec2::ZERO, pendulum.at(t)]).collect();
    let error = error_against(&truth.positions, &exact, truth.length).unwrap();
    println!("{error:.1e}");
    // The closed form's phase reaches 31 rad with an ulp of 4e-15.
    assert!(error < 1e-14);
}

/// Runs a scene anew up to a sample, compares every bit, and the energy, which the solver does not use.
fn assert_regenerated(name: &str, samples: usize) {
    let (world, truth) = (scene::open(name).unwrap().world, stored(name).unwrap());
    let mut reference = Reference::new(&world, TOLERANCES[1]).unwrap();
    let start = reference.energy();
    for (k, sample) in truth.positions.iter().take(samples.saturating_add(1)).enumerate() {
        if k > 0 {
            reference.advance().unwrap();
        }
        assert_eq!(&reference.positions(), sample, "{name} at sample {k}");
    }
    let drift = (reference.energy() - start).abs().value() / start.abs().value().max(1.0);
    println!("{name}: energy kept to {drift:.1e}");
    // A tolerance of 1e-22 a step, thousands of steps.
    assert!(drift < 1e-18, "{name}: {drift:e}");
}

#[test]
fn short_truths_come_out_the_same_whole() {
    for name in ["truth/pendulum", "truth/double_pendulum", "truth/rope", "truth/bridge", "truth/stiff_chain"] {
        assert_regenerated(name, usize::MAX);
    }
}

#[test]
fn long_truths_come_out_the_same_as_far_as_a_test_may_run() {
    for (name, samples) in
        [("truth/heavy_rope", 20), ("truth/stiff_chain_1e4", 400), ("truth/cloth", 2), ("truth/rigid_net", 1)]
    {
        assert_regenerated(name, samples);
    }
}

#[test]
fn a_truth_is_told_at_its_samples_and_drawn_in_between() {
    let truth = stored("truth/pendulum").unwrap();
    for k in [0, 1, 77, 600] {
        assert_eq!(truth.sample_at(k as f64 / 60.0), Some(truth.positions[k].as_slice()));
        assert_eq!(truth.drawn_at(k as f64 / 60.0).as_ref(), Some(&truth.positions[k]));
    }
    for t in [0.01, 1.0 / 60.0 + 1e-9, -1.0 / 60.0, 10.01, f64::NAN, f64::INFINITY] {
        assert_eq!(truth.sample_at(t), None, "{t}");
    }
    let pendulum = Pendulum { length: 1.0, gravity: 9.81, amplitude: std::f64::consts::FRAC_PI_2 };
    let worst =
        (0..1000).map(|i| 0.009 * f64::from(i)).map(|t| (truth.drawn_at(t).unwrap()[1] - pendulum.at(t)).length());
    let worst = worst.fold(0.0, f64::max);
    println!("drawn {worst:.1e} m off");
    // At most 3 g at the bottom: a/8 · (1/60 s)².
    assert!(worst < 30.0 / 8.0 / 3600.0, "{worst:e}");
    assert!([-0.01, 10.01, f64::NAN].iter().all(|t| truth.drawn_at(*t).is_none()));
}

#[test]
fn stored_bytes_are_read_back_and_damage_is_found() {
    let truth = stored("truth/double_pendulum").unwrap();
    let bytes = to_bytes(&truth);
    assert_eq!(from_bytes(&bytes), Ok(truth));
    assert_eq!(from_bytes(&bytes[..bytes.len() - 1]), Err(StoreError::Damaged));
    assert_eq!(from_bytes(&[&bytes[..], &[0]].concat()), Err(StoreError::Damaged));
    assert_eq!(from_bytes(&bytes[..20]), Err(StoreError::Damaged));
    assert_eq!(from_bytes(b"(version: 1)"), Err(StoreError::Unknown));
    // Counts that claim more than there is must not be believed.
    let mut huge = bytes.clone();
    huge[12..20].fill(0xff);
    assert_eq!(from_bytes(&huge), Err(StoreError::Damaged));
}
