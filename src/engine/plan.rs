//! What a world needs from a step: which stages, which springs are forces and which are rows.
//! Derived from the world and the method, shown to the user, rebuilt only when one of them changed.

use super::body::Motion;
use super::constraint::Kind;
use super::constraint::WORLD;
use super::constraint::form::{Form, Joint};
use super::id::Id;
use super::impact::MOST_TOGETHER;
use super::integrate::pace::Pace;
use super::island::partition::{Group, partition};
use super::state::State;
use super::world::Revision;
use super::{Integrator, LinearSolver, Method, World};
use glam::DVec2;
use std::fmt::Write;

/// A spring is integrated as a force while (h ω)² stays below this; explicit methods lose stability at 4 (semi-implicit
/// Euler, Verlet), and a quarter of it keeps their error and the effect of neighbouring springs moderate.
const FORCE_LIMIT: f64 = 1.0;
/// A damper is integrated as a force while h·c/m stays below this; explicit methods lose stability at 2.
const DAMPER_LIMIT: f64 = 0.5;
/// Local error of a step over the wanted accuracy: errors grow as they are carried on.
const LOCAL: f64 = 0.03;
/// The same for series, whose estimate is held to it over all steps of a frame together.
const LOCAL_SERIES: f64 = 0.1;
/// The same where nothing but springs acts: what swings for long loses energy with every step of a series (at 0.1 a mass that swings 110
/// times a second has lost 3e-6 of it after ten seconds at 1e-6).
const LOCAL_SWINGING: f64 = 0.005;
/// The same where anchors turn: at 0.15 chains of discs miss the bounds of `tests/turning`.
const LOCAL_TURNING: f64 = 0.08;
/// The same for Nyström's methods, whose estimate is a bound.
const LOCAL_NYSTROM: f64 = 0.12;
/// The same for Runge and Kutta's.
const LOCAL_KUTTA: f64 = 0.02;
/// The same for methods of order 2, whose errors add up more evenly; where anchors turn, RATTLE's estimate leaves out how errors of
/// the velocity are carried on.
const LOCAL_SECOND: f64 = 0.006;
const LOCAL_SECOND_TURNING: f64 = 0.014;

/// Walls with which free bodies are carried from event to event: each is looked at for each body.
const MOST_WALLS: usize = 512;

/// Loosest accuracy of what free bodies are carried with from event to event, and of series and Nyström's methods.
const LOOSEST_LOCAL: f64 = 1e-5;
const LOOSEST_SERIES: f64 = 1e-3;
/// The same of methods of order 2: coarser than this one step mostly does for a frame, and errors depend on which frames get a second one.
const LOOSEST_SECOND: f64 = 1e-2;

/// The decisions for one world under one method.
#[derive(Debug, Default)]
pub struct Plan {
    /// Revision of the world and method that this was derived from; `None` before the first.
    made_for: Option<(Revision, Method)>,
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
    pub(crate) rows: usize,
    /// Pairs of bodies joined by a constraint, which never touch each other: ordered, smaller index first.
    pub(crate) joined: Vec<(u32, u32)>,
    /// Islands that nothing can touch, where the method takes them whole.
    pub(crate) islands: Vec<IslandPlan>,
    /// Free bodies that can touch, carried from event to event.
    pub(crate) few: Option<FewPlan>,
    /// Whether anything is left for the substep loop.
    pub(crate) rest: bool,
    /// By body: carried by an island.
    pub(crate) in_island: Vec<bool>,
    /// Integrator of the rest.
    pub(crate) integrator: Integrator,
    /// Islands left to the substep loop because they could not be carried, by index among all.
    without: Vec<usize>,
    /// The disc that the mouse holds off its centre, and so turns.
    turned: Option<Id>,
    sentence: String,
}

/// How one island is carried.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct IslandPlan {
    pub group: Group,
    pub carrier: Carrier,
    /// Some body collides: in steps in which something is near the island goes through the substeps.
    pub guarded: bool,
    /// There are ropes; there is nothing but springs without dampers.
    pub ropes: bool,
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
pub(crate) struct FewPlan {
    /// Dense indices, ascending.
    pub bodies: Vec<u32>,
    /// Error allowed in a step where motion is not in closed form, in parts of the smallest radius.
    pub tolerance: f64,
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

