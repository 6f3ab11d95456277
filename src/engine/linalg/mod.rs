//! Linear algebra for the systems that constraints lead to. Everything works on plain slices of `f64`; nothing here knows a
//! body or a joint.
//!
//! - [`sparse`]: the direct solver of A λ = b for A = J M⁻¹ Jᵀ + α̃ on a constraint graph
//! - [`dense`]: the methods of a first course on small matrices: elimination, LU, Cholesky, least squares, null space,
//!   singular values
//! - [`iterative`]: Jacobi, Gauss-Seidel, projected Gauss-Seidel, conjugate gradients, with the history of their residuals

pub(crate) mod complex;
pub mod dense;
pub mod iterative;
pub mod sparse;
