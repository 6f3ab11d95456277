//! The way of free bodies through a step, cluster by cluster, event by event.

use super::clusters::{Cluster, Clusters};
use super::collide::Collisions;
use super::cone::Cone;
use super::path::{Drag, Path};
use super::record::Records;
use super::rest::{Forces, Held, STICKS, Surroundings, settle};
use super::rolling::{Curve, Frame, Rolling};
use super::surfaces::{Surfaces, TooDeep};
use super::touch::Touch;
use crate::engine::body::NO_ROTOR;
use crate::engine::error::{LARGEST_COORDINATE, LARGEST_SPEED};
use crate::engine::plan::{FewPlan, Plan};
use crate::engine::report::StepReport;
use crate::engine::world::{Touching, World};
use glam::DVec2;

/// A rebound that lasts no longer than this part of a step ends in rest: some 3 pm high at 60 Hz. Smaller costs more bounces on the way there.
const NO_TIME: f64 = 1e-4;
/// After so many events, and so many more for each body, such a rebound may last twice as long, up to so many doublings.
const PATIENCE: [usize; 2] = [32, 4];
const DOUBLINGS: usize = 8;
/// Most events in a sixtieth of a second, and so many more for each body: what has more does not run in real time.
const MOST_EVENTS: [f64; 2] = [300.0, 20.0];
/// Shortest step, in sixtieths of a second, to which the limits of events and of solves shrink: a bounce that ends needs its events in any step.
const LEAST_SHARE: [f64; 2] = [0.25, 0.02];
/// Bodies of a cluster, static ones in its way among them, that are few enough to be carried: their cost a step grows with the square, and with the walls.
pub(crate) const MOST_TOGETHER: usize = 128;
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

/// Times that clusters are found in a step, each time with what was learned about how far bodies come.
const ROUNDS: u32 = 4;

/// How the clusters of a step fared.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Fared {
    /// Some that something else can reach, or that are too large.
    pub left: bool,
    /// How many could not be carried.
    pub lost: usize,
    /// Impacts and located instants of the others.
    bounces: usize,
    events: usize,
}

/// Free bodies that can touch, carried exactly, and the scratch memory for it.
#[derive(Debug, Default)]
pub(crate) struct Few {
    plan: FewPlan,
    clusters: Clusters,
    /// Bodies carried in this step, with where they are at its end, and all their contacts.
    carried: Vec<(u32, Path)>,
    told: Records,
    /// The cluster in work, by place.
    surfaces: Surfaces,
    /// Where each body began, and how far from there it came [m].
    way: Vec<(DVec2, f64)>,
    /// Bodies that left the balls in which they were expected, and those in which they were [m].
    strayed: Vec<(u32, f64)>,
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
    /// Of the cluster, and those left for the step.
    events: usize,
    events_left: f64,
    /// Paths under changing forces, since the start of the step.
    rolls: u32,
}

/// A cluster cannot be carried through this step.
struct Lost;

impl From<TooDeep> for Lost {
    fn from(_: TooDeep) -> Lost {
        Lost
    }
}

impl Few {
    /// Makes the group anew.
    pub fn build(&mut self, plan: Option<&FewPlan>) {
        self.plan = plan.cloned().unwrap_or_default();
    }

    /// Carries what it can of the group through `time` [s] without touching the world.
    pub fn advance(&mut self, world: &World, plan: &Plan, time: f64, report: &mut StepReport) -> Fared {
        let mut fared = Fared::default();
        self.carried.clear();
        self.told.clear();
        if self.plan.bodies.is_empty() {
            return fared;
        }
        let sixtieths = 60.0 * time;
        self.end = time;
        self.rolls = 0;
        self.events_left =
            (MOST_EVENTS[0] + MOST_EVENTS[1] * self.plan.bodies.len() as f64) * sixtieths.max(LEAST_SHARE[0]);
        self.cone.forget_work(sixtieths.max(LEAST_SHARE[1]));
        self.strayed.clear();
        let mut clusters = std::mem::take(&mut self.clusters);
        for round in 0..ROUNDS {
            clusters.find(world, plan, &self.plan.bodies, time, &self.strayed);
            fared = self.carry_all(world, &clusters);
            if clusters.stay_apart(world, plan, &self.strayed) {
                break;
            }
            if round + 1 == ROUNDS {
                fared.lost += 1;
                self.carried.clear();
                self.told.clear();
            }
        }
        self.clusters = clusters;
        if !self.carried.is_empty() {
            report.impacts += fared.bounces;
            report.events += fared.events as u32;
        }
        fared
    }

    fn carry_all(&mut self, world: &World, clusters: &Clusters) -> Fared {
        let mut fared = Fared::default();
        self.carried.clear();
        self.told.clear();
        for cluster in clusters.iter() {
            if cluster.near || cluster.len() > MOST_TOGETHER {
                fared.left = true;
                continue;
            }
            match self.carry(world, clusters, cluster) {
                Ok([bounces, events]) => {
                    fared.bounces += bounces;
                    fared.events += events;
                }
                Err(Lost) => fared.lost += 1,
            }
        }
        fared
    }

