//! The state that a step reads and writes.

use super::body::{Bodies, Body, Motion, NO_ROTOR};
use super::constraint::{Anchor, Constraint, Constraints, Foresight, Grip, Kind, WORLD};
use super::error::{EngineError, check, check_point};
use super::id::{Id, find};
use super::shape::Wall;
use glam::DVec2;
use serde::{Deserialize, Serialize};
use std::sync::atomic::{AtomicU64, Ordering};

/// What a contact is with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Touching {
    /// Dense index of a body (larger than the contact's own).
    Body(u32),
    /// Dense index of a wall.
    Wall(u32),
}

/// A pair that touches or is about to: picture, measure and the solver's memory at once.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Contact {
    /// Dense index of the first body.
    pub a: u32,
    /// What that body touches.
    pub b: Touching,
    /// Where they touch, between the two surfaces [m].
    pub point: DVec2,
    /// Unit normal from `b` towards `a`.
    pub normal: DVec2,
    /// Distance of the surfaces when last detected [m]; negative is a penetration.
    pub gap: f64,
    /// Force along the normal [N], ≥ 0.
    pub normal_force: f64,
    /// Force on `a` along the tangent (the normal turned by +90°) [N].
    pub tangent_force: f64,
}

/// Values that stand in for those of every body, wall and spring at once; what the sandbox's world sliders change.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Tuning {
    /// Restitution of every contact, if set.
    pub restitution: Option<f64>,
    /// Friction of every contact, if set.
    pub friction: Option<f64>,
    /// Factor on the stiffness of every spring.
    pub stiffness: f64,
}

impl Default for Tuning {
    fn default() -> Self {
        Tuning { restitution: None, friction: None, stiffness: 1.0 }
    }
}

/// Everything that the next step depends on. A clone steps on to the same bits.
///
/// Arrays are read freely; they are changed through the methods, which keep them consistent and refuse values that no
/// step could read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct World {
    /// Steps taken.
    pub(crate) tick: u64,
    /// Simulated time [s].
    pub(crate) time: f64,
    /// Time, tick and rate when the rate was last changed: time is counted from there, so that it does not sum up rounding.
    pub(crate) epoch: (f64, u64, f64),
    pub(crate) gravity: DVec2,
    /// Rate at which free motion dies away [1/s]: v' = −drag · v.
    pub(crate) drag: f64,
    pub(crate) tuning: Tuning,
    pub(crate) bodies: Bodies,
    pub(crate) constraints: Constraints,
    pub(crate) wall_ids: Vec<Id>,
    pub(crate) walls: Vec<Wall>,
    pub(crate) grip: Option<Grip>,
    /// Contacts of the last substep: with bodies, then with walls, each ordered by (a, b).
    pub(crate) contacts: Vec<Contact>,
    /// Changes with every edit that a plan depends on.
    #[serde(skip)]
    pub(crate) revision: Revision,
    pub(crate) next_id: u64,
}

/// The name of a state of the things a plan is derived from. Never given twice in a process, so that a plan made for one
/// world cannot be taken for another's, also after undo. Not part of the physics: any two compare equal.
#[derive(Clone, Copy, Debug)]
pub struct Revision(u64);

impl Revision {
    fn next() -> Revision {
        static NEXT: AtomicU64 = AtomicU64::new(1);
        Revision(NEXT.fetch_add(1, Ordering::Relaxed))
    }

    /// Whether both name the same state.
    pub fn same(self, other: Revision) -> bool {
        self.0 == other.0
    }
}

impl Default for Revision {
    fn default() -> Self {
        Revision::next()
    }
}

impl PartialEq for Revision {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Default for World {
    fn default() -> Self {
        World {
            tick: 0,
            time: 0.0,
            epoch: (0.0, 0, 0.0),
            gravity: DVec2::new(0.0, -9.81),
            drag: 0.0,
            tuning: Tuning::default(),
            bodies: Bodies::default(),
            constraints: Constraints::default(),
            wall_ids: Vec::new(),
            walls: Vec::new(),
            grip: None,
            contacts: Vec::new(),
            revision: Revision::next(),
            next_id: 1,
        }
    }
}

/// Reading.
impl World {
    /// An empty world under (0, −9.81) m/s².
    pub fn new() -> World {
        World::default()
    }

    /// Steps taken.
    pub fn tick(&self) -> u64 {
        self.tick
    }

    /// Simulated time [s].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Gravity [m/s²].
    pub fn gravity(&self) -> DVec2 {
        self.gravity
    }

