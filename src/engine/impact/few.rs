//! The group's way through a step, event by event.

use super::collide::Collisions;
use super::cone::Cone;
use super::path::Path;
use super::record::Records;
use super::rest::{Forces, Held, STICKS, Surroundings, settle};
use super::rolling::{Curve, Frame, Rolling};
use super::surfaces::{Surfaces, TooDeep};
use super::touch::Touch;
use crate::engine::body::NO_ROTOR;
use crate::engine::error::{LARGEST_COORDINATE, LARGEST_SPEED};
use crate::engine::plan::FewPlan;
use crate::engine::report::StepReport;
use crate::engine::world::{Touching, World};

/// A rebound that lasts no longer than this part of a step ends in rest: some 3 pm high at 60 Hz. Smaller costs more bounces on the way there.
const NO_TIME: f64 = 1e-4;
/// After so many events, and so many more for each body, such a rebound may last twice as long, up to so many doublings.
const PATIENCE: [usize; 2] = [32, 4];
const DOUBLINGS: usize = 8;
/// Most events of a step, and so many more for each body: what has more does not run in real time.
const MOST_EVENTS: [usize; 2] = [300, 20];
/// Contacts that act at once; their direct solve costs the cube.
const MOST_AT_ONCE: usize = 96;

/// Finest tolerance of motion under changing forces, in parts of the smallest radius: its meetings with others are found with this error, by
/// steps that shrink with the cube root.
const FINEST: f64 = 1e-8;
/// Part of a step from which on a path under changing forces is fitted at both ends.
const FITTED: f64 = 1e-3;

/// Most of those paths in a step; their cost is that of a dozen solves each.
const MOST_CURVES: u32 = 64;

/// What ends a body's present path.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Next {
    Nothing,
    Body(usize),
    Wall,
    /// A contact that lasts changes.
    Change,
}

/// Free bodies that can touch, carried exactly, and the scratch memory for it.
#[derive(Debug, Default)]
pub(crate) struct Few {
    surfaces: Surfaces,
    paths: Vec<Path>,
    /// Paths told from the time of the event in work.
    here: Vec<Path>,
    /// Where bodies under changing forces will be.
    ahead: Vec<Path>,
    /// The next event of each body, and when [s].
    next: Vec<(f64, Next)>,
    held: Vec<Held>,
    records: Records,
    collisions: Collisions,
    cone: Cone,
    /// Bodies that hang together with the event in work, ascending, and a flag for each body.
    group: Vec<usize>,
    in_group: Vec<bool>,
    /// The body's next event is to be looked for.
    stale: Vec<bool>,
    touches: Vec<Touch>,
    resting: Vec<Touch>,
    rolling: Rolling,
    /// Bodies whose forces change all the time, and memory of those that were.
    curves: Vec<Curve>,
    spare: Vec<Curve>,
    /// Error allowed for those in a step [m].
    tolerance: f64,
    /// Length of the step [s].
    end: f64,
    events: usize,
    /// Paths under changing forces, since the start of the step.
    rolls: u32,
}

/// The group cannot be carried through this step.
struct Lost;

impl From<TooDeep> for Lost {
    fn from(_: TooDeep) -> Lost {
        Lost
    }
}

impl Few {
    /// Makes the group anew.
    pub fn build(&mut self, world: &World, plan: &FewPlan) {
        self.surfaces.build(world, &plan.bodies);
        self.tolerance = plan.tolerance.max(FINEST) * self.surfaces.least_radius();
    }

    /// Carries the group through `time` [s] without touching the world; `false` if it cannot be.
    pub fn advance(&mut self, world: &World, time: f64, report: &mut StepReport) -> bool {
        self.load(world, time);
        let carried = self.run(world).is_ok() && self.in_range();
        if carried {
            report.impacts += self.collisions.bounces;
            report.events += self.events as u32;
        }
        carried
    }

