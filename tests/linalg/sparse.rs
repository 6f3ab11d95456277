//! The sparse L D Lᵀ.

use crate::problems::*;
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use tautline::engine::linalg::sparse::block_tridiagonal::{factor_block_tridiagonal, solve_block_tridiagonal};
use tautline::engine::linalg::sparse::{Ldl, Path, Summary};

fn solved(ldl: &mut Ldl, b: &DVector<f64>) -> DVector<f64> {
    let mut x = b.clone();
    ldl.solve(x.as_mut_slice());
    x
}

/// ‖b − A x‖ / (‖A‖ ‖x‖ + ‖b‖), all in the maximum norm: of which relative change of A and b x is the exact solution.
fn backward_error(matrix: &DMatrix<f64>, x: &DVector<f64>, b: &DVector<f64>) -> f64 {
    let norm = matrix.row_iter().map(|row| row.iter().map(|a| a.abs()).sum::<f64>()).fold(0.0, f64::max);
    (b - matrix * x).amax() / (norm * x.amax() + b.amax()).max(f64::MIN_POSITIVE)
}

/// A = J Jᵀ + compliance.
fn definite(constraints: &Constraints, compliance: f64, random: &mut Random) -> DMatrix<f64> {
    let jacobian = constraints.jacobian(random);
    let mut matrix = &jacobian * jacobian.transpose();
    (0..matrix.nrows()).for_each(|k| matrix[(k, k)] += compliance);
    matrix
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, max_global_rejects: 50_000, ..ProptestConfig::default() })]

    /// With compliance the condition number stays below about 1e4, so that solutions agree to 1e-11.
    #[test]
    fn solutions_are_those_of_nalgebra_on_every_pattern(constraints in scene(), seed: u64) {
        let random = &mut Random(seed);
        let matrix = definite(&constraints, 1e-2, random);
        let b = random.vector(matrix.nrows());
        let (mut ldl, summary) = prepared(&constraints, &matrix);
        let pivots = ldl.factor();
        prop_assert!(pivots.finite && pivots.dropped == 0 && pivots.negative == 0 && pivots.smallest > 0.0);
        prop_assert_eq!(summary.rows, matrix.nrows());
        let truth = matrix.clone().cholesky().expect("positive definite").solve(&b);
        let x = solved(&mut ldl, &b);
        prop_assert!((&x - &truth).amax() <= 1e-11 * truth.amax(), "{:e}", (&x - &truth).amax() / truth.amax());
        // The residual is that of the dense copy.
        let mut r = b.clone();
        let found = ldl.residual(b.as_slice(), truth.as_slice(), r.as_mut_slice());
        let expected = &b - &matrix * &truth;
        prop_assert!((&r - expected).amax() <= 1e-13 * (1.0 + truth.amax()) && found == r.amax());
    }

    /// A quasi-definite matrix: positive and negative blocks on the diagonal. The signs of the pivots are the inertia.
    #[test]
    fn negative_pivots_count_the_negative_eigenvalues(constraints in scene(), seed: u64) {
        let random = &mut Random(seed);
        let mut matrix = definite(&constraints, 0.1, random);
        // Rows of one sign are definite among themselves; between rows of either sign there is a free coupling.
        let signs: Vec<f64> = (0..matrix.nrows()).map(|_| if random.below(2) == 0 { 1.0 } else { -1.0 }).collect();
        for i in 0..matrix.nrows() {
            for j in 0..matrix.nrows() {
                if signs[i] == signs[j] {
                    matrix[(i, j)] *= signs[i];
                }
            }
        }
        let (mut ldl, _) = prepared(&constraints, &matrix);
        let pivots = ldl.factor();
        let negative = matrix.clone().symmetric_eigenvalues().iter().filter(|value| **value < 0.0).count();
        prop_assert_eq!(pivots.negative, negative);
        let b = random.vector(matrix.nrows());
        let mut x = solved(&mut ldl, &b);
        ldl.refine(b.as_slice(), x.as_mut_slice());
        prop_assert!(backward_error(&matrix, &x, &b) < 1e-14);
    }

    /// Scales over twelve orders of magnitude, as masses of 1e-6 and 1e6 kg in one chain. Elimination without exchange of rows
    /// is backward stable for a definite matrix: the bound is n² ε, and rows are some tens.
    #[test]
    fn ill_conditioned_systems_have_a_small_backward_error(constraints in scene(), seed: u64) {
        let random = &mut Random(seed);
        let mut jacobian = constraints.jacobian(random);
        for mut body in jacobian.column_iter_mut() {
            body *= 10f64.powf(3.0 * random.unit());
        }
        let mut matrix = &jacobian * jacobian.transpose();
        (0..matrix.nrows()).for_each(|k| matrix[(k, k)] *= 1.0 + 1e-10);
        let b = random.vector(matrix.nrows());
        let (mut ldl, _) = prepared(&constraints, &matrix);
        let pivots = ldl.factor();
        prop_assert!(pivots.finite && pivots.negative == 0);
        if pivots.dropped == 0 {
            let x = solved(&mut ldl, &b);
            prop_assert!(backward_error(&matrix, &x, &b) < 1e-14, "{:e}", backward_error(&matrix, &x, &b));
        }
    }

    /// Constraints stated twice: as many rows are dropped as the rank lacks, and a consistent right-hand side is met by the
    /// dropped ones too. The rows themselves are independent enough (condition number of A below 2500) that rounding, some
    /// 1e-16 · 2500, stays below the threshold of 1e-11: without an exchange of rows no threshold tells worse rows apart.
    #[test]
    fn redundant_rows_are_dropped_and_counted(constraints in scene(), seed: u64, twins in 1..5usize) {
        let random = &mut Random(seed);
        let mut constraints = constraints;
        let original = constraints.sizes.len();
        let likes: Vec<usize> = (0..twins).map(|_| random.below(original)).collect();
        for &like in &likes {
            constraints.sizes.push(constraints.sizes[like]);
            constraints.bodies.push(constraints.bodies[like].clone());
        }
        let firsts = constraints.first_rows();
        let mut jacobian = constraints.jacobian(random);
        let independent = jacobian.rows(0, firsts[original]).svd(false, false).singular_values;
        prop_assume!(independent.len() == firsts[original] && independent.min() > 0.02 * independent.max());
        for (twin, &like) in likes.iter().enumerate() {
            for row in 0..usize::from(constraints.sizes[like]) {
                let copy = jacobian.row(firsts[like] + row) * (1.0 + 0.5 * random.unit());
                jacobian.set_row(firsts[original + twin] + row, &copy);
            }
        }
        let singular = jacobian.clone().svd(false, false).singular_values;
        let rank = singular.iter().filter(|&&value| value > 1e-10 * singular.max()).count();
        let matrix = &jacobian * jacobian.transpose();
        let (mut ldl, _) = prepared(&constraints, &matrix);
        let pivots = ldl.factor();
        prop_assert_eq!(pivots.dropped, matrix.nrows() - rank);
        prop_assert_eq!(ldl.dropped_rows().len(), pivots.dropped);
        let b = &jacobian * random.vector(jacobian.ncols());
        let x = solved(&mut ldl, &b);
        prop_assert!(ldl.dropped_rows().iter().all(|&row| x[row as usize] == 0.0));
        // Rounding in b, 1e-16, times the condition number.
        prop_assert!((&b - &matrix * &x).amax() < 1e-12 * (1.0 + x.amax()), "{:e}", (&b - &matrix * &x).amax());
    }

    /// More constraints than degrees of freedom, however close to one another: consistent right-hand sides are met after a
    /// step of refinement. 1e-6 is √ε times some: pivots between 1e-11 and 1e-8 may be noise that was not recognised.
    #[test]
    fn overdetermined_scenes_are_solved(count in 2..24usize, bodies in 1..8usize, seed: u64) {
        let random = &mut Random(seed);
        let constraints = anything(count, bodies, random);
        let jacobian = constraints.jacobian(random);
        let matrix = &jacobian * jacobian.transpose();
        let (mut ldl, _) = prepared(&constraints, &matrix);
        prop_assert!(ldl.factor().finite);
        let b = &jacobian * random.vector(jacobian.ncols());
        let mut x = solved(&mut ldl, &b);
        let first = ldl.refine(b.as_slice(), x.as_mut_slice());
        prop_assert!((first - (&b - &matrix * solved(&mut ldl, &b)).amax()).abs() < 1e-12 * (1.0 + x.amax()));
        let residual = (&b - &matrix * &x).amax();
        prop_assert!(residual < 1e-6, "{residual:e}, {first:e} before");
    }
}

