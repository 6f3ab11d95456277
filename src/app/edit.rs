//! Carries out edits on a world: adding, copying, cutting, pinning, joining, changing, removing.

use super::command::{Edit, Spawn};
use super::pick::{Item, item};
use crate::engine::{Anchor, Body, Constraint, DVec2, EngineError, Id, Kind, Motion, Shape, Spin, Wall, World};
use crate::scene::SceneError;
use crate::scene::generator::{Cloth, Generator, Pile, Rope};

/// Why an edit was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EditError {
    /// A body, constraint or wall that the world does not take, or an id that it does not have.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// A rope, cloth or pile that cannot be generated.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// Carries out `edit` and tells which things it made or changed; empty if there was nothing to do. On an error the world may be
/// half changed: the caller keeps a copy.
pub fn apply(world: &mut World, edit: &Edit) -> Result<Vec<Id>, EditError> {
    match edit {
        Edit::Spawn { kind, at, size } => spawn(world, *kind, *at, *size),
        Edit::Duplicate(ids, offset) => duplicate(world, ids, *offset),
        Edit::Delete(ids) => Ok(delete(world, ids)),
        Edit::Cut(from, to) => Ok(cut(world, *from, *to)),
        Edit::Pin(ids, fixed) => pin(world, ids, *fixed),
        Edit::ChangeBody { id, from, to } => {
            let changed = with_changes(world.body(*id)?, from, to);
            Ok(world.set_body(*id, &changed).map(|()| vec![*id])?)
        }
        Edit::SetKind(id, kind) => Ok(world.set_kind(*id, *kind).map(|()| vec![*id])?),
        Edit::SetWall(id, wall) => Ok(world.set_wall(*id, wall).map(|()| vec![*id])?),
        Edit::Join(constraint) => Ok(world.add_constraint(constraint).map(|id| vec![id])?),
        Edit::Hang { kind, from, at, size } => {
            let bob = world.add_body(&particle(*at, *size))?;
            let link = world.add_constraint(&Constraint::to_world(*kind, bob, *from))?;
            Ok(vec![bob, link])
        }
        Edit::AddWall(wall) => Ok(world.add_wall(wall).map(|id| vec![id])?),
    }
}

/// `body` with those properties of `to` that differ from `from`.
pub(super) fn with_changes(mut body: Body, from: &Body, to: &Body) -> Body {
    fn take<T: Copy + PartialEq>(value: &mut T, from: T, to: T) {
        if from != to {
            *value = to;
        }
    }
    take(&mut body.motion, from.motion, to.motion);
    take(&mut body.position.x, from.position.x, to.position.x);
    take(&mut body.position.y, from.position.y, to.position.y);
    take(&mut body.velocity.x, from.velocity.x, to.velocity.x);
    take(&mut body.velocity.y, from.velocity.y, to.velocity.y);
    take(&mut body.mass, from.mass, to.mass);
    take(&mut body.radius, from.radius, to.radius);
    take(&mut body.restitution, from.restitution, to.restitution);
    take(&mut body.friction, from.friction, to.friction);
    take(&mut body.collides, from.collides, to.collides);
    take(&mut body.group, from.group, to.group);
    match (&mut body.spin, from.spin, to.spin) {
        (Some(spin), Some(from), Some(to)) => {
            take(&mut spin.angle, from.angle, to.angle);
            take(&mut spin.omega, from.omega, to.omega);
        }
        (spin, from, to) => take(spin, from, to),
    }
    body
}

/// Mass of a spawned body by its area [kg/m²]: a disc of 0.1 m has about a kilogram.
const DENSITY: f64 = 30.0;
/// Natural frequency of `mass` on a spawned spring [Hz]: slow enough to be seen, far below the rate of a substep.
const SPRING_HZ: f64 = 2.5;
/// Damping ratio of a spawned spring: it rings some ten times.
const SPRING_DAMPING_RATIO: f64 = 0.03;
/// Natural frequency of a particle on one spring of a spawned cloth [Hz]: stiff enough to hang like cloth, and with four
/// neighbours still 15 substeps of 1/240 s a period.
const CLOTH_HZ: f64 = 8.0;
/// Distance of neighbours in what is spawned, in radii.
const GAP: f64 = 2.5;
/// Links of a spawned rope.
const ROPE_LINKS: u32 = 20;
/// Particles along a side of a spawned cloth.
const CLOTH_SIDE: u32 = 12;
/// Discs along a side of a spawned pile.
const PILE_SIDE: u32 = 8;

