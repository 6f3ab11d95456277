//! Which method carries an island through a step, and what takes its place where it fails.
//!
//! By hand it is the chosen one. By accuracy it is the cheapest that keeps it, found by trying: in a contest the method in use and all
//! others that could be cheaper by what the motion asks of them at least (its fastest swing and turn) carry the island through the same
//! step, each until it has cost as much as the best before it. Contests come after 2, 4, 8, … 64 steps, at once where a method fails,
//! does not keep the accuracy or costs much more than it did, and not so often that they themselves cost much. What they find is kept with the world, so that a fresh stepper goes on alike.
//!
//! Where no method keeps the accuracy within the work that a step may cost, the best result is taken, and the outcome
//! says so. What was best goes on, with half the work after each such contest, down to an eighth, and contests become
//! rare: trying in vain is not what time is for. Where none of them gets to the end of the step at all, coarser
//! accuracies are tried: those hold where finer ones break.

use super::System;
use super::accelerations::Rates;
use super::forest::Forest;
use super::work::Work;
use crate::engine::constraint::Foresight;
use crate::engine::integrate::BUDGET;
use crate::engine::integrate::energy_momentum::EnergyMomentum;
use crate::engine::integrate::nystrom::Nystrom;
use crate::engine::integrate::outcome::Outcome;
use crate::engine::integrate::radau::{Member, Radau, Task};
use crate::engine::integrate::rattle::Rattle;
use crate::engine::integrate::rattle_turning::RattleTurning;
use crate::engine::integrate::runge_kutta::{self, RungeKutta};
use crate::engine::integrate::taylor::Taylor;
use crate::engine::method::{Integrator, LinearSolver};
use crate::engine::plan::{Carrier, IslandPlan};
use crate::engine::world::World;
use glam::DVec2;

/// Steps of the world between two contests, at most.
const RAREST: u32 = 64;
/// Steps of the world for which an island that no method can carry is left to the substeps, at most, before it is tried again:
/// trying costs all that a step may.
const LONGEST_WAIT: u32 = 64;
/// What a contest costs in vain is at most this part of what is spent until the next one, as far as nothing calls for it.
const SHARE: f64 = 0.15;
/// So many times the work of the last contest's best calls for one.
const GROWN: f64 = 1.5;
/// Radau's methods find the parts to begin with by trying: what they may cost more than a rival the first time.
const LEARNING: f64 = 2.0;
/// A challenger must cost less than this part of the method in use.
const WORTH: f64 = 0.9;
/// Accuracies down to which methods of order 2, 4 and 5 are tried. Those of order 4 add up errors: the stiff chain is 1.4e-8 off
/// after 5 s at 1e-8 by Nyström's, the pendulum 4e-7 after 10 s at 1e-7 by Runge and Kutta's.
const SECOND_ORDER: f64 = 3e-5;
const KUTTA: f64 = 5e-7;
const FOURTH_ORDER: f64 = 5e-8;
const FIFTH_ORDER: f64 = 1e-8;
/// Radians of the fastest swing that a step of a series takes at most.
const SERIES_SWING: f64 = 6.0;
/// Energy that a method which damps may lose in a step, in parts of what there is times the accuracy: estimates of
/// places do not see what small fast swings lose, and slow motion may live on that. At 0.15 the case
/// `fast_swing_under_slow_motion` is 0.3 of its length off at 1e-2, at 0.02 the bridge costs twice as much at 1e-5.
/// Below the second accuracy rounding is all that shows.
const ENERGY: f64 = 0.1;
const FINEST_ENERGY: f64 = 1e-7;
/// What a step may cost at most, in parts of the time that it simulates: a little more than real time, as work is only estimated.
const DEAREST: f64 = 1.0;
/// Times that this is halved where no method keeps the accuracy.
const MOST_HALVINGS: u32 = 3;
/// Where nothing can carry an island with the accuracy at all, so many times coarser ones are tried in turn, up to
/// the coarsest.
const COARSER: f64 = 100.0;
const COARSEST: f64 = 1e-2;