    /// Rate at which free motion dies away [1/s].
    pub fn drag(&self) -> f64 {
        self.drag
    }

    /// The values that stand in for every contact's and spring's own.
    pub fn tuning(&self) -> Tuning {
        self.tuning
    }

    /// All bodies, an array a property; a body's place in them is its dense index.
    pub fn bodies(&self) -> &Bodies {
        &self.bodies
    }

    /// All constraints, an array a property; a constraint's place in them is its dense index.
    pub fn constraints(&self) -> &Constraints {
        &self.constraints
    }

    /// Walls, in the order of [`World::wall_ids`].
    pub fn walls(&self) -> &[Wall] {
        &self.walls
    }

    /// Ids of the walls, ascending.
    pub fn wall_ids(&self) -> &[Id] {
        &self.wall_ids
    }

    /// The hand's hold on a body; `None` if nothing is held.
    pub fn grip(&self) -> Option<&Grip> {
        self.grip.as_ref()
    }

    /// Contacts of the last substep, those about to touch included: with bodies, then with walls, each ordered by (a, b).
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    /// Body `id`, whole.
    pub fn body(&self, id: Id) -> Result<Body, EngineError> {
        self.bodies.index_of(id).map(|index| self.bodies.get(index)).ok_or(EngineError::NoBody(id))
    }

    /// Constraint `id`, whole.
    pub fn constraint(&self, id: Id) -> Result<Constraint, EngineError> {
        let index = self.constraints.index_of(id).ok_or(EngineError::NoConstraint(id))?;
        Ok(self.constraint_at(index))
    }

    /// Constraint at a dense index, whole.
    pub fn constraint_at(&self, index: usize) -> Constraint {
        let c = &self.constraints;
        Constraint {
            kind: c.kind[index],
            a: self.anchor(c.a[index], c.at_a[index]),
            b: self.anchor(c.b[index], c.at_b[index]),
        }
    }

    /// Both ends of constraint `index` in the world [m].
    pub fn ends(&self, index: usize) -> (DVec2, DVec2) {
        let c = &self.constraints;
        (self.world_point(c.a[index], c.at_a[index]), self.world_point(c.b[index], c.at_b[index]))
    }

    /// A point given in the axes of body `index`, in the world [m].
    pub fn to_world(&self, index: usize, local: DVec2) -> DVec2 {
        self.bodies.position[index] + self.arm(index, local)
    }

    /// A point of the world in the axes of body `index` [m]; (0, 0) for a particle, which has no axes.
    pub fn to_local(&self, index: usize, point: DVec2) -> DVec2 {
        match self.bodies.spin(index) {
            Some(spin) => rotate(point - self.bodies.position[index], -spin.angle),
            None => DVec2::ZERO,
        }
    }

    /// A 64-bit FNV-1a hash over the bits of time, positions, velocities, rotations and multipliers: equal states, equal
    /// hashes, on every machine and in every build.
    pub fn hash(&self) -> u64 {
        let mut hash = Fnv::new();
        hash.add(self.time);
        let spins = &self.bodies.rotors;
        let vectors = [&self.bodies.position, &self.bodies.velocity, &self.constraints.force];
        vectors.into_iter().flatten().for_each(|v| hash.add_vector(*v));
        [&spins.angle, &spins.omega].into_iter().flatten().for_each(|value| hash.add(*value));
        for contact in &self.contacts {
            hash.add(contact.normal_force);
            hash.add(contact.tangent_force);
        }
        hash.value
    }

    /// Distance of the two surfaces of a contact as they stand now [m]; negative is a penetration.
    pub fn gap(&self, contact: &Contact) -> f64 {
        let (a, position) = (contact.a as usize, &self.bodies.position);
        let distance = match contact.b {
            Touching::Body(b) => (position[a] - position[b as usize]).length() - self.bodies.radius[b as usize],
            Touching::Wall(wall) => self.walls[wall as usize].shape.distance(position[a]).0,
        };
        distance - self.bodies.radius[a]
    }

    /// The mouse's hold, if it is on a disc that it turns.
    pub(crate) fn turning_grip(&self) -> Option<&Grip> {
        let turned = |grip: &&Grip| {
            let body = self.bodies.index_of(grip.body).map(|body| self.bodies.rotor[body]);
            body.is_some_and(|rotor| rotor != NO_ROTOR && self.bodies.rotors.inverse_inertia[rotor as usize] > 0.0)
        };
        self.grip.as_ref().filter(|grip| grip.local != DVec2::ZERO).filter(turned)
    }

