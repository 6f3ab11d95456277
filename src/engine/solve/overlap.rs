//! Contacts on the positions: parting overlaps, and the planes in which a projection sees its contacts.
//!
//! An overlap that is there at the start of a substep is parted by moving the bodies, without touching their velocities, so
//! bodies spawned inside each other part without being launched and a pile at rest gets no energy from its overlaps.
//! (As pre-stabilisation in Macklin et al., "Unified Particle Physics", ACM Trans. Graph. 33(4), 2014.)

use super::contact_rows::ContactRow;
use crate::engine::collide::sweep::CORE;
use crate::engine::state::State;
use glam::DVec2;

/// Largest speed that a projection makes of an overlap [m/s]. Smaller lets stacks sink, larger launches bodies that were
/// spawned inside each other.
const LARGEST_PUSH: f64 = 1.0;

/// Contacts as planes: the gap along the normal found at detection, and how far the bodies have moved since.
pub(crate) struct Planes<'a> {
    pub rows: &'a mut [ContactRow],
    /// Positions and angles at detection, overlaps parted.
    pub position: &'a [DVec2],
    pub angle: &'a [f64],
}

impl Planes<'_> {
    /// Takes `part` of every overlap away, on the positions alone; the rows then have the gaps that are left.
    pub fn part_overlaps(rows: &mut [ContactRow], found_at: &[DVec2], state: &mut State, part: f64) {
        for row in rows.iter().filter(|row| row.gap < 0.0) {
            let (a, b) = (row.a as usize, row.b as usize);
            let moved = state.position[a] - found_at[a] - state.position[b] + found_at[b];
            let push = part * row.normal_mass * -(row.gap + row.normal.dot(moved)).min(0.0);
            state.position[a] += state.inverse_mass[a] * push * row.normal;
            state.position[b] -= state.inverse_mass[b] * push * row.normal;
        }
        for row in rows {
            let (a, b) = (row.a as usize, row.b as usize);
            row.gap += row.normal.dot(state.position[a] - found_at[a] - state.position[b] + found_at[b]);
        }
    }

    /// How far body `i` has moved since detection [m], and turned [rad].
    fn moved<const SPIN: bool>(&self, i: u32, state: &State) -> (DVec2, f64) {
        let i = i as usize;
        (state.position[i] - self.position[i], if SPIN { state.angle[i] - self.angle[i] } else { 0.0 })
    }

    /// One visit of contact `i`: out of the overlap along the normal, then back along the tangent as far as friction holds.
    pub fn project<const SPIN: bool>(&mut self, i: usize, state: &mut State, h: f64) -> f64 {
        let row = self.rows[i];
        let ((move_a, turn_a), (move_b, turn_b)) = (self.moved::<SPIN>(row.a, state), self.moved::<SPIN>(row.b, state));
        let gap = row.gap + row.normal.dot(move_a - move_b);
        // What an earlier substep left is carried on, as its velocity is needed up a stack; more would launch bodies.
        let change = row.gap.min(0.0) + (-row.gap).clamp(0.0, LARGEST_PUSH * h) - gap;
        if change <= 0.0 {
            return 0.0;
        }
        let push = change * row.normal_mass;
        shift::<SPIN>(&row, push * row.normal, 0.0, state);
        let slid = row.normal.perp().dot(move_a - move_b) - row.radius_a * turn_a - row.radius_b * turn_b;
        let normal_impulse = row.normal_impulse + push / h;
        let most = row.friction * normal_impulse;
        let wanted = row.tangent_impulse - slid * row.tangent_mass / h;
        let tangent_impulse = wanted.min(most).max(-most);
        let rub = (tangent_impulse - row.tangent_impulse) * h;
        shift::<SPIN>(&row, rub * row.normal.perp(), rub, state);
        self.rows[i].normal_impulse = normal_impulse;
        self.rows[i].tangent_impulse = tangent_impulse;
        change
    }

    /// Keeps the core of a body out of something immovable, whatever the sweeps left over.
    pub fn guard<const SPIN: bool>(&self, i: usize, state: &mut State) {
        let row = &self.rows[i];
        if state.inverse_mass[row.b as usize] > 0.0 {
            return;
        }
        let least = row.gap.min(-CORE * row.radius_a);
        let gap = row.gap + row.normal.dot(self.moved::<SPIN>(row.a, state).0 - self.moved::<SPIN>(row.b, state).0);
        if gap < least {
            state.position[row.a as usize] += (least - gap) * row.normal;
        }
    }
}

/// Moves both bodies of a contact by `weighted` [kg·m] over their masses, and turns them by the tangential part of it.
fn shift<const SPIN: bool>(row: &ContactRow, weighted: DVec2, tangential: f64, state: &mut State) {
    let (a, b) = (row.a as usize, row.b as usize);
    state.position[a] += state.inverse_mass[a] * weighted;
    state.position[b] -= state.inverse_mass[b] * weighted;
    if SPIN {
        state.angle[a] -= state.inverse_inertia[a] * tangential * row.radius_a;
        state.angle[b] -= state.inverse_inertia[b] * tangential * row.radius_b;
    }
}