/// The same object for one pattern after the other gives the bits of a fresh one.
#[test]
fn an_object_may_be_reused_for_another_pattern() {
    let random = &mut Random(7);
    let mut reused = Ldl::default();
    for count in [9, 3, 20, 1, 14] {
        for constraints in
            [chain(count, 1), tree(count, random), grid(4, 2), anything(count, 5, random), chain(count, 3)]
        {
            let matrix = definite(&constraints, 0.1, random);
            let b = random.vector(matrix.nrows());
            let pairs = constraints.pairs();
            let (mut fresh, summary) = prepared(&constraints, &matrix);
            assert_eq!(reused.analyse(&constraints.sizes, &pairs), summary);
            write(&mut reused, &constraints, &pairs, &matrix);
            assert_eq!(reused.factor(), fresh.factor());
            assert_eq!(solved(&mut reused, &b), solved(&mut fresh, &b));
        }
    }
}

#[test]
fn an_empty_matrix_is_solved() {
    let mut ldl = Ldl::default();
    let summary = ldl.analyse(&[], &[]);
    assert_eq!(summary, Summary::default());
    assert!(ldl.factor().finite);
    ldl.solve(&mut []);
}

/// NaN or infinity in any one entry is reported, on every path, and does not spread to the next factorisation.
#[test]
fn values_that_are_no_numbers_are_reported() {
    let random = &mut Random(3);
    let singles = side_by_side(&[chain(1, 1), chain(1, 2), chain(1, 3), chain(1, 1)], random);
    for constraints in
        [chain(7, 1), chain(6, 1), chain(5, 2), chain(4, 3), singles, tree(8, random), grid(4, 1), grid(3, 3)]
    {
        let matrix = definite(&constraints, 0.1, random);
        let pairs = constraints.pairs();
        let (mut ldl, _) = prepared(&constraints, &matrix);
        let good = ldl.factor();
        for (i, j) in (0..matrix.nrows()).flat_map(|i| (0..=i).map(move |j| (i, j))) {
            for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                if matrix[(i, j)] == 0.0 {
                    continue;
                }
                let mut broken = matrix.clone();
                (broken[(i, j)], broken[(j, i)]) = (bad, bad);
                write(&mut ldl, &constraints, &pairs, &broken);
                assert!(!ldl.factor().finite, "{bad} at ({i}, {j}) of {constraints:?}");
            }
        }
        write(&mut ldl, &constraints, &pairs, &matrix);
        assert_eq!(ldl.factor(), good);
    }
}

