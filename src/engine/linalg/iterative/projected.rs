//! Projected Gauss-Seidel: as Gauss-Seidel, but every unknown is kept between bounds: low ≤ x ≤ high. What it solves is the
//! mixed linear complementarity problem: each row has b = A x, or x at its lower bound and A x ≥ b, or x at its upper bound and
//! A x ≤ b. Contacts (an impulse never pulls), motors with a greatest torque and friction boxes are such rows. Converges for
//! symmetric positive definite matrices. Cottle, Pang and Stone, "The Linear Complementarity Problem", section 5.2.

use super::Csr;
use super::watch::{Run, Stop, Watch, Workspace, norm};

/// Improves `x`, which holds a first guess that need not lie within the bounds. `bounds(row)` is (low, high), infinite where
/// there is none. `relaxation` is 1 for the plain method. Rows without diagonal stay at their guess, within the bounds.
///
/// The residual counts what a row may still change: b − A x, but 0 where only a bound stands against it.
///
/// # Panics
/// If `b` or `x` have not as many entries as the matrix rows, or a lower bound is above its upper one or NaN.
pub fn projected_gauss_seidel(
    a: &Csr,
    b: &[f64],
    x: &mut [f64],
    bounds: impl Fn(usize) -> (f64, f64),
    relaxation: f64,
    stop: Stop,
    workspace: &mut Workspace,
) -> Run {
    assert_eq!((b.len(), x.len()), (a.size(), a.size()), "one right-hand side and one unknown a row");
    workspace.prepare(a.size(), 1, stop);
    let Workspace { history, vectors: [residual, ..] } = workspace;
    let clamp = |row: usize, x: f64| {
        let (low, high) = bounds(row);
        x.clamp(low, high)
    };
    x.iter_mut().enumerate().for_each(|(row, x)| *x = clamp(row, *x));
    compute_residual(a, b, x, &bounds, residual);
    let mut watch = Watch::new(b, norm(residual), stop);
    loop {
        if let Some(run) = watch.note(norm(residual), history) {
            return run;
        }
        for (row, diagonal) in a.diagonal().iter().enumerate() {
            if *diagonal != 0.0 {
                x[row] = clamp(row, x[row] + relaxation * (b[row] - a.row_times(row, x)) / diagonal);
            }
        }
        compute_residual(a, b, x, &bounds, residual);
    }
}

fn compute_residual(a: &Csr, b: &[f64], x: &[f64], bounds: impl Fn(usize) -> (f64, f64), residual: &mut [f64]) {
    for (row, residual) in residual.iter_mut().enumerate() {
        let (low, high) = bounds(row);
        let r = b[row] - a.row_times(row, x);
        // A positive residual asks for a larger x.
        let blocked = (x[row] >= high && r > 0.0) || (x[row] <= low && r < 0.0);
        *residual = if blocked { 0.0 } else { r };
    }
}