    fn load(&mut self, world: &World, time: f64) {
        let bodies = &world.bodies;
        self.end = time;
        self.events = 0;
        self.rolls = 0;
        self.collisions.bounces = 0;
        self.cone.forget_work();
        self.paths.clear();
        for (place, body) in self.surfaces.body.iter().enumerate() {
            let spin = bodies.spin(*body as usize).unwrap_or_default();
            let moves = self.surfaces.is_dynamic(place);
            self.paths.push(Path {
                position: bodies.position[*body as usize],
                velocity: if moves { bodies.velocity[*body as usize] } else { Default::default() },
                drive: if moves { world.gravity } else { Default::default() },
                angle: spin.angle,
                omega: if moves { spin.omega } else { 0.0 },
                ..Path::default()
            });
        }
        self.paths.push(Path::default());
        self.next.clear();
        self.next.resize(self.surfaces.len(), (f64::INFINITY, Next::Nothing));
        self.in_group.clear();
        self.in_group.resize(self.surfaces.len(), false);
        self.stale.clear();
        self.stale.resize(self.surfaces.len(), false);
        self.held.clear();
        self.spare.append(&mut self.curves);
        self.records.clear();
    }

    /// All events of the step.
    fn run(&mut self, world: &World) -> Result<(), Lost> {
        self.set_here(world, 0.0)?;
        for place in 0..self.surfaces.len() {
            // A group marks its bodies, so that each is met once.
            if self.surfaces.is_dynamic(place) && !self.stale[place] {
                self.process(world, 0.0, [Some(place), None])?;
                self.group.iter().for_each(|place| self.stale[*place] = true);
            }
        }
        self.predict_stale(world, 0.0);
        loop {
            let first = |found: Option<usize>, place: usize| match found {
                Some(found) if self.next[found].0 <= self.next[place].0 => Some(found),
                _ => Some(place),
            };
            let Some(place) = (0..self.next.len()).fold(None, first) else { break };
            let (time, next) = self.next[place];
            if time >= self.end {
                break;
            }
            self.events += 1;
            if self.events > MOST_EVENTS[0] + MOST_EVENTS[1] * self.surfaces.len() {
                return Err(Lost);
            }
            self.set_here(world, time)?;
            self.process(world, time, [Some(place), if let Next::Body(other) = next { Some(other) } else { None }])?;
            self.mark_stale();
            self.predict_stale(world, time);
        }
        self.set_here(world, self.end)?;
        self.paths.clone_from(&self.here);
        self.in_group.fill(true);
        self.release(self.end);
        Ok(())
    }

    fn set_here(&mut self, world: &World, time: f64) -> Result<(), Lost> {
        let Few { surfaces, paths, here, curves, rolling, cone, .. } = self;
        here.clear();
        here.extend(paths.iter().map(|path| path.at(time, surfaces.drag)));
        let frame = Frame { world, masses: &surfaces.masses, drag: surfaces.drag };
        if curves.iter().all(|curve| rolling.evaluate(curve, time, &frame, cone, here)) { Ok(()) } else { Err(Lost) }
    }

    /// Relative speed below which what touches stays [m/s]: a rebound in the pull of gravity lasts 2 v/g.
    fn rest_speed(&self, world: &World) -> f64 {
        let patience = PATIENCE[0] + PATIENCE[1] * self.surfaces.len();
        let doublings = (self.events / patience).min(DOUBLINGS);
        0.5 * world.gravity.length() * NO_TIME * self.end * f64::from(1u32 << doublings)
    }

    /// Bounces and forces of all that hangs together with the `seeds` at `time`; their paths then go on from there.
    fn process(&mut self, world: &World, time: f64, seeds: [Option<usize>; 2]) -> Result<(), Lost> {
        self.gather(world, seeds)?;
        self.release(time);
        self.group.iter().for_each(|place| self.paths[*place] = self.here[*place]);
        let rest = self.rest_speed(world);
        self.collisions.rest = rest;
        let masses = &self.surfaces.masses;
        if !self.touches.is_empty()
            && !self.collisions.resolve(&mut self.touches, &mut self.cone, masses, &mut self.paths)
        {
            return Err(Lost);
        }
        let surroundings = Surroundings { gravity: world.gravity, rest };
        let scratch = (&mut self.cone, &mut self.resting);
        let of_group = (&self.group[..], &self.touches[..]);
        match settle(of_group, &surroundings, scratch, masses, &mut self.paths, &mut self.held) {
            Forces::Unknown => return Err(Lost),
            Forces::Changing => self.roll(world, time)?,
            Forces::Constant => {}
        }
        self.group.iter().for_each(|place| self.here[*place] = self.paths[*place]);
        for touch in &self.touches {
            if touch.impulse[0] != 0.0 {
                self.records.add(touch, self.surfaces.body[touch.a], touch.impulse);
            }
        }
        Ok(())
    }

