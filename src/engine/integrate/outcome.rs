//! What an integrator of islands says of its work, and how it retries smaller.

/// Halvings of a step before the run counts as failed.
const MOST_HALVINGS: u32 = 10;

/// What an integrator says of the time it carried an island through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Outcome {
    /// Steps taken, and those taken back.
    pub steps: u32,
    pub retries: u32,
    /// Newton iterations of the implicit methods.
    pub solves: u32,
    /// Highest order used.
    pub order: u32,
    /// Estimate of the local errors' sum [m].
    pub error: f64,
    /// The equations could not be solved to the tolerance.
    pub failed: bool,
    /// Nothing was done, as an implicit method would do it in fewer steps.
    pub stiff: bool,
    /// The estimate is within what was asked for; true as well where nothing was.
    pub kept: bool,
    /// Equal steps for the next time to begin with, where an accuracy is asked for; 0 if nothing is known.
    pub next: u32,
}

impl Default for Outcome {
    fn default() -> Outcome {
        Outcome {
            steps: 0,
            retries: 0,
            solves: 0,
            order: 0,
            error: 0.0,
            failed: false,
            stiff: false,
            kept: true,
            next: 0,
        }
    }
}

/// One step of `whole` seconds, in parts where it has to be: `step` says whether a step of so many seconds went well, and
/// changes nothing where it did not. A part grows again after two that went well.
pub(super) fn in_parts(whole: f64, outcome: &mut Outcome, mut step: impl FnMut(f64) -> bool) -> bool {
    let finest = 1u32 << MOST_HALVINGS;
    let (mut done, mut part) = (0, finest);
    while done < finest {
        if step(whole * f64::from(part) / f64::from(finest)) {
            outcome.steps += 1;
            done += part;
            if done % (2 * part) == 0 && part < finest {
                part *= 2;
            }
        } else {
            outcome.retries += 1;
            part /= 2;
            if part == 0 {
                return false;
            }
        }
    }
    true
}
