//! How a user wants a world to be stepped.

use super::error::{EngineError, check};
use serde::{Deserialize, Serialize};

/// How positions and velocities are carried through a substep. The order is that of smooth, unconstrained motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Integrator {
    /// Both from the old state: order 1, gains energy.
    ExplicitEuler,
    /// Velocity first, then position with the new velocity: order 1, symplectic.
    #[default]
    SemiImplicitEuler,
    /// Half a drift, a kick, half a drift: order 2, symplectic.
    PositionVerlet,
    /// Half a kick, a drift, half a kick: order 2, symplectic; two velocity solves.
    VelocityVerlet,
    /// Taylor series of adaptive order and step, for islands that nothing can touch.
    Taylor,
    /// Implicit midpoint with discrete gradients, for islands that nothing can touch: order 2, keeps energy and momenta.
    EnergyMomentum,
    /// Velocity Verlet with the constraints met in every step, for islands that nothing can touch: order 2, symplectic.
    Rattle,
    /// The classical Runge–Kutta method with the constraints solved for in every stage: order 4.
    RungeKutta4,
    /// Symplectic Runge–Kutta–Nyström method for islands of springs without dampers: order 4.
    Nystrom4,
    /// One of that kind with more kicks and drifts: order 6, 11 evaluations of the forces a step instead of 6.
    Nystrom6,
    /// Radau's implicit collocation with the constraints among its equations: order 5, damps what it cannot follow.
    Radau3,
    /// The same with five stages: order 9.
    Radau5,
}

impl Integrator {
    /// All of them, in the order in which they are listed to a user.
    pub const ALL: [Integrator; 12] = [
        Integrator::ExplicitEuler,
        Integrator::SemiImplicitEuler,
        Integrator::PositionVerlet,
        Integrator::VelocityVerlet,
        Integrator::Taylor,
        Integrator::EnergyMomentum,
        Integrator::Rattle,
        Integrator::RungeKutta4,
        Integrator::Nystrom4,
        Integrator::Nystrom6,
        Integrator::Radau3,
        Integrator::Radau5,
    ];

    /// Those that go through the substep loop, with a solver.
    pub const SUBSTEPPED: [Integrator; 4] = [
        Integrator::ExplicitEuler,
        Integrator::SemiImplicitEuler,
        Integrator::PositionVerlet,
        Integrator::VelocityVerlet,
    ];

    /// The name shown to a user.
    pub fn name(self) -> &'static str {
        match self {
            Integrator::ExplicitEuler => "Explicit Euler",
            Integrator::SemiImplicitEuler => "Semi-implicit Euler",
            Integrator::PositionVerlet => "Position Verlet",
            Integrator::VelocityVerlet => "Velocity Verlet",
            Integrator::Taylor => "Taylor series",
            Integrator::EnergyMomentum => "Energy–momentum midpoint",
            Integrator::Rattle => "RATTLE",
            Integrator::RungeKutta4 => "Runge–Kutta of order 4",
            Integrator::Nystrom4 => "Symplectic Nyström of order 4",
            Integrator::Nystrom6 => "Symplectic Nyström of order 6",
            Integrator::Radau3 => "Radau IIA, 3 stages",
            Integrator::Radau5 => "Radau IIA, 5 stages",
        }
    }

    /// The name on the command line.
    pub fn key(self) -> &'static str {
        match self {
            Integrator::ExplicitEuler => "explicit-euler",
            Integrator::SemiImplicitEuler => "semi-implicit-euler",
            Integrator::PositionVerlet => "position-verlet",
            Integrator::VelocityVerlet => "velocity-verlet",
            Integrator::Taylor => "taylor",
            Integrator::EnergyMomentum => "energy-momentum",
            Integrator::Rattle => "rattle",
            Integrator::RungeKutta4 => "runge-kutta-4",
            Integrator::Nystrom4 => "nystrom-4",
            Integrator::Nystrom6 => "nystrom-6",
            Integrator::Radau3 => "radau-3",
            Integrator::Radau5 => "radau-5",
        }
    }

    /// Whether it carries a whole island at once, its constraints solved exactly, instead of taking a solver. What can touch
    /// is then stepped with [`Integrator::OF_CONTACTS`].
    pub fn is_direct(self) -> bool {
        !Integrator::SUBSTEPPED.contains(&self)
    }

    /// The integrator of what can touch, where the chosen one takes no contacts.
    pub const OF_CONTACTS: Integrator = Integrator::SemiImplicitEuler;
}

/// How constraints and contacts are solved within a substep.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Solver {
    /// Gauss-Seidel projection of the predicted positions (position-based dynamics of 2006).
    Projection,
    /// Projected Gauss-Seidel on the velocities, with Baumgarte's position feedback.
    #[default]
    Pgs,
}

impl Solver {
    /// All of them, in the order in which they are listed to a user.
    pub const ALL: [Solver; 2] = [Solver::Projection, Solver::Pgs];

    /// The name shown to a user.
    pub fn name(self) -> &'static str {
        match self {
            Solver::Projection => "Gauss-Seidel projection",
            Solver::Pgs => "PGS on velocities",
        }
    }
}

