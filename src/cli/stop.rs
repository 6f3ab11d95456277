//! Ctrl-C, and the other ways in which a system asks a program to end: a long command ends in order and keeps what it
//! has.

use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

/// Exit code of a command that was stopped.
const STOPPED: u8 = 130;

/// Set when it is asked for.
pub(super) static ASKED: AtomicBool = AtomicBool::new(false);

/// From now on the first request is left to the command, and the second does not wait for it.
pub(super) fn listen() {
    crate::stop::listen(|| {
        if ASKED.swap(true, Ordering::Relaxed) {
            std::process::exit(i32::from(STOPPED));
        }
    });
}

/// Whether the command is to end.
pub(super) fn asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}

/// What it ends with then.
pub(super) fn code() -> ExitCode {
    ExitCode::from(STOPPED)
}
