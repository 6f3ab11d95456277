//! The working copy that a step changes, substep by substep; the world gets it back only when the whole step went well.

use super::body::{Motion, NO_ROTOR};
use super::constraint::WORLD;
use super::world::{World, rotate};
use glam::DVec2;

/// Positions and velocities of all bodies, and after the last one an immovable entry at the origin that stands for the world,
/// so that a constraint to the world needs no case of its own. The rotation arrays are empty in a scene without spin.
#[derive(Debug, Default)]
pub(crate) struct State {
    /// [m]
    pub position: Vec<DVec2>,
    /// [m/s]
    pub velocity: Vec<DVec2>,
    /// [rad]; 0 for a particle
    pub angle: Vec<f64>,
    /// [rad/s]; 0 for a particle
    pub omega: Vec<f64>,
    /// [1/kg]; 0 unless dynamic
    pub inverse_mass: Vec<f64>,
    /// [1/(kg·m²)]; 0 unless dynamic and with spin
    pub inverse_inertia: Vec<f64>,
    /// Whether a drift moves the body at all.
    pub moves: Vec<bool>,
}

impl State {
    /// Index that stands for `end`, a body or the world.
    pub fn index(end: u32, bodies: usize) -> u32 {
        if end == WORLD { bodies as u32 } else { end }
    }

    /// Number of bodies (without the world's entry).
    pub fn len(&self) -> usize {
        self.position.len() - 1
    }

    /// Copies the world in; `spin` says whether rotations are needed. Reuses its memory.
    /// Bodies `elsewhere` are carried by their islands and stand still here.
    pub fn load(&mut self, world: &World, spin: bool, elsewhere: &[bool]) {
        let bodies = &world.bodies;
        self.position.clone_from(&bodies.position);
        self.position.push(DVec2::ZERO);
        self.velocity.clone_from(&bodies.velocity);
        self.velocity.push(DVec2::ZERO);
        self.inverse_mass.clone_from(&bodies.inverse_mass);
        self.inverse_mass.push(0.0);
        self.moves.clear();
        self.moves.extend(bodies.motion.iter().map(|motion| *motion != Motion::Static));
        // A static body has a velocity only while the mouse leads it.
        let led = world.grip.map(|grip| grip.body);
        for (i, velocity) in self.velocity.iter_mut().enumerate().take(bodies.len()) {
            if !self.moves[i] && led != Some(bodies.id[i]) {
                *velocity = DVec2::ZERO;
            }
        }
        for (i, _) in elsewhere.iter().enumerate().filter(|(_, carried)| **carried) {
            self.inverse_mass[i] = 0.0;
            self.moves[i] = false;
            self.velocity[i] = DVec2::ZERO;
        }
        self.load_rotations(world, if spin { bodies.len() + 1 } else { 0 });
    }

    fn load_rotations(&mut self, world: &World, entries: usize) {
        for values in [&mut self.angle, &mut self.omega, &mut self.inverse_inertia] {
            values.clear();
            values.resize(entries, 0.0);
        }
        if entries > 0 {
            let rotors = &world.bodies.rotors;
            for (rotor, body) in rotors.body.iter().enumerate() {
                self.angle[*body as usize] = rotors.angle[rotor];
                self.omega[*body as usize] = if self.moves[*body as usize] { rotors.omega[rotor] } else { 0.0 };
                self.inverse_inertia[*body as usize] = rotors.inverse_inertia[rotor];
            }
        }
    }

    /// Copies positions, velocities and rotations back.
    pub fn store(&self, world: &mut World) {
        let n = self.len();
        let bodies = &mut world.bodies;
        bodies.position.copy_from_slice(&self.position[..n]);
        bodies.velocity.copy_from_slice(&self.velocity[..n]);
        if self.angle.is_empty() {
            return;
        }
        for (body, rotor) in bodies.rotor.iter().enumerate().filter(|(_, rotor)| **rotor != NO_ROTOR) {
            bodies.rotors.angle[*rotor as usize] = self.angle[body];
            bodies.rotors.omega[*rotor as usize] = self.omega[body];
        }
    }

    /// Vector from the centre of a body to a point in its axes, in world axes; for the world the point itself.
    pub fn arm<const SPIN: bool>(&self, body: u32, local: DVec2) -> DVec2 {
        if SPIN && local != DVec2::ZERO { rotate(local, self.angle[body as usize]) } else { local }
    }
}
