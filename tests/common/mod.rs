//! What several test files share.

/// The value, or `None` with a word on what is skipped and why. With `TAUTLINE_REQUIRE_DISPLAY=1` set, as on machines that
/// were prepared for every test, a missing piece is a failure instead.
pub fn require<T, E: std::fmt::Display>(what: &str, found: Result<T, E>) -> Option<T> {
    match found {
        Ok(found) => Some(found),
        Err(reason) => {
            let skipped = format!("skipped, for want of {what}: {reason}");
            assert!(std::env::var_os("TAUTLINE_REQUIRE_DISPLAY").is_none_or(|value| value != "1"), "{skipped}");
            eprintln!("{skipped}");
            None
        }
    }
}
