//! Rapier 0.36 as a witness: the same scenes, its default settings, our default rate. It computes in single precision and for
//! games, so where a closed form exists both errors are printed against that, and only what both must share is compared.

use rapier2d::prelude::*;
use tautline::engine::{Body, Constraint, DVec2, Kind, Method, Stepper, Wall, World};

const G: f64 = 9.81;

/// A ball or a block: a disc that may not turn, as our particles.
struct Disc {
    at: DVec2,
    radius: f64,
    restitution: f64,
    friction: f64,
}

/// A scene built twice.
struct Twins {
    ours: World,
    stepper: Stepper,
    theirs: PhysicsWorld,
    handles: Vec<RigidBodyHandle>,
}

fn to_rapier(v: DVec2) -> Vector {
    Vector::new(v.x as f32, v.y as f32)
}

impl Twins {
    /// 60 Hz for both, and as many substeps as Rapier makes: four.
    fn new() -> Twins {
        let theirs = PhysicsWorld { gravity: Vector::new(0.0, -G as f32), ..PhysicsWorld::new() };
        let stepper = Stepper::new(Method::default()).unwrap();
        Twins { ours: World::new(), stepper, theirs, handles: Vec::new() }
    }

    fn add_wall(&mut self, from: DVec2, to: DVec2, restitution: f64, friction: f64) {
        self.ours.add_wall(&Wall { restitution, friction, ..Wall::segment(from, to) }).unwrap();
        let collider = ColliderBuilder::segment(to_rapier(from), to_rapier(to));
        let collider = collider.restitution(restitution as f32).friction(friction as f32);
        self.theirs.insert_collider(collider, None);
    }

    fn add_disc(&mut self, disc: &Disc) -> usize {
        let Disc { at, radius, restitution, friction } = *disc;
        let mass = std::f64::consts::PI * radius * radius;
        self.ours.add_body(&Body { position: at, radius, mass, restitution, friction, ..Body::default() }).unwrap();
        let body = RigidBodyBuilder::dynamic().translation(to_rapier(at)).lock_rotations().can_sleep(false);
        let collider = ColliderBuilder::ball(radius as f32).restitution(restitution as f32).friction(friction as f32);
        let (handle, _) = self.theirs.insert(body, collider);
        self.handles.push(handle);
        self.handles.len() - 1
    }

    fn step(&mut self) {
        let report = self.stepper.step(&mut self.ours);
        assert!(report.divergence.is_none());
        self.theirs.step();
    }

    fn run(&mut self, seconds: f64) {
        (0..(seconds * 60.0).round() as u32).for_each(|_| self.step());
    }

    fn our(&self, i: usize) -> DVec2 {
        self.ours.bodies().position[i]
    }

    fn their(&self, i: usize) -> DVec2 {
        let at = self.theirs.bodies[self.handles[i]].translation();
        DVec2::new(f64::from(at.x), f64::from(at.y))
    }
}

#[test]
fn a_ball_bounces_as_high_as_rapiers_and_nearer_to_the_truth() {
    let mut twins = Twins::new();
    twins.add_wall(DVec2::new(-5.0, 0.0), DVec2::new(5.0, 0.0), 0.8, 0.0);
    twins.add_disc(&Disc { at: DVec2::new(0.0, 2.25), radius: 0.25, restitution: 0.8, friction: 0.0 });
    let (mut ours, mut theirs): (f64, f64) = (0.0, 0.0);
    for step in 0..85 {
        twins.step();
        // The fall of 2 m takes 0.64 s, the first bounce lasts to 1.66 s.
        if step > 50 {
            ours = ours.max(twins.our(0).y - 0.25);
            theirs = theirs.max(twins.their(0).y - 0.25);
        }
    }
    let truth = 0.64 * 2.0;
    println!("height of the first bounce: truth {truth:.4} m, ours {ours:.4}, Rapier {theirs:.4}");
    // Rapier's own error at its defaults is a few percent of the height.
    assert!((ours - theirs).abs() < 0.08 * truth);
    // Ours is of first order in h = 4 ms: 2 √(2 g h₀) h of the height.
    assert!((ours - truth).abs() < 0.03 * truth);
}

#[test]
fn a_block_slides_as_far_as_rapiers() {
    let mut twins = Twins::new();
    let (slope, friction) = (0.5f64, 0.3);
    let down = DVec2::from_angle(-slope);
    twins.add_wall(-20.0 * down, 20.0 * down, 0.0, friction);
    let start = 0.1 * down.perp();
    twins.add_disc(&Disc { at: start, radius: 0.1, restitution: 0.0, friction });
    twins.run(1.5);
    let truth = 0.5 * G * (slope.sin() - friction * slope.cos()) * 1.5 * 1.5;
    let (ours, theirs) = ((twins.our(0) - start).dot(down), (twins.their(0) - start).dot(down));
    println!("way down: truth {truth:.4} m, ours {ours:.4}, Rapier {theirs:.4}");
    // Both are of first order: half a substep's or step's share of the way.
    assert!((ours - theirs).abs() < 0.03 * truth);
    assert!((ours - truth).abs() < 0.005 * truth);
}

