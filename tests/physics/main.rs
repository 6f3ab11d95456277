//! Physics against closed forms, which the tests compute themselves. Every figure is printed; run with `--nocapture` to read.

mod chains;
mod closed_boxes;
mod clusters;
mod few;
mod figures;
mod free_motion;
mod friction;
mod grip;
mod impacts;
mod lab;
mod linear_solvers;
mod near;
mod oscillation;
mod pendulum;
mod seams;
mod stacking;
mod tunnelling;
