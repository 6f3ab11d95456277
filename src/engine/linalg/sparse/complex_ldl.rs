//! L D Lᵀ of complex symmetric matrices of 2 × 2 blocks, `L` of one pattern side by side, as implicit methods make them of a net.
//!
//! The pattern is analysed as a real matrix's is. No rows are exchanged: the matrices shall have their numerical range in a half-plane,
//! as (M + h² μ² K) has for positive definite M and K, where elimination is stable (Higham, "Factorizing complex symmetric matrices with
//! positive definite real and imaginary parts", Math. Comp. 67 (1998)).

use super::graph::Graph;
use super::numeric::Numeric;
use super::symbolic::Symbolic;
use crate::engine::linalg::complex::Complex;

/// The factorisation.
#[derive(Clone, Debug, Default)]
pub(crate) struct ComplexLdl<const L: usize> {
    symbolic: Symbolic,
    numeric: Numeric<Complex<L>>,
    /// The matrices: blocks row by row, of which those on the diagonal and left of it are read.
    pub values: Vec<Complex<L>>,
    /// Place of a block in the order of elimination.
    place: Vec<u32>,
    gathered: Vec<Complex<L>>,
}

impl<const L: usize> ComplexLdl<L> {
    /// Prepares for matrices of `blocks` blocks, coupled as `pairs` say.
    pub fn analyse(&mut self, blocks: usize, pairs: &[(u32, u32)]) {
        let mut graph = Graph::default();
        graph.build(blocks, pairs);
        self.symbolic.analyse(&graph, &vec![2; blocks], 0);
        self.numeric.reserve(&self.symbolic);
        self.values = vec![Complex::default(); self.symbolic.values];
        self.place = vec![0; blocks];
        self.symbolic.order.iter().enumerate().for_each(|(k, block)| self.place[*block as usize] = k as u32);
        self.gathered = vec![Complex::default(); 2 * blocks];
    }

    /// First value of diagonal block `block`; the entries right of the diagonal are not read.
    pub fn diagonal_slot(&self, block: usize) -> usize {
        self.symbolic.block_rows[self.place[block] as usize].diagonal
    }

    /// First value of the block of a pair, which must be symmetric.
    pub fn pair_slot(&self, (i, j): (u32, u32)) -> usize {
        let (i, j) = (self.place[i as usize] as usize, self.place[j as usize] as usize);
        self.symbolic.slot(i.max(j), i.min(j))
    }

    /// Factors the matrices that the values hold; returns whether there is a factor.
    pub fn factor(&mut self) -> bool {
        self.numeric.factor(&self.symbolic, &self.values).finite
    }

    /// A x = b in place, by block.
    pub fn solve(&mut self, b: &mut [[Complex<L>; 2]]) {
        for (to, block) in self.gathered.chunks_exact_mut(2).zip(&self.symbolic.order) {
            to.copy_from_slice(&b[*block as usize]);
        }
        self.numeric.solve(&self.symbolic, &mut self.gathered);
        for (from, block) in self.gathered.chunks_exact(2).zip(&self.symbolic.order) {
            b[*block as usize].copy_from_slice(from);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid of 3 × 3 blocks: the product of the matrix with the solution is the right-hand side.
    #[test]
    fn a_complex_grid_is_solved() {
        let pairs: Vec<(u32, u32)> = (0..9u32)
            .flat_map(|k| [(k, k + 1, k % 3 < 2), (k, k + 3, k < 6)])
            .filter(|(_, _, is)| *is)
            .map(|(a, b, _)| (a, b))
            .collect();
        let mut ldl = ComplexLdl::<2>::default();
        ldl.analyse(9, &pairs);
        let z = |k: usize| Complex { re: [1.0 + (k % 5) as f64, -0.3 * (k % 3) as f64], im: [0.2 * k as f64, 1.0] };
        let mut dense = vec![vec![Complex::<2>::default(); 18]; 18];
        for block in 0..9 {
            let slot = ldl.diagonal_slot(block);
            let entries =
                [z(block) + Complex::real(9.0), z(block + 4), z(block + 4), z(block + 1) + Complex::real(9.0)];
            ldl.values[slot..slot + 4].copy_from_slice(&entries);
            (0..4).for_each(|e| dense[2 * block + e / 2][2 * block + e % 2] = entries[e]);
        }
        for (p, (i, j)) in pairs.iter().enumerate() {
            let slot = ldl.pair_slot((*i, *j));
            let entries = [z(p), z(p + 2), z(p + 2), z(p + 3)];
            ldl.values[slot..slot + 4].copy_from_slice(&entries);
            for e in 0..4 {
                dense[2 * *i as usize + e / 2][2 * *j as usize + e % 2] = entries[e];
                dense[2 * *j as usize + e / 2][2 * *i as usize + e % 2] = entries[e];
            }
        }
        assert!(ldl.factor());
        let b: Vec<[Complex<2>; 2]> = (0..9).map(|k| [z(2 * k), z(k + 7)]).collect();
        let mut x = b.clone();
        ldl.solve(&mut x);
        for (row, entries) in dense.iter().enumerate() {
            let product = entries.iter().zip(x.as_flattened()).fold(Complex::default(), |sum, (a, x)| sum + *a * *x);
            let off = product - b.as_flattened()[row];
            assert!(off.re.iter().chain(&off.im).all(|off| off.abs() < 1e-12), "{row}: {off:?}");
        }
    }
}
