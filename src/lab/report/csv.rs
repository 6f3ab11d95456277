//! Comma-separated values: a row a point, empty where a point has no value.

use crate::lab::Point;
use std::io::Write;

/// The first row.
pub const HEADER: &str = "scene,method,hz,substeps,iterations,tolerance,cpu_us_per_second,error,error_kind,violation_max,\
                          energy_drift";

/// Writes a row. `{:?}` writes the fewest digits that are read back to the same bits.
pub fn write(out: &mut dyn Write, point: &Point) -> std::io::Result<()> {
    write!(out, "{},{},{:?},", quoted(&point.scene), point.method.key(), point.hz)?;
    write!(out, "{},{},{},", cell(point.substeps), cell(point.iterations), number(point.tolerance))?;
    write!(out, "{:?},{},{},", point.cpu_us_per_second, number(point.error), point.error_kind)?;
    writeln!(out, "{:?},{:?}", point.violation_max, point.energy_drift)
}

fn cell(value: Option<u32>) -> String {
    value.map_or(String::new(), |value| value.to_string())
}

fn number(value: Option<f64>) -> String {
    value.map_or(String::new(), |value| format!("{value:?}"))
}

/// A text as RFC 4180 wants it.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}
