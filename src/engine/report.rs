//! What a step tells about itself.

use super::id::Id;
use super::linalg::sparse::Path;
use super::method::Integrator;

/// The stages of a substep, in order, as in the loop of `step.rs`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Gravity, springs, dampers, drag and the grip are summed.
    Forces,
    /// The integrator carries the state on as if nothing constrained it.
    Predict,
    /// Broad and narrow phase find what touches or is about to.
    Detect,
    /// Rows of constraints and contacts are set up from the state.
    Assemble,
    /// Rows are solved, in islands that are carried whole as well.
    Solve,
    /// Positions are carried to the end, and forces and contacts kept.
    Update,
}

impl Stage {
    /// All of them, in order.
    pub const ALL: [Stage; 6] =
        [Stage::Forces, Stage::Predict, Stage::Detect, Stage::Assemble, Stage::Solve, Stage::Update];

    /// The name shown to a user.
    pub fn name(self) -> &'static str {
        ["Forces", "Prediction", "Detection", "Assembly", "Solve", "Update"][self as usize]
    }
}

/// Where and how a run left the range of numbers in which it means anything.
#[derive(Clone, Debug, PartialEq)]
pub struct Divergence {
    /// The body that shows it.
    pub body: Id,
    /// "position", "velocity", "angle" or "angular velocity".
    pub quantity: &'static str,
    /// Its value then (may be NaN or infinite).
    pub value: f64,
    /// Substep of the step in which it was seen, from 0.
    pub substep: u32,
    /// The most likely cause in this scene, and a setting to try.
    pub advice: String,
}

impl std::fmt::Display for Divergence {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "the run diverged: {} of body {} became {:e}. {}", self.quantity, self.body, self.value, self.advice)
    }
}

/// Everything one step did. Counts of rows, contacts and iterations are those of the last substep unless said.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StepReport {
    /// Number of the step just taken (the world's tick after it).
    pub tick: u64,
    /// Bodies in the world, those that never move included.
    pub bodies: usize,
    /// Rods, ropes, springs and pins in the world.
    pub constraints: usize,
    /// Scalar rows in the solver, contacts' two each included.
    pub rows: usize,
    /// Contacts that carry a force.
    pub contacts: usize,
    /// Pairs that the broad phase handed to the narrow phase, summed over the substeps.
    pub candidates: usize,
    /// Times that the broad phase was built anew, summed over the substeps.
    pub broad_phase_builds: u32,
    /// Impacts with restitution, summed over the substeps.
    pub impacts: usize,
    /// Instants located on the motion of free bodies: impacts, ends of slides, ends of sides.
    pub events: u32,
    /// Substeps of what can touch; 0 if all is carried by islands.
    pub substeps: u32,
    /// Steps of islands carried whole, the largest number of one island.
    pub island_steps: u32,
    /// Steps of islands that were taken back, all islands together.
    pub retries: u32,
    /// What carried the largest island in this step; `None` without islands.
    pub integrator: Option<Integrator>,
    /// The matrix of that island's constraints; `None` without islands or rows.
    pub matrix: Option<Path>,
    /// Highest order of an island's steps.
    pub order: u32,
    /// Estimate of the local error of this step, in parts of an island's size; 0 if nothing estimates it.
    pub local_error: f64,
    /// Worst ‖b − A x‖ / ‖b‖ of the islands' solves; 0 with the sparse LDLᵀ, which is not watched.
    pub linear_residual: f64,
    /// Most sweeps of one solve; 0 with methods that do not sweep.
    pub sweeps: u32,
    /// Rows that depend on others and were dropped.
    pub redundant: usize,
    /// Islands that could not be carried to the accuracy in this step and went through the substeps instead.
    pub given_up: usize,
    /// Islands carried whole whose accuracy could not be kept within the work that a step may cost.
    pub lapsed: usize,
    /// Islands that something came near to in this step, so that they went through the substeps.
    pub near: usize,
    /// Sweeps of the solver, summed over the substeps.
    pub iterations: u32,
    /// Largest change of a row's velocity (PGS, [m/s]) or of a constraint's value (projection, [m]) in the last sweep.
    pub residual: f64,
    /// Time a stage took [µs], in the order of [`Stage::ALL`], summed over the substeps; zero if the stepper has no clock.
    pub stage_us: [f64; 6],
    /// Time of the whole step [µs]; zero if the stepper has no clock.
    pub step_us: f64,
    /// Set if the step was taken back: the world then is as it was before it.
    pub divergence: Option<Divergence>,
}

impl StepReport {
    /// Whether a step by accuracy did not keep it everywhere: something went through the substeps, or was carried
    /// less accurately than asked.
    pub fn fell_short(&self) -> bool {
        self.substeps > 0 || self.lapsed > 0
    }
}
