//! Discs that constraints or the mouse turn: an anchor off a disc's centre stands at p = x + e, e = R(θ) r.
//!
//! The unknowns are then x, y and θ, with M = diag(m, m, I). Every such anchor is a node of its own among the island's, without mass,
//! so that all that only reads ends (rods, springs, the events of ropes, the hold) needs no case for it; what moves the bodies
//! goes through this room. In an island where no anchor is off a centre all of it is empty, and nothing here is called.

mod accelerations;
mod rows;

use super::{Nodes, System};
use crate::engine::body::NO_ROTOR;
use crate::engine::constraint::Grip;
use crate::engine::world::World;
use glam::DVec2;
pub(crate) use rows::{End, Rows};

/// No arm, no rotor.
const NONE: u32 = u32::MAX;

/// Discs with an anchor off their centres.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rotors {
    /// Node of the centre, and dense index of the body.
    pub node: Vec<u32>,
    pub body: Vec<u32>,
    /// [rad]
    pub angle: Vec<f64>,
    /// [rad/s]
    pub omega: Vec<f64>,
    /// 1/I [1/(kg·m²)]; 0 for a disc that nothing can turn, which goes on with its own angular velocity.
    pub inverse_inertia: Vec<f64>,
    /// 1 where drag acts, else 0.
    pub free: Vec<f64>,
    /// [m]
    pub radius: Vec<f64>,
    /// Of the angle.
    pub cos: Vec<f64>,
    pub sin: Vec<f64>,
}

/// Anchors off a centre.
#[derive(Clone, Debug, Default)]
pub(crate) struct Arms {
    /// The node that stands for the anchor.
    pub point: Vec<u32>,
    pub rotor: Vec<u32>,
    /// r, in the axes of the disc [m].
    pub local: Vec<DVec2>,
    /// e = R(θ) r [m].
    pub x: Vec<f64>,
    pub y: Vec<f64>,
}

/// All that turns in an island.
#[derive(Clone, Debug, Default)]
pub(crate) struct Turning {
    pub rotors: Rotors,
    pub arms: Arms,
    /// Known from the first factorisation on.
    pub rows: Rows,
    /// The arm that the mouse holds.
    held: Option<usize>,
    /// By node: its rotor, and the arm that it is the end of; shorter than the nodes, or NONE, where there is none.
    rotor_at: Vec<u32>,
    arm_at: Vec<u32>,
}

