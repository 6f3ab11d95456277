//! Bodies that touch nothing: in free flight, on a spring, on a rod.

use super::motion::{Course, Part};
use super::{links, refuse_drag, refuse_links};
use crate::engine::{DVec2, Kind, World};
use crate::truth::closed_form::{Oscillator, Pendulum};
use std::f64::consts::PI;

/// Directions count as equal up to this sine: what scene files round.
const ALONG: f64 = 1e-12;

pub(super) fn projectile(world: &World, body: usize) -> Result<Part, String> {
    refuse_links(world, body)?;
    let velocity = world.bodies().velocity[body];
    Ok(Part::Free { body, velocity, gravity: world.gravity(), drag: world.drag() })
}

/// The only constraint on `body`, and the fixed point at its other end [m].
fn tied(world: &World, body: usize) -> Result<(Kind, DVec2), String> {
    let [k] = links(world, body)[..] else {
        return Err(format!("{} constraints on it, not one", links(world, body).len()));
    };
    let c = world.constraints();
    let (ends, (a, b)) = ([c.a[k] as usize, c.b[k] as usize], world.ends(k));
    let (own, other, point) = if ends[0] == body { (a, ends[1], b) } else { (b, ends[0], a) };
    if world.bodies().motion.get(other).is_some() && world.is_dynamic(other) {
        return Err("a constraint to another body that moves".into());
    }
    if own != world.bodies().position[body] {
        return Err("a constraint that holds it off its centre".into());
    }
    Ok((c.kind[k], point))
}

/// Along the spring m s̈ = −k (s − rest) − (c + m drag) ṡ + m g, which swings about s = rest + m g/k.
pub(super) fn oscillator(world: &World, body: usize) -> Result<Part, String> {
    let (kind, point) = tied(world, body)?;
    let Kind::Spring { rest, stiffness, damping } = kind else {
        return Err(format!("a {} on it, not a spring", kind.name().to_lowercase()));
    };
    let bodies = world.bodies();
    let (mass, velocity) = (bodies.mass[body], bodies.velocity[body]);
    let stiffness = stiffness * world.tuning().stiffness;
    let offset = bodies.position[body] - point;
    let distance = offset.length();
    if !(stiffness > 0.0 && distance > 0.0) {
        return Err("a spring without stiffness or length".into());
    }
    let axis = offset / distance;
    let across = |v: DVec2| v.perp_dot(axis).abs() > ALONG * v.length();
    if across(world.gravity()) || across(velocity) {
        return Err("gravity or a velocity across the spring".into());
    }
    let middle = rest + mass * world.gravity().dot(axis) / stiffness;
    let oscillator = Oscillator {
        mass,
        stiffness,
        damping: damping + mass * world.drag(),
        position: distance - middle,
        velocity: velocity.dot(axis),
    };
    // No swing is wider than its energy allows.
    let widest = oscillator.position.hypot(oscillator.velocity * (mass / stiffness).sqrt());
    if widest >= middle {
        return Err("a swing through the fixed point, where the spring turns round".into());
    }
    let courses = [Course::Oscillator(oscillator), Course::Still];
    Ok(Part::Axes { body, axes: [axis, axis.perp()], courses, ground: None })
}

pub(super) fn pendulum(world: &World, body: usize) -> Result<Part, String> {
    refuse_drag(world)?;
    let (kind, pivot) = tied(world, body)?;
    let Kind::Rod { length } = kind else {
        return Err(format!("a {} on it, not a rod", kind.name().to_lowercase()));
    };
    let (bodies, gravity) = (world.bodies(), world.gravity().length());
    let offset = bodies.position[body] - pivot;
    if bodies.velocity[body] != DVec2::ZERO {
        return Err("a velocity at the start".into());
    }
    if !(gravity > 0.0) || (offset.length() - length).abs() > 1e-9 * length {
        return Err("no gravity, or a rod that starts stretched".into());
    }
    let down = world.gravity() / gravity;
    let amplitude = libm::atan2(offset.dot(down.perp()), offset.dot(down));
    // Straight up it balances for as long as rounding lets it.
    if amplitude.abs() > PI - 1e-3 {
        return Err("a rod that stands upright".into());
    }
    Ok(Part::Pendulum { body, pivot, down, pendulum: Pendulum { length, gravity, amplitude } })
}