    fn anchor(&self, body: u32, at: DVec2) -> Anchor {
        if body == WORLD { Anchor::World(at) } else { Anchor::Body(self.bodies.id[body as usize], at) }
    }

    pub(crate) fn world_point(&self, body: u32, at: DVec2) -> DVec2 {
        if body == WORLD { at } else { self.to_world(body as usize, at) }
    }

    /// Vector from the centre of body `index` to a point in its axes, in world axes.
    pub(crate) fn arm(&self, index: usize, local: DVec2) -> DVec2 {
        match self.bodies.spin(index) {
            Some(spin) if local != DVec2::ZERO => rotate(local, spin.angle),
            _ => DVec2::ZERO,
        }
    }
}

/// Changing. Every method that fails leaves the world as it was.
impl World {
    /// Sets gravity [m/s²].
    pub fn set_gravity(&mut self, gravity: DVec2) -> Result<(), EngineError> {
        check("gravity", gravity.length(), [0.0, 1e6], "finite and at most 1e6 m/s²")?;
        self.gravity = gravity;
        self.revision = Revision::next();
        Ok(())
    }

    /// Sets the rate at which free motion dies away [1/s].
    pub fn set_drag(&mut self, drag: f64) -> Result<(), EngineError> {
        check("drag", drag, [0.0, 1e6], "between 0 and 1e6 1/s")?;
        self.drag = drag;
        self.revision = Revision::next();
        Ok(())
    }

    /// Sets the values that stand in for every contact's and spring's own.
    pub fn set_tuning(&mut self, tuning: Tuning) -> Result<(), EngineError> {
        if let Some(restitution) = tuning.restitution {
            check("restitution", restitution, [0.0, 1.0], "between 0 and 1")?;
        }
        if let Some(friction) = tuning.friction {
            check("friction", friction, [0.0, 1e3], "between 0 and 1000")?;
        }
        check("stiffness factor", tuning.stiffness, [0.0, 1e9], "between 0 and 1e9")?;
        self.tuning = tuning;
        self.revision = Revision::next();
        Ok(())
    }

    /// Adds a body and names it.
    pub fn add_body(&mut self, body: &Body) -> Result<Id, EngineError> {
        body.validate()?;
        let id = self.take_id();
        self.bodies.push(id, body);
        Ok(id)
    }

    /// Replaces every property of a body, position and velocity included.
    pub fn set_body(&mut self, id: Id, body: &Body) -> Result<(), EngineError> {
        body.validate()?;
        let index = self.bodies.index_of(id).ok_or(EngineError::NoBody(id))?;
        let mut bodies = std::mem::take(&mut self.bodies);
        let old: Vec<(Id, Body)> = bodies.iter().collect();
        bodies.rebuild(old.into_iter().enumerate().map(|(i, (id, old))| (id, if i == index { *body } else { old })));
        self.bodies = bodies;
        if body.spin.is_none() {
            self.flatten_anchors(index as u32);
        }
        self.revision = Revision::next();
        Ok(())
    }

    /// Removes bodies with every constraint, contact and grip on them. Unknown ids are ignored. O((n + m) log m) for
    /// m of n things.
    pub fn remove_bodies(&mut self, ids: &[Id]) {
        let removed = sorted(ids);
        let is_removed = |id: &Id| removed.binary_search(id).is_ok();
        let mut map = vec![WORLD; self.bodies.len()];
        let mut kept = Vec::with_capacity(self.bodies.len());
        for (index, (id, body)) in self.bodies.iter().enumerate() {
            if !is_removed(&id) {
                map[index] = kept.len() as u32;
                kept.push((id, body));
            }
        }
        self.bodies.rebuild(kept.into_iter());
        let stays = |end: u32| end == WORLD || map[end as usize] != WORLD;
        let c = &self.constraints;
        let keep: Vec<bool> = (0..c.len()).map(|i| stays(c.a[i]) && stays(c.b[i])).collect();
        self.keep_constraints(&keep);
        for end in self.constraints.a.iter_mut().chain(&mut self.constraints.b).filter(|end| **end != WORLD) {
            *end = map[*end as usize];
        }
        self.contacts.retain_mut(|contact| renumber(contact, &map));
        if self.grip.is_some_and(|grip| is_removed(&grip.body)) {
            self.grip = None;
        }
        self.revision = Revision::next();
    }

