//! Jacobi: every row is solved for its own unknown, all with the old values of the others: xᵢ += ω rᵢ / aᵢᵢ. Any order of rows
//! gives the same, so that it runs in parallel; it converges for diagonally dominant matrices, for definite ones if the damping
//! ω is small enough (below 2 over the largest eigenvalue of D⁻¹ A). Saad, "Iterative Methods for Sparse Linear Systems",
//! section 4.1.

use super::Csr;
use super::watch::{Run, Stop, Watch, Workspace, norm};

/// Improves `x`, which holds a first guess. `damping` is ω, 1 for the plain method. Rows without diagonal are left alone.
///
/// # Panics
/// If `b` or `x` have not as many entries as the matrix rows.
pub fn jacobi(a: &Csr, b: &[f64], x: &mut [f64], damping: f64, stop: Stop, workspace: &mut Workspace) -> Run {
    assert_eq!((b.len(), x.len()), (a.size(), a.size()), "one right-hand side and one unknown a row");
    workspace.prepare(a.size(), 1, stop);
    let Workspace { history, vectors: [residual, ..] } = workspace;
    compute_residual(a, b, x, residual);
    let mut watch = Watch::new(b, norm(residual), stop);
    loop {
        if let Some(run) = watch.note(norm(residual), history) {
            return run;
        }
        for ((x, r), diagonal) in x.iter_mut().zip(&*residual).zip(a.diagonal()) {
            if *diagonal != 0.0 {
                *x += damping * r / diagonal;
            }
        }
        compute_residual(a, b, x, residual);
    }
}

/// r = b − A x.
pub(super) fn compute_residual(a: &Csr, b: &[f64], x: &[f64], residual: &mut [f64]) {
    for (row, (r, b)) in residual.iter_mut().zip(b).enumerate() {
        *r = b - a.row_times(row, x);
    }
}