/// Σ (c + 1)² and Σ c over columns with c entries below the diagonal, written out.
#[test]
fn chains_cost_what_the_closed_forms_say() {
    for count in 1..40usize {
        for size in 1..=3u8 {
            let b = usize::from(size);
            let summary = Ldl::default().analyse(&vec![size; count], &chain(count, size).pairs());
            let inner = b * (b - 1) / 2;
            assert_eq!(summary.nonzeros, count * inner + (count - 1) * b * b);
            // Columns of the last block have 0 … b − 1 entries, those of the others b more.
            let square = |n: usize| n * (n + 1) * (2 * n + 1) / 6;
            assert_eq!(summary.flops, square(b) + (count - 1) * (square(2 * b) - square(b)));
            assert_eq!(summary.path, if count == 1 { Path::Diagonal } else { Path::Chain { block: size } });
        }
    }
}

/// L of a tree has as many blocks off the diagonal as A.
#[test]
fn trees_have_no_fill() {
    let random = &mut Random(5);
    for count in [2, 10, 100, 1000] {
        // A path with branches: block k is coupled with one earlier block.
        let pairs: Vec<(u32, u32)> = (1..count).map(|k| (k, random.below(k as usize) as u32)).collect();
        let summary = Ldl::default().analyse(&vec![1; count as usize], &pairs);
        assert_eq!(summary.nonzeros, count as usize - 1);
        assert!(summary.path <= Path::Tree);
        // Bodies in a tree: the constraints at one body are a clique, and nothing has to fill in.
        let constraints = tree(count as usize, random);
        let mut unit = constraints.clone();
        unit.sizes.fill(1);
        let mut pairs = unit.pairs();
        pairs.iter_mut().for_each(|(i, j)| (*i, *j) = (*i.max(j), *i.min(j)));
        pairs.sort_unstable();
        pairs.dedup();
        let summary = Ldl::default().analyse(&unit.sizes, &pairs);
        assert_eq!(summary.nonzeros, pairs.len());
    }
}