/// A spring of rest length `rest` [m] that suits a `mass` [kg].
pub(crate) fn spring(rest: f64, mass: f64) -> Kind {
    let omega = std::f64::consts::TAU * SPRING_HZ;
    Kind::Spring { rest, stiffness: mass * omega * omega, damping: 2.0 * SPRING_DAMPING_RATIO * mass * omega }
}

/// A particle of radius `radius` [m] as it is spawned.
pub(crate) fn particle(position: DVec2, radius: f64) -> Body {
    Body { position, radius, mass: DENSITY * std::f64::consts::PI * radius * radius, ..Body::default() }
}

fn spawn(world: &mut World, kind: Spawn, at: DVec2, size: f64) -> Result<Vec<Id>, EditError> {
    let pair = DVec2::new(4.0 * size, 0.0);
    match kind {
        Spawn::Particle => Ok(vec![world.add_body(&particle(at, size))?]),
        Spawn::Disc => {
            let disc = Body { spin: Some(Spin::default()), restitution: 0.3, ..particle(at, 2.0 * size) };
            Ok(vec![world.add_body(&disc)?])
        }
        Spawn::Rod => spawn_pair(world, at - pair, at + pair, size, Kind::Rod { length: 8.0 * size }),
        Spawn::Spring => {
            let kind = spring(8.0 * size, particle(at, size).mass);
            spawn_pair(world, at - pair, at + pair, size, kind)
        }
        Spawn::Rope => Ok(rope(at, size).add_to(world)?),
        Spawn::Cloth => Ok(cloth(at, size).add_to(world)?),
        Spawn::Pile => Ok(pile(at, size).add_to(world)?),
    }
}

fn spawn_pair(world: &mut World, a: DVec2, b: DVec2, radius: f64, kind: Kind) -> Result<Vec<Id>, EditError> {
    let (a, b) = (world.add_body(&particle(a, radius))?, world.add_body(&particle(b, radius))?);
    let constraint = world.add_constraint(&Constraint::between(kind, a, b))?;
    Ok(vec![a, b, constraint])
}

/// Hangs from a pinned particle at `at`, to the right.
fn rope(at: DVec2, size: f64) -> Generator {
    let to = at + DVec2::new(GAP * size * f64::from(ROPE_LINKS), 0.0);
    let mass = particle(at, size).mass;
    Generator::Rope(Rope { from: at, to, links: ROPE_LINKS, mass, radius: size, ..Rope::default() })
}

/// Hangs from two pinned corners, its top edge's middle at `at`.
fn cloth(at: DVec2, size: f64) -> Generator {
    let spacing = GAP * size;
    let mass = particle(at, size).mass;
    let omega = std::f64::consts::TAU * CLOTH_HZ;
    Generator::Cloth(Cloth {
        corner: at - DVec2::new(spacing * f64::from(CLOTH_SIDE - 1) / 2.0, 0.0),
        columns: CLOTH_SIDE,
        rows: CLOTH_SIDE,
        spacing,
        stiffness: mass * omega * omega,
        damping: 2.0 * SPRING_DAMPING_RATIO * mass * omega,
        mass,
        radius: size,
        ..Cloth::default()
    })
}

/// A block of discs around `at`.
fn pile(at: DVec2, size: f64) -> Generator {
    let half = DVec2::splat(GAP * size * f64::from(PILE_SIDE) / 2.0);
    Generator::Pile(Pile {
        count: PILE_SIDE * PILE_SIDE,
        min: at - half,
        max: at + half,
        radius: (0.8 * size, 1.2 * size),
        density: DENSITY,
        spin: true,
        ..Pile::default()
    })
}

