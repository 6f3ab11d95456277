//! Methods that approach the solution sweep by sweep, one a file, with the history of their residuals. They are what physics
//! engines use, what people come to watch, and the baseline for the direct solver.

pub mod conjugate_gradients;
mod csr;
pub mod gauss_seidel;
pub mod jacobi;
pub mod projected;
mod watch;

pub use conjugate_gradients::{Preconditioner, conjugate_gradients};
pub use csr::Csr;
pub use gauss_seidel::gauss_seidel;
pub use jacobi::jacobi;
pub use projected::projected_gauss_seidel;
pub use watch::{Outcome, Run, Stop, Workspace};
