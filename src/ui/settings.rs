//! The panel of the world and of the way it is stepped: gravity, drag, materials, time step, integrator, solver.

use super::widgets::{self, Number};
use super::{companions, format, status, theme};
use crate::app::{Command, Frame};
use crate::engine::{DVec2, Integrator, LinearSolver, Method, Solver, StepReport, Tuning};
use egui::Ui;

/// What a double-click resets to: the values with which the scene was opened.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Defaults {
    /// Name of the scene.
    scene: String,
    method: Method,
    gravity: DVec2,
    drag: f64,
    tuning: Tuning,
}

impl Defaults {
    /// Takes the values of `frame` if it shows another scene than the one known.
    pub fn follow(&mut self, frame: &Frame) {
        if self.scene != frame.scene.name {
            let world = &frame.world;
            *self = Defaults {
                scene: frame.scene.name.clone(),
                method: frame.method,
                gravity: world.gravity(),
                drag: world.drag(),
                tuning: world.tuning(),
            };
        }
    }
}

fn gravity_number(name: &'static str) -> Number {
    Number {
        name,
        unit: "m/s²",
        range: -30.0..=30.0,
        help: "Acceleration of every dynamic body; y points up, so the earth's is −9.81 along y.",
        logarithmic: false,
        decimals: 2,
    }
}

const DRAG: Number = Number {
    name: "Air drag",
    unit: "1/s",
    range: 0.0..=10.0,
    help: "Rate at which free motion dies away: v' = −drag · v.",
    logarithmic: true,
    decimals: 3,
};

const RESTITUTION: Number = Number {
    name: "Restitution",
    unit: "",
    range: 0.0..=1.0,
    help: "Part of the speed that a bounce gives back, of every contact at once. 0: no bounce, 1: all of it.",
    logarithmic: false,
    decimals: 2,
};

const FRICTION: Number = Number {
    name: "Friction",
    unit: "",
    range: 0.0..=2.0,
    help: "Coulomb's coefficient of every contact at once: the tangential force is at most this times the normal force.",
    logarithmic: false,
    decimals: 2,
};

const STIFFNESS: Number = Number {
    name: "Stiffness",
    unit: "×",
    range: 0.01..=100.0,
    help: "Factor on the stiffness of every spring. 1: as built.",
    logarithmic: true,
    decimals: 2,
};

const RATE: Number = Number {
    name: "Step rate",
    unit: "Hz",
    range: 10.0..=1000.0,
    help: "Steps a second of simulated time; a step lasts 1/rate. More steps: more exact, more work.",
    logarithmic: true,
    decimals: 1,
};

const STEP: Number = Number {
    name: "Time step",
    unit: "ms",
    range: 1.0..=100.0,
    help: "Length of a step: 1000/rate. Shorter: more exact, more work.",
    logarithmic: true,
    decimals: 3,
};

const SUBSTEPS: Number = Number {
    name: "Substeps",
    unit: "",
    range: 1.0..=64.0,
    help: "Parts that a step is cut into; each detects, solves and moves anew. Often better than more iterations.",
    logarithmic: true,
    decimals: 0,
};

const ITERATIONS: Number = Number {
    name: "Iterations",
    unit: "",
    range: 1.0..=1000.0,
    help: "Sweeps of the solver over all constraints and contacts in a substep. More: stiffer, more work.",
    logarithmic: true,
    decimals: 0,
};

const BAUMGARTE: Number = Number {
    name: "Baumgarte",
    unit: "",
    range: 0.0..=1.0,
    help: "Part of the position error that PGS feeds back in a substep. Too much shakes, too little drifts.",
    logarithmic: false,
    decimals: 2,
};

const ACCURACY: Number = Number {
    name: "Accuracy",
    unit: "",
    range: 1e-14..=1e-2,
    help: "Wanted error after a second or so, in parts of an island's size: 1e-3 is quick, 1e-12 is round-off.",
    logarithmic: true,
    decimals: 0,
};

