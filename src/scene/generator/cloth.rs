//! A cloth: a grid of particles joined by springs.

use super::super::error::Fault;
use super::grid::Grid;
use super::{Generate, Layout, Pins, check_point, check_range};
use crate::engine::{Body, DVec2, Kind, World};
use serde::{Deserialize, Serialize};

/// `columns × rows` nodes `name.column.row`, the row 0 at the top. Its nodes do not touch each other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Cloth {
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
    /// Of the springs along rows and columns [N/m]; the diagonal ones have half of it.
    pub stiffness: f64,
    /// Of every spring [N·s/m].
    pub damping: f64,
    /// Whether there are springs along both diagonals, which keep the cloth from shearing.
    pub diagonals: bool,
    /// Which nodes are fixed.
    pub pins: Pins,
    /// Mass of a node [kg].
    pub mass: f64,
    /// Radius of a node [m].
    pub radius: f64,
    /// Whether it can touch other things.
    pub collides: bool,
}

impl Default for Cloth {
    fn default() -> Self {
        Cloth {
            name: None,
            corner: DVec2::ZERO,
            columns: 20,
            rows: 20,
            spacing: 0.1,
            stiffness: 500.0,
            damping: 0.05,
            diagonals: true,
            pins: Pins::Corners,
            mass: 0.01,
            radius: 0.05,
            collides: true,
        }
    }
}

impl Generate for Cloth {
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
        check_range("spacing", self.spacing, [1e-9, 1e6], "m")
    }

    fn build(&self, world: &mut World, group: u32) -> Result<(), Fault> {
        let Cloth { corner, columns, rows, spacing, pins, stiffness, damping, .. } = *self;
        let grid = Grid { corner, columns, rows, spacing, chord: None, pins };
        let node = Body { mass: self.mass, radius: self.radius, collides: self.collides, group, ..Body::default() };
        let nodes = grid.add_nodes(world, &node)?;
        let thread = |rest| Kind::Spring { rest, stiffness, damping };
        let shear = |rest| Kind::Spring { rest, stiffness: 0.5 * stiffness, damping };
        grid.join(world, &nodes, [1, 0], thread)?;
        grid.join(world, &nodes, [0, 1], thread)?;
        if self.diagonals {
            grid.join(world, &nodes, [1, 1], shear)?;
            grid.join(world, &nodes, [-1, 1], shear)?;
        }
        Ok(())
    }
}