impl Turning {
    /// Whether no anchor is off a centre.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.rotors.node.is_empty()
    }

    /// The node for an anchor at `local` of the body that stands at `node`: a new one, if the anchor turns with the body.
    pub fn anchor(&mut self, world: &World, nodes: &mut Nodes, node: u32, local: DVec2) -> u32 {
        let body = nodes.body[node as usize];
        let spins = world.bodies.rotor[body as usize] != NO_ROTOR;
        if local == DVec2::ZERO || !spins {
            return node;
        }
        let rotor = self.rotor(world, node, body);
        let point = nodes.push_point();
        self.arm_at.resize(point as usize, NONE);
        self.arm_at.push(self.arms.point.len() as u32);
        self.arms.point.push(point);
        self.arms.rotor.push(rotor);
        self.arms.local.push(local);
        self.arms.x.push(0.0);
        self.arms.y.push(0.0);
        point
    }

    fn rotor(&mut self, world: &World, node: u32, body: u32) -> u32 {
        if self.rotor_at.len() <= node as usize {
            self.rotor_at.resize(node as usize + 1, NONE);
        }
        if self.rotor_at[node as usize] != NONE {
            return self.rotor_at[node as usize];
        }
        let index = self.rotors.node.len() as u32;
        self.rotor_at[node as usize] = index;
        let bodies = &world.bodies;
        let inverse_inertia = bodies.rotors.inverse_inertia[bodies.rotor[body as usize] as usize];
        let rotors = &mut self.rotors;
        rotors.node.push(node);
        rotors.body.push(body);
        rotors.inverse_inertia.push(inverse_inertia);
        rotors.free.push(if inverse_inertia > 0.0 { 1.0 } else { 0.0 });
        rotors.radius.push(bodies.radius[body as usize]);
        for values in [&mut rotors.angle, &mut rotors.omega, &mut rotors.sin] {
            values.push(0.0);
        }
        rotors.cos.push(1.0);
        index
    }

    /// The end of a row that stands at this node.
    fn end(&self, point: u32) -> End {
        match self.arm_at.get(point as usize).copied().unwrap_or(NONE) {
            NONE => End { node: point, arm: NONE },
            arm => End { node: self.rotors.node[self.arms.rotor[arm as usize] as usize], arm },
        }
    }

    /// Takes an arm for the mouse's hold, if it turns a disc of the island.
    pub fn hold(&mut self, world: &World, nodes: &mut Nodes) {
        let Some(grip) = world.turning_grip() else { return };
        let body = world.bodies.index_of(grip.body).map(|body| body as u32);
        let own = |node: &usize| Some(nodes.body[*node]) == body && nodes.w[*node] > 0.0;
        if let Some(node) = (0..nodes.len()).find(own) {
            self.held = Some(self.arms.point.len());
            self.anchor(world, nodes, node as u32, grip.local);
        }
    }

    /// The node that the mouse holds, if it turns a disc of this island.
    pub fn held_point(&self) -> Option<usize> {
        self.held.map(|arm| self.arms.point[arm] as usize)
    }

    /// Reads angles and the grabbed point, and places the anchors on bodies that `nodes` has already read.
    pub fn load(&mut self, world: &World, nodes: &mut Nodes) {
        let bodies = &world.bodies;
        for (i, body) in self.rotors.body.iter().enumerate() {
            let spin = bodies.rotor[*body as usize] as usize;
            self.rotors.angle[i] = bodies.rotors.angle[spin];
            // What is static may have been given an angular velocity, with which it does not move.
            let still = bodies.motion[*body as usize] == crate::engine::Motion::Static;
            self.rotors.omega[i] = if still { 0.0 } else { bodies.rotors.omega[spin] };
        }
        if let (Some(arm), Some(Grip { local, .. })) = (self.held, &world.grip) {
            self.arms.local[arm] = *local;
        }
        self.place(nodes);
    }

    /// Writes angles and angular velocities back.
    pub fn store(&self, world: &mut World) {
        let (rotor, rotors) = (&world.bodies.rotor, &mut world.bodies.rotors);
        for (i, body) in self.rotors.body.iter().enumerate() {
            let spin = rotor[*body as usize] as usize;
            rotors.angle[spin] = self.rotors.angle[i];
            if self.rotors.free[i] > 0.0 {
                rotors.omega[spin] = self.rotors.omega[i];
            }
        }
    }

    /// Whether all angles and their rates are where numbers mean something.
    pub fn within(&self, most: f64) -> bool {
        // Written so that a NaN is out of range.
        self.rotors.angle.iter().chain(&self.rotors.omega).all(|value| value.abs() <= most)
    }

    /// Moves the anchors to where their bodies are, and gives them the velocities that they have there.
    pub fn place(&mut self, nodes: &mut Nodes) {
        self.place_positions(nodes);
        self.place_velocities(nodes);
    }

    /// p = x + R(θ) r.
    pub fn place_positions(&mut self, nodes: &mut Nodes) {
        let (rotors, arms) = (&mut self.rotors, &mut self.arms);
        for ((angle, cos), sin) in rotors.angle.iter().zip(&mut rotors.cos).zip(&mut rotors.sin) {
            (*sin, *cos) = libm::sincos(*angle);
        }
        for (i, (point, rotor)) in arms.point.iter().zip(&arms.rotor).enumerate() {
            let (local, rotor, point) = (arms.local[i], *rotor as usize, *point as usize);
            let (cos, sin, node) = (rotors.cos[rotor], rotors.sin[rotor], rotors.node[rotor] as usize);
            (arms.x[i], arms.y[i]) = (cos * local.x - sin * local.y, sin * local.x + cos * local.y);
            (nodes.x[point], nodes.y[point]) = (nodes.x[node] + arms.x[i], nodes.y[node] + arms.y[i]);
        }
    }

    /// ṗ = v + ω × e.
    pub fn place_velocities(&self, nodes: &mut Nodes) {
        let (rotors, arms) = (&self.rotors, &self.arms);
        for (i, (point, rotor)) in arms.point.iter().zip(&arms.rotor).enumerate() {
            let (node, omega, point) =
                (rotors.node[*rotor as usize] as usize, rotors.omega[*rotor as usize], *point as usize);
            (nodes.vx[point], nodes.vy[point]) =
                (nodes.vx[node] - omega * arms.y[i], nodes.vy[node] + omega * arms.x[i]);
        }
    }
}

impl System {
    /// Whether an anchor turns with a body.
    #[inline]
    pub fn turns(&self) -> bool {
        !self.turning.is_empty()
    }

    /// How easily the ends of a rod or rope give way along it: n·(M⁻¹ n) over both [1/kg].
    pub(super) fn mobility(&self, r: usize) -> f64 {
        let centres = self.nodes.w[self.rods.a[r] as usize] + self.nodes.w[self.rods.b[r] as usize];
        if self.turns() { self.turning.rows.mobility(r, self) } else { centres }
    }

    /// v += M⁻¹ Jᵀ `self.rhs`.
    pub(super) fn push_velocities(&mut self) {
        let (mut vx, mut vy) = (std::mem::take(&mut self.nodes.vx), std::mem::take(&mut self.nodes.vy));
        if self.turns() {
            let mut omega = std::mem::take(&mut self.turning.rotors.omega);
            self.turning.push(&self.nodes.w, &self.rhs, &mut vx, &mut vy, &mut omega);
            self.turning.rotors.omega = omega;
            (self.nodes.vx, self.nodes.vy) = (vx, vy);
            self.turning.place_velocities(&mut self.nodes);
            return;
        }
        self.push(&mut vx, &mut vy);
        (self.nodes.vx, self.nodes.vy) = (vx, vy);
    }

    /// q += M⁻¹ Jᵀ `self.rhs`.
    pub fn move_nodes(&mut self) {
        let (mut x, mut y) = (std::mem::take(&mut self.nodes.x), std::mem::take(&mut self.nodes.y));
        if self.turns() {
            let mut angle = std::mem::take(&mut self.turning.rotors.angle);
            self.turning.push(&self.nodes.w, &self.rhs, &mut x, &mut y, &mut angle);
            self.turning.rotors.angle = angle;
            (self.nodes.x, self.nodes.y) = (x, y);
            self.turning.place(&mut self.nodes);
            return;
        }
        self.push(&mut x, &mut y);
        (self.nodes.x, self.nodes.y) = (x, y);
    }
}
