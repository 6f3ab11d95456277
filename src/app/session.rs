//! The simulation's own thread: it takes commands, steps in real time, and publishes frames. The window never waits for it.

use super::command::Command;
use super::frame::Frame;
use super::simulation::Simulation;
use crate::scene::Setup;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// A running simulation, held from the window's side.
pub struct Session {
    commands: Sender<Command>,
    latest: Arc<Mutex<Arc<Frame>>>,
    /// Disconnected when the thread has ended.
    ended: Receiver<()>,
}

/// Least time between two frames: more than any display shows would only copy for nothing.
const FRAME_INTERVAL: Duration = Duration::from_micros(8_333);
/// How far a run may fall behind real time and still catch up; what is beyond that is given up, so that it never spirals.
const MOST_LAG: Duration = Duration::from_millis(50);
/// Time over which the achieved speed is averaged.
const SPEED_WINDOW: Duration = Duration::from_millis(500);
/// How long the end of a session waits for a step that is under way.
const FAREWELL: Duration = Duration::from_secs(1);

impl Session {
    /// Starts a thread that runs `setup`. `wake` is called in that thread after each new frame, to have the window drawn, and
    /// clones of it in the threads of companions when they have something new to show.
    ///
    /// # Errors
    /// If the system has no room for another thread.
    pub fn start(setup: Setup, wake: impl Fn() + Clone + Send + 'static) -> std::io::Result<Session> {
        let companions_wake = wake.clone();
        let waker = move || Box::new(companions_wake.clone()) as Box<dyn Fn() + Send>;
        let mut simulation = Simulation::new(setup, Box::new(waker));
        let latest = Arc::new(Mutex::new(simulation.publish(0, simulation.speed())));
        let (commands, inbox) = channel();
        let (end, ended) = channel();
        let thread = Thread {
            pace: Pace::new(Instant::now(), &simulation),
            simulation,
            inbox,
            latest: latest.clone(),
            sequence: 0,
            last_frame: Instant::now(),
            stale: false,
            wake,
        };
        std::thread::Builder::new().name("simulation".into()).spawn(move || {
            thread.run();
            drop(end);
        })?;
        Ok(Session { commands, latest, ended })
    }

    /// The latest frame. Costs a lock that is only ever held for the swap of a pointer.
    pub fn frame(&self) -> Arc<Frame> {
        self.latest.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Queues a command; it is carried out between two steps. After the thread has ended it goes nowhere.
    pub fn send(&self, command: Command) {
        // The only way to fail is that the thread has ended, which the faults it published have told already.
        let _ = self.commands.send(command);
    }
}

impl Drop for Session {
    /// Ends the thread. Waits for what was asked before (a file being saved), but not for a step that takes for ever.
    fn drop(&mut self) {
        self.send(Command::Quit);
        // Both outcomes are an end: the thread is gone, or it is left to the end of the process.
        let _ = self.ended.recv_timeout(FAREWELL);
    }
}

struct Thread<W: Fn()> {
    simulation: Simulation,
    inbox: Receiver<Command>,
    latest: Arc<Mutex<Arc<Frame>>>,
    pace: Pace,
    sequence: u64,
    last_frame: Instant,
    /// Whether something changed since the last frame.
    stale: bool,
    wake: W,
}

impl<W: Fn()> Thread<W> {
    fn run(mut self) {
        while let Ok(commands) = self.wait() {
            let asked = !commands.is_empty();
            for command in coalesce(commands) {
                if matches!(command, Command::Quit) {
                    return;
                }
                self.simulation.apply(command);
            }
            if asked {
                self.pace.retune(Instant::now(), &self.simulation);
            }
            let due = self.simulation.running() && self.pace.due() <= Instant::now();
            if due {
                self.simulation.step();
                self.pace.stepped(Instant::now(), &self.simulation);
            }
            self.stale |= asked || due;
            if self.stale && (!self.simulation.running() || self.last_frame.elapsed() >= FRAME_INTERVAL) {
                self.publish();
            }
        }
    }

    /// Waits for commands, or until the next step or frame is due; all commands that are there. Fails when nobody can send any
    /// more.
    fn wait(&self) -> Result<Vec<Command>, RecvTimeoutError> {
        let first = if self.simulation.running() {
            let frame_due = self.last_frame + FRAME_INTERVAL;
            let until = if self.stale { self.pace.due().min(frame_due) } else { self.pace.due() };
            match self.inbox.recv_timeout(until.saturating_duration_since(Instant::now())) {
                Err(RecvTimeoutError::Timeout) => return Ok(Vec::new()),
                first => first?,
            }
        } else {
            self.inbox.recv().map_err(|_| RecvTimeoutError::Disconnected)?
        };
        Ok(std::iter::once(first).chain(self.inbox.try_iter()).collect())
    }

    fn publish(&mut self) {
        self.sequence += 1;
        self.stale = false;
        self.last_frame = Instant::now();
        let frame = self.simulation.publish(self.sequence, self.pace.achieved);
        let old = std::mem::replace(&mut *self.latest.lock().unwrap_or_else(PoisonError::into_inner), frame);
        // Freed here, outside the lock: a large world takes a moment.
        drop(old);
        (self.wake)();
    }
}

/// Of several moves of the hold in a row only the last one counts.
fn coalesce(commands: Vec<Command>) -> impl Iterator<Item = Command> {
    let mut commands = commands.into_iter().peekable();
    std::iter::from_fn(move || {
        let mut command = commands.next()?;
        while let (Command::MoveGrip(_), Some(Command::MoveGrip(_))) = (&command, commands.peek()) {
            command = commands.next()?;
        }
        Some(command)
    })
}

/// When the next step is due, and how fast the last ones were.
struct Pace {
    due: Instant,
    running: bool,
    /// Wanted speed for which `due` was set.
    speed: f64,
    window_start: Instant,
    window_time: f64,
    /// Simulated seconds a second over the last window; what is wanted before the first has passed.
    achieved: f64,
}

impl Pace {
    fn new(now: Instant, simulation: &Simulation) -> Pace {
        Pace {
            due: now,
            running: simulation.running(),
            speed: simulation.speed(),
            window_start: now,
            window_time: simulation.time(),
            achieved: simulation.speed(),
        }
    }

    /// When the next step is due.
    fn due(&self) -> Instant {
        self.due
    }

    /// Starts anew if the run was started or its speed changed.
    fn retune(&mut self, now: Instant, simulation: &Simulation) {
        if self.running != simulation.running()
            || self.speed != simulation.speed()
            || simulation.time() < self.window_time
        {
            *self = Pace::new(now, simulation);
        }
    }

    /// Sets the time of the next step after one was taken.
    fn stepped(&mut self, now: Instant, simulation: &Simulation) {
        let interval = Duration::from_secs_f64(simulation.step_seconds() / simulation.speed());
        self.due = (self.due + interval).max(now.checked_sub(MOST_LAG).unwrap_or(now));
        self.running = simulation.running();
        let elapsed = now.saturating_duration_since(self.window_start);
        if elapsed >= SPEED_WINDOW {
            self.achieved = (simulation.time() - self.window_time) / elapsed.as_secs_f64();
            (self.window_start, self.window_time) = (now, simulation.time());
        }
    }
}
