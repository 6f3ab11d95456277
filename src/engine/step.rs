//! A step, stage by stage: forces, prediction, detection, assembly, solve, update.

use super::collide::sweep::drift;
use super::collide::{BroadPhase, WallGuard, find_contacts};
use super::constraint::grip::lead_static;
use super::error::{LARGEST_COORDINATE, LARGEST_SPEED};
use super::integrate::{self, Forces, Scene, add_spring_forces};
use super::island::Islands;
use super::plan::Plan;
use super::report::{Divergence, Stage, StepReport};
use super::solve::arms::Arms;
use super::solve::feedback::feed_back;
use super::solve::impact::Impacts;
use super::solve::overlap::Planes;
use super::solve::pgs::{Pgs, Task};
use super::solve::projection::Projection;
use super::state::State;
use super::world::Contact;
use super::{EngineError, Integrator, Method, Solver, World};
use glam::DVec2;
use std::mem::swap;

/// Arms of a joint longer than so many radii of the disc are named as what made a run diverge.
const OUTSIDE: f64 = 3.0;

/// Carries out a plan, step after step, with its own scratch memory: a warm step allocates nothing.
///
/// The world is changed only when a whole step went well. What the stepper remembers from step to step saves time but
/// does not touch the result: a fresh stepper continues a world with the same bits.
#[derive(Debug, Default)]
pub struct Stepper {
    method: Method,
    plan: Plan,
    /// The plan for steps in which some islands are given up.
    fallback: Plan,
    /// The islands given up in the last step.
    given_up: Vec<usize>,
    clock: Option<fn() -> u64>,
    state: State,
    forces: Forces,
    broad: BroadPhase,
    contacts: Vec<Contact>,
    old_contacts: Vec<Contact>,
    impacts: Impacts,
    islands: Islands,
    pgs: Pgs,
    projection: Projection,
    arms: Arms,
    /// Multipliers by constraint, and the grip's [N].
    force: Vec<DVec2>,
    grip_force: DVec2,
    guard: WallGuard,
    /// Positions before overlaps are parted.
    start: Vec<DVec2>,
    /// Positions and angles that the contacts' gaps belong to.
    planes_at: (Vec<DVec2>, Vec<f64>),
}

impl Stepper {
    /// A stepper for `method`.
    pub fn new(method: Method) -> Result<Stepper, EngineError> {
        method.validate()?;
        Ok(Stepper { method, ..Stepper::default() })
    }

    /// Hands in a clock (nanoseconds from any origin) with which the stages are timed.
    pub fn with_clock(self, clock: fn() -> u64) -> Stepper {
        Stepper { clock: Some(clock), ..self }
    }

    /// How the world is stepped.
    pub fn method(&self) -> &Method {
        &self.method
    }

    /// Changes the method; the plan follows with the next step.
    pub fn set_method(&mut self, method: Method) -> Result<(), EngineError> {
        method.validate()?;
        self.method = method;
        Ok(())
    }

    /// The plan for `world`, derived now if it is not the one at hand.
    pub fn plan(&mut self, world: &World) -> &Plan {
        if !self.plan.fits(world, &self.method) {
            self.plan.derive(world, &self.method);
            self.islands.build(world, &self.plan);
            self.broad.reset();
            self.guard.reset();
        }
        &self.plan
    }

    /// Steps the world once (1/hz seconds). If the run diverges the world is left as it was and the report says so.
    pub fn step(&mut self, world: &mut World) -> StepReport {
        let mut laps = Laps::start(self.clock);
        self.plan(world);
        let mut report = StepReport::default();
        self.islands.advance(world, &self.plan, self.method.step_seconds(), &mut report);
        let falls_back = !self.islands.given_up().is_empty();
        if falls_back {
            self.fallback.leave_out(world, &self.method, self.islands.given_up());
            self.islands.mark_carried(&mut self.fallback.in_island);
            swap(&mut self.plan, &mut self.fallback);
        }
        // Not `!=`: comparing memory that is not there, as empty lists do, takes longer than a small step.
        if !self.given_up.iter().eq(self.islands.given_up()) {
            self.given_up.clear();
            self.given_up.extend_from_slice(self.islands.given_up());
            self.broad.reset();
        }
        laps.end(Stage::Solve);
        if self.plan.rest {
            self.substeps(world, &mut report, &mut laps);
        }
        if report.divergence.is_none() {
            self.store(world);
        }
        laps.end(Stage::Update);
        self.fill_report(world, &laps, &mut report);
        if falls_back {
            swap(&mut self.plan, &mut self.fallback);
        }
        report
    }

