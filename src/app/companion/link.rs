//! The simulation's side of its companions: tells them what happens, and never waits for them.

use super::report::{Board, Companion, Companions};
use super::thread::{Message, Purpose, Thread};
use super::{Beginning, Extent, Input, Pose};
use crate::engine::{Method, World};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicIsize, AtomicU64, Ordering};
use std::sync::mpsc::{Sender, channel};

/// A companion may fall behind by what fits into this memory [bytes], within [`FEWEST_BEHIND`] and [`MOST_BEHIND`] steps.
const BEHIND_BYTES: usize = 64 << 20;
const FEWEST_BEHIND: usize = 60;
/// A minute at 60 steps a second.
const MOST_BEHIND: usize = 3_600;

/// What both sides of the queue see at once.
#[derive(Debug, Default)]
pub(super) struct Gate {
    /// Number of the beginning that counts; messages of others are of a run that was left.
    current: AtomicU64,
    /// Steps of that run in the queue; for a moment off by one where a run is left just as its last step is taken.
    waiting: AtomicIsize,
    /// The queue was full: the companion is given up until the next beginning.
    overrun: AtomicBool,
}

impl Gate {
    /// Whether `generation` is the run that counts.
    pub fn is(&self, generation: u64) -> bool {
        self.current.load(Ordering::Acquire) == generation
    }

    /// A step of the run that counts was taken out of the queue.
    pub fn taken(&self) {
        self.waiting.fetch_sub(1, Ordering::AcqRel);
    }

    pub fn is_overrun(&self) -> bool {
        self.overrun.load(Ordering::Acquire)
    }
}

/// Makes what a companion's thread calls after each report.
pub type Waker = Box<dyn Fn() -> Box<dyn Fn() + Send> + Send>;

/// One companion, held from the simulation's side. Dropping it ends its thread after the step at hand.
pub(in crate::app) struct Link {
    sender: Sender<Message>,
    board: Arc<Board>,
    gate: Arc<Gate>,
    generation: u64,
}

impl Link {
    fn start(purpose: Purpose, waker: &Waker) -> std::io::Result<Link> {
        let (sender, inbox) = channel();
        let (board, gate) = (Arc::<Board>::default(), Arc::<Gate>::default());
        let thread = Thread { purpose, inbox, board: board.clone(), gate: gate.clone(), wake: waker() };
        std::thread::Builder::new().name("companion".into()).spawn(move || thread.run())?;
        Ok(Link { sender, board, gate, generation: 0 })
    }

    fn send(&self, message: Message) {
        // The only way to fail is that the thread has ended, and it catches what could end it.
        let _ = self.sender.send(message);
    }

    fn begin(&mut self, beginning: Beginning) {
        self.generation += 1;
        self.gate.overrun.store(false, Ordering::Release);
        self.gate.waiting.store(0, Ordering::Release);
        self.gate.current.store(self.generation, Ordering::Release);
        self.send(Message::Begin(self.generation, Box::new(beginning)));
    }

    fn step(&self, here: &Arc<Pose>) {
        let bytes = size_of_val(&here.position[..]) + size_of_val(&here.angle[..]);
        let most = (BEHIND_BYTES / bytes.max(1)).clamp(FEWEST_BEHIND, MOST_BEHIND);
        if self.gate.is_overrun() {
            return;
        }
        if self.gate.waiting.fetch_add(1, Ordering::AcqRel) >= most as isize {
            self.gate.overrun.store(true, Ordering::Release);
        }
        self.send(Message::Step(self.generation, here.clone()));
    }
}

impl Drop for Link {
    fn drop(&mut self) {
        // What is still in the queue is of no use to anybody.
        self.gate.current.store(u64::MAX, Ordering::Release);
    }
}

/// All companions of a simulation.
#[derive(Default)]
pub(in crate::app) struct Links {
    truth: Option<(Link, Extent)>,
    rival: Option<(Link, Method)>,
}

