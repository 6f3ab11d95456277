//! Motion between two events, in closed form: constant forces, and a drag that takes the same part of every velocity.

use glam::DVec2;

/// Up to this part of a decay the weights come from their series, which does not cancel.
const SERIES: f64 = 0.25;

/// v̇ = a − drag v [1/s] for every velocity, that of turning included.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Drag(pub f64);

/// What is left of a velocity after a time, and how far velocity and force have carried.
#[derive(Clone, Copy, Debug)]
pub(super) struct Weights {
    /// e^(−drag t)
    pub kept: f64,
    /// s(t) = (1 − e^(−drag t))/drag [s]
    pub first: f64,
    /// (t − s)/drag [s²]
    pub second: f64,
}

impl Drag {
    /// v(t) = kept v + first a, x(t) = x + first v + second a.
    pub fn weights(self, t: f64) -> Weights {
        let z = self.0 * t;
        if z == 0.0 {
            return Weights { kept: 1.0, first: t, second: 0.5 * t * t };
        }
        if z < SERIES {
            // Σ (−z)^k / (k + 2)!, by Horner; the last term is below an ulp of the first.
            let second = (0..12).rev().fold(0.0, |sum, k| (1.0 - z * sum) / f64::from(k + 2)) * t * t;
            let first = t - self.0 * second;
            return Weights { kept: 1.0 - self.0 * first, first, second };
        }
        let first = -libm::expm1(-z) / self.0;
        Weights { kept: libm::exp(-z), first, second: (t - first) / self.0 }
    }
}

/// Where a body is, how fast it moves and what drives it, at one instant; holds until the next event.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Path {
    /// The instant, from the start of the step [s].
    pub since: f64,
    /// [m]
    pub position: DVec2,
    /// [m/s]
    pub velocity: DVec2,
    /// All forces but drag over the mass [m/s²].
    pub drive: DVec2,
    /// [rad]
    pub angle: f64,
    /// [rad/s]
    pub omega: f64,
    /// All torques but drag over the moment of inertia [rad/s²].
    pub turn: f64,
}

impl Path {
    /// The same path, told from another instant [s].
    pub fn at(&self, time: f64, drag: Drag) -> Path {
        let Weights { kept, first, second } = drag.weights(time - self.since);
        Path {
            since: time,
            position: self.position + first * self.velocity + second * self.drive,
            velocity: kept * self.velocity + first * self.drive,
            angle: self.angle + first * self.omega + second * self.turn,
            omega: kept * self.omega + first * self.turn,
            ..*self
        }
    }

    /// Motion of the centre against another's of the same instant.
    pub fn against(&self, other: &Path) -> Path {
        Path {
            since: self.since,
            position: self.position - other.position,
            velocity: self.velocity - other.velocity,
            drive: self.drive - other.drive,
            ..Path::default()
        }
    }

    /// A speed of the surface at `arm` [m] from the centre below which nothing but rounding is left [m/s].
    pub fn rounding_speed(&self, arm: f64) -> f64 {
        1e-14 * (self.velocity.length() + arm * self.omega.abs())
    }

    /// Magnitude of the acceleration [m/s²], which drag only lessens as time goes on.
    pub fn acceleration(&self, drag: Drag) -> f64 {
        (self.drive - drag.0 * self.velocity).length()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_and_formula_of_the_weights_agree() {
        for (drag, t) in [(0.9, 0.27), (20.0, 0.012_4), (0.249, 1.0), (1e-3, 1.0)] {
            let (near, z) = (Drag(drag).weights(t), drag * t);
            let exact = (-f64::exp_m1(-z) / drag, (z + f64::exp_m1(-z)) / (drag * drag));
            assert!((near.kept - f64::exp(-z)).abs() < 1e-15);
            assert!((near.first / exact.0 - 1.0).abs() < 1e-15, "{drag}");
            // The formula cancels; the series does not.
            assert!((near.second / exact.1 - 1.0).abs() < 1e-15 / (z * z), "{drag}");
        }
    }
}