    /// The substeps of all that is not carried by an island.
    fn substeps(&mut self, world: &World, report: &mut StepReport, laps: &mut Laps) {
        self.load(world);
        self.islands.forget_pulls(world, &mut self.force);
        report.substeps = if self.plan.rest_is_pushed { self.method.substeps } else { 0 };
        for substep in 0..self.method.substeps {
            if self.plan.spin {
                self.substep::<true>(world, report, laps);
            } else {
                self.substep::<false>(world, report, laps);
            }
            if let Some(divergence) = self.find_divergence(world, substep) {
                report.divergence = Some(divergence);
                break;
            }
        }
    }

    /// One substep, as in the textbook loop.
    fn substep<const SPIN: bool>(&mut self, world: &World, report: &mut StepReport, laps: &mut Laps) {
        let h = self.method.substep_seconds();
        let (integrator, solver) = (self.plan.integrator, self.method.solver);
        lead_static(world, &mut self.state, h);
        self.arms.steady(&self.plan.joints, &self.force, h, &mut self.state);
        // A projection acts on predicted positions, so its contacts are found before anything moves.
        let early = solver == Solver::Projection && integrate::drifts_first(integrator);
        if early {
            self.detect::<SPIN>(world, h, report);
            laps.end(Stage::Detect);
        }
        if solver == Solver::Pgs && integrate::drifts_first(integrator) && self.has_bullets(world, h) {
            self.detect::<SPIN>(world, h, report);
            self.pgs.contacts.iter().for_each(|row| row.stop(&mut self.state, h));
            laps.end(Stage::Detect);
        }
        if solver == Solver::Projection {
            self.projection.remember::<SPIN>(&self.plan.joints, &self.state);
        }
        let scene = Scene { world, plan: &self.plan, h };
        if integrate::evaluates_first(integrator) {
            self.forces.evaluate(&scene, &self.state);
        }
        laps.end(Stage::Forces);
        let remaining = integrate::begin(integrator, &scene, &mut self.state, &mut self.forces);
        if solver == Solver::Pgs && integrate::drifts_first(integrator) {
            self.keep_out_of_walls(world);
        }
        laps.end(Stage::Predict);
        if !early {
            self.detect::<SPIN>(world, h, report);
            laps.end(Stage::Detect);
        }
        let mut task = self.task(h);
        match solver {
            Solver::Pgs => self.solve_velocities::<SPIN>(world, &task, remaining, report, laps),
            Solver::Projection => self.solve_positions::<SPIN>(world, &task, remaining, report, laps),
        }
        if integrate::kicks_again(integrator) {
            integrate::kick_again(&Scene { world, plan: &self.plan, h }, &mut self.state, &mut self.forces);
            // A projection found moves, not impulses to start from.
            task.warm_start = solver == Solver::Pgs;
            self.pgs.reassemble::<SPIN>(world, &self.plan.joints, &self.state, &task);
            report.iterations += self.pgs.solve::<SPIN>(&mut self.state, &task);
            laps.end(Stage::Solve);
        }
        self.keep_multipliers(h);
        laps.end(Stage::Update);
    }

    /// Whether a body moves by more than its radius in a substep of `h` seconds. Before it drifts with a velocity that comes
    /// from outside of the last solve (an edit, a throw, an impact in many), what is ahead has to be looked at.
    fn has_bullets(&self, world: &World, h: f64) -> bool {
        let radius = &world.bodies.radius;
        self.plan.contacts && self.state.velocity.iter().zip(radius).any(|(v, r)| *r > 0.0 && v.length() * h > *r)
    }

    /// Contacts of the substep, and the impacts among them.
    fn detect<const SPIN: bool>(&mut self, world: &World, h: f64, report: &mut StepReport) {
        if !self.plan.contacts {
            return;
        }
        report.broad_phase_builds += u32::from(self.broad.update(world, &self.plan, &self.state, h));
        swap(&mut self.contacts, &mut self.old_contacts);
        let (old, new) = (&self.old_contacts, &mut self.contacts);
        report.candidates += find_contacts(world, &self.plan, &self.broad, &self.state, h, old, new);
        self.pgs.assemble_contacts::<SPIN>(world, &self.contacts, &self.state);
        self.start.clone_from(&self.state.position);
        Planes::part_overlaps(&mut self.pgs.contacts, &self.start, &mut self.state, self.method.baumgarte);
        if self.plan.restitution {
            let (integrator, solver) = (self.plan.integrator, self.method.solver);
            let only_short_shifts = solver == Solver::Pgs && integrate::drifts_first(integrator);
            report.impacts += self.impacts.resolve::<SPIN>(
                &mut self.pgs.contacts,
                &self.contacts,
                &mut self.state,
                (h, world.gravity),
                only_short_shifts,
            );
        }
        self.planes_at.0.clone_from(&self.state.position);
        self.planes_at.1.clone_from(&self.state.angle);
    }

