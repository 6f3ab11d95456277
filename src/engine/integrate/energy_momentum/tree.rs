//! One step of an island that is a tree: chains, ropes, pendulums, springs in a row, all in linear time.
//!
//! Rods are never off their length: the unknown of a rod is its turn s, by which d' becomes R(s) d', and its multiplier
//! follows from the balance of the node's forces along d_m. What is left is one equation a rod, the balance across d_m. Newton's
//! matrix for it is eliminated from the leaves to the root, as the articulated bodies of Featherstone (1983): all that hangs on a
//! node is a 2 × 2 stiffness K and a force g that is not balanced.
//!
//! ```text
//! node:     K x = g + F          F = −S e + d_m μ,   S = −λ/2 + springs beside the rod
//! turn:     x = x_parent + s τ',   D s = τ_m·(g − K x_parent),   D = τ_mᵀ (K + S) τ'
//! parent:   K̂ = K − K τ' τ_mᵀ K / D,   ĝ = g − K τ' s₀
//! ```
//!
//! One division a rod and iteration is on the critical path. The derivative is exact though not symmetric: d' ≠ d_m. One more
//! rod to a fixed point, as at the far end of a bridge, is taken in by its Schur complement, one number. With the multipliers and
//! C = 0 among Newton's unknowns it would be twice the work, and an iteration more.

use super::discrete::{self, Linear};
use super::{Progress, TURN};
use crate::engine::island::System;
use crate::engine::island::forest::{self, Forest, Join, NONE, Tie};
use glam::DVec2;

/// A node and its link to the parent, differences taken from the parent to the node.
#[derive(Clone, Copy, Debug, Default)]
struct Link {
    /// Index of the parent in the list, or none if it is fixed or there is none.
    parent: u32,
    /// The link as it is in this step.
    join: Join,
    /// The node's mass [kg].
    mass: f64,
    /// Difference at the start and at the end [m].
    dx: f64,
    dy: f64,
    nx: f64,
    ny: f64,
    /// The node's own force b − a u: inertia and drag, gravity.
    a: f64,
    bx: f64,
    by: f64,
    /// How far the node moves.
    ux: f64,
    uy: f64,
    /// Multiplier of a rod.
    lambda: f64,
    /// s = turn + μ closing − p·x_parent
    turn: f64,
    closing: f64,
    px: f64,
    py: f64,
}

/// Of a node that no rod holds: x = c + N x_parent, and c of the closing rod's unit multiplier; a pin's force.
#[derive(Clone, Copy, Debug, Default)]
struct Loose {
    cx: f64,
    cy: f64,
    cx2: f64,
    cy2: f64,
    n: [f64; 4],
    force: DVec2,
}

/// What acts on a link and a node besides a rod and inertia.
#[derive(Clone, Copy, Debug, Default)]
struct Extra {
    link: Linear,
    node: Linear,
}

/// A spring of the tree.
#[derive(Clone, Copy, Debug)]
struct SpringPlace {
    spring: u32,
    at: u32,
    /// The fixed node at its other end, or none if it lies along the link.
    ground: u32,
    dx: f64,
    dy: f64,
}

/// A rod from a node to a fixed one that is no link of the tree.
#[derive(Clone, Copy, Debug, Default)]
struct Closing {
    rod: u32,
    at: u32,
    ground: u32,
    dx: f64,
    dy: f64,
    ex: f64,
    ey: f64,
    lambda: f64,
}

/// What a node hands to its parent.
#[derive(Clone, Copy, Debug, Default)]
struct Carry {
    /// K, row by row.
    k: [f64; 4],
    /// Force that is not balanced [N].
    gx: f64,
    gy: f64,
    /// Force of the links.
    fx: f64,
    fy: f64,
    /// g of the closing rod's unit multiplier.
    hx: f64,
    hy: f64,
}