/// One line on an integrator.
pub fn integrator_help(integrator: Integrator) -> &'static str {
    match integrator {
        Integrator::ExplicitEuler => {
            "Position and velocity both from the old state. Order 1; gains energy, so it explodes sooner or later."
        }
        Integrator::SemiImplicitEuler => {
            "Velocity first, then position with the new velocity. Order 1, symplectic: the energy swings but does not drift."
        }
        Integrator::PositionVerlet => "Half a drift, a kick, half a drift. Order 2, symplectic; one force evaluation.",
        Integrator::VelocityVerlet => {
            "Half a kick, a drift, half a kick. Order 2, symplectic; velocities and positions at the same instant."
        }
        Integrator::Taylor => {
            "Whole islands that nothing can touch, to the accuracy below: series of high order, constraints solved exactly."
        }
        Integrator::Rattle => {
            "Whole islands that nothing can touch: velocity Verlet, rods and pins met in every step. Order 2, symplectic."
        }
        Integrator::RungeKutta4 => {
            "Whole islands that nothing can touch, the rods' forces solved for in each of four stages. Order 4; loses energy."
        }
        Integrator::Nystrom4 => {
            "Islands of springs without dampers: six force evaluations a step. Order 4, symplectic."
        }
        Integrator::Nystrom6 => {
            "Islands of springs without dampers: eleven force evaluations a step. Order 6, symplectic."
        }
        Integrator::Radau3 | Integrator::Radau5 => {
            "Whole islands that nothing can touch, stiff or damped ones too: implicit collocation. Order 5 or 9; damps what it cannot follow."
        }
        Integrator::EnergyMomentum => {
            "Whole islands that nothing can touch, one or more solves a step. Order 2; keeps energy and both momenta exactly."
        }
    }
}

/// One line on a linear solver.
pub fn linear_help(solver: LinearSolver) -> &'static str {
    match solver {
        LinearSolver::SparseLdl => {
            "Elimination along the constraints' graph: exact, and linear in the rows of chains and trees."
        }
        LinearSolver::Elimination => {
            "Gaussian elimination with pivoting, anew for every solve: n³ each, for 400 rows at most."
        }
        LinearSolver::Lu => "Elimination kept as L U: n³ once a step, n² a solve, for 400 rows at most.",
        LinearSolver::Cholesky => {
            "A triangle and its mirror at half the cost of LU; gives the step up where rows are redundant. 400 rows at most."
        }
        LinearSolver::LeastSquares => {
            "QR with column pivoting: redundant rows share the load evenly. The costliest; 400 rows at most."
        }
        LinearSolver::Jacobi => "All rows at once from old values, as often as iterations are set: may diverge.",
        LinearSolver::GaussSeidel => {
            "Row after row with the newest values: on a chain of n rows news takes some n² sweeps."
        }
        LinearSolver::ConjugateGradients => "The best of all residuals so far: n sweeps at most, but for rounding.",
    }
}

/// One line on a solver.
pub fn solver_help(solver: Solver) -> &'static str {
    match solver {
        Solver::Projection => {
            "Moves the predicted positions onto each constraint in turn. Robust; stiffness depends on the iterations."
        }
        Solver::Pgs => {
            "Solves for impulses on the velocities, in turn, within bounds. Warm starts from the last multipliers."
        }
    }
}

/// The sections "World", "Materials" and "Solver".
pub fn show(ui: &mut Ui, frame: &Frame, defaults: &Defaults, commands: &mut Vec<Command>) {
    widgets::section(ui, "World", true, |ui| world(ui, frame, defaults, commands));
    widgets::section(ui, "Materials", true, |ui| materials(ui, frame, defaults, commands));
    widgets::section(ui, "Solver", true, |ui| solver(ui, frame, defaults, commands));
}

fn world(ui: &mut Ui, frame: &Frame, defaults: &Defaults, commands: &mut Vec<Command>) {
    let mut gravity = frame.world.gravity();
    let x = widgets::slider(ui, &gravity_number("Gravity x"), &mut gravity.x, Some(defaults.gravity.x));
    let y = widgets::slider(ui, &gravity_number("Gravity y"), &mut gravity.y, Some(defaults.gravity.y));
    if x.changed || y.changed {
        commands.push(Command::Gravity(gravity));
    }
    let mut drag = frame.world.drag();
    if widgets::slider(ui, &DRAG, &mut drag, Some(defaults.drag)).changed {
        commands.push(Command::Drag(drag));
    }
}

