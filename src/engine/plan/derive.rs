//! How a plan is derived: contacts first, then islands, then what is left for the substeps.

use super::tolerance::{few_tolerance, series_tolerance};
use super::{Carrier, FewPlan, IslandPlan, Plan};
use crate::engine::body::Motion;
use crate::engine::constraint::form::{Form, Joint};
use crate::engine::constraint::{Kind, WORLD};
use crate::engine::island::partition::{Group, partition};
use crate::engine::state::State;
use crate::engine::{Integrator, LinearSolver, Method, World};
use glam::DVec2;

/// A spring is integrated as a force while (h ω)² stays below this; explicit methods lose stability at 4 (semi-implicit
/// Euler, Verlet), and a quarter of it keeps their error and the effect of neighbouring springs moderate.
const FORCE_LIMIT: f64 = 1.0;
/// A damper is integrated as a force while h·c/m stays below this; explicit methods lose stability at 2.
const DAMPER_LIMIT: f64 = 0.5;
/// Walls with which free bodies are carried from event to event: each is looked at for each body.
const MOST_WALLS: usize = 512;

impl Plan {
    /// Gives what nothing can touch to integrators that carry islands whole.
    pub(super) fn find_islands(&mut self, world: &World, method: &Method) {
        self.islands.clear();
        self.few = None;
        self.in_island.clear();
        self.in_island.resize(world.bodies.len(), false);
        self.integrator = method.integrator;
        (self.rest, self.rest_is_pushed) = (true, true);
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
        self.rest_is_pushed = (0..bodies.len()).any(|i| !self.in_island[i] && bodies.inverse_mass[i] > 0.0);
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
        self.few = Some(FewPlan { bodies: group.bodies, tolerance: few_tolerance(method.accuracy) });
        // Whether anything that is left can be pushed by what it touches.
        let left = |body: u32| !self.in_island[body as usize] && world.bodies.inverse_mass[body as usize] > 0.0;
        let contacts = (0..world.bodies.len() as u32).any(|body| left(body) && self.touches(world, body));
        self.restitution &= contacts;
        self.contacts = contacts;
    }

    /// Whether a body can touch anything.
    fn touches(&self, world: &World, body: u32) -> bool {
        self.contacts && world.bodies.is_solid(body as usize)
    }

    /// Whether an island moves smoothly as long as nothing touches it. Free bodies that can touch are a pile, a stack
    /// or balls in a box: contacts are what their scene is about.
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
    pub(super) fn divide_constraints(&mut self, world: &World, h: f64) {
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

    /// Factor by which an anchor of a disc is easier to move than its centre: 1 + m |at|²/I, and at least that of an
    /// anchor at the rim.
    fn leverage(&self, world: &World, body: usize, at: DVec2) -> f64 {
        let inertia = if body < world.bodies.len() { world.bodies.inertia(body) } else { None };
        inertia.map_or(1.0, |inertia| {
            let arm = at.length().max(world.bodies.radius[body]);
            1.0 + world.bodies.mass[body] * arm * arm / inertia
        })
    }

    pub(super) fn find_contacts(&mut self, world: &World) {
        let bodies = &world.bodies;
        let can_touch = |i: &usize| bodies.is_solid(*i);
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
}

impl IslandPlan {
    /// How an island is carried. By hand: ropes that tighten and slacken need events, which series and Radau's
    /// methods have; where anchors turn, series and RATTLE take them. What Nyström's methods do not take goes by
    /// series too.
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
            series_tolerance: series_tolerance(accuracy, springs, turning > 0),
            steps,
        }
    }
}

/// Whether a row can move anything: something dynamic hangs on it, and it is not an empty spring.
fn can_act(joint: &Joint, world: &World) -> bool {
    let movable = |end: u32| world.bodies.inverse_mass.get(end as usize).is_some_and(|w| *w > 0.0);
    (movable(joint.a) || movable(joint.b)) && (joint.form.stiffness > 0.0 || joint.form.damping > 0.0)
}
