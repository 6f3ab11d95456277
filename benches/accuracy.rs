//! Speed against error on the scenes with a truth: `cargo bench --bench accuracy --no-default-features [-- FILTER]`.
//!
//! Error: RMS distance from the truth over all bodies and samples, in parts of the scene's length. Cost: time of all steps,
//! planning included, per simulated second; median of repeated runs, in turn with the baseline of every engine, semi-implicit
//! Euler with projected Gauss-Seidel, 4 substeps of 10 iterations.

use std::time::Instant;
use tautline::engine::{Integrator, Method, Solver, Stepper};
use tautline::measure::error_against;
use tautline::scene::{self, Setup};
use tautline::truth::stored;

const RUNS: usize = 7;

fn main() {
    let filter: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    let automatic = |accuracy| Method { automatic: true, accuracy, ..Method::default() };
    let by_hand = |integrator, substeps| Method { integrator, substeps, ..Method::default() };
    let pgs = Method { solver: Solver::Pgs, substeps: 4, iterations: 10, ..Method::default() };
    let methods = [
        ("accuracy 1e-3".to_owned(), automatic(1e-3)),
        ("accuracy 1e-6".to_owned(), automatic(1e-6)),
        ("accuracy 1e-9".to_owned(), automatic(1e-9)),
        ("accuracy 1e-12".to_owned(), automatic(1e-12)),
        ("accuracy 1e-13".to_owned(), automatic(1e-13)),
        ("midpoint, 1".to_owned(), by_hand(Integrator::EnergyMomentum, 1)),
        ("RATTLE, 4".to_owned(), by_hand(Integrator::Rattle, 4)),
        ("Runge-Kutta, 4".to_owned(), by_hand(Integrator::RungeKutta4, 4)),
        ("PGS 4 x 10".to_owned(), pgs),
    ];
    for shipped in scene::truth_scenes().iter().filter(|scene| filter.iter().all(|word| scene.name.contains(word))) {
        let truth = stored(shipped.name).expect("a scene with a truth");
        let seconds = truth.times.last().copied().unwrap_or(1.0);
        let mut costs = vec![Vec::new(); methods.len()];
        for _ in 0..RUNS {
            for ((_, method), costs) in methods.iter().zip(&mut costs) {
                costs.push(cost(shipped.name, *method, truth.times.len() - 1) / seconds);
            }
        }
        println!("{:24} {:>10} {:>10} {:>8}", shipped.name, "error", "us/s", "to PGS");
        let medians: Vec<f64> = costs.iter_mut().map(|costs| median(costs)).collect();
        for ((name, method), cost) in methods.iter().zip(&medians) {
            let error = error(shipped.name, *method).unwrap_or(f64::NAN);
            println!("  {name:22} {error:10.1e} {cost:10.0} {:8.2}", cost / medians[medians.len() - 1]);
        }
    }
}

fn open(name: &str) -> Setup {
    scene::open(name).expect("a shipped scene")
}

/// Time of all steps [µs].
fn cost(name: &str, method: Method, steps: usize) -> f64 {
    let mut world = open(name).world;
    let mut stepper = Stepper::new(method).expect("a valid method");
    let start = Instant::now();
    for _ in 0..steps {
        std::hint::black_box(stepper.step(&mut world));
    }
    start.elapsed().as_secs_f64() * 1e6
}

fn error(name: &str, method: Method) -> Option<f64> {
    let truth = stored(name)?;
    let mut world = open(name).world;
    let mut stepper = Stepper::new(method).ok()?;
    let mut motion = vec![world.bodies().position.clone()];
    for _ in 1..truth.times.len() {
        stepper.step(&mut world);
        motion.push(world.bodies().position.clone());
    }
    error_against(&truth.positions, &motion, truth.length)
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