/// What solves A x = b, A = J M⁻¹ Jᵀ, for an island that is carried whole.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum LinearSolver {
    /// L D Lᵀ along the graph of the constraints: cost linear in the rows of chains and trees.
    #[default]
    SparseLdl,
    /// Gaussian elimination with pivoting, anew for every right-hand side: 2/3 n³ each.
    Elimination,
    /// The same kept as L U: 2/3 n³ once, 2 n² a solve.
    Lu,
    /// L Lᵀ, half of it, for positive definite matrices only: fails where rows are redundant.
    Cholesky,
    /// QR with column pivoting: the shortest solution where rows are redundant, 2 n³.
    LeastSquares,
    /// All rows at once from old values.
    Jacobi,
    /// Row after row with the newest values.
    GaussSeidel,
    /// Conjugate gradients with the diagonal as preconditioner: n sweeps at most but for rounding.
    ConjugateGradients,
}

impl LinearSolver {
    /// All of them, in the order in which they are listed to a user.
    pub const ALL: [LinearSolver; 8] = [
        LinearSolver::SparseLdl,
        LinearSolver::Elimination,
        LinearSolver::Lu,
        LinearSolver::Cholesky,
        LinearSolver::LeastSquares,
        LinearSolver::Jacobi,
        LinearSolver::GaussSeidel,
        LinearSolver::ConjugateGradients,
    ];

    /// Most rows of an island that a dense method takes.
    pub const MOST_DENSE: usize = 400;

    /// The name shown to a user.
    pub fn name(self) -> &'static str {
        match self {
            LinearSolver::SparseLdl => "Sparse LDL",
            LinearSolver::Elimination => "Gaussian elimination",
            LinearSolver::Lu => "LU",
            LinearSolver::Cholesky => "Cholesky",
            LinearSolver::LeastSquares => "Least squares by QR",
            LinearSolver::Jacobi => "Jacobi",
            LinearSolver::GaussSeidel => "Gauss-Seidel",
            LinearSolver::ConjugateGradients => "Conjugate gradients",
        }
    }

    /// The name on the command line.
    pub fn key(self) -> &'static str {
        match self {
            LinearSolver::SparseLdl => "sparse-ldl",
            LinearSolver::Elimination => "elimination",
            LinearSolver::Lu => "lu",
            LinearSolver::Cholesky => "cholesky",
            LinearSolver::LeastSquares => "least-squares",
            LinearSolver::Jacobi => "jacobi",
            LinearSolver::GaussSeidel => "gauss-seidel",
            LinearSolver::ConjugateGradients => "conjugate-gradients",
        }
    }

    /// Whether it works on all n² entries.
    pub fn is_dense(self) -> bool {
        use LinearSolver::*;
        matches!(self, Elimination | Lu | Cholesky | LeastSquares)
    }

    /// Whether it sweeps, `iterations` times at most.
    pub fn is_iterative(self) -> bool {
        use LinearSolver::*;
        matches!(self, Jacobi | GaussSeidel | ConjugateGradients)
    }
}

/// How a world is to be stepped.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Method {
    /// Steps per second of simulated time [Hz]; a step lasts 1/hz.
    pub hz: f64,
    /// Substeps a step.
    pub substeps: u32,
    /// Solver sweeps a substep.
    pub iterations: u32,
    /// How positions and velocities are carried through a substep, or islands through a step.
    pub integrator: Integrator,
    /// How constraints and contacts are solved in a substep; without effect on islands that are carried whole.
    pub solver: Solver,
    /// Start each solve from the last multipliers (PGS only; a projection has none to start from).
    pub warm_start: bool,
    /// Part of the position errors of joints (PGS) and of overlaps that is fed back in a substep, 0 … 1 (Baumgarte 1972).
    /// Less lets chains sag while PGS has not converged, more makes piles jitter.
    pub baumgarte: f64,
    /// The plan chooses integrators and steps for the wanted accuracy; the fields above then hold for what can touch.
    pub automatic: bool,
    /// What solves the rows of islands that are carried whole; methods that sweep take `iterations` sweeps at most.
    pub linear: LinearSolver,
    /// Wanted accuracy: error after a second or so, in parts of an island's size. Kept by the plan if `automatic`, and by
    /// integrators that adapt their step.
    pub accuracy: f64,
}

impl Default for Method {
    fn default() -> Self {
        Method {
            hz: 60.0,
            substeps: 4,
            iterations: 10,
            integrator: Integrator::default(),
            solver: Solver::default(),
            warm_start: true,
            baumgarte: 0.5,
            automatic: false,
            linear: LinearSolver::default(),
            accuracy: 1e-6,
        }
    }
}

impl Method {
    /// Length of a step [s].
    pub fn step_seconds(&self) -> f64 {
        1.0 / self.hz
    }

    /// Length of a substep [s].
    pub fn substep_seconds(&self) -> f64 {
        1.0 / (self.hz * f64::from(self.substeps))
    }

    /// Refuses a rate outside 1 … 100,000 Hz, no or more than 1,000 substeps, no or more than 100,000 iterations.
    pub fn validate(&self) -> Result<(), EngineError> {
        check("hz", self.hz, [1.0, 1e5], "between 1 and 100000 steps per second")?;
        check("substeps", f64::from(self.substeps), [1.0, 1e3], "between 1 and 1000")?;
        check("iterations", f64::from(self.iterations), [1.0, 1e5], "between 1 and 100000")?;
        check("baumgarte", self.baumgarte, [0.0, 1.0], "between 0 and 1")?;
        check("accuracy", self.accuracy, [1e-14, 0.1], "between 1e-14 and 0.1")
    }
}
