//! A net: a grid of particles joined by rods (or ropes, or springs), with diagonals or without.

use super::super::error::Fault;
use super::grid::Grid;
use super::{Generate, Layout, Link, Pins, check_point, check_range};
use crate::engine::{Body, DVec2, World};
use serde::{Deserialize, Serialize};

/// `columns × rows` nodes `name.column.row`, the row 0 at the top. Its nodes do not touch each other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Net {
    /// By which constraints refer to its nodes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Upper left node [m].
    pub corner: DVec2,
    /// Nodes in a row, 1 … 1e6.
    pub columns: u32,
    /// Nodes in a column, 1 … 1e6.
    pub rows: u32,
    /// Distance of neighbours [m].
    pub spacing: f64,
    /// Distance between the two ends of a row [m], if the rows are to hang in circular arcs, at most half circles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub chord: Option<f64>,
    /// What joins a node to its neighbours.
    pub link: Link,
    /// Whether the diagonals of every mesh are joined too, at the length that they are built with.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub braced: bool,
    /// Which nodes are fixed.
    pub pins: Pins,
    /// Mass of a node [kg].
    pub mass: f64,
    /// Radius of a node [m].
    pub radius: f64,
    /// Whether it can touch other things.
    pub collides: bool,
}

impl Default for Net {
    fn default() -> Self {
        Net {
            name: None,
            corner: DVec2::ZERO,
            columns: 12,
            rows: 8,
            spacing: 0.25,
            chord: None,
            link: Link::Rod,
            braced: false,
            pins: Pins::Corners,
            mass: 0.05,
            radius: 0.04,
            collides: true,
        }
    }
}

impl Generate for Net {
    fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    fn layout(&self) -> Layout {
        Layout::Grid { columns: self.columns as usize, rows: self.rows as usize }
    }

    fn check(&self) -> Result<(), Fault> {
        check_point("corner", self.corner)?;
        check_range("columns", f64::from(self.columns), [1.0, 1e6], "")?;
        check_range("rows", f64::from(self.rows), [1.0, 1e6], "")?;
        check_range("spacing", self.spacing, [1e-9, 1e6], "m")?;
        let Some(chord) = self.chord else { return Ok(()) };
        let links = f64::from(self.columns.max(2) - 1);
        let half_circle = self.spacing / libm::sin(std::f64::consts::FRAC_PI_2 / links);
        check_range("chord", chord, [half_circle, links * self.spacing], "m")
    }

    fn build(&self, world: &mut World, group: u32) -> Result<(), Fault> {
        let Net { corner, columns, rows, spacing, chord, pins, .. } = *self;
        let grid = Grid { corner, columns, rows, spacing, chord, pins };
        let node = Body { mass: self.mass, radius: self.radius, collides: self.collides, group, ..Body::default() };
        let nodes = grid.add_nodes(world, &node)?;
        grid.join(world, &nodes, [1, 0], |length| self.link.over(length))?;
        grid.join(world, &nodes, [0, 1], |length| self.link.over(length))?;
        if self.braced {
            grid.brace(world, &nodes, |length| self.link.over(length))?;
        }
        Ok(())
    }
}
