//! The linear algebra against nalgebra, closed forms, and residuals computed here.

mod allocation;
mod dense;
mod iterative;
mod problems;
mod sparse;