impl Carry {
    fn add(&mut self, more: &Carry) {
        self.k.iter_mut().zip(more.k).for_each(|(to, more)| *to += more);
        self.gx += more.gx;
        self.gy += more.gy;
        self.fx += more.fx;
        self.fy += more.fy;
        self.hx += more.hx;
        self.hy += more.hy;
    }
}

/// The tree of an island and the unknowns of a step.
#[derive(Debug, Default)]
pub(super) struct Tree {
    /// Of the island, parents first.
    node: Vec<u32>,
    /// Node of the island at the other end of the link, or none.
    parent_node: Vec<u32>,
    tie: Vec<Tie>,
    links: Vec<Link>,
    loose: Vec<Loose>,
    extras: Vec<Extra>,
    springs: Vec<SpringPlace>,
    closing: Option<Closing>,
    /// What a node's children that do not come right after it hand over; empty if there are none.
    branches: Vec<Carry>,
    /// The corrections of all nodes, and those under the closing rod's unit multiplier; empty if there are no branches.
    moved: Vec<[f64; 4]>,
    h: f64,
}

impl Tree {
    /// The tree of an island, or none if rods or springs close loops.
    pub fn new(system: &System) -> Option<Tree> {
        let forest = Forest::new(system)?;
        let mut tree = Tree::default();
        for (node, parent) in forest.node.iter().zip(&forest.parent) {
            let mass = 1.0 / system.nodes.w[*node as usize];
            tree.links.push(Link { parent: *parent, mass, ..Link::default() });
        }
        if forest.branched {
            tree.branches = vec![Carry::default(); forest.len()];
            tree.moved = vec![[0.0; 4]; forest.len()];
        }
        tree.loose = vec![Loose::default(); forest.len()];
        tree.extras = vec![Extra::default(); forest.len()];
        let place =
            |p: &forest::SpringPlace| SpringPlace { spring: p.spring, at: p.at, ground: p.ground, dx: 0.0, dy: 0.0 };
        tree.springs = forest.springs.iter().map(place).collect();
        let closing = |c: forest::Closing| Closing { rod: c.rod, at: c.at, ground: c.ground, ..Closing::default() };
        tree.closing = forest.closing.map(closing);
        (tree.node, tree.parent_node, tree.tie) = (forest.node, forest.parent_node, forest.tie);
        Some(tree)
    }

    /// Solves for a step of `h` seconds; the island is left as it is. Returns whether it went well, and in how many iterations.
    pub fn solve(&mut self, system: &System, h: f64, tight: f64) -> (bool, u32) {
        self.begin(system, h);
        let extra = !self.springs.is_empty() || self.closing.is_some() || system.held.is_some();
        let mut progress = Progress { tight, ..Progress::default() };
        while progress.goes_on() {
            // The multipliers of a first guess, which has no angular accelerations, are less right than the last step's.
            let first = progress.iterations == 0;
            if extra {
                self.evaluate(system);
            }
            match (extra, self.closing.is_some()) {
                (false, _) => self.eliminate::<false, false>(first),
                (true, false) => self.eliminate::<true, false>(first),
                (true, true) => self.eliminate::<true, true>(first),
            }
            let mu = self.close(system);
            progress.quadratic(self.correct(system, mu));
        }
        (progress.converged && self.turned_little(system), progress.iterations)
    }

