//! The front: points that no other beats in both error and cost, and what to use.

use super::point::{ErrorKind, Point};
use super::setting::Setting;

/// Points in the order of their cost, each with a smaller error than all before it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Front {
    points: Vec<Point>,
}

/// By how much the best method beats another one.
#[derive(Clone, Debug, PartialEq)]
pub struct Gain {
    /// The other one.
    pub baseline: Point,
    /// The most accurate point that costs no more, and by which factor its error is smaller.
    pub at_its_cost: Option<(Point, f64)>,
    /// The cheapest point whose error is no larger, and by which factor its cost is smaller.
    pub at_its_error: Option<(Point, f64)>,
}

impl Front {
    /// The front of some points of one scene. Points without an error are not on it; of two that are equal the first is.
    pub fn of(points: &[Point]) -> Front {
        let mut order: Vec<&Point> = points.iter().filter(|point| error(point).is_finite()).collect();
        order.sort_by(|a, b| a.cpu_us_per_second.total_cmp(&b.cpu_us_per_second).then(error(a).total_cmp(&error(b))));
        let mut front: Vec<Point> = Vec::new();
        for point in order {
            if front.last().is_none_or(|last| error(point) < error(last)) {
                front.push(point.clone());
            }
        }
        Front { points: front }
    }

    /// The points, the cheapest and least accurate first.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Whether this very point, with all its figures, is on the front.
    pub fn contains(&self, point: &Point) -> bool {
        self.points.contains(point)
    }

    /// The most accurate point that costs at most so much [µs/s].
    pub fn best_within(&self, cost: f64) -> Option<&Point> {
        self.points.iter().rev().find(|point| point.cpu_us_per_second <= cost)
    }

    /// The cheapest point whose error is at most so much.
    pub fn cheapest_for(&self, wanted: f64) -> Option<&Point> {
        self.points.iter().find(|point| error(point) <= wanted)
    }

    /// Error along the front at a cost [µs/s], on straight lines of log error over log cost; that of the last point for more,
    /// `None` for less than the first costs.
    pub fn error_at(&self, cost: f64) -> Option<f64> {
        let along: Vec<_> = self.points.iter().map(|point| (point.cpu_us_per_second, error(point))).collect();
        interpolate(&along, cost)
    }

    /// Cost along the front for an error [µs/s], on the same lines; that of the first point for larger errors, `None` for
    /// smaller ones than the last point's.
    pub fn cost_for(&self, wanted: f64) -> Option<f64> {
        let along: Vec<_> = self.points.iter().rev().map(|point| (error(point), point.cpu_us_per_second)).collect();
        interpolate(&along, wanted)
    }

    /// What to use for a wanted error, in a sentence.
    pub fn advice_for_error(&self, wanted: f64) -> String {
        match (self.cheapest_for(wanted), self.points.last()) {
            (Some(point), _) => format!("For an error of {} use {}.", short(wanted), found(point)),
            (None, Some(best)) => {
                format!("Nothing measured reaches an error of {}; the best is {}.", short(wanted), found(best))
            }
            (None, None) => "Nothing with an error was measured yet.".to_owned(),
        }
    }

    /// What to use for a budget [µs/s], in a sentence.
    pub fn advice_for_budget(&self, cost: f64) -> String {
        match (self.best_within(cost), self.points.first()) {
            (Some(point), _) => format!("For {} µs per simulated second use {}.", plain(cost), found(point)),
            (None, Some(first)) => {
                format!("Nothing measured costs as little as {} µs; the cheapest is {}.", plain(cost), found(first))
            }
            (None, None) => "Nothing with an error was measured yet.".to_owned(),
        }
    }

    /// How far the front is ahead of `baseline`; `None` if that was not measured among `points` or not compared with anything.
    pub fn gain(&self, points: &[Point], baseline: Setting) -> Option<Gain> {
        let compared = |point: &&Point| point.setting() == baseline && point.error_kind != ErrorKind::None;
        let baseline = points.iter().find(compared)?.clone();
        let at_its_cost = self.best_within(baseline.cpu_us_per_second);
        let at_its_error = self.cheapest_for(error(&baseline));
        Some(Gain {
            at_its_cost: at_its_cost.map(|point| (point.clone(), error(&baseline) / error(point))),
            at_its_error: at_its_error
                .map(|point| (point.clone(), baseline.cpu_us_per_second / point.cpu_us_per_second)),
            baseline,
        })
    }
}

impl Gain {
    /// In a sentence.
    pub fn sentence(&self) -> String {
        let Gain { baseline, at_its_cost, at_its_error } = self;
        let cost = plain(baseline.cpu_us_per_second);
        let label = baseline.setting().label();
        let mut text = match baseline.error {
            Some(error) => format!("{label} has an error of {} at {cost} µs/s.", short(error)),
            None => format!("{label} diverges."),
        };
        if let Some((point, factor)) = at_its_cost.as_ref().filter(|(_, factor)| factor.is_finite()) {
            let label = point.setting().label();
            text += &format!(" At its cost the best error is {} times smaller ({label})", factor_text(*factor));
            text += &match at_its_error.as_ref().filter(|(_, factor)| factor.is_finite()) {
                Some((point, factor)) => {
                    let label = point.setting().label();
                    format!("; its error is to be had {} times cheaper ({label}).", factor_text(*factor))
                }
                None => ".".to_owned(),
            };
        }
        text
    }
}

/// A factor with two digits, or as a power of ten.
pub(super) fn factor_text(factor: f64) -> String {
    match factor {
        _ if factor < 10.0 => format!("{factor:.1}"),
        _ if factor < 1e4 => {
            // Two digits
            let scale = libm::pow(10.0, libm::floor(libm::log10(factor)) - 1.0);
            format!("{:.0}", (factor / scale).round() * scale)
        }
        _ => format!("{factor:.0e}"),
    }
}

/// An error with two digits.
pub(super) fn short(error: f64) -> String {
    let text = format!("{error:.1e}");
    text.replace(".0e", "e")
}

/// A cost [µs/s] without digits that mean nothing.
pub(super) fn plain(cost: f64) -> String {
    if cost < 10.0 { format!("{cost:.1}") } else { format!("{cost:.0}") }
}

fn found(point: &Point) -> String {
    let cost = plain(point.cpu_us_per_second);
    format!("{}: error {} at {cost} µs/s", point.setting().label(), short(error(point)))
}

/// Infinite if there is none.
pub(super) fn error(point: &Point) -> f64 {
    point.error.unwrap_or(f64::INFINITY)
}

/// y at `x` along points with ascending x, on straight lines of log y over log x; the last y beyond the last, `None` before the
/// first.
fn interpolate(along: &[(f64, f64)], x: f64) -> Option<f64> {
    let after = along.partition_point(|(start, _)| *start <= x);
    let (x0, y0) = *along.get(after.checked_sub(1)?)?;
    let Some(&(x1, y1)) = along.get(after) else { return Some(y0) };
    // An error of zero has no logarithm.
    let log = |value: f64| libm::log(value.max(f64::MIN_POSITIVE));
    let part = (log(x) - log(x0)) / (log(x1) - log(x0));
    Some(libm::exp(log(y0) + part * (log(y1) - log(y0))))
}
