//! A rope bridge: a sagging deck between two fixed ends.

use super::super::error::Fault;
use super::rope::add_chain;
use super::{Generate, Layout, Link, check_point, check_range};
use crate::engine::{Body, DVec2, Motion, World};
use serde::{Deserialize, Serialize};

/// A deck of `links` links, hence nodes `name.0` … `name.links`, the first and the last fixed by default. It hangs in a parabola, which
/// is its shape at rest: equal weights at equal horizontal distances. Its nodes do not touch each other. Banks are flush with
/// it at a node's radius above its ends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Bridge {
    /// By which constraints refer to its nodes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Left end [m].
    pub from: DVec2,
    /// Right end [m].
    pub to: DVec2,
    /// Number of links, 2 … 1e6.
    pub links: u32,
    /// What joins one node to the next.
    pub link: Link,
    /// Whether the first node is fixed.
    pub pin_start: bool,
    /// Whether the last node is fixed.
    pub pin_end: bool,
    /// How far the middle hangs below the straight line [m].
    pub sag: f64,
    /// Mass of a node [kg].
    pub mass: f64,
    /// Radius of a node [m]; if not given 0.6 of the distance between two, so that nothing falls through.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius: Option<f64>,
    /// Coefficient of friction of the nodes, ≥ 0.
    pub friction: f64,
    /// Coefficient of restitution of the nodes, 0 … 1.
    pub restitution: f64,
}

impl Default for Bridge {
    fn default() -> Self {
        Bridge {
            name: None,
            from: DVec2::new(-4.0, 0.0),
            to: DVec2::new(4.0, 0.0),
            links: 40,
            link: Link::Rod,
            pin_start: true,
            pin_end: true,
            sag: 0.5,
            mass: 1.0,
            radius: None,
            friction: 0.5,
            restitution: 0.0,
        }
    }
}

impl Generate for Bridge {
    fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    fn layout(&self) -> Layout {
        Layout::Line(self.links as usize + 1)
    }

    fn check(&self) -> Result<(), Fault> {
        check_point("from", self.from)?;
        check_point("to", self.to)?;
        check_range("links", f64::from(self.links), [2.0, 1e6], "")?;
        check_range("sag", self.sag, [0.0, 1e6], "m")
    }

    fn build(&self, world: &mut World, group: u32) -> Result<(), Fault> {
        let spacing = (self.to - self.from).length() / f64::from(self.links);
        let nodes = (0..=self.links).map(|i| {
            let t = f64::from(i) / f64::from(self.links);
            let drop = DVec2::new(0.0, -4.0 * self.sag * t * (1.0 - t));
            let pinned = (i == 0 && self.pin_start) || (i == self.links && self.pin_end);
            Body {
                motion: if pinned { Motion::Static } else { Motion::Dynamic },
                position: self.from + (self.to - self.from) * t + drop,
                mass: self.mass,
                radius: self.radius.unwrap_or(0.6 * spacing),
                friction: self.friction,
                restitution: self.restitution,
                group,
                ..Body::default()
            }
        });
        add_chain(world, nodes, self.link)
    }
}
