//! The lab: fronts, files, sweeps, references, the command, and the page of `docs`.

mod command;
mod files;
mod front;
mod page;
mod reference;
mod sweep;

use tautline::lab::{ErrorKind, Family, Point};

/// A point by hand.
fn point(method: &str, substeps: u32, cost: f64, error: Option<f64>) -> Point {
    Point {
        scene: "hand".to_owned(),
        method: Family::find(method).expect("a method of that name"),
        hz: 60.0,
        substeps: Some(substeps),
        iterations: None,
        tolerance: None,
        cpu_us_per_second: cost,
        error,
        error_kind: if error.is_some() { ErrorKind::Stored } else { ErrorKind::Diverged },
        violation_max: 0.0,
        energy_drift: 0.0,
    }
}
