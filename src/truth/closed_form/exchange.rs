//! Impacts of two discs: what they exchange, and their whole motion when nothing else is near.
//!
//! Newton's law of impact along the line of centres, Coulomb's across it: the normal impulse is j = (1 + e) m̄ u with the
//! closing speed u and 1/m̄ = 1/m₁ + 1/m₂; the tangential one ends the slip of the surfaces, or is as large as μ j lets it be.
//! For discs the two directions do not mix, so that this is the exact solution of Coulomb's law over an impact however short
//! (Routh, Dynamics of a System of Rigid Bodies, I, § 179 ff.; Brach, Mechanical Impact Dynamics, 1991, chapter 2).

use crate::engine::DVec2;

/// A disc in an impact. One that cannot be moved, such as a wall, has infinite mass and inertia.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hitting {
    /// [kg]
    pub mass: f64,
    /// About its centre [kg·m²]: ½ m r² of a solid disc; infinite for what does not turn.
    pub inertia: f64,
    /// [m]
    pub radius: f64,
    /// [m/s]
    pub velocity: DVec2,
    /// [rad/s]
    pub omega: f64,
}

/// Both discs right after an impact. `normal` is the unit vector from the second's centre to the first's, `restitution` e from
/// 0 to 1, `friction` μ ≥ 0. Discs that part already are left alone.
pub fn exchange(discs: [Hitting; 2], normal: DVec2, restitution: f64, friction: f64) -> [Hitting; 2] {
    let [a, b] = discs;
    let tangent = normal.perp();
    let apart = a.velocity - b.velocity;
    let closing = -normal.dot(apart);
    if !(closing > 0.0) {
        return discs;
    }
    let inverse = 1.0 / a.mass + 1.0 / b.mass;
    let push = (1.0 + restitution) * closing / inverse;
    // Speed of the first surface past the second one, at the point of contact.
    let slip = tangent.dot(apart) - a.radius * a.omega - b.radius * b.omega;
    let yielding = inverse + a.radius * a.radius / a.inertia + b.radius * b.radius / b.inertia;
    let rub = (-slip / yielding).clamp(-friction * push, friction * push);
    let impulse = push * normal + rub * tangent;
    [
        Hitting { velocity: a.velocity + impulse / a.mass, omega: a.omega - rub * a.radius / a.inertia, ..a },
        Hitting { velocity: b.velocity - impulse / b.mass, omega: b.omega - rub * b.radius / b.inertia, ..b },
    ]
}

/// Two discs with nothing else near, in a uniform field: parabolas, and at most one impact between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Encounter {
    /// Both at time 0.
    pub discs: [Hitting; 2],
    /// Their centres at time 0, apart by more than the sum of the radii [m].
    pub positions: [DVec2; 2],
    /// [m/s²]
    pub gravity: DVec2,
    /// Coefficient of restitution of the impact, 0 … 1.
    pub restitution: f64,
    /// Coefficient of friction of the impact, ≥ 0.
    pub friction: f64,
}

impl Encounter {
    /// When the surfaces meet [s], if they do: |d + w t| = r₁ + r₂, to which gravity, the same for both, adds nothing.
    pub fn impact_time(&self) -> Option<f64> {
        let d = self.positions[0] - self.positions[1];
        let w = self.discs[0].velocity - self.discs[1].velocity;
        let reach = self.discs[0].radius + self.discs[1].radius;
        let (a, half_b) = (w.length_squared(), d.dot(w));
        // (|d| − R)(|d| + R), so that a small gap keeps its digits.
        let c = (d.length() - reach) * (d.length() + reach);
        // |d|² a − (d·w)² = (d × w)²
        let root = reach * reach * a - d.perp_dot(w) * d.perp_dot(w);
        (half_b < 0.0 && root >= 0.0 && c >= 0.0).then(|| c / (root.sqrt() - half_b))
    }

