//! How many steps an integrator of fixed order takes.

/// What an island is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Pace {
    /// So many steps, or more where they would not be stable.
    Steps(u32),
    /// As few as keep the sum of the local errors below so much [m].
    Within(f64),
}

/// Errors are estimates: a little too large is let pass.
pub(super) const SLACK: f64 = 1.5;

impl Pace {
    /// Whether an estimate [m] is within what is asked for; NaN is not.
    pub fn keeps(self, error: f64) -> bool {
        match self {
            Pace::Steps(_) => true,
            Pace::Within(tolerance) => error <= SLACK * tolerance,
        }
    }
}

/// The steps to take instead of `steps`, where the local errors' sum is `excess` times what is allowed and falls with the power
/// `order` of the number of steps; none if they will do.
pub(super) fn steps_within(steps: f64, excess: f64, order: f64) -> Option<f64> {
    if excess <= SLACK {
        return None;
    }
    Some(libm::ceil(steps * libm::pow(excess, 1.0 / order)).max(steps + 1.0))
}