    /// PGS: rows, sweeps, then the drift with the velocities found.
    fn solve_velocities<const SPIN: bool>(
        &mut self,
        world: &World,
        task: &Task,
        remaining: f64,
        report: &mut StepReport,
        laps: &mut Laps,
    ) {
        let multipliers = (&self.force[..], self.grip_force);
        self.pgs.assemble::<SPIN>(world, &self.plan.joints, &self.state, multipliers, &self.contacts, task);
        self.forget_multipliers();
        laps.end(Stage::Assemble);
        report.iterations += self.pgs.solve::<SPIN>(&mut self.state, task);
        self.pgs.contacts.iter().for_each(|row| row.guard(&mut self.state, task.h));
        report.residual = self.pgs.residual;
        laps.end(Stage::Solve);
        drift(&mut self.state, remaining);
        self.arms.exchange(&mut self.state);
        feed_back::<SPIN>(&self.plan.joints, self.method.baumgarte, &mut self.state);
        self.arms.exchange(&mut self.state);
        self.keep_out_of_walls(world);
        laps.end(Stage::Update);
    }

    /// Projection: the drift, then sweeps over the positions.
    fn solve_positions<const SPIN: bool>(
        &mut self,
        world: &World,
        task: &Task,
        remaining: f64,
        report: &mut StepReport,
        laps: &mut Laps,
    ) {
        self.pgs.solve_grip::<SPIN>(world, &mut self.state, task);
        self.forget_multipliers();
        laps.end(Stage::Assemble);
        drift(&mut self.state, remaining);
        laps.end(Stage::Update);
        let (position, angle) = &self.planes_at;
        let mut planes = Planes { rows: &mut self.pgs.contacts, position, angle };
        let (joints, state) = (&self.plan.joints, &mut self.state);
        report.iterations += self.projection.solve::<SPIN>(joints, &mut planes, state, task, &mut self.force);
        report.residual = self.projection.residual;
        self.keep_out_of_walls(world);
        laps.end(Stage::Solve);
    }

    /// The last resort against tunnelling, along the whole way since the last time.
    fn keep_out_of_walls(&mut self, world: &World) {
        if self.plan.contacts && !world.walls.is_empty() {
            self.guard.hold(world, &mut self.state);
        }
    }

    fn task(&self, h: f64) -> Task {
        let Method { iterations, warm_start, .. } = self.method;
        let share = if integrate::kicks_again(self.plan.integrator) { 0.5 } else { 1.0 };
        Task { h, iterations, warm_start, share }
    }

    fn forget_multipliers(&mut self) {
        self.force.fill(DVec2::ZERO);
        self.grip_force = DVec2::ZERO;
    }

    /// Turns the impulses found into forces, by constraint and by contact.
    fn keep_multipliers(&mut self, h: f64) {
        self.pgs.add_forces(&self.plan.joints, h, &mut self.force, &mut self.grip_force);
        add_spring_forces(&self.forces, &self.plan.springs, &mut self.force);
        for (contact, row) in self.contacts.iter_mut().zip(&self.pgs.contacts) {
            contact.normal_force = (row.normal_impulse + row.found[0]) / h;
            contact.tangent_force = (row.tangent_impulse + row.found[1]) / h;
        }
    }

    fn load(&mut self, world: &World) {
        self.state.load(world, self.plan.spin, &self.plan.in_island);
        self.arms.read(&self.plan.joints, self.plan.arms, &self.state);
        self.contacts.clone_from(&world.contacts);
        self.force.clone_from(&world.constraints.force);
        self.grip_force = world.grip.map_or(DVec2::ZERO, |grip| grip.force);
        if self.plan.contacts {
            self.guard.begin(&self.state);
        } else {
            self.contacts.clear();
            self.pgs.contacts.clear();
        }
    }

    fn store(&mut self, world: &mut World) {
        if self.plan.rest {
            self.state.store(world);
            world.contacts.clone_from(&self.contacts);
            world.constraints.force.copy_from_slice(&self.force);
            if let Some(grip) = &mut world.grip {
                grip.force = self.grip_force;
            }
        }
        if !self.plan.rest {
            world.contacts.clear();
        }
        world.constraints.carried.fill(false);
        self.islands.store(world, self.method.step_seconds());
        world.advance_clock(self.method.hz);
    }