/// The methods, and their scratch memory.
#[derive(Debug, Default)]
pub(crate) struct Ladder {
    taylor: Taylor,
    rattle: Rattle,
    rattle_turning: RattleTurning,
    runge_kutta: RungeKutta,
    nystrom: Nystrom,
    /// By island: they keep the order in which it is eliminated.
    own: Vec<Own>,
    /// All islands' links.
    links: f64,
    load: Vec<f64>,
    best: Result,
}

/// What belongs to one island.
#[derive(Debug)]
struct Own {
    energy_momentum: EnergyMomentum,
    radau: Radau,
    work: Work,
}

/// An island after a step.
#[derive(Debug, Default)]
struct Result {
    coordinates: [Vec<f64>; 4],
    rods: Vec<f64>,
    held: Vec<bool>,
    pins: Vec<DVec2>,
    parts: [f64; 2],
    steps: u32,
}

/// What a try may cost [ns].
#[derive(Clone, Copy, Debug)]
struct Limit {
    /// By the time that is simulated. Steps of fixed order go on to the end all the same: where they cost more than that, all else does.
    most: f64,
    /// By the best so far, which costs so much.
    rival: f64,
}

impl Limit {
    const NONE: Limit = Limit { most: f64::INFINITY, rival: f64::INFINITY };

    fn least(self) -> f64 {
        self.most.min(self.rival)
    }
}

/// A method's try.
#[derive(Clone, Copy, Debug)]
struct Try {
    integrator: Integrator,
    outcome: Outcome,
    work: f64,
    /// As in the foresight.
    coarser: f64,
}

impl Try {
    /// Whether this one is to be preferred to what was the best so far.
    fn beats(&self, best: &Try, worth: f64) -> bool {
        match (self.outcome.kept, best.outcome.kept) {
            (true, true) => self.work < worth * best.work,
            (false, false) => self.outcome.error < best.outcome.error,
            (kept, _) => kept,
        }
    }
}

impl Ladder {
    /// Forgets all islands.
    pub fn clear(&mut self) {
        self.own.clear();
        self.links = 0.0;
    }

    /// Makes room for one more island.
    pub fn add(&mut self, system: &System) {
        if system.turns() {
            // Stands in where RATTLE gives in.
            self.taylor.reserve(system);
        }
        let tree = !system.turns() && Forest::new(system).is_some();
        let work = Work::new(system, tree);
        self.links += work.links();
        self.own.push(Own { energy_momentum: EnergyMomentum::default(), radau: Radau::default(), work });
    }

    /// Carries an island through `time` [s]; says what did it.
    pub fn carry(
        &mut self,
        index: usize,
        (plan, system): (&IslandPlan, &mut System),
        world: &World,
        time: f64,
    ) -> (Integrator, Outcome) {
        system.load(world, time);
        let foresight = plan.group.constraints.first().map(|i| world.constraints.foresight[*i as usize]);
        let foresight = foresight.unwrap_or_default();
        system.foresight = foresight;
        if foresight.integrator.is_none() && foresight.due > 1 {
            system.foresight.due -= 1;
            return (Integrator::Taylor, Outcome { failed: true, ..Outcome::default() });
        }
        let (integrator, outcome) = match plan.carrier {
            Carrier::ByHand(integrator) => self.by_hand(index, (plan, system), integrator, (world, time)),
            Carrier::Cheapest if system.turns() => self.turning((plan, system), (world, time)),
            Carrier::Cheapest => self.cheapest(index, (plan, system), (world, time)),
        };
        if outcome.failed {
            let lapses = system.foresight.lapses.max(foresight.lapses + 1);
            let wait = (1u32 << (lapses - 1).min(31)).min(LONGEST_WAIT);
            system.foresight = Foresight { integrator: None, interval: wait, due: wait, lapses, ..system.foresight };
        } else if system.foresight.integrator.is_none() {
            system.foresight = Foresight { integrator: Some(integrator), interval: 0, due: 0, ..system.foresight };
        }
        (integrator, outcome)
    }

