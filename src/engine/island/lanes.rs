//! The largest of many values, found four side by side: one after the other each would wait for the one before.

/// Largest of values ≥ 0.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Largest {
    most: [f64; 4],
    /// Comparisons lose a NaN, a sum does not.
    sum: [f64; 4],
}

impl Largest {
    /// Takes the absolute values.
    #[inline]
    pub fn take_sizes(&mut self, values: &[f64]) {
        let (fours, rest) = values.as_chunks::<4>();
        fours.iter().for_each(|four| self.take(&four.map(f64::abs)));
        rest.iter().for_each(|value| self.take(&[value.abs()]));
    }

    #[inline]
    pub fn take(&mut self, values: &[f64]) {
        let (fours, rest) = values.as_chunks::<4>();
        for four in fours {
            for (k, value) in four.iter().enumerate() {
                self.most[k] = if *value > self.most[k] { *value } else { self.most[k] };
                self.sum[k] += value;
            }
        }
        for value in rest {
            self.most[0] = if *value > self.most[0] { *value } else { self.most[0] };
            self.sum[0] += value;
        }
    }

    /// The largest so far; NaN if one of them was, 0 if there were none.
    pub fn value(&self) -> f64 {
        let sum: f64 = self.sum.iter().sum();
        if sum.is_nan() { f64::NAN } else { self.most.iter().fold(0.0, |most: f64, value| most.max(*value)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_is_found_and_a_nan_is_not_lost() {
        let mut largest = Largest::default();
        largest.take(&[1.0, 2.0, 7.0, 3.0, 5.0]);
        largest.take(&[6.0]);
        assert_eq!(largest.value(), 7.0);
        largest.take(&[0.0, f64::NAN, 1.0, 2.0]);
        largest.take(&[9.0; 8]);
        assert!(largest.value().is_nan());
        assert_eq!(Largest::default().value(), 0.0);
    }
}
