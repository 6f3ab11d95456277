//! Bodies that meet each other or walls with nothing to pull them: an encounter of two, a row, a box.

use super::contacts::{refuse_rough_floor, sides};
use super::motion::{Course, Part};
use super::{refuse_drag, refuse_links};
use crate::engine::{DVec2, World};
use crate::truth::closed_form::{Encounter, Hitting};

fn refuse_gravity(world: &World) -> Result<(), String> {
    if world.gravity() == DVec2::ZERO { Ok(()) } else { Err("gravity".into()) }
}

/// Restitution and friction where two bodies touch.
fn material(world: &World, a: usize, b: usize) -> (f64, f64) {
    let (bodies, tuning) = (world.bodies(), world.tuning());
    (
        tuning.restitution.unwrap_or(bodies.restitution[a].max(bodies.restitution[b])),
        tuning.friction.unwrap_or((bodies.friction[a] * bodies.friction[b]).sqrt()),
    )
}

/// Whether two bodies can touch at all.
pub(super) fn can_touch(world: &World, a: usize, b: usize) -> bool {
    let bodies = world.bodies();
    let solid = |i: usize| bodies.collides[i] && bodies.radius[i] > 0.0;
    solid(a) && solid(b) && (bodies.group[a] == 0 || bodies.group[a] != bodies.group[b])
}

/// Who meets whom is found from the motions at the start, the earliest first; all others fly freely.
pub(super) fn exchange(world: &World, moving: &[usize]) -> Result<Vec<Part>, String> {
    refuse_drag(world)?;
    moving.iter().try_for_each(|&i| refuse_links(world, i))?;
    let pairs = moving.iter().enumerate().flat_map(|(k, &a)| moving[k + 1..].iter().map(move |&b| [a, b]));
    let meeting = |[a, b]: [usize; 2]| {
        let encounter = encounter(world, a, b);
        encounter.impact_time().filter(|_| can_touch(world, a, b)).map(|time| (time, [a, b], encounter))
    };
    let mut meetings: Vec<_> = pairs.filter_map(meeting).collect();
    meetings.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut parts, mut met) = (Vec::new(), Vec::new());
    for (_, bodies, encounter) in meetings {
        if !bodies.iter().any(|body| met.contains(body)) {
            met.extend(bodies);
            parts.push(Part::Pair { bodies, encounter });
        }
    }
    if parts.is_empty() {
        return Err("no two bodies that meet".into());
    }
    let (velocity, gravity) = (&world.bodies().velocity, world.gravity());
    let alone = moving.iter().filter(|body| !met.contains(body));
    parts.extend(alone.map(|&body| Part::Free { body, velocity: velocity[body], gravity, drag: 0.0 }));
    Ok(parts)
}

fn encounter(world: &World, a: usize, b: usize) -> Encounter {
    let bodies = world.bodies();
    let hitting = |i: usize| {
        let (mass, radius, spin) = (bodies.mass[i], bodies.radius[i], bodies.spin(i));
        Hitting {
            mass,
            inertia: if spin.is_some() { 0.5 * mass * radius * radius } else { f64::INFINITY },
            radius,
            velocity: bodies.velocity[i],
            omega: spin.unwrap_or_default().omega,
        }
    };
    let (restitution, friction) = material(world, a, b);
    let positions = [bodies.position[a], bodies.position[b]];
    Encounter { discs: [hitting(a), hitting(b)], positions, gravity: world.gravity(), restitution, friction }
}

pub(super) fn row(world: &World, moving: &[usize]) -> Result<Part, String> {
    refuse_drag(world)?;
    moving.iter().try_for_each(|&i| refuse_links(world, i))?;
    let bodies = world.bodies();
    let first = moving[0];
    let is_like_first = |i: usize| bodies.mass[i] == bodies.mass[first] && bodies.radius[i] == bodies.radius[first];
    if !moving.iter().all(|&i| is_like_first(i) && bodies.spin(i).is_none_or(|spin| spin.omega == 0.0)) {
        return Err("balls that differ in mass or radius, or that spin".into());
    }
    // The farthest of them gives the line its direction.
    let offset = |i: usize| bodies.position[i] - bodies.position[first];
    let farthest = moving.iter().copied().max_by(|&a, &b| offset(a).length().total_cmp(&offset(b).length()));
    let axis = offset(farthest.unwrap_or(first)).try_normalize().ok_or("fewer than two places")?;
    let off_line = |v: DVec2| v.perp_dot(axis).abs() > 1e-12 * (1.0 + v.length());
    if moving.iter().any(|&i| off_line(offset(i)) || off_line(bodies.velocity[i])) {
        return Err("a place or a velocity off the line".into());
    }
    if world.gravity() != DVec2::ZERO {
        if world.gravity().dot(axis).abs() > 1e-12 * world.gravity().length() {
            return Err("gravity along the line".into());
        }
        moving.iter().try_for_each(|&i| refuse_rough_floor(world, i))?;
    }
    let mut order = moving.to_vec();
    order.sort_by(|&a, &b| offset(a).dot(axis).total_cmp(&offset(b).dot(axis)));
    if order.windows(2).any(|pair| !can_touch(world, pair[0], pair[1]) || material(world, pair[0], pair[1]).0 != 1.0) {
        return Err("neighbours that cannot touch, or a restitution other than 1".into());
    }
    Ok(Part::Row {
        places: order.iter().map(|&i| offset(i).dot(axis)).collect(),
        velocities: order.iter().map(|&i| bodies.velocity[i].dot(axis)).collect(),
        bodies: order,
        origin: bodies.position[first],
        axis,
        diameter: 2.0 * bodies.radius[first],
    })
}

pub(super) fn billiard(world: &World, body: usize) -> Result<Part, String> {
    refuse_drag(world)?;
    refuse_gravity(world)?;
    refuse_links(world, body)?;
    let velocity = world.bodies().velocity[body];
    let course = |axis: DVec2| match velocity.dot(axis) {
        0.0 => Ok(Course::Still),
        velocity => Ok::<_, String>(Course::Reflected {
            velocity,
            walls: [-room(world, body, -axis)?, room(world, body, axis)?],
        }),
    };
    let courses = [course(DVec2::X)?, course(DVec2::Y)?];
    Ok(Part::Axes { body, axes: [DVec2::X, DVec2::Y], courses, ground: None })
}

/// How far `body` can go along an axis before it touches a wall [m].
fn room(world: &World, body: usize, axis: DVec2) -> Result<f64, String> {
    let (bodies, tuning) = (world.bodies(), world.tuning());
    let (centre, radius) = (bodies.position[body], bodies.radius[body]);
    let mut nearest: Option<(f64, f64, f64)> = None;
    for wall in world.walls() {
        for side in sides(&wall.shape) {
            let (a, b) = (side.from - centre, side.to - centre);
            let across = a.perp_dot(axis) * b.perp_dot(axis) <= 0.0 && a.dot(axis) == b.dot(axis);
            let distance = a.dot(axis) - radius;
            if across && distance > -1e-9 && nearest.is_none_or(|(least, ..)| distance < least) {
                nearest = Some((distance, wall.restitution, wall.friction));
            }
        }
    }
    let (distance, restitution, friction) = nearest.ok_or("no wall along an axis that it moves on")?;
    let restitution = tuning.restitution.unwrap_or(restitution.max(bodies.restitution[body]));
    let friction = tuning.friction.unwrap_or(friction * bodies.friction[body]);
    if restitution != 1.0 || friction != 0.0 {
        return Err(format!("a wall with restitution {restitution:?}, friction {friction:?}, not 1 and 0"));
    }
    Ok(distance)
}