fn materials(ui: &mut Ui, frame: &Frame, defaults: &Defaults, commands: &mut Vec<Command>) {
    let mut tuning = frame.world.tuning();
    let mut changed = overriding(ui, &RESTITUTION, &mut tuning.restitution, 0.5);
    changed |= overriding(ui, &FRICTION, &mut tuning.friction, 0.5);
    changed |= widgets::slider(ui, &STIFFNESS, &mut tuning.stiffness, Some(defaults.tuning.stiffness)).changed;
    if changed {
        commands.push(Command::Tuning(tuning));
    }
}

/// A switch between "as built" and one value for everything, and that value's slider.
fn overriding(ui: &mut Ui, number: &Number, value: &mut Option<f64>, first: f64) -> bool {
    let mut everywhere = value.is_some();
    let label = format!("Set {}", number.name.to_lowercase());
    let help = format!("One value for every contact, in place of each body's and wall's own. {}", number.help);
    let mut changed = widgets::switch(ui, &label, &mut everywhere, Some(false), &help);
    if changed {
        *value = everywhere.then_some(first);
    }
    if let Some(value) = value {
        changed |= widgets::slider(ui, number, value, Some(first)).changed;
    }
    changed
}

fn solver(ui: &mut Ui, frame: &Frame, defaults: &Defaults, commands: &mut Vec<Command>) {
    let mut method = frame.method;
    let help = "The plan chooses how islands that nothing can touch are carried, for the accuracy wanted. Up to some hundred free \
                bodies go exactly from impact to impact. What else can touch is stepped as set by hand.";
    let mut changed = widgets::switch(ui, "By accuracy", &mut method.automatic, Some(defaults.method.automatic), help);
    if method.automatic || method.integrator.is_direct() {
        changed |= widgets::slider(ui, &ACCURACY, &mut method.accuracy, Some(defaults.method.accuracy)).changed;
    }
    outcome(ui, frame);
    changed |= step_length(ui, &mut method, &defaults.method);
    if method.automatic {
        let help = "What the plan does not choose: how to step what can touch, or comes near.";
        widgets::fold(ui, "By hand", help, |ui| {
            widgets::note(ui, effect_by_hand(&frame.report));
            changed |= by_hand(ui, &mut method, &defaults.method);
        });
    } else {
        changed |= by_hand(ui, &mut method, &defaults.method);
    }
    if changed {
        commands.push(Command::Method(method));
    }
}

/// What the plan chose and why, what that costs, and how wrong it is.
fn outcome(ui: &mut Ui, frame: &Frame) {
    let report = &frame.report;
    if !frame.plan.is_empty() {
        widgets::note(ui, &frame.plan);
    }
    if let Some(carried) = last_step(report) {
        widgets::note(ui, &carried);
    }
    if report.near > 0 {
        let islands = format::count(report.near);
        widgets::note(ui, &format!("Groups with something near, left to the substeps in this step: {islands}."));
    }
    if report.given_up > 0 {
        let islands = format::count(report.given_up);
        let note = format!(
            "Groups whose accuracy was not kept in this step, left to the substeps: {islands}. No position meets all their \
             lengths, discs on springs or anchors ask for more than 1000 steps a frame, the linear solver failed, or free bodies \
             overlap or roll over each other."
        );
        widgets::note(ui, &note);
    }
    if report.lapsed > 0 {
        let islands = format::count(report.lapsed);
        widgets::note(
            ui,
            &format!(
                "Groups carried through this step less accurately than asked: {islands}. No method reaches the accuracy for what a \
                 step may cost: ask for less, take shorter steps, or softer springs."
            ),
        );
    }
    widgets::reading(ui, "Step time", status::cost(frame), status::COST_HELP);
    if frame.method.automatic {
        let estimate = match report.local_error {
            0.0 => "not estimated".to_owned(),
            error => format::minus(format!("{error:.0e}")),
        };
        let help = "Estimated error of the last step alone, in parts of an island's size. It has to stay well below the accuracy.";
        widgets::reading(ui, "Local error", estimate, help);
    }
    if let Some(truth) = &frame.companions.truth {
        let (text, help) = companions::short_status(frame, truth, &theme::colours(ui));
        widgets::reading(ui, "Off truth", text, &help);
    }
}

/// Whether the settings by hand have any effect at the moment.
fn effect_by_hand(report: &StepReport) -> &'static str {
    if report.tick > 0 && report.substeps == 0 {
        "Nothing went through the substeps in the last step: these settings had no effect."
    } else {
        "These hold for what can touch, and for what something comes near to."
    }
}