    /// Takes the group on under forces that change all the time.
    fn roll(&mut self, world: &World, time: f64) -> Result<(), Lost> {
        let Few { surfaces, paths, ahead, rolling, cone, .. } = self;
        let frame = Frame { world, masses: &surfaces.masses, drag: surfaces.drag };
        self.rolls += 1;
        if self.rolls > MOST_CURVES {
            return Err(Lost);
        }
        let mut curve = self.spare.pop().unwrap_or_default();
        curve.begin(time, &self.group, paths, &self.resting, cone);
        ahead.clone_from(paths);
        if !rolling.plan(&mut curve, self.end, self.tolerance, &frame, cone, paths)
            || !rolling.evaluate(&curve, curve.until, &frame, cone, ahead)
        {
            self.spare.push(curve);
            return Err(Lost);
        }
        let lasts = curve.until - time;
        if lasts > FITTED * self.end {
            // For meetings with others: the parabola through both ends, off by the third order on the way.
            let weights = surfaces.drag.weights(lasts);
            for place in &curve.bodies {
                let path = &mut paths[*place];
                path.drive = (ahead[*place].position - path.position - weights.first * path.velocity) / weights.second;
            }
        }
        self.curves.push(curve);
        Ok(())
    }

    /// The bodies that touch the seeds, one through another, and all their contacts: with bodies, then with walls.
    fn gather(&mut self, world: &World, seeds: [Option<usize>; 2]) -> Result<(), Lost> {
        self.group.clear();
        self.touches.clear();
        let mut member = std::mem::take(&mut self.in_group);
        member.fill(false);
        for seed in seeds.into_iter().flatten().filter(|seed| self.surfaces.is_dynamic(*seed)) {
            if !std::mem::replace(&mut member[seed], true) {
                self.group.push(seed);
            }
        }
        let mut looked_at = 0;
        let mut found = Ok(());
        while looked_at < self.group.len() && found.is_ok() {
            let (i, surfaces, group) = (self.group[looked_at], &self.surfaces, &mut self.group);
            looked_at += 1;
            let mut join = |j: usize| {
                if j < surfaces.len() && surfaces.is_dynamic(j) && !std::mem::replace(&mut member[j], true) {
                    group.push(j);
                }
            };
            found = surfaces.touching(i, &self.here, &mut join);
            for held in self.held.iter().filter(|held| held.touch.a == i || held.touch.b == i) {
                join(held.touch.a);
                join(held.touch.b);
            }
            for curve in self.curves.iter().filter(|curve| curve.bodies.contains(&i)) {
                curve.bodies.iter().for_each(|place| join(*place));
            }
        }
        self.in_group = member;
        found?;
        self.group.sort_unstable();
        let (surfaces, here, touches) = (&self.surfaces, &self.here, &mut self.touches);
        for i in &self.group {
            surfaces.touching(*i, here, |j| {
                if *i < j || !surfaces.is_dynamic(j) {
                    touches.push(surfaces.touch_of(world, *i, j, here));
                }
            })?;
        }
        for i in &self.group {
            surfaces.touch_walls(world, *i, here, touches)?;
        }
        if self.touches.len() > MOST_AT_ONCE { Err(Lost) } else { Ok(()) }
    }

