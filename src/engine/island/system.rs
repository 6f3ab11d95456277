//! An island's equations: nodes, rods and ropes, springs, pins, the mouse's hold, gravity and drag.
//!
//! M a = f + Jᵀλ, with C = ½ (|d|² − L²) for a rod from a to b, d = x_b − x_a, so that J = (−dᵀ, dᵀ) is linear in the
//! positions; λ d is then the force on b, and λ L the multiplier [N] that every solver of the engine reports. A pin has
//! C = d, two rows. Where anchors are off the centres of discs the angles are unknowns as well: see [`super::turning`].

use super::Nodes;
use super::forces::{Held, Springs};
use super::matrix::Matrix;
use super::turning::Turning;
use crate::engine::constraint::{Kind, WORLD};
use crate::engine::method::LinearSolver;
use crate::engine::world::World;
use glam::DVec2;

/// Distances that are kept: rods, and ropes while they are taut.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rods {
    /// Nodes at the ends.
    pub a: Vec<u32>,
    pub b: Vec<u32>,
    /// L² [m²]
    pub square: Vec<f64>,
    /// Index in the world's list.
    pub constraint: Vec<u32>,
    /// Ropes only pull; they come after all rods.
    pub first_rope: usize,
    /// Whether the row is in force; a rod's always is.
    pub held: Vec<bool>,
    /// λ at the end of the last step [N/m]; 0 for a slack rope.
    pub lambda: Vec<f64>,
}

/// Ends that coincide.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pins {
    pub a: Vec<u32>,
    pub b: Vec<u32>,
    pub constraint: Vec<u32>,
    /// Force on b [N].
    pub lambda: Vec<DVec2>,
}

/// One island.
#[derive(Clone, Debug, Default)]
pub(crate) struct System {
    pub nodes: Nodes,
    pub rods: Rods,
    pub pins: Pins,
    pub springs: Springs,
    /// Discs that anchors turn.
    pub turning: Turning,
    pub gravity: DVec2,
    /// [1/s]
    pub drag: f64,
    pub held: Option<Held>,
    /// Size of the island at the start of the step [m]: errors are measured in parts of it.
    pub length: f64,
    /// Analysed when it is first filled: the midpoint rule has one of its own.
    pub matrix: Matrix,
    /// What solves it, and in how many sweeps at most.
    solver: (LinearSolver, u32),
    /// d = x_b − x_a of the rods, at the positions that the matrix was filled for.
    pub dx: Vec<f64>,
    pub dy: Vec<f64>,
    /// Right-hand side and solution: rods, then two rows a pin.
    pub rhs: Vec<f64>,
}

impl System {
    /// The island of these bodies and constraints (dense indices, ascending), with what solves its rows and in how many sweeps.
    pub fn new(world: &World, bodies: &[u32], constraints: &[u32], solver: (LinearSolver, u32)) -> System {
        let mut system = System { gravity: world.gravity, drag: world.drag, ..System::default() };
        for body in bodies {
            let i = *body as usize;
            let position = world.bodies.position[i];
            system.nodes.push(*body, position.x, position.y, world.bodies.inverse_mass[i]);
        }
        let is_rope = |c: &&u32| matches!(world.constraints.kind[**c as usize], Kind::Rope { .. });
        let rods = constraints.iter().filter(|c| !is_rope(c));
        for constraint in rods.chain(constraints.iter().filter(is_rope)) {
            system.add_constraint(world, bodies, *constraint);
        }
        system.turning.hold(world, &mut system.nodes, bodies.len());
        let rows = system.rods.a.len();
        (system.dx, system.dy) = (vec![0.0; rows], vec![0.0; rows]);
        system.rhs = vec![0.0; rows + 2 * system.pins.a.len()];
        system.solver = solver;
        system
    }

    fn add_constraint(&mut self, world: &World, bodies: &[u32], constraint: u32) {
        let (c, i) = (&world.constraints, constraint as usize);
        let mut end = |body: u32, at: DVec2| {
            if body == WORLD {
                return self.nodes.push(WORLD, at.x, at.y, 0.0);
            }
            let node = match bodies.binary_search(&body) {
                Ok(node) => node as u32,
                Err(_) => self.fixed_node(world, body),
            };
            self.turning.anchor(world, &mut self.nodes, node, at)
        };
        let (a, b) = (end(c.a[i], c.at_a[i]), end(c.b[i], c.at_b[i]));
        match c.kind[i] {
            Kind::Rod { length } | Kind::Rope { length } => {
                let rods = &mut self.rods;
                rods.a.push(a);
                rods.b.push(b);
                rods.square.push(length * length);
                rods.constraint.push(constraint);
                rods.lambda.push(0.0);
                let rope = matches!(c.kind[i], Kind::Rope { .. });
                rods.held.push(!rope);
                if !rope {
                    rods.first_rope = rods.a.len();
                }
            }
            Kind::Spring { rest, stiffness, damping } => {
                self.springs.push([a, b], rest, stiffness * world.tuning.stiffness, damping, constraint);
            }
            Kind::Pin => {
                self.pins.a.push(a);
                self.pins.b.push(b);
                self.pins.constraint.push(constraint);
                self.pins.lambda.push(DVec2::ZERO);
            }
        }
    }

    /// The node of a body that no constraint can move, shared by all that hang on it.
    fn fixed_node(&mut self, world: &World, body: u32) -> u32 {
        match self.nodes.body.iter().position(|known| *known == body) {
            Some(node) => node as u32,
            None => {
                let position = world.bodies.position[body as usize];
                self.nodes.push(body, position.x, position.y, 0.0)
            }
        }
    }

