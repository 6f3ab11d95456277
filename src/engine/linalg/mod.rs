//! Linear algebra for the systems that constraints lead to. Everything works on plain slices of `f64`; nothing here knows a
//! body or a joint.
//!
//! - [`sparse`]: the direct solver of A λ = b for A = J M⁻¹ Jᵀ + α̃ on a constraint graph

pub mod sparse;
