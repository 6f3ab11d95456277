//! A reference for any world: the engine's most accurate method, refined until two runs agree.

use super::reference::{Lost, Reference, Source};
use super::trial::{Stop, Trial};
use crate::engine::{DVec2, EngineError, Integrator, LinearSolver, Method, Solver, World};
use crate::measure::error_against;
use crate::truth::SAMPLES_PER_SECOND;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// Agreement that ends the refining, in parts of the length.
const WANTED: f64 = 1e-12;
/// Two runs have parted where some body is farther from itself than this, in parts of the length.
const PARTED: f64 = 1e-3;
/// Part of the time asked for that must be known for a reference to be of use.
const USEFUL: f64 = 0.25;
/// The last refinement: 60 · 2⁹ Hz is within what a method accepts.
const MOST_LEVELS: u32 = 10;
/// From this level on only the step is halved: the accuracy is at its finest.
const FINEST_ACCURACY: u32 = 3;
/// Bodies × samples that are kept at most, 16 bytes each, three runs at a time.
const MOST_POSITIONS: usize = 20_000_000;

/// How far the refining is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LevelReport {
    /// The run under way, from 0.
    pub level: u32,
    /// Part of it that is done, 0 to 1.
    pub part: f64,
    /// RMS distance of the two finest runs so far, in parts of the length.
    pub agreement: Option<f64>,
}

/// Why there is no reference.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoReference {
    /// The two finest runs part before a quarter of the time.
    #[error("{0}")]
    Lost(Lost),
    /// A run left the range of numbers in which it means anything.
    #[error("no reference: the most accurate method diverged after {after:.1} s")]
    Diverged {
        /// Simulated time [s].
        after: f64,
    },
    /// Either of the first two runs took ten times the budget.
    #[error("no reference: two runs do not fit into {seconds:.1} s; give more time, or compare over fewer seconds")]
    TooSlow {
        /// The budget [s].
        seconds: f64,
    },
    /// The samples of three runs would take too much memory.
    #[error("no reference: {bodies} bodies over {seconds} s are too much to keep; compare over fewer seconds")]
    TooLarge {
        /// Bodies of the world.
        bodies: usize,
        /// Simulated time that was asked for [s].
        seconds: f64,
    },
    /// Somebody asked to stop.
    #[error("no reference: stopped before it had converged")]
    Cancelled,
    /// The engine refuses the method.
    #[error("no reference: {0}")]
    Engine(#[from] EngineError),
}

/// The motion of `world` over `seconds`, computed with step and tolerance refined until two runs agree to 1e-12 of `length` [m],
/// refining brings no more, or the next run would not fit into what is left of `budget`; two runs are done in any case, unless
/// they take ten times the budget. `method` gives what has no accuracy (feedback, linear solver excepted).
///
/// The reference is the finer of the two runs that agree best, and is known to their distance. That covers its true error as long
/// as refining converges: the coarser one is then the farther from the truth. Where some body parts from itself by more than
/// a thousandth of the length, the samples end.
pub fn refine(
    world: &World,
    method: Method,
    seconds: f64,
    length: f64,
    budget: Duration,
    cancel: &AtomicBool,
    tell: &mut dyn FnMut(LevelReport),
) -> Result<Reference, NoReference> {
    let bodies = world.bodies().len();
    if bodies as f64 * seconds * f64::from(SAMPLES_PER_SECOND) > MOST_POSITIONS as f64 {
        return Err(NoReference::TooLarge { bodies, seconds });
    }
    let begun = Instant::now();
    let mut levels = Levels { length, pairs: Vec::new(), finest: Vec::new() };
    let mut took = [Duration::ZERO; 2];
    for level in 0..MOST_LEVELS {
        let left = budget.saturating_sub(begun.elapsed());
        // The step is halved, and iterations doubled where there are any; what was seen counts if it is more.
        let growth = (took[1].as_secs_f64() / took[0].as_secs_f64().max(1e-9)).clamp(2.0, 8.0);
        if level >= 2 && took[1].mul_f64(growth) > left {
            break;
        }
        let limit = if level < 2 { budget * 10 } else { left * 2 };
        let agreement = levels.agreement();
        let started = Instant::now();
        let mut trial = Trial::new(world, refined(method, level), cancel)?;
        match trial.motion(seconds, limit, |part| tell(LevelReport { level, part, agreement })) {
            Ok(motion) if motion.diverged => {
                return Err(NoReference::Diverged { after: motion.positions.len() as f64 / 60.0 });
            }
            Ok(motion) => levels.add(motion.positions),
            Err(Stop::Cancelled) => return Err(NoReference::Cancelled),
            Err(Stop::TooSlow) if level < 2 => return Err(NoReference::TooSlow { seconds: budget.as_secs_f64() }),
            Err(Stop::TooSlow) => break,
        }
        took = [took[1], started.elapsed()];
        if levels.done(level) {
            break;
        }
    }
    levels.into_reference()
}

