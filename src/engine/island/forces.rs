//! Forces of an island: springs with dampers, the mouse's hold, gravity and drag.

use super::Nodes;
use crate::engine::constraint::Grip;
use crate::engine::world::World;
use glam::DVec2;
use std::f64::consts::TAU;

/// Springs between nodes: force k (|d| − rest) + c d|d|/dt, pulling.
#[derive(Clone, Debug, Default)]
pub(crate) struct Springs {
    pub a: Vec<u32>,
    pub b: Vec<u32>,
    /// [m]
    pub rest: Vec<f64>,
    /// [N/m]
    pub stiffness: Vec<f64>,
    /// [N·s/m]
    pub damping: Vec<f64>,
    /// Index in the world's list.
    pub constraint: Vec<u32>,
    /// Some spring has a damper.
    pub damped: bool,
}

impl Springs {
    pub fn push(&mut self, [a, b]: [u32; 2], rest: f64, stiffness: f64, damping: f64, constraint: u32) {
        self.a.push(a);
        self.b.push(b);
        self.rest.push(rest);
        self.stiffness.push(stiffness);
        self.damping.push(damping);
        self.constraint.push(constraint);
        self.damped |= damping > 0.0;
    }

    pub fn len(&self) -> usize {
        self.a.len()
    }

    /// Force on b along d over its length, as a factor on d [N/m].
    #[inline]
    fn factor(&self, i: usize, (dx, dy): (f64, f64), nodes: &Nodes) -> f64 {
        let square = dx * dx + dy * dy;
        if square == 0.0 {
            // Coinciding ends have no direction.
            return 0.0;
        }
        let mut factor = -self.stiffness[i] * (1.0 - self.rest[i] / square.sqrt());
        if self.damping[i] > 0.0 {
            let (a, b) = (self.a[i] as usize, self.b[i] as usize);
            let speed = dx * (nodes.vx[b] - nodes.vx[a]) + dy * (nodes.vy[b] - nodes.vy[a]);
            factor -= self.damping[i] * speed / square;
        }
        factor
    }

    /// Adds the springs' forces to vectors by node [N].
    pub fn add_forces(&self, nodes: &Nodes, fx: &mut [f64], fy: &mut [f64]) {
        if !self.damped {
            return self.add_elastic_forces(nodes, fx, fy);
        }
        for (i, (a, b)) in self.a.iter().zip(&self.b).enumerate() {
            let (a, b) = (*a as usize, *b as usize);
            let (dx, dy) = (nodes.x[b] - nodes.x[a], nodes.y[b] - nodes.y[a]);
            let factor = self.factor(i, (dx, dy), nodes);
            fx[a] -= factor * dx;
            fy[a] -= factor * dy;
            fx[b] += factor * dx;
            fy[b] += factor * dy;
        }
    }

    /// The same without dampers: differences are gathered for some springs, their factors found side by side, and the forces
    /// scattered.
    fn add_elastic_forces(&self, nodes: &Nodes, fx: &mut [f64], fy: &mut [f64]) {
        const SIDE: usize = 32;
        let (mut dx, mut dy, mut factor) = ([0.0; SIDE], [0.0; SIDE], [0.0; SIDE]);
        let chunks = self.a.chunks(SIDE).zip(self.b.chunks(SIDE));
        let laws = self.rest.chunks(SIDE).zip(self.stiffness.chunks(SIDE));
        for ((a, b), (rest, stiffness)) in chunks.zip(laws) {
            for (((dx, dy), a), b) in dx.iter_mut().zip(&mut dy).zip(a).zip(b) {
                *dx = nodes.x[*b as usize] - nodes.x[*a as usize];
                *dy = nodes.y[*b as usize] - nodes.y[*a as usize];
            }
            for ((((factor, dx), dy), rest), k) in factor.iter_mut().zip(&dx).zip(&dy).zip(rest).zip(stiffness) {
                let square: f64 = dx * dx + dy * dy;
                let pull = k * (rest / square.sqrt() - 1.0);
                *factor = if square > 0.0 { pull } else { 0.0 };
            }
            for ((((factor, dx), dy), a), b) in factor.iter().zip(&dx).zip(&dy).zip(a).zip(b) {
                let (a, b) = (*a as usize, *b as usize);
                let (px, py) = (factor * dx, factor * dy);
                fx[a] -= px;
                fy[a] -= py;
                fx[b] += px;
                fy[b] += py;
            }
        }
    }

