//! The points of an island: bodies that move, and those and the anchors that do not.

use crate::engine::body::Motion;
use crate::engine::constraint::WORLD;
use crate::engine::constraint::grip::led_velocity;
use crate::engine::world::World;

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
}

impl Nodes {
    pub fn len(&self) -> usize {
        self.x.len()
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
        (self.len() - 1) as u32
    }

    /// Adds a node without mass that is placed by others.
    pub fn push_point(&mut self) -> u32 {
        self.push(WORLD, 0.0, 0.0, 0.0)
    }

    /// Reads positions and velocities. Where the mouse leads a static body it moves for `h` seconds as it is led.
    pub fn load(&mut self, world: &World, h: f64) {
        let bodies = &world.bodies;
        for i in 0..self.body.len() {
            let body = self.body[i];
            if body == WORLD {
                continue;
            }
            let position = bodies.position[body as usize];
            let velocity = match bodies.motion[body as usize] {
                Motion::Static => led_velocity(world, body as usize, h),
                _ => bodies.velocity[body as usize],
            };
            (self.x[i], self.y[i]) = (position.x, position.y);
            (self.vx[i], self.vy[i]) = (velocity.x, velocity.y);
        }
    }

    /// Writes positions and velocities back.
    pub fn store(&self, world: &mut World) {
        let bodies = &mut world.bodies;
        for (i, body) in self.body.iter().enumerate().filter(|(_, body)| **body != WORLD) {
            let (position, velocity) = (&mut bodies.position[*body as usize], &mut bodies.velocity[*body as usize]);
            (position.x, position.y) = (self.x[i], self.y[i]);
            (velocity.x, velocity.y) = (self.vx[i], self.vy[i]);
        }
    }
}