    /// The first guess: every node goes on with its velocity, every rod turns on with its own.
    fn begin(&mut self, system: &System, h: f64) {
        self.h = h;
        let (nodes, rods) = (&system.nodes, &system.rods);
        let (inertia, drag) = (2.0 / (h * h), system.drag / h);
        for t in 0..self.links.len() {
            let (i, tie) = (self.node[t] as usize, self.tie[t]);
            let (fx, fy) = self.parent_move(system, t);
            let link = &mut self.links[t];
            let (vx, vy) = (nodes.vx[i], nodes.vy[i]);
            link.a = link.mass * (inertia + drag);
            link.bx = link.mass * (inertia * h * vx + system.gravity.x);
            link.by = link.mass * (inertia * h * vy + system.gravity.y);
            (link.ux, link.uy) = (h * vx, h * vy);
            link.join = Join::Free;
            if self.parent_node[t] == NONE {
                continue;
            }
            let p = self.parent_node[t] as usize;
            (link.dx, link.dy) = (nodes.x[i] - nodes.x[p], nodes.y[i] - nodes.y[p]);
            match tie.join {
                Join::Rod if rods.held[tie.index as usize] => {
                    let r = tie.index as usize;
                    link.join = Join::Rod;
                    link.lambda = rods.lambda[r];
                    let across = link.dx * (vy - nodes.vy[p]) - link.dy * (vx - nodes.vx[p]);
                    let square = rods.square[r];
                    let over = 1.0 / square;
                    (link.nx, link.ny) = turned(link.dx, link.dy, h * across * over);
                    // What rounding has taken from the length comes back.
                    let right = 1.0 + 0.5 * over * (square - link.dx * link.dx - link.dy * link.dy);
                    (link.nx, link.ny) = (right * link.nx, right * link.ny);
                    (link.ux, link.uy) = (fx + (link.nx - link.dx), fy + (link.ny - link.dy));
                }
                Join::Pin => {
                    link.join = Join::Pin;
                    (link.ux, link.uy) = (fx - link.dx, fy - link.dy);
                }
                _ => {}
            }
        }
        for place in &mut self.springs {
            let i = self.node[place.at as usize] as usize;
            let other = if place.ground == NONE { self.parent_node[place.at as usize] } else { place.ground } as usize;
            (place.dx, place.dy) = (nodes.x[i] - nodes.x[other], nodes.y[i] - nodes.y[other]);
        }
        if let Some(closing) = &mut self.closing {
            let (i, ground) = (self.node[closing.at as usize] as usize, closing.ground as usize);
            (closing.dx, closing.dy) = (nodes.x[i] - nodes.x[ground], nodes.y[i] - nodes.y[ground]);
            closing.lambda = rods.lambda[closing.rod as usize];
        }
    }

    /// How far the parent of t goes: nothing if there is none.
    #[inline(always)]
    fn parent_move(&self, system: &System, t: usize) -> (f64, f64) {
        match (self.links[t].parent, self.parent_node[t]) {
            (NONE, NONE) => (0.0, 0.0),
            (NONE, p) => (self.h * system.nodes.vx[p as usize], self.h * system.nodes.vy[p as usize]),
            (parent, _) => (self.links[parent as usize].ux, self.links[parent as usize].uy),
        }
    }

    /// Springs, the hold, and the closing rod's present force.
    fn evaluate(&mut self, system: &System) {
        let (nodes, h) = (&system.nodes, self.h);
        self.extras.fill(Extra::default());
        for place in &self.springs {
            let (at, d) = (place.at as usize, (place.dx, place.dy));
            let link = &self.links[at];
            let (fx, fy) = if place.ground == NONE {
                self.parent_move(system, at)
            } else {
                let g = place.ground as usize;
                (h * nodes.vx[g], h * nodes.vy[g])
            };
            let found = discrete::spring(&system.springs, place.spring as usize, d, (link.ux - fx, link.uy - fy), h);
            let extra = &mut self.extras[at];
            add(if place.ground == NONE { &mut extra.link } else { &mut extra.node }, found);
        }
        if let Some(held) = &system.held
            && let Some(at) = self.node.iter().position(|node| *node as usize == held.node)
        {
            let (start, link) = (DVec2::new(nodes.x[held.node], nodes.y[held.node]), &self.links[at]);
            add(&mut self.extras[at].node, discrete::hold(held, start, DVec2::new(link.ux, link.uy), h));
        }
        if let Some(closing) = &mut self.closing {
            let (link, g) = (&self.links[closing.at as usize], closing.ground as usize);
            (closing.ex, closing.ey) = (link.ux - h * nodes.vx[g], link.uy - h * nodes.vy[g]);
            let (mx, my) = (closing.dx + 0.5 * closing.ex, closing.dy + 0.5 * closing.ey);
            let lambda = if system.rods.held[closing.rod as usize] { closing.lambda } else { 0.0 };
            let k = [-0.5 * lambda, 0.0, 0.0, -0.5 * lambda];
            add(&mut self.extras[closing.at as usize].node, Linear { fx: lambda * mx, fy: lambda * my, k });
        }
    }

