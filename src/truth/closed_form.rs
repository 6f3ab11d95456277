//! Motions that have a formula. All of them start at time 0; units are SI.

use crate::engine::DVec2;
use std::f64::consts::FRAC_PI_2;

/// Where a body without drag is at time `t` [m]: p + v t + ½ g t².
pub fn projectile(position: DVec2, velocity: DVec2, gravity: DVec2, t: f64) -> DVec2 {
    position + t * (velocity + 0.5 * t * gravity)
}

/// Position [m] and velocity [m/s] under gravity and a drag that takes away the part `drag` [1/s] of the velocity every second:
/// v̇ = g − drag v, hence v = u + (v₀ − u) e^(−drag t) with the terminal velocity u = g/drag. No drag makes a projectile.
pub fn fall_with_drag(position: DVec2, velocity: DVec2, gravity: DVec2, drag: f64, t: f64) -> (DVec2, DVec2) {
    if drag == 0.0 {
        return (projectile(position, velocity, gravity, t), velocity + t * gravity);
    }
    let terminal = gravity / drag;
    // 1 − e^(−drag t), without cancellation for small drag
    let lost = -libm::expm1(-drag * t);
    let position = position + terminal * t + (velocity - terminal) * (lost / drag);
    (position, velocity + (terminal - velocity) * lost)
}

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

/// The Jacobian elliptic functions sn, cn, dn of one argument.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jacobi {
    pub sn: f64,
    pub cn: f64,
    pub dn: f64,
}

/// sn(u, k), cn(u, k), dn(u, k) with modulus 0 ≤ |k| < 1, by the arithmetic-geometric mean and the descending Landen
/// transformation (Abramowitz, Stegun, 16.4; Bulirsch, Numerical calculation of elliptic integrals and functions, 1965).
pub fn jacobi(u: f64, k: f64) -> Jacobi {
    let mut a = 1.0;
    let mut b = ((1.0 - k) * (1.0 + k)).sqrt();
    // Halves of the differences, for the way back.
    let mut levels = [(0.0, 0.0); 16];
    let mut count = 0;
    while count < levels.len() && (a - b) > 1e-16 * a {
        (a, b, levels[count]) = (0.5 * (a + b), (a * b).sqrt(), (0.5 * (a + b), 0.5 * (a - b)));
        count += 1;
    }
    let mut phase = libm::ldexp(a * u, count as i32);
    for &(a, c) in levels[..count].iter().rev() {
        phase = 0.5 * (phase + libm::asin(c / a * libm::sin(phase)));
    }
    let (sn, cn) = libm::sincos(phase);
    // Not cos φ₀ / cos(φ₁ − φ₀), which loses its digits where cn vanishes.
    Jacobi { sn, cn, dn: ((1.0 - k) * (1.0 + k) + (k * cn) * (k * cn)).sqrt() }
}

/// The complete elliptic integral of the first kind K(k).
pub fn quarter_period(k: f64) -> f64 {
    FRAC_PI_2 / mean(((1.0 - k) * (1.0 + k)).sqrt())
}

/// The arithmetic-geometric mean of 1 and `b` > 0. Quadratic convergence.
fn mean(mut b: f64) -> f64 {
    let mut a = 1.0;
    while (a - b).abs() > 1e-15 * a {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    0.5 * (a + b)
}
