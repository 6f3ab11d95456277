//! Narrow phase: which candidates touch or will touch in this substep, where, and along which normal.
//!
//! A pair that moves little against each other is judged where it stands. One that moves by more than a part of its size
//! is judged where it first meets along its path, so that nothing is jumped over: the gap is then the path's length along
//! the normal found there.

use super::BroadPhase;
use super::sweep::{disc_hits_disc, disc_hits_wall};
use crate::engine::collide::broad::MARGIN;
use crate::engine::plan::Plan;
use crate::engine::state::State;
use crate::engine::world::{Contact, Touching, World};
use glam::DVec2;

/// Relative motion in a substep, as a part of the smaller radius, from which on the path is followed.
const FAST: f64 = 0.25;
/// A wall goes on in another one where that is no farther than this part of the radius of the body that touches there.
const JOINED: f64 = 1e-6;

/// Fills `contacts` with the contacts of this substep: bodies with bodies, then bodies with walls, each ascending by
/// (a, b). Returns the number of pairs looked at. Forces of contacts that `old` already had are carried over.
pub(crate) fn find_contacts(
    world: &World,
    plan: &Plan,
    broad: &BroadPhase,
    state: &State,
    h: f64,
    old: &[Contact],
    contacts: &mut Vec<Contact>,
) -> usize {
    contacts.clear();
    let narrow = Narrow { world, state, h };
    let slow = |body: &u32| !broad.is_fast[*body as usize];
    for (a, b) in broad.pairs.iter().filter(|(a, b)| slow(a) && slow(b)) {
        contacts.extend(narrow.discs(*a, *b));
    }
    let of_bodies = contacts.len();
    for near in broad.walls.chunk_by(|one, next| one.0 == next.0).filter(|near| slow(&near[0].0)) {
        let walls = near.iter().map(|(_, wall)| *wall);
        contacts.extend(near.iter().filter_map(|(a, wall)| narrow.wall(*a, *wall, walls.clone())));
    }
    let mut looked_at = broad.pairs.len() + broad.walls.len();
    for fast in &broad.fast {
        looked_at += narrow.of_fast(plan, broad, *fast, contacts);
    }
    if !broad.fast.is_empty() {
        contacts.sort_unstable_by_key(key);
    }
    debug_assert!(of_bodies <= contacts.len() && contacts.is_sorted_by_key(key));
    carry_forces(old, contacts);
    looked_at
}

struct Narrow<'a> {
    world: &'a World,
    state: &'a State,
    h: f64,
}

