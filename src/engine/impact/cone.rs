//! Contacts that act at once: u = A λ + b with A = J M⁻¹ Jᵀ, 0 ≤ λ_n ⊥ u_n ≥ 0, and Coulomb's cone |λ_t| ≤ μ λ_n with friction against u_t.
//!
//! u are accelerations and λ forces for contacts that last, or speeds after and impulses of a plastic impact. An active set: some normals act,
//! some tangents stick (u_t = 0), the others slide (λ_t = ±μ λ_n); the equations of a set are solved directly, and the worst condition that the
//! solution breaks changes the set. Where contacts are redundant the shortest of all solutions is taken (least squares by QR), so the
//! count of contacts is no matter. Mass ratios of 1e6 cost no more than equal ones. The order of changes is fixed.
//!
//! Cost: some (2 m)³ for each change of the set. Fails, and says so, where friction makes the set cycle.

use super::touch::{Masses, Touch};
use crate::engine::linalg::dense::{Matrix, Qr};

/// Parts of the largest force or speed that count as nothing.
const NOTHING: f64 = 1e-11;
/// Most changes of a set, and so many more for each contact.
const CHANGES: [usize; 2] = [32, 8];
/// Sweeps of projected Gauss-Seidel where changes cycle.
const SWEEPS: u32 = 200;
/// Most times a step that Gauss-Seidel is asked for: what needs more does not run in real time.
const RESCUES: u32 = 4;
/// Most cubes of the rows solved for, and squares of those swept, in a sixtieth of a second: some milliseconds. A heap of a hundred discs needs more than all else together, and does
/// not run in real time.
const MOST_WORK: f64 = 1e7;
/// Part of the largest force that is rounding.
const ROUNDING: f64 = 1e-13;
/// Part of the right-hand side that may be left over where rows are redundant; more is a contradiction.
const UNSOLVED: f64 = 1e-9;
/// Columns that are independent by less than this are redundant.
const DEPENDENT: f64 = 1e-12;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Normal {
    Off,
    On,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Tangent {
    Stick,
    /// λ_t = sign · μ λ_n.
    Slide(f64),
}

/// One problem after another, in the same memory.
#[derive(Debug, Default)]
pub(super) struct Cone {
    /// Rows 2 i and 2 i + 1 are the normal and the tangent of contact i, scaled to a diagonal of 1.
    a: Matrix,
    b: Vec<f64>,
    scale: Vec<f64>,
    friction: Vec<f64>,
    pub normal: Vec<Normal>,
    pub tangent: Vec<Tangent>,
    /// The contact slides already, so that its friction has its direction.
    pub slides: Vec<bool>,
    /// The solution, by row.
    lambda: Vec<f64>,
    /// Of the solution's entries.
    largest: f64,
    speed: Vec<f64>,
    /// Rows of the unknowns of the present set.
    unknown: Vec<usize>,
    reduced: Matrix,
    right: Vec<f64>,
    found: Vec<f64>,
    qr: Qr,
    /// Times that Gauss-Seidel was asked for, and the work of all solves, in this step; and the most of it.
    rescues: u32,
    work: f64,
    most_work: f64,
}

impl Cone {
    /// Begins a step, `sixtieths` of a second long.
    pub fn forget_work(&mut self, sixtieths: f64) {
        (self.rescues, self.work, self.most_work) = (0, 0.0, MOST_WORK * sixtieths);
    }

    /// Begins a problem: A of these contacts, everything acting and sticking, b = 0.
    pub fn begin(&mut self, touches: &[Touch], masses: &Masses) {
        let m = touches.len();
        self.scale.clear();
        for touch in touches {
            self.scale.push(touch.normal_mass.sqrt());
            self.scale.push(touch.tangent_mass.sqrt());
        }
        self.a.reshape(2 * m, 2 * m);
        for i in 0..m {
            for j in 0..=i {
                let block = coupling(&touches[i], &touches[j], masses);
                for (k, entry) in block.into_iter().enumerate() {
                    let (row, column) = (2 * i + k / 2, 2 * j + k % 2);
                    let entry = entry * self.scale[row] * self.scale[column];
                    self.a[(row, column)] = entry;
                    self.a[(column, row)] = entry;
                }
            }
        }
        self.friction.clear();
        // λ = scale y, so the cone of the scaled unknowns has another slope.
        let slope = |(i, touch): (usize, &Touch)| touch.friction * self.scale[2 * i] / self.scale[2 * i + 1];
        self.friction.extend(touches.iter().enumerate().map(slope));
        self.normal.clear();
        self.normal.resize(m, Normal::On);
        self.tangent.clear();
        let first = |touch: &Touch| if touch.friction > 0.0 { Tangent::Stick } else { Tangent::Slide(1.0) };
        self.tangent.extend(touches.iter().map(first));
        self.slides.clear();
        self.slides.resize(m, false);
        for values in [&mut self.b, &mut self.lambda, &mut self.speed] {
            values.clear();
            values.resize(2 * m, 0.0);
        }
    }

    /// Sets what contact i would do without the others: along the normal and the tangent.
    pub fn set_free(&mut self, i: usize, free: [f64; 2]) {
        for (k, value) in free.into_iter().enumerate() {
            self.b[2 * i + k] = value * self.scale[2 * i + k];
        }
    }

    /// Force or impulse of contact i, along the normal and the tangent; a tangential one of rounding is none, so that what balances stands.
    pub fn multiplier(&self, i: usize) -> [f64; 2] {
        if self.lambda[2 * i + 1].abs() <= ROUNDING * self.largest {
            return [self.lambda[2 * i] * self.scale[2 * i], 0.0];
        }
        [self.lambda[2 * i] * self.scale[2 * i], self.lambda[2 * i + 1] * self.scale[2 * i + 1]]
    }

    /// Finds the set and its solution; `false` if it cycles, also from the set that projected Gauss-Seidel comes near to, or costs too much.
    pub fn solve(&mut self) -> bool {
        self.improve_set()
            || self.rescues < RESCUES && self.work <= self.most_work && {
                self.rescues += 1;
                self.work += f64::from(SWEEPS) * (self.lambda.len() as f64).powi(2);
                self.sweep();
                self.improve_set()
            }
    }

    fn improve_set(&mut self) -> bool {
        for _ in 0..CHANGES[0] + CHANGES[1] * self.normal.len() {
            if !self.solve_set() {
                return false;
            }
            if !self.change_set() {
                return true;
            }
        }
        false
    }

    /// Takes the set from sweeps of projected Gauss-Seidel, which never cycles and never ends.
    fn sweep(&mut self) {
        self.lambda.fill(0.0);
        for _ in 0..SWEEPS {
            for i in 0..self.normal.len() {
                let (n, t) = (2 * i, 2 * i + 1);
                self.lambda[n] = (self.lambda[n] - self.row_speed(n)).max(0.0);
                let most = self.friction[i] * self.lambda[n];
                self.lambda[t] = match self.tangent[i] {
                    Tangent::Slide(sign) if self.slides[i] || most == 0.0 => sign * most,
                    _ => (self.lambda[t] - self.row_speed(t)).min(most).max(-most),
                };
            }
        }
        for i in 0..self.normal.len() {
            let [pressed, rubbed] = [self.lambda[2 * i], self.lambda[2 * i + 1]];
            self.normal[i] = if pressed > 0.0 { Normal::On } else { Normal::Off };
            if !self.slides[i] && self.friction[i] > 0.0 {
                let inside = rubbed.abs() < (1.0 - 1e-6) * self.friction[i] * pressed;
                self.tangent[i] = if inside { Tangent::Stick } else { Tangent::Slide(rubbed.signum()) };
            }
        }
    }

    /// u of one row; the diagonal of A is 1.
    fn row_speed(&self, row: usize) -> f64 {
        self.b[row] + self.a.row(row).iter().zip(&self.lambda).map(|(a, lambda)| a * lambda).sum::<f64>()
    }

    /// Solves the equations of the present set for all right-hand sides like b; the rows that are zero after it.
    pub fn solve_set(&mut self) -> bool {
        self.unknown.clear();
        for i in 0..self.normal.len() {
            if self.normal[i] == Normal::On {
                self.unknown.push(2 * i);
                if self.tangent[i] == Tangent::Stick {
                    self.unknown.push(2 * i + 1);
                }
            }
        }
        let k = self.unknown.len();
        self.work += (k as f64).powi(3);
        if self.work > self.most_work {
            return false;
        }
        self.lambda.fill(0.0);
        self.found.clear();
        self.found.resize(k, 0.0);
        if k > 0 {
            self.reduced.reshape(k, k);
            self.right.clear();
            for row in 0..k {
                let r = self.unknown[row];
                self.right.push(-self.b[r]);
                for column in 0..k {
                    let c = self.unknown[column];
                    let mut entry = self.a[(r, c)];
                    if let (0, Tangent::Slide(sign)) = (c % 2, self.tangent[c / 2]) {
                        entry += self.a[(r, c + 1)] * sign * self.friction[c / 2];
                    }
                    self.reduced[(row, column)] = entry;
                }
            }
            if self.qr.factor(&self.reduced, DEPENDENT).is_err() {
                return false;
            }
            let left = self.qr.solve(&self.right, &mut self.found);
            if !(left <= UNSOLVED * largest(&self.right)) {
                return false;
            }
        }
        for (row, value) in self.unknown.iter().zip(&self.found) {
            self.lambda[*row] = *value;
            if let (0, Tangent::Slide(sign)) = (row % 2, self.tangent[row / 2]) {
                self.lambda[row + 1] = sign * self.friction[row / 2] * value;
            }
        }
        self.largest = largest(&self.lambda);
        self.a.times(&self.lambda, &mut self.speed);
        self.speed.iter_mut().zip(&self.b).for_each(|(speed, b)| *speed += b);
        true
    }

    /// Changes the set where the solution breaks a condition most; `false` if it breaks none. First what pulls, then what sticks beyond its
    /// cone, then what would sink in or is rubbed onwards.
    fn change_set(&mut self) -> bool {
        let (force, speed) = (NOTHING * self.largest, NOTHING * largest(&self.b));
        let change = self
            .worst(|i| self.pulls(i, force))
            .or_else(|| self.worst(|i| self.breaks_loose(i, force)))
            .or_else(|| self.worst(|i| self.sinks(i, speed).or_else(|| self.is_rubbed_onwards(i, speed))));
        if let Some((i, Change { normal, tangent, .. })) = change {
            (self.normal[i], self.tangent[i]) = (normal, tangent);
        }
        change.is_some()
    }

    /// The contact with the largest excess; of equal ones the first.
    fn worst(&self, find: impl Fn(usize) -> Option<Change>) -> Option<(usize, Change)> {
        let mut worst: Option<(usize, Change)> = None;
        for i in 0..self.normal.len() {
            if let Some(change) = find(i)
                && worst.is_none_or(|(_, worst)| change.excess > worst.excess)
            {
                worst = Some((i, change));
            }
        }
        worst
    }

    fn pulls(&self, i: usize, nothing: f64) -> Option<Change> {
        let excess = -self.lambda[2 * i];
        (self.normal[i] == Normal::On && excess > nothing).then(|| Change {
            excess,
            normal: Normal::Off,
            tangent: self.tangent[i],
        })
    }

    fn breaks_loose(&self, i: usize, nothing: f64) -> Option<Change> {
        let [pressed, rubbed] = [self.lambda[2 * i], self.lambda[2 * i + 1]];
        let excess = rubbed.abs() - self.friction[i] * pressed.max(0.0);
        (self.normal[i] == Normal::On && self.tangent[i] == Tangent::Stick && excess > nothing).then(|| Change {
            excess,
            normal: Normal::On,
            tangent: Tangent::Slide(rubbed.signum()),
        })
    }

    fn sinks(&self, i: usize, nothing: f64) -> Option<Change> {
        let excess = -self.speed[2 * i];
        let tangent = if self.slides[i] || self.friction[i] == 0.0 { self.tangent[i] } else { Tangent::Stick };
        (self.normal[i] == Normal::Off && excess > nothing).then_some(Change { excess, normal: Normal::On, tangent })
    }

    fn is_rubbed_onwards(&self, i: usize, nothing: f64) -> Option<Change> {
        let Tangent::Slide(sign) = self.tangent[i] else { return None };
        let excess = sign * self.speed[2 * i + 1];
        let may_stick = self.normal[i] == Normal::On && !self.slides[i] && self.friction[i] > 0.0;
        (may_stick && excess > nothing).then_some(Change { excess, normal: Normal::On, tangent: Tangent::Stick })
    }
}

/// A change of the set at one contact, and by how much the condition is broken there.
#[derive(Clone, Copy, Debug)]
struct Change {
    excess: f64,
    normal: Normal,
    tangent: Tangent,
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, value| largest.max(value.abs()))
}

/// The 2 × 2 block of J M⁻¹ Jᵀ for two contacts: (n, n), (n, t), (t, n), (t, t).
fn coupling(one: &Touch, other: &Touch, masses: &Masses) -> [f64; 4] {
    let mut block = [0.0; 4];
    let ends = |touch: &Touch| [(touch.a, 1.0, touch.arm_a), (touch.b, -1.0, touch.arm_b)];
    for (place, sign, arm) in ends(one) {
        for (_, other_sign, other_arm) in ends(other).into_iter().filter(|end| end.0 == place) {
            let w = masses.inverse_mass[place] * sign * other_sign;
            block[0] += w * one.normal.dot(other.normal);
            block[1] += w * one.normal.dot(other.tangent());
            block[2] += w * one.tangent().dot(other.normal);
            block[3] += w * one.tangent().dot(other.tangent()) + masses.inverse_inertia[place] * arm * other_arm;
        }
    }
    block
}
