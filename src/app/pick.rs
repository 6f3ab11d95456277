//! What lies under the pointer: an exact hit first, then the nearest within reach; of several, the smallest on top.

use super::camera::Camera;
use crate::engine::{DVec2, Id, Shape, World};

/// How far from a thing the pointer may be and still mean it [canvas points].
pub const REACH: f64 = 8.0;

/// What an id names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Item {
    /// Dense index of a body.
    Body(usize),
    /// Dense index of a constraint.
    Constraint(usize),
    /// Index of a wall.
    Wall(usize),
}

/// What `id` names in `world`, if it still exists.
pub fn item(world: &World, id: Id) -> Option<Item> {
    let wall = || world.wall_ids().binary_search(&id).ok().map(Item::Wall);
    let constraint = || world.constraints().index_of(id).map(Item::Constraint);
    world.bodies().index_of(id).map(Item::Body).or_else(constraint).or_else(wall)
}

/// The body, constraint or wall at a canvas point.
pub fn pick(world: &World, camera: &Camera, canvas: DVec2) -> Option<Id> {
    let point = camera.to_world(canvas);
    let candidates = bodies(world, point).chain(constraints(world, point)).chain(walls(world, point));
    best(candidates, REACH / camera.scale)
}

/// The body at a canvas point, whatever else is there.
pub fn pick_body(world: &World, camera: &Camera, canvas: DVec2) -> Option<Id> {
    best(bodies(world, camera.to_world(canvas)), REACH / camera.scale)
}

/// The bodies whose centres, the constraints whose middles and the walls whose bounds lie in a rectangle [m].
pub fn within(world: &World, min: DVec2, max: DVec2) -> Vec<Id> {
    let inside = |point: DVec2| point.cmpge(min).all() && point.cmple(max).all();
    let bodies = world.bodies();
    let mut ids: Vec<Id> = (0..bodies.len()).filter(|&i| inside(bodies.position[i])).map(|i| bodies.id[i]).collect();
    let middle = |i: usize| {
        let (a, b) = world.ends(i);
        (a + b) / 2.0
    };
    let constraints = world.constraints();
    ids.extend((0..constraints.len()).filter(|&i| inside(middle(i))).map(|i| constraints.id[i]));
    for (id, wall) in world.wall_ids().iter().zip(world.walls()) {
        let (low, high) = wall.shape.bounds();
        if inside(low) && inside(high) {
            ids.push(*id);
        }
    }
    ids
}

/// Corners of the smallest box around those of `ids` that exist [m]; of everything if `ids` is empty; `None` if nothing is there.
pub fn bounds(world: &World, ids: &[Id]) -> Option<(DVec2, DVec2)> {
    let mut boxes: Vec<(DVec2, DVec2)> = Vec::new();
    let wanted = |id: &Id| ids.is_empty() || ids.contains(id);
    let bodies = world.bodies();
    for i in (0..bodies.len()).filter(|&i| wanted(&bodies.id[i])) {
        let radius = DVec2::splat(bodies.radius[i]);
        boxes.push((bodies.position[i] - radius, bodies.position[i] + radius));
    }
    for i in (0..world.constraints().len()).filter(|&i| wanted(&world.constraints().id[i])) {
        let (a, b) = world.ends(i);
        boxes.push((a.min(b), a.max(b)));
    }
    let walls = world.wall_ids().iter().zip(world.walls());
    boxes.extend(walls.filter(|(id, _)| wanted(id)).map(|(_, wall)| wall.shape.bounds()));
    boxes.into_iter().reduce(|all, one| (all.0.min(one.0), all.1.max(one.1)))
}

/// One thing near the pointer: how far away its surface is (≤ 0: the pointer is on it), and how large it is.
struct Candidate {
    id: Id,
    distance: f64,
    size: f64,
}

fn bodies(world: &World, point: DVec2) -> impl Iterator<Item = Candidate> {
    let bodies = world.bodies();
    (0..bodies.len()).map(move |i| {
        let radius = bodies.radius[i];
        Candidate { id: bodies.id[i], distance: point.distance(bodies.position[i]) - radius, size: radius }
    })
}

fn constraints(world: &World, point: DVec2) -> impl Iterator<Item = Candidate> {
    (0..world.constraints().len()).map(move |i| {
        let (from, to) = world.ends(i);
        let distance = Shape::Segment { from, to }.distance(point).0;
        Candidate { id: world.constraints().id[i], distance, size: from.distance(to) }
    })
}

fn walls(world: &World, point: DVec2) -> impl Iterator<Item = Candidate> {
    world.wall_ids().iter().zip(world.walls()).map(move |(id, wall)| {
        let (min, max) = wall.shape.bounds();
        Candidate { id: *id, distance: wall.shape.distance(point).0, size: min.distance(max) }
    })
}

/// The smallest of those hit exactly, else the nearest within `reach` [m].
fn best(candidates: impl Iterator<Item = Candidate>, reach: f64) -> Option<Id> {
    let rank = |c: &Candidate| if c.distance <= 0.0 { (0, c.size, 0.0) } else { (1, c.distance, c.size) };
    let near = candidates.filter(|c| c.distance <= reach);
    near.min_by(|a, b| {
        let (a, b) = (rank(a), rank(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.total_cmp(&b.2))
    })
    .map(|c| c.id)
}
