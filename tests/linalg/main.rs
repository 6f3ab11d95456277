//! The linear algebra against nalgebra, closed forms, and residuals computed here.

mod problems;
mod sparse;
