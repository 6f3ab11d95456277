//! Projected Gauss-Seidel on the velocities.
//!
//! Solves A λ + b = 0 within bounds, A = J M⁻¹ Jᵀ + γ, without ever forming A: each row in turn gets the impulse that
//! makes its own equation hold, clamped, and the velocities carry what changed to the other rows (Catto, "Iterative Dynamics
//! with Temporal Coherence", 2005). A spring's row obeys implicit Euler. A rigid joint's asks for J v = −½ h J̇v,
//! so that the drift follows the chord of the arc on which it turns; what it is off by is fed back to the positions after the
//! drift (see `feedback`), what contacts overlap before it (see `overlap`).
//!
//! Cost: O(rows) a sweep. It converges linearly, slowly where masses differ much along a chain (condition number of A): a
//! heavy ball on a light rope stretches it. Redundant rows do no harm.

use super::contact_rows::ContactRow;
use crate::engine::constraint::form::{Joint, Row};
use crate::engine::constraint::grip::GripRows;
use crate::engine::state::State;
use crate::engine::world::{Contact, World};
use glam::DVec2;

/// Sweeps go on, up to so many times those asked for, where gravity alone moves bodies by their radii in a substep, as discs of ten
/// micrometres: a stack of them would fall into itself.
const MORE_SWEEPS: u32 = 20;
/// Part of the smallest radius that gravity has to move bodies by, and by which they may move on what the sweeps have left over.
const THROUGH: f64 = 0.1;

/// One scalar row of a joint.
#[derive(Clone, Copy, Debug)]
struct JointRow {
    a: u32,
    b: u32,
    normal: DVec2,
    arm_a: f64,
    arm_b: f64,
    /// (K + γ)⁻¹ [kg]
    mass: f64,
    /// γ [1/kg]
    softness: f64,
    /// [m/s]
    bias: f64,
    /// Bounds and value of the impulse [N·s].
    low: f64,
    high: f64,
    impulse: f64,
}

/// K⁻¹ of a pin whose two rows know of each other: xx, xy, yy [kg], and the place of its first row.
#[derive(Clone, Copy, Debug)]
struct PinBlock {
    row: usize,
    inverse: [f64; 3],
}

/// What a solve is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Task {
    /// Length of the substep [s].
    pub h: f64,
    pub iterations: u32,
    /// Start from the multipliers known, instead of from nothing.
    pub warm_start: bool,
    /// Part of the substep whose impulses this solve finds: 1, or ½ where the substep solves twice.
    pub share: f64,
}

/// The rows of a substep and the impulses found.
#[derive(Debug, Default)]
pub(crate) struct Pgs {
    joints: Vec<JointRow>,
    /// Pins with arms, in the order of their rows.
    pins: Vec<PinBlock>,
    pub contacts: Vec<ContactRow>,
    grip: Option<GripRows>,
    /// Impulses of the joints' rows and of the grip that an earlier solve of the same substep found [N·s].
    found: Vec<f64>,
    grip_found: DVec2,
    /// Largest change of a row's velocity in the last sweep [m/s], and of a contact's.
    pub residual: f64,
    closing: f64,
    /// Of all bodies with contacts [m].
    least_radius: f64,
    /// [m/s²]
    gravity: f64,
}

impl Pgs {
    /// Scalar rows.
    pub fn rows(&self) -> usize {
        self.joints.len() + 2 * self.contacts.len() + 2 * usize::from(self.grip.is_some())
    }

    /// Evaluates the rows of the contacts.
    pub fn assemble_contacts<const SPIN: bool>(&mut self, world: &World, contacts: &[Contact], state: &State) {
        self.contacts.clear();
        self.contacts.extend(contacts.iter().map(|contact| ContactRow::of::<SPIN>(contact, world, state)));
        self.gravity = world.gravity.length();
        self.least_radius = self.contacts.iter().map(ContactRow::least_radius).fold(f64::INFINITY, f64::min);
    }