    /// The method chosen, or series for what it does not take.
    fn by_hand(
        &mut self,
        index: usize,
        (plan, system): (&IslandPlan, &mut System),
        integrator: Integrator,
        (world, time): (&World, f64),
    ) -> (Integrator, Outcome) {
        let takes = match integrator {
            Integrator::Nystrom4 | Integrator::Nystrom6 => Nystrom::takes(system),
            Integrator::Radau3 | Integrator::Radau5 => Radau::takes(system),
            Integrator::Rattle if system.turns() => return self.turning((plan, system), (world, time)),
            _ => true,
        };
        let integrator = if takes { integrator } else { Integrator::Taylor };
        (integrator, self.run(index, (plan, system), integrator, time, Limit::NONE))
    }

    /// An island whose discs anchors turn: RATTLE, or series.
    fn turning(
        &mut self,
        (plan, system): (&IslandPlan, &mut System),
        (world, time): (&World, f64),
    ) -> (Integrator, Outcome) {
        if plan.second_order() && RattleTurning::takes(system) {
            let outcome = self.rattle_turning.advance(system, time, plan.pace(system.length, plan.accuracy));
            if plan.steps.is_some() || (outcome.kept && !outcome.stiff && !outcome.failed) {
                return (Integrator::Rattle, outcome);
            }
            system.load(world, time);
        }
        (Integrator::Taylor, self.taylor.advance(system, time, plan.series_tolerance * system.length, BUDGET))
    }

    /// The cheapest method that keeps the accuracy.
    fn cheapest(
        &mut self,
        index: usize,
        (plan, system): (&IslandPlan, &mut System),
        (world, time): (&World, f64),
    ) -> (Integrator, Outcome) {
        if plan.group.constraints.is_empty() {
            // Free fall is exact with both.
            let integrator = if system.damped() { Integrator::Taylor } else { Integrator::Rattle };
            return (integrator, self.run(index, (plan, system), integrator, time, Limit::NONE));
        }
        let mut foresight = system.foresight;
        let dearest = DEAREST / f64::from(1u32 << foresight.lapses.min(MOST_HALVINGS));
        let whole = 1e9 * time * self.own[index].work.links() / self.links;
        let most = dearest * whole;
        let alone = Limit { most, ..Limit::NONE };
        let mut first = None;
        let passes = system.swing_through_zero(time) > 0.0;
        if passes {
            // Only series know of that instant; this step says nothing about others.
            let tried = self.attempt(index, (plan, system), Integrator::Taylor, time, alone);
            if tried.outcome.kept {
                system.foresight.steps = foresight.steps;
                return (Integrator::Taylor, tried.outcome);
            }
            first = Some(tried);
        } else if let Some(integrator) =
            foresight.integrator.filter(|integrator| plan.takes(*integrator, system.accuracy(plan)))
        {
            let tried = self.attempt(index, (plan, system), integrator, time, alone);
            (foresight.parts, foresight.steps) = (system.foresight.parts, system.foresight.steps);
            let will_do = !tried.outcome.failed && (tried.outcome.kept || foresight.lapses > 0);
            if will_do && foresight.due > 1 && tried.work <= GROWN * foresight.work {
                let lapses = foresight.lapses.saturating_sub(u32::from(tried.outcome.kept));
                system.foresight = Foresight { due: foresight.due - 1, lapses, ..foresight };
                return (integrator, tried.outcome);
            }
            first = Some(tried);
        }
        let (best, vain) = self.hold(index, (plan, system), (world, time), (first, passes), [most, DEAREST * whole]);
        system.foresight.coarser = best.coarser;
        let stays = foresight.integrator == Some(best.integrator) && best.outcome.kept;
        let lapses = if best.outcome.kept { 0 } else { foresight.lapses + 1 };
        let interval = if stays || lapses > 1 { 2 * foresight.interval } else { 2 };
        // The first step of all may be like no other.
        let worth = if foresight.integrator.is_some() { vain / (SHARE * best.work.max(1.0)) } else { 0.0 };
        let interval = interval.max(worth as u32).clamp(2, RAREST);
        let (integrator, work) = (Some(best.integrator), best.work);
        system.foresight = Foresight { integrator, interval, due: interval, lapses, work, ..system.foresight };
        (best.integrator, best.outcome)
    }

