//! When to stop, what came of it, and the memory in which it happens.

/// Residual in relation to its start beyond which a method is given up.
const DIVERGED: f64 = 1e8;

/// So many sweeps without the best residual falling by [`PROGRESS`] are a standstill. Conjugate gradients may go without
/// progress for some tens of sweeps and then converge; slow is not still: 1e-6 in 100 sweeps needs 1e8 sweeps a figure.
const PATIENCE: usize = 100;
const PROGRESS: f64 = 1e-6;

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// ‖b − A x‖₂ over ‖b‖₂, or over its value at the start if b = 0.
    pub tolerance: f64,
    /// At most so many sweeps.
    pub sweeps: usize,
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The residual is within the tolerance.
    Converged,
    /// The sweeps were used up.
    SweepLimit,
    /// The residual does not fall any more: rounding, inconsistent rows, or a row without diagonal.
    Stagnated,
    /// The residual has grown 1e8-fold, or is no number.
    Diverged,
    /// Conjugate gradients met a direction of no or negative curvature: the matrix is not positive definite.
    NotPositive,
}

/// What came of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    /// Why it ended.
    pub outcome: Outcome,
    /// Sweeps that were done, 0 if the first guess was good enough.
    pub sweeps: usize,
    /// ‖b − A x‖₂ at the end.
    pub residual: f64,
}

/// Memory that may be used again; a run that needs no more than the last one allocates nothing.
#[derive(Clone, Debug, Default)]
pub struct Workspace {
    /// ‖b − A x‖₂ at the start and after every sweep of the last run.
    pub history: Vec<f64>,
    pub(super) vectors: [Vec<f64>; 4],
}

impl Workspace {
    pub(super) fn prepare(&mut self, n: usize, vectors: usize, stop: Stop) {
        self.history.clear();
        // A limit of usize::MAX asks for no such memory.
        self.history.reserve(stop.sweeps.saturating_add(1).min(100_000));
        for vector in &mut self.vectors[..vectors] {
            vector.clear();
            vector.resize(n, 0.0);
        }
    }
}

/// Judges residuals as they come in.
pub(super) struct Watch {
    goal: f64,
    sweeps: usize,
    best: f64,
    since: usize,
}

impl Watch {
    /// `first` is the residual at the start.
    pub(super) fn new(b: &[f64], first: f64, stop: Stop) -> Self {
        let scale = if b.iter().all(|b| *b == 0.0) { first } else { norm(b) };
        Self { goal: stop.tolerance * scale, sweeps: stop.sweeps, best: f64::INFINITY, since: 0 }
    }

    pub(super) fn met_by(&self, residual: f64) -> bool {
        residual <= self.goal
    }

    /// Notes the residual at the start or after a sweep; how the run ends, if it does.
    pub(super) fn note(&mut self, residual: f64, history: &mut Vec<f64>) -> Option<Run> {
        history.push(residual);
        let sweeps = history.len() - 1;
        if residual < (1.0 - PROGRESS) * self.best {
            (self.best, self.since) = (residual, sweeps);
        }
        let outcome = if self.met_by(residual) {
            Outcome::Converged
        } else if !(residual <= DIVERGED * history[0]) {
            Outcome::Diverged
        } else if sweeps >= self.sweeps {
            Outcome::SweepLimit
        } else if sweeps - self.since >= PATIENCE {
            Outcome::Stagnated
        } else {
            return None;
        };
        Some(Run { outcome, sweeps, residual })
    }
}

pub(super) fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}