    /// From the leaves to the root. With `first` the stiffness takes the multipliers of the step before.
    fn eliminate<const EXTRA: bool, const CLOSED: bool>(&mut self, first: bool) {
        let branched = !self.branches.is_empty();
        if branched {
            self.branches.fill(Carry::default());
        }
        let closing = self.closing.unwrap_or_default();
        let mut carry = Carry::default();
        for (t, link) in self.links.iter_mut().enumerate().rev() {
            if branched {
                carry.add(&self.branches[t]);
            }
            carry.k[0] += link.a;
            carry.k[3] += link.a;
            carry.fx += link.bx - link.a * link.ux;
            carry.fy += link.by - link.a * link.uy;
            let mut beside = Linear::default();
            if EXTRA {
                let Extra { link, node } = &self.extras[t];
                (0..4).for_each(|i| carry.k[i] += node.k[i]);
                carry.fx += node.fx;
                carry.fy += node.fy;
                beside = *link;
            }
            if CLOSED && t == closing.at as usize {
                carry.hx += closing.dx + 0.5 * closing.ex;
                carry.hy += closing.dy + 0.5 * closing.ey;
            }
            carry = match link.join {
                Join::Rod => link.pass_rod::<EXTRA, CLOSED>(&carry, &beside, first),
                Join::Pin => self.loose[t].pass_pin(&carry),
                Join::Free => self.loose[t].pass_free(&carry, &beside),
            };
            if link.parent as usize != t.wrapping_sub(1) {
                if link.parent != NONE {
                    self.branches[link.parent as usize].add(&carry);
                }
                carry = Carry::default();
            }
        }
    }

    /// The closing rod's correction, from what the tree does without it and under its unit multiplier.
    fn close(&mut self, system: &System) -> f64 {
        let Some(closing) = &mut self.closing else { return 0.0 };
        if !system.rods.held[closing.rod as usize] {
            return 0.0;
        }
        let mut x = [0.0; 4];
        for (t, link) in self.links.iter().enumerate().take(closing.at as usize + 1) {
            if link.parent as usize != t.wrapping_sub(1) {
                x = if link.parent == NONE { [0.0; 4] } else { self.moved[link.parent as usize] };
            }
            x = match link.join {
                Join::Rod => {
                    let turn = link.turn - (link.px * x[0] + link.py * x[1]);
                    let unit = link.closing - (link.px * x[2] + link.py * x[3]);
                    [x[0] - turn * link.ny, x[1] + turn * link.nx, x[2] - unit * link.ny, x[3] + unit * link.nx]
                }
                _ => {
                    let Loose { cx, cy, cx2, cy2, n, .. } = &self.loose[t];
                    let (to, unit) = (times(n, x[0], x[1]), times(n, x[2], x[3]));
                    [cx + to.0, cy + to.1, cx2 + unit.0, cy2 + unit.1]
                }
            };
            if !self.moved.is_empty() {
                self.moved[t] = x;
            }
        }
        let (nx, ny) = (closing.dx + closing.ex, closing.dy + closing.ey);
        let error = 0.5 * (nx * nx + ny * ny - system.rods.square[closing.rod as usize]);
        let mu = -(error + nx * x[0] + ny * x[1]) / (nx * x[2] + ny * x[3]);
        closing.lambda += mu;
        mu
    }

