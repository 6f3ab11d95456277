//! A world as Rapier's, in either precision.

use super::{Run, cheapest};
use tautline::engine::{DVec2, Kind, Shape, World};

/// How Rapier is to step.
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    /// Steps in 1/60 s.
    pub steps: u32,
    /// Solver iterations of a step: Rapier's substeps.
    pub iterations: usize,
    /// Factor on the natural frequency of contacts.
    pub contact_stiffness: f64,
    /// Whether joints start from their last impulses and contacts are found anew in every step.
    pub careful: bool,
    pub rods: Rods,
}

/// What stands for a rod.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rods {
    /// A rope joint, which is the same while it is under tension.
    Ropes,
    /// A hinge at the upper end on a link that carries the mass at its lower end and turns with [`LINK_INERTIA`].
    Hinges,
}

/// Moment of inertia of a link about its mass, in parts of m L²: a pendulum's period is half of that too long.
const LINK_INERTIA: f64 = 1e-4;

/// What Rapier does by itself.
pub const DEFAULT: Setting =
    Setting { steps: 1, iterations: 4, contact_stiffness: 1.0, careful: false, rods: Rods::Ropes };

/// Sixteen times the work.
pub const BETTER: Setting =
    Setting { steps: 4, iterations: 16, contact_stiffness: 4.0, careful: true, rods: Rods::Ropes };

macro_rules! witness {
    ($precision:ident, $rapier:ident, $real:ty) => {
        /// Rapier in this precision.
        pub mod $precision {
            use super::*;
            use $rapier::prelude as rapier;

            fn vector(v: DVec2) -> rapier::Vector {
                rapier::Vector::new(v.x as $real, v.y as $real)
            }

            /// Steps a copy of `world` for so many samples. A contact's material is right where both sides have the same.
            #[allow(clippy::unnecessary_cast)]
            pub fn run(world: &World, setting: Setting, samples: usize) -> Run {
                cheapest(|| {
                    let (mut theirs, handles) = build(world, setting);
                    let positions = |theirs: &rapier::PhysicsWorld| -> Vec<DVec2> {
                        let at = handles.iter().map(|handle| theirs.bodies[*handle].translation());
                        at.map(|at| DVec2::new(at.x as f64, at.y as f64)).collect()
                    };
                    Run::of(positions(&theirs), samples, || {
                        (0..setting.steps).for_each(|_| theirs.step());
                        positions(&theirs)
                    })
                })
            }

            fn build(world: &World, setting: Setting) -> (rapier::PhysicsWorld, Vec<rapier::RigidBodyHandle>) {
                let mut theirs = rapier::PhysicsWorld::new();
                theirs.gravity = vector(world.gravity());
                let parameters = &mut theirs.integration_parameters;
                parameters.dt = 1.0 / (60.0 * setting.steps as $real);
                parameters.num_solver_iterations = setting.iterations;
                parameters.contact_softness.natural_frequency *= setting.contact_stiffness as $real;
                parameters.static_contact_softness.natural_frequency *= setting.contact_stiffness as $real;
                parameters.warmstart_joints = setting.careful;
                parameters.contact_recycling = !setting.careful;
                let handles = (0..world.bodies().len()).map(|i| add_body(&mut theirs, world, i)).collect::<Vec<_>>();
                for wall in world.walls() {
                    let collider = match wall.shape {
                        Shape::Segment { from, to } => rapier::ColliderBuilder::segment(vector(from), vector(to)),
                        Shape::Box { min, max } => {
                            let half = 0.5 * (max - min);
                            rapier::ColliderBuilder::cuboid(half.x as $real, half.y as $real)
                                .translation(vector(0.5 * (min + max)))
                        }
                    };
                    let collider = collider.restitution(wall.restitution as $real).friction(wall.friction as $real);
                    theirs.insert_collider(collider, None);
                }
                let mut hinged = vec![false; handles.len()];
                for i in 0..world.constraints().len() {
                    add_joint(&mut theirs, (&handles, &mut hinged), world, i, setting.rods);
                }
                (theirs, handles)
            }

            fn add_body(theirs: &mut rapier::PhysicsWorld, world: &World, i: usize) -> rapier::RigidBodyHandle {
                let (bodies, spin) = (world.bodies(), world.bodies().spin(i));
                let mut body = if world.is_dynamic(i) {
                    rapier::RigidBodyBuilder::dynamic()
                } else {
                    rapier::RigidBodyBuilder::fixed()
                };
                body = body.translation(vector(bodies.position[i])).linvel(vector(bodies.velocity[i])).can_sleep(false);
                body = match spin {
                    Some(spin) => body.angvel(spin.omega as $real),
                    None => body.lock_rotations(),
                };
                if bodies.radius[i] == 0.0 || !bodies.collides[i] {
                    return theirs.insert_body(body.additional_mass(bodies.mass[i] as $real));
                }
                let collider = rapier::ColliderBuilder::ball(bodies.radius[i] as $real).mass(bodies.mass[i] as $real);
                let collider = collider.restitution(bodies.restitution[i] as $real);
                theirs.insert(body, collider.friction(bodies.friction[i] as $real)).0
            }

            fn add_joint(
                theirs: &mut rapier::PhysicsWorld,
                (handles, hinged): (&[rapier::RigidBodyHandle], &mut [bool]),
                world: &World,
                i: usize,
                rods: Rods,
            ) {
                let (ends, c) = (world.ends(i), world.constraints());
                let mut handle = |body: u32, at: DVec2| match handles.get(body as usize) {
                    Some(handle) => *handle,
                    None => theirs.insert_body(rapier::RigidBodyBuilder::fixed().translation(vector(at))),
                };
                let (a, b) = (handle(c.a[i], ends.0), handle(c.b[i], ends.1));
                let link = c.b[i] as usize;
                match c.kind[i] {
                    // A link has one upper end; a rod back to a fixed point remains a rope.
                    Kind::Rod { length } if rods == Rods::Hinges && world.is_dynamic(link) && !hinged[link] => {
                        hinged[link] = true;
                        let inertia = LINK_INERTIA * world.bodies().mass[link] * length * length;
                        let properties = rapier::MassProperties::new(
                            rapier::Vector::new(0.0, 0.0),
                            world.bodies().mass[link] as $real,
                            inertia as $real,
                        );
                        let body = &mut theirs.bodies[b];
                        body.set_locked_axes(rapier::LockedAxes::empty(), true);
                        body.set_additional_mass_properties(properties, true);
                        let joint = rapier::RevoluteJointBuilder::new().local_anchor2(vector(ends.0 - ends.1));
                        theirs.impulse_joints.insert(a, b, joint, true);
                    }
                    Kind::Rod { length } => {
                        let joint = rapier::RopeJointBuilder::new(length as $real);
                        theirs.impulse_joints.insert(a, b, joint, true);
                    }
                    Kind::Spring { rest, stiffness, damping } => {
                        let joint =
                            rapier::SpringJointBuilder::new(rest as $real, stiffness as $real, damping as $real);
                        theirs.impulse_joints.insert(a, b, joint, true);
                    }
                    kind => panic!("no scene here has a {}", kind.name()),
                }
            }
        }
    };
}

witness!(single, rapier2d, f32);
witness!(double, rapier2d_f64, f64);
