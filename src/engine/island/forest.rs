//! The trees that an island is made of, where rods and springs close no loops but for one more rod to a fixed point, as at the
//! far end of a bridge.

use super::System;

/// No index.
pub(crate) const NONE: u32 = u32::MAX;

/// What holds a node to its parent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum Join {
    /// Nothing, or springs.
    #[default]
    Free,
    Rod,
    Pin,
}

/// A constraint beside the springs, by the node's link.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Tie {
    pub join: Join,
    /// Index of the rod or pin.
    pub index: u32,
}

/// Where a spring acts: along the link of `at`, or between `at` and a fixed node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpringPlace {
    pub spring: u32,
    pub at: u32,
    /// The fixed node at its other end, or none if it lies along the link.
    pub ground: u32,
}

/// A rod from a node to a fixed one that is no link of a tree.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Closing {
    pub rod: u32,
    pub at: u32,
    pub ground: u32,
}

/// The nodes that move, parents first; all lists are by place in this order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Forest {
    /// Of the island.
    pub node: Vec<u32>,
    /// Place of the parent, or none if it is fixed or there is none.
    pub parent: Vec<u32>,
    /// Node of the island at the other end of the link, or none.
    pub parent_node: Vec<u32>,
    pub tie: Vec<Tie>,
    pub springs: Vec<SpringPlace>,
    pub closing: Option<Closing>,
    /// Some node has children that do not come right after it.
    pub branched: bool,
}

/// The other end of an edge of the island's graph, and what it is.
#[derive(Clone, Copy)]
struct Edge {
    to: u32,
    tie: Tie,
}

impl Forest {
    /// The trees of an island, or none if rods or springs close loops.
    pub fn new(system: &System) -> Option<Forest> {
        let edges = edges(system);
        let mut forest = Forest::default();
        let mut place = vec![NONE; system.nodes.len()];
        let movable = |node: u32| system.nodes.w[node as usize] > 0.0;
        let anchored = |node: &u32| edges[*node as usize].iter().any(|e| !movable(e.to) && e.tie.join != Join::Free);
        let nodes = || (0..system.nodes.len() as u32).filter(|node| movable(*node));
        let end = |node: &u32| edges[*node as usize].len() <= 1;
        // Roots by preference: held by a fixed point, the end of a chain, any.
        for root in nodes().filter(anchored).chain(nodes().filter(end)).chain(nodes()) {
            if place[root as usize] == NONE {
                forest.grow(system, &edges, root, &mut place)?;
            }
        }
        forest.place_springs(system, &place);
        let follows = |(t, parent): (usize, &u32)| *parent == NONE || *parent as usize + 1 == t;
        forest.branched = !forest.parent.iter().enumerate().all(follows);
        Some(forest)
    }

    /// Number of nodes that move.
    pub fn len(&self) -> usize {
        self.node.len()
    }

    /// Adds the component of `root`.
    fn grow(&mut self, system: &System, edges: &[Vec<Edge>], root: u32, place: &mut [u32]) -> Option<()> {
        let movable = |node: u32| system.nodes.w[node as usize] > 0.0;
        let mut stack = vec![(root, NONE, Tie::default())];
        let mut rooted = false;
        while let Some((node, from, tie)) = stack.pop() {
            let at = self.node.len() as u32;
            if place[node as usize] != NONE {
                return None;
            }
            place[node as usize] = at;
            self.node.push(node);
            self.parent_node.push(from);
            self.tie.push(tie);
            self.parent.push(if from == NONE { NONE } else { place[from as usize] });
            let mut seen_parent = from == NONE;
            for edge in &edges[node as usize] {
                if movable(edge.to) {
                    if edge.to == from && !seen_parent {
                        seen_parent = true;
                        continue;
                    }
                    if place[edge.to as usize] != NONE {
                        return None;
                    }
                    stack.push((edge.to, node, edge.tie));
                } else if edge.tie.join != Join::Free {
                    if node == root && !rooted {
                        rooted = true;
                        self.parent_node[at as usize] = edge.to;
                        self.tie[at as usize] = edge.tie;
                    } else if edge.tie.join == Join::Rod && self.closing.is_none() {
                        self.closing = Some(Closing { rod: edge.tie.index, at, ground: edge.to });
                    } else {
                        return None;
                    }
                }
            }
        }
        Some(())
    }

    fn place_springs(&mut self, system: &System, place: &[u32]) {
        for (spring, (a, b)) in system.springs.a.iter().zip(&system.springs.b).enumerate() {
            let (pa, pb) = (place[*a as usize], place[*b as usize]);
            let (at, ground) = match (pa, pb) {
                (NONE, NONE) => continue,
                (at, NONE) => (at, *b),
                (NONE, at) => (at, *a),
                (pa, pb) => (pa.max(pb), NONE),
            };
            self.springs.push(SpringPlace { spring: spring as u32, at, ground });
        }
    }
}

/// By node, what joins it to which others: one edge for all springs and the rod or pin that lie between the same two nodes, but
/// two for two rods.
fn edges(system: &System) -> Vec<Vec<Edge>> {
    let mut edges: Vec<Vec<Edge>> = vec![Vec::new(); system.nodes.len()];
    let mut add = |a: u32, b: u32, tie: Tie| {
        for (from, to) in [(a, b), (b, a)] {
            let known = edges[from as usize].iter().any(|edge| edge.to == to);
            if tie.join != Join::Free || !known {
                edges[from as usize].push(Edge { to, tie });
            }
        }
    };
    for (index, (a, b)) in system.rods.a.iter().zip(&system.rods.b).enumerate() {
        add(*a, *b, Tie { join: Join::Rod, index: index as u32 });
    }
    for (index, (a, b)) in system.pins.a.iter().zip(&system.pins.b).enumerate() {
        add(*a, *b, Tie { join: Join::Pin, index: index as u32 });
    }
    for (a, b) in system.springs.a.iter().zip(&system.springs.b) {
        add(*a, *b, Tie::default());
    }
    edges
}