/// The fill of a net of n × n bodies grows as n² log n; George (1973) gives 31 n² log₂ n / 4 for nested dissection of the
/// nine-point grid, and rods number twice the bodies. Banded elimination would need 2 n² · 2 n = 4 n³.
#[test]
fn nets_fill_little() {
    for side in [10usize, 20, 30, 50] {
        let rods = grid(side, 1);
        let mut pairs = Vec::new();
        let mut at_body = vec![Vec::new(); rods.body_count];
        for (k, bodies) in rods.bodies.iter().enumerate() {
            for &body in bodies {
                pairs.extend(at_body[body].iter().map(|&other| (k as u32, other)));
                at_body[body].push(k as u32);
            }
        }
        let summary = Ldl::default().analyse(&rods.sizes, &pairs);
        let (n, bound) = (side as f64, 31.0 / 4.0 * (side * side) as f64 * (side as f64).log2());
        println!(
            "{side}²: {} rows, {} entries (bound {bound:.0}, band {:.0})",
            summary.rows,
            summary.nonzeros,
            4.0 * n.powi(3)
        );
        assert_eq!(summary.path, Path::Sparse);
        assert!((summary.nonzeros as f64) < bound);
    }
}

#[test]
fn components_are_told_apart() {
    let random = &mut Random(11);
    let parts = [chain(5, 1), chain(1, 3), chain(4, 2), grid(3, 1), tree(6, random), chain(1, 1), chain(2, 1)];
    let all = side_by_side(&parts, random);
    let components = Ldl::default().analyse(&all.sizes, &all.pairs()).components;
    println!("{components:?}");
    assert_eq!((components.diagonal, components.sparse), (2, 1));
    // The tree may happen to be a chain of equal blocks.
    assert!(components.chains >= 3 && components.chains + components.trees == 4);
}

/// A hub with thousands of neighbours, and a clique of hundreds.
#[test]
fn large_degrees_are_ordered_sensibly() {
    let leaves = 5000;
    let pairs: Vec<(u32, u32)> = (1..=leaves).map(|leaf| (0, leaf)).collect();
    let summary = Ldl::default().analyse(&vec![1; leaves as usize + 1], &pairs);
    assert_eq!(summary.nonzeros, leaves as usize);
    let clique: Vec<(u32, u32)> = (0..400).flat_map(|i| (0..i).map(move |j| (i, j))).collect();
    let summary = Ldl::default().analyse(&[1; 400], &clique);
    assert_eq!(summary.nonzeros, 400 * 399 / 2);
}

