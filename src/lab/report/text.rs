//! The work–precision diagram as text, for a terminal of 80 columns.

use super::axis::Axis;
use super::mark::letter;
use crate::lab::front::error;
use crate::lab::{Family, Front, Point, Setting};
use std::fmt::Write;

/// Columns and rows of the plot itself.
const COLUMNS: usize = 70;
const ROWS: usize = 21;
/// What the baseline is marked with.
const BASELINE: char = '#';
const WIDTH: usize = 80;

/// Error over cost, both logarithmic: a letter a family, a capital on the front. Empty if no point has an error.
pub fn diagram(points: &[Point]) -> String {
    let shown: Vec<&Point> = points.iter().filter(|point| error(point).is_finite()).collect();
    let (costs, errors) = (shown.iter().map(|point| point.cpu_us_per_second), shown.iter().map(|point| error(point)));
    let Some((x, y)) = Axis::over(costs).zip(Axis::over(errors)) else { return String::new() };
    let mut cells = vec![vec![' '; COLUMNS]; ROWS];
    let front = Front::of(points);
    // What matters most is drawn last: the front, then the baseline.
    let mut order = shown.clone();
    order.sort_by_key(|point| {
        (point.setting() == Setting::BASELINE, front.contains(point), usize::MAX - point.method.index())
    });
    for point in order {
        let column = (x.place(point.cpu_us_per_second) * (COLUMNS - 1) as f64).round() as usize;
        let row = ((1.0 - y.place(error(point))) * (ROWS - 1) as f64).round() as usize;
        let letter = letter(point.method);
        cells[row][column] = match () {
            () if point.setting() == Setting::BASELINE => BASELINE,
            () if front.contains(point) => letter.to_ascii_uppercase(),
            () => letter,
        };
    }
    draw(&cells, x, y) + &legend(&shown)
}

fn draw(cells: &[Vec<char>], x: Axis, y: Axis) -> String {
    let mut text = "error\n".to_owned();
    let row_of =
        |exponent: i32| ((1.0 - y.place(libm::pow(10.0, f64::from(exponent)))) * (ROWS - 1) as f64).round() as usize;
    let ticks: Vec<(usize, i32)> = y.ticks(10).map(|exponent| (row_of(exponent), exponent)).collect();
    for (row, cells) in cells.iter().enumerate() {
        let label =
            ticks.iter().find(|(at, _)| *at == row).map_or(String::new(), |(_, exponent)| format!("1e{exponent}"));
        let edge = if label.is_empty() { '|' } else { '+' };
        let line: String = cells.iter().collect();
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{label:>7} {edge}{}", line.trim_end());
    }
    let (mut ruler, mut labels) = (vec!['-'; COLUMNS], vec![' '; COLUMNS + 9]);
    for exponent in x.ticks(8) {
        let column = (x.place(libm::pow(10.0, f64::from(exponent))) * (COLUMNS - 1) as f64).round() as usize;
        ruler[column] = '+';
        let label = format!("1e{exponent}");
        // The last one ends within the width.
        let start = (column + 9).saturating_sub(label.len() / 2).min(COLUMNS + 9 - label.len());
        labels.splice(start..start + label.len(), label.chars());
    }
    let (ruler, labels): (String, String) = (ruler.iter().collect(), labels.iter().collect());
    let _ = writeln!(text, "        +{ruler}\n{}", labels.trim_end());
    let _ = writeln!(text, "{:>WIDTH$}", "CPU time per simulated second [us/s]");
    text
}

/// The families shown, as many on a line as fit.
fn legend(points: &[&Point]) -> String {
    let present = |family: &Family| points.iter().any(|point| point.method == *family);
    let mut entries: Vec<String> = vec!["Capital: on the front".to_owned()];
    if points.iter().any(|point| point.setting() == Setting::BASELINE) {
        entries.push(format!("{BASELINE} {}", Setting::BASELINE.label()));
    }
    entries
        .extend(Family::ALL.into_iter().filter(present).map(|family| format!("{} {}", letter(family), family.name())));
    let (mut text, mut line) = (String::new(), String::new());
    for entry in entries {
        let length = |text: &str| text.chars().count();
        if !line.is_empty() && length(&line) + 3 + length(&entry) > WIDTH {
            text += &(std::mem::take(&mut line) + "\n");
        }
        line += if line.is_empty() { "" } else { "   " };
        line += &entry;
    }
    text + &line + "\n"
}
