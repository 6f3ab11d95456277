//! A contact of surfaces: one direction along the normal in which it only pushes, one along the tangent bounded by Coulomb's cone.
//!
//! Ċ_n = n·(v_a − v_b); Ċ_t = t·(v_a − v_b) − r_a ω_a − r_b ω_b with t the normal turned by +90°, as in `solve/contact_rows.rs`.

use super::path::Path;
use crate::engine::material::Material;
use crate::engine::shape::Shape;
use crate::engine::world::{Touching, World};
use glam::DVec2;

/// Ends of a side nearer than this part of the radius count as reached.
pub(super) const AT_END: f64 = 1e-9;

/// Two surfaces that touch. Bodies by their places in the group; the place after the last stands for the immovable world.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    pub a: usize,
    pub b: usize,
    /// As the world names it.
    pub with: Touching,
    /// Unit normal from `b` towards `a`.
    pub normal: DVec2,
    /// Distance of the centres, or of a centre from a wall [m].
    pub distance: f64,
    /// 0 for a particle, which does not turn.
    pub arm_a: f64,
    pub arm_b: f64,
    pub friction: f64,
    pub restitution: f64,
    /// Effective masses [kg].
    pub normal_mass: f64,
    pub tangent_mass: f64,
    /// How far the contact can go along −t and t before the side of a wall ends [m]; none where the normal turns with the motion.
    pub side: Option<[f64; 2]>,
    /// Impulses since the start of the step [N·s].
    pub impulse: [f64; 2],
}

/// Masses of the bodies of a group and of the world after them: 1/m [1/kg] and 1/I [1/(kg·m²)].
#[derive(Clone, Debug, Default)]
pub(super) struct Masses {
    pub inverse_mass: Vec<f64>,
    pub inverse_inertia: Vec<f64>,
}

impl Touch {
    /// Fills in what follows from the materials and the masses.
    pub fn of(
        world: &World,
        masses: &Masses,
        (a, b): (usize, usize),
        dense: u32,
        with: Touching,
        (normal, distance): (DVec2, f64),
    ) -> Touch {
        let (bodies, i) = (&world.bodies, dense as usize);
        let (radius_b, other) = match with {
            Touching::Body(j) => (bodies.radius[j as usize], bodies.material(j as usize)),
            Touching::Wall(wall) => (0.0, world.walls[wall as usize].material()),
        };
        let Material { restitution, friction } = bodies.material(i).mixed(other, &world.tuning);
        let arm = |place: usize, radius: f64| if masses.inverse_inertia[place] > 0.0 { radius } else { 0.0 };
        let (arm_a, arm_b) = (arm(a, bodies.radius[i]), arm(b, radius_b));
        let k = masses.inverse_mass[a] + masses.inverse_mass[b];
        let turning = masses.inverse_inertia[a] * arm_a * arm_a + masses.inverse_inertia[b] * arm_b * arm_b;
        Touch {
            a,
            b,
            with,
            normal,
            distance,
            arm_a,
            arm_b,
            friction,
            restitution,
            normal_mass: 1.0 / k,
            tangent_mass: 1.0 / (k + turning),
            side: None,
            impulse: [0.0; 2],
        }
    }

    pub fn tangent(&self) -> DVec2 {
        self.normal.perp()
    }

    /// Speed at which the surfaces part [m/s].
    pub fn normal_speed(&self, paths: &[Path]) -> f64 {
        self.normal.dot(paths[self.a].velocity - paths[self.b].velocity)
    }

    /// Speed of the centres past each other, `a`'s along the tangent [m/s].
    pub fn passing_speed(&self, paths: &[Path]) -> f64 {
        self.tangent().dot(paths[self.a].velocity - paths[self.b].velocity)
    }

    /// Speed of `a`'s surface past `b`'s along the tangent [m/s].
    pub fn tangent_speed(&self, paths: &[Path]) -> f64 {
        self.passing_speed(paths) - self.arm_a * paths[self.a].omega - self.arm_b * paths[self.b].omega
    }

    /// The same of what drives the surfaces [m/s²].
    pub fn tangent_drive(&self, paths: &[Path]) -> f64 {
        let (a, b) = (&paths[self.a], &paths[self.b]);
        self.tangent().dot(a.drive - b.drive) - self.arm_a * a.turn - self.arm_b * b.turn
    }

    /// Acceleration by which the surfaces part when the centres pass each other, without any force [m/s²].
    pub fn parting(&self, paths: &[Path]) -> f64 {
        match self.side {
            Some(_) => 0.0,
            None => {
                let speed = self.passing_speed(paths);
                speed * speed / self.distance
            }
        }
    }

    /// A speed below which nothing but rounding is left [m/s].
    pub fn rounding_speed(&self, paths: &[Path]) -> f64 {
        paths[self.a].rounding_speed(self.arm_a) + paths[self.b].rounding_speed(self.arm_b)
    }

    /// Changes velocities by an impulse along the normal and one along the tangent [N·s].
    pub fn push(&mut self, impulse: [f64; 2], masses: &Masses, paths: &mut [Path]) {
        let push = impulse[0] * self.normal + impulse[1] * self.tangent();
        for (place, sign, arm) in [(self.a, 1.0, self.arm_a), (self.b, -1.0, self.arm_b)] {
            paths[place].velocity += sign * masses.inverse_mass[place] * push;
            paths[place].omega -= masses.inverse_inertia[place] * arm * impulse[1];
        }
        self.impulse[0] += impulse[0];
        self.impulse[1] += impulse[1];
    }

    /// Adds forces along the normal and the tangent to what drives the bodies [N].
    pub fn drive(&self, force: [f64; 2], masses: &Masses, paths: &mut [Path]) {
        let push = force[0] * self.normal + force[1] * self.tangent();
        for (place, sign, arm) in [(self.a, 1.0, self.arm_a), (self.b, -1.0, self.arm_b)] {
            paths[place].drive += sign * masses.inverse_mass[place] * push;
            paths[place].turn -= masses.inverse_inertia[place] * arm * force[1];
        }
    }
}

/// How far a disc of `radius` that touches a wall at `centre` can go along −t and t before the side it touches ends [m]; none at a
/// corner or an end.
pub(super) fn side_of(shape: &Shape, centre: DVec2, normal: DVec2, radius: f64) -> Option<[f64; 2]> {
    let (ends, side) = match *shape {
        Shape::Segment { from, to } => ([from, to], (to - from).try_normalize()?),
        Shape::Box { min, max } if normal.x.abs() <= AT_END => ([min, max], DVec2::X),
        Shape::Box { min, max } if normal.y.abs() <= AT_END => ([min, max], DVec2::Y),
        Shape::Box { .. } => return None,
    };
    let along = if side.dot(normal.perp()) < 0.0 { -side } else { side };
    let [one, other] = ends.map(|end| (end - centre).dot(along));
    let (low, high) = (one.min(other), one.max(other));
    (low <= AT_END * radius && high >= -AT_END * radius).then_some([(-low).max(0.0), high.max(0.0)])
}
