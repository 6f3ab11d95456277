//! A method as the lab sees it: a family and its knobs.

use crate::engine::{Integrator, Method, Solver};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Methods that share their knobs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// The accuracy dial: the plan chooses. Knob: tolerance.
    Dial,
    /// An integrator that carries islands whole. Knob: substeps; of the Taylor series the tolerance.
    Direct(Integrator),
    /// An integrator of the substep loop with a solver. Knobs: substeps and iterations.
    Substepped(Integrator, Solver),
}

impl Family {
    /// All of them, in the order in which they are listed to a user.
    pub const ALL: [Family; 17] = [
        Family::Dial,
        Family::Direct(Integrator::Taylor),
        Family::Direct(Integrator::EnergyMomentum),
        Family::Direct(Integrator::Rattle),
        Family::Direct(Integrator::RungeKutta4),
        Family::Direct(Integrator::Nystrom4),
        Family::Direct(Integrator::Nystrom6),
        Family::Direct(Integrator::Radau3),
        Family::Direct(Integrator::Radau5),
        Family::Substepped(Integrator::SemiImplicitEuler, Solver::Pgs),
        Family::Substepped(Integrator::SemiImplicitEuler, Solver::Projection),
        Family::Substepped(Integrator::VelocityVerlet, Solver::Pgs),
        Family::Substepped(Integrator::VelocityVerlet, Solver::Projection),
        Family::Substepped(Integrator::PositionVerlet, Solver::Pgs),
        Family::Substepped(Integrator::PositionVerlet, Solver::Projection),
        Family::Substepped(Integrator::ExplicitEuler, Solver::Pgs),
        Family::Substepped(Integrator::ExplicitEuler, Solver::Projection),
    ];

    /// The name on the command line and in files: "accuracy", "rattle", "semi-implicit-euler+pgs".
    pub fn key(self) -> String {
        match self {
            Family::Dial => "accuracy".to_owned(),
            Family::Direct(integrator) => integrator.key().to_owned(),
            Family::Substepped(integrator, solver) => format!("{}+{}", integrator.key(), solver_key(solver)),
        }
    }

    /// The family of that name.
    pub fn find(key: &str) -> Option<Family> {
        Family::ALL.into_iter().find(|family| family.key() == key)
    }

    /// The name shown to a user.
    pub fn name(self) -> String {
        match self {
            Family::Dial => "Accuracy".to_owned(),
            Family::Direct(integrator) => integrator.name().to_owned(),
            Family::Substepped(integrator, Solver::Pgs) => format!("{} + PGS", integrator.name()),
            Family::Substepped(integrator, Solver::Projection) => format!("{} + projection", integrator.name()),
        }
    }

    /// Where it stands in [`Family::ALL`].
    pub fn index(self) -> usize {
        Family::ALL.iter().position(|family| *family == self).unwrap_or(0)
    }
}

fn solver_key(solver: Solver) -> &'static str {
    match solver {
        Solver::Projection => "projection",
        Solver::Pgs => "pgs",
    }
}

impl Serialize for Family {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.key())
    }
}

impl<'de> Deserialize<'de> for Family {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Family, D::Error> {
        let key = String::deserialize(deserializer)?;
        Family::find(&key).ok_or_else(|| D::Error::custom(format!("there is no method {key:?}")))
    }
}

/// A family with its knobs set. A knob that is not given is the scene's own, and of no effect unless something touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// Which methods, and hence which knobs.
    pub family: Family,
    /// Steps a second [Hz].
    pub hz: f64,
    /// Substeps a step; `None` leaves them to the scene.
    pub substeps: Option<u32>,
    /// Sweeps of the solver a substep; `None` leaves them to the scene.
    pub iterations: Option<u32>,
    /// Wanted accuracy, in parts of an island's size; `None` leaves it to the scene.
    pub tolerance: Option<f64>,
}

impl Setting {
    /// The baseline of every engine: semi-implicit Euler with PGS, 4 substeps of 10 iterations at 60 Hz.
    pub const BASELINE: Setting = Setting {
        family: Family::Substepped(Integrator::SemiImplicitEuler, Solver::Pgs),
        hz: 60.0,
        substeps: Some(4),
        iterations: Some(10),
        tolerance: None,
    };

    /// The accuracy dial at `tolerance`.
    pub fn dial(tolerance: f64) -> Setting {
        Setting { family: Family::Dial, hz: 60.0, substeps: None, iterations: None, tolerance: Some(tolerance) }
    }

    /// An integrator of islands with so many substeps.
    pub fn direct(integrator: Integrator, substeps: u32) -> Setting {
        Setting { family: Family::Direct(integrator), substeps: Some(substeps), ..Setting::BASELINE }.without_sweeps()
    }

    /// The Taylor series at `tolerance`.
    pub fn taylor(tolerance: f64) -> Setting {
        Setting { family: Family::Direct(Integrator::Taylor), ..Setting::dial(tolerance) }
    }

    /// An integrator and solver of the substep loop.
    pub fn substepped(integrator: Integrator, solver: Solver, substeps: u32, iterations: u32) -> Setting {
        let family = Family::Substepped(integrator, solver);
        Setting { family, substeps: Some(substeps), iterations: Some(iterations), ..Setting::BASELINE }
    }

    fn without_sweeps(self) -> Setting {
        Setting { iterations: None, ..self }
    }

    /// The method for a scene whose own one is `scene`.
    pub fn method(&self, scene: Method) -> Method {
        let (integrator, solver) = match self.family {
            Family::Dial => (scene.integrator, scene.solver),
            Family::Direct(integrator) => (integrator, scene.solver),
            Family::Substepped(integrator, solver) => (integrator, solver),
        };
        Method {
            hz: self.hz,
            substeps: self.substeps.unwrap_or(scene.substeps),
            iterations: self.iterations.unwrap_or(scene.iterations),
            integrator,
            solver,
            automatic: self.family == Family::Dial,
            accuracy: self.tolerance.unwrap_or(scene.accuracy),
            ..scene
        }
    }

    /// What a user reads: "Accuracy 1e-6", "RATTLE, 4 substeps", "Semi-implicit Euler + PGS, 4 × 10 at 240 Hz".
    pub fn label(&self) -> String {
        let mut text = self.family.name();
        if let Some(tolerance) = self.tolerance {
            text += &if self.family == Family::Dial { format!(" {tolerance:e}") } else { format!(" to {tolerance:e}") };
        }
        text += &match (self.substeps, self.iterations) {
            (Some(substeps), Some(iterations)) => format!(", {substeps} × {iterations}"),
            (Some(1), None) => ", 1 substep".to_owned(),
            (Some(substeps), None) => format!(", {substeps} substeps"),
            (None, Some(iterations)) => format!(", {iterations} iterations"),
            (None, None) => String::new(),
        };
        if self.hz != 60.0 {
            text += &format!(" at {} Hz", self.hz);
        }
        text
    }

    /// About how much work a simulated second is, in arbitrary units that can be compared within a family.
    pub(super) fn work(&self) -> f64 {
        let substeps = f64::from(self.substeps.unwrap_or(1));
        // A substep costs about as much as a few sweeps besides its sweeps.
        let sweeps = self.iterations.map_or(1.0, |iterations| f64::from(iterations) + 5.0);
        // The order of a series grows with the digits, and its cost with the square of the order.
        let digits = self.tolerance.map_or(1.0, |tolerance| -libm::log10(tolerance));
        self.hz * substeps * sweeps * digits * digits
    }
}
