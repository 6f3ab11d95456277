//! The scene as it stands in a file: every field of the format, its unit and its default.

use super::generator::Generator;
use super::pass::Pass;
use crate::engine::{DVec2, Integrator, LinearSolver, Method, Motion, Solver, Tuning};
use crate::truth::ClosedForm;
use serde::de::{self, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;

/// The version of the format that this program writes, and the only one so far.
pub const VERSION: u32 = 1;

/// A whole scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Document {
    /// Version of the format; always written, and first.
    pub version: u32,
    /// Heading for the user; the scene's name if empty.
    #[serde(default, skip_serializing_if = "is_default")]
    pub title: String,
    /// One or two sentences for the user: what it shows, what to try.
    #[serde(default, skip_serializing_if = "is_default")]
    pub about: String,
    /// What to show at first; everything if not given.
    #[serde(default, skip_serializing_if = "is_default")]
    pub view: Option<View>,
    /// What its exact motion is compared over; only in scenes that have one: particles, rods and springs that never touch, or
    /// what a closed form is for.
    #[serde(default, skip_serializing_if = "is_default")]
    pub truth: Option<Truth>,
    /// What a run of it must keep to, as it opens; shown beside its name and tried by a test.
    #[serde(default, skip_serializing_if = "is_default")]
    pub pass: Option<Pass>,
    /// The surroundings, and how the world is stepped.
    #[serde(default, skip_serializing_if = "is_default")]
    pub settings: Settings,
    /// Single bodies, built first and in this order.
    #[serde(default, skip_serializing_if = "is_default")]
    pub bodies: Vec<BodyEntry>,
    /// What never moves and can be touched.
    #[serde(default, skip_serializing_if = "is_default")]
    pub walls: Vec<WallEntry>,
    /// Ropes, cloths, piles and the like: many bodies from one entry.
    #[serde(default, skip_serializing_if = "is_default")]
    pub generators: Vec<Generator>,
    /// Built last, so that they can refer to what the generators made.
    #[serde(default, skip_serializing_if = "is_default")]
    pub constraints: Vec<ConstraintEntry>,
}

impl Default for Document {
    fn default() -> Self {
        Document {
            version: VERSION,
            title: String::new(),
            about: String::new(),
            view: None,
            truth: None,
            pass: None,
            settings: Settings::default(),
            bodies: Vec::new(),
            walls: Vec::new(),
            generators: Vec::new(),
            constraints: Vec::new(),
        }
    }
}

/// The rectangle that a scene asks to show.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct View {
    /// Its middle [m].
    pub centre: DVec2,
    /// Its height [m]; the width follows from the window.
    pub height: f64,
}

/// What a scene's exact motion is compared over: `truth: (seconds: 10, length: 1)`, and the formula that it follows, if there is
/// one: `truth: (seconds: 3, length: 1, form: Bounce)`. Without a formula it is what `tautline truth` computes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Truth {
    /// Simulated time from the start [s].
    pub seconds: f64,
    /// By which distances from the truth are divided [m].
    pub length: f64,
    /// The formula of the motion; the world must be one that it is for.
    #[serde(default, skip_serializing_if = "is_default")]
    pub form: Option<ClosedForm>,
}

/// The surroundings, and how the world is stepped. The fields from `hz` on are those of [`Method`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// [m/s²]
    pub gravity: DVec2,
    /// Rate at which free motion dies away [1/s].
    pub drag: f64,
    /// Values that stand in for those of all contacts and springs.
    pub tuning: Tuning,
    /// Steps per simulated second [Hz].
    pub hz: f64,
    /// Substeps a step, 1 … 1000.
    pub substeps: u32,
    /// Solver sweeps a substep, 1 … 100,000.
    pub iterations: u32,
    /// How positions and velocities are carried on.
    pub integrator: Integrator,
    /// How constraints and contacts are solved within a substep.
    pub solver: Solver,
    /// Whether a solve starts from the last multipliers.
    pub warm_start: bool,
    /// Part of the position errors that is fed back in a substep, 0 … 1.
    pub baumgarte: f64,
    /// Whether the plan chooses methods and steps for the wanted accuracy.
    pub automatic: bool,
    /// What solves the rows of islands that are carried whole.
    pub linear: LinearSolver,
    /// Wanted error after a second or so, in parts of an island's size, 1e-14 … 0.1.
    pub accuracy: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Settings::new(DVec2::new(0.0, -9.81), 0.0, Tuning::default(), &Method::default())
    }
}

