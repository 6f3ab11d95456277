//! How fast the window is: time to the first frame, time of the panels' code, time from an input to the frame that answers it.

use std::time::{Duration, Instant};

/// Collects times; prints them on standard error at the end if `TAUTLINE_TIMING` is set.
pub struct Timing {
    start: Instant,
    wanted: bool,
    first_frame: Option<Duration>,
    /// Time of the panels' code in each pass [ms].
    panels: Vec<f64>,
    /// When the oldest input came that no frame has answered yet.
    input: Option<Instant>,
    /// Time from an input to the end of the frame that answers it [ms].
    answers: Vec<f64>,
}

impl Timing {
    /// Starts the clock.
    pub fn start() -> Timing {
        let wanted = std::env::var_os("TAUTLINE_TIMING").is_some_and(|value| !value.is_empty() && value != "0");
        Timing {
            start: Instant::now(),
            wanted,
            first_frame: None,
            panels: Vec::new(),
            input: None,
            answers: Vec::new(),
        }
    }

    /// An input came.
    pub fn input(&mut self) {
        self.input.get_or_insert_with(Instant::now);
    }

    /// The panels' code of one pass took this long.
    pub fn panels(&mut self, time: Duration) {
        if self.wanted {
            self.panels.push(1e3 * time.as_secs_f64());
        }
    }

    /// A frame is on its way to the screen.
    pub fn frame(&mut self) {
        if self.first_frame.is_none() {
            let time = self.start.elapsed();
            self.first_frame = Some(time);
            log::info!("first frame after {:.0} ms", 1e3 * time.as_secs_f64());
            if self.wanted {
                eprintln!("first frame: {:.0} ms", 1e3 * time.as_secs_f64());
            }
        }
        if let Some(input) = self.input.take().filter(|_| self.wanted) {
            self.answers.push(1e3 * input.elapsed().as_secs_f64());
        }
    }

    /// Prints what was collected.
    pub fn report(&mut self) {
        if !self.wanted {
            return;
        }
        for (name, times) in [("panels", &mut self.panels), ("input to frame", &mut self.answers)] {
            times.sort_unstable_by(f64::total_cmp);
            let part =
                |share: f64| times.get(((times.len() as f64 * share) as usize).min(times.len().saturating_sub(1)));
            if let (Some(median), Some(p99), Some(worst)) = (part(0.5), part(0.99), part(1.0)) {
                let count = times.len();
                eprintln!("{name}: median {median:.2} ms, 99 % within {p99:.2} ms, worst {worst:.2} ms of {count}");
            }
        }
    }
}
