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

/// What the velocity's error adds to a smooth motion's, in parts of the local errors of steps as long as the time. Fitted to
/// the truth scenes: less lets the pendulum be 3.4e-4 off after 10 s at 3e-4. The midpoint rule does not look for what it leaves
/// unresolved in nets, and the rigid net is 1.8e-4 off after a second with estimates of 4e-8 a step.
pub(super) const SMOOTH: f64 = 6.0;
pub(super) const SMOOTH_NET: f64 = 60.0;

/// Factor on the local errors of equal steps of a method of order 2. Where one step does for the time the motion is smooth, and
/// errors of the velocity are carried on in one direction; where many are needed it swings, and they come to nothing.
pub(super) fn carried_on(steps: f64, smooth: f64) -> f64 {
    1.0 + smooth / (steps * steps * steps)
}

/// The part of what is allowed that fewer steps the next time may be expected to leave.
const MUCH_LESS: f64 = 0.4;
/// How many fewer at most.
const FEWER: f64 = 0.8;

/// The steps to begin the next time with, after `steps` with local errors of `excess` times what is allowed: more where it was let pass
/// as an estimate, fewer where those would clearly do, mostly the same, so that nothing is tried in vain and errors that cancel from one
/// time to the next are equal.
pub(super) fn steps_next(steps: f64, excess: f64, order: f64, smooth: f64) -> u32 {
    if excess > 1.0 {
        return steps as u32 + 1;
    }
    let fewest = libm::floor(FEWER * steps).max(1.0);
    let fewer = libm::ceil(steps * libm::pow(excess / MUCH_LESS, 1.0 / order)).max(fewest);
    let carried = carried_on(fewer, smooth) / carried_on(steps, smooth);
    let will_do = fewer < steps && excess * carried * libm::pow(steps / fewer, order) < MUCH_LESS;
    (if will_do { fewer } else { steps }) as u32
}

/// The steps to take instead of `steps`, where the local errors' sum is `excess` times what is allowed and falls with the power
/// `order` of the number of steps; none if they will do.
pub(super) fn steps_within(steps: f64, excess: f64, order: f64) -> Option<f64> {
    if excess <= SLACK {
        return None;
    }
    Some(libm::ceil(steps * libm::pow(excess, 1.0 / order)).max(steps + 1.0))
}