    /// Derives everything anew. O(bodies + constraints · log constraints).
    pub(crate) fn derive(&mut self, world: &World, method: &Method) {
        self.made_for = Some((world.revision, *method));
        self.turned = turned_by_mouse(world);
        self.find_contacts(world);
        self.find_islands(world, method);
        self.spin = (0..world.bodies.len()).any(|i| !self.in_island[i] && world.bodies.spin(i).is_some());
        self.divide_constraints(world, method.substep_seconds());
        self.sentence = self.describe(world, method);
    }

    /// What was decided and why, in one sentence for the user.
    pub fn sentence(&self) -> &str {
        &self.sentence
    }

    /// Gives what nothing can touch to integrators that carry islands whole.
    fn find_islands(&mut self, world: &World, method: &Method) {
        self.islands.clear();
        self.few = None;
        self.in_island.clear();
        self.in_island.resize(world.bodies.len(), false);
        self.integrator = method.integrator;
        self.rest = true;
        if !method.automatic && !method.integrator.is_direct() {
            return;
        }
        if method.integrator.is_direct() {
            self.integrator = Integrator::OF_CONTACTS;
        }
        let mut groups = partition(world);
        let few = groups.pop_if(|group| method.automatic && self.is_few(world, group));
        let smooth: Vec<Group> = groups.into_iter().filter(|group| self.smooth(world, group)).collect();
        let few = few.filter(|_| self.without.binary_search(&smooth.len()).is_err());
        for (index, group) in smooth.into_iter().enumerate() {
            if self.without.binary_search(&index).is_err() {
                group.bodies.iter().for_each(|body| self.in_island[*body as usize] = true);
                let guarded = group.bodies.iter().any(|body| self.touches(world, *body));
                let turning = self.turning_anchors(world, &group);
                self.islands.push(IslandPlan { guarded, ..IslandPlan::of(world, method, group, turning) });
            }
        }
        if let Some(free) = few {
            self.carry_few(world, method, free);
        }
        let bodies = &world.bodies;
        self.rest = (0..bodies.len()).any(|i| !self.in_island[i] && bodies.motion[i] != Motion::Static);
    }

    /// Whether a group is of free bodies that can touch.
    fn is_few(&self, world: &World, group: &Group) -> bool {
        group.constraints.is_empty()
            && group.bodies.iter().any(|body| self.touches(world, *body))
            && world.walls.len() <= MOST_WALLS
    }

    /// Gives free bodies to the stage that carries them from event to event.
    fn carry_few(&mut self, world: &World, method: &Method, group: Group) {
        group.bodies.iter().for_each(|body| self.in_island[*body as usize] = true);
        let tolerance = LOCAL * method.accuracy.min(LOOSEST_LOCAL);
        self.few = Some(FewPlan { bodies: group.bodies, tolerance });
        // Whether anything that is left can be pushed by what it touches.
        let left = |body: u32| !self.in_island[body as usize] && world.bodies.inverse_mass[body as usize] > 0.0;
        let contacts = (0..world.bodies.len() as u32).any(|body| left(body) && self.touches(world, body));
        self.restitution &= contacts;
        self.contacts = contacts;
    }

    /// Whether a body can touch anything.
    fn touches(&self, world: &World, body: u32) -> bool {
        self.contacts && world.bodies.collides[body as usize] && world.bodies.radius[body as usize] > 0.0
    }

    /// Whether an island moves smoothly as long as nothing touches it. Free bodies that can touch are a pile, a stack or balls in
    /// a box: contacts are what their scene is about.
    fn smooth(&self, world: &World, group: &Group) -> bool {
        !group.constraints.is_empty() || !group.bodies.iter().any(|body| self.touches(world, *body))
    }

    /// Ends of constraints off the centre of a body, and the mouse's hold if it is one: what turns an island's discs.
    fn turning_anchors(&self, world: &World, group: &Group) -> usize {
        let (bodies, c) = (&world.bodies, &world.constraints);
        let turns = |body: u32, at: DVec2| usize::from(body != WORLD && at != DVec2::ZERO);
        let ends = |i: &u32| {
            let i = *i as usize;
            turns(c.a[i], c.at_a[i]) + turns(c.b[i], c.at_b[i])
        };
        let held = group.bodies.iter().any(|body| self.turned == Some(bodies.id[*body as usize]));
        group.constraints.iter().map(ends).sum::<usize>() + usize::from(held)
    }

