//! Islands that nothing can touch: bodies joined by constraints whose motion between two events is smooth.
//!
//! There the constraint system A λ = b is solved exactly, by the sparse LDLᵀ of the constraint graph, and the integrators
//! under [`crate::engine::integrate`] keep their full order. An island is a copy of its bodies in arrays of coordinates,
//! made for a plan and filled anew in every step.

pub(crate) mod accelerations;
mod energy;
pub(crate) mod forces;
pub(crate) mod forest;
mod ladder;
pub(crate) mod lanes;
pub(crate) mod linear;
pub(crate) mod matrix;
mod near;
pub(crate) mod nodes;
pub(crate) mod pairs;
pub(crate) mod partition;
pub(crate) mod projection;
mod ropes;
pub(crate) mod system;
pub(crate) mod turning;
mod work;

mod stepping;

pub(crate) use nodes::Nodes;
pub(crate) use ropes::Stretching;
pub(crate) use stepping::Islands;
pub(crate) use system::System;
