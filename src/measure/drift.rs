//! How far the energy has drifted, against what the motion has moved of it.

use super::Measures;

/// Parts of all energy below which what has moved is rounding.
const ROUNDING: f64 = 1e-12;

/// The drift of a run's energy from its start.
///
/// Relative to E₀ it would depend on where the height is zero. So it is divided by the energy that the motion has to do with:
/// the largest kinetic energy so far plus the spread of the potential and elastic energy so far. Drag, dampers, friction,
/// impacts with e < 1 and the mouse change the energy by themselves; their work is part of the drift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyDrift {
    /// [J]
    first: f64,
    largest_kinetic: f64,
    /// Lowest and highest sum of potential and elastic energy [J].
    stored: [f64; 2],
    /// Energy now, less that at first [J].
    difference: f64,
    /// Sum of the sizes of all energies now [J].
    size: f64,
}

impl EnergyDrift {
    /// A run that begins with `start`.
    pub fn new(start: &Measures) -> EnergyDrift {
        let stored = start.potential + start.elastic;
        let mut drift = EnergyDrift {
            first: start.total_energy(),
            largest_kinetic: 0.0,
            stored: [stored, stored],
            difference: 0.0,
            size: 0.0,
        };
        drift.see(start);
        drift
    }

    /// Takes in another instant, and says the drift there.
    pub fn see(&mut self, now: &Measures) -> f64 {
        let stored = now.potential + now.elastic;
        self.largest_kinetic = self.largest_kinetic.max(now.kinetic);
        self.stored = [self.stored[0].min(stored), self.stored[1].max(stored)];
        self.difference = now.total_energy() - self.first;
        self.size = now.kinetic + now.potential.abs() + now.elastic;
        self.relative()
    }

    /// The drift at the instant seen last, in parts of [`EnergyDrift::scale`]; 0 while nothing has moved but rounding.
    pub fn relative(&self) -> f64 {
        let scale = self.scale();
        if scale > ROUNDING * self.size { self.difference / scale } else { 0.0 }
    }

    /// What the drift is divided by [J].
    pub fn scale(&self) -> f64 {
        self.largest_kinetic + (self.stored[1] - self.stored[0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(kinetic: f64, potential: f64, elastic: f64) -> Measures {
        Measures { kinetic, potential, elastic, ..Measures::default() }
    }

    #[test]
    fn the_drift_does_not_depend_on_where_the_height_is_zero() {
        for height in [0.0, 1000.0] {
            let mut drift = EnergyDrift::new(&at(0.0, height, 0.0));
            // Fell by 10 J, of which 9 J are motion: a tenth of a half is lost.
            assert_eq!(drift.see(&at(9.0, height - 10.0, 0.0)), -1.0 / 19.0);
            assert_eq!(drift.scale(), 19.0);
            // Back at the top: the scale stays.
            assert_eq!(drift.see(&at(0.0, height - 0.5, 0.0)), -0.5 / 19.0);
        }
    }

    #[test]
    fn what_only_rounds_has_no_drift() {
        let mut drift = EnergyDrift::new(&at(0.0, 1e6, 0.0));
        assert_eq!(drift.relative(), 0.0);
        assert_eq!(drift.see(&at(0.0, 1e6 + 1e-9, 0.0)), 0.0);
        assert_eq!(EnergyDrift::new(&at(0.0, 0.0, 0.0)).relative(), 0.0);
    }
}
