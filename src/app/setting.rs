//! Settings by the names under which undo and redo offer their changes.

use crate::engine::{Method, Tuning};

/// Several settings at once.
const SEVERAL: &str = "settings";

/// Which part of a method is another one; `None` if both are the same.
pub fn method(from: &Method, to: &Method) -> Option<&'static str> {
    one_of(&[
        (from.hz != to.hz, "step rate"),
        (from.substeps != to.substeps, "substeps"),
        (from.iterations != to.iterations, "iterations"),
        (from.integrator != to.integrator, "integrator"),
        (from.solver != to.solver, "constraint solver"),
        (from.warm_start != to.warm_start, "warm starting"),
        (from.baumgarte != to.baumgarte, "Baumgarte factor"),
    ])
}

/// Which part of a tuning is another one; `None` if both are the same.
pub fn tuning(from: &Tuning, to: &Tuning) -> Option<&'static str> {
    one_of(&[
        (from.stiffness != to.stiffness, "stiffness"),
        (from.restitution != to.restitution, "restitution"),
        (from.friction != to.friction, "friction"),
    ])
}

fn one_of(parts: &[(bool, &'static str)]) -> Option<&'static str> {
    let mut changed = parts.iter().filter(|(changed, _)| *changed).map(|(_, name)| *name);
    let first = changed.next()?;
    Some(if changed.next().is_some() { SEVERAL } else { first })
}
