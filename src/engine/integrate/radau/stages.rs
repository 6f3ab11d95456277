//! The stages of a step: accelerations, and the velocities and positions that they bring about.
//!
//! ```text
//! V_j = v + h Σ a_jk A_k,   Q_j = q + c_j h v + h² Σ (a²)_jk A_k
//! ```

use super::scheme::Scheme;
use crate::engine::island::System;
use crate::engine::linalg::complex::Complex;

/// Weight of a change of velocity against one of position [s].
const WEIGHT: f64 = 0.1;

/// By stage.
pub(super) type Values<const S: usize> = [f64; S];

/// Stages of one node: x and y.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node<const S: usize> {
    /// [m]
    pub q: [Values<S>; 2],
    /// [m/s]
    pub v: [Values<S>; 2],
    /// [m/s²]
    pub a: [Values<S>; 2],
}

/// Stages of all nodes.
#[derive(Debug)]
pub(super) struct Stages<const S: usize, const L: usize> {
    pub scheme: &'static Scheme<S, L>,
    pub node: Vec<Node<S>>,
    /// Length of the step [s].
    pub h: f64,
    /// h a and h² a².
    weights: [Values<S>; S],
    squared: [Values<S>; S],
}

impl<const S: usize, const L: usize> Stages<S, L> {
    pub fn new(scheme: &'static Scheme<S, L>) -> Self {
        Stages { scheme, node: Vec::new(), h: 0.0, weights: [[0.0; S]; S], squared: [[0.0; S]; S] }
    }

    /// First guess for a step of `h` seconds: the same acceleration all along.
    pub fn begin(&mut self, system: &System, (ax, ay): (&[f64], &[f64]), h: f64) {
        self.h = h;
        let scheme = self.scheme;
        self.weights = scheme.weights.map(|row| row.map(|a| h * a));
        self.squared = scheme.squared.map(|row| row.map(|a| h * h * a));
        let nodes = &system.nodes;
        self.node.resize(nodes.len(), Node { q: [[0.0; S]; 2], v: [[0.0; S]; 2], a: [[0.0; S]; 2] });
        let starts = nodes.x.iter().zip(&nodes.y).zip(nodes.vx.iter().zip(&nodes.vy)).zip(ax.iter().zip(ay));
        for (node, (((x, y), (vx, vy)), (ax, ay))) in self.node.iter_mut().zip(starts) {
            for (k, (q, v, a)) in [(x, vx, ax), (y, vy, ay)].into_iter().enumerate() {
                for j in 0..S {
                    let t = h * scheme.nodes[j];
                    node.a[k][j] = *a;
                    node.v[k][j] = v + t * a;
                    node.q[k][j] = q + t * v + 0.5 * t * t * a;
                }
            }
        }
    }

    /// Corrects the stages of a node by z, given by eigenvalue. Returns by how much its end moves [m].
    #[inline(always)]
    pub fn correct(&mut self, node: usize, z: &[Complex<L>; 2]) -> f64 {
        let node = &mut self.node[node];
        let mut moved = 0.0;
        for (k, z) in z.iter().enumerate() {
            let mut change = [0.0; S];
            for (change, t) in change.iter_mut().zip(&self.scheme.from_eigen) {
                for l in 0..L {
                    *change += t.re[l] * z.re[l] - t.im[l] * z.im[l];
                }
            }
            let (mut dv, mut dq) = ([0.0; S], [0.0; S]);
            for i in 0..S {
                for (j, change) in change.iter().enumerate() {
                    dv[i] += self.weights[i][j] * change;
                    dq[i] += self.squared[i][j] * change;
                }
            }
            for (to, by) in [(&mut node.a[k], &change), (&mut node.v[k], &dv), (&mut node.q[k], &dq)] {
                to.iter_mut().zip(by).for_each(|(to, by)| *to += by);
            }
            moved += dq[S - 1].abs() + WEIGHT * dv[S - 1].abs();
        }
        moved
    }

    /// Estimate of the error of the step: h² times the last Legendre coefficient of the accelerations, RMS over the nodes [m].
    pub fn estimate(&self) -> f64 {
        let mut sum = 0.0;
        for node in &self.node {
            for a in &node.a {
                let last: f64 = a.iter().zip(&self.scheme.last_legendre).map(|(a, weight)| a * weight).sum();
                sum += last * last;
            }
        }
        self.h * self.h * (sum / self.node.len().max(1) as f64).sqrt()
    }

    /// Moves the island to the end of the step.
    pub fn apply(&self, system: &mut System) {
        let nodes = &mut system.nodes;
        for (i, node) in self.node.iter().enumerate() {
            (nodes.x[i], nodes.y[i]) = (node.q[0][S - 1], node.q[1][S - 1]);
            (nodes.vx[i], nodes.vy[i]) = (node.v[0][S - 1], node.v[1][S - 1]);
        }
    }

    /// The accelerations at the end of the step, by node.
    pub fn last_accelerations(&self, ax: &mut [f64], ay: &mut [f64]) {
        for (node, (ax, ay)) in self.node.iter().zip(ax.iter_mut().zip(ay)) {
            (*ax, *ay) = (node.a[0][S - 1], node.a[1][S - 1]);
        }
    }

    /// Differences of positions, velocities and accelerations from node a to node b, x and y of each.
    #[inline(always)]
    pub fn between(&self, a: usize, b: usize) -> [[Values<S>; 2]; 3] {
        let (a, b) = (&self.node[a], &self.node[b]);
        let minus = |a: &Values<S>, b: &Values<S>| std::array::from_fn(|j| b[j] - a[j]);
        let both = |a: &[Values<S>; 2], b: &[Values<S>; 2]| [minus(&a[0], &b[0]), minus(&a[1], &b[1])];
        [both(&a.q, &b.q), both(&a.v, &b.v), both(&a.a, &b.a)]
    }

    /// The same at stage j alone.
    pub fn between_at(&self, a: usize, b: usize, j: usize) -> [[f64; 2]; 3] {
        let (a, b) = (&self.node[a], &self.node[b]);
        let minus = |a: &[Values<S>; 2], b: &[Values<S>; 2]| [b[0][j] - a[0][j], b[1][j] - a[1][j]];
        [minus(&a.q, &b.q), minus(&a.v, &b.v), minus(&a.a, &b.a)]
    }

    /// Σ x_j (T⁻¹)_j
    #[inline(always)]
    pub fn to_eigen(&self, x: &Values<S>) -> Complex<L> {
        let mut z = Complex::default();
        for (x, t) in x.iter().zip(&self.scheme.to_eigen) {
            for l in 0..L {
                z.re[l] += x * t.re[l];
                z.im[l] += x * t.im[l];
            }
        }
        z
    }

    /// Re Σ T_jl z_l
    #[inline(always)]
    pub fn by_stage(&self, z: &Complex<L>) -> Values<S> {
        std::array::from_fn(|j| {
            let t = &self.scheme.from_eigen[j];
            (0..L).fold(0.0, |sum, l| sum + t.re[l] * z.re[l] - t.im[l] * z.im[l])
        })
    }

    /// The stage nearest to the middle of the step, where the Jacobian is taken.
    pub const MIDDLE: usize = S / 2;
}
