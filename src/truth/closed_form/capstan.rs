//! A rope over a round peg with friction.

/// The ratio of the tensions at which a rope round a peg begins to slip: e^(μφ) for an angle `wrap` [rad] in contact (Euler,
/// Remarques sur l'effet du frottement dans l'équilibre, 1762). For a chain of short links it is the limit of [`peg_ratio`].
pub fn capstan_ratio(friction: f64, wrap: f64) -> f64 {
    libm::exp(friction * wrap)
}

/// The same for a chain without weight that touches a peg in `contacts` single points (nodes that lie on it) and turns by the
/// same angle at each, `wrap` [rad] in all; what a rope of discs on a peg does. `None` if a single contact can hold any tension.
///
/// At a node that turns by δ the balance across and along the peg is N = (T + T') sin(δ/2) and (T' − T) cos(δ/2) = μ N, hence
/// T'/T = (1 + μ tan(δ/2))/(1 − μ tan(δ/2)).
pub fn peg_ratio(friction: f64, wrap: f64, contacts: u32) -> Option<f64> {
    let half = 0.5 * wrap / f64::from(contacts);
    let grip = friction * libm::tan(half);
    (contacts > 0 && grip < 1.0).then(|| libm::exp(f64::from(contacts) * (libm::log1p(grip) - libm::log1p(-grip))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::DVec2;
    use std::f64::consts::PI;

    #[test]
    fn the_ratio_solves_the_ropes_equation_of_balance() {
        // dT/dφ = μ T over half a turn, by the classical Runge-Kutta method.
        let (friction, steps) = (0.3, 100);
        let h = PI / f64::from(steps);
        let mut tension = 1.0;
        for _ in 0..steps {
            let k1 = friction * tension;
            let k2 = friction * (tension + 0.5 * h * k1);
            let k3 = friction * (tension + 0.5 * h * k2);
            let k4 = friction * (tension + h * k3);
            tension += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        }
        assert!((tension - capstan_ratio(0.3, PI)).abs() < 1e-9);
    }

    #[test]
    fn a_node_on_the_peg_is_in_balance_at_the_limit_of_friction() {
        let (friction, turn) = (0.4, 0.3f64);
        let ratio = peg_ratio(friction, turn, 1).unwrap();
        // The bisector is the y axis, the peg below: both tensions point down it by half the turn.
        let pulls = ratio * DVec2::new(f64::cos(0.5 * turn), -f64::sin(0.5 * turn))
            + DVec2::new(-f64::cos(0.5 * turn), -f64::sin(0.5 * turn));
        let (normal, tangent) = (-pulls.y, pulls.x);
        assert!((tangent - friction * normal).abs() < 1e-15, "{tangent} of {}", friction * normal);
    }

    #[test]
    fn many_contacts_make_a_capstan_and_few_hold_more() {
        let limit = capstan_ratio(0.3, PI);
        let few = peg_ratio(0.3, PI, 3).unwrap();
        let [coarse, fine] = [50, 100].map(|n| peg_ratio(0.3, PI, n).unwrap() - limit);
        // Second order in the turn at a contact.
        assert!(few > limit && ((coarse / fine).log2() - 2.0).abs() < 0.01, "{few}, {coarse:e}, {fine:e}");
        assert_eq!([0, 1].map(|n| peg_ratio(0.3, PI, n)), [None; 2]);
    }
}