    /// Springs become forces where the substep `h` resolves them, rows where it does not; the rest are rows.
    ///
    /// The bound on a spring's frequency is Gershgorin's on M⁻¹K, with the stiffness of all springs at both ends.
    fn divide_constraints(&mut self, world: &World, h: f64) {
        let (bodies, constraints) = (&world.bodies, &world.constraints);
        let mut load = vec![(0.0, 0.0); bodies.len() + 1];
        let all: Vec<Joint> = (0..constraints.len())
            .map(|i| Joint {
                index: i as u32,
                a: State::index(constraints.a[i], bodies.len()),
                b: State::index(constraints.b[i], bodies.len()),
                at_a: constraints.at_a[i],
                at_b: constraints.at_b[i],
                form: Form::of(&constraints.kind[i], world.tuning.stiffness),
            })
            .filter(|joint: &Joint| {
                let carried = |end: u32| self.in_island.get(end as usize).is_some_and(|carried| *carried);
                !carried(joint.a) && !carried(joint.b)
            })
            .collect();
        for joint in all.iter().filter(|joint| joint.form.stiffness.is_finite()) {
            for (end, at) in [(joint.a as usize, joint.at_a), (joint.b as usize, joint.at_b)] {
                let w = bodies.inverse_mass.get(end).copied().unwrap_or(0.0) * self.leverage(world, end, at);
                load[end].0 += w * joint.form.stiffness;
                load[end].1 += w * joint.form.damping;
            }
        }
        let resolved = |joint: &Joint| {
            let (a, b) = (load[joint.a as usize], load[joint.b as usize]);
            joint.form.stiffness.is_finite() && h * h * (a.0 + b.0) <= FORCE_LIMIT && h * (a.1 + b.1) <= DAMPER_LIMIT
        };
        let acts = |joint: &Joint| joint.form.stiffness > 0.0 || joint.form.damping > 0.0;
        self.springs = all.iter().filter(|joint| resolved(joint) && acts(joint)).copied().collect();
        self.joints = all.iter().filter(|joint| !resolved(joint) && can_act(joint, world)).copied().collect();
        self.rows = self.joints.iter().map(|joint| joint.form.rows()).sum();
        let turns = |end: u32, at: DVec2| (end as usize) < bodies.len() && at != DVec2::ZERO;
        self.arms = self.joints.iter().any(|joint| turns(joint.a, joint.at_a) || turns(joint.b, joint.at_b));
        self.dashpots = self.springs.iter().any(|joint| joint.form.damping > 0.0);
    }

    /// Factor by which an anchor of a disc is easier to move than its centre: 1 + m |at|²/I with I = ½ m r², and at least that of an anchor at the rim.
    fn leverage(&self, world: &World, body: usize, at: DVec2) -> f64 {
        if body < world.bodies.len() && world.bodies.spin(body).is_some() {
            let arm = at.length() / world.bodies.radius[body];
            1.0 + 2.0 * (arm * arm).max(1.0)
        } else {
            1.0
        }
    }

    fn find_contacts(&mut self, world: &World) {
        let bodies = &world.bodies;
        let can_touch = |i: &usize| bodies.collides[*i] && bodies.radius[*i] > 0.0;
        let touching = (0..bodies.len()).filter(can_touch).count();
        let movable = (0..bodies.len()).filter(can_touch).any(|i| bodies.inverse_mass[i] > 0.0);
        self.contacts = movable && (touching >= 2 || !world.walls.is_empty());
        self.restitution = self.contacts
            && match world.tuning.restitution {
                Some(restitution) => restitution > 0.0,
                None => {
                    (0..bodies.len()).filter(can_touch).any(|i| bodies.restitution[i] > 0.0)
                        || world.walls.iter().any(|wall| wall.restitution > 0.0)
                }
            };
        self.joined.clear();
        if self.contacts {
            let constraints = &world.constraints;
            let pairs = constraints.a.iter().zip(&constraints.b).map(|(a, b)| (*a.min(b), *a.max(b)));
            self.joined.extend(pairs.filter(|(_, larger)| (*larger as usize) < bodies.len()));
            self.joined.sort_unstable();
            self.joined.dedup();
        }
    }

