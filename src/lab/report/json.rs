//! JSON lines: a point a line, with the names of [`Point`]'s fields. Numbers come back with the same bits.

use crate::engine::Method;
use crate::lab::Point;
use std::io::Write;

/// What is wrong with a file of points.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {problem}; measure anew, or remove the line")]
pub struct JsonError {
    /// From 1.
    pub line: usize,
    /// What is wrong with the line, and in which column.
    pub problem: String,
}

/// Writes a line.
pub fn write(out: &mut dyn Write, point: &Point) -> std::io::Result<()> {
    let line = serde_json::to_string(point).map_err(std::io::Error::other)?;
    writeln!(out, "{line}")
}

/// The points in `text`, and how many of its bytes are whole lines: a last line without an end is what a run left that was
/// killed while it wrote, and is not read.
pub fn read(text: &str) -> Result<(Vec<Point>, usize), JsonError> {
    let whole = text.rfind('\n').map_or(0, |end| end + 1);
    let mut points = Vec::new();
    for (index, line) in text[..whole].lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        let wrong = |problem: String| JsonError { line: index + 1, problem };
        let point: Point = serde_json::from_str(line).map_err(|error| wrong(explain(&error)))?;
        point.setting().method(Method::default()).validate().map_err(|error| wrong(error.to_string()))?;
        points.push(point);
    }
    Ok((points, whole))
}

/// What the library says, with the column but without its line, which is always the first.
fn explain(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let problem = text.split(" at line ").next().unwrap_or(&text);
    format!("{problem} (column {})", error.column())
}