impl Settings {
    /// Settings made of a world's and a method's parts.
    pub fn new(gravity: DVec2, drag: f64, tuning: Tuning, method: &Method) -> Settings {
        let Method { hz, substeps, iterations, integrator, solver, warm_start, baumgarte, automatic, linear, accuracy } =
            *method;
        Settings {
            gravity,
            drag,
            tuning,
            hz,
            substeps,
            iterations,
            integrator,
            solver,
            warm_start,
            baumgarte,
            automatic,
            linear,
            accuracy,
        }
    }

    /// The part that says how the world is stepped.
    pub fn method(&self) -> Method {
        let Settings {
            hz,
            substeps,
            iterations,
            integrator,
            solver,
            warm_start,
            baumgarte,
            automatic,
            linear,
            accuracy,
            ..
        } = *self;
        Method { hz, substeps, iterations, integrator, solver, warm_start, baumgarte, automatic, linear, accuracy }
    }
}

/// A body of the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum BodyEntry {
    /// A body without rotation.
    Particle(BodyFields),
    /// A body that turns.
    Disc(BodyFields),
}

/// What can be said about a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BodyFields {
    /// By which constraints refer to it.
    #[serde(skip_serializing_if = "is_default")]
    pub name: Option<String>,
    /// What may move it: everything by default.
    #[serde(skip_serializing_if = "is_default")]
    pub motion: Motion,
    /// Centre [m].
    pub position: DVec2,
    /// [m/s]
    #[serde(skip_serializing_if = "is_zero_point")]
    pub velocity: DVec2,
    /// From the x axis, counter-clockwise [rad]; discs only.
    #[serde(skip_serializing_if = "is_default")]
    pub angle: Option<f64>,
    /// Angular velocity [rad/s]; discs only.
    #[serde(skip_serializing_if = "is_default")]
    pub omega: Option<f64>,
    /// [kg]; 1 if neither this nor the density is given.
    #[serde(skip_serializing_if = "is_default")]
    pub mass: Option<f64>,
    /// [kg/m²], in place of the mass.
    #[serde(skip_serializing_if = "is_default")]
    pub density: Option<f64>,
    /// [m]; 0 for a point, which never touches anything.
    pub radius: f64,
    /// Coefficient of restitution, 0 … 1; a contact takes the larger of the two.
    #[serde(skip_serializing_if = "is_zero")]
    pub restitution: f64,
    /// Coefficient of friction, 0 … 1000; a contact takes the geometric mean of the two.
    pub friction: f64,
    /// Whether it can touch anything at all.
    #[serde(skip_serializing_if = "is_true")]
    pub collides: bool,
    /// Bodies of the same group other than 0 do not touch each other.
    #[serde(skip_serializing_if = "is_default")]
    pub group: u32,
}

impl Default for BodyFields {
    fn default() -> Self {
        let body = crate::engine::Body::default();
        BodyFields {
            name: None,
            motion: body.motion,
            position: body.position,
            velocity: body.velocity,
            angle: None,
            omega: None,
            mass: None,
            density: None,
            radius: body.radius,
            restitution: body.restitution,
            friction: body.friction,
            collides: body.collides,
            group: body.group,
        }
    }
}

