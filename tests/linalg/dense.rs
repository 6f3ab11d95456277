//! The methods of the course.

use crate::problems::Random;
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use tautline::engine::linalg::dense::elimination::eliminate;
use tautline::engine::linalg::dense::{Cholesky, DenseError, Lu, Matrix, Qr, SingularValues, null_space};

fn ours(matrix: &DMatrix<f64>) -> Matrix {
    Matrix::from_fn(matrix.nrows(), matrix.ncols(), |row, column| matrix[(row, column)])
}

fn theirs(matrix: &Matrix) -> DMatrix<f64> {
    DMatrix::from_row_slice(matrix.rows(), matrix.columns(), matrix.entries())
}

fn random_matrix(random: &mut Random, rows: usize, columns: usize) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns, |_, _| random.unit())
}

/// A matrix of the given singular values and its pseudo-inverse: between random orthogonal matrices.
fn with_pseudo_inverse(
    random: &mut Random,
    rows: usize,
    columns: usize,
    values: &[f64],
) -> (DMatrix<f64>, DMatrix<f64>) {
    let (u, v) = (random_matrix(random, rows, rows).qr().q(), random_matrix(random, columns, columns).qr().q());
    let (mut middle, mut inverse) = (DMatrix::zeros(rows, columns), DMatrix::zeros(columns, rows));
    values.iter().enumerate().for_each(|(k, value)| (middle[(k, k)], inverse[(k, k)]) = (*value, 1.0 / value));
    (&u * middle * &v, v.transpose() * inverse * u.transpose())
}

fn with_singular_values(random: &mut Random, rows: usize, columns: usize, values: &[f64]) -> DMatrix<f64> {
    with_pseudo_inverse(random, rows, columns, values).0
}

/// From 1 down to 1 / condition.
fn spread(n: usize, condition: f64) -> Vec<f64> {
    (0..n).map(|k| condition.powf(-(k as f64) / (n - 1).max(1) as f64)).collect()
}