    /// A contest, and where nothing gets to the end of the step others with coarser accuracies, for which it may cost
    /// the second `most` [ns].
    fn hold(
        &mut self,
        index: usize,
        (plan, system): (&IslandPlan, &mut System),
        (world, time): (&World, f64),
        (first, passes): (Option<Try>, bool),
        most: [f64; 2],
    ) -> (Try, f64) {
        // What a coarser accuracy has failed with is not tried with a finer one.
        let broken = first.filter(|first| first.outcome.failed).map_or(0.0, |first| first.coarser);
        let mut coarser = broken;
        let mut vain = first.filter(|_| broken > 0.0).map_or(0.0, |first| first.work);
        loop {
            system.foresight.coarser = coarser;
            let known = if coarser == 0.0 { first } else { None };
            let most = if coarser == 0.0 { most[0] } else { most[1] };
            let (best, spent) = self.contest(index, (plan, system), (world, time), (known, passes), most);
            vain += spent;
            coarser = COARSER * coarser.max(1.0);
            if !best.outcome.failed || plan.accuracy * coarser > COARSEST {
                return (best, vain);
            }
            vain += best.work;
        }
    }

    /// Tries all that could be cheaper than `first`, the result of which the island holds; leaves the best result in it. Returns with it
    /// the work of the others [ns]. Where a spring `passes` zero length only series are believed.
    fn contest(
        &mut self,
        index: usize,
        (plan, system): (&IslandPlan, &mut System),
        (world, time): (&World, f64),
        (first, passes): (Option<Try>, bool),
        most: f64,
    ) -> (Try, f64) {
        let outcome = Outcome { failed: true, kept: false, ..Outcome::default() };
        let failed = Try { integrator: Integrator::Taylor, outcome, work: 0.0, coarser: 0.0 };
        let mut best = first.filter(|first| !first.outcome.failed);
        let mut work = first.map_or(0.0, |first| first.work);
        if best.is_some() {
            self.best.keep(system);
        }
        let parts = system.foresight.parts;
        self.reload(system, world, time, parts);
        let rates = system.rates(&mut self.load);
        let mut least = RUNGS.map(|integrator| (self.least(index, integrator, &rates, time), integrator));
        least.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (mut untouched, mut holds_best) = (true, false);
        for (bound, integrator) in least {
            let known = first.is_some_and(|first| first.integrator == integrator);
            if known || !plan.takes(integrator, system.accuracy(plan)) || !takes(integrator, system) {
                continue;
            }
            let rival = best.filter(|best| best.outcome.kept).map_or(f64::INFINITY, |best| best.work);
            let limit = Limit { most, rival };
            if bound > limit.least() && best.is_some() {
                continue;
            }
            if !untouched {
                let parts = system.foresight.parts;
                self.reload(system, world, time, parts);
            }
            let mut tried = self.attempt(index, (plan, system), integrator, time, limit);
            tried.outcome.kept &= !passes || integrator == Integrator::Taylor;
            (untouched, holds_best) = (false, false);
            work += tried.work;
            // The one in use stays unless another one is clearly cheaper.
            let worth = if best.is_some_and(|best| first.is_some_and(|f| f.integrator == best.integrator)) {
                WORTH
            } else {
                1.0
            };
            if !tried.outcome.failed && best.is_none_or(|best| tried.beats(&best, worth)) {
                best = Some(tried);
                self.best.keep(system);
                holds_best = true;
            }
        }
        if best.is_some() && !holds_best {
            self.best.restore(system);
        }
        let best = best.unwrap_or(failed);
        (best, work - best.work)
    }