/// Saddle points: two coordinates with a definite part, a multiplier with 0 on the diagonal; and blocks without symmetry.
#[test]
fn block_tridiagonal_systems_are_solved_as_by_nalgebra() {
    let random = &mut Random(13);
    for case in 0..500 {
        let n = 1 + case % 20;
        let mut block = |saddle: f64| {
            let mut block: [[f64; 3]; 3] = std::array::from_fn(|_| std::array::from_fn(|_| random.unit()));
            if saddle > 0.0 {
                (block[0][0], block[1][1], block[2][2]) = (saddle, saddle, 0.0);
                (block[2][0], block[2][1]) = (block[0][2] + 2.0, block[1][2]);
                block[0][2] = block[2][0];
            }
            block
        };
        let diagonal: Vec<_> = (0..n).map(|_| block(10.0)).collect();
        let lower: Vec<_> = (1..n).map(|_| block(0.0).map(|row| row.map(|x| 0.1 * x))).collect();
        let upper: Vec<_> = (1..n).map(|_| block(0.0).map(|row| row.map(|x| 0.1 * x))).collect();
        let mut matrix = DMatrix::zeros(3 * n, 3 * n);
        for k in 0..n {
            for (row, column) in (0..3).flat_map(|row| (0..3).map(move |column| (row, column))) {
                matrix[(3 * k + row, 3 * k + column)] = diagonal[k][row][column];
                if k > 0 {
                    matrix[(3 * k + row, 3 * k - 3 + column)] = lower[k - 1][row][column];
                    matrix[(3 * k - 3 + row, 3 * k + column)] = upper[k - 1][row][column];
                }
            }
        }
        let (mut inverses, mut multipliers) = (vec![[[0.0; 3]; 3]; n], vec![[[0.0; 3]; 3]; n - 1]);
        let found = factor_block_tridiagonal(&diagonal, &lower, &upper, &mut inverses, &mut multipliers);
        assert!(found.regular && found.worst > 1e-3);
        let b = random.vector(3 * n);
        let mut x = b.clone();
        solve_block_tridiagonal(&inverses, &multipliers, &lower, &upper, x.as_mut_slice().as_chunks_mut().0);
        let truth = matrix.lu().solve(&b).expect("regular");
        // The blocks dominate: condition numbers are below 1e3.
        assert!((&x - &truth).amax() < 1e-12 * truth.amax().max(1.0), "{:e}", (&x - &truth).amax());
        let singular = vec![[[1.0, 2.0, 3.0]; 3]; n];
        assert!(!factor_block_tridiagonal(&singular, &lower, &upper, &mut inverses, &mut multipliers).regular);
        let mut broken = diagonal.clone();
        broken[n / 3][1][0] = f64::NAN;
        assert!(!factor_block_tridiagonal(&broken, &lower, &upper, &mut inverses, &mut multipliers).regular);
    }
}

/// A pivot block whose determinant cancels is inverted with exchange of rows: rows 1e-7 apart cost 7 figures, not 14.
#[test]
fn nearly_singular_pivot_blocks_keep_what_figures_they_have() {
    let random = &mut Random(19);
    for _ in 0..200 {
        let mut block: [[f64; 3]; 3] = std::array::from_fn(|_| std::array::from_fn(|_| random.unit()));
        block[2] = std::array::from_fn(|k| block[0][k] + block[1][k] + 1e-7 * random.unit());
        let matrix = DMatrix::from_fn(3, 3, |row, column| block[row][column]);
        let condition = matrix.singular_values().max() / matrix.singular_values().min();
        let (mut inverses, exact) = ([[[0.0; 3]; 3]], [random.unit(), random.unit(), random.unit()]);
        let found = factor_block_tridiagonal(&[block], &[], &[], &mut inverses, &mut []);
        assert!(found.regular && found.worst < 1e-3);
        let b = &matrix * DVector::from_column_slice(&exact);
        let mut x = [[b[0], b[1], b[2]]];
        solve_block_tridiagonal(&inverses, &[], &[], &[], &mut x);
        let error = (0..3).map(|k| (x[0][k] - exact[k]).abs()).fold(0.0, f64::max);
        assert!(error < 1e-15 * condition, "{error:e} at {condition:e}");
    }
}