fn relative_residual(matrix: &DMatrix<f64>, x: &[f64], b: &DVector<f64>) -> f64 {
    let x = DVector::from_column_slice(x);
    (b - matrix * &x).norm() / (matrix.norm() * x.norm() + b.norm()).max(f64::MIN_POSITIVE)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    /// Backward errors of a few ε at condition numbers of up to 1e12; forward errors are within condition · ε of nalgebra's.
    #[test]
    fn elimination_and_lu_solve_what_nalgebra_solves(n in 1..25usize, digits in 0.0..12.0, seed: u64) {
        let random = &mut Random(seed);
        let condition = 10f64.powf(digits);
        let matrix = with_singular_values(random, n, n, &spread(n, condition));
        let b = random.vector(n);
        let truth = matrix.clone().lu().solve(&b).expect("regular");
        let mut x = b.clone();
        eliminate(&mut ours(&matrix), x.as_mut_slice()).unwrap();
        prop_assert!(relative_residual(&matrix, x.as_slice(), &b) < 1e-14);
        prop_assert!((&x - &truth).norm() < 1e-13 * condition * truth.norm());
        let mut lu = Lu::default();
        lu.factor(&ours(&matrix)).unwrap();
        let mut y = b.clone();
        lu.solve(y.as_mut_slice());
        prop_assert!(relative_residual(&matrix, y.as_slice(), &b) < 1e-14);
        // Not its `determinant`, which loses figures by expansion up to n = 3.
        let determinant = matrix.clone().lu().determinant();
        prop_assert!((lu.determinant() - determinant).abs() < 1e-13 * condition * determinant.abs());
    }

    #[test]
    fn cholesky_solves_definite_systems(n in 1..25usize, digits in 0.0..12.0, seed: u64) {
        let random = &mut Random(seed);
        let half = with_singular_values(random, n, n, &spread(n, 10f64.powf(digits / 2.0)));
        let matrix = &half * half.transpose();
        let b = random.vector(n);
        let mut cholesky = Cholesky::default();
        cholesky.factor(&ours(&matrix)).unwrap();
        let mut x = b.clone();
        cholesky.solve(x.as_mut_slice());
        prop_assert!(relative_residual(&matrix, x.as_slice(), &b) < 1e-14);
    }

    /// It fails at the first leading minor that is not positive, as the eigenvalues of the leading blocks say.
    #[test]
    fn cholesky_fails_where_the_matrix_is_not_definite(n in 2..12usize, seed: u64) {
        let random = &mut Random(seed);
        let half = random_matrix(random, n, n);
        let mut matrix = &half * half.transpose();
        let at = random.below(n);
        matrix[(at, at)] -= 10.0;
        let least = |k: usize| matrix.view((0, 0), (k, k)).clone_owned().symmetric_eigenvalues().min();
        let first = (1..=n).find(|&k| least(k) < 0.0);
        // In doubt proves nothing.
        prop_assume!((1..=n).all(|k| least(k).abs() > 1e-9));
        match (Cholesky::default().factor(&ours(&matrix)), first) {
            (Err(DenseError::NotPositive { row, pivot }), Some(first)) => {
                prop_assert_eq!(row + 1, first);
                prop_assert!(pivot < 0.0);
            }
            (result, first) => prop_assert!(result.is_ok() && first.is_none(), "{result:?}, {first:?}"),
        }
    }

    /// The pseudo-inverse gives the shortest of all least-squares solutions.
    #[test]
    fn least_squares_are_the_pseudo_inverse(rows in 1..16usize, columns in 1..16usize, lost in 0..6usize, seed: u64) {
        let random = &mut Random(seed);
        let rank = rows.min(columns).saturating_sub(lost).max(1);
        let (matrix, inverse) = with_pseudo_inverse(random, rows, columns, &spread(rank, 1e3));
        let b = random.vector(rows);
        let mut qr = Qr::default();
        prop_assert_eq!(qr.factor(&ours(&matrix), 1e-10).unwrap(), rank);
        let mut x = vec![0.0; columns];
        let residual = qr.solve(b.as_slice(), &mut x);
        let truth = inverse * &b;
        let x = DVector::from_vec(x);
        // ε times the square of the condition number, as least squares with a residual have it.
        prop_assert!((&x - &truth).norm() < 1e-9 * (1.0 + truth.norm()), "{:e}", (&x - &truth).norm());
        prop_assert!((residual - (&b - &matrix * &truth).norm()).abs() < 1e-11 * (1.0 + b.norm()));
    }

    #[test]
    fn null_spaces_are_orthonormal_and_complete(rows in 1..16usize, columns in 1..16usize, lost in 0..6usize, seed: u64) {
        let random = &mut Random(seed);
        let rank = rows.min(columns).saturating_sub(lost);
        let matrix = with_singular_values(random, rows, columns, &spread(rank, 1e3));
        let found = null_space(&ours(&matrix), 1e-10).unwrap();
        prop_assert_eq!(found.rank, rank);
        let basis = theirs(&found.basis);
        prop_assert_eq!(basis.shape(), (columns, columns - rank));
        if rank < columns {
            prop_assert!((&matrix * &basis).amax() < 1e-14 * (1.0 + columns as f64));
            let gram = basis.transpose() * &basis;
            prop_assert!((gram - DMatrix::identity(columns - rank, columns - rank)).amax() < 1e-14 * columns as f64);
        }
    }

    #[test]
    fn singular_values_are_those_the_matrix_was_made_of(rows in 1..20usize, columns in 1..20usize, digits in 0.0..12.0, seed: u64) {
        let random = &mut Random(seed);
        let condition = 10f64.powf(digits);
        let values = spread(rows.min(columns), condition);
        let matrix = with_singular_values(random, rows, columns, &values);
        let mut singular = SingularValues::default();
        let found = singular.of(&ours(&matrix)).unwrap().to_vec();
        // The product of three matrices is rounded to some ε of the largest value, 1.
        for (found, value) in found.iter().zip(&values) {
            prop_assert!((found - value).abs() < 1e-14, "{found:e} for {value:e}");
        }
        let reference = matrix.svd(false, false).singular_values;
        prop_assert!(found.iter().zip(reference.iter()).all(|(a, b)| (a - b).abs() < 1e-14));
        let expected = if values.len() == 1 { 1.0 } else { condition };
        prop_assert!((singular.condition_number() / expected - 1.0).abs() < 1e-14 * condition + 1e-12);
    }
}

