//! Constraints and holds that turn discs, carried whole: against closed forms, and against the same motions in minimal coordinates,
//! integrated here by an extrapolation method that shares nothing with the engine. Figures are printed; `--nocapture` to read.

mod conservation;
mod hold;
mod independent;
mod pendulums;
mod plan;
mod ropes;
mod springs;

use tautline::engine::{
    Anchor, Body, Constraint, DVec2, Id, Integrator, Kind, Method, Spin, StepReport, Stepper, World,
};
use tautline::measure::Measures;

const G: f64 = 9.81;

fn v(x: f64, y: f64) -> DVec2 {
    DVec2::new(x, y)
}

fn by_accuracy(accuracy: f64) -> Method {
    Method { automatic: true, accuracy, ..Method::default() }
}

/// A disc that collides with nothing.
fn disc(position: DVec2, mass: f64, radius: f64, angle: f64, omega: f64) -> Body {
    Body { position, mass, radius, spin: Some(Spin { angle, omega }), collides: false, ..Body::default() }
}

fn join(world: &mut World, kind: Kind, a: Anchor, b: Anchor) -> Id {
    world.add_constraint(&Constraint { kind, a, b }).unwrap()
}

/// One step in which everything is carried whole; nothing may diverge or be given up.
fn step(world: &mut World, stepper: &mut Stepper) -> StepReport {
    let report = stepper.step(world);
    assert!(report.divergence.is_none() && report.given_up == 0 && report.substeps == 0, "{report:?}");
    assert!(report.integrator.is_some());
    report
}

/// What is allowed after a second or two: quick methods down to 6e-4, series to 1e-5 at the loosest, and some rounding.
fn allowed(accuracy: f64) -> f64 {
    if accuracy >= 6e-4 { accuracy } else { accuracy.min(1e-5) + 1e-12 }
}

fn angle(world: &World, body: usize) -> f64 {
    world.bodies().spin(body).unwrap().angle
}

fn omega(world: &World, body: usize) -> f64 {
    world.bodies().spin(body).unwrap().omega
}

fn violation(world: &World) -> f64 {
    Measures::of(world).violation_max
}

/// I + m d² of a disc about a point at distance `d` from its centre [kg·m²].
fn inertia_about(mass: f64, radius: f64, d: f64) -> f64 {
    0.5 * mass * radius * radius + mass * d * d
}
