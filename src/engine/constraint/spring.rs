//! Spring with a damper: the force −k C − c Ċ along the line between two points.
//!
//! C = |p_b − p_a| − rest, with the rod's Ċ, J and K; compliance α = 1/k. A spring that the step resolves is a force of
//! the integrator; one too stiff for the step is a row of the solver, where implicit Euler makes
//! λ = −(k (C + h Ċ⁺) + c Ċ⁺) of it, which is stable at every stiffness (Catto, "Soft Constraints", GDC 2011).

use super::form::{Form, Measure};

pub(super) fn form(rest: f64, stiffness: f64, damping: f64) -> Form {
    Form { stiffness, damping, ..Form::rigid(Measure::Distance { length: rest }) }
}
