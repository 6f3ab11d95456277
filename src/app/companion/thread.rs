//! A companion's own thread: takes what the simulation tells, in order, and publishes what came of it.

use super::link::Gate;
use super::reference::Reference;
use super::report::{Board, Report, Standing};
use super::rival::Rival;
use super::separation::Gap;
use super::{Beginning, Extent, Input, Pose};
use crate::app::error::Lost;
use crate::engine::Method;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError};
use std::time::{Duration, Instant};

/// What a companion is for.
#[derive(Clone, Copy, Debug)]
pub(super) enum Purpose {
    Truth(Extent),
    Rival(Method),
}

/// What the simulation tells, with the number of the beginning that it belongs to.
pub(super) enum Message {
    Begin(u64, Box<Beginning>),
    Input(u64, Input),
    /// The simulation took a step and is here now.
    Step(u64, Arc<Pose>),
    /// The rival's method.
    Method(Method),
    /// How far the truth is to go from now on; the simulation is at this beginning.
    Extent(u64, Extent, Box<Beginning>),
}

/// Least time between two reports: more than any display shows.
const INTERVAL: Duration = Duration::from_micros(8_333);

/// What runs in the thread.
enum Runner {
    Reference(Box<Reference>),
    Rival(Box<Rival>),
}

pub(super) struct Thread {
    pub purpose: Purpose,
    pub inbox: Receiver<Message>,
    pub board: Arc<Board>,
    pub gate: Arc<Gate>,
    pub wake: Box<dyn Fn() + Send>,
}

/// What the thread has at work.
struct Work {
    generation: u64,
    runner: Option<Runner>,
    /// The last report, if the runner has ended.
    last: Report,
    stale: bool,
    published: Option<Instant>,
}

impl Thread {
    /// Works until the simulation lets go of it.
    pub fn run(mut self) {
        let (runner, last) = (None, Report::default());
        let mut work = Work { generation: 0, runner, last, stale: false, published: None };
        while let Some(message) = self.next(&mut work) {
            self.take(message, &mut work);
            if work.stale && work.published.is_none_or(|at| at.elapsed() >= INTERVAL) {
                self.publish(&mut work);
            }
        }
    }

    /// The next message; publishes what is due while there is none. `None` when the simulation has let go.
    fn next(&self, work: &mut Work) -> Option<Message> {
        match self.inbox.try_recv() {
            Ok(message) => return Some(message),
            Err(TryRecvError::Disconnected) => return None,
            Err(TryRecvError::Empty) => {}
        }
        if work.stale {
            let rest = work.published.map_or(Duration::ZERO, |at| INTERVAL.saturating_sub(at.elapsed()));
            match self.inbox.recv_timeout(rest) {
                Ok(message) => return Some(message),
                Err(RecvTimeoutError::Disconnected) => return None,
                Err(RecvTimeoutError::Timeout) => self.publish(work),
            }
        }
        self.inbox.recv().ok()
    }

    fn take(&mut self, message: Message, work: &mut Work) {
        match message {
            Message::Begin(generation, beginning) if self.gate.is(generation) => {
                work.generation = generation;
                self.board.rewind(beginning.world.time());
                let last = Report { generation, time: beginning.world.time(), ..Report::default() };
                work.last = Report { since: last.time, tick: beginning.world.tick(), ..last };
                let purpose = self.purpose;
                self.guard(work, |work| {
                    work.runner = None;
                    work.runner = Some(match purpose {
                        Purpose::Truth(extent) => Runner::Reference(Box::new(Reference::new(beginning, extent)?)),
                        Purpose::Rival(method) => Runner::Rival(Box::new(Rival::new(beginning, method)?)),
                    });
                    Ok(None)
                });
            }
            Message::Input(generation, input) if self.gate.is(generation) => {
                let gate = self.gate.clone();
                self.guard(work, |work| match &mut work.runner {
                    Some(Runner::Reference(reference)) => {
                        reference.input(&input, &|| gate.is(generation)).map(|()| None)
                    }
                    Some(Runner::Rival(rival)) => rival.input(&input).map(|()| None),
                    None => Ok(None),
                });
            }
            Message::Step(generation, here) if self.gate.is(generation) => {
                self.gate.taken();
                self.step(generation, &here, work);
            }
            Message::Method(method) => {
                self.purpose = Purpose::Rival(method);
                self.guard(work, |work| match &mut work.runner {
                    Some(Runner::Rival(rival)) => rival.set_method(method).map(|()| None),
                    _ => Ok(None),
                });
            }
            Message::Extent(generation, extent, beginning) => {
                self.purpose = Purpose::Truth(extent);
                let counts = self.gate.is(generation);
                self.guard(work, |work| match &mut work.runner {
                    Some(Runner::Reference(reference)) if counts => {
                        reference.set_extent(extent, beginning).map(|()| None)
                    }
                    _ => Ok(None),
                });
            }
            // Of a run that was left.
            Message::Begin(..) | Message::Input(..) | Message::Step(..) => {}
        }
    }

    fn step(&self, generation: u64, here: &Pose, work: &mut Work) {
        if self.gate.is_overrun() {
            self.guard(work, |_| Err(Lost::Overrun));
            return;
        }
        let gate = self.gate.clone();
        self.guard(work, |work| match &mut work.runner {
            Some(Runner::Reference(reference)) => reference.step(here, &|| gate.is(generation)),
            Some(Runner::Rival(rival)) => rival.step(here),
            None => Ok(None),
        });
    }

    /// Does something with the runner. What fails, or panics, ends it, and its last report says why.
    fn guard(&self, work: &mut Work, act: impl FnOnce(&mut Work) -> Result<Option<Gap>, Lost>) {
        let had = work.runner.is_some();
        let outcome = catch_unwind(AssertUnwindSafe(|| act(work)));
        let outcome = outcome.unwrap_or(Err(Lost::Failed));
        work.stale = true;
        match outcome {
            Ok(gap) => gap.into_iter().for_each(|gap| self.board.push(gap)),
            Err(why) => {
                if had || matches!(work.last.standing, Standing::Waiting) {
                    let last = work.report().unwrap_or_else(|| work.last.clone());
                    work.last = Report { standing: Standing::Lost(why.to_string()), frame: last.frame.clone(), ..last };
                }
                work.runner = None;
            }
        }
    }

    fn publish(&self, work: &mut Work) {
        let report = work.report().unwrap_or_else(|| work.last.clone());
        self.board.publish(report);
        work.stale = false;
        work.published = Some(Instant::now());
        (self.wake)();
    }
}

impl Work {
    fn report(&mut self) -> Option<Report> {
        match self.runner.as_mut()? {
            Runner::Reference(reference) => Some(reference.report(self.generation)),
            Runner::Rival(rival) => Some(rival.report(self.generation)),
        }
    }
}