    /// Diagonal of the box around all nodes, or the longest rod or spring if that is longer; 1 m for a single point.
    fn measure(&self) -> f64 {
        let span = |values: &[f64]| {
            let fold = |(low, high): (f64, f64), v: &f64| (low.min(*v), high.max(*v));
            let (low, high) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), fold);
            high - low
        };
        let size = span(&self.nodes.x).hypot(span(&self.nodes.y));
        let longest = self.rods.square.iter().fold(0.0f64, |l, s| l.max(s.sqrt()));
        let size = size.max(longest);
        if size > 0.0 && size.is_finite() { size } else { 1.0 }
    }

    /// Reads the bodies, and the hold if it is on one of them. `h` is the length of the step to come [s].
    pub fn load(&mut self, world: &World, h: f64) {
        self.nodes.load(world, h);
        if self.turns() {
            self.turning.load(world, &mut self.nodes);
        }
        // The multipliers are where iterations begin: from the world, so that a fresh stepper goes on with the same bits.
        let force = &world.constraints.force;
        for ((lambda, constraint), square) in
            self.rods.lambda.iter_mut().zip(&self.rods.constraint).zip(&self.rods.square)
        {
            *lambda = force[*constraint as usize].x / square.sqrt();
        }
        for (lambda, constraint) in self.pins.lambda.iter_mut().zip(&self.pins.constraint) {
            *lambda = force[*constraint as usize];
        }
        self.held = Held::of(world, &self.nodes, self.turning.held_point());
        self.length = self.measure();
    }

    /// Writes the bodies and the multipliers back.
    pub fn store(&self, world: &mut World) {
        self.nodes.store(world);
        self.turning.store(world);
        let force = &mut world.constraints.force;
        for (r, constraint) in self.rods.constraint.iter().enumerate() {
            let lambda = if self.rods.held[r] { self.rods.lambda[r] * self.rods.square[r].sqrt() } else { 0.0 };
            force[*constraint as usize] = DVec2::new(lambda, 0.0);
        }
        for (constraint, lambda) in self.pins.constraint.iter().zip(&self.pins.lambda) {
            force[*constraint as usize] = *lambda;
        }
        self.springs.store(&self.nodes, force);
        if let (Some(held), Some(grip)) = (&self.held, &mut world.grip) {
            grip.force = held.force(&self.nodes);
        }
    }

    /// Takes note whether the hold's bound acts now.
    pub fn see_bound(&mut self) {
        if let Some(held) = &mut self.held {
            held.bounded = held.unbounded(&self.nodes).length() > held.most;
        }
    }

    /// Whether nothing but forces acts.
    pub fn unconstrained(&self) -> bool {
        self.rods.a.is_empty() && self.pins.a.is_empty()
    }

    /// Fills the matrix for the present positions and factors it.
    pub fn factor(&mut self) {
        self.take_differences();
        if self.turns() {
            return self.factor_turning(self.solver);
        }
        if !self.matrix.analysed() {
            self.matrix = Matrix::new(&self.nodes, &self.rods, &self.pins, self.solver);
        }
        self.matrix.factor(&self.rods, &self.dx, &self.dy);
    }

    /// The same, if there is anything to factor.
    pub fn factor_if_constrained(&mut self) {
        if !self.unconstrained() {
            self.factor();
        }
    }

    /// d of every rod at the present positions.
    pub fn take_differences(&mut self) {
        let (rods, nodes) = (&self.rods, &self.nodes);
        let ends = rods.a.iter().zip(&rods.b);
        for (((a, b), dx), dy) in ends.zip(&mut self.dx).zip(&mut self.dy) {
            *dx = nodes.x[*b as usize] - nodes.x[*a as usize];
            *dy = nodes.y[*b as usize] - nodes.y[*a as usize];
        }
    }

    /// Adds M⁻¹ Jᵀ `self.rhs` to vectors by node, with the d that the matrix was filled for.
    pub fn push(&self, x: &mut [f64], y: &mut [f64]) {
        push(&self.nodes.w, &self.rods, &self.pins, (&self.dx, &self.dy), &self.rhs, x, y);
    }
}

/// Adds M⁻¹ Jᵀ λ to vectors by node.
pub(crate) fn push(
    w: &[f64],
    rods: &Rods,
    pins: &Pins,
    (dx, dy): (&[f64], &[f64]),
    lambda: &[f64],
    x: &mut [f64],
    y: &mut [f64],
) {
    for ((((a, b), dx), dy), lambda) in rods.a.iter().zip(&rods.b).zip(dx).zip(dy).zip(lambda) {
        let (a, b) = (*a as usize, *b as usize);
        let (fx, fy) = (lambda * dx, lambda * dy);
        x[a] -= w[a] * fx;
        y[a] -= w[a] * fy;
        x[b] += w[b] * fx;
        y[b] += w[b] * fy;
    }
    let pinned = lambda[rods.a.len()..].chunks_exact(2);
    for ((a, b), lambda) in pins.a.iter().zip(&pins.b).zip(pinned) {
        let (a, b) = (*a as usize, *b as usize);
        x[a] -= w[a] * lambda[0];
        y[a] -= w[a] * lambda[1];
        x[b] += w[b] * lambda[0];
        y[b] += w[b] * lambda[1];
    }
}
