//! What is measured of a run while it goes on: energy and its drift, the error against the truth, the order of convergence.

use crate::engine::{DVec2, Integrator, Method, StepReport, Stepper, World};
use crate::measure::{Distance, EnergyDrift, ErrorSum, Growth, Measures, observed_order};
use crate::truth::Trajectory;
use std::time::{Duration, Instant};

/// What is measured at one instant.
pub(super) struct Seen {
    pub measures: Measures,
    /// In parts of the energy that has moved so far.
    pub energy_drift: f64,
    /// Distance from the truth, at its samples.
    pub error: Option<Distance>,
    /// By which errors are divided to make them relative [m].
    pub length: f64,
    /// Observed order of convergence of the run so far.
    pub order: Option<f64>,
    /// By how much the motion has let errors grow so far, where that is known.
    pub growth: Option<f64>,
}

/// Measures a run from its start.
pub(super) struct Watch {
    drift: EnergyDrift,
    exact: Option<Trajectory>,
    error: ErrorSum,
    refined: Refined,
    growth: Option<Growth>,
    /// Spent on the runs beside it.
    pub(super) beside: Duration,
}

impl Watch {
    /// A run from `world`, whose exact motion may be known, which `refined` repeats, and whose sensitivity `growth`
    /// follows.
    pub(super) fn new(world: &World, exact: Option<Trajectory>, refined: Refined, growth: Option<Growth>) -> Watch {
        let drift = EnergyDrift::new(&Measures::of(world));
        Watch { drift, exact, error: ErrorSum::default(), refined, growth, beside: Duration::ZERO }
    }

    /// Takes a step of the runs beside it, after the run took one that told `report`.
    pub(super) fn step(&mut self, report: &StepReport) {
        let begun = Instant::now();
        self.growth.iter_mut().for_each(|growth| growth.step(report));
        for (world, stepper) in &mut self.refined.runs {
            self.refined.diverged |= stepper.step(world).divergence.is_some();
        }
        self.beside += begun.elapsed();
    }

    /// Measures the run where it is now, once at each of its instants.
    pub(super) fn look(&mut self, world: &World) -> Seen {
        let measures = Measures::of(world);
        let found = &world.bodies().position;
        let exact = self.exact.as_ref().and_then(|exact| exact.sample_at(world.time()));
        self.refined.look(found, exact);
        Seen {
            energy_drift: self.drift.see(&measures),
            error: exact.and_then(|exact| self.error.add(exact, found)),
            length: self.exact.as_ref().map_or(1.0, |exact| exact.length),
            order: self.refined.order(&self.error),
            growth: self.growth.as_ref().and_then(Growth::factor),
            measures,
        }
    }

    /// Error, drift and order of the whole run, as the end of a sentence; empty where nothing is known of them.
    pub(super) fn summary(&self) -> String {
        let mut text = String::new();
        if let Some(exact) = self.exact.as_ref().filter(|_| self.error.samples() > 0) {
            let (rms, max, samples, length) =
                (self.error.rms() / exact.length, self.error.max() / exact.length, self.error.samples(), exact.length);
            text += &format!("; error {rms:.2e} (worst {max:.2e}) of {length} m over {samples} samples of the truth");
            text += &format!(", energy drift {:.1e}", self.drift.relative());
        }
        if let Some(sentence) = self.growth.as_ref().and_then(Growth::sentence) {
            text += &format!("; {sentence}");
        }
        match (self.refined.runs.is_empty(), self.refined.order(&self.error)) {
            (true, _) => {}
            (false, Some(order)) => text += &format!("; observed order {order:.2}"),
            (false, None) => text += "; no observed order: the runs do not differ, or one of them diverged",
        }
        text
    }
}

/// The same run with finer substeps, beside it.
#[derive(Default)]
pub(super) struct Refined {
    /// Twice the substeps, and four times where no truth is known.
    runs: Vec<(World, Stepper)>,
    /// Error of the first finer run against the truth.
    error: ErrorSum,
    /// Distances of the run and the first finer one, and of the first and the second finer one.
    apart: [ErrorSum; 2],
    /// Whether one of them ended, after which there is nothing to compare.
    diverged: bool,
}

impl Refined {
    /// Repeats `world` under `method`; three runs in all where there is no truth.
    pub(super) fn new(world: &World, method: Method, without_truth: bool) -> anyhow::Result<Refined> {
        let adapts = method.automatic || method.integrator == Integrator::Taylor;
        anyhow::ensure!(
            !adapts,
            "--order needs steps of a fixed length: choose an integrator, for example --integrator velocity-verlet"
        );
        let factors: &[u32] = if without_truth { &[2, 4] } else { &[2] };
        let finer = |factor: &u32| {
            let method = Method { substeps: method.substeps.saturating_mul(*factor), ..method };
            Ok((world.clone(), Stepper::new(method)?))
        };
        Ok(Refined { runs: factors.iter().map(finer).collect::<anyhow::Result<_>>()?, ..Refined::default() })
    }

    fn look(&mut self, coarse: &[DVec2], exact: Option<&[DVec2]>) {
        let Some((first, _)) = self.runs.first() else { return };
        let finer = &first.bodies().position;
        if let Some(exact) = exact {
            self.error.add(exact, finer);
        }
        if let Some((second, _)) = self.runs.get(1) {
            self.apart[0].add(finer, coarse);
            self.apart[1].add(&second.bodies().position, finer);
        }
    }

    /// From the errors of two runs, or the distances of three.
    fn order(&self, coarse: &ErrorSum) -> Option<f64> {
        match self.runs.len() {
            _ if self.diverged => None,
            0 => None,
            1 => observed_order(coarse.rms(), self.error.rms()),
            _ => observed_order(self.apart[0].rms(), self.apart[1].rms()),
        }
    }
}