    /// Adds the absolute values of the stiffness matrix by rows, half of them: for each end's x and y [N/m].
    pub fn add_loads(&self, nodes: &Nodes, x: &mut [f64], y: &mut [f64]) {
        for (i, (a, b)) in self.a.iter().zip(&self.b).enumerate() {
            let (a, b) = (*a as usize, *b as usize);
            let (dx, dy) = (nodes.x[b] - nodes.x[a], nodes.y[b] - nodes.y[a]);
            let square = dx * dx + dy * dy;
            if square > 0.0 {
                let (k, cross) = (self.stiffness[i], (dx * dy).abs());
                let inverse = 1.0 / square;
                let tension = k * (1.0 - self.rest[i] * inverse.sqrt()).abs();
                let over = k * inverse;
                let (along_x, along_y) = (over * (dx * dx + cross) + tension, over * (dy * dy + cross) + tension);
                x[a] += along_x;
                x[b] += along_x;
                y[a] += along_y;
                y[b] += along_y;
            }
        }
    }

    /// Writes the springs' forces, as multipliers (λ, 0) [N].
    pub fn store(&self, nodes: &Nodes, force: &mut [DVec2]) {
        for (i, constraint) in self.constraint.iter().enumerate() {
            let (a, b) = (self.a[i] as usize, self.b[i] as usize);
            let (dx, dy) = (nodes.x[b] - nodes.x[a], nodes.y[b] - nodes.y[a]);
            let length = (dx * dx + dy * dy).sqrt();
            force[*constraint as usize] = DVec2::new(self.factor(i, (dx, dy), nodes) * length, 0.0);
        }
    }
}

/// The mouse's hold on a node: −k (x − target) − c v, at most `most` [N].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Held {
    pub node: usize,
    pub target: DVec2,
    /// [N/m]
    pub stiffness: f64,
    /// [N·s/m]
    pub damping: f64,
    /// [N]
    pub most: f64,
    /// Whether the bound acts, as long as a series holds.
    pub bounded: bool,
}

impl Held {
    /// The world's hold, if it is on a node that can be pushed; `point` is the node that it holds in place of a centre, if it does.
    pub fn of(world: &World, nodes: &Nodes, point: Option<usize>) -> Option<Held> {
        let grip = world.grip.as_ref()?;
        let body = world.bodies.index_of(grip.body)?;
        let node = nodes.body.iter().position(|b| *b == body as u32)?;
        (nodes.w[node] > 0.0).then(|| Held::new(grip, point.unwrap_or(node), world.bodies.mass[body]))
    }

    fn new(grip: &Grip, node: usize, mass: f64) -> Held {
        let omega = TAU * grip.frequency;
        let (stiffness, damping) = (mass * omega * omega, 2.0 * grip.damping_ratio * mass * omega);
        Held { node, target: grip.target, stiffness, damping, most: grip.max_force, bounded: false }
    }

    /// Spring and damper without the bound [N].
    pub fn unbounded(&self, nodes: &Nodes) -> DVec2 {
        let i = self.node;
        let away = DVec2::new(nodes.x[i], nodes.y[i]) - self.target;
        -self.stiffness * away - self.damping * DVec2::new(nodes.vx[i], nodes.vy[i])
    }

    /// The force on the node [N].
    pub fn force(&self, nodes: &Nodes) -> DVec2 {
        let force = self.unbounded(nodes);
        let size = force.length();
        if size > self.most { force * (self.most / size) } else { force }
    }
}
