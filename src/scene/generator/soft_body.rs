//! A soft body: a ring of particles and springs that keeps its shape.

use super::super::error::Fault;
use super::{Generate, Layout, check_point, check_range};
use crate::engine::{Body, Constraint, DVec2, Id, Kind, World};
use serde::{Deserialize, Serialize};

/// What keeps the ring open.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Filling {
    /// Springs across to the opposite side and to the third points, which act like the pressure in a tyre.
    #[default]
    Tyre,
    /// The same and a node in the middle with spokes: stiffer.
    Wheel,
}

/// `nodes` nodes `name.0` … on a circle, counter-clockwise from the right; with [`Filling::Wheel`] the hub is the last one,
/// `name.nodes`. Its nodes do not touch each other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SoftBody {
    /// By which constraints refer to its nodes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Middle [m].
    pub centre: DVec2,
    /// [m/s]
    pub velocity: DVec2,
    /// From the middle to the nodes [m].
    pub radius: f64,
    /// Nodes on the circle, 6 … 1e6; the hub is not counted.
    pub nodes: u32,
    /// What keeps the ring open.
    pub filling: Filling,
    /// Of the springs along the ring [N/m]; those across have a quarter of it.
    pub stiffness: f64,
    /// Of every spring [N·s/m].
    pub damping: f64,
    /// Mass of the whole [kg].
    pub mass: f64,
    /// Radius of a node [m]; if not given 0.6 of the distance between two, so that nothing gets in.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub node_radius: Option<f64>,
    /// Coefficient of friction of the nodes, ≥ 0.
    pub friction: f64,
}

impl Default for SoftBody {
    fn default() -> Self {
        SoftBody {
            name: None,
            centre: DVec2::ZERO,
            velocity: DVec2::ZERO,
            radius: 0.6,
            nodes: 20,
            filling: Filling::Tyre,
            stiffness: 800.0,
            damping: 1.0,
            mass: 2.0,
            node_radius: None,
            friction: 0.5,
        }
    }
}

impl Generate for SoftBody {
    fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    fn layout(&self) -> Layout {
        Layout::Line(self.nodes as usize + usize::from(self.filling == Filling::Wheel))
    }

    fn check(&self) -> Result<(), Fault> {
        check_point("centre", self.centre)?;
        check_range("nodes", f64::from(self.nodes), [6.0, 1e6], "")?;
        check_range("radius", self.radius, [1e-6, 1e6], "m")
    }

    fn build(&self, world: &mut World, group: u32) -> Result<(), Fault> {
        let (ring, hub) = self.add_nodes(world, group)?;
        let count = self.nodes as usize;
        let across = 0.25 * self.stiffness;
        self.join(world, &ring, 1, count, self.stiffness)?;
        // A stiffer skin: every other node as well.
        self.join(world, &ring, 2, count, across)?;
        self.join(world, &ring, count / 3, count, across)?;
        self.join(world, &ring, count / 2, if count.is_multiple_of(2) { count / 2 } else { count }, across)?;
        for &node in hub.iter().flat_map(|_| &ring) {
            self.spring(world, node, hub.expect("the loop runs only if there is a hub"), self.stiffness)?;
        }
        Ok(())
    }
}

/// A node and where it is [m].
type Node = (Id, DVec2);

impl SoftBody {
    fn add_nodes(&self, world: &mut World, group: u32) -> Result<(Vec<Node>, Option<Node>), Fault> {
        let turn = std::f64::consts::TAU / f64::from(self.nodes);
        let spacing = 2.0 * self.radius * libm::sin(turn / 2.0);
        let node = Body {
            velocity: self.velocity,
            mass: self.mass / self.layout_len(),
            radius: self.node_radius.unwrap_or(0.6 * spacing),
            friction: self.friction,
            group,
            ..Body::default()
        };
        let mut add = |position: DVec2| world.add_body(&Body { position, ..node }).map(|id| (id, position));
        let mut ring = Vec::new();
        for i in 0..self.nodes {
            let (sin, cos) = libm::sincos(f64::from(i) * turn);
            ring.push(add(self.centre + DVec2::new(cos, sin) * self.radius)?);
        }
        let hub = if self.filling == Filling::Wheel { Some(add(self.centre)?) } else { None };
        Ok((ring, hub))
    }

    fn layout_len(&self) -> f64 {
        f64::from(self.nodes) + if self.filling == Filling::Wheel { 1.0 } else { 0.0 }
    }

    /// Joins the first `count` nodes to those `ahead` of them.
    fn join(&self, world: &mut World, ring: &[Node], ahead: usize, count: usize, stiffness: f64) -> Result<(), Fault> {
        for i in 0..count {
            self.spring(world, ring[i], ring[(i + ahead) % ring.len()], stiffness)?;
        }
        Ok(())
    }

    fn spring(&self, world: &mut World, a: Node, b: Node, stiffness: f64) -> Result<(), Fault> {
        let kind = Kind::Spring { rest: (b.1 - a.1).length(), stiffness, damping: self.damping };
        world.add_constraint(&Constraint::between(kind, a.0, b.0))?;
        Ok(())
    }
}
