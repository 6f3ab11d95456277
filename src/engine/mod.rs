//! The physics core: a [`World`] is state, a [`Method`] says how it is to be stepped, a [`Plan`] is what that means for
//! this world, and a [`Stepper`] carries it out.
//!
//! Units are SI throughout: metres, kilograms, seconds, newtons, radians. Axes: x to the right, y up, angles counter-clockwise.
//! Everything is `f64`. No file, window, thread or clock is known here; a clock for the stage timings can be handed in.

pub mod body;
mod collide;
pub mod constraint;
pub mod error;
mod filter;
pub mod id;
mod impact;
mod integrate;
mod island;
pub mod linalg;
mod material;
pub mod method;
pub mod plan;
pub mod report;
pub mod shape;
mod solve;
mod state;
pub mod step;
pub mod world;

pub use body::{Body, Motion, Spin};
pub use constraint::{Anchor, Constraint, Grip, Kind};
pub use error::EngineError;
pub use glam::DVec2;
pub use id::Id;
pub use material::Material;
pub use method::{Integrator, LinearSolver, Method, Solver};
pub use plan::{Carrier, Plan};
pub use report::{Divergence, Stage, StepReport};
pub use shape::{Shape, Wall};
pub use step::Stepper;
pub use world::{Contact, Touching, Tuning, World};