    /// Adds a constraint and names it.
    pub fn add_constraint(&mut self, constraint: &Constraint) -> Result<Id, EngineError> {
        constraint.validate()?;
        let (a, at_a) = self.resolve(&constraint.a)?;
        let (b, at_b) = self.resolve(&constraint.b)?;
        let id = self.take_id();
        let c = &mut self.constraints;
        c.id.push(id);
        c.kind.push(constraint.kind);
        c.a.push(a);
        c.b.push(b);
        c.at_a.push(at_a);
        c.at_b.push(at_b);
        c.force.push(DVec2::ZERO);
        c.carried.push(false);
        c.foresight.push(Foresight::default());
        Ok(id)
    }

    /// Changes what a constraint asks for (its length, its stiffness, even its kind); its ends stay.
    pub fn set_kind(&mut self, id: Id, kind: Kind) -> Result<(), EngineError> {
        kind.validate()?;
        let index = self.constraints.index_of(id).ok_or(EngineError::NoConstraint(id))?;
        self.constraints.kind[index] = kind;
        self.revision = Revision::next();
        Ok(())
    }

    /// Removes constraints. Unknown ids are ignored.
    pub fn remove_constraints(&mut self, ids: &[Id]) {
        let removed = sorted(ids);
        let keep: Vec<bool> = self.constraints.id.iter().map(|id| removed.binary_search(id).is_err()).collect();
        self.keep_constraints(&keep);
        self.revision = Revision::next();
    }

    /// Adds a wall and names it.
    pub fn add_wall(&mut self, wall: &Wall) -> Result<Id, EngineError> {
        wall.validate()?;
        let id = self.take_id();
        self.walls.push(*wall);
        self.wall_ids.push(id);
        Ok(id)
    }

    /// Replaces a wall.
    pub fn set_wall(&mut self, id: Id, wall: &Wall) -> Result<(), EngineError> {
        wall.validate()?;
        let index = find(&self.wall_ids, id).ok_or(EngineError::NoWall(id))?;
        self.walls[index] = *wall;
        self.revision = Revision::next();
        Ok(())
    }

    /// Removes walls. Unknown ids are ignored.
    pub fn remove_walls(&mut self, ids: &[Id]) {
        let removed = sorted(ids);
        let keep: Vec<bool> = self.wall_ids.iter().map(|id| removed.binary_search(id).is_err()).collect();
        retain(&mut self.walls, &keep);
        retain(&mut self.wall_ids, &keep);
        self.contacts.retain(|contact| matches!(contact.b, Touching::Body(_)));
        self.revision = Revision::next();
    }

    /// Takes hold of a body, moves the hold, or (with `None`) lets go; the body keeps its velocity.
    pub fn set_grip(&mut self, grip: Option<Grip>) -> Result<(), EngineError> {
        if let Some(grip) = &grip {
            self.bodies.index_of(grip.body).ok_or(EngineError::NoBody(grip.body))?;
            check_point("grabbed point", grip.local)?;
            check_point("target of the grip", grip.target)?;
            check("frequency of the grip", grip.frequency, [1e-3, 1e4], "between 0.001 and 10000 Hz")?;
            check("damping ratio of the grip", grip.damping_ratio, [0.0, 1e3], "between 0 and 1000")?;
            check("largest force of the grip", grip.max_force, [0.0, 1e18], "between 0 and 1e18 N")?;
        }
        self.grip = grip;
        Ok(())
    }

    /// Counts a step at `hz` steps a second.
    pub(crate) fn advance_clock(&mut self, hz: f64) {
        if self.epoch.2 != hz {
            self.epoch = (self.time, self.tick, hz);
        }
        self.tick += 1;
        self.time = self.epoch.0 + (self.tick - self.epoch.1) as f64 / hz;
    }

    fn take_id(&mut self) -> Id {
        let id = Id(self.next_id);
        self.next_id += 1;
        self.revision = Revision::next();
        id
    }

    /// Dense index and local point of an anchor; a particle's anchor is its centre.
    fn resolve(&self, anchor: &Anchor) -> Result<(u32, DVec2), EngineError> {
        match *anchor {
            Anchor::World(point) => Ok((WORLD, point)),
            Anchor::Body(id, local) => {
                let index = self.bodies.index_of(id).ok_or(EngineError::NoBody(id))?;
                Ok((index as u32, if self.bodies.rotor[index] == NO_ROTOR { DVec2::ZERO } else { local }))
            }
        }
    }

    /// Moves every anchor on body `index` to its centre, for a body that stopped having axes.
    fn flatten_anchors(&mut self, index: u32) {
        let c = &mut self.constraints;
        for i in 0..c.id.len() {
            if c.a[i] == index {
                c.at_a[i] = DVec2::ZERO;
            }
            if c.b[i] == index {
                c.at_b[i] = DVec2::ZERO;
            }
        }
        if let Some(grip) = self.grip.as_mut().filter(|grip| self.bodies.id[index as usize] == grip.body) {
            grip.local = DVec2::ZERO;
        }
    }