impl Narrow<'_> {
    /// The contacts of a body that outruns the lists.
    fn of_fast(&self, plan: &Plan, broad: &BroadPhase, fast: u32, contacts: &mut Vec<Contact>) -> usize {
        let i = fast as usize;
        let (from, path) = (self.state.position[i], self.h * self.state.velocity[i]);
        // Another body moves by no more than its room, or is fast itself.
        let reach = self.world.bodies.radius[i] * (1.0 + MARGIN);
        let mut looked_at = self.world.walls.len();
        let mut try_with = |other: u32| {
            looked_at += 1;
            if self.world.bodies.may_touch(&plan.joined, fast, other) {
                contacts.extend(self.discs(fast.min(other), fast.max(other)));
            }
        };
        broad.near(from.min(from + path), from.max(from + path), reach, &mut try_with);
        broad.fast.iter().copied().filter(|other| *other > fast).for_each(try_with);
        if self.world.bodies.may_touch_walls(fast as usize) {
            let walls = 0..self.world.walls.len() as u32;
            contacts.extend(walls.clone().filter_map(|wall| self.wall(fast, wall, walls.clone())));
        }
        looked_at
    }

    fn discs(&self, a: u32, b: u32) -> Option<Contact> {
        let (i, j) = (a as usize, b as usize);
        let (radius_a, radius_b) = (self.world.bodies.radius[i], self.world.bodies.radius[j]);
        let offset = self.state.position[i] - self.state.position[j];
        let path = self.h * (self.state.velocity[i] - self.state.velocity[j]);
        let distance = offset.length();
        // Coinciding centres have no direction; any fixed one lets them part again.
        let normal = if distance > 0.0 { offset / distance } else { DVec2::Y };
        let smaller = radius_a.min(radius_b);
        let here = (normal, distance - radius_a - radius_b);
        let Meeting { normal, gap, .. } =
            judge(here, path, smaller, || disc_hits_disc(offset, path, radius_a + radius_b))?;
        if self.state.inverse_mass[i] == 0.0 && self.state.inverse_mass[j] == 0.0 {
            // Both are carried elsewhere in this step.
            return None;
        }
        let point = self.state.position[j] + normal * (radius_b + 0.5 * gap);
        Some(contact(a, Touching::Body(b), point, normal, gap))
    }

    /// The contact of a body with a wall, if it is not one with a seam between walls; `near` are those it may be joined to.
    fn wall(&self, a: u32, wall: u32, near: impl Iterator<Item = u32>) -> Option<Contact> {
        let i = a as usize;
        let (position, radius) = (self.state.position[i], self.world.bodies.radius[i]);
        let path = self.h * self.state.velocity[i];
        let shape = &self.world.walls[wall as usize].shape;
        let (distance, normal) = shape.distance(position);
        let Meeting { normal, gap, fraction } =
            judge((normal, distance - radius), path, radius, || disc_hits_wall(shape, position, path, radius))?;
        if self.state.inverse_mass[i] == 0.0 || self.meets_seam(wall, near, position + fraction * path, radius) {
            return None;
        }
        Some(contact(a, Touching::Wall(wall), position - normal * (radius + 0.5 * gap), normal, gap))
    }

    /// Whether the disc at `centre` comes to `wall` only where another wall goes on that is nearer: the seams of a floor made
    /// of pieces would else hold up what slides over them.
    fn meets_seam(&self, wall: u32, near: impl Iterator<Item = u32>, centre: DVec2, radius: f64) -> bool {
        let shape = |wall: u32| &self.world.walls[wall as usize].shape;
        let (distance, normal) = shape(wall).distance(centre);
        let foot = centre - distance * normal;
        near.filter(|other| *other != wall)
            .any(|other| shape(other).distance(foot).0 <= JOINED * radius && shape(other).distance(centre).0 < distance)
    }
}

/// Where two shapes touch, nearly touch, or meet.
struct Meeting {
    normal: DVec2,
    /// [m]
    gap: f64,
    /// Part of the path after which this is so.
    fraction: f64,
}

/// How a pair touches, nearly touches, or meets along `path` (the motion of the first against the second).
fn judge(
    (normal, gap): (DVec2, f64),
    path: DVec2,
    smaller_radius: f64,
    first_hit: impl Fn() -> Option<(DVec2, f64)>,
) -> Option<Meeting> {
    let margin = MARGIN * smaller_radius;
    let fast = path.length_squared() > (FAST * smaller_radius) * (FAST * smaller_radius);
    if fast
        && gap > 0.0
        && let Some((normal, fraction)) = first_hit()
    {
        return Some(Meeting { normal, gap: (-path.dot(normal) * fraction).max(0.0), fraction });
    }
    let closing = if fast { 0.0 } else { -path.dot(normal) };
    (gap < margin + closing.max(0.0)).then_some(Meeting { normal, gap, fraction: 0.0 })
}

fn contact(a: u32, b: Touching, point: DVec2, normal: DVec2, gap: f64) -> Contact {
    Contact { a, b, point, normal, gap, normal_force: 0.0, tangent_force: 0.0 }
}

/// The order of contacts: bodies first, then walls; within each by (a, b).
fn key(contact: &Contact) -> (bool, u32, u32) {
    match contact.b {
        Touching::Body(b) => (false, contact.a, b),
        Touching::Wall(wall) => (true, contact.a, wall),
    }
}

/// Both lists are in order, so one pass finds the pairs that were there before.
fn carry_forces(old: &[Contact], contacts: &mut [Contact]) {
    let mut known = old.iter().peekable();
    for contact in contacts {
        while known.next_if(|known| key(known) < key(contact)).is_some() {}
        if let Some(known) = known.peek().filter(|known| key(known) == key(contact)) {
            contact.normal_force = known.normal_force;
            contact.tangent_force = known.tangent_force;
        }
    }
}
