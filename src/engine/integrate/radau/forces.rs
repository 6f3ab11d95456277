//! Forces at the stages, and how they change with positions and velocities.

use super::stages::{Stages, Values};
use crate::engine::island::System;
use crate::engine::island::forces::{Held, Springs};
use crate::engine::linalg::complex::Complex;
use glam::DVec2;

/// A 2 × 2 block, row by row.
pub(super) type Block<const L: usize> = [Complex<L>; 4];

/// Minus the derivatives of a force by position and velocity, row by row.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Slopes {
    position: [f64; 4],
    velocity: [f64; 4],
}

impl Slopes {
    /// h² μ² K + h μ D
    #[inline(always)]
    pub fn block<const L: usize>(&self, rate: Complex<L>, square: Complex<L>) -> Block<L> {
        std::array::from_fn(|i| square.scaled(self.position[i]) + rate.scaled(self.velocity[i]))
    }

    /// The same with both parts made symmetric.
    pub fn symmetric(mut self) -> Slopes {
        for k in [&mut self.position, &mut self.velocity] {
            let even = 0.5 * (k[1] + k[2]);
            (k[1], k[2]) = (even, even);
        }
        self
    }
}

/// Force of spring i on the end that d points to, over d, at every stage [N/m].
#[inline(always)]
pub(super) fn spring_factor<const S: usize>(
    springs: &Springs,
    i: usize,
    d: &[Values<S>; 2],
    w: &[Values<S>; 2],
) -> Values<S> {
    std::array::from_fn(|j| {
        let square = d[0][j] * d[0][j] + d[1][j] * d[1][j];
        if square == 0.0 {
            // Coinciding ends have no direction.
            return 0.0;
        }
        let mut factor = -springs.stiffness[i] * (1.0 - springs.rest[i] / square.sqrt());
        if springs.damping[i] > 0.0 {
            factor -= springs.damping[i] * (d[0][j] * w[0][j] + d[1][j] * w[1][j]) / square;
        }
        factor
    })
}

/// Slopes of spring i's force −k (ℓ − rest) n − c (n·w) n, n = d/ℓ.
pub(super) fn spring_slopes(springs: &Springs, i: usize, d: [f64; 2], w: [f64; 2]) -> Slopes {
    let square = d[0] * d[0] + d[1] * d[1];
    if square == 0.0 {
        return Slopes::default();
    }
    let over = 1.0 / square;
    let (k, c) = (springs.stiffness[i], springs.damping[i]);
    let even = k * (1.0 - springs.rest[i] / square.sqrt());
    let speed = (d[0] * w[0] + d[1] * w[1]) * over;
    let mut slopes = Slopes::default();
    for row in 0..2 {
        for column in 0..2 {
            let unit = f64::from(row == column);
            let along = d[row] * d[column] * over;
            let turn = d[row] * w[column] * over + speed * unit - 2.0 * speed * along;
            slopes.position[2 * row + column] = even * unit + (k - even) * along + c * turn;
            slopes.velocity[2 * row + column] = c * along;
        }
    }
    slopes
}

/// Gravity, drag and inertia of node i with this mass: f − m A at every stage [N].
#[inline(always)]
pub(super) fn own<const S: usize, const L: usize>(
    system: &System,
    stages: &Stages<S, L>,
    i: usize,
    mass: f64,
) -> [Values<S>; 2] {
    let node = &stages.node[i];
    let (drag, gravity) = (system.drag, system.gravity);
    [
        std::array::from_fn(|j| mass * (gravity.x - drag * node.v[0][j] - node.a[0][j])),
        std::array::from_fn(|j| mass * (gravity.y - drag * node.v[1][j] - node.a[1][j])),
    ]
}

/// The mouse's hold at every stage [N].
pub(super) fn hold<const S: usize, const L: usize>(held: &Held, stages: &Stages<S, L>) -> [Values<S>; 2] {
    let node = &stages.node[held.node];
    let force: [DVec2; S] = std::array::from_fn(|j| {
        bounded(held, DVec2::new(node.q[0][j], node.q[1][j]), DVec2::new(node.v[0][j], node.v[1][j])).0
    });
    [force.map(|force| force.x), force.map(|force| force.y)]
}

/// Its slopes at stage j.
pub(super) fn hold_slopes<const S: usize, const L: usize>(held: &Held, stages: &Stages<S, L>, j: usize) -> Slopes {
    let node = &stages.node[held.node];
    let (x, v) = (DVec2::new(node.q[0][j], node.q[1][j]), DVec2::new(node.v[0][j], node.v[1][j]));
    let (force, share) = bounded(held, x, v);
    let n = if share < 1.0 { force / held.most.max(f64::MIN_POSITIVE) } else { DVec2::ZERO };
    let across = [1.0 - n.x * n.x, -n.x * n.y, -n.x * n.y, 1.0 - n.y * n.y];
    Slopes {
        position: across.map(|part| share * held.stiffness * part),
        velocity: across.map(|part| share * held.damping * part),
    }
}

/// The force, and what part of the unbounded one it is.
fn bounded(held: &Held, x: DVec2, v: DVec2) -> (DVec2, f64) {
    let force = -held.stiffness * (x - held.target) - held.damping * v;
    let size = force.length();
    let share = if size > held.most { held.most / size } else { 1.0 };
    (share * force, share)
}