    /// Carries one cluster; tells its bounces and events.
    fn carry(&mut self, world: &World, clusters: &Clusters, cluster: Cluster) -> Result<[usize; 2], Lost> {
        if let Some(body) = cluster.single()
            && let Some(path) = self.alone(world, clusters, body)
        {
            self.carried.push((body, path));
            return Ok([0; 2]);
        }
        self.surfaces.build(world, cluster.bodies());
        self.tolerance = self.plan.tolerance.max(FINEST) * self.surfaces.least_radius();
        self.load(world);
        self.run(world)?;
        if !self.in_range() {
            return Err(Lost);
        }
        for place in (0..self.surfaces.len()).filter(|place| self.surfaces.is_dynamic(*place)) {
            let (body, way) = (self.surfaces.body[place], self.way[place].1);
            self.carried.push((body, self.paths[place]));
            if way > clusters.room(world, body, self.end) {
                self.strayed.push((body, Clusters::ball(world, body, way, self.end)));
            }
        }
        self.told.append(&mut self.records);
        Ok([self.collisions.bounces, self.events])
    }

    /// Where a body is at the end that reaches nothing at all, if it is one.
    fn alone(&self, world: &World, clusters: &Clusters, body: u32) -> Option<Path> {
        let path = start_of(world, body);
        let room = clusters.room(world, body, self.end);
        let reach = DVec2::splat(world.bodies.radius[body as usize] + room);
        let (low, high) = (path.position - reach, path.position + reach);
        let meets = |(min, max): (DVec2, DVec2)| min.cmple(high).all() && max.cmpge(low).all();
        if room.is_finite() && world.walls.iter().any(|wall| meets(wall.shape.bounds())) {
            return None;
        }
        Some(path.at(self.end, Drag(world.drag))).filter(in_range)
    }

    /// Begins the cluster.
    fn load(&mut self, world: &World) {
        self.events = 0;
        self.collisions.bounces = 0;
        self.paths.clear();
        self.paths.extend(self.surfaces.body.iter().map(|body| start_of(world, *body)));
        self.way.clear();
        self.way.extend(self.paths.iter().map(|path| (path.position, 0.0)));
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
            self.events_left -= 1.0;
            if self.events_left < 0.0 {
                return Err(Lost);
            }
            self.set_here(world, time)?;
            self.process(world, time, [Some(place), if let Next::Body(other) = next { Some(other) } else { None }])?;
            self.mark_stale();
            self.predict_stale(world, time);
        }
        self.set_here(world, self.end)?;
        self.paths.clone_from(&self.here);
        for (path, (start, farthest)) in self.paths.iter().zip(&mut self.way) {
            *farthest = farthest.max((path.position - *start).length());
        }
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
        for place in &self.group {
            let (start, farthest) = &mut self.way[*place];
            *farthest = farthest.max((self.here[*place].position - *start).length());
        }
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
        self.paths.iter().all(in_range)
    }

    /// Says in `flags` which bodies of the group were carried in this step.
    pub fn mark_carried(&self, flags: &mut [bool]) {
        self.plan.bodies.iter().for_each(|body| flags[*body as usize] = false);
        self.carried.iter().for_each(|(body, _)| flags[*body as usize] = true);
    }

    /// Writes what was carried and its contacts to the world.
    pub fn store(&mut self, world: &mut World) {
        let bodies = &mut world.bodies;
        for (body, path) in &self.carried {
            let i = *body as usize;
            bodies.position[i] = path.position;
            bodies.velocity[i] = path.velocity;
            let rotor = bodies.rotor[i];
            if rotor != NO_ROTOR {
                bodies.rotors.angle[rotor as usize] = path.angle;
                bodies.rotors.omega[rotor as usize] = path.omega;
            }
        }
        if !self.carried.is_empty() {
            self.told.store(world, self.end);
        }
    }
}

/// The path of a body at the start of a step, before anything touches it.
fn start_of(world: &World, body: u32) -> Path {
    let (bodies, i) = (&world.bodies, body as usize);
    let spin = bodies.spin(i).unwrap_or_default();
    let path = Path { position: bodies.position[i], angle: spin.angle, ..Path::default() };
    if bodies.inverse_mass[i] > 0.0 {
        Path { velocity: bodies.velocity[i], drive: world.gravity, omega: spin.omega, ..path }
    } else {
        path
    }
}

/// Whether a body is where numbers mean something.
fn in_range(path: &Path) -> bool {
    // Written so that a NaN is out of range.
    path.position.x.abs() <= LARGEST_COORDINATE
        && path.position.y.abs() <= LARGEST_COORDINATE
        && path.velocity.x.abs() <= LARGEST_SPEED
        && path.velocity.y.abs() <= LARGEST_SPEED
        && path.omega.abs() <= LARGEST_SPEED
        && path.angle.abs() <= LARGEST_SPEED * LARGEST_COORDINATE
}
