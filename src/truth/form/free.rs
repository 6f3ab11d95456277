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

/// The only constraint on `body`.
struct Tie {
    kind: Kind,
    /// Whether it holds the body at its centre.
    central: bool,
    /// The fixed point at its other end [m].
    point: DVec2,
}

fn tied(world: &World, body: usize) -> Result<Tie, String> {
    let [k] = links(world, body)[..] else {
        return Err(format!("{} constraints on it, not one", links(world, body).len()));
    };
    let c = world.constraints();
    let (ends, (a, b)) = ([c.a[k] as usize, c.b[k] as usize], world.ends(k));
    let (own, other, point) = if ends[0] == body { (a, ends[1], b) } else { (b, ends[0], a) };
    if world.bodies().motion.get(other).is_some() && world.is_dynamic(other) {
        return Err("a constraint to another body that moves".into());
    }
    Ok(Tie { kind: c.kind[k], central: own == world.bodies().position[body], point })
}

/// Along the spring m s̈ = −k (s − rest) − (c + m drag) ṡ + m g, which swings about s = rest + m g/k.
pub(super) fn oscillator(world: &World, body: usize) -> Result<Part, String> {
    let Tie { kind, central, point } = tied(world, body)?;
    let Kind::Spring { rest, stiffness, damping } = kind else {
        return Err(format!("a {} on it, not a spring", kind.name().to_lowercase()));
    };
    if !central {
        return Err("a spring that holds it off its centre".into());
    }
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

/// A mass on a rod, or a disc on a pin off its centre: the same motion with the length (I + m d²)/(m d), d from pin to centre
/// (Huygens' compound pendulum).
pub(super) fn pendulum(world: &World, body: usize) -> Result<Part, String> {
    refuse_drag(world)?;
    let Tie { kind, central, point: pivot } = tied(world, body)?;
    let (bodies, gravity) = (world.bodies(), world.gravity().length());
    let offset = bodies.position[body] - pivot;
    let arm = offset.length();
    let length = match kind {
        Kind::Rod { length } if central && (arm - length).abs() <= 1e-9 * length => length,
        Kind::Rod { .. } => return Err("a rod that starts stretched, or holds it off its centre".into()),
        Kind::Pin if arm > 0.0 && !central => arm + 0.5 * bodies.radius[body] * bodies.radius[body] / arm,
        kind => return Err(format!("a {} on it, neither a rod nor a pin off its centre", kind.name().to_lowercase())),
    };
    let turns = bodies.spin(body).is_some_and(|spin| spin.omega != 0.0);
    if bodies.velocity[body] != DVec2::ZERO || turns && kind == Kind::Pin {
        return Err("a velocity at the start".into());
    }
    if !(gravity > 0.0) {
        return Err("no gravity".into());
    }
    let down = world.gravity() / gravity;
    let amplitude = libm::atan2(offset.dot(down.perp()), offset.dot(down));
    // Straight up it balances for as long as rounding lets it.
    if amplitude.abs() > PI - 1e-3 {
        return Err("a rod that stands upright".into());
    }
    let arm = if kind == Kind::Pin { arm } else { length };
    Ok(Part::Pendulum { body, pivot, down, arm, pendulum: Pendulum { length, gravity, amplitude } })
}
