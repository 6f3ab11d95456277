//! How large bodies and links are drawn and what lies over what: one truth for the picture and for the pointer.

use crate::engine::constraint::WORLD;
use crate::engine::{Kind, Motion, World};

/// Least radius of a point mass on the canvas [points]: large enough to be seen and taken hold of.
pub const LEAST_DOT: f64 = 3.0;
/// Least radius of a body that has one [points]: it shrinks with the view, but never vanishes.
const LEAST_DISC: f64 = 1.5;
/// Least radius of a static body, so that its bolt can be told [points].
const LEAST_BOLT: f64 = 5.0;
/// Width of a rod at least and at most [points]; in between a fifth of its length.
pub const ROD_WIDTH: [f64; 2] = [1.5, 4.0];
/// The same for a rope under tension.
pub const ROPE_WIDTH: [f64; 2] = [1.5, 3.0];
/// Radius of a pin, and of the bolt of an end fixed to the world [points].
pub const PIN_RADIUS: f64 = 4.0;

/// Radius of the bob of a point mass on a link, in parts of its shortest link, and at most [points].
const BOB: (f64, f64) = (0.25, 8.0);
/// How many times larger the bob of a heavy one is at most.
const HEAVIEST_BOB: f64 = 3.0;

/// What is looked up of each body to draw it, gathered once a picture.
#[derive(Clone, Debug, Default)]
pub struct Sizes {
    /// By body: how many rods, ropes, springs and pins hold it.
    pub links: Vec<u32>,
    /// By body: length of the shortest rod, rope or spring on a point mass [m], 0 on anything else.
    shortest: Vec<f64>,
    /// By body: how many times larger its bob is than that of a middling mass.
    weight: Vec<f64>,
}

impl Sizes {
    /// Those of the bodies of `world`.
    pub fn of(world: &World) -> Sizes {
        let mut sizes = Sizes::default();
        sizes.gather(world);
        sizes
    }

    /// The same, in memory that is there.
    pub fn gather(&mut self, world: &World) {
        let (bodies, links) = (world.bodies(), world.constraints());
        self.links.clear();
        self.links.resize(bodies.len(), 0);
        self.shortest.clear();
        self.shortest.resize(bodies.len(), 0.0);
        for link in 0..links.len() {
            for body in [links.a[link], links.b[link]].into_iter().filter(|body| *body != WORLD) {
                let body = body as usize;
                self.links[body] += 1;
                let is_bob = bodies.radius[body] == 0.0 && bodies.motion[body] == Motion::Dynamic;
                if let Some(length) = length(links.kind[link]).filter(|_| is_bob) {
                    let known = self.shortest[body];
                    self.shortest[body] = if known > 0.0 { known.min(length) } else { length };
                }
            }
        }
        self.weigh(world);
    }

    fn weigh(&mut self, world: &World) {
        let masses = &world.bodies().mass;
        self.weight.clear();
        self.weight.resize(masses.len(), 1.0);
        let bobs = || (0..masses.len()).filter(|body| self.shortest[*body] > 0.0);
        let mut sorted: Vec<f64> = bobs().map(|body| masses[body]).collect();
        if sorted.is_empty() {
            return;
        }
        let middle = (sorted.len() - 1) / 2;
        let middling = *sorted.select_nth_unstable_by(middle, f64::total_cmp).1;
        for body in bobs() {
            // As a ball of the same stuff grows with its mass.
            self.weight[body] = (masses[body] / middling).cbrt().clamp(1.0, HEAVIEST_BOB);
        }
    }

    /// Radius of body `index` on the canvas [points].
    pub fn radius(&self, world: &World, index: usize, scale: f64) -> f64 {
        let bodies = world.bodies();
        if self.shortest[index] > 0.0 {
            return (BOB.0 * self.shortest[index] * scale).clamp(LEAST_DOT, BOB.1) * self.weight[index];
        }
        let least = match (bodies.motion[index], bodies.radius[index]) {
            (Motion::Static, _) => LEAST_BOLT,
            (_, 0.0) => LEAST_DOT,
            _ => LEAST_DISC,
        };
        (bodies.radius[index] * scale).max(least)
    }
}

