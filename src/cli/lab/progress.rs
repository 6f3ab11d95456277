//! How far a long command is, on standard error: a line that is written over on a terminal, a line now and then elsewhere.

use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};

/// Between two lines on a terminal, and elsewhere.
const QUICK: Duration = Duration::from_millis(100);
const SLOW: Duration = Duration::from_secs(5);

pub(super) struct ProgressLine {
    terminal: bool,
    last: Instant,
    shown: bool,
}

impl ProgressLine {
    pub fn new() -> ProgressLine {
        ProgressLine { terminal: std::io::stderr().is_terminal(), last: Instant::now(), shown: false }
    }

    /// Shows a line if the last one is old enough. Where nobody can be told, nothing is lost.
    pub fn tell(&mut self, line: impl FnOnce() -> String) {
        if self.last.elapsed() < if self.terminal { QUICK } else { SLOW } {
            return;
        }
        self.last = Instant::now();
        let mut err = std::io::stderr();
        let _ = if self.terminal { write!(err, "\r\x1b[K{}", line()) } else { writeln!(err, "{}", line()) };
        let _ = err.flush();
        self.shown = true;
    }

    /// Removes the line, so that something else can stand there.
    pub fn clear(&mut self) {
        if self.terminal && self.shown {
            let mut err = std::io::stderr();
            let _ = write!(err, "\r\x1b[K");
            let _ = err.flush();
            self.shown = false;
        }
    }
}

/// "40 s", "3 min"
pub(super) fn spoken(seconds: f64) -> String {
    if seconds < 100.0 { format!("{seconds:.0} s") } else { format!("{:.0} min", seconds / 60.0) }
}
