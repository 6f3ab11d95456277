//! The points of an island: bodies that move, and those and the anchors that do not.

use super::lanes::Largest;
use crate::engine::body::Motion;
use crate::engine::constraint::WORLD;
use crate::engine::constraint::grip::led_velocity;
use crate::engine::world::World;
use glam::DVec2;

/// Coordinates by node. A node whose inverse mass is 0 moves on with its own velocity (0 for a fixed point).
#[derive(Clone, Debug, Default)]
pub(crate) struct Nodes {
    /// Dense index of the body, or [`WORLD`] for a fixed anchor and one that turns with a body.
    pub body: Vec<u32>,
    /// [m]
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    /// [m/s]
    pub vx: Vec<f64>,
    pub vy: Vec<f64>,
    /// [1/kg]
    pub w: Vec<f64>,
    /// 1 where gravity and drag act, else 0.
    pub free: Vec<f64>,
    /// Those with an inverse mass of 0.
    pub fixed: Vec<u32>,
}

impl Nodes {
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// Largest component of a velocity [m/s]; NaN if one of them is.
    pub fn fastest(&self) -> f64 {
        let mut largest = Largest::default();
        largest.take_sizes(&self.vx);
        largest.take_sizes(&self.vy);
        largest.value()
    }

    /// Largest coordinate [m]; NaN if one of them is.
    pub fn farthest(&self) -> f64 {
        let mut largest = Largest::default();
        largest.take_sizes(&self.x);
        largest.take_sizes(&self.y);
        largest.value()
    }

    /// Width and height of the box around all nodes [m].
    pub fn extent(&self) -> [f64; 2] {
        [&self.x, &self.y].map(|values| {
            let first = values.first().copied().unwrap_or(0.0);
            let (mut low, mut high) = ([first; 4], [first; 4]);
            let (fours, rest) = values.as_chunks::<4>();
            let mut take = |k: usize, value: f64| {
                low[k] = if value < low[k] { value } else { low[k] };
                high[k] = if value > high[k] { value } else { high[k] };
            };
            fours.iter().for_each(|four| (0..4).for_each(|k| take(k, four[k])));
            rest.iter().for_each(|value| take(0, *value));
            high.into_iter().fold(first, f64::max) - low.into_iter().fold(first, f64::min)
        })
    }

    /// Whether all nodes are where numbers mean something, their coordinates within `far` [m] and `fast` [m/s].
    pub fn within(&self, far: f64, fast: f64) -> bool {
        // Written so that a NaN is out of range.
        self.farthest() <= far && self.fastest() <= fast
    }

    /// x, y, vx, vy.
    pub fn coordinates(&mut self) -> [&mut Vec<f64>; 4] {
        [&mut self.x, &mut self.y, &mut self.vx, &mut self.vy]
    }

    /// Adds a node at rest.
    pub fn push(&mut self, body: u32, x: f64, y: f64, w: f64) -> u32 {
        self.body.push(body);
        self.x.push(x);
        self.y.push(y);
        self.vx.push(0.0);
        self.vy.push(0.0);
        self.w.push(w);
        self.free.push(if w > 0.0 { 1.0 } else { 0.0 });
        let node = (self.len() - 1) as u32;
        if w == 0.0 {
            self.fixed.push(node);
        }
        node
    }

    /// Adds a node without mass that is placed by others.
    pub fn push_point(&mut self) -> u32 {
        self.push(WORLD, 0.0, 0.0, 0.0)
    }

    /// Reads positions and velocities. Where the mouse leads a static body it moves for `h` seconds as it is led.
    pub fn load(&mut self, world: &World, h: f64) {
        let bodies = &world.bodies;
        let Nodes { body, x, y, vx, vy, .. } = self;
        for ((((body, x), y), vx), vy) in body.iter().zip(x).zip(y).zip(vx).zip(vy) {
            // Not an anchor in the world.
            if let Some(position) = bodies.position.get(*body as usize) {
                let velocity = bodies.velocity[*body as usize];
                (*x, *y) = (position.x, position.y);
                (*vx, *vy) = (velocity.x, velocity.y);
            }
        }
        for i in self.fixed.iter().map(|i| *i as usize).filter(|i| self.body[*i] != WORLD) {
            let body = self.body[i] as usize;
            if bodies.motion[body] == Motion::Static {
                let velocity = led_velocity(world, body, h);
                (self.vx[i], self.vy[i]) = (velocity.x, velocity.y);
            }
        }
    }

    /// Writes positions and velocities back.
    pub fn store(&self, world: &mut World) {
        let bodies = &mut world.bodies;
        let values = self.x.iter().zip(&self.y).zip(self.vx.iter().zip(&self.vy));
        for (body, ((x, y), (vx, vy))) in self.body.iter().zip(values) {
            if let Some(position) = bodies.position.get_mut(*body as usize) {
                *position = DVec2::new(*x, *y);
                bodies.velocity[*body as usize] = DVec2::new(*vx, *vy);
            }
        }
    }
}
