//! Takes an edit back in a world that has moved on: what the edit changed is undone, everything else stays where it is now.

use super::edit::with_changes;
use crate::engine::constraint::WORLD;
use crate::engine::{Body, Contact, Id, Motion, Touching, World};
use std::collections::BTreeSet;

/// The world `now` without the change that led from `before` to `after`; `now` has come from `after` by moving alone. Time goes
/// on, and so does every body but for the properties that the change concerned. What the change has torn is put together as
/// it was: a link that comes back, and all that hangs together by it, would otherwise join what is far apart.
///
/// `without(after, before, now)` makes the change again.
pub fn without(before: &World, after: &World, now: &World) -> World {
    if now == after {
        return before.clone();
    }
    let torn = torn(before, after);
    let mut world = before.clone();
    let bodies: Vec<(Id, Body)> = before
        .bodies()
        .iter()
        .enumerate()
        .map(|(index, (id, own))| {
            let moved = after.bodies().index_of(id).zip(now.bodies().index_of(id)).filter(|_| !torn[index]);
            let Some((from, here)) = moved else { return (id, own) };
            (id, with_changes(now.bodies().get(here), &after.bodies().get(from), &own))
        })
        .collect();
    world.bodies.rebuild(bodies.into_iter());
    (world.tick, world.time, world.epoch) = (now.tick, now.time, now.epoch);
    for index in 0..before.constraints().len() {
        if let Some(here) = now.constraints().index_of(before.constraints().id[index]) {
            world.constraints.force[index] = now.constraints.force[here];
            world.constraints.carried[index] = now.constraints.carried[here];
        }
    }
    world.contacts = now.contacts().iter().filter_map(|contact| renumbered(contact, now, before)).collect();
    // A plan that was made for the old world is not that of this one, although they have the same bodies.
    world.set_gravity(before.gravity()).expect("it was accepted before");
    world
}

/// By body of `before`: whether it hangs together with a body or a link that `after` has no more.
fn torn(before: &World, after: &World) -> Vec<bool> {
    let (bodies, links) = (before.bodies(), before.constraints());
    let lost: BTreeSet<Id> =
        links.id.iter().copied().filter(|id| after.constraints().index_of(*id).is_none()).collect();
    let holds = |body: u32| body != WORLD && bodies.motion[body as usize] != Motion::Static;
    let mut joined: Vec<Vec<usize>> = vec![Vec::new(); bodies.len()];
    let mut torn = vec![false; bodies.len()];
    let mut front = Vec::new();
    for index in 0..links.len() {
        let ends = [links.a[index], links.b[index]];
        let held: Vec<usize> = ends.into_iter().filter(|body| holds(*body)).map(|body| body as usize).collect();
        if let [a, b] = held[..] {
            joined[a].push(b);
            joined[b].push(a);
        }
        if lost.contains(&links.id[index]) {
            front.extend(held);
        }
    }
    while let Some(body) = front.pop() {
        if !std::mem::replace(&mut torn[body], true) {
            front.extend(&joined[body]);
        }
    }
    torn
}

/// A contact of `from` by the indices of `to`, if both have what touches there.
fn renumbered(contact: &Contact, from: &World, to: &World) -> Option<Contact> {
    let body = |index: u32| to.bodies().index_of(from.bodies().id[index as usize]).map(|index| index as u32);
    let wall =
        |index: u32| to.wall_ids().binary_search(&from.wall_ids()[index as usize]).ok().map(|index| index as u32);
    let b = match contact.b {
        Touching::Body(index) => Touching::Body(body(index)?),
        Touching::Wall(index) => Touching::Wall(wall(index)?),
    };
    Some(Contact { a: body(contact.a)?, b, ..*contact })
}
