//! The one form of every constraint: an error C(q), rows of J, a stiffness (compliance α = 1/k, 0 when rigid), a damping,
//! and bounds on the multiplier. Solvers see this and nothing else.
//!
//! A row acts along a unit vector n at one point of each body: J = (−n, −r_a×n | n, r_b×n), so the forces on the two bodies
//! are equal and opposite. Ċ = J v, and its share of A = J M⁻¹ Jᵀ is K = w_a + w_b + (r_a×n)²/I_a + (r_b×n)²/I_b.

use super::{Kind, pin, rod, rope, spring};
use crate::engine::state::State;
use glam::DVec2;

/// Largest angle by which a correction of positions turns a body [rad]. It is computed along the tangent of the anchor's circle; more than this along a
/// tangent leads away from where it should.
const MOST_TURN: f64 = 0.5;

/// Way along the tangent in radii up to which a soft joint follows a chord.
const LONGEST_CHORD: f64 = 0.9;

/// What C measures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Measure {
    /// |p_b − p_a| − length: one row along the line between the ends.
    Distance { length: f64 },
    /// p_b − p_a: two rows, along x and y.
    Offset,
}

/// A constraint as the solvers see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Form {
    pub measure: Measure,
    /// 1/α [N/m]; infinite for a rigid constraint.
    pub stiffness: f64,
    /// [N·s/m]
    pub damping: f64,
    /// Bounds on λ [N]: a rope only pulls, so its λ ≤ 0.
    pub low: f64,
    pub high: f64,
}

impl Form {
    /// A rigid constraint that acts both ways.
    pub fn rigid(measure: Measure) -> Form {
        Form { measure, stiffness: f64::INFINITY, damping: 0.0, low: f64::NEG_INFINITY, high: f64::INFINITY }
    }

    /// The form of a constraint; `stiffness_factor` scales every spring.
    pub fn of(kind: &Kind, stiffness_factor: f64) -> Form {
        match *kind {
            Kind::Rod { length } => rod::form(length),
            Kind::Rope { length } => rope::form(length),
            Kind::Spring { rest, stiffness, damping } => spring::form(rest, stiffness * stiffness_factor, damping),
            Kind::Pin => pin::form(),
        }
    }

    /// Number of scalar rows.
    pub fn rows(&self) -> usize {
        match self.measure {
            Measure::Distance { .. } => 1,
            Measure::Offset => 2,
        }
    }
}

/// A constraint of the plan: its form, and its ends as indices into [`State`] (the world has the last index).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Joint {
    /// Index in the world's list of constraints.
    pub index: u32,
    pub a: u32,
    pub b: u32,
    pub at_a: DVec2,
    pub at_b: DVec2,
    pub form: Form,
}

/// One scalar row at the present positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Row {
    pub normal: DVec2,
    /// r_a × n and r_b × n [m].
    pub arm_a: f64,
    pub arm_b: f64,
    /// C [m].
    pub error: f64,
}

impl Joint {
    /// The rows of J and C at the present positions; a distance has one, and leaves the second unset.
    pub fn rows<const SPIN: bool>(&self, state: &State) -> [Option<Row>; 2] {
        let (r_a, r_b) = (state.arm::<SPIN>(self.a, self.at_a), state.arm::<SPIN>(self.b, self.at_b));
        let offset = state.position[self.b as usize] + r_b - state.position[self.a as usize] - r_a;
        let row =
            |normal: DVec2, error| Row { normal, arm_a: r_a.perp_dot(normal), arm_b: r_b.perp_dot(normal), error };
        match self.form.measure {
            Measure::Distance { length } => {
                let distance = offset.length();
                // Coinciding ends have no direction; any fixed one lets them part again.
                let normal = if distance > 0.0 { offset / distance } else { DVec2::X };
                [Some(row(normal, distance - length)), None]
            }
            Measure::Offset => [Some(row(DVec2::X, offset.x)), Some(row(DVec2::Y, offset.y))],
        }
    }

    /// K = J M⁻¹ Jᵀ of one row [1/kg].
    pub fn inverse_effective_mass<const SPIN: bool>(&self, row: &Row, state: &State) -> f64 {
        let (a, b) = (self.a as usize, self.b as usize);
        let mut k = state.inverse_mass[a] + state.inverse_mass[b];
        if SPIN {
            k += state.inverse_inertia[a] * row.arm_a * row.arm_a + state.inverse_inertia[b] * row.arm_b * row.arm_b;
        }
        k
    }

