//! Free flight, with and without drag.

use crate::engine::DVec2;

/// Where a body without drag is at time `t` [m]: p + v t + ½ g t².
pub fn projectile(position: DVec2, velocity: DVec2, gravity: DVec2, t: f64) -> DVec2 {
    position + t * (velocity + 0.5 * t * gravity)
}

/// Position [m] and velocity [m/s] under gravity and a drag that takes away the part `drag` [1/s] of the velocity every
/// second: v̇ = g − drag v, hence v = v₀ (1 − z φ₁) + g t φ₁ and p = p₀ + v₀ t φ₁ + g t² φ₂ with z = drag t, φ₁ = (1 −
/// e^(−z))/z and φ₂ = (1 − φ₁)/z. No drag makes a projectile, and a small one what differs little from it.
pub fn fall_with_drag(position: DVec2, velocity: DVec2, gravity: DVec2, drag: f64, t: f64) -> (DVec2, DVec2) {
    let z = drag * t;
    let (one, two) = if z < 0.5 {
        (series(z, 1), series(z, 2))
    } else {
        let one = -libm::expm1(-z) / z;
        (one, (1.0 - one) / z)
    };
    let position = position + t * (one * velocity + t * two * gravity);
    (position, velocity * libm::exp(-z) + t * one * gravity)
}

/// φₙ(z) = Σ (−z)ᵏ/(k + n)! for n of 1 or 2 and z ≤ ½, where the quotients cancel: 16 terms are exact to rounding.
fn series(z: f64, n: u32) -> f64 {
    // Horner's scheme, from the last term: 1/n! (1 − z/(n + 1) (1 − z/(n + 2) (…))).
    let nested = (1..16).rev().fold(1.0, |rest, k| 1.0 - z / f64::from(n + k) * rest);
    nested / f64::from(n)
}
