//! The clock that costs are measured with.

/// What the clock counts, for a report.
#[cfg(unix)]
pub const CLOCK: &str = "CPU time of the measuring thread";
/// What the clock counts, for a report.
#[cfg(not(unix))]
pub const CLOCK: &str = "time on the wall: this system tells no CPU time of a thread";

/// CPU time of this thread [ns].
#[cfg(unix)]
pub fn thread_nanoseconds() -> u64 {
    let now = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    now.tv_sec as u64 * 1_000_000_000 + now.tv_nsec as u64
}

/// Time on the wall [ns].
#[cfg(not(unix))]
pub fn thread_nanoseconds() -> u64 {
    static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    START.get_or_init(std::time::Instant::now).elapsed().as_nanos() as u64
}
