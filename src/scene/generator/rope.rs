//! A rope: nodes on a straight line, each joined to the next.

use super::super::error::Fault;
use super::{Generate, Layout, Link, check_point, check_range};
use crate::engine::{Body, Constraint, DVec2, Id, Motion, World};
use serde::{Deserialize, Serialize};

/// A rope of `links` links, hence `links + 1` nodes `name.0` … `name.links`. Its nodes do not touch each other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Rope {
    /// By which constraints refer to its nodes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// First node [m].
    pub from: DVec2,
    /// Last node [m].
    pub to: DVec2,
    /// Number of links, 1 … 1e6.
    pub links: u32,
    /// What joins one node to the next.
    pub link: Link,
    /// Mass of a node [kg].
    pub mass: f64,
    /// Radius of a node [m].
    pub radius: f64,
    /// Whether the first node is fixed.
    pub pin_start: bool,
    /// Whether the last node is fixed.
    pub pin_end: bool,
    /// Mass of the last node [kg], if it is to differ: a heavy ball.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end_mass: Option<f64>,
    /// Radius of the last node [m], if it is to differ.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end_radius: Option<f64>,
    /// Whether it can touch other things.
    pub collides: bool,
}

impl Default for Rope {
    fn default() -> Self {
        Rope {
            name: None,
            from: DVec2::ZERO,
            to: DVec2::new(2.0, 0.0),
            links: 20,
            link: Link::Rod,
            mass: 0.1,
            radius: 0.04,
            pin_start: true,
            pin_end: false,
            end_mass: None,
            end_radius: None,
            collides: true,
        }
    }
}

impl Generate for Rope {
    fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    fn layout(&self) -> Layout {
        Layout::Line(self.links as usize + 1)
    }

    fn check(&self) -> Result<(), Fault> {
        check_point("from", self.from)?;
        check_point("to", self.to)?;
        check_range("links", f64::from(self.links), [1.0, 1e6], "")
    }

    fn build(&self, world: &mut World, group: u32) -> Result<(), Fault> {
        let last = self.links;
        let nodes = (0..=last).map(|i| {
            let pinned = (i == 0 && self.pin_start) || (i == last && self.pin_end);
            let end = i == last;
            Body {
                motion: if pinned { Motion::Static } else { Motion::Dynamic },
                position: self.from + (self.to - self.from) * (f64::from(i) / f64::from(last)),
                mass: self.end_mass.filter(|_| end).unwrap_or(self.mass),
                radius: self.end_radius.filter(|_| end).unwrap_or(self.radius),
                collides: self.collides,
                group,
                ..Body::default()
            }
        });
        add_chain(world, nodes, self.link)
    }
}

/// Adds nodes and a link from each to the next.
pub(super) fn add_chain(world: &mut World, nodes: impl Iterator<Item = Body>, link: Link) -> Result<(), Fault> {
    let mut chain: Vec<(Id, DVec2)> = Vec::new();
    for node in nodes {
        chain.push((world.add_body(&node)?, node.position));
    }
    for pair in chain.windows(2) {
        let distance = (pair[1].1 - pair[0].1).length();
        world.add_constraint(&Constraint::between(link.over(distance), pair[0].0, pair[1].0))?;
    }
    Ok(())
}
