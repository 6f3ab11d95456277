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
    /// With γ = c/2m, δ² = γ² − k/m and C, S = e^(−γt) times cosh δt, sinh(δt)/δ above criticality, cos, sin with |δ|
    /// below, and 1, t at it: x = x₀ C + (v₀ + γ x₀) S, v = v₀ C − (γ v₀ + k x₀/m) S (Landau, Lifshitz, Mechanics, §
    /// 25).
    pub fn at(&self, t: f64) -> (f64, f64) {
        let gamma = self.damping / (2.0 * self.mass);
        let omega_squared = self.stiffness / self.mass;
        let square = gamma * gamma - omega_squared;
        let rate = square.abs().sqrt();
        let (c, s) = match square {
            // Below this the next term of the series, (δt)²/6, is under an ulp.
            _ if rate * t < 1e-8 => {
                let decay = libm::exp(-gamma * t);
                (decay, decay * t)
            }
            _ if square < 0.0 => {
                let decay = libm::exp(-gamma * t);
                (decay * libm::cos(rate * t), decay * libm::sin(rate * t) / rate)
            }
            // Far above criticality e^(−γt) is 0 and cosh δt is not finite, but their product is the slow mode, whose
            // rate γ − δ = (k/m)/(γ + δ) must not be a difference.
            _ => {
                let slow = libm::exp(-omega_squared / (gamma + rate) * t);
                let lost = -libm::expm1(-2.0 * rate * t);
                (slow * (1.0 - 0.5 * lost), slow * lost / (2.0 * rate))
            }
        };
        let position = self.position * c + (self.velocity + gamma * self.position) * s;
        (position, self.velocity * c - (gamma * self.velocity + omega_squared * self.position) * s)
    }
}
