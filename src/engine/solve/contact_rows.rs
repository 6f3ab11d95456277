//! Contacts as rows: one along the normal that only pushes, one along the tangent bounded by Coulomb's cone.
//!
//! C = gap ≥ 0, λ_n ≥ 0; Ċ = n·(v_a − v_b); tangent t = n turned by +90°, |λ_t| ≤ μ λ_n. A disc's normal passes through its
//! centre, so only the tangent has arms: r_a × t = −radius_a, r_b × t = radius_b.

use crate::engine::collide::sweep::CORE;
use crate::engine::material::Material;
use crate::engine::state::State;
use crate::engine::world::{Contact, Touching, World};
use glam::DVec2;

/// The two rows of one contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactRow {
    pub a: u32,
    /// The other body, or the world's entry for a wall.
    pub b: u32,
    pub normal: DVec2,
    /// Distance of the surfaces at assembly [m].
    pub gap: f64,
    /// Effective masses along the normal and the tangent [kg].
    pub normal_mass: f64,
    pub tangent_mass: f64,
    /// Whether the contact carried a force in the last substep.
    pub held: bool,
    /// Speed along the normal that is asked for [m/s]: at least this.
    pub wanted_speed: f64,
    pub friction: f64,
    pub restitution: f64,
    pub radius_a: f64,
    /// 0 for a wall.
    pub radius_b: f64,
    /// [N·s]
    pub normal_impulse: f64,
    pub tangent_impulse: f64,
    /// Normal and tangent impulse that an earlier solve of the same substep found [N·s].
    pub found: [f64; 2],
}

impl ContactRow {
    /// The rows of `contact`; `wanted_speed` and the impulses are zero.
    pub fn of<const SPIN: bool>(contact: &Contact, world: &World, state: &State) -> ContactRow {
        let bodies = &world.bodies;
        let a = contact.a as usize;
        let (b, radius_b, other) = match contact.b {
            Touching::Body(b) => (b, bodies.radius[b as usize], bodies.material(b as usize)),
            Touching::Wall(wall) => (state.len() as u32, 0.0, world.walls[wall as usize].material()),
        };
        let Material { restitution, friction } = bodies.material(a).mixed(other, &world.tuning);
        let k = state.inverse_mass[a] + state.inverse_mass[b as usize];
        let mut tangent_k = k;
        if SPIN {
            tangent_k += state.inverse_inertia[a] * bodies.radius[a] * bodies.radius[a]
                + state.inverse_inertia[b as usize] * radius_b * radius_b;
        }
        ContactRow {
            a: contact.a,
            b,
            normal: contact.normal,
            gap: contact.gap,
            normal_mass: 1.0 / k,
            tangent_mass: 1.0 / tangent_k,
            held: contact.normal_force > 0.0,
            wanted_speed: 0.0,
            friction,
            restitution,
            radius_a: bodies.radius[a],
            radius_b,
            normal_impulse: 0.0,
            tangent_impulse: 0.0,
            found: [0.0; 2],
        }
    }

    /// Speed at which the surfaces part along the normal [m/s].
    pub fn normal_speed(&self, state: &State) -> f64 {
        self.normal.dot(state.velocity[self.a as usize] - state.velocity[self.b as usize])
    }

    /// Speed of `a`'s surface past `b`'s along the tangent [m/s].
    pub fn tangent_speed<const SPIN: bool>(&self, state: &State) -> f64 {
        let (a, b) = (self.a as usize, self.b as usize);
        let mut speed = self.normal.perp().dot(state.velocity[a] - state.velocity[b]);
        if SPIN {
            speed -= self.radius_a * state.omega[a] + self.radius_b * state.omega[b];
        }
        speed
    }

    /// Radius of the smaller body [m].
    pub fn least_radius(&self) -> f64 {
        if self.radius_b > 0.0 { self.radius_a.min(self.radius_b) } else { self.radius_a }
    }

    /// Adds an impulse along the normal [N·s].
    pub fn push(&self, impulse: f64, state: &mut State) {
        let (a, b) = (self.a as usize, self.b as usize);
        state.velocity[a] += state.inverse_mass[a] * impulse * self.normal;
        state.velocity[b] -= state.inverse_mass[b] * impulse * self.normal;
    }

    /// Adds an impulse along the tangent [N·s].
    pub fn rub<const SPIN: bool>(&self, impulse: f64, state: &mut State) {
        let (a, b) = (self.a as usize, self.b as usize);
        let tangent = self.normal.perp();
        state.velocity[a] += state.inverse_mass[a] * impulse * tangent;
        state.velocity[b] -= state.inverse_mass[b] * impulse * tangent;
        if SPIN {
            state.omega[a] -= state.inverse_inertia[a] * impulse * self.radius_a;
            state.omega[b] -= state.inverse_inertia[b] * impulse * self.radius_b;
        }
    }

    /// Ends a closing speed that would carry the surfaces past each other within `h` seconds.
    pub fn stop(&self, state: &mut State, h: f64) {
        let short = -self.gap.max(0.0) / h - self.normal_speed(state);
        if short > 0.0 {
            self.push(short * self.normal_mass, state);
        }
    }

    /// Ends a closing speed that would carry the core of `a` into something immovable within `h` seconds, whatever the
    /// sweeps left over.
    pub fn guard(&self, state: &mut State, h: f64) {
        if state.inverse_mass[self.b as usize] > 0.0 {
            return;
        }
        let least = -((self.gap + CORE * self.radius_a).max(0.0)) / h;
        let speed = self.normal_speed(state);
        if speed < least {
            state.velocity[self.a as usize] += (least - speed) * self.normal;
        }
    }
}
