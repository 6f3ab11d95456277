//! The first instant at which a gap closes.
//!
//! From a gap g and its rate ġ at one instant and a bound m ≤ g̈ for all later ones, Taylor's theorem gives a parabola below g. Its first zero is
//! a step that cannot jump over a root. Near a simple root it is Newton's step and converges quadratically; along a parabola it is exact.

/// A gap [m], its rate [m/s], and a bound from below on its second derivative from there on [m/s²].
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    pub gap: f64,
    pub rate: f64,
    pub bend: f64,
}

/// What counts as nothing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rounding {
    /// A gap [m].
    pub gap: f64,
    /// A rate [m/s].
    pub rate: f64,
}

/// Steps of one search. A search that grazes converges linearly and needs some fifty.
const MOST_STEPS: u32 = 200;
/// First step of a gap that neither closes nor opens, as a part of the time searched; each further one is twice as long.
const NUDGE: f64 = 1e-7;

/// The first time in [0, `end`] at which the gap is closed and closing; `None` if there is none.
///
/// A search that does not converge ends with the time reached, up to which there is none: the caller looks again from there.
pub(super) fn first_root(end: f64, rounding: Rounding, sample: impl Fn(f64) -> Sample) -> Option<f64> {
    let (mut time, mut nudge) = (0.0, NUDGE * end);
    for _ in 0..MOST_STEPS {
        let Sample { gap, mut rate, bend } = sample(time);
        let closed = gap <= rounding.gap;
        if closed && rate < -rounding.rate {
            return Some(time);
        }
        if closed && rate <= rounding.rate {
            rate = 0.0;
        }
        let mut step = first_zero(gap.max(0.0), rate, bend)?;
        if closed && step < nudge {
            step = nudge;
            nudge *= 2.0;
        }
        if rate < 0.0 && time + step <= time {
            return Some(time);
        }
        time += step;
        // Written so that a NaN ends the search.
        if !(time <= end) {
            return None;
        }
    }
    Some(time)
}

/// The first zero of c + b t + m t²/2 for c ≥ 0 and t ≥ 0, in the form that does not cancel.
fn first_zero(c: f64, b: f64, m: f64) -> Option<f64> {
    if b < 0.0 {
        let discriminant = b * b - 2.0 * m * c;
        return (discriminant >= 0.0).then(|| 2.0 * c / (-b + discriminant.sqrt()));
    }
    (m < 0.0).then(|| (b + (b * b - 2.0 * m * c).sqrt()) / -m)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FINE: Rounding = Rounding { gap: 1e-15, rate: 1e-15 };

    #[test]
    fn a_parabola_takes_one_step_and_its_second_root_counts_where_it_starts_closed() {
        let throw = |t: f64| Sample { gap: 3.0 * t - 5.0 * t * t, rate: 3.0 - 10.0 * t, bend: -10.0 };
        let found = first_root(1.0, FINE, throw).unwrap();
        assert!((found - 0.6).abs() < 1e-15, "{found}");
    }

    #[test]
    fn a_passing_disc_is_met_or_missed_by_a_hair() {
        // Offset (−1, y) with velocity (1, 0) against a sum of radii of 0.5.
        let pass = |y: f64| {
            first_root(10.0, FINE, |t: f64| {
                let (x, d) = (t - 1.0, (t - 1.0).hypot(y));
                Sample { gap: d - 0.5, rate: x / d, bend: 0.0 }
            })
        };
        let exact = 1.0 - (0.25f64 - 0.3 * 0.3).sqrt();
        assert!((pass(0.3).unwrap() - exact).abs() < 1e-15);
        // Here the discs overlap by 2e-12 m in passing.
        let hair = pass(0.5 - 2e-12).unwrap();
        assert!((hair - (1.0 - (0.25f64 - (0.5 - 2e-12) * (0.5 - 2e-12)).sqrt())).abs() < 1e-9, "{hair}");
        assert_eq!(pass(0.5 + 1e-12), None);
    }
}
