//! What cloth and net share: nodes in columns and rows, some of them fixed, joined to their neighbours.

use super::super::error::Fault;
use crate::engine::{Body, Constraint, DVec2, Id, Kind, Motion, World};
use serde::{Deserialize, Serialize};

/// Which nodes of a grid are fixed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Pins {
    None,
    /// The two upper corners.
    #[default]
    Corners,
    /// The whole top row.
    Top,
    /// So many nodes in the middle of the top row.
    TopCentre(u32),
}

impl Pins {
    fn holds(self, column: u32, row: u32, columns: u32) -> bool {
        row == 0
            && match self {
                Pins::None => false,
                Pins::Corners => column == 0 || column + 1 == columns,
                Pins::Top => true,
                Pins::TopCentre(count) => {
                    let first = columns.saturating_sub(count) / 2;
                    (first..first.saturating_add(count)).contains(&column)
                }
            }
    }
}

/// A rectangular grid, hanging down from its upper left corner.
pub(super) struct Grid {
    pub corner: DVec2,
    pub columns: u32,
    pub rows: u32,
    pub spacing: f64,
    pub pins: Pins,
}

impl Grid {
    /// Adds the nodes, row by row from the top, each like `node`.
    pub(super) fn add_nodes(&self, world: &mut World, node: &Body) -> Result<Vec<Id>, Fault> {
        let mut ids = Vec::new();
        for row in 0..self.rows {
            for column in 0..self.columns {
                let pinned = self.pins.holds(column, row, self.columns);
                let offset = DVec2::new(f64::from(column), -f64::from(row)) * self.spacing;
                let motion = if pinned { Motion::Static } else { Motion::Dynamic };
                ids.push(world.add_body(&Body { motion, position: self.corner + offset, ..*node })?);
            }
        }
        Ok(ids)
    }

    /// Joins every node to the one `right` columns and `down` rows further, where there is one.
    pub(super) fn join(
        &self,
        world: &mut World,
        nodes: &[Id],
        [right, down]: [i64; 2],
        kind: impl Fn(f64) -> Kind,
    ) -> Result<(), Fault> {
        let (columns, rows) = (i64::from(self.columns), i64::from(self.rows));
        let length = DVec2::new(right as f64, down as f64).length() * self.spacing;
        for row in 0..rows - down {
            for column in 0.max(-right)..columns.min(columns - right) {
                let from = (row * columns + column) as usize;
                let to = ((row + down) * columns + column + right) as usize;
                world.add_constraint(&Constraint::between(kind(length), nodes[from], nodes[to]))?;
            }
        }
        Ok(())
    }
}
