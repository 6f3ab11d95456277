//! Figures that a test measures: printed one by one, held against their limits, all failures reported together.

/// The figures of one test. Dropping it fails the test if any figure broke its limit.
#[derive(Default)]
pub struct Figures {
    broken: Vec<String>,
}

impl Figures {
    /// `measured` must not exceed `limit`; NaN never passes.
    pub fn at_most(&mut self, what: &str, measured: f64, limit: f64) {
        self.judge(measured <= limit, format!("{what}: {measured:.3e}, at most {limit:.3e}"));
    }

    /// `measured` must be within `tolerance` of `expected`.
    pub fn near(&mut self, what: &str, measured: f64, expected: f64, tolerance: f64) {
        let off = measured - expected;
        let line = format!("{what}: {measured:.9}, expected {expected:.9}, off {off:.2e}, at most {tolerance:.2e}");
        self.judge(off.abs() <= tolerance, line);
    }

    fn judge(&mut self, holds: bool, line: String) {
        println!("{} {line}", if holds { "  " } else { "! " });
        if !holds {
            self.broken.push(line);
        }
    }
}

impl Drop for Figures {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            assert!(self.broken.is_empty(), "{} figures off:\n{}", self.broken.len(), self.broken.join("\n"));
        }
    }
}

/// Observed order of convergence: the slope of log error over log step between the coarsest and the finest of `errors`, of
/// which each was measured with half the step of the one before.
pub fn order(errors: &[f64]) -> f64 {
    let halvings = (errors.len() - 1) as f64;
    (errors[0] / errors[errors.len() - 1]).log2() / halvings
}
