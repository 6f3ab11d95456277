//! Pin: a point of one body and a point of another (or of the world) coincide; both may turn about it.
//!
//! C = p_b − p_a (2 rows, along x and y); Ċ = v_b + ω_b × r_b − v_a − ω_a × r_a; J = (−1, −r_a× | 1, r_b×);
//! K = (w_a + w_b) 1 + the 2 × 2 parts of the arms. λ is the force on b.

use super::form::{Form, Measure};

pub(super) fn form() -> Form {
    Form::rigid(Measure::Offset)
}
