//! Elliptic functions and integrals by the arithmetic-geometric mean.

use std::f64::consts::FRAC_PI_2;

/// The Jacobian elliptic functions sn, cn, dn of one argument.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jacobi {
    /// sin φ of the amplitude φ(u), −1 … 1.
    pub sn: f64,
    /// cos φ, −1 … 1.
    pub cn: f64,
    /// √(1 − k² sin² φ) = dφ/du, √(1 − k²) … 1.
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
pub(super) fn mean(mut b: f64) -> f64 {
    let mut a = 1.0;
    while (a - b).abs() > 1e-15 * a {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    0.5 * (a + b)
}
