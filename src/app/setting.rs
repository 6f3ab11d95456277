//! Settings by the names under which undo and redo offer their changes.

use crate::engine::{Method, Tuning};

/// Several settings at once.
const SEVERAL: &str = "settings";

/// Which part of a method is another one; `None` if both are the same.
pub fn method(from: &Method, to: &Method) -> Option<&'static str> {
    // All fields by name, so that a new one cannot be left out.
    let Method { hz, substeps, iterations, integrator, solver, warm_start, baumgarte, automatic, linear, accuracy } =
        *from;
    one_of(&[
        (hz != to.hz, "step rate"),
        (substeps != to.substeps, "substeps"),
        (iterations != to.iterations, "iterations"),
        (integrator != to.integrator, "integrator"),
        (solver != to.solver, "constraint solver"),
        (warm_start != to.warm_start, "warm starting"),
        (baumgarte != to.baumgarte, "Baumgarte factor"),
        (automatic != to.automatic, "choice by accuracy"),
        (linear != to.linear, "linear solver"),
        (accuracy != to.accuracy, "accuracy"),
    ])
}

/// Which part of a tuning is another one; `None` if both are the same.
pub fn tuning(from: &Tuning, to: &Tuning) -> Option<&'static str> {
    let Tuning { stiffness, restitution, friction } = *from;
    one_of(&[
        (stiffness != to.stiffness, "stiffness"),
        (restitution != to.restitution, "restitution"),
        (friction != to.friction, "friction"),
    ])
}

fn one_of(parts: &[(bool, &'static str)]) -> Option<&'static str> {
    let mut changed = parts.iter().filter(|(changed, _)| *changed).map(|(_, name)| *name);
    let first = changed.next()?;
    Some(if changed.next().is_some() { SEVERAL } else { first })
}
