//! Rod: two points at a fixed distance L, pulling and pushing.
//!
//! C = |p_b − p_a| − L; Ċ = n·(v_b − v_a) with n the unit vector from a to b; J = (−n, −r_a×n | n, r_b×n);
//! K = w_a + w_b (+ (r×n)²/I of each body with spin). λ < 0 pulls.

use super::form::{Form, Measure};

pub(super) fn form(length: f64) -> Form {
    Form::rigid(Measure::Distance { length })
}