    /// What carries how many islands.
    fn describe_islands(&self, sentence: &mut String, method: &Method) {
        let mut first = true;
        let mut item = |count: usize, how: std::fmt::Arguments| {
            if count > 0 {
                let _ = write!(sentence, "{}{} {how}", if first { "" } else { ", " }, plural(count, "island"));
                first = false;
            }
        };
        let count = |which: &dyn Fn(&IslandPlan) -> bool| self.islands.iter().filter(|island| which(island)).count();
        let cheapest = |island: &IslandPlan| island.carrier == Carrier::Cheapest;
        item(
            count(&|island| cheapest(island) && island.turning == 0),
            format_args!("by the cheapest method within {:.0e}", method.accuracy),
        );
        let rattle = |island: &IslandPlan| {
            island.turning > 0
                && !island.damped
                && !island.ropes
                && island.accuracy >= crate::engine::island::TURNING_SECOND_ORDER
        };
        item(
            count(&|island| cheapest(island) && rattle(island)),
            format_args!("by RATTLE within {:.0e}, Taylor series where it is stiff", method.accuracy),
        );
        item(
            count(&|island| cheapest(island) && island.turning > 0 && !rattle(island)),
            format_args!("by Taylor series to {:.0e}", method.accuracy),
        );
        for integrator in Integrator::ALL {
            let count = count(&|island| island.carrier == Carrier::ByHand(integrator));
            if integrator == Integrator::Taylor {
                item(count, format_args!("by Taylor series to {:.0e}", method.accuracy));
            } else {
                let steps = plural(method.substeps as usize, "substep");
                item(count, format_args!("by {}, {steps} a step", spoken(integrator)));
            }
        }
        sentence.push_str(&self.describe_linear(method));
        if self.islands.iter().any(|island| island.guarded) {
            sentence.push_str(" while nothing is near");
        }
        let turning: usize = self.islands.iter().map(|island| island.turning).sum();
        if turning > 0 {
            let _ = write!(sentence, ", {} off a centre", plural(turning, "anchor"));
        }
    }

    /// What solves the islands' rows.
    fn describe_linear(&self, method: &Method) -> String {
        // The midpoint rule has a Newton matrix of its own.
        let takes = |island: &&IslandPlan| island.carrier != Carrier::ByHand(Integrator::EnergyMomentum);
        let with = |linear| self.islands.iter().filter(takes).filter(move |island| island.linear.0 == linear).count();
        if method.linear == LinearSolver::SparseLdl || with(method.linear) == 0 && with(LinearSolver::SparseLdl) == 0 {
            return ", solved directly".to_owned();
        }
        let mut text = format!(", solved by {}", method.linear.name());
        if method.linear.is_iterative() {
            text += &format!(" in at most {}", plural(method.iterations as usize, "sweep"));
        }
        if with(LinearSolver::SparseLdl) > 0 {
            let islands = plural(with(LinearSolver::SparseLdl), "island");
            text += &format!(" ({islands} of more than {} rows by sparse LDL)", LinearSolver::MOST_DENSE);
        }
        text
    }

    /// How free bodies are carried, and which of them not.
    fn describe_few(&self, world: &World, few: &FewPlan, sentence: &mut String) {
        let free = few.bodies.len();
        let bodies = if free == 1 { "1 free body".to_string() } else { format!("{free} free bodies") };
        let _ = write!(sentence, "; {bodies} from impact to impact in closed form, contact forces solved directly");
        let moves_otherwise = |body: u32| {
            let i = body as usize;
            let others = few.bodies.binary_search(&body).is_err() && world.bodies.motion[i] != Motion::Static;
            others && world.bodies.collides[i] && world.bodies.radius[i] > 0.0
        };
        if free > MOST_TOGETHER {
            let _ = write!(sentence, ", heaps of more than {MOST_TOGETHER} through the substeps");
        }
        if (0..world.bodies.len() as u32).any(moves_otherwise) {
            sentence.push_str(", those near what moves otherwise through the substeps");
        }
    }

