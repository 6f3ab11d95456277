//! The methods of a first course in numerical linear algebra, one a file. They serve small systems, show a user what a
//! matrix is like, and check the sparse solver; cost n³, so not for more than some hundred rows.
//!
//! Factor objects keep their memory: a second matrix of the same size is factored and solved without allocation.

pub mod cholesky;
pub mod elimination;
mod error;
pub mod lu;
mod matrix;
pub mod null_space;
pub mod qr;
mod reflectors;
pub mod singular;

pub use cholesky::Cholesky;
pub use error::DenseError;
pub use lu::Lu;
pub use matrix::Matrix;
pub use null_space::{NullSpace, null_space};
pub use qr::Qr;
pub use singular::SingularValues;