/// The method of a level.
fn refined(scene: Method, level: u32) -> Method {
    let accuracy = 1e-8 * libm::pow(1e-2, f64::from(level.min(FINEST_ACCURACY)));
    Method {
        hz: f64::from(SAMPLES_PER_SECOND << level),
        substeps: scene.substeps.max(4),
        iterations: (scene.iterations.max(20) << level).min(100_000),
        integrator: Integrator::VelocityVerlet,
        solver: Solver::Pgs,
        automatic: true,
        accuracy: accuracy.max(1e-14),
        linear: LinearSolver::default(),
        warm_start: true,
        baumgarte: scene.baumgarte,
    }
}

/// A run, and by sample the largest distance of a body from where the run before has it, in parts of the length.
struct Pair {
    positions: Vec<Vec<DVec2>>,
    distances: Vec<f64>,
    rms: f64,
}

/// The runs so far.
struct Levels {
    length: f64,
    /// Best and last of the pairs of successive runs.
    pairs: Vec<Pair>,
    finest: Vec<Vec<DVec2>>,
}

impl Levels {
    fn add(&mut self, positions: Vec<Vec<DVec2>>) {
        if !self.finest.is_empty() {
            let apart = |(a, b): (&Vec<DVec2>, &Vec<DVec2>)| {
                a.iter().zip(b).map(|(a, b)| (*a - *b).length()).fold(0.0, f64::max) / self.length
            };
            let distances: Vec<f64> = self.finest.iter().zip(&positions).map(apart).collect();
            let rms = error_against(&self.finest, &positions, self.length).unwrap_or(f64::INFINITY);
            self.pairs.push(Pair { positions: positions.clone(), distances, rms });
            // Only the last two, and the positions of the better one, are looked at again.
            if self.pairs.len() > 2 {
                self.pairs.remove(0);
            }
        }
        self.finest = positions;
    }

    fn agreement(&self) -> Option<f64> {
        self.pairs.last().map(|pair| pair.rms)
    }

    /// Whether another run would bring nothing.
    fn done(&self, level: u32) -> bool {
        match &self.pairs[..] {
            [.., last] if last.rms <= WANTED => true,
            [before, last] => level > FINEST_ACCURACY && last.rms > 0.5 * before.rms,
            _ => false,
        }
    }

    fn into_reference(mut self) -> Result<Reference, NoReference> {
        let lost = self.lost();
        let best = match &self.pairs[..] {
            // At round-off a finer run is not a better one.
            [before, last] if before.rms < last.rms && lost.is_none() => 0,
            pairs => pairs.len() - 1,
        };
        let Pair { mut positions, distances, .. } = self.pairs.swap_remove(best);
        let count = positions.len();
        let parted = distances.iter().position(|distance| !(*distance <= PARTED)).unwrap_or(count);
        if let Some(lost) = lost.filter(|_| (parted as f64) < USEFUL * count as f64) {
            return Err(NoReference::Lost(lost));
        }
        positions.truncate(parted);
        // The largest distance of a sample's bodies, since a sample is no longer at hand body by body: a bound on their RMS.
        let squares: f64 = distances[..parted].iter().map(|distance| distance * distance).sum();
        let known_to = (squares / parted.max(1) as f64).sqrt();
        Ok(Reference { source: Source::Refined, known_to, length: self.length, positions, lost })
    }

    /// From when on the two finest runs disagree, and whether refining would help.
    fn lost(&self) -> Option<Lost> {
        let last = self.pairs.last()?;
        let parted = last.distances.iter().position(|distance| !(*distance <= PARTED))?;
        let after = parted as f64 / f64::from(SAMPLES_PER_SECOND);
        let rest = |pair: &Pair| pair.distances[parted..].iter().map(|distance| distance * distance).sum::<f64>();
        match &self.pairs[..] {
            [before, last] if rest(last) <= 0.25 * rest(before) => Some(Lost::NotConverged(after)),
            [_, _] => Some(Lost::Chaotic(after)),
            _ => Some(Lost::NotConverged(after)),
        }
    }
}
