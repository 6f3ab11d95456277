//! Cuts a world into the groups of bodies that constraints hold together.

use crate::engine::constraint::WORLD;
use crate::engine::world::World;

/// Dynamic bodies that hang together, and their constraints; dense indices, ascending.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Group {
    /// Dense indices of the bodies that can move, ascending.
    pub bodies: Vec<u32>,
    /// Dense indices of its constraints.
    pub constraints: Vec<u32>,
}

/// All groups that hold constraints, in the order of their first bodies, then all free bodies as one last group.
/// Constraints between immovable ends belong to none.
pub(crate) fn partition(world: &World) -> Vec<Group> {
    let mut roots = Roots((0..world.bodies.len() as u32).collect());
    let c = &world.constraints;
    let dynamic = |end: u32| end != WORLD && world.bodies.inverse_mass[end as usize] > 0.0;
    for i in 0..c.len() {
        if dynamic(c.a[i]) && dynamic(c.b[i]) {
            roots.join(c.a[i], c.b[i]);
        }
    }
    let mut constrained = vec![false; world.bodies.len()];
    for end in c.a.iter().chain(&c.b).filter(|end| dynamic(**end)) {
        constrained[*end as usize] = true;
    }
    let mut group_of = vec![WORLD; world.bodies.len()];
    let mut groups: Vec<Group> = Vec::new();
    let mut free = Group::default();
    for body in (0..world.bodies.len() as u32).filter(|body| dynamic(*body)) {
        if !constrained[body as usize] {
            free.bodies.push(body);
            continue;
        }
        let root = roots.find(body) as usize;
        if group_of[root] == WORLD {
            group_of[root] = groups.len() as u32;
            groups.push(Group::default());
        }
        groups[group_of[root] as usize].bodies.push(body);
    }
    for i in 0..c.len() {
        if let Some(end) = [c.a[i], c.b[i]].into_iter().find(|end| dynamic(*end)) {
            let root = roots.find(end) as usize;
            groups[group_of[root] as usize].constraints.push(i as u32);
        }
    }
    if !free.bodies.is_empty() {
        groups.push(free);
    }
    groups
}

/// Disjoint sets; a set is named by its smallest member, so the outcome does not depend on the order of joining.
struct Roots(Vec<u32>);

impl Roots {
    fn find(&mut self, mut i: u32) -> u32 {
        while self.0[i as usize] != i {
            // Path halving (Tarjan and van Leeuwen 1984).
            self.0[i as usize] = self.0[self.0[i as usize] as usize];
            i = self.0[i as usize];
        }
        i
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}
