//! Conjugate gradients: the x of least error in the span of all residuals so far; a sweep costs one product with A. Ends after n
//! sweeps in exact arithmetic, after some √κ · log(1 / tolerance) in practice, κ the condition number. For symmetric positive
//! definite matrices. Hestenes and Stiefel (1952); Saad, "Iterative Methods for Sparse Linear Systems", sections 6.7 and 9.2.

use super::Csr;
use super::jacobi::compute_residual;
use super::watch::{Outcome, Run, Stop, Watch, Workspace, norm};

/// A cheap approximate inverse with which every residual is multiplied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Preconditioner {
    /// The residual is taken as it is.
    None,
    /// 1 / aᵢᵢ: undoes rows of different scale, as from masses that differ. Rows without positive diagonal are left as they are.
    Diagonal,
}

/// Improves `x`, which holds a first guess.
///
/// The residual in the history is updated, not computed; before a run ends as converged it is computed, and if rounding has
/// led them apart, the method starts anew from there.
///
/// # Panics
/// If `b` or `x` have not as many entries as the matrix rows.
pub fn conjugate_gradients(
    a: &Csr,
    b: &[f64],
    x: &mut [f64],
    preconditioner: Preconditioner,
    stop: Stop,
    workspace: &mut Workspace,
) -> Run {
    assert_eq!((b.len(), x.len()), (a.size(), a.size()), "one right-hand side and one unknown a row");
    workspace.prepare(a.size(), 4, stop);
    let Workspace { history, vectors: [r, z, direction, image] } = workspace;
    compute_residual(a, b, x, r);
    let mut watch = Watch::new(b, norm(r), stop);
    let mut square = restart(a, preconditioner, r, z, direction);
    loop {
        if let Some(run) = watch.note(norm(r), history) {
            compute_residual(a, b, x, r);
            let residual = norm(r);
            if run.outcome != Outcome::Converged || watch.met_by(residual) || run.sweeps >= stop.sweeps {
                let outcome = match run.outcome {
                    Outcome::Converged if !watch.met_by(residual) => Outcome::SweepLimit,
                    outcome => outcome,
                };
                return Run { outcome, residual, ..run };
            }
            *history.last_mut().expect("it was just noted") = residual;
            square = restart(a, preconditioner, r, z, direction);
        }
        a.times(direction, image);
        let curvature = dot(direction, image);
        if !(curvature > 0.0) {
            return Run { outcome: Outcome::NotPositive, sweeps: history.len() - 1, residual: norm(r) };
        }
        let step = square / curvature;
        for k in 0..x.len() {
            x[k] += step * direction[k];
            r[k] -= step * image[k];
        }
        precondition(a, preconditioner, r, z);
        let before = std::mem::replace(&mut square, dot(r, z));
        for (direction, z) in direction.iter_mut().zip(&*z) {
            *direction = z + square / before * *direction;
        }
    }
}

/// The first direction is the preconditioned residual. Returns rᵀz.
fn restart(a: &Csr, preconditioner: Preconditioner, r: &[f64], z: &mut [f64], direction: &mut [f64]) -> f64 {
    precondition(a, preconditioner, r, z);
    direction.copy_from_slice(z);
    dot(r, z)
}

fn precondition(a: &Csr, preconditioner: Preconditioner, r: &[f64], z: &mut [f64]) {
    match preconditioner {
        Preconditioner::None => z.copy_from_slice(r),
        Preconditioner::Diagonal => {
            for ((z, r), diagonal) in z.iter_mut().zip(r).zip(a.diagonal()) {
                *z = if *diagonal > 0.0 { r / diagonal } else { *r };
            }
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