    /// From the root to the leaves. Returns the largest turn, or move in parts of the island's size.
    fn correct(&mut self, system: &System, mu: f64) -> f64 {
        let (mut largest, mut farthest) = (0.0f64, 0.0f64);
        let (mut x, mut y, mut ux, mut uy) = (0.0, 0.0, 0.0, 0.0);
        for t in 0..self.links.len() {
            let parent = self.links[t].parent;
            if parent as usize != t.wrapping_sub(1) {
                (ux, uy) = self.parent_move(system, t);
                [x, y, ..] = if parent == NONE { [0.0; 4] } else { self.moved[parent as usize] };
            }
            let link = &mut self.links[t];
            if link.join == Join::Rod {
                let turn = link.turn + mu * link.closing - (link.px * x + link.py * y);
                x -= turn * link.ny;
                y += turn * link.nx;
                (link.nx, link.ny) = turned(link.nx, link.ny, turn);
                ux += link.nx - link.dx;
                uy += link.ny - link.dy;
                // Written so that a NaN is kept.
                largest = if turn.abs() <= largest { largest } else { turn.abs() };
            } else {
                let Loose { cx, cy, cx2, cy2, n, .. } = &self.loose[t];
                let (tx, ty) = times(n, x, y);
                (x, y) = (cx + mu * cx2 + tx, cy + mu * cy2 + ty);
                (ux, uy) =
                    if link.join == Join::Pin { (ux - link.dx, uy - link.dy) } else { (link.ux + x, link.uy + y) };
                let far = x.abs() + y.abs();
                farthest = if far <= farthest { farthest } else { far };
            }
            (link.ux, link.uy) = (ux, uy);
            if !self.moved.is_empty() {
                self.moved[t] = [x, y, 0.0, 0.0];
            }
            if largest.is_nan() {
                return f64::NAN;
            }
        }
        let far = farthest / system.length;
        if far <= largest { largest } else { far }
    }

    /// Whether no rod has turned farther than a step can tell from a turn the other way.
    fn turned_little(&self, system: &System) -> bool {
        let within = |(link, tie): (&Link, &Tie)| {
            link.join != Join::Rod
                || link.dx * link.nx + link.dy * link.ny > TURN * system.rods.square[tie.index as usize]
        };
        self.links.iter().zip(&self.tie).all(within)
    }

    /// Moves the island to the end of the step.
    pub fn apply(&self, system: &mut System) {
        let over = 2.0 / self.h;
        let nodes = &mut system.nodes;
        for (t, link) in self.links.iter().enumerate() {
            let i = self.node[t] as usize;
            nodes.x[i] += link.ux;
            nodes.y[i] += link.uy;
            nodes.vx[i] = over * link.ux - nodes.vx[i];
            nodes.vy[i] = over * link.uy - nodes.vy[i];
            let index = self.tie[t].index as usize;
            match link.join {
                Join::Rod => system.rods.lambda[index] = link.lambda,
                Join::Pin => {
                    let sign = if system.pins.b[index] == self.node[t] { 1.0 } else { -1.0 };
                    system.pins.lambda[index] = sign * self.loose[t].force;
                }
                Join::Free => {}
            }
        }
        if let Some(closing) = self.closing.filter(|closing| system.rods.held[closing.rod as usize]) {
            system.rods.lambda[closing.rod as usize] = closing.lambda;
        }
    }
}