    /// K⁻¹ of the two rows of a pin at the present positions: its entries xx, xy, yy [kg].
    ///
    /// K = W 1 + i_a p pᵀ + i_b q qᵀ, with p and q the arms of the rows. Far outside a small disc the rows depend on each other nearly, and only its
    /// determinant in the form W² + W (i_a p² + i_b q²) + i_a i_b (p × q)² does not cancel.
    pub fn inverse_of_pin<const SPIN: bool>(&self, [x, y]: [&Row; 2], state: &State) -> [f64; 3] {
        let (a, b) = (self.a as usize, self.b as usize);
        let w = state.inverse_mass[a] + state.inverse_mass[b];
        if !SPIN {
            return [1.0 / w, 0.0, 1.0 / w];
        }
        let (i_a, i_b) = (state.inverse_inertia[a], state.inverse_inertia[b]);
        let (p, q) = (DVec2::new(x.arm_a, y.arm_a), DVec2::new(x.arm_b, y.arm_b));
        let cross = p.perp_dot(q);
        let determinant = w * w + w * (i_a * p.length_squared() + i_b * q.length_squared()) + i_a * i_b * cross * cross;
        let off = i_a * p.x * p.y + i_b * q.x * q.y;
        let (xx, yy) = (w + i_a * p.x * p.x + i_b * q.x * q.x, w + i_a * p.y * p.y + i_b * q.y * q.y);
        [yy / determinant, -off / determinant, xx / determinant]
    }

    /// Moves both bodies by a push along `rows` [kg·m], less where one of them would turn by more than [`MOST_TURN`].
    pub fn shift<const SPIN: bool>(&self, rows: &[Option<Row>; 2], push: DVec2, state: &mut State) {
        let (a, b) = (self.a as usize, self.b as usize);
        let along = rows.iter().flatten().zip([push.x, push.y]);
        let mut part = 1.0;
        if SPIN {
            let turn = |inertia: f64, arm: fn(&Row) -> f64| {
                inertia * along.clone().map(|(row, push)| arm(row) * push).sum::<f64>()
            };
            let (turn_a, turn_b) =
                (turn(state.inverse_inertia[a], |row| row.arm_a), turn(state.inverse_inertia[b], |row| row.arm_b));
            let most = turn_a.abs().max(turn_b.abs());
            if most > MOST_TURN {
                part = MOST_TURN / most;
            }
            state.angle[a] -= part * turn_a;
            state.angle[b] += part * turn_b;
        }
        for (row, push) in along {
            let push = part * push;
            state.position[a] -= state.inverse_mass[a] * push * row.normal;
            state.position[b] += state.inverse_mass[b] * push * row.normal;
        }
    }

    /// J v of one row [m/s].
    pub fn speed<const SPIN: bool>(&self, row: &Row, state: &State) -> f64 {
        let (a, b) = (self.a as usize, self.b as usize);
        let mut speed = row.normal.dot(state.velocity[b] - state.velocity[a]);
        if SPIN {
            speed += row.arm_b * state.omega[b] - row.arm_a * state.omega[a];
        }
        speed
    }

    /// ½ h J̇v of each row [m/s], at the present positions and velocities.
    ///
    /// A drift along J v = 0 leaves the circle on which a joint turns; one with J v = −½ h J̇v follows the chord of its arc and
    /// keeps the speed. Turning by more than a radian in `h` seconds counts as one radian. A soft joint forgets what a substep was off, so its chord
    /// ends on the circle exactly, where that of a rigid one leaves the fourth order to the feedback.
    pub fn half_turning<const SPIN: bool>(&self, state: &State, h: f64) -> DVec2 {
        let (a, b) = (self.a as usize, self.b as usize);
        let (r_a, r_b) = (state.arm::<SPIN>(self.a, self.at_a), state.arm::<SPIN>(self.b, self.at_b));
        let offset = state.position[b] + r_b - state.position[a] - r_a;
        let mut speed = state.velocity[b] - state.velocity[a];
        let mut towards_centre = DVec2::ZERO;
        if SPIN {
            let turning = |omega: f64| (omega * omega).min(1.0 / (h * h));
            towards_centre = turning(state.omega[a]) * r_a - turning(state.omega[b]) * r_b;
            speed += state.omega[b] * r_b.perp() - state.omega[a] * r_a.perp();
        }
        let distance = offset.length();
        match self.form.measure {
            Measure::Offset => 0.5 * h * towards_centre,
            Measure::Distance { .. } if distance > 0.0 => {
                let normal = offset / distance;
                let across = normal.perp_dot(speed).abs();
                let turned = h * across / distance;
                let turning = across * if self.form.stiffness.is_finite() { chord(turned) } else { turned.min(1.0) };
                DVec2::new(0.5 * (h * normal.dot(towards_centre) + turning), 0.0)
            }
            Measure::Distance { .. } => DVec2::ZERO,
        }
    }
}

/// Twice the slope of the chord that starts along the tangent by `turned` radii and ends on the circle: 2 (1 − √(1 − x²))/x, which is x for small x.
///
/// Where ends pass each other closely there is no such chord, nor any sense in one: it fades, as the same slope in every substep would feed the motion.
fn chord(turned: f64) -> f64 {
    let x = turned.min(LONGEST_CHORD);
    let fade = if turned > x { x / turned } else { 1.0 };
    // In the form that does not cancel.
    2.0 * x / (1.0 + (1.0 - x * x).sqrt()) * fade * fade
}