    /// Evaluates the rows of the joints and the grip at the present positions, and the impulses to start from: parts of the
    /// forces [N] of the last substep, by constraint and of the grip.
    pub fn assemble<const SPIN: bool>(
        &mut self,
        world: &World,
        joints: &[Joint],
        state: &State,
        (force, grip_force): (&[DVec2], DVec2),
        contacts: &[Contact],
        task: &Task,
    ) {
        let warm = if task.warm_start { task.h * task.share } else { 0.0 };
        self.joints.clear();
        self.pins.clear();
        self.found.clear();
        for joint in joints {
            let start = force[joint.index as usize] * warm;
            let turning = joint.half_turning::<SPIN>(state, task.h);
            self.push_joint::<SPIN>(joint, state, turning, start, task);
        }
        for (row, contact) in self.contacts.iter_mut().zip(contacts) {
            // All of a gap may close in the substep; an overlap is not the velocities' business (see `overlap`).
            row.wanted_speed = -row.gap.max(0.0) / task.h;
            row.normal_impulse = contact.normal_force * warm;
            row.tangent_impulse = contact.tangent_force * warm;
        }
        let grip_warm = if task.warm_start { grip_force * task.share } else { DVec2::ZERO };
        self.grip = GripRows::assemble::<SPIN>(world, state, task.h, task.share, grip_warm);
        self.grip_found = DVec2::ZERO;
    }

    /// Solves the grip alone, ahead of a projection, which takes its velocities as given; exact for a free body.
    pub fn solve_grip<const SPIN: bool>(&mut self, world: &World, state: &mut State, task: &Task) {
        self.joints.clear();
        self.pins.clear();
        self.found.clear();
        self.grip = GripRows::assemble::<SPIN>(world, state, task.h, task.share, DVec2::ZERO);
        self.grip_found = DVec2::ZERO;
        if let Some(grip) = &mut self.grip {
            grip.solve::<SPIN>(state);
        }
    }

    /// Evaluates the rows anew at the positions reached, so that the velocities respect what holds there. A contact that carried nothing is switched off. What was found so far counts on; PGS also starts
    /// from it, since both halves of a substep need about the same.
    pub fn reassemble<const SPIN: bool>(&mut self, world: &World, joints: &[Joint], state: &State, task: &Task) {
        self.found.clear();
        self.found.extend(self.joints.iter().map(|row| row.impulse));
        self.joints.clear();
        self.pins.clear();
        for joint in joints {
            let found = |row: usize| self.found.get(row).copied().unwrap_or(0.0);
            let start = DVec2::new(found(self.joints.len()), found(self.joints.len() + 1));
            self.push_joint::<SPIN>(joint, state, DVec2::ZERO, start, task);
        }
        for row in &mut self.contacts {
            row.wanted_speed = if row.normal_impulse > 0.0 { 0.0 } else { f64::NEG_INFINITY };
            row.found = [row.normal_impulse, row.tangent_impulse];
            if !task.warm_start {
                (row.normal_impulse, row.tangent_impulse) = (0.0, 0.0);
            }
        }
        self.grip_found = self.grip.map_or(DVec2::ZERO, |grip| grip.impulse);
        self.grip =
            GripRows::assemble::<SPIN>(world, state, task.h, task.share, self.grip_found / (task.share * task.h));
    }

    /// Adds the rows of a joint; `turning` and `start` have an entry for each.
    fn push_joint<const SPIN: bool>(
        &mut self,
        joint: &Joint,
        state: &State,
        turning: DVec2,
        start: DVec2,
        task: &Task,
    ) {
        let [first, second] = joint.rows::<SPIN>(state);
        if let [Some(x), Some(y)] = [&first, &second] {
            let inverse = joint.inverse_of_pin::<SPIN>([x, y], state);
            if inverse[1] != 0.0 {
                self.pins.push(PinBlock { row: self.joints.len(), inverse });
            }
        }
        self.joints.extend(first.map(|row| JointRow::of::<SPIN>(joint, &row, state, turning.x, start.x, task)));
        self.joints.extend(second.map(|row| JointRow::of::<SPIN>(joint, &row, state, turning.y, start.y, task)));
    }