/// A constraint of the scene. Lengths not given are the distance of the ends as built.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum ConstraintEntry {
    /// Keeps its ends at a distance of `length` [m].
    Rod {
        /// First end.
        a: End,
        /// Where on the disc `a` it holds, in its axes from its centre [m]; the centre if not given.
        #[serde(default, skip_serializing_if = "is_default")]
        at_a: Option<DVec2>,
        /// Second end.
        b: End,
        /// Where on the disc `b` it holds, in its axes from its centre [m]; the centre if not given.
        #[serde(default, skip_serializing_if = "is_default")]
        at_b: Option<DVec2>,
        /// Distance that is kept [m].
        #[serde(default, skip_serializing_if = "is_default")]
        length: Option<f64>,
    },
    /// Keeps its ends within a distance of `length` [m].
    Rope {
        /// First end.
        a: End,
        /// Where on the disc `a` it holds, in its axes from its centre [m]; the centre if not given.
        #[serde(default, skip_serializing_if = "is_default")]
        at_a: Option<DVec2>,
        /// Second end.
        b: End,
        /// Where on the disc `b` it holds, in its axes from its centre [m]; the centre if not given.
        #[serde(default, skip_serializing_if = "is_default")]
        at_b: Option<DVec2>,
        /// Largest distance [m].
        #[serde(default, skip_serializing_if = "is_default")]
        length: Option<f64>,
    },
    /// Pulls its ends to a distance of `rest` [m] with `stiffness` [N/m] and `damping` [N·s/m].
    Spring {
        /// First end.
        a: End,
        /// Where on the disc `a` it holds, in its axes from its centre [m]; the centre if not given.
        #[serde(default, skip_serializing_if = "is_default")]
        at_a: Option<DVec2>,
        /// Second end.
        b: End,
        /// Where on the disc `b` it holds, in its axes from its centre [m]; the centre if not given.
        #[serde(default, skip_serializing_if = "is_default")]
        at_b: Option<DVec2>,
        /// Distance at which it does not pull [m].
        #[serde(default, skip_serializing_if = "is_default")]
        rest: Option<f64>,
        /// Force over elongation [N/m].
        stiffness: f64,
        /// Force over the speed of elongation [N·s/m].
        #[serde(default, skip_serializing_if = "is_zero")]
        damping: f64,
    },
    /// Holds its ends together; they may turn about each other.
    Pin {
        /// First end.
        a: End,
        /// Where on the disc `a` it holds, in its axes from its centre [m]; the centre if not given.
        #[serde(default, skip_serializing_if = "is_default")]
        at_a: Option<DVec2>,
        /// Second end.
        b: End,
        /// Where on the disc `b` it holds, in its axes from its centre [m]; the centre if not given.
        #[serde(default, skip_serializing_if = "is_default")]
        at_b: Option<DVec2>,
    },
}

/// One end of a constraint as written: `"ball"`, `"deck.12"`, `"cloth.3.4"` (column, row) or a fixed point `(1.0, 2.0)`.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    /// A body by its name, or a generator's node.
    Body(String),
    /// A fixed point of the world [m].
    Point(DVec2),
}

impl Serialize for End {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            End::Body(name) => serializer.serialize_str(name),
            End::Point(point) => point.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for End {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<End, D::Error> {
        deserializer.deserialize_any(EndVisitor)
    }
}

struct EndVisitor;

impl<'de> Visitor<'de> for EndVisitor {
    type Value = End;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("the name of a body in quotes, or a fixed point such as (1.0, 2.0)")
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<End, E> {
        Ok(End::Body(name.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut numbers: A) -> Result<End, A::Error> {
        let x = numbers.next_element()?.ok_or_else(|| de::Error::invalid_length(0, &self))?;
        let y = numbers.next_element()?.ok_or_else(|| de::Error::invalid_length(1, &self))?;
        Ok(End::Point(DVec2::new(x, y)))
    }
}

/// Something immovable.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum WallEntry {
    /// A line without thickness, solid from both sides.
    Segment {
        /// One end [m].
        from: DVec2,
        /// The other end [m].
        to: DVec2,
        /// Coefficient of restitution, 0 … 1.
        #[serde(default, skip_serializing_if = "is_zero")]
        restitution: f64,
        /// Coefficient of friction, ≥ 0; 0.5 if not given.
        #[serde(default = "default_friction")]
        friction: f64,
    },
    /// Segments from point to point.
    Line {
        /// The points [m], at least two.
        points: Vec<DVec2>,
        /// Coefficient of restitution of every segment, 0 … 1.
        #[serde(default, skip_serializing_if = "is_zero")]
        restitution: f64,
        /// Coefficient of friction of every segment, ≥ 0; 0.5 if not given.
        #[serde(default = "default_friction")]
        friction: f64,
    },
    /// A solid box with sides along the axes, from its lower left corner `min` to its upper right corner `max`.
    Box {
        /// Lower left corner [m].
        min: DVec2,
        /// Upper right corner [m].
        max: DVec2,
        /// Coefficient of restitution, 0 … 1.
        #[serde(default, skip_serializing_if = "is_zero")]
        restitution: f64,
        /// Coefficient of friction, ≥ 0; 0.5 if not given.
        #[serde(default = "default_friction")]
        friction: f64,
    },
}

fn default_friction() -> f64 {
    crate::engine::Wall::default().friction
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

fn is_true(value: &bool) -> bool {
    *value
}

/// Whether `value` is +0: a −0 is written out, so that it comes back with the same bits.
fn is_zero(value: &f64) -> bool {
    value.to_bits() == 0
}

pub(super) fn is_zero_point(value: &DVec2) -> bool {
    is_zero(&value.x) && is_zero(&value.y)
}
