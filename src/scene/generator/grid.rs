//! What cloth and net share: nodes in columns and rows, some of them fixed, joined to their neighbours.

use super::super::error::Fault;
use crate::engine::{Body, Constraint, DVec2, Id, Kind, Motion, World};
use serde::{Deserialize, Serialize};

/// Which nodes of a grid are fixed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Pins {
    /// All nodes are free: the grid falls.
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
    /// Distance between the ends of a row [m]; a row that is longer hangs in a circular arc.
    pub chord: Option<f64>,
    pub pins: Pins,
}

impl Grid {
    /// Adds the nodes, row by row from the top, each like `node`.
    pub(super) fn add_nodes(&self, world: &mut World, node: &Body) -> Result<Vec<Id>, Fault> {
        let mut ids = Vec::new();
        let along_row = self.row();
        for row in 0..self.rows {
            for column in 0..self.columns {
                let pinned = self.pins.holds(column, row, self.columns);
                let offset = along_row[column as usize] - DVec2::new(0.0, f64::from(row) * self.spacing);
                let motion = if pinned { Motion::Static } else { Motion::Dynamic };
                ids.push(world.add_body(&Body { motion, position: self.corner + offset, ..*node })?);
            }
        }
        Ok(ids)
    }

    /// The nodes of a row, from its first one [m].
    fn row(&self) -> Vec<DVec2> {
        let straight = (0..self.columns).map(|i| DVec2::new(f64::from(i) * self.spacing, 0.0)).collect();
        let links = f64::from(self.columns - 1);
        let Some(chord) = self.chord.filter(|chord| *chord < links * self.spacing) else { return straight };
        let half = half_angle(links, chord / self.spacing);
        let radius = 0.5 * self.spacing / libm::sin(half);
        let node = |i: u32| {
            let angle = (2.0 * f64::from(i) - links) * half;
            // cos(end) − cos(angle) as a product, which does not cancel
            let [sum, difference] = [links * half + angle, links * half - angle].map(|turn| libm::sin(0.5 * turn));
            // Half the chord is radius · sin(end): the last node is a chord from the first to the bit.
            let x = 0.5 * chord * (1.0 + libm::sin(angle) / libm::sin(links * half));
            DVec2::new(x, -2.0 * radius * sum * difference)
        };
        (0..self.columns).map(node).collect()
    }

    /// Joins the diagonals of every mesh, at the distances at which their nodes stand.
    pub(super) fn brace(&self, world: &mut World, nodes: &[Id], kind: impl Fn(f64) -> Kind) -> Result<(), Fault> {
        let (columns, rows) = (self.columns as usize, self.rows as usize);
        for corner in (0..rows - 1).flat_map(|row| (0..columns - 1).map(move |column| row * columns + column)) {
            for (a, b) in [(nodes[corner], nodes[corner + columns + 1]), (nodes[corner + 1], nodes[corner + columns])] {
                let at = |id: Id| world.bodies().index_of(id).map_or(DVec2::ZERO, |i| world.bodies().position[i]);
                let length = (at(b) - at(a)).length();
                world.add_constraint(&Constraint::between(kind(length), a, b))?;
            }
        }
        Ok(())
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

/// Half the angle that a link takes on the circle, where `links` of them in a row span `span` of their lengths:
/// sin(links · α) = span · sin α with 0 < α ≤ π / (2 · links). Bisection to the last bit; the left side falls behind the right.
fn half_angle(links: f64, span: f64) -> f64 {
    let [mut low, mut high] = [0.0, std::f64::consts::FRAC_PI_2 / links];
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        let long = libm::sin(links * middle) > span * libm::sin(middle);
        *(if long { &mut low } else { &mut high }) = middle;
    }
}
