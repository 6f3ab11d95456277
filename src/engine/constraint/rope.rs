//! Rope: two points at most L apart; it pulls when taut and does nothing when slack.
//!
//! C = |p_b − p_a| − L ≤ 0, with the rod's Ċ, J and K; λ ≤ 0.

use super::form::{Form, Measure};

pub(super) fn form(length: f64) -> Form {
    Form { high: 0.0, ..Form::rigid(Measure::Distance { length }) }
}
