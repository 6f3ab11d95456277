//! Ranges of legends: round numbers that rise at once and fall with hesitation, so that colours do not flicker.

use std::time::{Duration, Instant};

/// How long the values must stay well below a range before it falls: longer than a slow swing rests at its turning points.
const PATIENCE: Duration = Duration::from_secs(8);
/// A range falls only if the values would fit into this share of it.
const WELL_BELOW: f64 = 0.25;
/// A range rises only if a value is more than so many times its top: what swings about a step does not change it.
const CLEARLY_ABOVE: f64 = 1.05;

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
            let top = if largest > CLEARLY_ABOVE * self.top { wanted } else { self.top };
            *self = SteadyRange { top, low: None };
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
        if largest > WELL_BELOW * self.top {
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
    fn a_range_rises_at_once_and_falls_only_after_eight_seconds_well_below() {
        let start = Instant::now();
        let at = |seconds: f64| start + Duration::from_secs_f64(seconds);
        let mut range = SteadyRange::default();
        range.update(3.0, at(0.0));
        assert_eq!(range.top(), 5.0);
        range.update(80.0, at(0.1));
        assert_eq!(range.top(), 100.0);
        range.update(3.0, at(0.2));
        range.update(3.0, at(8.1));
        assert_eq!(range.top(), 100.0, "not yet eight seconds");
        range.update(45.0, at(8.2));
        range.update(45.0, at(20.0));
        assert_eq!(range.top(), 100.0, "45 is not well below 100");
        range.update(9.0, at(21.0));
        range.update(3.0, at(29.1));
        assert_eq!(range.top(), 10.0, "the largest value of the last eight seconds counts");
    }

    #[test]
    fn a_range_stays_while_values_swing_about_one_of_its_steps() {
        let start = Instant::now();
        for (middle, swing) in [(0.97, 0.08), (1.5, 1.4), (3.5, 1.6), (5.0, 0.2)] {
            let mut range = SteadyRange::default();
            // A period of six seconds.
            let value = |i: u32| middle + swing * (f64::from(i) / 60.0 * std::f64::consts::TAU / 6.0).sin();
            let mut tops = std::collections::BTreeSet::new();
            for i in 0..3600 {
                range.update(value(i), start + Duration::from_secs_f64(f64::from(i) / 60.0));
                if i >= 360 {
                    tops.insert(range.top().to_bits());
                }
            }
            assert_eq!(tops.len(), 1, "{middle} ± {swing}: the range changed after the first swing");
            assert!(middle + swing <= 1.051 * range.top(), "{middle} ± {swing}: {}", range.top());
        }
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
