//! The iterative methods.

use crate::problems::Random;
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use std::f64::consts::PI;
use tautline::engine::linalg::iterative::{
    Csr, Outcome, Preconditioner, Run, Stop, Workspace, conjugate_gradients, gauss_seidel, jacobi,
    projected_gauss_seidel,
};

fn csr(matrix: &DMatrix<f64>) -> Csr {
    let mut entries = Vec::new();
    for (row, column) in (0..matrix.nrows()).flat_map(|row| (0..matrix.ncols()).map(move |column| (row, column))) {
        if matrix[(row, column)] != 0.0 {
            entries.push((row as u32, column as u32, matrix[(row, column)]));
        }
    }
    Csr::from_entries(matrix.nrows(), &entries)
}

/// Symmetric positive definite, condition number below 1e3 or so.
fn definite(random: &mut Random, n: usize) -> DMatrix<f64> {
    let half = DMatrix::from_fn(n, n, |_, _| random.unit());
    &half * half.transpose() + DMatrix::identity(n, n) * 0.1
}

const STOP: Stop = Stop { tolerance: 1e-10, sweeps: 100_000 };

fn assert_solved(run: Run, matrix: &DMatrix<f64>, x: &[f64], b: &DVector<f64>, workspace: &Workspace) {
    let residual = (b - matrix * DVector::from_column_slice(x)).norm();
    assert_eq!(run.outcome, Outcome::Converged, "{run:?}");
    assert!(residual <= 1.01e-10 * b.norm() && (run.residual - residual).abs() <= 1e-13 * (1.0 + b.norm()));
    assert_eq!(workspace.history.len(), run.sweeps + 1);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn all_methods_solve_definite_systems(n in 1..15usize, seed: u64) {
        let random = &mut Random(seed);
        let (matrix, b) = (definite(random, n), random.vector(n));
        let (a, start) = (csr(&matrix), random.vector(n));
        let mut workspace = Workspace::default();
        let guess = || start.as_slice().to_vec();
        let mut x = guess();
        let run = gauss_seidel(&a, b.as_slice(), &mut x, 1.0, STOP, &mut workspace);
        assert_solved(run, &matrix, &x, &b, &workspace);
        for preconditioner in [Preconditioner::None, Preconditioner::Diagonal] {
            let mut x = guess();
            let run = conjugate_gradients(&a, b.as_slice(), &mut x, preconditioner, STOP, &mut workspace);
            assert_solved(run, &matrix, &x, &b, &workspace);
            // n in exact arithmetic.
            prop_assert!(run.sweeps <= 4 * n + 4, "{run:?}");
        }
        // Damped by the number of rows Jacobi converges for every definite matrix: no eigenvalue of D⁻¹ A exceeds n.
        let mut x = guess();
        let run = jacobi(&a, b.as_slice(), &mut x, 1.0 / n as f64, STOP, &mut workspace);
        assert_solved(run, &matrix, &x, &b, &workspace);
    }

    /// Of the solution with bounds the three conditions of complementarity hold in every row.
    #[test]
    fn bounded_rows_are_complementary(n in 1..15usize, seed: u64) {
        let random = &mut Random(seed);
        let (matrix, b) = (definite(random, n), 3.0 * random.vector(n));
        let bounds: Vec<(f64, f64)> = (0..n).map(|_| match random.below(4) {
            0 => (0.0, f64::INFINITY),
            1 => (f64::NEG_INFINITY, f64::INFINITY),
            2 => (-0.5, 0.5),
            _ => (0.2, 0.2),
        }).collect();
        let (mut x, mut workspace) = (random.vector(n), Workspace::default());
        let run = projected_gauss_seidel(&csr(&matrix), b.as_slice(), x.as_mut_slice(), |row| bounds[row], 1.0, STOP, &mut workspace);
        prop_assert_eq!(run.outcome, Outcome::Converged);
        let r = &b - &matrix * &x;
        for (row, &(low, high)) in bounds.iter().enumerate() {
            prop_assert!(low <= x[row] && x[row] <= high);
            let tolerance = 1e-10 * b.norm();
            prop_assert!(r[row] <= tolerance || x[row] == high, "row {row}: {} at {} of {low}..{high}", r[row], x[row]);
            prop_assert!(r[row] >= -tolerance || x[row] == low, "row {row}: {} at {} of {low}..{high}", r[row], x[row]);
        }
    }
}

fn second_difference(n: usize) -> DMatrix<f64> {
    DMatrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
        0 => 2.0,
        1 => -1.0,
        _ => 0.0,
    })
}

/// On the second difference of n points the residual falls per sweep by cos(π / (n + 1)) with Jacobi and by its square with
/// Gauss-Seidel (Young 1954), once the slowest mode alone is left.
#[test]
fn a_chain_converges_at_the_rate_of_the_textbook() {
    let n = 20;
    let (a, b) = (csr(&second_difference(n)), vec![1.0; n]);
    let radius = (PI / (n as f64 + 1.0)).cos();
    // By 1e-5 the other modes are gone, and rounding of 1e-14 is still 1e-9 of the residual.
    let stop = Stop { tolerance: 1e-5, sweeps: 10_000 };
    let mut workspace = Workspace::default();
    jacobi(&a, &b, &mut vec![0.0; n], 1.0, stop, &mut workspace);
    let rate = |history: &[f64]| history[history.len() - 1] / history[history.len() - 2];
    println!("Jacobi {} for {radius}", rate(&workspace.history));
    assert!((rate(&workspace.history) - radius).abs() < 1e-9);
    let slow = workspace.history.len();
    gauss_seidel(&a, &b, &mut vec![0.0; n], 1.0, stop, &mut workspace);
    println!("Gauss-Seidel {} for {}", rate(&workspace.history), radius * radius);
    assert!((rate(&workspace.history) - radius * radius).abs() < 1e-9);
    // Twice the rate; the constants before it differ by some sweeps.
    assert!((slow as f64 / workspace.history.len() as f64 - 2.0).abs() < 0.1);
    // The best relaxation, 2 / (1 + sin(π / (n + 1))), needs some n sweeps in place of n².
    let best = 2.0 / (1.0 + (1.0 - radius * radius).sqrt());
    let run = gauss_seidel(&a, &b, &mut vec![0.0; n], best, stop, &mut workspace);
    assert_eq!(run.outcome, Outcome::Converged);
    assert!(run.sweeps < 10 * n, "{run:?}");
}

