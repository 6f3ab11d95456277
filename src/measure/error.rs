//! How far a motion is from the truth.

use crate::engine::DVec2;

/// Root mean square, over all bodies (those that are fixed too) and all samples, of the distance to the truth, divided by
/// `length` [m]. A sample is the centres of all bodies [m]. `None` if the two have not the same samples of the same bodies,
/// or there are none; a motion that is not finite has no finite error.
pub fn error_against(truth: &[Vec<DVec2>], motion: &[Vec<DVec2>], length: f64) -> Option<f64> {
    let same = truth.len() == motion.len() && truth.iter().zip(motion).all(|(a, b)| a.len() == b.len());
    let count = truth.iter().map(Vec::len).sum::<usize>();
    if !same || count == 0 {
        return None;
    }
    let pairs = truth.iter().flatten().zip(motion.iter().flatten());
    let sum: f64 = pairs.map(|(exact, found)| (*found - *exact).length_squared()).sum();
    Some((sum / count as f64).sqrt() / length)
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
        let wild = vec![vec![DVec2::NAN; 3]; 2];
        assert!(error_against(&truth, &wild, 1.0).is_some_and(f64::is_nan));
    }
}
