//! Rapier 0.36 as a witness, in single and in double precision, on scenes whose truth is known and on piles.
//!
//! A world is built twice, ours and Rapier's, from the same bodies, walls and constraints (`witness.rs`). An error is the RMS
//! distance from the truth over all bodies and samples, divided by the scene's length. A time is that of the stepping alone, in
//! microseconds for a simulated second: every step counts with the least time that it took in three equal runs, so that whatever
//! else the machine does stays out. Both engines are compiled with the same optimisation, ours with overflow checks besides.
//! Times are printed and never asserted.
//!
//! Rapier's settings: its **defaults** (60 steps a second of 4 solver iterations, which are its substeps), in both precisions, and a
//! **better** one in double precision that spends 16 times the work on the same solver: 240 steps a second of 16 iterations,
//! joints warm-started, contacts always found anew, and contacts four times as stiff, which steps that short can follow. Bodies never
//! sleep. Of the two ways to build a rod there, as a rope joint or as a hinge on a light link, the one with the smaller error
//! counts. Rapier is made for games, where none of this is needed; the figures say nothing about that use.
//!
//! `cargo test --test rapier -- --nocapture` prints all figures.

mod contacts;
mod ours;
mod pile;
mod truth_scenes;
mod witness;

use tautline::engine::DVec2;
use tautline::measure::error_against;
use tautline::truth::Trajectory;

/// A motion and what it cost.
#[derive(Clone)]
pub struct Run {
    /// Centres of all bodies every 1/60 s from the start on [m].
    pub motion: Vec<Vec<DVec2>>,
    /// Time between each of these and the next [s].
    pub spent: Vec<f64>,
}

impl Run {
    /// Carries a motion on from `start` by `step`, which says where bodies are 1/60 s later, and times it.
    fn of(start: Vec<DVec2>, samples: usize, mut step: impl FnMut() -> Vec<DVec2>) -> Run {
        let (mut motion, mut spent) = (vec![start], Vec::new());
        for _ in 1..samples {
            let before = std::time::Instant::now();
            motion.push(step());
            spent.push(before.elapsed().as_secs_f64());
        }
        Run { motion, spent }
    }

    /// Time of a simulated second [µs].
    pub fn us_per_second(&self) -> f64 {
        60e6 * self.spent.iter().sum::<f64>() / self.spent.len() as f64
    }

    /// Error against a truth, printed with the time.
    pub fn report(&self, name: &str, truth: &Trajectory) -> f64 {
        let error = error_against(&truth.positions, &self.motion, truth.length).expect("the same samples");
        println!("  {name:28} error {error:8.1e} at {:9.0} µs/s", self.us_per_second());
        error
    }
}

/// One of three equal runs, with the least time that each step took in any of them.
fn cheapest(run: impl Fn() -> Run) -> Run {
    let mut first = run();
    for again in [run(), run()] {
        first.spent.iter_mut().zip(again.spent).for_each(|(least, spent)| *least = least.min(spent));
    }
    first
}
