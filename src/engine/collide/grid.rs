//! A uniform grid without bounds: bodies sorted by the cell of their centre, so that neighbours are runs of one array.
//!
//! Rows of cells are contiguous in the order (row, column), hence the neighbours of a cell in a row are one run, found by a
//! pointer that only moves forward while the cells are walked in order.

use glam::DVec2;

/// Bodies of about one size in cells at least as wide as the reach of a pair.
#[derive(Debug, Default)]
pub(crate) struct Grid {
    cell: f64,
    /// (cell, body), sorted.
    entries: Vec<(u64, u32)>,
}

impl Grid {
    /// Sorts the bodies into cells of width `cell` [m]. O(n log n).
    pub fn fill(&mut self, cell: f64, bodies: impl Iterator<Item = (u32, DVec2)>) {
        self.cell = cell;
        self.entries.clear();
        self.entries.extend(bodies.map(|(body, at)| (key(column(at.x, cell), column(at.y, cell)), body)));
        self.entries.sort_unstable();
    }

    /// Calls `visit` once for every pair of bodies in the same or neighbouring cells.
    pub fn pairs(&self, mut visit: impl FnMut(u32, u32)) {
        let mut above = 0;
        for (i, (cell, body)) in self.entries.iter().enumerate() {
            let (x, y) = place(*cell);
            let last_here = key(x.saturating_add(1), y);
            self.entries[i + 1..]
                .iter()
                .take_while(|entry| entry.0 <= last_here)
                .for_each(|entry| visit(*body, entry.1));
            if y == i32::MAX {
                continue;
            }
            let (first, last) = (key(x.saturating_sub(1), y + 1), key(x.saturating_add(1), y + 1));
            while above < self.entries.len() && self.entries[above].0 < first {
                above += 1;
            }
            self.entries[above..].iter().take_while(|entry| entry.0 <= last).for_each(|entry| visit(*body, entry.1));
        }
    }

    /// Calls `visit` for every body whose cell meets the box from `min` to `max`, row by row.
    ///
    /// `clip` narrows a row, given the row's lower and upper edge, to the part of x that is of interest.
    pub fn in_box(&self, min: DVec2, max: DVec2, clip: impl Fn(f64, f64) -> (f64, f64), mut visit: impl FnMut(u32)) {
        let (first_row, last_row) = (column(min.y, self.cell), column(max.y, self.cell));
        let mut next = self.entries.partition_point(|entry| entry.0 < key(i32::MIN, first_row));
        while next < self.entries.len() {
            let (_, y) = place(self.entries[next].0);
            if y > last_row {
                break;
            }
            let (left, right) = clip(f64::from(y) * self.cell, (f64::from(y) + 1.0) * self.cell);
            let last = key(column(right.min(max.x), self.cell), y);
            let first = key(column(left.max(min.x), self.cell), y);
            next += self.entries[next..].partition_point(|entry| entry.0 < first);
            while next < self.entries.len() && self.entries[next].0 <= last {
                visit(self.entries[next].1);
                next += 1;
            }
            next += self.entries[next..].partition_point(|entry| place(entry.0).1 <= y);
        }
    }
}

/// Cell number of a coordinate; beyond ±2³¹ cells everything shares the outermost one.
fn column(coordinate: f64, cell: f64) -> i32 {
    (coordinate / cell).floor() as i32
}

/// Sort key of a cell: by row, then by column.
fn key(x: i32, y: i32) -> u64 {
    let shift = |number: i32| u64::from((number as u32) ^ 0x8000_0000);
    (shift(y) << 32) | shift(x)
}

/// Column and row of a key.
fn place(key: u64) -> (i32, i32) {
    let unshift = |bits: u64| ((bits as u32) ^ 0x8000_0000) as i32;
    (unshift(key & 0xffff_ffff), unshift(key >> 32))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_order_cells_by_row_and_give_the_place_back() {
        for (x, y) in [(0, 0), (-1, 5), (i32::MIN, i32::MAX), (7, -3)] {
            assert_eq!(place(key(x, y)), (x, y));
        }
        assert!(key(5, -1) < key(-5, 0) && key(-1, 0) < key(0, 0));
    }

    #[test]
    fn every_close_pair_is_visited_exactly_once() {
        let points: Vec<DVec2> = (0..400)
            .map(|i| DVec2::new(f64::from(i * 37 % 101) * 0.13 - 6.0, f64::from(i * 53 % 97) * 0.11 - 5.0))
            .collect();
        let mut grid = Grid::default();
        grid.fill(0.5, points.iter().enumerate().map(|(i, p)| (i as u32, *p)));
        let mut found = Vec::new();
        grid.pairs(|a, b| {
            if points[a as usize].distance(points[b as usize]) < 0.5 {
                found.push((a.min(b), a.max(b)));
            }
        });
        let mut expected = Vec::new();
        for b in 0..points.len() as u32 {
            let close = |a: &u32| points[*a as usize].distance(points[b as usize]) < 0.5;
            expected.extend((0..b).filter(close).map(|a| (a, b)));
        }
        found.sort_unstable();
        expected.sort_unstable();
        assert_eq!(found, expected);
    }
}