    fn keep_constraints(&mut self, keep: &[bool]) {
        let c = &mut self.constraints;
        retain(&mut c.id, keep);
        retain(&mut c.kind, keep);
        retain(&mut c.a, keep);
        retain(&mut c.b, keep);
        retain(&mut c.at_a, keep);
        retain(&mut c.at_b, keep);
        retain(&mut c.force, keep);
        retain(&mut c.carried, keep);
        retain(&mut c.foresight, keep);
    }

    /// Whether body `index` is pushed by anything.
    pub fn is_dynamic(&self, index: usize) -> bool {
        self.bodies.motion[index] == Motion::Dynamic
    }
}

/// `v` turned by `angle` [rad], with the same bits on every platform.
pub(crate) fn rotate(v: DVec2, angle: f64) -> DVec2 {
    let (sin, cos) = libm::sincos(angle);
    DVec2::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y)
}

/// In ascending order, to be searched in.
fn sorted(ids: &[Id]) -> Vec<Id> {
    let mut ids = ids.to_vec();
    ids.sort_unstable();
    ids
}

fn retain<T>(items: &mut Vec<T>, keep: &[bool]) {
    let mut kept = keep.iter();
    items.retain(|_| *kept.next().expect("one flag an item"));
}

/// Gives a contact its bodies' new indices; `false` if one of them is gone.
fn renumber(contact: &mut Contact, map: &[u32]) -> bool {
    contact.a = map[contact.a as usize];
    if let Touching::Body(b) = &mut contact.b {
        *b = map[*b as usize];
        return contact.a != WORLD && *b != WORLD;
    }
    contact.a != WORLD
}

/// FNV-1a (Fowler, Noll, Vo), fed with the bits of doubles.
struct Fnv {
    value: u64,
}

impl Fnv {
    fn new() -> Fnv {
        Fnv { value: 0xcbf2_9ce4_8422_2325 }
    }

    fn add(&mut self, number: f64) {
        for byte in number.to_bits().to_le_bytes() {
            self.value = (self.value ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    fn add_vector(&mut self, v: DVec2) {
        self.add(v.x);
        self.add(v.y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::{Kind, Shape};

    #[test]
    fn what_is_removed_in_any_order_takes_what_hangs_on_it_and_nothing_else() {
        let mut world = World::new();
        let ids: Vec<Id> = (0..100)
            .map(|i| world.add_body(&Body { position: DVec2::new(f64::from(i), 0.0), ..Body::default() }).unwrap())
            .collect();
        let rods: Vec<Id> = ids
            .windows(2)
            .map(|pair| {
                world.add_constraint(&Constraint::between(Kind::Rod { length: 1.0 }, pair[0], pair[1])).unwrap()
            })
            .collect();
        let shape = |x: f64| Shape::Segment { from: DVec2::new(x, -1.0), to: DVec2::new(x, -2.0) };
        let walls: Vec<Id> =
            (0..10).map(|i| world.add_wall(&Wall { shape: shape(f64::from(i)), ..Wall::default() }).unwrap()).collect();
        // Of the highest first, some twice, one that is none.
        let gone: Vec<Id> = ids.iter().rev().step_by(3).copied().chain([ids[99], rods[0]]).collect();
        world.remove_bodies(&gone);
        let left: Vec<f64> = world.bodies().position.iter().map(|p| p.x).collect();
        let expected: Vec<f64> = (0..100).filter(|i| (99 - i) % 3 != 0).map(f64::from).collect();
        assert_eq!(left, expected);
        // One rod of three lies between two that stay.
        assert_eq!(world.constraints().len(), 33);
        for i in 0..world.constraints().len() {
            let (a, b) = world.ends(i);
            assert_eq!(b.x - a.x, 1.0);
        }
        let kept = world.constraints().id.clone();
        world.remove_constraints(&[kept[30], kept[2], kept[2]]);
        assert_eq!(world.constraints().len(), 31);
        assert!(!world.constraints().id.contains(&kept[2]) && world.constraints().id.contains(&kept[3]));
        world.remove_walls(&[walls[9], walls[0]]);
        assert_eq!(world.walls().len(), 8);
        assert!(world.walls().iter().all(|wall| wall.shape != shape(0.0) && wall.shape != shape(9.0)));
    }
}
