//! The loop of a run: step, look, write.

use super::super::stop;
use super::rows::Rows;
use super::watch::Watch;
use crate::engine::{Divergence, Method, StepReport, Stepper, World};
use std::sync::OnceLock;
use std::time::Instant;

/// How long to run and when to write [s].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sampling {
    pub seconds: f64,
    pub every: f64,
}

impl Sampling {
    /// The step nearest to sample `index`, at `hz` steps a second.
    fn step_of(&self, index: u64, hz: f64) -> u64 {
        (index as f64 * self.every * hz).round() as u64
    }
}

/// What a run ended with.
#[derive(Clone, Debug)]
pub(super) struct Finish {
    /// The last good state.
    pub world: World,
    pub steps: u64,
    /// Set if the run diverged, which ended it.
    pub divergence: Option<Divergence>,
    /// Whether the user ended it.
    pub stopped: bool,
    /// Where an accuracy was wanted and not kept.
    pub lapses: Lapses,
}

/// Steps under a wanted accuracy in which it was not kept.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Lapses {
    /// Steps in which an island was carried by a method that did not reach it, and nothing went through the substeps.
    short: u64,
    /// Steps in which something went through the substeps.
    steps: u64,
    /// Those in which something was near to an island, and in which an island could not be carried.
    near: u64,
    lost: u64,
}

impl Lapses {
    fn add(&mut self, report: &StepReport) {
        if report.substeps == 0 {
            self.short += u64::from(report.lapsed > 0);
            return;
        }
        self.steps += 1;
        self.near += u64::from(report.near > 0);
        self.lost += u64::from(report.given_up > 0);
    }

    /// For the summary of a run of so many steps: nothing if there are none.
    pub fn summary(&self, of: u64) -> String {
        let Lapses { short, steps, near, lost } = *self;
        let no_method = "no method reaches it for what a step may cost";
        let why = match (near, lost) {
            _ if steps == 0 && short == 0 => return String::new(),
            _ if steps == 0 => return format!("; accuracy not kept in {short} of {of} steps: {no_method}"),
            (0, 0) => "bodies can touch".to_owned(),
            (_, 0) => "something was near".to_owned(),
            (0, _) => "they could not be carried to it".to_owned(),
            _ => format!("something was near in {near}, {lost} could not be carried to it"),
        };
        let more = if short > 0 { format!("; nor in {short} more: {no_method}") } else { String::new() };
        format!("; accuracy not kept in {steps} of {of} steps, which went through the substeps: {why}{more}")
    }
}

/// Steps `world` for `sampling.seconds` and writes rows on the way. Stops early on divergence, and when asked to.
pub(super) fn run(
    mut world: World,
    method: Method,
    sampling: Sampling,
    rows: &mut Rows,
    watch: &mut Watch,
) -> anyhow::Result<Finish> {
    let mut stepper = Stepper::new(method)?.with_clock(nanoseconds);
    // There are no rows between steps, and a step may hold a billion samples.
    let sampling = Sampling { every: sampling.every.max(method.step_seconds()), ..sampling };
    let last = (sampling.seconds * method.hz).round() as u64;
    rows.headers()?;
    rows.write(&world, &watch.look(&world), Since::default())?;
    let mut sample = 1;
    let mut since_row = Sums::default();
    let mut lapses = Lapses::default();
    let mut steps = 0;
    for step in 1..=last {
        if stop::asked() {
            break;
        }
        let report = stepper.step(&mut world);
        if let Some(divergence) = report.divergence {
            return Ok(Finish { world, steps, divergence: Some(divergence), stopped: false, lapses });
        }
        if method.automatic {
            lapses.add(&report);
        }
        since_row.add(&report, method.automatic && report.substeps > 0);
        steps = step;
        watch.step(&report);
        let seen = watch.look(&world);
        if step >= sampling.step_of(sample, method.hz) {
            rows.write(&world, &seen, since_row.take())?;
            while sampling.step_of(sample, method.hz) <= step {
                sample += 1;
            }
        }
    }
    Ok(Finish { world, steps, divergence: None, stopped: steps < last, lapses })
}

/// What the steps since the row before tell.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Since {
    /// Mean time of a step [µs].
    pub step_us: f64,
    /// Largest estimate of a step's local error, in parts of an island's size; not finite where one had none.
    pub local_error: f64,
}

#[derive(Default)]
struct Sums {
    step_us: f64,
    steps: f64,
    local_error: f64,
}

impl Sums {
    /// Takes a step in; one that `lapsed` has no estimate.
    fn add(&mut self, report: &StepReport, lapsed: bool) {
        self.step_us += report.step_us;
        self.steps += 1.0;
        self.local_error = self.local_error.max(if lapsed { f64::INFINITY } else { report.local_error });
    }

    fn take(&mut self) -> Since {
        let Sums { step_us, steps, local_error } = std::mem::take(self);
        Since { step_us: step_us / steps, local_error }
    }
}

/// Nanoseconds since the first call.
fn nanoseconds() -> u64 {
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed().as_nanos() as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_summary_says_in_how_many_steps_the_accuracy_was_not_kept_and_why() {
        let kept = StepReport::default;
        let short = || StepReport { lapsed: 1, ..kept() };
        let lost = || StepReport { given_up: 1, substeps: 4, ..kept() };
        let summary = |reports: &[StepReport]| {
            let mut lapses = Lapses::default();
            reports.iter().for_each(|report| lapses.add(report));
            lapses.summary(reports.len() as u64)
        };
        assert_eq!(summary(&[kept(), kept()]), "");
        let no_method = "no method reaches it for what a step may cost";
        assert_eq!(summary(&[kept(), short(), kept()]), format!("; accuracy not kept in 1 of 3 steps: {no_method}"));
        let substeps =
            "; accuracy not kept in 1 of 2 steps, which went through the substeps: they could not be carried to it";
        assert_eq!(summary(&[kept(), lost()]), substeps);
        assert!(summary(&[short(), lost(), short()]).ends_with(&format!("; nor in 2 more: {no_method}")));
    }
}
