//! The truth beside the simulation: known, or computed as exactly as the engine can and checked against a coarser run.

use super::report::{Report, Standing};
use super::separation::{Gap, Separation};
use super::{Beginning, Extent, Follower, Input, Pose};
use crate::app::error::Lost;
use crate::engine::{EngineError, Id, Integrator, LinearSolver, Method, Solver, StepReport, World};
use crate::measure::Growth;
use crate::truth::Trajectory;
use std::sync::Arc;

/// Distance of the two runs, in parts of the scene's length, from which there is no reference any more. Where neighbouring
/// motions part as fast as they do then, neither run says anything about the next second.
pub const PARTED: f64 = 1e-3;

/// Substeps of what can touch in the finer run, at least; the coarser one takes half as many. Beyond it the solver's own
/// iterations are what is left of the error.
const SUBSTEPS: u32 = 32;

/// By which part the coarser run is disturbed at its start: some roundings, far less than its accuracy.
const DISTURBANCE: f64 = 1e-14;

/// A known motion is over when a step ends later than its last sample by more than this [s].
const SAME_TIME: f64 = 1e-9;

/// The most accurate method for a scene that is stepped with `method`, and one that is coarser.
pub fn reference_methods(method: &Method) -> [Method; 2] {
    let substeps = method.substeps.saturating_mul(4).clamp(SUBSTEPS, 1000);
    let fine = Method {
        hz: method.hz,
        substeps,
        iterations: method.iterations.clamp(50, 100_000),
        integrator: Integrator::VelocityVerlet,
        solver: Solver::Pgs,
        warm_start: true,
        automatic: true,
        linear: LinearSolver::SparseLdl,
        accuracy: 1e-13,
        ..Method::default()
    };
    [fine, Method { substeps: substeps / 2, accuracy: 1e-11, ..fine }]
}

/// Follows a simulation with the truth.
pub(super) struct Reference {
    beginning: Box<Beginning>,
    extent: Extent,
    length: f64,
    /// Steps followed since the beginning, and the rates from which step on [Hz].
    steps: u64,
    rates: Vec<(u64, f64)>,
    source: Source,
    separation: Separation,
    /// How the motion itself treats errors.
    growth: Growth,
    /// Step and time of the simulation that was reached last.
    tick: u64,
    time: f64,
    since: f64,
}

/// Bodies of a scene by accuracy of which it is watched without a truth how errors grow: it may cost ten times the
/// run, and nobody asked.
const MOST_UNASKED: usize = 200;

enum Source {
    Known(Trajectory),
    Computed(Box<Pair>),
    Parted { after: f64, chaotic: bool },
    Over { after: f64, touched: bool },
}

/// A run and a coarser one.
struct Pair {
    fine: Follower,
    coarse: Follower,
    /// Largest root mean square of their distance so far [m].
    apart: f64,
    /// Some step went through substeps, whose error nothing bounds.
    by_substeps: bool,
}

impl Reference {
    /// # Errors
    /// If no run can be begun.
    pub fn new(beginning: Box<Beginning>, extent: Extent) -> Result<Reference, Lost> {
        let known = beginning.untouched.then(|| beginning.start.known_motion()).flatten();
        let source = match known {
            Some(known) => Source::Known(known),
            None if extent == Extent::Computed => Source::Computed(Box::new(Pair::new(&beginning)?)),
            None => Source::Over { after: beginning.world.time(), touched: true },
        };
        let (tick, time) = (beginning.world.tick(), beginning.world.time());
        let (method, length) = (Method { hz: beginning.hz, ..beginning.start.method }, beginning.length());
        let mut reference = Reference {
            extent,
            length,
            growth: Growth::new(&beginning.world, &method, length)?,
            rates: vec![(0, beginning.hz)],
            steps: 0,
            source,
            separation: Separation::default(),
            tick,
            time,
            since: 0.0,
            beginning,
        };
        reference.since = if matches!(reference.source, Source::Known(_)) { 0.0 } else { time };
        let here = Pose::of(&reference.beginning.world);
        reference.compare(&here);
        Ok(reference)
    }

    /// Carries out an input. What is known of the motion ends there: it is computed from the beginning on.
    pub fn input(&mut self, input: &Input, goes_on: &dyn Fn() -> bool) -> Result<(), Lost> {
        if let Input::Rate(hz) = input {
            self.rates.push((self.steps, *hz));
            self.growth.set_rate(*hz)?;
        } else {
            self.growth.change(|world| input.apply(world).is_ok());
        }
        if input.touches() && matches!(self.source, Source::Known(_)) {
            self.leave_known(true, goes_on)?;
        }
        match &mut self.source {
            Source::Computed(pair) => pair.apply(input),
            Source::Known(_) | Source::Parted { .. } | Source::Over { .. } => Ok(()),
        }
    }

    /// What is known ends here: goes on computing, if it is to.
    fn leave_known(&mut self, touched: bool, goes_on: &dyn Fn() -> bool) -> Result<(), Lost> {
        if self.extent == Extent::Computed {
            return self.compute(goes_on);
        }
        self.source = Source::Over { after: self.time, touched };
        Ok(())
    }

    /// Goes as far as `extent` from now on. One that had ended begins anew where the simulation is.
    pub fn set_extent(&mut self, extent: Extent, beginning: Box<Beginning>) -> Result<(), Lost> {
        match (&self.source, extent) {
            (Source::Over { .. }, Extent::Computed) => *self = Reference::new(beginning, extent)?,
            (Source::Computed(_) | Source::Parted { .. }, Extent::Known) => {
                self.source = Source::Over { after: self.time, touched: !self.beginning.untouched };
            }
            _ => {}
        }
        self.extent = extent;
        Ok(())
    }

