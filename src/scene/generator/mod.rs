//! Generators: many bodies and constraints from one line of a scene. One file a generator.

mod bridge;
mod cloth;
mod cradle;
mod grid;
mod link;
mod net;
mod pile;
mod rope;
mod soft_body;
mod stack;

pub use bridge::Bridge;
pub use cloth::Cloth;
pub use cradle::Cradle;
pub use grid::Pins;
pub use link::Link;
pub use net::Net;
pub use pile::Pile;
pub use rope::Rope;
pub use soft_body::{Filling, SoftBody};
pub use stack::Stack;

use super::build::MOST_BODIES;
use super::error::{Fault, SceneError};
pub use super::names::Layout;
use crate::engine::{DVec2, Id, World};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// A generator with its parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Generator {
    /// Nodes on a straight line, each joined to the next.
    Rope(Rope),
    /// A sagging deck between two fixed ends.
    Bridge(Bridge),
    /// A grid of particles joined by springs.
    Cloth(Cloth),
    /// A ring of particles and springs that keeps its shape.
    SoftBody(SoftBody),
    /// A grid of particles joined by rods, ropes or springs.
    Net(Net),
    /// Discs standing on each other.
    Stack(Stack),
    /// Discs of random size strewn over a rectangle.
    Pile(Pile),
    /// Newton's cradle: equal balls in a row, each hanging on a rod.
    Cradle(Cradle),
}

/// What every generator can do.
trait Generate {
    /// The name by which constraints refer to its nodes.
    fn name(&self) -> Option<&str>;
    /// How its nodes are numbered, hence how many there are; parameters may still be wrong.
    fn layout(&self) -> Layout;
    /// Refuses parameters from which nothing sensible can be built.
    fn check(&self) -> Result<(), Fault>;
    /// Adds its bodies, in the order of its layout, and its constraints. `group` is a collision group that no body has
    /// yet, for bodies that do not touch each other.
    fn build(&self, world: &mut World, group: u32) -> Result<(), Fault>;
}

impl Generator {
    fn kind(&self) -> &dyn Generate {
        match self {
            Generator::Rope(rope) => rope,
            Generator::Bridge(bridge) => bridge,
            Generator::Cloth(cloth) => cloth,
            Generator::SoftBody(soft_body) => soft_body,
            Generator::Net(net) => net,
            Generator::Stack(stack) => stack,
            Generator::Pile(pile) => pile,
            Generator::Cradle(cradle) => cradle,
        }
    }

    /// The name by which constraints refer to its nodes.
    pub fn name(&self) -> Option<&str> {
        self.kind().name()
    }

    /// Number of bodies that it makes.
    pub fn body_count(&self) -> u64 {
        match self.kind().layout() {
            Layout::Line(count) => count as u64,
            Layout::Grid { columns, rows } => (columns as u64).saturating_mul(rows as u64),
        }
    }

    /// Adds everything to a world and returns the new bodies, or leaves the world as it was.
    pub fn add_to(&self, world: &mut World) -> Result<Vec<Id>, SceneError> {
        let first = world.bodies().len();
        if self.body_count() > MOST_BODIES {
            return Err(Fault::value("count", self.body_count() as f64, format!("at most {MOST_BODIES} bodies")).into());
        }
        let built = self.build(world, &mut FreeGroups::default());
        let new = world.bodies().id[first..].to_vec();
        match built {
            Ok(_) => Ok(new),
            Err(fault) => {
                world.remove_bodies(&new);
                Err(fault.into())
            }
        }
    }

    /// Adds everything to a world whose growth `groups` has followed.
    pub(super) fn build(&self, world: &mut World, groups: &mut FreeGroups) -> Result<Layout, Fault> {
        self.kind().check()?;
        self.kind().build(world, groups.next(world))?;
        Ok(self.kind().layout())
    }
}

/// `Ok` if a parameter lies within a range; `unit` is empty for a count.
fn check_range(field: &'static str, value: f64, [low, high]: [f64; 2], unit: &str) -> Result<(), Fault> {
    if value >= low && value <= high {
        return Ok(());
    }
    let expected = format!("a value between {low} and {high} {unit}");
    Err(Fault::value(field, value, expected.trim_end()))
}

/// `Ok` if a point is one where bodies may be.
pub(super) fn check_point(field: &'static str, point: DVec2) -> Result<(), Fault> {
    match point.to_array().into_iter().find(|coordinate| !(coordinate.abs() <= 1e9)) {
        Some(coordinate) => Err(Fault::value(field, coordinate, "coordinates within 1e9 m")),
        None => Ok(()),
    }
}

/// The collision groups that nobody has in a world which only grows. All calls together take O(bodies log bodies).
#[derive(Default)]
pub(super) struct FreeGroups {
    /// Bodies whose groups are known.
    seen: usize,
    /// Groups of those, as far as they are above `taken`.
    used: BTreeSet<u32>,
    /// The groups 1 to this one are used.
    taken: u32,
}

impl FreeGroups {
    /// The smallest group from 1 that no body has.
    fn next(&mut self, world: &World) -> u32 {
        let groups = &world.bodies().group;
        self.used.extend(groups[self.seen..].iter().filter(|group| **group > self.taken));
        self.seen = groups.len();
        // There are fewer bodies than numbers, so the count never overflows.
        while self.used.remove(&(self.taken + 1)) {
            self.taken += 1;
        }
        self.taken + 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::Body;

    #[test]
    fn a_fresh_group_is_the_smallest_that_nobody_has() {
        let mut world = World::new();
        let mut groups = FreeGroups::default();
        assert_eq!(groups.next(&world), 1);
        for group in [u32::MAX, 0, 1, 2, 4, 2] {
            world.add_body(&Body { group, ..Body::default() }).expect("a sound body");
        }
        assert_eq!([groups.next(&world), FreeGroups::default().next(&world)], [3; 2]);
        for group in [3, 0, 4, 6] {
            world.add_body(&Body { group, ..Body::default() }).expect("a sound body");
        }
        assert_eq!([groups.next(&world), FreeGroups::default().next(&world)], [5; 2]);
    }

    #[test]
    fn a_generator_that_fails_leaves_the_world_as_it_was() {
        let mut world = World::new();
        let rope = Generator::Rope(Rope { mass: 1e13, ..Rope::default() });
        assert!(rope.add_to(&mut world).is_err());
        assert!(world.bodies().is_empty() && world.constraints().is_empty());
    }
}
