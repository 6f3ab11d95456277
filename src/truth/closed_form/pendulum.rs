//! The pendulum of any amplitude, by elliptic functions.

use super::elliptic::{Jacobi, jacobi, mean};
use crate::engine::DVec2;
use std::f64::consts::FRAC_PI_2;

/// A mass on a rigid rod, let go at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pendulum {
    /// [m]
    pub length: f64,
    /// Downwards [m/s²].
    pub gravity: f64,
    /// Angle at time 0 from straight down, counter-clockwise, between −π and π [rad].
    pub amplitude: f64,
}

impl Pendulum {
    /// The mass at time `t`, from the pivot [m], to a few ulps for dozens of swings.
    ///
    /// sin(θ/2) = k cd(ω t, k) with k = sin(amplitude/2), ω² = g/L (Whittaker, Analytical Dynamics, § 44).
    pub fn at(&self, t: f64) -> DVec2 {
        let k = libm::sin(0.5 * self.amplitude);
        let Jacobi { cn, dn, .. } = jacobi(self.rate() * t, k);
        let sine = k * cn / dn;
        // cos(θ/2) = k'/dn(u)
        let cosine = libm::cos(0.5 * self.amplitude) / dn;
        self.length * DVec2::new(2.0 * sine * cosine, 2.0 * sine * sine - 1.0)
    }

    /// Time of a whole swing to and fro [s]: 2π/ω divided by the arithmetic-geometric mean of 1 and cos(amplitude/2) (Gauss).
    pub fn period(&self) -> f64 {
        4.0 * FRAC_PI_2 / (self.rate() * mean(libm::cos(0.5 * self.amplitude)))
    }

    /// ω of small swings [rad/s].
    fn rate(&self) -> f64 {
        (self.gravity / self.length).sqrt()
    }
}