impl Link {
    /// Eliminates a node on a rod; returns what its parent feels.
    #[inline(always)]
    fn pass_rod<const EXTRA: bool, const CLOSED: bool>(&mut self, at: &Carry, beside: &Linear, first: bool) -> Carry {
        let k = &at.k;
        let (nx, ny) = (self.nx, self.ny);
        let (mx, my) = (0.5 * (self.dx + nx), 0.5 * (self.dy + ny));
        let (mut fx, mut fy) = (at.fx, at.fy);
        if EXTRA {
            (fx, fy) = (fx + beside.fx, fy + beside.fy);
        }
        // The multiplier balances the forces along d_m.
        let lambda = -(mx * fx + my * fy) / (mx * mx + my * my);
        let geometric = -0.5 * if first { self.lambda } else { lambda };
        self.lambda = lambda;
        let (rx, ry) = (lambda * mx, lambda * my);
        let (gx, gy) = (at.gx + fx + rx, at.gy + fy + ry);
        // τ' = (−ny, nx), τ_m = (−my, mx)
        let (qx, qy) = (k[1] * nx - k[0] * ny, k[3] * nx - k[2] * ny);
        let (px, py) = (k[2] * mx - k[0] * my, k[3] * mx - k[1] * my);
        let mut across = geometric * (my * ny + mx * nx);
        if EXTRA {
            let s = &beside.k;
            across += mx * (s[3] * nx - s[2] * ny) - my * (s[1] * nx - s[0] * ny);
        }
        let over = 1.0 / (across + (mx * qy - my * qx));
        let turn = (mx * gy - my * gx) * over;
        let (px, py) = (px * over, py * over);
        (self.turn, self.px, self.py) = (turn, px, py);
        let mut to = Carry {
            k: [k[0] - qx * px, k[1] - qx * py, k[2] - qy * px, k[3] - qy * py],
            gx: gx - turn * qx,
            gy: gy - turn * qy,
            fx: -rx,
            fy: -ry,
            hx: 0.0,
            hy: 0.0,
        };
        if EXTRA {
            (to.fx, to.fy) = (to.fx - beside.fx, to.fy - beside.fy);
        }
        if CLOSED {
            self.closing = (mx * at.hy - my * at.hx) * over;
            (to.hx, to.hy) = (at.hx - self.closing * qx, at.hy - self.closing * qy);
        }
        to
    }
}

impl Loose {
    /// A pin: the node goes where its parent goes, and hands all forces on.
    fn pass_pin(&mut self, at: &Carry) -> Carry {
        *self = Loose { n: [1.0, 0.0, 0.0, 1.0], force: DVec2::new(-at.fx, -at.fy), ..Loose::default() };
        *at
    }

    /// Springs with stiffness S, or nothing: x = (K + S)⁻¹ (g + S x_parent), K̂ = K (K + S)⁻¹ S, ĝ = g − K c = S c.
    fn pass_free(&mut self, at: &Carry, beside: &Linear) -> Carry {
        let (k, s) = (&at.k, &beside.k);
        let [a, b, c, d] = [k[0] + s[0], k[1] + s[1], k[2] + s[2], k[3] + s[3]];
        let over = 1.0 / (a * d - b * c);
        let inverse = [d * over, -b * over, -c * over, a * over];
        (self.cx, self.cy) = times(&inverse, at.gx + at.fx + beside.fx, at.gy + at.fy + beside.fy);
        (self.cx2, self.cy2) = times(&inverse, at.hx, at.hy);
        self.n = product(&inverse, s);
        let ((gx, gy), (hx, hy)) = (times(s, self.cx, self.cy), times(s, self.cx2, self.cy2));
        Carry { k: product(k, &self.n), gx, gy, fx: -beside.fx, fy: -beside.fy, hx, hy }
    }
}

/// A vector turned by about `angle` [rad], tan(angle/2) taken for angle/2 (Cayley): its length is kept.
#[inline(always)]
fn turned(x: f64, y: f64, angle: f64) -> (f64, f64) {
    let half = 0.5 * angle;
    let over = angle / (1.0 + half * half);
    (x - over * (half * x + y), y + over * (x - half * y))
}

#[inline(always)]
fn times(m: &[f64; 4], x: f64, y: f64) -> (f64, f64) {
    (m[0] * x + m[1] * y, m[2] * x + m[3] * y)
}

fn product(a: &[f64; 4], b: &[f64; 4]) -> [f64; 4] {
    let row = |x: f64, y: f64| (x * b[0] + y * b[2], x * b[1] + y * b[3]);
    let (first, second) = (row(a[0], a[1]), row(a[2], a[3]));
    [first.0, first.1, second.0, second.1]
}

fn add(to: &mut Linear, more: Linear) {
    to.fx += more.fx;
    to.fy += more.fy;
    to.k.iter_mut().zip(more.k).for_each(|(to, more)| *to += more);
}
