//! A logarithmic axis from one power of ten to another.

/// What an error of zero is drawn as: below anything that a double resolves of a length.
const SMALLEST: f64 = 1e-18;

/// An axis that shows `10^low` to `10^high`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Axis {
    pub low: i32,
    pub high: i32,
}

impl Axis {
    /// The shortest axis that shows all `values`; one decade at least. `None` without a value.
    pub fn over(values: impl Iterator<Item = f64>) -> Option<Axis> {
        let logs = values.filter(|value| value.is_finite()).map(decades);
        let (low, high) =
            logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), log| (low.min(log), high.max(log)));
        if low > high {
            return None;
        }
        let (low, high) = (low.floor() as i32, high.ceil() as i32);
        Some(Axis { low, high: high.max(low + 1) })
    }

    /// Where a value stands: 0 at the low end, 1 at the high end; the ends for what is beyond them.
    pub fn place(self, value: f64) -> f64 {
        ((decades(value) - f64::from(self.low)) / f64::from(self.high - self.low)).clamp(0.0, 1.0)
    }

    /// Exponents of the powers of ten that are labelled: at most `most`, evenly spaced.
    pub fn ticks(self, most: i32) -> impl DoubleEndedIterator<Item = i32> {
        let every = ((self.high - self.low) / most.max(1)).max(0) + 1;
        (self.low..=self.high).filter(move |exponent| exponent.rem_euclid(every) == 0)
    }
}

fn decades(value: f64) -> f64 {
    libm::log10(value.max(SMALLEST))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_covers_its_values_in_whole_decades() {
        let axis = Axis::over([3e-5, 0.2, f64::NAN].into_iter()).unwrap();
        assert_eq!(axis, Axis { low: -5, high: 0 });
        assert!((axis.place(1e-4) - 0.2).abs() < 1e-12);
        assert_eq!((axis.place(1e-9), axis.place(1e9)), (0.0, 1.0));
        assert_eq!(axis.ticks(10).collect::<Vec<_>>(), [-5, -4, -3, -2, -1, 0]);
        assert_eq!(axis.ticks(3).collect::<Vec<_>>(), [-4, -2, 0]);
        assert_eq!(Axis::over([10.0].into_iter()), Some(Axis { low: 1, high: 2 }));
        assert_eq!(Axis::over(std::iter::empty()), None);
    }
}