    fn describe(&self, world: &World, method: &Method) -> String {
        let mut parts = Vec::new();
        let counts = [
            ("rod", count(world, |kind| matches!(kind, Kind::Rod { .. }))),
            ("rope", count(world, |kind| matches!(kind, Kind::Rope { .. }))),
            ("pin", count(world, |kind| matches!(kind, Kind::Pin))),
        ];
        for (name, number) in counts.into_iter().filter(|(_, number)| *number > 0) {
            parts.push(plural(number, name));
        }
        let stiff = self.joints.iter().filter(|joint| joint.form.stiffness.is_finite()).count();
        if stiff > 0 {
            let as_rows = if stiff == 1 { "a row" } else { "rows" };
            let dies = if stiff == 1 { "its vibration dies away" } else { "their vibration dies away" };
            parts.push(format!("{} as {as_rows} (too stiff for the substep: {dies})", plural(stiff, "spring")));
        }
        if !self.springs.is_empty() {
            let as_forces = if self.springs.len() == 1 { "a force" } else { "forces" };
            parts.push(format!("{} as {as_forces}", plural(self.springs.len(), "spring")));
        }
        if parts.is_empty() {
            parts.push("No constraints".to_string());
        }
        let mut sentence = parts.join(", ");
        if !self.islands.is_empty() {
            sentence.push_str("; ");
            self.describe_islands(&mut sentence, method);
        }
        if let Some(few) = &self.few {
            self.describe_few(world, few, &mut sentence);
        }
        if (method.automatic || method.integrator.is_direct()) && self.rest {
            let bodies = (0..world.bodies.len()).filter(|i| !self.in_island[*i] && world.bodies.inverse_mass[*i] > 0.0);
            let _ = match bodies.count() {
                0 => Ok(()),
                1 => sentence.write_str("; 1 body can touch and goes through the substeps"),
                n => write!(sentence, "; {n} bodies can touch and go through the substeps"),
            };
        }
        let turns = self.spin || self.islands.iter().any(|island| island.turning > 0);
        sentence.push_str(if turns { "; rotations" } else { "; particles only" });
        sentence.push_str(match (self.contacts, self.restitution) {
            _ if self.few.is_some() => ", the next impact is the first root of a gap",
            (false, _) => ", nothing can touch: no broad phase",
            (true, false) => ", contacts from a sorted grid",
            (true, true) => ", contacts from a sorted grid, impacts with restitution",
        });
        let solver = match (self.rows, self.contacts) {
            (0, false) => "nothing to solve".to_string(),
            _ => format!("{}, {}", method.solver.name(), plural(self.rows, "row")),
        };
        if self.rest {
            let _ = write!(sentence, "; {solver}; {}.", self.integrator.name());
        } else {
            sentence.push('.');
        }
        sentence
    }
}

/// What carries an island.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Carrier {
    /// The integrator that a user chose, in so many substeps.
    ByHand(Integrator),
    /// The cheapest one that keeps the accuracy, found while running.
    Cheapest,
}

