//! Requests of the system to end: Ctrl-C, a terminal that closes, a session that ends.

/// From now on `act` is called for each request, on a thread of its own. Requests that are ignored (the terminal's
/// end under nohup) stay so. Where the system does not allow it, a request ends the program at once, as it does
/// without this.
#[cfg(unix)]
pub(crate) fn listen(mut act: impl FnMut() + Send + 'static) {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let ignored = ignored();
    let heard = [SIGHUP, SIGINT, SIGTERM].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
    if let Ok(mut signals) = signal_hook::iterator::Signals::new(heard) {
        let _ = std::thread::Builder::new()
            .name("requests".to_owned())
            .spawn(move || signals.forever().for_each(|_| act()));
    }
}

#[cfg(not(unix))]
pub(crate) fn listen(act: impl FnMut() + Send + 'static) {
    let _ = ctrlc::try_set_handler(act);
}

/// Signals that this process ignores, one a bit from signal 1 on, where Linux tells it.
#[cfg(unix)]
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}
