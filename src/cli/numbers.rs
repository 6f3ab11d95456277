//! Numbers of the command line: durations, sizes, counts, with errors that say what is accepted.

use crate::lab::{Family, rate_fits};
use clap::builder::{PathBufValueParser, TypedValueParser};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The longest run that is accepted [s]: over eleven days.
const LONGEST: f64 = 1e6;
/// The largest side of a picture [pixels]; graphics adapters commonly stop there.
const LARGEST_SIDE: u32 = 8192;

/// A duration [s], 0 included.
pub(super) fn seconds(text: &str) -> Result<f64, String> {
    number(text, 0.0, LONGEST, "a number of seconds from 0 to 1000000, such as 10 or 0.5")
}

/// A time between samples [s]: a number or a fraction such as 1/60.
pub(super) fn interval(text: &str) -> Result<f64, String> {
    const EXPECTED: &str = "a number of seconds from 1e-9 to 1000000 such as 0.1, or a fraction such as 1/60";
    let (over, under) = text.split_once('/').unwrap_or((text, "1"));
    let parts = over.trim().parse::<f64>().ok().zip(under.trim().parse::<f64>().ok());
    match parts.map(|(over, under)| over / under) {
        Some(every) if (1e-9..=LONGEST).contains(&every) => Ok(every),
        _ => Err(format!("expected {EXPECTED}")),
    }
}

/// Steps a second [Hz].
pub(super) fn hz(text: &str) -> Result<f64, String> {
    number(text, 1.0, 1e5, "a rate from 1 to 100000 steps per second")
}

/// Substeps a step.
pub(super) fn substeps(text: &str) -> Result<u32, String> {
    count(text, 1000)
}

/// Solver sweeps a substep.
pub(super) fn iterations(text: &str) -> Result<u32, String> {
    count(text, 100_000)
}

/// The part of the position error fed back in a substep.
pub(super) fn baumgarte(text: &str) -> Result<f64, String> {
    number(text, 0.0, 1.0, "a number from 0 to 1")
}

/// Wanted accuracy.
pub(super) fn accuracy(text: &str) -> Result<f64, String> {
    number(text, 1e-14, 0.1, "a number from 1e-14 to 0.1")
}

/// Steps a second that meet the samples of a reference [Hz].
pub(super) fn rate(text: &str) -> Result<f64, String> {
    const EXPECTED: &str = "a multiple of 60 up to 100000, or one of 30, 20, 15, 12, 10, 6, 5, 4, 3, 2, 1";
    text.parse().ok().filter(|hz| rate_fits(*hz)).ok_or_else(|| format!("expected {EXPECTED} steps per second"))
}

/// Timed runs of a setting.
pub(super) fn runs(text: &str) -> Result<usize, String> {
    const EXPECTED: &str = "expected a whole number from 5 to 1000: the median of fewer runs says little";
    text.parse().ok().filter(|runs| (5..=1000).contains(runs)).ok_or_else(|| EXPECTED.to_owned())
}

/// Time that may be spent.
pub(super) fn budget(text: &str) -> Result<Duration, String> {
    number(text, 1e-3, LONGEST, "a number of seconds from 0.001 to 1000000, such as 20").map(Duration::from_secs_f64)
}

/// A method of the lab.
pub(super) fn family(text: &str) -> Result<Family, String> {
    let all = || Family::ALL.map(Family::key).join(", ");
    Family::find(text).ok_or_else(|| format!("expected some of {}", all()))
}

/// A picture that is text.
pub(super) fn svg() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(|path| {
        let fits = path == Path::new("-") || ends_in(&path, "svg") || path.starts_with("/dev/");
        fits.then_some(path).ok_or("expected the name of an SVG file, such as diagram.svg, or -")
    })
}

/// A picture's width and height [pixels].
pub(super) fn size(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| text.parse::<u32>().ok().filter(|side| (16..=LARGEST_SIDE).contains(side));
    let sides = text.split_once('x').and_then(|(width, height)| side(width).zip(side(height)));
    sides
        .map(|(width, height)| [width, height])
        .ok_or_else(|| format!("expected width and height in pixels from 16 to {LARGEST_SIDE}, such as 1280x800"))
}

/// The path of a picture, which is a PNG file whatever it is called: another ending would only mislead.
pub(super) fn png() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(|path| {
        ends_in(&path, "png").then_some(path).ok_or("expected the name of a PNG file, such as picture.png")
    })
}

fn ends_in(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending))
}

fn number(text: &str, low: f64, high: f64, expected: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value >= low && value <= high => Ok(value),
        _ => Err(format!("expected {expected}")),
    }
}

fn count(text: &str, most: u32) -> Result<u32, String> {
    match text.parse::<u32>() {
        Ok(count) if (1..=most).contains(&count) => Ok(count),
        _ => Err(format!("expected a whole number from 1 to {most}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions_are_divided_and_nonsense_is_refused() {
        assert_eq!(interval("1/60"), Ok(1.0 / 60.0));
        assert_eq!(interval("0.25"), Ok(0.25));
        for wrong in ["0", "1/0", "0/0", "-1", "NaN", "1e300", "1/1/2", "", "1/", "fast"] {
            assert!(interval(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn durations_are_finite_and_not_negative() {
        assert_eq!(seconds("0"), Ok(0.0));
        for wrong in ["-1", "NaN", "inf", "1e300", "ten"] {
            assert!(seconds(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn sizes_are_two_sides_within_reason() {
        assert_eq!(size("1280x800"), Ok([1280, 800]));
        for wrong in ["1280", "0x0", "1280x", "x800", "99999x99999", "1280X800", "-1x5"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
    }
}
