//! Ropes, rods and springs whose exact motion is stored. The double pendulum is left out: one of its rods pushes, which a rope
//! joint cannot.

use super::ours;
use super::witness::{BETTER, DEFAULT, Rods, Setting, double, single};
use tautline::engine::{Method, Stepper, World};
use tautline::scene;
use tautline::truth::{Trajectory, stored};

/// The least tension of a rod over the motion [N].
fn least_tension(world: &World, samples: usize) -> f64 {
    let (mut world, mut stepper) = (world.clone(), Stepper::new(ours::to(1e-9)).unwrap());
    let kinds = world.constraints().kind.clone();
    let rods: Vec<usize> = (0..kinds.len()).filter(|&i| kinds[i].name() == "Rod").collect();
    (1..samples).fold(f64::INFINITY, |least, _| {
        stepper.step(&mut world);
        rods.iter().map(|&i| world.constraints().tension(i)).fold(least, f64::min)
    })
}

/// Prints all errors and times on a scene; returns our error to 1e-9 and the best of Rapier's.
fn compare(name: &str) -> (f64, f64) {
    let (world, truth) = (scene::open(name).unwrap().world, stored(name).unwrap());
    let samples = truth.times.len();
    let tension = least_tension(&world, samples);
    println!("{name}");
    // A rope joint is a rod as long as nothing pushes; rounding aside, as where a rod is let go across its pull.
    assert!(tension > -1e-6, "a rod pushes with {tension} N");
    ours::run(&world, Method::default(), samples).report("ours, 4 substeps of 10", &truth);
    ours::run(&world, ours::to(1e-3), samples).report("ours to 1e-3", &truth);
    let error = ours::run(&world, ours::to(1e-9), samples).report("ours to 1e-9", &truth);
    let has_rods = tension.is_finite();
    let best = [("default", DEFAULT), ("better", BETTER)]
        .map(|(name, setting)| theirs(name, setting, has_rods, &world, &truth));
    (error, best[0].min(best[1]))
}

/// Rapier's error in double precision; with default settings the one in single precision is printed too.
fn theirs(name: &str, setting: Setting, has_rods: bool, world: &World, truth: &Trajectory) -> f64 {
    let samples = truth.times.len();
    let with = |rods| Setting { rods, ..setting };
    let mut best = f64::INFINITY;
    for rods in [Rods::Ropes, Rods::Hinges] {
        if rods == Rods::Hinges && !has_rods {
            continue;
        }
        let kind = if has_rods { format!(", {rods:?}").to_lowercase() } else { String::new() };
        if name == "default" {
            single::run(world, with(rods), samples).report(&format!("Rapier f32, {name}{kind}"), truth);
        }
        let error = double::run(world, with(rods), samples).report(&format!("Rapier f64, {name}{kind}"), truth);
        best = best.min(if error.is_finite() { error } else { f64::INFINITY });
    }
    best
}

#[test]
fn ours_is_nearer_to_the_truth_than_rapiers_best_by_a_thousand() {
    // The second is what Rapier's best must reach to be a witness of the same motion: it is of first order in its substeps, of
    // which there are 3840 a second. It never holds 100 kg on links of 20 g, whatever it spends.
    for (name, witness) in [
        ("truth/pendulum", 0.1),
        ("truth/rope", 0.01),
        ("truth/heavy_rope", f64::INFINITY),
        ("truth/bridge", 0.01),
        ("truth/cloth", 0.01),
        ("truth/stiff_chain", 0.01),
    ] {
        let (ours, best) = compare(name);
        assert!(ours < 1e-8, "{name}: {ours:e}");
        assert!(best < witness && best > 1000.0 * ours, "{name}: {best:e} and {ours:e}");
    }
}

#[test]
fn rapier_converges_to_the_stored_truth() {
    for name in ["truth/rope", "truth/stiff_chain"] {
        let (world, truth) = (scene::open(name).unwrap().world, stored(name).unwrap());
        let [coarse, fine] = [BETTER.steps, 2 * BETTER.steps].map(|steps| {
            let run = double::run(&world, Setting { steps, ..BETTER }, truth.times.len());
            run.report(&format!("{name}, {steps} steps a frame"), &truth)
        });
        let order = tautline::measure::observed_order(coarse, fine).unwrap();
        println!("  order {order:.2}");
        // First order in the step, and somewhat more while warm-started joints are solved better as well.
        assert!((0.7..2.2).contains(&order), "{name}: {coarse:e} and {fine:e}");
    }
}
