//! The front as a table for a terminal.

use crate::lab::front::{plain, short};
use crate::lab::{Front, Point, Setting};
use std::fmt::Write;

/// The front of `points` from cheap to costly, and the baseline where it is not on it; all points by cost if none has an error.
pub fn table(points: &[Point]) -> String {
    let front = Front::of(points);
    let mut rows: Vec<&Point> = if front.points().is_empty() {
        points.iter().collect()
    } else {
        let baseline = points.iter().filter(|point| point.setting() == Setting::BASELINE && !front.contains(point));
        front.points().iter().chain(baseline).collect()
    };
    rows.sort_by(|a, b| a.cpu_us_per_second.total_cmp(&b.cpu_us_per_second));
    let width = rows.iter().map(|point| point.setting().label().chars().count()).max().unwrap_or(0).max(6);
    let mut text = format!("  {:width$} {:>9} {:>8} {:>9} {:>8}\n", "method", "us/s", "error", "violation", "drift");
    for point in rows {
        let mark = if front.contains(point) { '*' } else { ' ' };
        let label = point.setting().label();
        let error = point.error.map_or_else(|| point.error_kind.to_string(), short);
        let (cost, violation, drift) =
            (plain(point.cpu_us_per_second), short(point.violation_max), short(point.energy_drift));
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{mark} {label:width$} {cost:>9} {error:>8} {violation:>9} {drift:>8}");
    }
    text
}
