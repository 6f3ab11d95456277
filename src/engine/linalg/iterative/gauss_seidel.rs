//! Gauss-Seidel: row after row is solved for its own unknown with the newest values of the others, xᵢ += rᵢ / aᵢᵢ. Converges
//! for every symmetric positive definite matrix, also a semidefinite one with consistent b; on a chain of n rows it needs some
//! n² sweeps, as news travels one row a sweep. In mechanics the rows are constraints, the unknowns impulses, and a sweep is an
//! iteration of "sequential impulses". Saad, "Iterative Methods for Sparse Linear Systems", section 4.1.

use super::Csr;
use super::projected::projected_gauss_seidel;
use super::watch::{Run, Stop, Workspace};

/// Improves `x`, which holds a first guess. `relaxation` is 1 for the plain method, between 1 and 2 for successive
/// over-relaxation. Rows without diagonal are left alone.
///
/// # Panics
/// If `b` or `x` have not as many entries as the matrix rows.
pub fn gauss_seidel(a: &Csr, b: &[f64], x: &mut [f64], relaxation: f64, stop: Stop, workspace: &mut Workspace) -> Run {
    projected_gauss_seidel(a, b, x, |_| (f64::NEG_INFINITY, f64::INFINITY), relaxation, stop, workspace)
}