#[test]
fn a_pendulum_swings_along_with_rapiers() {
    let mut twins = Twins::new();
    let start = DVec2::new(1.0, 0.0);
    let ball = twins.add_disc(&Disc { at: start, radius: 0.05, restitution: 0.0, friction: 0.0 });
    let id = twins.ours.bodies().id[ball];
    twins.ours.add_constraint(&Constraint::to_world(Kind::Rod { length: 1.0 }, id, DVec2::ZERO)).unwrap();
    // A hinge at the origin on a body that may turn: with the mass at its centre almost the same as our point on a rod.
    let hook = twins.theirs.insert_body(RigidBodyBuilder::fixed());
    let handle = twins.handles[ball];
    twins.theirs.bodies[handle].set_locked_axes(LockedAxes::empty(), true);
    let joint = RevoluteJointBuilder::new().local_anchor1(Vector::new(0.0, 0.0)).local_anchor2(Vector::new(-1.0, 0.0));
    twins.theirs.impulse_joints.insert(hook, handle, joint, true);
    let (mut apart, mut ours_off, mut theirs_off): (f64, f64, f64) = (0.0, 0.0, 0.0);
    for _ in 0..120 {
        twins.step();
        apart = apart.max(twins.our(0).distance(twins.their(0)));
        ours_off = ours_off.max((twins.our(0).length() - 1.0).abs());
        theirs_off = theirs_off.max((twins.their(0).length() - 1.0).abs());
    }
    println!("pendulum over 2 s: apart {apart:.4} m; length off: ours {ours_off:.1e} m, Rapier {theirs_off:.1e} m");
    // A swing from the horizontal is 3.14 m long and passes the lowest point at 4.4 m/s: 5 cm are 11 ms.
    assert!(apart < 0.05);
    assert!(ours_off < 1e-3);
}

#[test]
fn a_pile_comes_to_rest_as_high_as_rapiers_and_overlaps_less() {
    let mut twins = Twins::new();
    let corners = [(-1.0, 4.0), (-1.0, 0.0), (1.0, 0.0), (1.0, 4.0)].map(|(x, y)| DVec2::new(x, y));
    (0..3).for_each(|i| twins.add_wall(corners[i], corners[i + 1], 0.0, 0.5));
    for i in 0..100 {
        let (column, row) = (f64::from(i % 8), f64::from(i / 8));
        // Every other row is set off sideways, so that the discs do not stand on each other's tops.
        let at = DVec2::new(-0.82 + 0.22 * column + 0.06 * (row % 2.0), 0.15 + 0.22 * row);
        twins.add_disc(&Disc { at, radius: 0.08 + 0.002 * f64::from(i % 11), restitution: 0.0, friction: 0.5 });
    }
    twins.run(8.0);
    let radius = &twins.ours.bodies().radius;
    let measure = |at: &dyn Fn(usize) -> DVec2| {
        let highest = (0..100).map(|i| at(i).y + radius[i]).fold(0.0, f64::max);
        let mean = (0..100).map(|i| at(i).y).sum::<f64>() / 100.0;
        let pairs = (0..100).flat_map(|i| (0..i).map(move |j| (i, j)));
        let overlap = pairs.map(|(i, j)| radius[i] + radius[j] - at(i).distance(at(j))).fold(0.0, f64::max);
        (highest, mean, overlap)
    };
    let (our_top, our_mean, our_overlap) = measure(&|i| twins.our(i));
    let (their_top, their_mean, their_overlap) = measure(&|i| twins.their(i));
    let fastest = twins.ours.bodies().velocity.iter().map(|v| v.length()).fold(0.0, f64::max);
    println!("pile: top {our_top:.3} m, Rapier {their_top:.3}; mean height {our_mean:.4}, Rapier {their_mean:.4}");
    println!("deepest overlap {our_overlap:.1e} m, Rapier {their_overlap:.1e}; fastest of ours {fastest:.1e} m/s");
    // A pile is chaotic: which disc lies where differs, by how much it fills the box hardly. Half a disc at the top.
    assert!((our_top - their_top).abs() < 0.1, "tops differ");
    assert!((our_mean - their_mean).abs() < 0.03 * their_mean, "mean heights differ");
    // A tenth of a radius is what an eye sees.
    assert!(our_overlap < 0.008 && our_overlap <= their_overlap.max(1e-3), "overlaps");
    assert!(fastest < 0.01, "at rest");
}
