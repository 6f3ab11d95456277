//! Random matrices over graphs of blocks, kept dense as the independent copy.

use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use tautline::engine::linalg::sparse::{Ldl, Summary};

/// A small generator (SplitMix64), so that a failing case is found again from its seed.
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In [-1, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * 2f64.powi(-52) - 1.0
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    pub fn vector(&mut self, n: usize) -> DVector<f64> {
        DVector::from_fn(n, |_, _| self.unit())
    }
}

/// Constraints between bodies: block k acts on the given bodies, all of three degrees of freedom.
#[derive(Clone, Debug)]
pub struct Constraints {
    pub sizes: Vec<u8>,
    pub bodies: Vec<Vec<usize>>,
    pub body_count: usize,
}

impl Constraints {
    pub fn first_rows(&self) -> Vec<usize> {
        let sum = |k: usize| self.sizes[..k].iter().map(|&size| usize::from(size)).sum();
        (0..self.sizes.len()).map(sum).collect()
    }

    pub fn rows(&self) -> usize {
        self.sizes.iter().map(|&size| usize::from(size)).sum()
    }

    /// The pairs of blocks that share a body.
    pub fn pairs(&self) -> Vec<(u32, u32)> {
        let mut pairs = Vec::new();
        for i in 0..self.sizes.len() {
            for j in 0..i {
                for body in &self.bodies[i] {
                    if self.bodies[j].contains(body) {
                        // Orientation varies, and blocks that share two bodies are named twice.
                        pairs.push(if (i + j) % 2 == 0 { (i as u32, j as u32) } else { (j as u32, i as u32) });
                    }
                }
            }
        }
        pairs
    }

    /// A random Jacobian with the pattern of the constraints.
    pub fn jacobian(&self, random: &mut Random) -> DMatrix<f64> {
        let mut jacobian = DMatrix::zeros(self.rows(), 3 * self.body_count);
        for ((first, &size), bodies) in self.first_rows().into_iter().zip(&self.sizes).zip(&self.bodies) {
            for row in first..first + usize::from(size) {
                for body in bodies {
                    (0..3).for_each(|k| jacobian[(row, 3 * body + k)] = random.unit());
                }
            }
        }
        jacobian
    }
}

/// A rope, hinge or weld chain: block k between bodies k and k + 1.
pub fn chain(count: usize, size: u8) -> Constraints {
    let bodies = (0..count).map(|k| vec![k, k + 1]).collect();
    Constraints { sizes: vec![size; count], bodies, body_count: count + 1 }
}

/// Every body but the first hangs on an earlier one.
pub fn tree(count: usize, random: &mut Random) -> Constraints {
    let bodies = (1..=count).map(|k| vec![k, random.below(k)]).collect();
    let sizes = (0..count).map(|_| 1 + random.below(3) as u8).collect();
    Constraints { sizes, bodies, body_count: count + 1 }
}

/// A net of side × side bodies.
pub fn grid(side: usize, size: u8) -> Constraints {
    let mut bodies = Vec::new();
    for y in 0..side {
        for x in 0..side {
            let at = y * side + x;
            if x + 1 < side {
                bodies.push(vec![at, at + 1]);
            }
            if y + 1 < side {
                bodies.push(vec![at, at + side]);
            }
        }
    }
    Constraints { sizes: vec![size; bodies.len()], bodies, body_count: side * side }
}

/// Constraints of 1 to 3 rows between random bodies, one in five to the ground.
pub fn anything(count: usize, body_count: usize, random: &mut Random) -> Constraints {
    let mut bodies = Vec::new();
    for _ in 0..count {
        let (a, b) = (random.below(body_count), random.below(body_count));
        bodies.push(if a == b || random.below(5) == 0 { vec![a] } else { vec![a, b] });
    }
    let sizes = (0..count).map(|_| 1 + random.below(3) as u8).collect();
    Constraints { sizes, bodies, body_count }
}

/// Several of the above side by side, the blocks shuffled.
pub fn side_by_side(parts: &[Constraints], random: &mut Random) -> Constraints {
    let (mut all, mut body_count) = (Vec::new(), 0);
    for part in parts {
        for (size, bodies) in part.sizes.iter().zip(&part.bodies) {
            all.push((*size, bodies.iter().map(|body| body + body_count).collect()));
        }
        body_count += part.body_count;
    }
    for k in (1..all.len()).rev() {
        all.swap(k, random.below(k + 1));
    }
    let (sizes, bodies) = all.into_iter().unzip();
    Constraints { sizes, bodies, body_count }
}

/// The pattern of a random scene.
pub fn scene() -> impl Strategy<Value = Constraints> {
    (0..6, 1..24usize, any::<u64>()).prop_map(|(kind, count, seed)| {
        let random = &mut Random(seed);
        match kind {
            0 => chain(count, 1 + (seed % 3) as u8),
            1 => tree(count, random),
            2 => grid(2 + count / 6, 1 + (seed % 2) as u8),
            3 => anything(count, 1 + count, random),
            4 => anything(count, 1, random),
            _ => {
                let parts = [
                    chain(count, 1),
                    chain(1, 2),
                    chain(count / 2, 2),
                    chain(3, 3),
                    tree(count / 2, random),
                    anything(count / 3, 3, random),
                    chain(1, 1),
                    chain(1, 1),
                ];
                side_by_side(&parts, random)
            }
        }
    })
}

/// Writes a dense matrix into the values, block by block as the slots say.
pub fn write(ldl: &mut Ldl, constraints: &Constraints, pairs: &[(u32, u32)], matrix: &DMatrix<f64>) {
    let firsts = constraints.first_rows();
    let size = |k: u32| usize::from(constraints.sizes[k as usize]);
    ldl.values_mut().fill(f64::NAN);
    for k in 0..constraints.sizes.len() as u32 {
        let (slot, first, size) = (ldl.diagonal_slot(k as usize), firsts[k as usize], size(k));
        for row in 0..size {
            for column in 0..=row {
                ldl.values_mut()[slot + row * size + column] = matrix[(first + row, first + column)];
            }
        }
    }
    for (p, &(i, j)) in pairs.iter().enumerate() {
        let (slot, transposed) = ldl.pair_slot(p);
        let (i, j) = if transposed { (j, i) } else { (i, j) };
        for row in 0..size(i) {
            for column in 0..size(j) {
                let value = matrix[(firsts[i as usize] + row, firsts[j as usize] + column)];
                ldl.values_mut()[slot + row * size(j) + column] = value;
            }
        }
    }
}

/// Analysed and filled with a matrix, not yet factored. Whatever is neither a diagonal nor a pair is NaN.
pub fn prepared(constraints: &Constraints, matrix: &DMatrix<f64>) -> (Ldl, Summary) {
    let (mut ldl, pairs) = (Ldl::default(), constraints.pairs());
    let summary = ldl.analyse(&constraints.sizes, &pairs);
    write(&mut ldl, constraints, &pairs, matrix);
    (ldl, summary)
}