impl IslandPlan {
    /// How an island is carried. By hand: ropes that tighten and slacken need events, which series and Radau's methods have; where anchors
    /// turn, series and RATTLE take them. What Nyström's methods do not take goes by series too.
    fn of(world: &World, method: &Method, group: Group, turning: usize) -> IslandPlan {
        let kinds = || group.constraints.iter().map(|i| &world.constraints.kind[*i as usize]);
        let ropes = kinds().any(|kind| matches!(kind, Kind::Rope { .. }));
        let plain_spring = |kind: &Kind| matches!(kind, Kind::Spring { damping, .. } if *damping == 0.0);
        let springs = world.drag == 0.0 && kinds().all(plain_spring);
        let damper = |kind: &Kind| matches!(kind, Kind::Spring { damping, .. } if *damping > 0.0);
        // Where anchors turn, only the series takes what depends on velocities.
        let damped = turning > 0 && (world.drag > 0.0 || kinds().any(damper));
        let carrier = match method.integrator {
            _ if method.automatic => Carrier::Cheapest,
            Integrator::Rattle if turning > 0 && !damped && !ropes => Carrier::ByHand(Integrator::Rattle),
            _ if turning > 0 => Carrier::ByHand(Integrator::Taylor),
            by_hand @ (Integrator::Radau3 | Integrator::Radau5) => Carrier::ByHand(by_hand),
            _ if ropes => Carrier::ByHand(Integrator::Taylor),
            Integrator::Nystrom4 | Integrator::Nystrom6 if !springs => Carrier::ByHand(Integrator::Taylor),
            by_hand => Carrier::ByHand(by_hand),
        };
        let steps = (!method.automatic).then_some(method.substeps);
        let local = match turning {
            0 if springs => LOCAL_SWINGING,
            0 => LOCAL_SERIES,
            _ => LOCAL_TURNING,
        };
        let series_tolerance = local * method.accuracy.min(LOOSEST_SERIES);
        let rows: usize = kinds().map(|kind| if matches!(kind, Kind::Pin) { 2 } else { 1 }).sum();
        let fits = !method.linear.is_dense() || rows <= LinearSolver::MOST_DENSE;
        let linear = (if fits { method.linear } else { LinearSolver::SparseLdl }, method.iterations);
        let accuracy = method.accuracy;
        IslandPlan {
            group,
            carrier,
            guarded: false,
            ropes,
            springs,
            turning,
            damped,
            linear,
            accuracy,
            series_tolerance,
            steps,
        }
    }

    /// What methods of order 2 are asked for on an island of this size [m].
    pub fn pace(&self, length: f64) -> Pace {
        let local = if self.turning > 0 { LOCAL_SECOND_TURNING } else { LOCAL_SECOND };
        self.steps.map_or(Pace::Within(local * self.accuracy.min(LOOSEST_SECOND) * length), Pace::Steps)
    }

    /// The same for Nyström's methods.
    pub fn fine_pace(&self, length: f64) -> Pace {
        self.steps.map_or(Pace::Within(LOCAL_NYSTROM * self.accuracy.min(LOOSEST_SERIES) * length), Pace::Steps)
    }

    /// The same for Runge and Kutta's.
    pub fn kutta_pace(&self, length: f64) -> Pace {
        self.steps.map_or(Pace::Within(LOCAL_KUTTA * self.accuracy * length), Pace::Steps)
    }

    /// The same for Radau's, which know how local errors add up.
    pub fn whole_pace(&self, length: f64) -> Pace {
        self.steps.map_or(Pace::Within(self.accuracy * length), Pace::Steps)
    }

    /// About the order that a series takes.
    pub fn series_order(&self) -> f64 {
        1.0 - 0.5 * libm::log(self.series_tolerance)
    }
}

/// Whether a row can move anything: something dynamic hangs on it, and it is not an empty spring.
fn can_act(joint: &Joint, world: &World) -> bool {
    let movable = |end: u32| world.bodies.inverse_mass.get(end as usize).is_some_and(|w| *w > 0.0);
    (movable(joint.a) || movable(joint.b)) && (joint.form.stiffness > 0.0 || joint.form.damping > 0.0)
}

/// The name of an integrator of islands within a sentence.
fn spoken(integrator: Integrator) -> &'static str {
    match integrator {
        Integrator::Taylor => "Taylor series",
        Integrator::EnergyMomentum => "the energy–momentum midpoint rule",
        Integrator::RungeKutta4 => "Runge–Kutta of order 4",
        Integrator::Nystrom4 => "symplectic Nyström of order 4",
        Integrator::Nystrom6 => "symplectic Nyström of order 6",
        Integrator::Radau3 => "Radau's method of 3 stages",
        Integrator::Radau5 => "Radau's method of 5 stages",
        _ => integrator.name(),
    }
}

/// The disc that the mouse turns.
fn turned_by_mouse(world: &World) -> Option<Id> {
    world.turning_grip().map(|grip| grip.body)
}

fn count(world: &World, which: impl Fn(&Kind) -> bool) -> usize {
    world.constraints.kind.iter().filter(|kind| which(kind)).count()
}

fn plural(number: usize, name: &str) -> String {
    if number == 1 { format!("1 {name}") } else { format!("{number} {name}s") }
}