impl Links {
    /// Starts or ends the truth, or lets it go further or less far.
    pub fn set_truth(&mut self, extent: Option<Extent>, beginning: Beginning, waker: &Waker) -> std::io::Result<()> {
        match (extent, &mut self.truth) {
            (None, truth) => *truth = None,
            (Some(extent), Some((link, now))) => {
                if *now != extent {
                    link.send(Message::Extent(link.generation, extent, Box::new(beginning)));
                    *now = extent;
                }
            }
            (Some(extent), truth) => {
                let mut link = Link::start(Purpose::Truth(extent), waker)?;
                link.begin(beginning);
                *truth = Some((link, extent));
            }
        }
        Ok(())
    }

    /// Starts or ends the rival, or gives it another method.
    pub fn set_rival(&mut self, method: Option<Method>, beginning: Beginning, waker: &Waker) -> std::io::Result<()> {
        match (method, &mut self.rival) {
            (None, rival) => *rival = None,
            (Some(method), Some((link, now))) => {
                if *now != method {
                    link.send(Message::Method(method));
                    *now = method;
                }
            }
            (Some(method), rival) => {
                let mut link = Link::start(Purpose::Rival(method), waker)?;
                link.begin(beginning);
                *rival = Some((link, method));
            }
        }
        Ok(())
    }

    /// The simulation is elsewhere, all at once: another scene, a restart, an undo.
    pub fn begin(&mut self, beginning: &Beginning) {
        self.each(|link| link.begin(beginning.clone()));
    }

    /// Whether there is a companion at all.
    pub fn any(&self) -> bool {
        self.truth.is_some() || self.rival.is_some()
    }

    pub fn input(&mut self, input: &Input) {
        self.each(|link| link.send(Message::Input(link.generation, input.clone())));
    }

    /// The simulation took a step.
    pub fn step(&mut self, world: &World) {
        if self.any() {
            let here = Arc::new(Pose::of(world));
            self.each(|link| link.step(&here));
        }
    }

    /// The companions as a frame shows them.
    pub fn companions(&self) -> Companions {
        let companion = |link: &Link| Companion { board: link.board.clone(), generation: link.generation };
        Companions {
            truth: self.truth.as_ref().map(|(link, _)| companion(link)),
            rival: self.rival.as_ref().map(|(link, _)| companion(link)),
        }
    }

    fn each(&mut self, mut act: impl FnMut(&mut Link)) {
        self.truth.iter_mut().for_each(|(link, _)| act(link));
        self.rival.iter_mut().for_each(|(link, _)| act(link));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::companion::Standing;
    use std::sync::mpsc::channel;
    use std::sync::{Mutex, PoisonError};
    use std::time::{Duration, Instant};

    #[test]
    fn a_companion_that_falls_too_far_behind_is_given_up_and_begins_anew_after_a_restart() {
        // A wake that lasts until the test lets it end stands for a step that takes for ever.
        let (release, held) = channel::<()>();
        let held = Arc::new(Mutex::new(held));
        let waker: Waker = Box::new(move || {
            let held = held.clone();
            Box::new(move || {
                let _ = held.lock().unwrap_or_else(PoisonError::into_inner).recv();
            })
        });
        let start = Arc::new(crate::scene::open("pendulum").expect("a shipped scene"));
        let (world, hz) = (start.world.clone(), start.method.hz);
        let beginning = Beginning { world, start, scene: Arc::default(), untouched: true, hz };
        let mut links = Links::default();
        links.set_truth(Some(Extent::Computed), beginning.clone(), &waker).expect("room for a thread");
        let world = beginning.world.clone();
        (0..2 * MOST_BEHIND).for_each(|_| links.step(&world));
        let companion = links.companions().truth.expect("it was started");
        drop(release);
        let wait = |wanted: &dyn Fn(&Standing) -> bool, companion: &Companion| {
            let begin = Instant::now();
            while !wanted(&companion.report().standing) {
                assert!(begin.elapsed() < Duration::from_secs(20), "{:?}", companion.report());
                std::thread::sleep(Duration::from_millis(2));
            }
        };
        wait(&|standing| matches!(standing, Standing::Lost(why) if why.contains("keep up")), &companion);
        links.begin(&beginning);
        let companion = links.companions().truth.expect("it is still there");
        wait(&|standing| matches!(standing, Standing::Converged { .. }), &companion);
    }
}
