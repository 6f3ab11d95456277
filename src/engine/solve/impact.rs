//! Impacts with restitution, before the solve: e = −v⁺/v⁻ along the normal, contact by contact, until nothing closes.
//!
//! Contacts are taken one after another from the velocities that the earlier ones left, so an impact runs through a row of
//! balls as it does through Newton's cradle (for sequential against simultaneous impact see Smith et al., "Reflections on
//! Simultaneous Impact", ACM Trans. Graph. 31(4), 2012). Each conserves momentum to rounding, and energy too for e = 1.
//!
//! The surfaces meet at a fraction of the substep. A body whose velocity changes by Δv at time t of it is moved by −t·Δv, to
//! where a straight way with the new velocity ends in the same place: a bounce is not early by up to a substep, and further
//! impacts in the same substep are found on the way really taken.

//!
//! The velocities that a substep drifts with are those of its middle. The surfaces meet at time t of it, so gravity g along the normal has them meet with
//! u − g (½ h − t) where u is their closing speed, and after the bounce the middle's velocity is e (u − g (½ h − t)) − g (½ h − t): a ball with e = 1 keeps
//! its energy to rounding, as long as a bounce lasts more than a few substeps. Without it a bounce gained or lost up to m g h u.

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
    /// [m], by body
    shift: Vec<DVec2>,
    /// Longest shift, as a part of the first body's radius. Bounded for integrators of which a part of the drift comes after
    /// the next detection, where a long one would put a body behind a wall meanwhile; without it a bounce is early.
    longest_shift: f64,
    /// Time of the body's last impact in this substep [s].
    at: Vec<f64>,
    /// Contacts with restitution that were approaching at the start.
    bouncing: Vec<u32>,
}

impl Impacts {
    /// Resolves the impacts of a substep of `h` seconds; positions and gaps are then those that go with the new velocities.
    /// `gravity` [m/s²] sets what counts as resting. Returns the number of impacts.
    pub fn resolve<const SPIN: bool>(
        &mut self,
        rows: &mut [ContactRow],
        contacts: &[Contact],
        state: &mut State,
        (h, gravity): (f64, DVec2),
        only_short_shifts: bool,
    ) -> usize {
        self.longest_shift = if only_short_shifts { 0.5 * CORE } else { f64::INFINITY };
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
        for row in rows {
            row.gap += row.normal.dot(self.shift[row.a as usize] - self.shift[row.b as usize]);
        }
        for (position, shift) in state.position.iter_mut().zip(&self.shift) {
            *position += *shift;
        }
        impacts
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
        gravity: DVec2,
    ) -> bool {
        let (a, b) = (row.a as usize, row.b as usize);
        let speed = row.normal_speed(state);
        let rest = 2.0 * h * (gravity.length() + force / row.normal_mass);
        // The gap that a straight way with the present velocities would have started from.
        let gap = row.gap + row.normal.dot(self.shift[a] - self.shift[b]);
        if !(speed < -rest) || gap + h * speed > 0.0 {
            return false;
        }
        let time = (gap / -speed).min(h).max(self.at[a]).max(self.at[b]);
        let before = (state.velocity[a], state.velocity[b]);
        let falls = |i: usize| if state.inverse_mass[i] > 0.0 { gravity } else { DVec2::ZERO };
        let closing = row.normal.dot(falls(b) - falls(a));
        let rebound = |time: f64| {
            let gained = closing * (0.5 * h - time);
            (row.restitution * (-speed - gained) - gained).max(0.0)
        };
        // How far it goes without a shift: as if the surfaces had met at the start.
        let change = (rebound(time) - speed) * row.normal_mass;
        let longest = self.longest_shift * row.radius_a;
        let too_long = |i: usize| time * change * state.inverse_mass[i] > longest;
        let shifts = !too_long(a) && !too_long(b);
        let impulse = if shifts { change } else { (rebound(0.0) - speed) * row.normal_mass };
        row.push(impulse, state);
        let most = row.friction * impulse;
        let rub = (-row.tangent_speed::<SPIN>(state) * row.tangent_mass).min(most).max(-most);
        row.rub::<SPIN>(rub, state);
        let shift = [time * (state.velocity[a] - before.0), time * (state.velocity[b] - before.1)];
        if shifts && shift[0].length() <= longest && shift[1].length() <= longest {
            self.shift[a] -= shift[0];
            self.shift[b] -= shift[1];
        }
        self.at[a] = time;
        self.at[b] = time;
        true
    }
}
