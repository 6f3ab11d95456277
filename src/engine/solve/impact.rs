//! Impacts with restitution, before the solve: e = −v⁺/v⁻ along the normal, contact by contact, until nothing closes.
//!
//! Contacts are taken one after another from the velocities that the earlier ones left, so an impact runs through a row of
//! balls as it does through Newton's cradle (for sequential against simultaneous impact see Smith et al., "Reflections on
//! Simultaneous Impact", ACM Trans. Graph. 31(4), 2012). Each conserves momentum to rounding, and energy too for e = 1.
//!
//! The surfaces meet at a fraction of the substep. A body whose velocity changes by Δv at time t of the substep has lost
//! t·Δv on the way that its new velocity will be taken for; `shift` returns it, so a bounce is not early by up to a substep.

use super::contact_rows::ContactRow;
use crate::engine::collide::sweep::CORE;
use crate::engine::state::State;
use crate::engine::world::Contact;
use glam::DVec2;

/// Passes over the contacts; what still closes then is left to the solve, without a bounce. A row of n balls hit against
/// its order needs n.
const LARGEST_PASSES: u32 = 64;

/// Shifts and times of the impacts of a substep.
#[derive(Debug, Default)]
pub(crate) struct Impacts {
    /// [m], by body; to be added to the drift.
    pub shift: Vec<DVec2>,
    /// Time of the body's last impact in this substep [s].
    at: Vec<f64>,
    /// Contacts with restitution that were approaching at the start.
    bouncing: Vec<u32>,
}

impl Impacts {
    /// Resolves the impacts of a substep of `h` seconds. `gravity` [m/s²] sets what counts as resting. Returns their number.
    pub fn resolve<const SPIN: bool>(
        &mut self,
        rows: &[ContactRow],
        contacts: &[Contact],
        state: &mut State,
        h: f64,
        gravity: f64,
    ) -> usize {
        self.shift.clear();
        self.shift.resize(state.position.len(), DVec2::ZERO);
        self.at.clear();
        self.at.resize(state.position.len(), 0.0);
        self.bouncing.clear();
        self.bouncing.extend((0..rows.len() as u32).filter(|i| rows[*i as usize].restitution > 0.0));
        let mut impacts = 0;
        for _ in 0..LARGEST_PASSES {
            let before = impacts;
            for i in 0..self.bouncing.len() {
                let row = self.bouncing[i] as usize;
                impacts += usize::from(self.bounce::<SPIN>(&rows[row], contacts[row].normal_force, state, h, gravity));
            }
            if impacts == before {
                break;
            }
        }
        impacts
    }

    /// Drops shifts that reach through the core of a body. For integrators of which a part of the drift comes after the next
    /// detection: a long shift would put the body behind a wall meanwhile; without it the bounce is early.
    pub fn drop_long_shifts(&mut self, radius: &[f64]) {
        for (shift, radius) in self.shift.iter_mut().zip(radius) {
            if shift.length() > 0.5 * CORE * radius {
                *shift = DVec2::ZERO;
            }
        }
    }

    /// One impact, if the surfaces meet within the substep at more than the speed of rest.
    ///
    /// Speed of rest: what gravity and the contact's last force make in two substeps. Slower contacts belong to the solve;
    /// a bounce that decays below it ends in rest.
    fn bounce<const SPIN: bool>(
        &mut self,
        row: &ContactRow,
        force: f64,
        state: &mut State,
        h: f64,
        gravity: f64,
    ) -> bool {
        let speed = row.normal_speed(state);
        let rest = 2.0 * h * (gravity + force / row.normal_mass);
        if !(speed < -rest) || row.gap + h * speed > 0.0 {
            return false;
        }
        let (a, b) = (row.a as usize, row.b as usize);
        let meets = (row.gap.max(0.0) / -speed).min(h);
        let time = meets.max(self.at[a]).max(self.at[b]);
        let before = (state.velocity[a], state.velocity[b]);
        let impulse = -(1.0 + row.restitution) * speed * row.normal_mass;
        row.push(impulse, state);
        let most = row.friction * impulse;
        let rub = (-row.tangent_speed::<SPIN>(state) * row.tangent_mass).min(most).max(-most);
        row.rub::<SPIN>(rub, state);
        self.shift[a] -= time * (state.velocity[a] - before.0);
        self.shift[b] -= time * (state.velocity[b] - before.1);
        self.at[a] = time;
        self.at[b] = time;
        true
    }
}