    /// Follows a step, after which the simulation is `here`. A new distance, if there is one.
    pub fn step(&mut self, here: &Pose, goes_on: &dyn Fn() -> bool) -> Result<Option<Gap>, Lost> {
        self.steps += 1;
        (self.tick, self.time) = (here.tick, here.time);
        let small = here.position.len() <= MOST_UNASKED && self.beginning.start.method.automatic;
        if small || matches!(self.source, Source::Known(_) | Source::Computed(_)) {
            // It may cost as much as ten steps of every body.
            self.growth.step(&StepReport { bodies: here.position.len(), ..StepReport::default() });
        }
        let is_over = |known: &Trajectory| known.times.last().is_none_or(|end| here.time > end + SAME_TIME);
        match &mut self.source {
            Source::Known(known) if is_over(known) => self.leave_known(false, goes_on)?,
            Source::Computed(pair) => pair.step()?,
            Source::Known(_) | Source::Parted { .. } | Source::Over { .. } => {}
        }
        self.judge();
        Ok(self.compare(here))
    }

    /// Runs from the beginning to where the simulation is now, without inputs: none has come so far but changes of the rate.
    fn compute(&mut self, goes_on: &dyn Fn() -> bool) -> Result<(), Lost> {
        let mut pair = Pair::new(&self.beginning)?;
        let mut rates = self.rates.iter().peekable();
        for step in 0..self.steps {
            while let Some((_, hz)) = rates.next_if(|(from, _)| *from <= step) {
                pair.apply(&Input::Rate(*hz))?;
            }
            if !goes_on() {
                return Err(Lost::Left);
            }
            pair.step()?;
        }
        for (_, hz) in rates {
            pair.apply(&Input::Rate(*hz))?;
        }
        self.since = self.beginning.world.time();
        self.source = Source::Computed(Box::new(pair));
        self.judge();
        Ok(())
    }

    /// Gives the reference up where the two runs have parted.
    fn judge(&mut self) {
        if let Source::Computed(pair) = &self.source
            && !(pair.apart <= PARTED * self.length)
        {
            self.source = Source::Parted { after: self.time, chaotic: !pair.by_substeps };
        }
    }

    fn compare(&mut self, here: &Pose) -> Option<Gap> {
        let (there, uncertainty, ids): (Pose, f64, &[Id]) = match &self.source {
            Source::Known(known) => {
                let there = Pose { position: known.sample_at(here.time)?.to_vec(), ..Pose::default() };
                (there, known.agreement * known.length, &self.beginning.world.bodies().id)
            }
            Source::Computed(pair) => (Pose::of(pair.fine.world()), pair.apart, &pair.fine.world().bodies().id),
            Source::Parted { .. } | Source::Over { .. } => return None,
        };
        self.separation.compare(ids, here, &there, self.length, uncertainty);
        self.separation.gap
    }

    /// What there is to tell.
    pub fn report(&self, generation: u64) -> Report {
        let standing = match &self.source {
            Source::Known(known) => Standing::Exact { error: known.agreement },
            Source::Computed(pair) => Standing::Converged { to: pair.apart / self.length },
            Source::Parted { after, chaotic } => Standing::Parted { after: *after, chaotic: *chaotic },
            Source::Over { after, touched } => Standing::Over { after: *after, touched: *touched },
        };
        let ended = matches!(standing, Standing::Parted { .. } | Standing::Over { .. });
        Report {
            generation,
            tick: self.tick,
            time: self.time,
            since: self.since,
            standing,
            length: self.length,
            gap: self.separation.gap.filter(|_| !ended),
            so_far: self.separation.so_far(),
            parting: self.separation.parting,
            growth: self.growth.fold(),
            offsets: if ended { Arc::default() } else { self.separation.offsets.clone() },
            frame: None,
        }
    }
}

/// The same world with its velocities and gravity larger by [`DISTURBANCE`]. Where both methods go from impact to impact in
/// closed form they would have the same bits, whatever the motion makes of rounding; so it shows.
fn disturbed(world: &World) -> Result<World, EngineError> {
    let mut disturbed = world.clone();
    disturbed.set_gravity((1.0 + DISTURBANCE) * world.gravity())?;
    for index in (0..world.bodies().len()).filter(|index| world.is_dynamic(*index)) {
        let (id, mut body) = (world.bodies().id[index], world.bodies().get(index));
        body.velocity *= 1.0 + DISTURBANCE;
        disturbed.set_body(id, &body)?;
    }
    Ok(disturbed)
}

impl Pair {
    fn new(beginning: &Beginning) -> Result<Pair, Lost> {
        let own = Method { hz: beginning.hz, ..beginning.start.method };
        let [fine, coarse] = reference_methods(&own);
        let begin = Follower::new;
        let disturbed = disturbed(&beginning.world)?;
        Ok(Pair {
            fine: begin(beginning.world.clone(), fine)?,
            coarse: begin(disturbed, coarse)?,
            apart: 0.0,
            by_substeps: false,
        })
    }

    fn apply(&mut self, input: &Input) -> Result<(), Lost> {
        self.fine.apply(input)?;
        self.coarse.apply(input)
    }

    fn step(&mut self) -> Result<(), Lost> {
        self.fine.step()?;
        self.coarse.step()?;
        self.by_substeps |= self.fine.report().substeps > 0;
        let [fine, coarse] = [&self.fine, &self.coarse].map(|run| &run.world().bodies().position);
        let squares: f64 = fine.iter().zip(coarse).map(|(a, b)| (*a - *b).length_squared()).sum();
        self.apart = self.apart.max((squares / fine.len().max(1) as f64).sqrt());
        Ok(())
    }
}