    /// Ends the contacts of the group that lasted until `time`.
    fn release(&mut self, time: f64) {
        let Few { held, in_group, records, surfaces, curves, spare, .. } = self;
        while let Some(place) = curves.iter().position(|curve| in_group[curve.bodies[0]]) {
            spare.push(curves.swap_remove(place));
        }
        let of_group = |place: usize| in_group.get(place).is_some_and(|within| *within);
        held.retain(|one| {
            let ends = of_group(one.touch.a) || of_group(one.touch.b);
            if ends {
                let lasted = time - one.since;
                let impulse = [one.force[0] * lasted, one.force[1] * lasted];
                records.add(&one.touch, surfaces.body[one.touch.a], impulse);
            }
            !ends
        });
    }

    /// Marks the group and all that was to meet one of it.
    fn mark_stale(&mut self) {
        for place in 0..self.surfaces.len() {
            let orphan = matches!(self.next[place].1, Next::Body(other) if self.in_group[other]);
            if self.in_group[place] || orphan {
                self.stale[place] = true;
                self.next[place] = (f64::INFINITY, Next::Nothing);
            }
        }
    }

    fn predict_stale(&mut self, world: &World, time: f64) {
        for place in 0..self.surfaces.len() {
            if std::mem::take(&mut self.stale[place]) {
                self.predict(world, place, time);
            }
        }
    }

    /// The next event of a body, seen from `time`; earlier than another's own, it is that one's too.
    fn predict(&mut self, world: &World, i: usize, time: f64) {
        if !self.surfaces.is_dynamic(i) {
            return;
        }
        let (left, still) = (self.end - time, STICKS * self.rest_speed(world));
        let lasts =
            |held: &[Held], i: usize, with: Touching| held.iter().any(|one| one.touch.a == i && one.touch.with == with);
        let mut best = self.next[i];
        let mut keep = |found: f64, what: Next| {
            if time + found < best.0 {
                best = (time + found, what);
            }
        };
        for j in 0..self.surfaces.len() {
            let (a, b) = (i.min(j), i.max(j));
            if let Some(found) = self.surfaces.meets(i, j, &self.here, left, still)
                && !lasts(&self.held, a, Touching::Body(self.surfaces.body[b]))
            {
                keep(found, Next::Body(j));
                if self.surfaces.is_dynamic(j) && time + found < self.next[j].0 {
                    self.next[j] = (time + found, Next::Body(i));
                }
            }
        }
        for wall in 0..world.walls.len() {
            if !lasts(&self.held, i, Touching::Wall(wall as u32))
                && let Some(found) = self.surfaces.meets_wall(world, i, wall, &self.here, left, still)
            {
                keep(found, Next::Wall);
            }
        }
        for curve in self.curves.iter().filter(|curve| curve.bodies[0] == i) {
            keep(curve.until - time, Next::Change);
        }
        for held in self.held.iter().filter(|held| held.touch.a == i && !held.curved) {
            if let Some(found) = self.surfaces.changes(&held.touch, held.slides, &self.here, left, still) {
                keep(found, Next::Change);
            }
        }
        self.next[i] = best;
    }

    /// Whether all bodies are where numbers mean something.
    fn in_range(&self) -> bool {
        // Written so that a NaN is out of range.
        self.paths.iter().all(|path| {
            path.position.x.abs() <= LARGEST_COORDINATE
                && path.position.y.abs() <= LARGEST_COORDINATE
                && path.velocity.x.abs() <= LARGEST_SPEED
                && path.velocity.y.abs() <= LARGEST_SPEED
                && path.omega.abs() <= LARGEST_SPEED
                && path.angle.abs() <= LARGEST_SPEED * LARGEST_COORDINATE
        })
    }

    /// Writes the group and its contacts to the world.
    pub fn store(&mut self, world: &mut World) {
        let bodies = &mut world.bodies;
        for (place, body) in self.surfaces.body.iter().enumerate().filter(|(place, _)| self.surfaces.is_dynamic(*place))
        {
            let (i, path) = (*body as usize, &self.paths[place]);
            bodies.position[i] = path.position;
            bodies.velocity[i] = path.velocity;
            let rotor = bodies.rotor[i];
            if rotor != NO_ROTOR {
                bodies.rotors.angle[rotor as usize] = path.angle;
                bodies.rotors.omega[rotor as usize] = path.omega;
            }
        }
        self.records.store(world, self.end);
    }
}