    fn reload(&self, system: &mut System, world: &World, time: f64, parts: [f64; 2]) {
        system.load(world, time);
        (system.foresight.parts, system.foresight.steps) = (parts, 0);
    }

    /// Least work of a method on a motion with these rates [ns].
    fn least(&self, index: usize, integrator: Integrator, rates: &Rates, time: f64) -> f64 {
        let own = &self.own[index];
        let steps = |most_turn: f64, most_swing: f64| {
            libm::ceil(time * (rates.turn / most_turn).max(rates.swing / most_swing)).max(1.0)
        };
        let (steps, order, solves) = match integrator {
            Integrator::Rattle => (steps(0.7, 1.8), 2.0, 0.0),
            Integrator::RungeKutta4 => (steps(runge_kutta::TURN, runge_kutta::SWING), 4.0, 0.0),
            Integrator::Nystrom4 => (steps(f64::INFINITY, 5.0), 4.0, 0.0),
            Integrator::Nystrom6 => (steps(f64::INFINITY, 9.0), 6.0, 0.0),
            Integrator::Taylor => (steps(f64::INFINITY, SERIES_SWING), 5.0, 0.0),
            Integrator::Radau3 | Integrator::Radau5 => (1.0, 5.0, 2.0),
            _ => (1.0, 2.0, 2.0),
        };
        own.work.of(integrator, steps, order, solves)
    }

    fn attempt(
        &mut self,
        index: usize,
        (plan, system): (&IslandPlan, &mut System),
        integrator: Integrator,
        time: f64,
        limit: Limit,
    ) -> Try {
        let damps = matches!(integrator, Integrator::RungeKutta4 | Integrator::Radau3 | Integrator::Radau5);
        let accuracy = system.accuracy(plan);
        let watched = damps && accuracy >= FINEST_ENERGY && system.is_conservative();
        let before = watched.then(|| system.energy(time));
        let mut outcome = self.run(index, (plan, system), integrator, time, limit);
        if let Some(before) = before.filter(|_| outcome.kept && !outcome.failed) {
            let after = system.energy(time);
            let allowed = ENERGY * accuracy * (before.scale + after.scale);
            outcome.kept = (after.total - before.total).abs() <= allowed;
        }
        system.foresight.steps = outcome.next;
        let work = self.own[index].work.done(integrator, &outcome);
        let failed = outcome.failed || outcome.stiff;
        let coarser = system.foresight.coarser;
        let kept = outcome.kept && !failed && coarser == 0.0;
        Try { integrator, outcome: Outcome { failed, kept, ..outcome }, work, coarser }
    }

    /// Runs one method, within about the limit.
    fn run(
        &mut self,
        index: usize,
        (plan, system): (&IslandPlan, &mut System),
        integrator: Integrator,
        time: f64,
        limit: Limit,
    ) -> Outcome {
        let (length, accuracy) = (system.length, system.accuracy(plan));
        let pace = plan.pace(length, accuracy);
        let own = &mut self.own[index];
        let most = |order: f64, solves: f64| {
            (limit.least() / own.work.of(integrator, 1.0, order, solves)).clamp(1.0, 4.0 * f64::from(BUDGET))
        };
        let steps = own.work.steps(integrator, limit.rival);
        match integrator {
            Integrator::Rattle => self.rattle.advance(system, time, pace, steps),
            Integrator::EnergyMomentum => {
                own.energy_momentum.advance(system, time, pace, (2.0 * most(2.0, 2.0), steps))
            }
            Integrator::RungeKutta4 => self.runge_kutta.advance(system, time, plan.kutta_pace(length, accuracy), steps),
            Integrator::Nystrom4 => self.nystrom.advance(system, time, (plan.fine_pace(length, accuracy), steps), 4),
            Integrator::Nystrom6 => self.nystrom.advance(system, time, (plan.fine_pace(length, accuracy), steps), 6),
            Integrator::Radau3 | Integrator::Radau5 => {
                let five = usize::from(integrator == Integrator::Radau5);
                let member = [Member::Three, Member::Five][five];
                let parts = Some(system.foresight.parts[five]).filter(|parts| *parts > 0.0);
                let task = Task {
                    pace: plan.whole_pace(length, accuracy),
                    member,
                    parts,
                    most: most(5.0, 3.0).min(1024.0),
                    rival: LEARNING * steps,
                };
                let (outcome, parts) = own.radau.advance(system, time, &task);
                system.foresight.parts[five] = parts;
                outcome
            }
            _ => {
                let tolerance = plan.series_tolerance * length * (accuracy / plan.accuracy);
                let order = plan.series_order();
                let budget = if limit.least().is_finite() { most(order, 0.0) as u32 } else { BUDGET };
                self.taylor.advance(system, time, tolerance, budget.max(1))
            }
        }
    }
}