/// Length of a link that has one [m].
fn length(kind: Kind) -> Option<f64> {
    match kind {
        Kind::Rod { length } | Kind::Rope { length } | Kind::Spring { rest: length, .. } => Some(length),
        Kind::Pin => None,
    }
}

/// Width of a rod or rope of `length` [m] on the canvas [points].
pub fn width(length: f64, scale: f64, [least, most]: [f64; 2]) -> f64 {
    (length / 5.0 * scale).clamp(least, most)
}

/// Whether a link is drawn over the bodies that move: a piece of a chain whose beads hide more than half of it. Any other
/// lies below them, so that it seems to be fixed to their edges.
pub fn lies_above(world: &World, sizes: &Sizes, link: usize, scale: f64) -> bool {
    let links = world.constraints();
    let Some(length) = length(links.kind[link]) else { return false };
    let is_bead = |body: usize| sizes.links[body] > 1 && world.bodies().motion[body] != Motion::Static;
    let ends = [links.a[link], links.b[link]].into_iter().filter(|body| *body != WORLD).map(|body| body as usize);
    let hidden: f64 = ends.filter(|body| is_bead(*body)).map(|body| sizes.radius(world, body, scale)).sum();
    hidden > 0.5 * length * scale
}

/// A spring's coil [points], which belongs to the spring and not to its present length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coil {
    /// Length at rest.
    pub rest: f64,
    /// Grows with the root of the rest length, so that short and long springs both look like springs; fewer where they
    /// could not be told apart.
    pub windings: f64,
    /// From the axis to the outermost point of a winding [points].
    pub half_width: f64,
}

/// The coil of a spring of `rest` [m] that is `length` [points] long now.
pub fn coil(rest: f64, length: f64, scale: f64) -> Coil {
    /// Room that a winding needs at rest to be told from its neighbours [points].
    const WINDING: f64 = 4.5;
    /// Least half width at which a zigzag is not a line [points].
    const NARROWEST: f64 = 2.5;
    // A spring that rests at length 0 has no size of its own; it is given that of a spring a third as long as it is now.
    let rest = if rest > 0.0 { rest } else { length / scale / 3.0 };
    let wanted = (9.0 * rest.sqrt()).round().clamp(4.0, 40.0);
    let windings = (rest * scale / WINDING).floor().clamp(2.0, wanted);
    Coil { rest: rest * scale, windings, half_width: (0.75 * rest * scale / windings).max(NARROWEST) }
}

/// Whether a spring `length` [points] long is drawn as a plain line: too short for a coil, or one of many in a cloth or a
/// soft body, where coils would hide each other.
pub fn is_plain(world: &World, sizes: &Sizes, link: usize, length: f64) -> bool {
    /// A shorter spring is a dash [points].
    const SHORTEST: f64 = 8.0;
    /// Links of a body up to which it is a joint, and beyond which it is a node of a mesh.
    const JOINT: u32 = 3;
    let links = world.constraints();
    let ends = [links.a[link], links.b[link]];
    length < SHORTEST || ends.into_iter().any(|body| body != WORLD && sizes.links[body as usize] > JOINT)
}

/// Half the width that a link takes up on the canvas [points].
pub fn half_width(world: &World, sizes: &Sizes, link: usize, scale: f64) -> f64 {
    let (from, to) = world.ends(link);
    let length = from.distance(to) * scale;
    match world.constraints().kind[link] {
        Kind::Rod { length } => width(length, scale, ROD_WIDTH) / 2.0,
        Kind::Rope { length } => width(length, scale, ROPE_WIDTH) / 2.0,
        Kind::Spring { .. } if is_plain(world, sizes, link, length) => ROD_WIDTH[0] / 2.0,
        Kind::Spring { rest, .. } => coil(rest, length, scale).half_width,
        Kind::Pin => PIN_RADIUS,
    }
}
