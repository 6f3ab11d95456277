//! The grid: its steps, its labels, and the scale bar.

use super::legend::{step_down, step_up};
use crate::app::Camera;

/// Least distance of two labelled lines [points].
const MAJOR_SPACING: f64 = 80.0;
/// Greatest length of the scale bar [points], and as a share of the canvas's width.
const SCALE_BAR: (f64, f64) = (120.0, 0.3);

/// Distances of the grid's lines [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridStep {
    /// Of the labelled lines: 1, 2 or 5 times a power of ten.
    pub major: f64,
    /// Of all lines: a quarter or a fifth of `major`, itself such a step.
    pub minor: f64,
    /// Opacity of the lines that are not labelled, 0 … 1: they fade in as they move apart.
    pub minor_opacity: f64,
}

impl GridStep {
    /// The steps at a scale [points a metre].
    pub fn at_scale(scale: f64) -> GridStep {
        let major = step_up(MAJOR_SPACING / scale);
        let leading = major / 10f64.powf(major.log10().floor());
        let minor = if (leading - 2.0).abs() < 0.5 { major / 4.0 } else { major / 5.0 };
        GridStep { major, minor, minor_opacity: ((minor * scale - 14.0) / 14.0).clamp(0.25, 1.0) }
    }
}

/// The axis on which a coordinate is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// To the right.
    X,
    /// Upwards.
    Y,
}

/// A labelled line of the grid.
#[derive(Clone, Debug, PartialEq)]
pub struct GridLabel {
    /// Which coordinate the text gives: x for upright lines.
    pub axis: Axis,
    /// Where the line crosses the canvas [points from its left or upper edge].
    pub at: f64,
    /// The coordinate with its unit, such as "−0.5 m".
    pub text: String,
}

/// The labels of every major line that is seen, x first, each in ascending order of the coordinate.
pub fn labels(camera: &Camera) -> Vec<GridLabel> {
    let major = GridStep::at_scale(camera.scale).major;
    let half = camera.size / 2.0 / camera.scale;
    let along = |axis: Axis, centre: f64, half: f64| {
        lines(centre - half, centre + half, major).map(move |k| {
            let offset = (k * major - centre) * camera.scale;
            let at = if axis == Axis::X { camera.size.x / 2.0 + offset } else { camera.size.y / 2.0 - offset };
            GridLabel { axis, at, text: length_text(k * major, major) }
        })
    };
    along(Axis::X, camera.centre.x, half.x).chain(along(Axis::Y, camera.centre.y, half.y)).collect()
}

/// Whole multiples of `step` from `low` to `high`. At most a few thousand: beyond that a view has no lines worth drawing.
pub(crate) fn lines(low: f64, high: f64, step: f64) -> impl Iterator<Item = f64> {
    let (first, last) = ((low / step).ceil(), (high / step).floor());
    // Where a double no longer tells two neighbours apart there is no line to draw either.
    let countable = step > 0.0 && last - first < 4096.0 && last.abs().max(first.abs()) < 1e15;
    let count = if countable { (last - first + 1.0).max(0.0) as usize } else { 0 };
    (0..count).map(move |i| first + i as f64)
}

/// The scale bar's length.
#[derive(Clone, Debug, PartialEq)]
pub struct ScaleBar {
    /// Length in the world [m], 1, 2 or 5 times a power of ten.
    pub metres: f64,
    /// Length on the canvas [points].
    pub points: f64,
    /// Such as "20 cm".
    pub text: String,
}

/// The longest round length that fits the scale bar.
pub fn scale_bar(camera: &Camera) -> ScaleBar {
    let metres = step_down(SCALE_BAR.0.min(SCALE_BAR.1 * camera.size.x) / camera.scale);
    ScaleBar { metres, points: metres * camera.scale, text: length_text(metres, metres) }
}

/// `metres` with as many digits, and in the unit, that a grid of `step` needs.
pub fn length_text(metres: f64, step: f64) -> String {
    let (unit, size) = match step {
        step if step >= 999.0 => ("km", 1e3),
        step if step >= 0.0999 => ("m", 1.0),
        step if step >= 0.00999 => ("cm", 1e-2),
        step if step >= 0.999e-3 => ("mm", 1e-3),
        step if step >= 0.999e-6 => ("µm", 1e-6),
        _ => ("nm", 1e-9),
    };
    let decimals = (-(step / size).log10() - 1e-9).ceil().clamp(0.0, 9.0) as usize;
    let value = metres / size;
    // No "−0": a multiple of the step is either zero or at least a step.
    let value = if value.abs() < 0.5 * step / size { 0.0 } else { value };
    let sign = if value < 0.0 { "−" } else { "" };
    format!("{sign}{:.decimals$} {unit}", value.abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::DVec2;

    #[test]
    fn steps_keep_labelled_lines_80_to_200_points_apart_at_every_scale() {
        for exponent in -60..90 {
            let scale = 10f64.powf(f64::from(exponent) / 10.0);
            let step = GridStep::at_scale(scale);
            let apart = step.major * scale;
            assert!((79.9..200.1).contains(&apart), "{apart} points at {scale}");
            let parts = step.major / step.minor;
            assert!((parts - parts.round()).abs() < 1e-9 && (4.0..=5.0).contains(&parts.round()));
            assert!(step.minor * scale >= 15.9);
        }
    }

    #[test]
    fn labels_carry_units_and_lie_on_their_lines() {
        let camera = Camera { centre: DVec2::new(0.25, -1.0), scale: 100.0, size: DVec2::new(400.0, 300.0) };
        let found = labels(&camera);
        let texts: Vec<&str> = found.iter().map(|label| label.text.as_str()).collect();
        assert_eq!(texts, ["−1 m", "0 m", "1 m", "2 m", "−2 m", "−1 m", "0 m"]);
        for label in found {
            let value: f64 = label.text.replace('−', "-").trim_end_matches(" m").parse().unwrap();
            let at = camera.to_canvas(DVec2::splat(value));
            let expected = if label.axis == Axis::X { at.x } else { at.y };
            assert!((label.at - expected).abs() < 1e-9);
        }
    }

    #[test]
    fn lengths_are_written_in_the_unit_of_the_step() {
        let cases = [
            (0.5, 0.5, "0.5 m"),
            (-0.30000000000000004, 0.1, "−0.3 m"),
            (0.05, 0.05, "5 cm"),
            (0.002, 0.001, "2 mm"),
            (40000.1, 0.1, "40000.1 m"),
            (2e6, 1e6, "2000 km"),
            (5e-9, 5e-9, "5 nm"),
            (-1e-17, 0.1, "0.0 m"),
        ];
        for (metres, step, text) in cases {
            assert_eq!(length_text(metres, step), text);
        }
    }

    #[test]
    fn the_scale_bar_is_round_and_fits() {
        for exponent in -60..90 {
            let scale = 10f64.powf(f64::from(exponent) / 10.0);
            let bar = scale_bar(&Camera { centre: DVec2::ZERO, scale, size: DVec2::new(800.0, 600.0) });
            assert!((47.9..120.1).contains(&bar.points), "{} points at {scale}", bar.points);
        }
    }
}
