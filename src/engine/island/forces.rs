//! Forces of an island: springs with dampers, the mouse's hold, gravity and drag.

use super::Nodes;
use super::lanes::Largest;
use super::pairs::Pairs;
use crate::engine::constraint::Grip;
use crate::engine::world::World;
use glam::DVec2;
use std::f64::consts::TAU;

/// Springs that are worked off side by side.
const SIDE: usize = 32;

/// Springs between nodes: force k (|d| − rest) + c d|d|/dt, pulling.
#[derive(Clone, Debug, Default)]
pub(crate) struct Springs {
    pub a: Vec<u32>,
    pub b: Vec<u32>,
    /// The same, for loops over all; made by [`Springs::finish`].
    pub pairs: Pairs,
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

    /// Finds the runs among the springs, once all are in.
    pub fn finish(&mut self) {
        self.pairs = Pairs::new(&self.a, &self.b);
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

    /// The same without dampers, some springs side by side.
    fn add_elastic_forces(&self, nodes: &Nodes, fx: &mut [f64], fy: &mut [f64]) {
        let (mut dx, mut dy) = ([0.0; SIDE], [0.0; SIDE]);
        for block in self.pairs.blocks::<SIDE>() {
            let range = block.range();
            let n = range.len();
            let (dx, dy) = (&mut dx[..n], &mut dy[..n]);
            block.differences(&nodes.x, dx);
            block.differences(&nodes.y, dy);
            let (rest, stiffness) = (&self.rest[range.clone()][..n], &self.stiffness[range][..n]);
            for i in 0..n {
                let square = dx[i] * dx[i] + dy[i] * dy[i];
                let pull = stiffness[i] * (rest[i] / square.sqrt() - 1.0);
                // Coinciding ends have no direction.
                let factor = if square > 0.0 { pull } else { 0.0 };
                (dx[i], dy[i]) = (factor * dx[i], factor * dy[i]);
            }
            block.add(dx, fx);
            block.add(dy, fy);
        }
    }

    /// Adds the absolute values of the stiffness matrix by rows, half of them: for each end's x and y [N/m].
    pub fn add_loads(&self, nodes: &Nodes, x: &mut [f64], y: &mut [f64]) {
        let (mut dx, mut dy) = ([0.0; SIDE], [0.0; SIDE]);
        for block in self.pairs.blocks::<SIDE>() {
            let range = block.range();
            let n = range.len();
            let (dx, dy) = (&mut dx[..n], &mut dy[..n]);
            block.differences(&nodes.x, dx);
            block.differences(&nodes.y, dy);
            let (rest, stiffness) = (&self.rest[range.clone()][..n], &self.stiffness[range][..n]);
            for i in 0..n {
                let (xx, yy, xy) = (dx[i] * dx[i], dy[i] * dy[i], (dx[i] * dy[i]).abs());
                let square = xx + yy;
                let k = stiffness[i];
                let tension = k * (1.0 - rest[i] / square.sqrt()).abs();
                let over = k / square;
                let (along_x, along_y) = (over * (xx + xy) + tension, over * (yy + xy) + tension);
                (dx[i], dy[i]) = if square > 0.0 { (along_x, along_y) } else { (0.0, 0.0) };
            }
            block.add_to_both(dx, x);
            block.add_to_both(dy, y);
        }
    }

    /// Largest change of a spring's difference since the nodes stood at `x` and `y`, in parts of the shorter of both; NaN if one is.
    /// Springs without a rest length pull to a point, whatever their direction.
    pub fn largest_turn(&self, nodes: &Nodes, x: &[f64], y: &[f64]) -> f64 {
        let [mut dx, mut dy, mut ex, mut ey] = [[0.0; SIDE]; 4];
        let mut largest = Largest::default();
        for block in self.pairs.blocks::<SIDE>() {
            let range = block.range();
            let n = range.len();
            let rest = &self.rest[range][..n];
            for (from, to) in [(x, &mut dx), (y, &mut dy), (&nodes.x[..], &mut ex), (&nodes.y[..], &mut ey)] {
                block.differences(from, &mut to[..n]);
            }
            for i in 0..n {
                let (cx, cy) = (ex[i] - dx[i], ey[i] - dy[i]);
                let (before, after) = (dx[i] * dx[i] + dy[i] * dy[i], ex[i] * ex[i] + ey[i] * ey[i]);
                let shorter = if before < after { before } else { after };
                let moved = cx * cx + cy * cy;
                dx[i] = if rest[i] > 0.0 && moved > 0.0 { moved / shorter } else { 0.0 };
            }
            largest.take(&dx[..n]);
        }
        largest.value().sqrt()
    }

    /// Whether a spring whose force depends on where it points points backwards, seen from when the nodes stood at
    /// `x` and `y`.
    pub fn turn_over(&self, nodes: &Nodes, x: &[f64], y: &[f64]) -> bool {
        self.turn_beyond(nodes, x, y, 0.0)
    }

    /// The same where it has turned by more than an angle with this `cosine` ≥ 0. With neither rest length nor damper
    /// the force is as smooth near zero length as elsewhere.
    pub fn turn_beyond(&self, nodes: &Nodes, x: &[f64], y: &[f64], cosine: f64) -> bool {
        let [mut dx, mut dy, mut ex, mut ey] = [[0.0; SIDE]; 4];
        self.pairs.blocks::<SIDE>().any(|block| {
            let range = block.range();
            let n = range.len();
            for (from, to) in [(x, &mut dx), (y, &mut dy), (&nodes.x[..], &mut ex), (&nodes.y[..], &mut ey)] {
                block.differences(from, &mut to[..n]);
            }
            let (rest, damping) = (&self.rest[range.clone()][..n], &self.damping[range][..n]);
            (0..n).any(|i| {
                let along = dx[i] * ex[i] + dy[i] * ey[i];
                let squares = (dx[i] * dx[i] + dy[i] * dy[i]) * (ex[i] * ex[i] + ey[i] * ey[i]);
                let far = along < 0.0 || along * along < cosine * cosine * squares;
                (rest[i] > 0.0 || damping[i] > 0.0) && far
            })
        })
    }

    /// Writes the springs' forces, as multipliers (λ, 0) [N].
    pub fn store(&self, nodes: &Nodes, force: &mut [DVec2]) {
        let (mut dx, mut dy) = ([0.0; SIDE], [0.0; SIDE]);
        for block in self.pairs.blocks::<SIDE>() {
            let range = block.range();
            let n = range.len();
            let (dx, dy) = (&mut dx[..n], &mut dy[..n]);
            block.differences(&nodes.x, dx);
            block.differences(&nodes.y, dy);
            let (rest, stiffness) = (&self.rest[range.clone()][..n], &self.stiffness[range.clone()][..n]);
            if self.damped {
                let first = range.start;
                (0..n).for_each(|i| {
                    let length = (dx[i] * dx[i] + dy[i] * dy[i]).sqrt();
                    dx[i] = self.factor(first + i, (dx[i], dy[i]), nodes) * length;
                });
            } else {
                for i in 0..n {
                    let square = dx[i] * dx[i] + dy[i] * dy[i];
                    dx[i] = if square > 0.0 { stiffness[i] * (rest[i] - square.sqrt()) } else { 0.0 };
                }
            }
            for (constraint, lambda) in self.constraint[range].iter().zip(dx) {
                force[*constraint as usize] = DVec2::new(*lambda, 0.0);
            }
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