    /// One visit of every joint; returns the largest change of a row's velocity [m/s].
    fn sweep_joints<const SPIN: bool>(&mut self, state: &mut State) -> f64 {
        let mut residual: f64 = 0.0;
        let mut next = 0;
        for pin in &self.pins {
            for row in &mut self.joints[next..pin.row] {
                residual = residual.max(row.solve::<SPIN>(state));
            }
            if let [x, y] = &mut self.joints[pin.row..pin.row + 2] {
                residual = residual.max(pin.solve::<SPIN>(x, y, state));
            }
            next = pin.row + 2;
        }
        for row in &mut self.joints[next..] {
            residual = residual.max(row.solve::<SPIN>(state));
        }
        residual
    }

    /// Sweeps. Returns their number.
    pub fn solve<const SPIN: bool>(&mut self, state: &mut State, task: &Task) -> u32 {
        if self.rows() == 0 {
            return 0;
        }
        self.start::<SPIN>(state);
        let mut sweeps = 0;
        while sweeps < task.iterations || sweeps < MORE_SWEEPS * task.iterations && self.lets_through(task.h) {
            self.residual = self.sweep_joints::<SPIN>(state);
            if let Some(grip) = &mut self.grip {
                grip.solve::<SPIN>(state);
            }
            self.closing = 0.0;
            for row in &mut self.contacts {
                self.closing = self.closing.max(solve_contact::<SPIN>(row, state));
            }
            self.residual = self.residual.max(self.closing);
            sweeps += 1;
        }
        sweeps
    }

    /// Whether bodies are so small that they might change places in `h` seconds, by what the last sweep still changed at a contact.
    fn lets_through(&self, h: f64) -> bool {
        let way = THROUGH * self.least_radius;
        self.gravity * h * h > way && self.closing * h > way
    }

    fn start<const SPIN: bool>(&self, state: &mut State) {
        self.joints.iter().for_each(|row| row.apply::<SPIN>(row.impulse, state));
        if let Some(grip) = &self.grip {
            grip.warm_start::<SPIN>(state);
        }
        for row in &self.contacts {
            row.push(row.normal_impulse, state);
            row.rub::<SPIN>(row.tangent_impulse, state);
        }
    }

    /// Adds the forces found in this substep [N] to the list by constraint and to the grip's.
    pub fn add_forces(&self, joints: &[Joint], h: f64, force: &mut [DVec2], grip_force: &mut DVec2) {
        let found = self.found.iter().copied().chain(std::iter::repeat(0.0));
        let mut impulses = self.joints.iter().zip(found).map(|(row, found)| row.impulse + found);
        for joint in joints.iter().take_while(|_| !self.joints.is_empty()) {
            let total = &mut force[joint.index as usize];
            total.x += impulses.next().map_or(0.0, |impulse| impulse / h);
            if joint.form.rows() == 2 {
                total.y += impulses.next().map_or(0.0, |impulse| impulse / h);
            }
        }
        if let Some(grip) = &self.grip {
            *grip_force += (grip.impulse + self.grip_found) / h;
        }
    }
}

impl PinBlock {
    /// One visit of both rows at once; returns the larger change of their velocities [m/s]. Far outside a small disc the force of each row alone would
    /// mostly turn the disc, against the other row, and hundreds of visits would be needed.
    fn solve<const SPIN: bool>(&self, x: &mut JointRow, y: &mut JointRow, state: &mut State) -> f64 {
        let off = DVec2::new(x.speed::<SPIN>(state) + x.bias, y.speed::<SPIN>(state) + y.bias);
        let [xx, xy, yy] = self.inverse;
        let change = -DVec2::new(xx * off.x + xy * off.y, xy * off.x + yy * off.y);
        for (row, change) in [(x, change.x), (y, change.y)] {
            row.impulse += change;
            row.apply::<SPIN>(change, state);
        }
        off.abs().max_element()
    }
}