    /// Centres [m] and motions of both at time `t`.
    pub fn at(&self, t: f64) -> [(DVec2, Hitting); 2] {
        let flown = |at: [DVec2; 2], discs: [Hitting; 2], t: f64| {
            [0, 1].map(|i| {
                let velocity = discs[i].velocity + t * self.gravity;
                let position = at[i] + t * (discs[i].velocity + 0.5 * t * self.gravity);
                (position, Hitting { velocity, ..discs[i] })
            })
        };
        match self.impact_time().filter(|hit| *hit <= t) {
            None => flown(self.positions, self.discs, t),
            Some(hit) => {
                let [a, b] = flown(self.positions, self.discs, hit);
                let after = exchange([a.1, b.1], (a.0 - b.0).normalize(), self.restitution, self.friction);
                flown([a.0, b.0], after, t - hit)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn disc(mass: f64, velocity: DVec2, omega: f64) -> Hitting {
        Hitting { mass, inertia: 0.5 * mass * 0.25 * 0.25, radius: 0.25, velocity, omega }
    }

    /// Momentum, angular momentum about the first centre, and energy of two discs whose centres are apart by `normal`/2.
    fn kept([a, b]: [Hitting; 2], normal: DVec2) -> (DVec2, f64, f64) {
        let momentum = a.mass * a.velocity + b.mass * b.velocity;
        let turning = a.inertia * a.omega + b.inertia * b.omega + (-0.5 * normal).perp_dot(b.mass * b.velocity);
        let energy = |h: Hitting| 0.5 * (h.mass * h.velocity.length_squared() + h.inertia * h.omega * h.omega);
        (momentum, turning, energy(a) + energy(b))
    }

    #[test]
    fn head_on_hits_share_speeds_as_the_masses_say() {
        for mass in [1.0, 10.0, 1000.0] {
            let at_rest = disc(1.0, DVec2::ZERO, 0.0);
            let [heavy, light] = exchange([disc(mass, DVec2::X, 0.0), at_rest], DVec2::NEG_X, 1.0, 0.0);
            // (m₁ − m₂)/(m₁ + m₂) and 2 m₁/(m₁ + m₂), every textbook.
            assert!((heavy.velocity.x - (mass - 1.0) / (mass + 1.0)).abs() < 1e-15);
            assert!((light.velocity.x - 2.0 * mass / (mass + 1.0)).abs() < 1e-15);
        }
    }

    #[test]
    fn momentum_and_angular_momentum_are_kept_and_energy_is_lost_by_what_theory_says() {
        for i in 0..50 {
            let turn = f64::from(i) * 0.7;
            let normal = DVec2::from_angle(turn);
            let pair = [
                disc(2.0 + turn, -3.0 * DVec2::from_angle(turn + 0.4), 5.0),
                disc(0.7, DVec2::from_angle(2.0 * turn) * 0.2, -3.0 + turn),
            ];
            for (e, friction) in [(1.0, 0.0), (0.5, 0.0), (0.8, 0.1), (1.0, 100.0), (0.0, 0.3)] {
                let after = exchange(pair, normal, e, friction);
                let ((p, l, energy), (q, m, left)) = (kept(pair, normal), kept(after, normal));
                assert!((p - q).length() < 1e-13 * p.length() && (l - m).abs() < 1e-12);
                let apart = |[a, b]: [Hitting; 2]| normal.dot(a.velocity - b.velocity);
                assert!((apart(after) + e * apart(pair)).abs() < 1e-14 * 10.0);
                // The loss along the normal is ½ m̄ (1 − e²) u² (Carnot); friction only adds to it.
                let reduced = 1.0 / (1.0 / pair[0].mass + 1.0 / pair[1].mass);
                let carnot = 0.5 * reduced * (1.0 - e * e) * apart(pair) * apart(pair);
                assert!(energy - left > carnot - 1e-12, "{e}, {friction}: {} and {carnot}", energy - left);
                assert!(friction > 0.0 || (energy - left - carnot).abs() < 1e-12);
            }
        }
    }

    /// The impact as it runs: the normal impulse rises little by little, friction opposes what slips at that moment.
    fn little_by_little([mut a, mut b]: [Hitting; 2], normal: DVec2, e: f64, friction: f64) -> [Hitting; 2] {
        let (tangent, steps) = (normal.perp(), 200_000);
        let closing = -normal.dot(a.velocity - b.velocity);
        let dj = (1.0 + e) * closing / (1.0 / a.mass + 1.0 / b.mass) / f64::from(steps);
        for _ in 0..steps {
            let slip = tangent.dot(a.velocity - b.velocity) - a.radius * a.omega - b.radius * b.omega;
            let rub = -friction * dj * if slip.abs() < 1e-5 { 0.0 } else { slip.signum() };
            let impulse = dj * normal + rub * tangent;
            a.velocity += impulse / a.mass;
            b.velocity -= impulse / b.mass;
            a.omega -= rub * a.radius / a.inertia;
            b.omega -= rub * b.radius / b.inertia;
        }
        [a, b]
    }

    #[test]
    fn friction_is_that_of_an_impact_followed_through() {
        let normal = DVec2::from_angle(0.3);
        let pair = [disc(2.0, DVec2::new(-3.0, 1.0), 8.0), disc(0.7, DVec2::new(0.5, -0.2), 2.0)];
        for friction in [0.05, 0.2, 2.0] {
            let (found, expected) =
                (exchange(pair, normal, 0.6, friction), little_by_little(pair, normal, 0.6, friction));
            for (f, x) in found.iter().zip(&expected) {
                let off = (f.velocity - x.velocity).length() + 0.25 * (f.omega - x.omega).abs();
                println!("friction {friction}: {off:.1e} m/s");
                // What slips by less than 1e-5 m/s counts as stuck there, and steps of the impulse are 1e-4 m/s.
                assert!(off < 1e-3, "{off:e}");
            }
        }
    }

    #[test]
    fn a_spinning_ball_on_a_wall_grips_or_slips() {
        let wall =
            Hitting { mass: f64::INFINITY, inertia: f64::INFINITY, radius: 0.0, velocity: DVec2::ZERO, omega: 0.0 };
        let ball = disc(1.0, DVec2::new(3.0, -2.0), 0.0);
        let [gripping, unmoved] = exchange([ball, wall], DVec2::Y, 0.5, 10.0);
        // Rolling afterwards with 2/3 of the speed along the wall: m v r is kept about the point of contact, I = ½ m r².
        assert!((gripping.velocity - DVec2::new(2.0, 1.0)).length() < 1e-15);
        assert!((gripping.omega + 2.0 / 0.25).abs() < 1e-14);
        assert_eq!(unmoved, wall);
        let [slipping, _] = exchange([ball, wall], DVec2::Y, 0.5, 0.1);
        assert!((slipping.velocity - DVec2::new(3.0 - 0.1 * 3.0, 1.0)).length() < 1e-15);
    }

    #[test]
    fn discs_meet_when_their_centres_are_as_far_apart_as_their_radii_add_up_to() {
        let encounter = Encounter {
            discs: [disc(1.0, DVec2::new(4.0, 0.3), 1.0), disc(3.0, DVec2::new(-1.0, 0.0), 0.0)],
            positions: [DVec2::new(-2.0, 0.1), DVec2::new(1.0, 0.3)],
            gravity: DVec2::new(0.0, -9.81),
            restitution: 0.7,
            friction: 0.2,
        };
        let hit = encounter.impact_time().unwrap();
        let apart = |t: f64| {
            let [a, b] = encounter.at(t);
            a.0.distance(b.0)
        };
        assert!((apart(hit) - 0.5).abs() < 1e-14 && apart(hit - 0.01) > 0.5 && apart(hit + 0.01) > 0.5);
        // The common centre does not feel the impact.
        for t in [0.3, hit, 1.0, 2.0] {
            let centre = |[a, b]: [(DVec2, Hitting); 2]| (a.0 + 3.0 * b.0) / 4.0;
            let start = (encounter.positions[0] + 3.0 * encounter.positions[1]) / 4.0;
            let velocity = DVec2::new(0.25, 0.075);
            let expected = start + t * velocity + 0.5 * t * t * encounter.gravity;
            assert!((centre(encounter.at(t)) - expected).length() < 1e-14 * 20.0);
        }
        let passing = Encounter { positions: [DVec2::new(-2.0, 1.1), DVec2::new(1.0, 0.3)], ..encounter };
        assert_eq!(passing.impact_time(), None);
        let parting = Encounter { positions: [DVec2::new(2.0, 0.1), DVec2::new(1.0, 0.3)], ..encounter };
        assert_eq!(parting.impact_time(), None);
    }
}
