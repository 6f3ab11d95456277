//! Forces in their discrete form: over a step they do exactly the work that the potential gives.
//!
//! All take the difference d at the start of the step, by how much it changes, δ, so that d_m = d + δ/2, and give the force on
//! the end that d points to together with the stiffness S = −∂force/∂δ.

use crate::engine::island::forces::{Held, Springs};
use glam::DVec2;

/// A force and its stiffness, row by row.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Linear {
    pub fx: f64,
    pub fy: f64,
    pub k: [f64; 4],
}

/// Spring i over a step of `h` seconds: −k (ℓ' + ℓ − 2 rest) / (ℓ' + ℓ) d_m (Gonzalez 1996), and its damper at mid velocity.
#[inline]
pub(super) fn spring(springs: &Springs, i: usize, (dx, dy): (f64, f64), (ex, ey): (f64, f64), h: f64) -> Linear {
    let (mx, my, nx, ny) = (dx + 0.5 * ex, dy + 0.5 * ey, dx + ex, dy + ey);
    let before = (dx * dx + dy * dy).sqrt();
    let after = (nx * nx + ny * ny).sqrt();
    let sum = before + after;
    if sum == 0.0 {
        // Coinciding ends have no direction.
        return Linear::default();
    }
    let (stiffness, rest) = (springs.stiffness[i], springs.rest[i]);
    let factor = stiffness * (1.0 - 2.0 * rest / sum);
    let along = if after > 0.0 { 2.0 * stiffness * rest / (sum * sum * after) } else { 0.0 };
    let half = 0.5 * factor;
    let (ax, ay) = (along * mx, along * my);
    let k = [half + ax * nx, ax * ny, ay * nx, half + ay * ny];
    let mut linear = Linear { fx: -factor * mx, fy: -factor * my, k };
    let square = mx * mx + my * my;
    if springs.damping[i] > 0.0 && square > 0.0 {
        // −c/h n (n·δ), n = d_m/|d_m|
        let over = springs.damping[i] / (h * square);
        let along = mx * ex + my * ey;
        linear.fx -= over * along * mx;
        linear.fy -= over * along * my;
        // ∂: d_m (d_m + δ/2)ᵀ + ½ (d_m·δ) 1 − (d_m·δ) d_m d_mᵀ/|d_m|²
        let turn = along / square;
        let (rx, ry) = (nx - turn * mx, ny - turn * my);
        let even = 0.5 * along;
        linear.k[0] += over * (mx * rx + even);
        linear.k[1] += over * mx * ry;
        linear.k[2] += over * my * rx;
        linear.k[3] += over * (my * ry + even);
    }
    linear
}

/// The mouse's hold at mid position and velocity, for a node that stood at `start` and moves by `u`.
pub(super) fn hold(held: &Held, start: DVec2, u: DVec2, h: f64) -> Linear {
    let force = -held.stiffness * (start + 0.5 * u - held.target) - held.damping / h * u;
    let slope = 0.5 * held.stiffness + held.damping / h;
    let size = force.length();
    if size <= held.most {
        return Linear { fx: force.x, fy: force.y, k: [slope, 0.0, 0.0, slope] };
    }
    let (over, n) = (held.most / size, force / size);
    let k = |i: f64, j: f64, one: f64| over * slope * (one - i * j);
    let k = [k(n.x, n.x, 1.0), k(n.x, n.y, 0.0), k(n.y, n.x, 0.0), k(n.y, n.y, 1.0)];
    Linear { fx: over * force.x, fy: over * force.y, k }
}
