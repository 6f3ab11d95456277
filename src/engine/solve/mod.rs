//! Solvers of the constraints and contacts of one substep: projected Gauss-Seidel on the velocities, Gauss-Seidel
//! projection of the positions, and the impacts that come before either.

pub(crate) mod arms;
pub(crate) mod contact_rows;
pub(crate) mod feedback;
pub(crate) mod impact;
pub(crate) mod overlap;
pub(crate) mod pgs;
pub(crate) mod projection;
