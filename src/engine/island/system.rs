//! An island's equations: nodes, rods and ropes, springs, pins, the mouse's hold, gravity and drag.
//!
//! M a = f + Jᵀλ, with C = ½ (|d|² − L²) for a rod from a to b, d = x_b − x_a, so that J = (−dᵀ, dᵀ) is linear in the
//! positions; λ d is then the force on b, and λ L the multiplier [N] that every solver of the engine reports. A pin has
//! C = d, two rows. Where anchors are off the centres of discs the angles are unknowns as well: see [`super::turning`].

use super::Nodes;
use super::forces::{Held, Springs};
use super::matrix::Matrix;
use super::pairs::{self, Pairs};
use super::turning::Turning;
use crate::engine::constraint::{Foresight, Kind, WORLD};
use crate::engine::method::LinearSolver;
use crate::engine::world::World;
use glam::DVec2;

/// Distances that are kept: rods, and ropes while they are taut.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rods {
    /// Nodes at the ends.
    pub a: Vec<u32>,
    pub b: Vec<u32>,
    /// The same, for loops over all.
    pub pairs: Pairs,
    /// L [m] and L² [m²]
    pub length: Vec<f64>,
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
    /// What was found about the steps to come.
    pub foresight: Foresight,
    /// Size of the island at the start of the step [m]: errors are measured in parts of it.
    pub length: f64,
    /// The longest rod [m].
    longest: f64,
    /// Analysed when it is first filled: the midpoint rule has one of its own.
    pub matrix: Matrix,
    /// What solves it, and in how many sweeps at most.
    solver: (LinearSolver, u32),
    /// d = x_b − x_a of the rods, at the positions that the matrix was filled for.
    pub dx: Vec<f64>,
    pub dy: Vec<f64>,
    /// d that the matrix was last factored for.
    factored: [Vec<f64>; 2],
    /// Differences of something else, by rod.
    pub scratch: [Vec<f64>; 2],
    /// Right-hand side and solution: rods, then two rows a pin.
    pub rhs: Vec<f64>,
    /// Ropes that a step has left too long.
    pub(super) long: Vec<usize>,
}

impl System {
    /// The island of these bodies and constraints (dense indices, ascending), with what solves its rows and in how many sweeps.
    ///
    /// Nodes are numbered as the bodies are, fixed ones among them, and rods and springs sorted along them, so that rows of a
    /// rope, a net or a cloth become runs ([`Pairs`]).
    pub fn new(world: &World, bodies: &[u32], constraints: &[u32], solver: (LinearSolver, u32)) -> System {
        let mut system = System { gravity: world.gravity, drag: world.drag, ..System::default() };
        let c = &world.constraints;
        let ends = constraints.iter().flat_map(|i| [c.a[*i as usize], c.b[*i as usize]]);
        let mut all: Vec<u32> = bodies.iter().copied().chain(ends.filter(|body| *body != WORLD)).collect();
        all.sort_unstable();
        all.dedup();
        for body in &all {
            let (i, own) = (*body as usize, bodies.binary_search(body).is_ok());
            let position = world.bodies.position[i];
            let inverse_mass = if own { world.bodies.inverse_mass[i] } else { 0.0 };
            system.nodes.push(*body, position.x, position.y, inverse_mass);
        }
        let mut joined: Vec<_> = constraints.iter().map(|i| (system.ends(world, &all, *i as usize), *i)).collect();
        joined.sort_by_key(|((a, b), i)| {
            let is_rope = matches!(c.kind[*i as usize], Kind::Rope { .. });
            (is_rope, pairs::order(*a, *b), *i)
        });
        joined.into_iter().for_each(|((a, b), i)| system.add_constraint(world, a, b, i));
        system.turning.hold(world, &mut system.nodes);
        let rows = system.rods.a.len();
        (system.dx, system.dy) = (vec![0.0; rows], vec![0.0; rows]);
        system.scratch = [vec![0.0; rows], vec![0.0; rows]];
        system.rhs = vec![0.0; rows + 2 * system.pins.a.len()];
        system.rods.pairs = Pairs::new(&system.rods.a, &system.rods.b);
        system.springs.finish();
        system.solver = solver;
        system
    }

    /// Nodes at the ends of a constraint; those of rods, ropes and springs, which have no direction, ascending.
    fn ends(&mut self, world: &World, bodies: &[u32], constraint: usize) -> (u32, u32) {
        let c = &world.constraints;
        let mut end = |body: u32, at: DVec2| match bodies.binary_search(&body) {
            Ok(node) => self.turning.anchor(world, &mut self.nodes, node as u32, at),
            // An anchor in the world.
            Err(_) => self.nodes.push(WORLD, at.x, at.y, 0.0),
        };
        let (a, b) = (end(c.a[constraint], c.at_a[constraint]), end(c.b[constraint], c.at_b[constraint]));
        let directed = matches!(c.kind[constraint], Kind::Pin);
        if directed || a <= b { (a, b) } else { (b, a) }
    }

    fn add_constraint(&mut self, world: &World, a: u32, b: u32, constraint: u32) {
        let (c, i) = (&world.constraints, constraint as usize);
        match c.kind[i] {
            Kind::Rod { length } | Kind::Rope { length } => {
                let rods = &mut self.rods;
                rods.a.push(a);
                rods.b.push(b);
                rods.length.push(length);
                rods.square.push(length * length);
                self.longest = self.longest.max(length);
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

    /// Diagonal of the box around all nodes, or the longest rod or spring if that is longer; 1 m for a single point.
    fn measure(&self) -> f64 {
        let [width, height] = self.nodes.extent();
        let size = (width * width + height * height).sqrt().max(self.longest);
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
        let rods = &mut self.rods;
        for ((lambda, constraint), length) in rods.lambda.iter_mut().zip(&rods.constraint).zip(&rods.length) {
            *lambda = force[*constraint as usize].x / length;
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
        let rods = &self.rods;
        let multipliers = rods.lambda.iter().zip(&rods.length).zip(&rods.held);
        for (constraint, ((lambda, length), held)) in rods.constraint.iter().zip(multipliers) {
            let lambda = if *held { lambda * length } else { 0.0 };
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

    /// Takes note whether the hold's bound acts now; returns whether that is news.
    pub fn see_bound(&mut self) -> bool {
        let Some(held) = &mut self.held else { return false };
        let bounded = held.unbounded(&self.nodes).length() > held.most;
        std::mem::replace(&mut held.bounded, bounded) != bounded
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
        // A step begins where the last one ended: its matrix is there already. Ropes change it without moving.
        let [fx, fy] = &mut self.factored;
        if *fx == self.dx && *fy == self.dy && self.matrix.analysed() && self.rods.first_rope == self.rods.a.len() {
            return;
        }
        if !self.matrix.analysed() {
            self.matrix = Matrix::new(&self.nodes, &self.rods, &self.pins, self.solver);
        }
        fx.clone_from(&self.dx);
        fy.clone_from(&self.dy);
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
        self.rods.pairs.differences(&self.nodes.x, &mut self.dx);
        self.rods.pairs.differences(&self.nodes.y, &mut self.dy);
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
    rods.pairs.push(w, lambda, dx, x);
    rods.pairs.push(w, lambda, dy, y);
    let pinned = lambda[rods.a.len()..].chunks_exact(2);
    for ((a, b), lambda) in pins.a.iter().zip(&pins.b).zip(pinned) {
        let (a, b) = (*a as usize, *b as usize);
        x[a] -= w[a] * lambda[0];
        y[a] -= w[a] * lambda[1];
        x[b] += w[b] * lambda[0];
        y[b] += w[b] * lambda[1];
    }
}
