//! What a companion tells the window: immutable reports, and the curve of its distances.

use super::separation::{Gap, Offsets, Parting};
use crate::app::frame::Frame;
use crate::app::plot_data::PLOT_SECONDS;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// At most this many distances are kept for the plot.
const MOST_SAMPLES: usize = 24_000;

/// What a companion is worth at the moment.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Standing {
    /// It has not begun.
    #[default]
    Waiting,
    /// The truth is known: stored with the scene, or a closed form. Its own error in parts of the scene's length.
    Exact {
        /// How far the known motion may be from the true one, in parts of the length.
        error: f64,
    },
    /// Two runs of different fineness agree to this part of the scene's length.
    Converged {
        /// How far the two runs are apart, in parts of the length.
        to: f64,
    },
    /// The two runs parted at this time [s]: from then on there is no reference. `chaotic` if both were carried to their
    /// accuracy until then, so that only neighbouring motions parting can be why; otherwise the runs may have been too coarse.
    Parted {
        /// Simulated time [s].
        after: f64,
        /// Both runs kept their accuracy until then.
        chaotic: bool,
    },
    /// What is known of the motion ended at this time [s], or was no longer that of the scene, and nobody asked to compute it.
    Over {
        /// Simulated time [s].
        after: f64,
        /// The scene had been changed by then; otherwise no more of its motion is known.
        touched: bool,
    },
    /// A world that is only compared.
    Following,
    /// It ended, and why.
    Lost(String),
}

/// One state of a companion.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// Which beginning it belongs to: those of others are of the past.
    pub generation: u64,
    /// Step that it has reached.
    pub tick: u64,
    /// Simulated time that it has reached [s].
    pub time: f64,
    /// Simulated time from when on it has followed [s].
    pub since: f64,
    /// What it is worth at the moment, or why it ended.
    pub standing: Standing,
    /// By which distances are divided [m].
    pub length: f64,
    /// The last distance of the simulation from it.
    pub gap: Option<Gap>,
    /// Root mean square of the distance over all samples so far [m].
    pub so_far: f64,
    /// Where and when the simulation was first visibly apart from it; `None` if it never was.
    pub parting: Option<Parting>,
    /// "4e5-fold", where the motion itself lets errors grow by so much.
    pub growth: Option<String>,
    /// How far each body of the simulation is from where the companion has it.
    pub offsets: Arc<Offsets>,
    /// The rival's own picture; nobody else has one.
    pub frame: Option<Arc<Frame>>,
}

/// What the companion's thread and the window share.
#[derive(Debug, Default)]
pub(super) struct Board {
    report: Mutex<Arc<Report>>,
    gaps: Mutex<VecDeque<Gap>>,
}

impl Board {
    pub fn report(&self) -> Arc<Report> {
        self.report.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    pub fn publish(&self, report: Report) {
        let new = Arc::new(report);
        let old = std::mem::replace(&mut *self.report.lock().unwrap_or_else(PoisonError::into_inner), new);
        // Freed here, outside the lock.
        drop(old);
    }

    pub fn gaps(&self) -> MutexGuard<'_, VecDeque<Gap>> {
        self.gaps.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub fn push(&self, gap: Gap) {
        let mut gaps = self.gaps();
        let oldest = gap.time - PLOT_SECONDS;
        while gaps.len() >= MOST_SAMPLES || gaps.front().is_some_and(|first| first.time < oldest) {
            gaps.pop_front();
        }
        gaps.push_back(gap);
    }

    /// Forgets what lies after `time` [s]: the run goes on from there.
    pub fn rewind(&self, time: f64) {
        self.gaps().retain(|gap| gap.time <= time);
    }
}

/// A companion as a frame knows it. Cheap to clone.
#[derive(Clone, Debug)]
pub struct Companion {
    pub(super) board: Arc<Board>,
    pub(super) generation: u64,
}

impl Companion {
    /// A companion that reports just this, for pictures of the panels.
    pub fn fixed(report: Report, gaps: impl IntoIterator<Item = Gap>) -> Companion {
        let generation = report.generation;
        let board = Board::default();
        board.publish(report);
        gaps.into_iter().for_each(|gap| board.push(gap));
        Companion { board: Arc::new(board), generation }
    }

    /// Its latest report; one of a run that was left is empty.
    pub fn report(&self) -> Arc<Report> {
        let report = self.board.report();
        if report.generation == self.generation { report } else { Arc::default() }
    }

    /// The distances of the last 20 s, oldest first. The companion waits while the guard lives: read and let go.
    pub fn gaps(&self) -> MutexGuard<'_, VecDeque<Gap>> {
        self.board.gaps()
    }
}

/// The companions of a simulation.
#[derive(Clone, Debug, Default)]
pub struct Companions {
    /// The truth, drawn as a ghost.
    pub truth: Option<Companion>,
    /// "B", drawn beside the simulation.
    pub rival: Option<Companion>,
}
