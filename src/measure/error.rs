//! How far a motion is from the truth.

use crate::engine::DVec2;

/// How far one instant of a motion is from the truth, over all bodies (those that are fixed too) [m].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Distance {
    /// Root mean square.
    pub rms: f64,
    /// Largest.
    pub max: f64,
}

/// The distance from the truth over many instants.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ErrorSum {
    /// Sum of the squared distances [m²].
    squares: f64,
    count: usize,
    /// The largest distance, NaN if any was [m].
    max: f64,
    samples: usize,
}

impl ErrorSum {
    /// Takes in an instant: where bodies should be and where they are [m]. `None`, and nothing is taken in, if these are not the
    /// same bodies or there are none; a motion that is not finite has no finite distance.
    pub fn add(&mut self, exact: &[DVec2], found: &[DVec2]) -> Option<Distance> {
        if exact.len() != found.len() || exact.is_empty() {
            return None;
        }
        let mut instant = ErrorSum { count: exact.len(), ..ErrorSum::default() };
        for (exact, found) in exact.iter().zip(found) {
            let distance = (*found - *exact).length();
            instant.squares += distance * distance;
            instant.max = larger(instant.max, distance);
        }
        self.squares += instant.squares;
        self.count += instant.count;
        self.max = larger(self.max, instant.max);
        self.samples += 1;
        Some(Distance { rms: instant.rms(), max: instant.max })
    }

    /// Root mean square over all bodies and instants [m]; 0 if there were none.
    pub fn rms(&self) -> f64 {
        (self.squares / self.count.max(1) as f64).sqrt()
    }

    /// Largest distance of any body at any instant [m].
    pub fn max(&self) -> f64 {
        self.max
    }

    /// Instants taken in.
    pub fn samples(&self) -> usize {
        self.samples
    }
}

/// The larger of two, NaN if either is.
fn larger(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}

/// Root mean square, over all bodies (those that are fixed too) and all samples, of the distance to the truth, divided by
/// `length` [m]. A sample is the centres of all bodies [m]. `None` if the two have not the same samples of the same bodies,
/// or there are none; a motion that is not finite has no finite error.
pub fn error_against(truth: &[Vec<DVec2>], motion: &[Vec<DVec2>], length: f64) -> Option<f64> {
    let mut sum = ErrorSum::default();
    if truth.len() != motion.len() || truth.is_empty() {
        return None;
    }
    for (exact, found) in truth.iter().zip(motion) {
        sum.add(exact, found)?;
    }
    Some(sum.rms() / length)
}

/// The order that two errors show of which the second was made with half the step: log₂(coarse/fine). `None` where one is 0 or
/// not finite. Without a truth the distances of runs with h and h/2, and of those with h/2 and h/4, do as well (Richardson).
pub fn observed_order(coarse: f64, fine: f64) -> Option<f64> {
    let order = (coarse / fine).log2();
    (coarse > 0.0 && order.is_finite()).then_some(order)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_counts_every_body_and_sample_once() {
        let fixed = DVec2::ZERO;
        let truth = vec![vec![fixed, DVec2::new(1.0, 0.0)]; 2];
        let motion = vec![truth[0].clone(), vec![fixed, DVec2::new(1.0, 4.0)]];
        // One of four distances is 4 m: √(16/4) = 2 m, over 10 m.
        assert_eq!(error_against(&truth, &motion, 10.0), Some(0.2));
        assert_eq!(error_against(&truth, &truth, 10.0), Some(0.0));
    }

    #[test]
    fn what_cannot_be_compared_has_no_error() {
        let truth = vec![vec![DVec2::ZERO; 3]; 2];
        assert_eq!(error_against(&truth, &truth[..1], 1.0), None);
        assert_eq!(error_against(&truth, &[vec![DVec2::ZERO; 3], vec![DVec2::ZERO; 2]], 1.0), None);
        assert_eq!(error_against(&[], &[], 1.0), None);
        assert_eq!(ErrorSum::default().add(&[], &[]), None);
        let wild = vec![vec![DVec2::NAN; 3]; 2];
        assert!(error_against(&truth, &wild, 1.0).is_some_and(f64::is_nan));
    }

    #[test]
    fn instants_add_up_to_the_error_of_the_whole() {
        let truth = vec![vec![DVec2::ZERO, DVec2::X]; 2];
        let motion = vec![vec![DVec2::new(3.0, 4.0), DVec2::X], vec![DVec2::ZERO, DVec2::new(2.0, 0.0)]];
        let mut sum = ErrorSum::default();
        let first = sum.add(&truth[0], &motion[0]).unwrap();
        assert_eq!((first.rms, first.max), (12.5f64.sqrt(), 5.0));
        sum.add(&truth[1], &motion[1]).unwrap();
        assert_eq!((sum.rms(), sum.max(), sum.samples()), (6.5f64.sqrt(), 5.0, 2));
        assert_eq!(error_against(&truth, &motion, 1.0), Some(sum.rms()));
        sum.add(&truth[0], &[DVec2::NAN, DVec2::X]).unwrap();
        assert!(sum.max().is_nan() && sum.rms().is_nan());
    }

    #[test]
    fn the_order_is_how_often_the_error_halves() {
        assert_eq!(observed_order(1.6e-3, 1e-4), Some(4.0));
        assert_eq!(observed_order(0.5, 1.0), Some(-1.0));
        for (coarse, fine) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (f64::NAN, 1.0), (1.0, f64::INFINITY)] {
            assert_eq!(observed_order(coarse, fine), None, "{coarse}, {fine}");
        }
    }
}
