//! Contacts as they are told to the world: the mean force of a step, bounces included.

use super::touch::Touch;
use crate::engine::world::{Contact, Touching, World};
use glam::DVec2;

/// Impulses by pair, since the start of the step.
#[derive(Debug, Default)]
pub(super) struct Records(Vec<Contact>);

impl Records {
    pub fn clear(&mut self) {
        self.0.clear();
    }

    /// Adds impulses along the normal and the tangent [N·s] to those of the pair; `dense` is the index of body `a` in the world.
    pub fn add(&mut self, touch: &Touch, dense: u32, impulse: [f64; 2]) {
        let known = self.0.iter_mut().find(|known| known.a == dense && known.b == touch.with);
        if let Some(known) = known {
            known.normal_force += impulse[0];
            known.tangent_force += impulse[1];
            return;
        }
        let normal = touch.normal;
        let [normal_force, tangent_force] = impulse;
        self.0.push(Contact {
            a: dense,
            b: touch.with,
            point: DVec2::ZERO,
            normal,
            gap: 0.0,
            normal_force,
            tangent_force,
        });
    }

    /// Takes those of another group over; no pair is in both.
    pub fn append(&mut self, other: &mut Records) {
        self.0.append(&mut other.0);
    }

    /// Writes them to the world beside what is there, in its order, with the places that the bodies have there now, as forces over `time` [s].
    pub fn store(&mut self, world: &mut World, time: f64) {
        for contact in &mut self.0 {
            let bodies = &world.bodies;
            let (i, centre) = (contact.a as usize, bodies.position[contact.a as usize]);
            let (distance, normal) = match contact.b {
                Touching::Body(b) => {
                    let offset = centre - bodies.position[b as usize];
                    (offset.length() - bodies.radius[b as usize], offset.normalize_or(DVec2::Y))
                }
                Touching::Wall(wall) => world.walls[wall as usize].shape.distance(centre),
            };
            contact.normal = normal;
            contact.gap = distance - bodies.radius[i];
            contact.point = centre - normal * (bodies.radius[i] + 0.5 * contact.gap);
            contact.normal_force /= time;
            contact.tangent_force /= time;
        }
        world.contacts.extend_from_slice(&self.0);
        world.contacts.sort_unstable_by_key(|contact| match contact.b {
            Touching::Body(b) => (false, contact.a, b),
            Touching::Wall(wall) => (true, contact.a, wall),
        });
    }
}