/// The methods that a contest may try.
const RUNGS: [Integrator; 8] = [
    Integrator::Rattle,
    Integrator::EnergyMomentum,
    Integrator::RungeKutta4,
    Integrator::Nystrom4,
    Integrator::Nystrom6,
    Integrator::Taylor,
    Integrator::Radau3,
    Integrator::Radau5,
];

impl System {
    /// What the island is carried with: the wanted accuracy, or a coarser one where nothing could carry it with that.
    fn accuracy(&self, plan: &IslandPlan) -> f64 {
        plan.accuracy * self.foresight.coarser.max(1.0)
    }
}

/// Whether a method takes an island as it is now, with the mouse's hold.
fn takes(integrator: Integrator, system: &System) -> bool {
    !matches!(integrator, Integrator::Nystrom4 | Integrator::Nystrom6) || Nystrom::takes(system)
}

impl IslandPlan {
    /// Whether a contest may try a method: by its order, and by what it takes.
    pub fn takes(&self, integrator: Integrator, accuracy: f64) -> bool {
        // Others do not solve for the multipliers by themselves, and a solver was chosen.
        let chosen = self.linear.0 != LinearSolver::SparseLdl;
        if chosen && !matches!(integrator, Integrator::Rattle | Integrator::RungeKutta4 | Integrator::Taylor) {
            return false;
        }
        match integrator {
            // Ropes that tighten and slacken need events.
            Integrator::Rattle | Integrator::EnergyMomentum => accuracy >= SECOND_ORDER && !self.ropes,
            Integrator::RungeKutta4 => accuracy >= KUTTA && !self.ropes,
            Integrator::Nystrom4 => accuracy >= FOURTH_ORDER && self.springs,
            Integrator::Nystrom6 => self.springs,
            Integrator::Radau3 => accuracy >= FIFTH_ORDER,
            Integrator::Taylor | Integrator::Radau5 => true,
            _ => false,
        }
    }
}

impl Result {
    fn keep(&mut self, system: &System) {
        let nodes = &system.nodes;
        for (to, from) in self.coordinates.iter_mut().zip([&nodes.x, &nodes.y, &nodes.vx, &nodes.vy]) {
            to.clone_from(from);
        }
        self.rods.clone_from(&system.rods.lambda);
        self.held.clone_from(&system.rods.held);
        self.pins.clone_from(&system.pins.lambda);
        (self.parts, self.steps) = (system.foresight.parts, system.foresight.steps);
    }

    fn restore(&self, system: &mut System) {
        for (to, from) in system.nodes.coordinates().into_iter().zip(&self.coordinates) {
            to.copy_from_slice(from);
        }
        system.rods.lambda.copy_from_slice(&self.rods);
        system.rods.held.copy_from_slice(&self.held);
        system.pins.lambda.copy_from_slice(&self.pins);
        system.foresight.steps = self.steps;
        // What was learnt since is not forgotten.
        let learnt = system.foresight.parts;
        system.foresight.parts = std::array::from_fn(|i| if learnt[i] > 0.0 { learnt[i] } else { self.parts[i] });
    }
}
