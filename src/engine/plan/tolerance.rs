//! What local errors methods may make for a wanted accuracy.

use super::{Carrier, IslandPlan};
use crate::engine::integrate::pace::Pace;

/// Local error of a step over the wanted accuracy: errors grow as they are carried on.
const LOCAL: f64 = 0.03;
/// The same for series, whose estimate is held to it over all steps of a frame together.
const LOCAL_SERIES: f64 = 0.1;
/// The same where nothing but springs acts: what swings for long loses energy with every step of a series (at 0.1 a
/// mass that swings 110 times a second has lost 3e-6 of it after ten seconds at 1e-6).
const LOCAL_SWINGING: f64 = 0.005;
/// The same where anchors turn: at 0.15 chains of discs miss the bounds of `tests/turning`.
const LOCAL_TURNING: f64 = 0.08;
/// The same for Nyström's methods, whose estimate is a bound: at 0.2 the stiffer chain is 1.3e-10 off at 1e-10.
const LOCAL_NYSTROM: f64 = 0.12;
/// The same for Runge and Kutta's: at 0.06 four masses on springs lose 3 % of their energy in ten seconds at 1e-3.
const LOCAL_KUTTA: f64 = 0.02;
/// The same for methods of order 2, whose errors add up more evenly; where anchors turn, RATTLE's estimate leaves out
/// how errors of the velocity are carried on.
const LOCAL_SECOND: f64 = 0.006;
const LOCAL_SECOND_TURNING: f64 = 0.014;

/// Loosest accuracy of what free bodies are carried with from event to event, and of series and Nyström's methods.
const LOOSEST_LOCAL: f64 = 1e-5;
const LOOSEST_SERIES: f64 = 1e-3;
/// The same of methods of order 2: coarser than this one step mostly does for a frame, and errors depend on which
/// frames get a second one.
const LOOSEST_SECOND: f64 = 1e-2;

/// Where anchors turn there is no contest: accuracies down to which RATTLE costs less than series.
const TURNING_SECOND_ORDER: f64 = 6e-4;

/// Error allowed in a step of free bodies where motion is not in closed form, in parts of the smallest radius.
pub(super) fn few_tolerance(accuracy: f64) -> f64 {
    LOCAL * accuracy.min(LOOSEST_LOCAL)
}

/// Error that a series may make in a step, in parts of the island's size.
pub(super) fn series_tolerance(accuracy: f64, springs: bool, turning: bool) -> f64 {
    let local = match (turning, springs) {
        (true, _) => LOCAL_TURNING,
        (false, true) => LOCAL_SWINGING,
        (false, false) => LOCAL_SERIES,
    };
    local * accuracy.min(LOOSEST_SERIES)
}

impl IslandPlan {
    /// Where anchors turn: whether RATTLE goes before series, if it takes the island.
    pub fn second_order(&self) -> bool {
        self.carrier != Carrier::Cheapest || self.accuracy >= TURNING_SECOND_ORDER
    }

    /// What methods of order 2 are asked for on an island of this size [m], for an accuracy: its own, or a coarser
    /// one where that fails.
    pub(crate) fn pace(&self, length: f64, accuracy: f64) -> Pace {
        let local = if self.turning > 0 { LOCAL_SECOND_TURNING } else { LOCAL_SECOND };
        self.steps.map_or(Pace::Within(local * accuracy.min(LOOSEST_SECOND) * length), Pace::Steps)
    }

    /// The same for Nyström's methods.
    pub(crate) fn fine_pace(&self, length: f64, accuracy: f64) -> Pace {
        self.steps.map_or(Pace::Within(LOCAL_NYSTROM * accuracy.min(LOOSEST_SERIES) * length), Pace::Steps)
    }

    /// The same for Runge and Kutta's.
    pub(crate) fn kutta_pace(&self, length: f64, accuracy: f64) -> Pace {
        self.steps.map_or(Pace::Within(LOCAL_KUTTA * accuracy * length), Pace::Steps)
    }

    /// The same for Radau's, which know how local errors add up.
    pub(crate) fn whole_pace(&self, length: f64, accuracy: f64) -> Pace {
        self.steps.map_or(Pace::Within(accuracy * length), Pace::Steps)
    }

    /// About the order that a series takes.
    pub(crate) fn series_order(&self) -> f64 {
        1.0 - 0.5 * libm::log(self.series_tolerance)
    }
}