/// What is chosen by hand: substeps and what is done in each.
fn by_hand(ui: &mut Ui, method: &mut Method, defaults: &Method) -> bool {
    let mut changed = widgets::whole_slider(ui, &SUBSTEPS, &mut method.substeps, Some(defaults.substeps)).changed;
    let substep = format::si(method.substep_seconds(), "s");
    widgets::reading(ui, "Substep", substep, "Length of a substep: the step divided by the substeps.");
    changed |= widgets::whole_slider(ui, &ITERATIONS, &mut method.iterations, Some(defaults.iterations)).changed;
    changed |= kinds(ui, method, defaults);
    if method.solver == Solver::Pgs {
        let help = "Start each solve from the last multipliers: far fewer iterations for stacks and ropes.";
        changed |= widgets::switch(ui, "Warm starting", &mut method.warm_start, Some(defaults.warm_start), help);
        changed |= widgets::slider(ui, &BAUMGARTE, &mut method.baumgarte, Some(defaults.baumgarte)).changed;
    }
    changed
}

/// How groups went through the last step: "Last step: RATTLE, order 2, 4 substeps; tridiagonal; local error 2e-7 of the size."
fn last_step(report: &StepReport) -> Option<String> {
    let mut parts = Vec::new();
    parts.extend(report.integrator.map(|integrator| of_islands(report, integrator)));
    if report.events > 0 {
        parts.push(format!("events located on the motion of free bodies: {}", report.events));
    }
    (!parts.is_empty()).then(|| format!("Last step: {}.", parts.join("; ")))
}

fn of_islands(report: &StepReport, integrator: Integrator) -> String {
    let substeps =
        if report.island_steps == 1 { "1 substep".to_owned() } else { format!("{} substeps", report.island_steps) };
    let mut text = format!("{}, order {}, {substeps}", integrator.name(), report.order);
    if let Some(matrix) = report.matrix {
        text += &format!("; matrix {}", matrix.name());
    }
    if report.linear_residual > 0.0 {
        text += &format!("; residual {:.0e} of the right-hand side", report.linear_residual);
    }
    if report.sweeps > 0 {
        text += &format!(" after {} sweeps", report.sweeps);
    }
    if report.redundant > 0 {
        text += &format!("; redundant rows dropped: {}", report.redundant);
    }
    if report.local_error > 0.0 {
        text += &format!("; local error about {:.0e} of the size", report.local_error);
    }
    text
}

/// Rate and length of a step: the same number twice, as people think of either.
fn step_length(ui: &mut Ui, method: &mut Method, defaults: &Method) -> bool {
    let rate = widgets::slider(ui, &RATE, &mut method.hz, Some(defaults.hz));
    let mut milliseconds = 1000.0 / method.hz;
    let step = widgets::number(ui, &STEP, &mut milliseconds, Some(1000.0 / defaults.hz));
    if step.changed {
        method.hz = 1000.0 / milliseconds;
    }
    rate.changed || step.changed
}

fn kinds(ui: &mut Ui, method: &mut Method, defaults: &Method) -> bool {
    let integrators = Integrator::ALL.map(|kind| (kind, kind.name(), integrator_help(kind)));
    let help = "How positions and velocities are carried through a substep.";
    let integrator =
        widgets::choice(ui, "Integrator", &mut method.integrator, Some(defaults.integrator), &integrators, help);
    widgets::note(ui, integrator_help(method.integrator));
    let solvers = Solver::ALL.map(|kind| (kind, kind.name(), solver_help(kind)));
    let help = "How constraints and contacts are solved within a substep.";
    let solver = widgets::choice(ui, "Constraint solver", &mut method.solver, Some(defaults.solver), &solvers, help);
    widgets::note(ui, solver_help(method.solver));
    let whole = method.automatic || method.integrator.is_direct();
    integrator || solver || whole && linear(ui, method, defaults)
}

/// What solves the rows of islands that are carried whole.
fn linear(ui: &mut Ui, method: &mut Method, defaults: &Method) -> bool {
    let solvers = LinearSolver::ALL.map(|kind| (kind, kind.name(), linear_help(kind)));
    let help = "What solves A x = b for islands that are carried whole. The sparse one is exact and fast; the others are there to be felt.";
    let changed = widgets::choice(ui, "Linear solver", &mut method.linear, Some(defaults.linear), &solvers, help);
    widgets::note(ui, linear_help(method.linear));
    changed
}