impl JointRow {
    /// `turning` is the row's ½ h J̇v if a drift follows: C changes by h (J v + ½ h J̇v) through it. A rigid joint keeps its length, a spring's force
    /// is that of the length it will have, a damper's that of its mean rate.
    fn of<const SPIN: bool>(
        joint: &Joint,
        row: &Row,
        state: &State,
        turning: f64,
        warm_impulse: f64,
        task: &Task,
    ) -> JointRow {
        let form = &joint.form;
        let h = task.h;
        let one_sided = form.high == 0.0;
        let (softness, bias) = if form.stiffness.is_finite() {
            let soft = h * form.stiffness + form.damping;
            (1.0 / (task.share * h * soft), row.error * form.stiffness / soft + turning)
        } else if one_sided && row.error < 0.0 {
            (0.0, row.error / h + turning)
        } else {
            (0.0, turning)
        };
        JointRow {
            a: joint.a,
            b: joint.b,
            normal: row.normal,
            arm_a: row.arm_a,
            arm_b: row.arm_b,
            mass: 1.0 / (joint.inverse_effective_mass::<SPIN>(row, state) + softness),
            softness,
            bias,
            low: form.low,
            high: form.high,
            impulse: warm_impulse,
        }
    }

    #[inline]
    fn speed<const SPIN: bool>(&self, state: &State) -> f64 {
        let (a, b) = (self.a as usize, self.b as usize);
        let mut speed = self.normal.dot(state.velocity[b] - state.velocity[a]);
        if SPIN {
            speed += self.arm_b * state.omega[b] - self.arm_a * state.omega[a];
        }
        speed
    }

    /// One visit; returns by how much it changed the row's velocity [m/s].
    #[inline]
    fn solve<const SPIN: bool>(&mut self, state: &mut State) -> f64 {
        let wanted = self.impulse - self.mass * (self.speed::<SPIN>(state) + self.bias + self.softness * self.impulse);
        let impulse = wanted.clamp(self.low, self.high);
        let change = impulse - self.impulse;
        self.impulse = impulse;
        self.apply::<SPIN>(change, state);
        (change / self.mass).abs()
    }

    #[inline]
    fn apply<const SPIN: bool>(&self, impulse: f64, state: &mut State) {
        let (a, b) = (self.a as usize, self.b as usize);
        state.velocity[a] -= state.inverse_mass[a] * impulse * self.normal;
        state.velocity[b] += state.inverse_mass[b] * impulse * self.normal;
        if SPIN {
            state.omega[a] -= state.inverse_inertia[a] * impulse * self.arm_a;
            state.omega[b] += state.inverse_inertia[b] * impulse * self.arm_b;
        }
    }
}

/// One visit of a contact: friction within the cone of the present normal impulse, then the normal. Returns the change of
/// the normal velocity [m/s].
#[inline]
fn solve_contact<const SPIN: bool>(row: &mut ContactRow, state: &mut State) -> f64 {
    let most = row.friction * row.normal_impulse;
    let wanted = row.tangent_impulse - row.tangent_mass * row.tangent_speed::<SPIN>(state);
    // Not `clamp`, which panics on a NaN: a diverging run must reach the check at the end of the substep.
    let tangent = wanted.min(most).max(-most);
    row.rub::<SPIN>(tangent - row.tangent_impulse, state);
    row.tangent_impulse = tangent;

    let normal = (row.normal_impulse - row.normal_mass * (row.normal_speed(state) - row.wanted_speed)).max(0.0);
    let change = normal - row.normal_impulse;
    row.push(change, state);
    row.normal_impulse = normal;
    (change / row.normal_mass).abs()
}