/// One-sided Jacobi keeps the relative accuracy of graded columns: A = Q D has the singular values of D, over 60 decades.
#[test]
fn small_singular_values_of_graded_columns_keep_their_figures() {
    let random = &mut Random(23);
    for _ in 0..50 {
        let q = random_matrix(random, 7, 7).qr().q();
        let scales: Vec<f64> = (0..7).map(|k| 10f64.powi(30 - 10 * k)).collect();
        let matrix = Matrix::from_fn(7, 7, |row, column| q[(row, column)] * scales[column]);
        let mut singular = SingularValues::default();
        for (found, value) in singular.of(&matrix).unwrap().iter().zip(&scales) {
            assert!((found / value - 1.0).abs() < 1e-3, "{found:e} for {value:e}");
        }
    }
}

/// The Hilbert matrix of order 8: determinant 1/365356847125734485878112256000000 and condition number 1.5257575e10 (Todd 1954).
#[test]
fn the_hilbert_matrix_is_as_bad_as_known() {
    let hilbert = Matrix::from_fn(8, 8, |i, j| 1.0 / (1 + i + j) as f64);
    let mut singular = SingularValues::default();
    singular.of(&hilbert).unwrap();
    println!("condition number {:e}", singular.condition_number());
    // ε times the condition number is 3e-6.
    assert!((singular.condition_number() / 1.525_757_5e10 - 1.0).abs() < 1e-5);
    let mut lu = Lu::default();
    lu.factor(&hilbert).unwrap();
    assert!((lu.determinant() * 365_356_847_125_734_485_878_112_256_000_000.0 - 1.0).abs() < 1e-5);
}

#[test]
fn bad_matrices_are_refused() {
    let flat = Matrix::zeros(2, 3);
    let not_square = Err(DenseError::NotSquare { rows: 2, columns: 3 });
    assert_eq!(Lu::default().factor(&flat), not_square);
    assert_eq!(Cholesky::default().factor(&flat), not_square);
    assert_eq!(eliminate(&mut flat.clone(), &mut [0.0; 2]), not_square);
    let twice = Matrix::from_fn(2, 2, |_, column| 1.0 + column as f64);
    assert_eq!(Lu::default().factor(&twice), Err(DenseError::Singular { column: 1 }));
    assert_eq!(eliminate(&mut twice.clone(), &mut [1.0, 1.0]), Err(DenseError::Singular { column: 1 }));
    for bad in [f64::NAN, f64::INFINITY] {
        let mut broken = Matrix::identity(3);
        broken[(2, 0)] = bad;
        assert_eq!(Lu::default().factor(&broken), Err(DenseError::NotFinite));
        assert_eq!(Cholesky::default().factor(&broken), Err(DenseError::NotFinite));
        assert_eq!(Qr::default().factor(&broken, 1e-12), Err(DenseError::NotFinite));
        assert_eq!(null_space(&broken, 1e-12), Err(DenseError::NotFinite));
        assert_eq!(SingularValues::default().of(&broken), Err(DenseError::NotFinite));
    }
}

#[test]
fn empty_and_zero_matrices_are_fine() {
    let (empty, zero) = (Matrix::zeros(0, 0), Matrix::zeros(3, 2));
    Lu::default().factor(&empty).unwrap();
    Cholesky::default().factor(&empty).unwrap();
    let mut singular = SingularValues::default();
    assert!(singular.of(&empty).unwrap().is_empty() && singular.condition_number() == 1.0);
    assert_eq!(singular.of(&zero).unwrap(), [0.0, 0.0]);
    assert_eq!(singular.condition_number(), f64::INFINITY);
    let mut qr = Qr::default();
    assert_eq!(qr.factor(&zero, 1e-12), Ok(0));
    let mut x = [1.0, 1.0];
    assert_eq!(qr.solve(&[3.0, 0.0, 4.0], &mut x), 5.0);
    assert_eq!(x, [0.0, 0.0]);
    assert_eq!(null_space(&zero, 1e-12).unwrap().rank, 0);
}
