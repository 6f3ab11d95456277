//! What methods cost on an island, so that they can be compared without a clock: in nanoseconds of a core of 2026, or so. Only ratios
//! matter, and the same island always finds the same ones.
//!
//! Fitted to steps of ropes, nets and cloth of 20 to 400 nodes (`cargo bench --bench accuracy`), within a third.

use super::System;
use crate::engine::integrate::outcome::Outcome;
use crate::engine::method::Integrator;

/// A multiplication and addition of a factorisation, an entry of a solve [ns].
const FACTOR: f64 = 0.35;
const SOLVE: f64 = 1.0;

/// The sizes of an island that work grows with.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Work {
    /// Nodes, or rods and springs if they are more.
    links: f64,
    /// Work of a factorisation and of a solve of A = J M⁻¹ Jᵀ, beyond what is linear [ns].
    dual: [f64; 2],
    /// The same of the matrix of the nodes.
    primal: [f64; 2],
    /// Nothing but forces acts; springs or one more rod beside a tree of rods.
    free: bool,
    extra: bool,
}

impl Work {
    /// `tree`: nothing closes a loop.
    pub fn new(system: &System, tree: bool) -> Work {
        let n = system.nodes.len() as f64;
        let links = n.max((system.rods.a.len() + system.springs.len() + system.pins.a.len()) as f64).max(1.0);
        // Nested dissection of a grid: 12 rows^1.5 operations, some 40 entries a node.
        let rows = 2.0 * n;
        let primal = if tree { [0.0; 2] } else { [FACTOR * 12.0 * rows * rows.sqrt(), SOLVE * 40.0 * n] };
        // A net of rods has nearly as many rows as there are coordinates.
        let share = (system.rhs.len() as f64 / rows).min(1.5);
        let dual = if tree { [0.0; 2] } else { primal.map(|work| work * share) };
        let extra = system.springs.len() > 0 || system.rods.a.len() >= n as usize;
        Work { links, dual, primal, free: system.unconstrained(), extra }
    }

    /// Work of so many steps, with so many solves where the method iterates [ns].
    pub fn of(&self, integrator: Integrator, steps: f64, order: f64, solves: f64) -> f64 {
        let Work { links, dual: [factor, solve], primal: [primal, substitute], free, extra } = *self;
        let tree = primal == 0.0;
        // The midpoint rule's steps, of two iterations.
        let pairs = 0.4 * steps + 0.3 * solves;
        match integrator {
            Integrator::Rattle if free => 300.0 + 40.0 * steps + links * (10.0 + 13.0 * steps),
            Integrator::Rattle => {
                350.0 + 110.0 * steps + links * (62.0 + 20.0 * steps) + steps * (factor + 3.0 * solve)
            }
            Integrator::EnergyMomentum if tree && !extra => 130.0 + links * (15.0 + 65.0 * pairs),
            Integrator::EnergyMomentum if tree => 400.0 + 150.0 * pairs + links * (15.0 + 95.0 * pairs),
            Integrator::EnergyMomentum => links * (20.0 + 70.0 * pairs) + pairs * (primal + 2.0 * substitute),
            Integrator::RungeKutta4 => {
                400.0 + 45.0 * links + steps * (350.0 + 48.0 * links + 4.0 * factor + 6.0 * solve)
            }
            Integrator::Nystrom4 => 300.0 + links * (10.0 + 60.0 * steps),
            Integrator::Nystrom6 => 300.0 + links * (10.0 + 105.0 * steps),
            Integrator::Radau3 => {
                500.0
                    + 300.0 * steps
                    + links * (170.0 * steps + 45.0 * solves)
                    + steps * (8.0 * primal + factor)
                    + 8.0 * solves * substitute
            }
            Integrator::Radau5 => {
                500.0
                    + 450.0 * steps
                    + links * (330.0 * steps + 85.0 * solves)
                    + steps * (12.0 * primal + factor)
                    + 12.0 * solves * substitute
            }
            _ => {
                let term = 60.0 + (10.0 + 0.6 * order) * order;
                400.0 + steps * (500.0 + links * term + factor + order * solve)
            }
        }
    }

    /// Work that an integrator has done; without what it took back, where it begins the next time with what was found.
    pub fn done(&self, integrator: Integrator, outcome: &Outcome) -> f64 {
        let steps = f64::from(if outcome.next > 0 { outcome.steps } else { outcome.steps + outcome.retries });
        self.of(integrator, steps, f64::from(outcome.order), f64::from(outcome.solves))
    }

    /// Steps of a method of fixed order that so much work [ns] is enough for, at least one.
    pub fn steps(&self, integrator: Integrator, work: f64) -> f64 {
        let none = self.of(integrator, 0.0, 0.0, 0.0);
        let one = self.of(integrator, 1.0, 0.0, usual_solves(integrator));
        libm::floor((work - none) / (one - none)).max(1.0)
    }

    /// Links, for sharing out what a step may cost.
    pub fn links(&self) -> f64 {
        self.links
    }
}

/// Newton iterations of a step, as a rule.
fn usual_solves(integrator: Integrator) -> f64 {
    match integrator {
        Integrator::EnergyMomentum => 2.0,
        Integrator::Radau3 | Integrator::Radau5 => 3.0,
        _ => 0.0,
    }
}