/// A symmetric b excites 10 of the 20 eigenvectors: as many sweeps.
#[test]
fn conjugate_gradients_need_a_sweep_an_eigenvalue() {
    let n = 20;
    let stop = Stop { tolerance: 1e-12, sweeps: 100 };
    let a = csr(&second_difference(n));
    let run = conjugate_gradients(
        &a,
        &vec![1.0; n],
        &mut vec![0.0; n],
        Preconditioner::None,
        stop,
        &mut Workspace::default(),
    );
    assert_eq!((run.outcome, run.sweeps), (Outcome::Converged, 10));
}

/// Undamped, Jacobi diverges where an eigenvalue of D⁻¹ A exceeds 2: here 1 + 0.9 · 2 = 2.8.
#[test]
fn divergence_is_noticed() {
    let matrix = DMatrix::from_fn(3, 3, |i, j| if i == j { 1.0 } else { 0.9 });
    let mut workspace = Workspace::default();
    let run = jacobi(&csr(&matrix), &[1.0; 3], &mut [0.0; 3], 1.0, STOP, &mut workspace);
    assert_eq!(run.outcome, Outcome::Diverged);
    assert!(run.sweeps < 100);
    let mut broken = matrix.clone();
    broken[(1, 2)] = f64::NAN;
    let (a, b) = (csr(&broken), [1.0; 3]);
    for run in [
        jacobi(&a, &b, &mut [0.0; 3], 1.0, STOP, &mut workspace),
        gauss_seidel(&a, &b, &mut [0.0; 3], 1.0, STOP, &mut workspace),
        conjugate_gradients(&a, &b, &mut [0.0; 3], Preconditioner::Diagonal, STOP, &mut workspace),
    ] {
        assert_eq!(run.outcome, Outcome::Diverged);
    }
}

/// Two equal rows that ask for different things.
#[test]
fn contradictions_end_in_a_standstill() {
    let a = csr(&DMatrix::from_element(2, 2, 1.0));
    let mut workspace = Workspace::default();
    let run = gauss_seidel(&a, &[1.0, 2.0], &mut [0.0; 2], 1.0, STOP, &mut workspace);
    assert_eq!(run.outcome, Outcome::Stagnated);
    let run = gauss_seidel(&a, &[1.0, 1.0], &mut [0.0; 2], 1.0, STOP, &mut workspace);
    assert_eq!(run.outcome, Outcome::Converged, "redundant, but consistent");
}

#[test]
fn an_indefinite_matrix_is_reported_by_conjugate_gradients() {
    let a = csr(&DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 1.0]));
    let run =
        conjugate_gradients(&a, &[1.0, -1.0], &mut [0.0; 2], Preconditioner::None, STOP, &mut Workspace::default());
    assert_eq!(run.outcome, Outcome::NotPositive);
}

#[test]
fn limits_and_trivial_systems_end_at_once() {
    let (a, mut workspace) = (csr(&second_difference(10)), Workspace::default());
    let few = Stop { tolerance: 1e-10, sweeps: 3 };
    let run = gauss_seidel(&a, &[1.0; 10], &mut [0.0; 10], 1.0, few, &mut workspace);
    assert_eq!((run.outcome, run.sweeps, workspace.history.len()), (Outcome::SweepLimit, 3, 4));
    // The zero vector solves A x = 0, from the start and from elsewhere.
    for start in [0.0, 1.0] {
        let mut x = [start; 10];
        for run in [
            gauss_seidel(&a, &[0.0; 10], &mut x.clone(), 1.0, STOP, &mut workspace),
            conjugate_gradients(&a, &[0.0; 10], &mut x, Preconditioner::Diagonal, STOP, &mut workspace),
        ] {
            assert_eq!(run.outcome, Outcome::Converged);
        }
        assert!(x.iter().all(|x| x.abs() < 1e-8));
    }
    let run = jacobi(&Csr::from_entries(0, &[]), &[], &mut [], 1.0, STOP, &mut workspace);
    assert_eq!((run.outcome, run.sweeps), (Outcome::Converged, 0));
}

/// Entries of one place add up; order does not matter; rows may be empty.
#[test]
fn rows_are_built_from_entries_in_any_order() {
    let a = Csr::from_entries(4, &[(3, 1, 2.0), (0, 2, 1.0), (3, 1, 0.5), (0, 0, 4.0), (3, 3, 1.0), (3, 3, 1.0)]);
    assert_eq!(a.row(0), (&[0, 2][..], &[4.0, 1.0][..]));
    assert_eq!(a.row(1), (&[][..], &[][..]));
    assert_eq!(a.row(3), (&[1, 3][..], &[2.5, 2.0][..]));
    assert_eq!(a.diagonal(), [4.0, 0.0, 0.0, 2.0]);
    let mut product = [0.0; 4];
    a.times(&[1.0, 2.0, 3.0, 4.0], &mut product);
    assert_eq!(product, [7.0, 0.0, 0.0, 13.0]);
}