    fn find_divergence(&self, world: &World, substep: u32) -> Option<Divergence> {
        let state = &self.state;
        let found = |i: usize, quantity, value| {
            Some(Divergence { body: world.bodies.id[i], quantity, value, substep, advice: self.advice(world) })
        };
        for i in 0..state.len() {
            let (far, speed) = (state.position[i].abs().max_element(), state.velocity[i].abs().max_element());
            // Written so that a NaN is found too: max_element may hide one, a sum does not.
            if !(far <= LARGEST_COORDINATE) || !state.position[i].is_finite() {
                return found(i, "position", state.position[i].length());
            }
            if !(speed <= LARGEST_SPEED) || !state.velocity[i].is_finite() {
                return found(i, "velocity", state.velocity[i].length());
            }
        }
        let wild = |value: &f64| !(value.abs() <= LARGEST_SPEED * LARGEST_COORDINATE);
        let turned = |values: &[f64]| values.iter().position(wild);
        if let Some(i) = turned(&state.angle) {
            return found(i, "angle", state.angle[i]);
        }
        turned(&state.omega).and_then(|i| found(i, "angular velocity", state.omega[i]))
    }

    /// The likely cause of a divergence in this scene, and what to try.
    fn advice(&self, world: &World) -> String {
        let masses = || world.bodies.mass.iter().zip(&world.bodies.inverse_mass).filter(|(_, w)| **w > 0.0);
        let (light, heavy) = masses().fold((f64::INFINITY, 0.0f64), |(l, h), (m, _)| (l.min(*m), h.max(*m)));
        let (outside, body) = self.longest_arm(world);
        if outside > OUTSIDE {
            format!(
                "A joint of body {} is {outside:.0} of its radii from its centre, so the least force turns it fast: \
                 try more substeps, an accuracy, a larger disc, or anchors within it.",
                world.bodies.id[body]
            )
        } else if self.method.integrator == Integrator::ExplicitEuler {
            "Explicit Euler gains energy at every step: try semi-implicit Euler or velocity Verlet.".to_string()
        } else if heavy > 100.0 * light && self.plan.rows > 0 {
            format!(
                "The masses differ {:.0} : 1 along the constraints: try more iterations or substeps.",
                heavy / light
            )
        } else {
            "The step is too large for what moves here: try more substeps or a higher rate.".to_string()
        }
    }

    /// The longest arm of a joint in radii of its disc, and whose it is.
    fn longest_arm(&self, world: &World) -> (f64, usize) {
        let ends = self.plan.joints.iter().flat_map(|joint| [(joint.a, joint.at_a), (joint.b, joint.at_b)]);
        let arms = ends.filter_map(|(body, at)| {
            let radius =
                world.bodies.radius.get(body as usize).filter(|_| world.bodies.inverse_mass[body as usize] > 0.0)?;
            Some((at.length() / radius, body as usize)).filter(|_| at != DVec2::ZERO)
        });
        arms.fold((0.0, 0), |longest, arm| if arm.0 > longest.0 { arm } else { longest })
    }

    fn fill_report(&self, world: &World, laps: &Laps, report: &mut StepReport) {
        report.tick = world.tick;
        report.bodies = world.bodies.len();
        report.constraints = world.constraints.len();
        report.rows = self.plan.rows + 2 * world.contacts.len();
        report.contacts = world.contacts.iter().filter(|contact| contact.normal_force > 0.0).count();
        report.stage_us = laps.stage_us;
        report.step_us = laps.total_us();
    }
}

/// Time by stage, from a clock that may not be there.
struct Laps {
    clock: Option<fn() -> u64>,
    started: u64,
    last: u64,
    stage_us: [f64; 6],
}

impl Laps {
    fn start(clock: Option<fn() -> u64>) -> Laps {
        let now = clock.map_or(0, |clock| clock());
        Laps { clock, started: now, last: now, stage_us: [0.0; 6] }
    }

    /// Counts the time since the last call for `stage`.
    fn end(&mut self, stage: Stage) {
        if let Some(clock) = self.clock {
            let now = clock();
            self.stage_us[stage as usize] += now.saturating_sub(self.last) as f64 / 1e3;
            self.last = now;
        }
    }

    fn total_us(&self) -> f64 {
        self.last.saturating_sub(self.started) as f64 / 1e3
    }
}
