//! What lies under the pointer: an exact hit first, then the nearest within reach; of several, the smallest on top.

use super::camera::Camera;
use super::drawn::{self, Sizes};
use crate::engine::constraint::WORLD;
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
    let sizes = Sizes::of(world);
    let links = (0..world.constraints().len()).map(|link| constraint(world, &sizes, camera.scale, link, point));
    let candidates = bodies(world, &sizes, camera.scale, point).chain(links).chain(walls(world, point));
    best(candidates, REACH / camera.scale)
}

/// The body at a canvas point, whatever else is there.
pub fn pick_body(world: &World, camera: &Camera, canvas: DVec2) -> Option<Id> {
    best(bodies(world, &Sizes::of(world), camera.scale, camera.to_world(canvas)), REACH / camera.scale)
}

/// A place on a rod, rope or spring by which it can be held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Handle {
    /// The rod, rope or spring.
    pub link: Id,
    /// The body at the nearer end that can be moved: the one that is held.
    pub body: Id,
    /// The end at `body` is the first one.
    first: bool,
    /// How far from that end the place is, in parts of the way to the other.
    along: f64,
}

impl Handle {
    /// The end that is held and the place itself [m], as they are now; `None` if the link is gone.
    pub fn places(&self, world: &World) -> Option<(DVec2, DVec2)> {
        let (a, b) = world.ends(world.constraints().index_of(self.link)?);
        let (end, other) = if self.first { (a, b) } else { (b, a) };
        Some((end, end.lerp(other, self.along)))
    }
}

/// The place on the rod, rope or spring at a canvas point, if one lies there that hangs on a body which can be moved.
pub fn pick_handle(world: &World, camera: &Camera, canvas: DVec2) -> Option<Handle> {
    let link = pick(world, camera, canvas)?;
    let links = world.constraints();
    let index = links.index_of(link)?;
    let (a, b) = world.ends(index);
    let way = b - a;
    let from_a = (camera.to_world(canvas) - a).dot(way) / way.length_squared();
    if !from_a.is_finite() {
        return None;
    }
    let from_a = from_a.clamp(0.0, 1.0);
    let ends = [(links.a[index], true, from_a), (links.b[index], false, 1.0 - from_a)];
    let moves = |body: u32| body != WORLD && world.is_dynamic(body as usize);
    let movable = ends.into_iter().filter(|(body, ..)| moves(*body));
    let (body, first, along) = movable.min_by(|a, b| a.2.total_cmp(&b.2))?;
    Some(Handle { link, body: world.bodies().id[body as usize], first, along })
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

/// One thing near the pointer.
struct Candidate {
    id: Id,
    /// The pointer is on it.
    hit: bool,
    /// From its surface [m].
    distance: f64,
    /// The smaller of two that are hit lies on top [m].
    size: f64,
}

/// A body is hit where it is; a point mass where its bob is drawn.
fn bodies(world: &World, sizes: &Sizes, scale: f64, point: DVec2) -> impl Iterator<Item = Candidate> {
    let bodies = world.bodies();
    (0..bodies.len()).map(move |i| {
        let radius = if bodies.radius[i] == 0.0 { sizes.radius(world, i, scale) / scale } else { bodies.radius[i] };
        let distance = point.distance(bodies.position[i]) - radius;
        Candidate { id: bodies.id[i], hit: distance <= 0.0, distance, size: radius }
    })
}

/// A link is hit where its line can be seen. One that lies over the beads of its chain is hit along its middle half and wins
/// there: the rest is left to the beads.
fn constraint(world: &World, sizes: &Sizes, scale: f64, link: usize, point: DVec2) -> Candidate {
    let (from, to) = world.ends(link);
    let half_width = drawn::half_width(world, sizes, link, scale) / scale;
    let length = from.distance(to);
    let away = |from: DVec2, to: DVec2| Shape::Segment { from, to }.distance(point).0 - half_width;
    let above = length == 0.0 || drawn::lies_above(world, sizes, link, scale);
    let links = world.constraints();
    let hidden = |body: u32| {
        let radius = if body == WORLD { 0.0 } else { sizes.radius(world, body as usize, scale) / scale };
        (radius / length).min(1.0)
    };
    let [start, end] = if above { [0.25, 0.25] } else { [hidden(links.a[link]), hidden(links.b[link])] };
    let hit = start + end < 1.0 && away(from.lerp(to, start), to.lerp(from, end)) <= 0.0;
    let size = if above { half_width } else { length };
    Candidate { id: links.id[link], hit, distance: away(from, to), size }
}

fn walls(world: &World, point: DVec2) -> impl Iterator<Item = Candidate> {
    world.wall_ids().iter().zip(world.walls()).map(move |(id, wall)| {
        let (min, max) = wall.shape.bounds();
        let distance = wall.shape.distance(point).0;
        Candidate { id: *id, hit: distance <= 0.0, distance, size: min.distance(max) }
    })
}

/// The smallest of those hit exactly, else the nearest within `reach` [m].
fn best(candidates: impl Iterator<Item = Candidate>, reach: f64) -> Option<Id> {
    let rank = |c: &Candidate| if c.hit { (0, c.size, 0.0) } else { (1, c.distance, c.size) };
    let near = candidates.filter(|c| c.distance <= reach);
    near.min_by(|a, b| {
        let (a, b) = (rank(a), rank(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.total_cmp(&b.2))
    })
    .map(|c| c.id)
}
