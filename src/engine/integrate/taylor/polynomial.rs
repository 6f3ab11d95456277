//! Products of coefficients, and the values of polynomials.

/// to += a b
#[inline]
pub(super) fn add_product(to: &mut [f64], a: &[f64], b: &[f64]) {
    for ((to, a), b) in to.iter_mut().zip(a).zip(b) {
        *to += a * b;
    }
}

/// Σ c_k tᵏ
pub(super) fn horner(c: &[Vec<f64>], order: usize, t: f64, to: &mut [f64]) {
    to.copy_from_slice(&c[order]);
    for k in (0..order).rev() {
        to.iter_mut().zip(&c[k]).for_each(|(to, c)| *to = *to * t + c);
    }
}

/// Σ k c_k tᵏ⁻¹ / scale
pub(super) fn horner_rate(c: &[Vec<f64>], order: usize, t: f64, scale: f64, to: &mut [f64]) {
    to.iter_mut().zip(&c[order]).for_each(|(to, c)| *to = order as f64 * c);
    for k in (1..order).rev() {
        to.iter_mut().zip(&c[k]).for_each(|(to, c)| *to = *to * t + k as f64 * c);
    }
    to.iter_mut().for_each(|to| *to /= scale);
}

/// Σ k (k − 1) c_k tᵏ⁻² / scale²
pub(super) fn horner_second(c: &[Vec<f64>], order: usize, t: f64, scale: f64, to: &mut [f64]) {
    let weight = |k: usize| (k * (k - 1)) as f64;
    to.iter_mut().zip(&c[order]).for_each(|(to, c)| *to = weight(order) * c);
    for k in (2..order).rev() {
        to.iter_mut().zip(&c[k]).for_each(|(to, c)| *to = *to * t + weight(k) * c);
    }
    let over = 1.0 / (scale * scale);
    to.iter_mut().for_each(|to| *to *= over);
}

/// Σ c_k tᵏ of one entry.
pub(super) fn value(c: &[Vec<f64>], i: usize, t: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, c| sum * t + c[i])
}

/// Σ k c_k tᵏ⁻¹ of one entry.
pub(super) fn value_rate(c: &[Vec<f64>], i: usize, t: f64) -> f64 {
    c.iter().enumerate().skip(1).rev().fold(0.0, |sum, (k, c)| sum * t + k as f64 * c[i])
}
