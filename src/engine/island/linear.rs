//! The course's methods in place of the sparse LDLᵀ, so that their speed and their failures can be felt on a scene.
//!
//! They take the values of the same A = J M⁻¹ Jᵀ, as a dense matrix or by rows. A factorisation that fails makes every
//! solution NaN: the island is then given up for the step. What sweeps leave of a residual goes into the motion as it is.

use crate::engine::linalg::dense::{self, Cholesky, Lu, Qr, elimination::eliminate};
use crate::engine::linalg::iterative::{
    Csr, Preconditioner, Stop, Workspace, conjugate_gradients, gauss_seidel, jacobi,
};
use crate::engine::method::LinearSolver;

/// Sweeps end where only rounding is left.
const ROUNDING: f64 = 1e-15;
/// Least squares counts a column as dependent below this part of the longest.
const DEPENDENT: f64 = 1e-12;

/// How well the solves of a step went.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Quality {
    /// Largest ‖b − A x‖ / ‖b‖, the norms being those of the largest entry.
    pub residual: f64,
    /// Most sweeps of a solve.
    pub sweeps: u32,
}

/// An entry of A, and where its value stands among those of the sparse matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Entry {
    pub row: u32,
    pub column: u32,
    pub slot: u32,
}

/// A method and its scratch memory.
#[derive(Clone, Debug, Default)]
pub(crate) struct Linear {
    solver: LinearSolver,
    iterations: u32,
    /// Row by row with ascending columns, both triangles.
    entries: Vec<Entry>,
    csr: Csr,
    matrix: dense::Matrix,
    used_up: dense::Matrix,
    lu: Lu,
    cholesky: Cholesky,
    qr: Qr,
    workspace: Workspace,
    b: Vec<f64>,
    failed: bool,
    pub quality: Quality,
}

impl Linear {
    /// `entries` in any order, repeated where pairs of rows meet twice.
    pub fn new(solver: LinearSolver, iterations: u32, rows: usize, mut entries: Vec<Entry>) -> Linear {
        entries.sort_unstable();
        entries.dedup();
        let ones: Vec<_> = entries.iter().map(|entry| (entry.row, entry.column, 1.0)).collect();
        let csr = Csr::from_entries(rows, &ones);
        let dense = if solver.is_dense() { rows } else { 0 };
        let matrix = dense::Matrix::zeros(dense, dense);
        Linear { solver, iterations, entries, csr, matrix, b: vec![0.0; rows], ..Linear::default() }
    }

    /// Takes the values of A. Returns the number of rows found to depend on others.
    pub fn factor(&mut self, values: &[f64]) -> usize {
        let slots = self.entries.iter().map(|entry| values[entry.slot as usize]);
        self.csr.set_values(slots);
        if !self.solver.is_dense() {
            return 0;
        }
        for entry in &self.entries {
            self.matrix[(entry.row as usize, entry.column as usize)] = values[entry.slot as usize];
        }
        let mut dependent = 0;
        self.failed = match self.solver {
            LinearSolver::Lu => self.lu.factor(&self.matrix).is_err(),
            LinearSolver::Cholesky => self.cholesky.factor(&self.matrix).is_err(),
            LinearSolver::LeastSquares => {
                let rank = self.qr.factor(&self.matrix, DEPENDENT);
                dependent = self.b.len() - rank.unwrap_or(self.b.len());
                rank.is_err()
            }
            _ => false,
        };
        dependent
    }

    /// A x = b in place; all NaN if it cannot be solved.
    pub fn solve(&mut self, b: &mut [f64]) {
        self.b.copy_from_slice(b);
        let stop = Stop { tolerance: ROUNDING, sweeps: self.iterations as usize };
        let workspace = &mut self.workspace;
        let run = match self.solver {
            LinearSolver::SparseLdl => None,
            LinearSolver::Elimination => {
                self.used_up.copy_from(&self.matrix);
                self.failed = eliminate(&mut self.used_up, b).is_err();
                None
            }
            LinearSolver::Lu | LinearSolver::Cholesky | LinearSolver::LeastSquares if self.failed => None,
            LinearSolver::Lu => {
                self.lu.solve(b);
                None
            }
            LinearSolver::Cholesky => {
                self.cholesky.solve(b);
                None
            }
            LinearSolver::LeastSquares => {
                self.qr.solve(&self.b, b);
                None
            }
            LinearSolver::Jacobi => {
                b.fill(0.0);
                Some(jacobi(&self.csr, &self.b, b, 1.0, stop, workspace))
            }
            LinearSolver::GaussSeidel => {
                b.fill(0.0);
                Some(gauss_seidel(&self.csr, &self.b, b, 1.0, stop, workspace))
            }
            LinearSolver::ConjugateGradients => {
                b.fill(0.0);
                Some(conjugate_gradients(&self.csr, &self.b, b, Preconditioner::Diagonal, stop, workspace))
            }
        };
        if self.failed {
            b.fill(f64::NAN);
            return;
        }
        if let Some(run) = run {
            self.quality.sweeps = self.quality.sweeps.max(run.sweeps as u32);
        }
        self.note_residual(b);
    }

    fn note_residual(&mut self, x: &[f64]) {
        let size = self.b.iter().fold(0.0f64, |most, b| most.max(b.abs()));
        let mut far = 0.0f64;
        for row in 0..x.len() {
            let (columns, values) = self.csr.row(row);
            let product: f64 = columns.iter().zip(values).map(|(column, value)| value * x[*column as usize]).sum();
            far = far.max((self.b[row] - product).abs());
        }
        if size > 0.0 {
            self.quality.residual = self.quality.residual.max(far / size);
        }
    }
}
