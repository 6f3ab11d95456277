//! A mass on a spring, in all regimes of damping.

/// Mass on a spring with damping: m ẍ + c ẋ + k x = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oscillator {
    /// [kg]
    pub mass: f64,
    /// k [N/m]
    pub stiffness: f64,
    /// c [N·s/m]
    pub damping: f64,
    /// Displacement at time 0 [m].
    pub position: f64,
    /// [m/s]
    pub velocity: f64,
}

impl Oscillator {
    /// Displacement [m] and velocity [m/s] at time `t`, whether it is damped below, at or above criticality.
    ///
    /// With γ = c/2m, δ² = γ² − k/m: x = e^(−γt) (x₀ C + (v₀ + γ x₀) S), where C, S = cosh δt, sinh(δt)/δ above criticality,
    /// cos, sin with |δ| below, and 1, t at it (Landau, Lifshitz, Mechanics, § 25).
    pub fn at(&self, t: f64) -> (f64, f64) {
        let gamma = self.damping / (2.0 * self.mass);
        let square = gamma * gamma - self.stiffness / self.mass;
        let rate = square.abs().sqrt();
        let (c, s) = match square {
            // Below this the next term of the series, (δt)²/6, is under an ulp.
            _ if rate * t < 1e-8 => (1.0, t),
            _ if square < 0.0 => (libm::cos(rate * t), libm::sin(rate * t) / rate),
            _ => (libm::cosh(rate * t), libm::sinh(rate * t) / rate),
        };
        let (decay, slope) = (libm::exp(-gamma * t), self.velocity + gamma * self.position);
        let position = decay * (self.position * c + slope * s);
        // C' = δ² S, S' = C
        (position, decay * (self.position * square * s + slope * c) - gamma * position)
    }
}
