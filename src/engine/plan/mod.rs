//! What a world needs from a step: which stages, which springs are forces and which are rows, what carries which
//! island. Derived from the world and the method, rebuilt only when one of them changed. Data: its words are in
//! `sentence.rs`.

mod derive;
mod sentence;
mod tolerance;

use super::constraint::form::Joint;
use super::id::Id;
pub use super::island::partition::Group;
use super::world::Revision;
use super::{Integrator, LinearSolver, Method, World};

/// The decisions for one world under one method.
#[derive(Debug, Default)]
pub struct Plan {
    /// Revision of the world and method that this was derived from; `None` before the first.
    made_for: Option<(Revision, Method)>,
    /// Names this derivation.
    version: Revision,
    /// Some body turns: rotations are loaded and contacts have arms.
    pub spin: bool,
    /// Something can touch something: there is a broad phase, a narrow phase, a contact memory.
    pub contacts: bool,
    /// Some contact can bounce: there is an impact stage.
    pub restitution: bool,
    /// Some spring that is a force has a damper, so forces depend on velocities.
    pub dashpots: bool,
    /// Some joint for the solver has an end off the centre of a body that turns.
    pub(crate) arms: bool,
    /// Springs that the integrator resolves.
    pub(crate) springs: Vec<Joint>,
    /// Constraints for the solver.
    pub(crate) joints: Vec<Joint>,
    /// Scalar rows of `joints`.
    pub rows: usize,
    /// Pairs of bodies joined by a constraint, which never touch each other: ordered, smaller index first.
    pub(crate) joined: Vec<(u32, u32)>,
    /// Islands that nothing can touch, where the method takes them whole.
    pub islands: Vec<IslandPlan>,
    /// Free bodies that can touch, carried from event to event.
    pub few: Option<FewPlan>,
    /// Whether anything is left for the substep loop.
    pub rest: bool,
    /// Whether forces move any of it; kinematic bodies go their way exactly.
    pub rest_is_pushed: bool,
    /// By body: carried by an island.
    pub(crate) in_island: Vec<bool>,
    /// Integrator of the rest.
    pub(crate) integrator: Integrator,
    /// Islands left to the substep loop because they could not be carried, by index among all.
    without: Vec<usize>,
    /// The disc that the mouse holds off its centre, and so turns.
    turned: Option<Id>,
}

/// How one island is carried.
#[derive(Clone, Debug, PartialEq)]
pub struct IslandPlan {
    /// Its bodies and constraints.
    pub group: Group,
    /// What carries it.
    pub carrier: Carrier,
    /// Some body collides: in steps in which something is near the island goes through the substeps.
    pub guarded: bool,
    /// There are ropes.
    pub ropes: bool,
    /// There is nothing but springs without dampers.
    pub springs: bool,
    /// Anchors that turn with a disc; with none the angles are not among the unknowns.
    pub turning: usize,
    /// Something that turns is damped.
    pub damped: bool,
    /// What solves its rows, and in how many sweeps at most.
    pub linear: (LinearSolver, u32),
    /// Wanted error, in parts of the island's size.
    pub accuracy: f64,
    /// Error that a series may make in a step, in parts of it.
    pub series_tolerance: f64,
    /// Steps within a step of the world, where the integrator does not find them itself.
    pub steps: Option<u32>,
}

/// Free bodies that can touch walls and each other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FewPlan {
    /// Dense indices, ascending.
    pub bodies: Vec<u32>,
    /// Error allowed in a step where motion is not in closed form, in parts of the smallest radius.
    pub tolerance: f64,
}

/// What carries an island.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carrier {
    /// The integrator that a user chose, in so many substeps.
    ByHand(Integrator),
    /// The cheapest one that keeps the accuracy, found while running.
    Cheapest,
}

impl Plan {
    /// Whether the plan still holds for this world and method.
    pub(crate) fn fits(&self, world: &World, method: &Method) -> bool {
        self.turned == turned_by_mouse(world)
            && self.made_for.is_some_and(|(revision, made_for)| revision.same(world.revision) && made_for == *method)
    }

    /// Makes this the plan in which the islands `without` (indices in the plan with all) go through the substep loop.
    pub(crate) fn leave_out(&mut self, world: &World, method: &Method, without: &[usize]) {
        if self.without != without || !self.fits(world, method) {
            self.without.clear();
            self.without.extend_from_slice(without);
            self.derive(world, method);
        }
    }

    /// The name of this derivation, for who keeps what follows from it.
    pub fn version(&self) -> Revision {
        self.version
    }

    /// Derives everything anew. O(bodies + constraints · log constraints).
    pub(crate) fn derive(&mut self, world: &World, method: &Method) {
        self.made_for = Some((world.revision, *method));
        self.turned = turned_by_mouse(world);
        self.find_contacts(world);
        self.find_islands(world, method);
        self.spin = (0..world.bodies.len()).any(|i| !self.in_island[i] && world.bodies.spin(i).is_some());
        self.divide_constraints(world, method.substep_seconds());
        self.version = Revision::default();
    }
}

/// The disc that the mouse turns.
fn turned_by_mouse(world: &World) -> Option<Id> {
    world.turning_grip().map(|grip| grip.body)
}