fn duplicate(world: &mut World, ids: &[Id], offset: DVec2) -> Result<Vec<Id>, EditError> {
    let mut copies = Vec::new();
    for &id in ids {
        let Ok(body) = world.body(id) else { continue };
        copies.push((id, world.add_body(&Body { position: body.position + offset, ..body })?));
    }
    let copy_of = |id: Id| copies.iter().find(|(old, _)| *old == id).map(|(_, new)| *new);
    // A constraint comes along if it was selected, or if it joins two things that are copied.
    let moved = |anchor: Anchor| match anchor {
        Anchor::Body(id, local) => copy_of(id).map(|copy| Anchor::Body(copy, local)),
        Anchor::World(point) => Some(Anchor::World(point + offset)),
    };
    let mut made: Vec<Id> = copies.iter().map(|(_, new)| *new).collect();
    for index in 0..world.constraints().len() {
        let old = world.constraint_at(index);
        if let (Some(a), Some(b)) = (moved(old.a), moved(old.b)) {
            made.push(world.add_constraint(&Constraint { a, b, ..old })?);
        }
    }
    for &id in ids {
        if let Some(Item::Wall(index)) = item(world, id) {
            let old = world.walls()[index];
            made.push(world.add_wall(&Wall { shape: shifted(old.shape, offset), ..old })?);
        }
    }
    Ok(made)
}

fn shifted(shape: Shape, offset: DVec2) -> Shape {
    match shape {
        Shape::Segment { from, to } => Shape::Segment { from: from + offset, to: to + offset },
        Shape::Box { min, max } => Shape::Box { min: min + offset, max: max + offset },
    }
}

fn delete(world: &mut World, ids: &[Id]) -> Vec<Id> {
    let of = |wanted: fn(Item) -> bool| -> Vec<Id> {
        ids.iter().copied().filter(|id| item(world, *id).is_some_and(wanted)).collect()
    };
    let bodies = of(|item| matches!(item, Item::Body(_)));
    let constraints = of(|item| matches!(item, Item::Constraint(_)));
    let walls = of(|item| matches!(item, Item::Wall(_)));
    if !constraints.is_empty() {
        world.remove_constraints(&constraints);
    }
    if !bodies.is_empty() {
        world.remove_bodies(&bodies);
    }
    if !walls.is_empty() {
        world.remove_walls(&walls);
    }
    [bodies, constraints, walls].concat()
}

/// A pin has no length that a slash could cross: it is cut if the slash passes it within this part of the slash's own length.
const PIN_REACH: f64 = 0.02;

fn cut(world: &mut World, from: DVec2, to: DVec2) -> Vec<Id> {
    let slash = Shape::Segment { from, to };
    let crossed = |index: usize| {
        let (a, b) = world.ends(index);
        match world.constraints().kind[index] {
            Kind::Pin => slash.distance((a + b) / 2.0).0 <= PIN_REACH * from.distance(to),
            _ => segments_cross(from, to, a, b),
        }
    };
    let constraints = world.constraints();
    let ids: Vec<Id> = (0..constraints.len()).filter(|&i| crossed(i)).map(|i| constraints.id[i]).collect();
    if !ids.is_empty() {
        world.remove_constraints(&ids);
    }
    ids
}

/// Whether segment ab and segment cd have a point in common, by the signs of four areas; two on one line do not count.
fn segments_cross(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> bool {
    let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
    let (c_side, d_side) = (side(a, b, c), side(a, b, d));
    let (a_side, b_side) = (side(c, d, a), side(c, d, b));
    (c_side != 0.0 || d_side != 0.0) && c_side * d_side <= 0.0 && a_side * b_side <= 0.0
}

fn pin(world: &mut World, ids: &[Id], fixed: bool) -> Result<Vec<Id>, EditError> {
    let motion = if fixed { Motion::Static } else { Motion::Dynamic };
    let mut changed = Vec::new();
    for &id in ids {
        let Ok(body) = world.body(id) else { continue };
        if body.motion == motion {
            continue;
        }
        // What is fixed has no velocity left, so that it does not fly off when it is freed.
        let spin = body.spin.map(|spin| Spin { omega: 0.0, ..spin });
        world.set_body(id, &Body { motion, velocity: DVec2::ZERO, spin, ..body })?;
        changed.push(id);
    }
    Ok(changed)
}
