//! Motions and forces that have a formula, one concept a file. All motions start at time 0; units are SI.
//!
//! Nothing here calls the engine's integrators or solvers: each file says where its formula comes from, and its tests hold it
//! against an integration, a quadrature or a law that the formula does not use.

mod bounce;
mod capstan;
mod elliptic;
mod exchange;
mod free;
mod hanging;
mod oscillator;
mod pendulum;
mod ramp;
mod row;
mod stack;

pub use bounce::{BouncingBall, Flight};
pub use capstan::{capstan_ratio, peg_ratio};
pub use elliptic::{Jacobi, jacobi, quarter_period};
pub use exchange::{Encounter, Hitting, exchange};
pub use free::{fall_with_drag, projectile};
pub use hanging::{Hanging, NoBalance};
pub use oscillator::Oscillator;
pub use pendulum::Pendulum;
pub use ramp::{Roll, Rolling, Slide};
pub use row::{elastic_row, reflected};
pub use stack::{stack_forces, wedged_forces};
