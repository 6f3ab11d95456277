//! Equal balls in a row, and a ball between walls: elastic impacts that only exchange or reverse velocities.

/// Places of equal balls in a row at time `t` [m], in their order; all impacts are elastic and head-on.
///
/// Two equal masses exchange their velocities, so that without their size the balls pass through each other: the place of
/// ball i is the i-th smallest of x_j + v_j t (Jepsen, Dynamics of a simple many-body system of hard rods, J. Math. Phys. 6,
/// 1965), with a diameter [m] added for each ball on its left. Newton's cradle, for balls that touch or not.
pub fn elastic_row(places: &[f64], velocities: &[f64], diameter: f64, t: f64) -> Vec<f64> {
    let ghosts = places.iter().zip(velocities).enumerate();
    let mut ghosts: Vec<f64> = ghosts.map(|(i, (x, v))| x - diameter * i as f64 + v * t).collect();
    ghosts.sort_by(f64::total_cmp);
    ghosts.iter().enumerate().map(|(i, x)| x + diameter * i as f64).collect()
}

/// Place at time `t` [m] and velocity then [m/s] of a point that flies between two elastic walls at `low` and `high`: the way
/// is unfolded to a straight one and folded back. Reflections along one axis leave the other alone, so that a box is two of these.
pub fn reflected(place: f64, velocity: f64, [low, high]: [f64; 2], t: f64) -> (f64, f64) {
    let width = high - low;
    let unfolded = place - low + velocity * t;
    let crossings = libm::floor(unfolded / width);
    let rest = unfolded - crossings * width;
    // fmod is exact: odd numbers of reflections end in the mirror image.
    if libm::fmod(crossings, 2.0) == 0.0 { (low + rest, velocity) } else { (high - rest, -velocity) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_arriving_ball_sends_off_only_the_last() {
        let (places, velocities) = ([-1.0, 0.0, 0.2, 0.4, 0.6], [5.0, 0.0, 0.0, 0.0, 0.0]);
        // The gap of 0.8 m is crossed in 0.16 s.
        let after = elastic_row(&places, &velocities, 0.2, 0.36);
        let expected = [-0.2, 0.0, 0.2, 0.4, 1.6];
        assert!(after.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{after:?}");
    }

    #[test]
    fn balls_at_any_distance_go_as_impact_after_impact_leads() {
        let places = [0.0f64, 1.0, 1.7, 3.1, 4.0];
        let velocities = [3.0, -1.0, 0.5, -2.0, -2.5];
        let (diameter, end) = (0.3, 2.0);
        let (mut x, mut v, mut now) = (places, velocities, 0.0);
        // From impact to impact, the earliest first.
        loop {
            let meets = |i: usize| {
                let (gap, closing) = (x[i + 1] - x[i] - diameter, v[i] - v[i + 1]);
                if closing > 0.0 { gap.max(0.0) / closing } else { f64::INFINITY }
            };
            let next = (0..4).min_by(|a, b| meets(*a).total_cmp(&meets(*b))).unwrap();
            let step = meets(next).min(end - now);
            (0..5).for_each(|i| x[i] += step * v[i]);
            now += step;
            if now >= end {
                break;
            }
            v.swap(next, next + 1);
        }
        let found = elastic_row(&places, &velocities, diameter, end);
        assert!(found.iter().zip(x).all(|(a, b)| (a - b).abs() < 1e-14), "{found:?} and {x:?}");
    }

    #[test]
    fn a_point_between_walls_comes_back_after_two_widths() {
        let walls = [-2.0, 3.0];
        let period = 10.0 / 4.0;
        for t in [0.0, 0.3, 0.7, 1.6, 2.4] {
            let (x, v) = reflected(0.5, -4.0, walls, t);
            let again = reflected(0.5, -4.0, walls, t + 3.0 * period);
            assert!((again.0 - x).abs() < 1e-13 && again.1 == v && (walls[0]..=walls[1]).contains(&x));
        }
        // 2.5 m to the left wall, then 3.5 m back.
        assert_eq!(reflected(0.5, -4.0, walls, 1.5), (1.5, 4.0));
    }
}
