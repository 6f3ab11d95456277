//! Ranges of legends: round numbers that rise at once and fall with hesitation, so that colours do not flicker.

use std::time::{Duration, Instant};

/// How long the values must stay well below a range before it falls.
const PATIENCE: Duration = Duration::from_secs(2);
/// A range falls only if the values would fit into this share of the next lower one.
const WELL_BELOW: f64 = 0.8;

/// Upper end of a legend's range: 1, 2 or 5 times a power of ten.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SteadyRange {
    top: f64,
    /// Since when a lower range would do, and the largest value seen since.
    low: Option<(Instant, f64)>,
}

impl SteadyRange {
    /// Upper end; 0 before the first value other than zero.
    pub fn top(&self) -> f64 {
        self.top
    }

    /// `value` as a share of the range, −1 … 1 for |value| up to its top; 0 while there is no range.
    pub fn share(&self, value: f64) -> f64 {
        if self.top > 0.0 { value / self.top } else { 0.0 }
    }

    /// Takes note of the largest magnitude without ever falling; whether it fills the range. What is not finite is passed over.
    pub fn rise(&mut self, largest: f64) -> bool {
        let wanted = step_up(largest);
        let fills = largest.is_finite() && largest >= 0.0 && wanted >= self.top;
        if fills {
            *self = SteadyRange { top: wanted, low: None };
        }
        fills
    }

    /// Takes note of the largest magnitude at an instant. What is not finite is passed over.
    pub fn update(&mut self, largest: f64, now: Instant) {
        if !largest.is_finite() || largest < 0.0 {
            return;
        }
        if self.rise(largest) {
            return;
        }
        if step_up(largest / WELL_BELOW) >= self.top {
            self.low = None;
            return;
        }
        let (since, seen) = self.low.unwrap_or((now, largest));
        let seen = seen.max(largest);
        self.low = Some((since, seen));
        // A range without any value stays: a scene that stops moving keeps its legend.
        if now.saturating_duration_since(since) >= PATIENCE && seen > 0.0 {
            *self = SteadyRange { top: step_up(seen), low: None };
        }
    }
}

/// The smallest of 1, 2, 5 times a power of ten that is not below `value`; 0 for 0.
pub fn step_up(value: f64) -> f64 {
    // Below this a double has no power of ten to round to; no quantity shown is as small.
    if value.is_nan() || value <= 1e-300 {
        return 0.0;
    }
    let power = 10f64.powf(value.log10().floor());
    // The logarithm may be off by its last bit, and the power with it: a trace above a step is still the step.
    [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|step| step * power)
        .find(|step| *step >= value * (1.0 - 1e-12))
        .unwrap_or(10.0 * power)
}

/// The largest of 1, 2, 5 times a power of ten that is not above `value`; 0 for 0.
pub fn step_down(value: f64) -> f64 {
    if value.is_nan() || value <= 1e-300 {
        return 0.0;
    }
    let power = 10f64.powf(value.log10().floor());
    [5.0, 2.0, 1.0].into_iter().map(|step| step * power).find(|step| *step <= value * (1.0 + 1e-12)).unwrap_or(power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_one_two_five_times_a_power_of_ten() {
        let cases =
            [(0.0, 0.0), (1.0, 1.0), (1.1, 2.0), (2.0, 2.0), (4.9, 5.0), (5.1, 10.0), (0.031, 0.05), (1e9, 1e9)];
        for (value, step) in cases {
            assert!((step_up(value) - step).abs() <= 1e-12 * step, "{value}: {}", step_up(value));
        }
        assert_eq!([step_down(4.9), step_down(5.0), step_down(99.0)], [2.0, 5.0, 50.0]);
    }

    #[test]
    fn a_range_rises_at_once_and_falls_only_after_two_seconds_well_below() {
        let start = Instant::now();
        let at = |seconds: f64| start + Duration::from_secs_f64(seconds);
        let mut range = SteadyRange::default();
        range.update(3.0, at(0.0));
        assert_eq!(range.top(), 5.0);
        range.update(80.0, at(0.1));
        assert_eq!(range.top(), 100.0);
        range.update(3.0, at(0.2));
        range.update(3.0, at(2.1));
        assert_eq!(range.top(), 100.0, "not yet two seconds");
        range.update(45.0, at(2.2));
        range.update(45.0, at(2.3));
        assert_eq!(range.top(), 100.0, "45 is not well below 50");
        range.update(9.0, at(3.0));
        range.update(3.0, at(5.1));
        assert_eq!(range.top(), 10.0, "the largest value of the last two seconds counts");
    }

    #[test]
    fn a_range_ignores_what_is_not_a_number_and_stays_when_everything_rests() {
        let start = Instant::now();
        let mut range = SteadyRange::default();
        range.update(f64::NAN, start);
        range.update(f64::INFINITY, start);
        assert_eq!((range.top(), range.share(3.0)), (0.0, 0.0));
        range.update(2.0, start);
        range.update(0.0, start);
        range.update(0.0, start + Duration::from_secs(60));
        assert_eq!(range.top(), 2.0);
    }
}
