//! Contact forces of what stands still.

/// Force between each body of an upright stack and what is below it [N], from the bottom up: the weight of the body and of
/// all above it. `masses` are listed from the bottom [kg], `gravity` [m/s²].
pub fn stack_forces(masses: &[f64], gravity: f64) -> Vec<f64> {
    let mut forces: Vec<f64> = masses.to_vec();
    let mut above = 0.0;
    for force in forces.iter_mut().rev() {
        above += *force;
        *force = above * gravity;
    }
    forces
}

/// Force in each contact of discs of the same radius that lean zigzag against two walls, without friction [N]: below each disc
/// from the bottom up, along the line of centres (the lowest on the floor), and of the walls on each disc. `lean` is the angle
/// of the lines of centres with the vertical [rad].
///
/// Below every disc the vertical part carries all that is above; the lines of centres lean, so each takes 1/cos of it, and the
/// walls the rest (statics of frictionless contacts, e.g. Timoshenko, Young, Engineering Mechanics, § 2).
pub fn wedged_forces(masses: &[f64], gravity: f64, lean: f64) -> (Vec<f64>, Vec<f64>) {
    let weights = stack_forces(masses, gravity);
    let (cosine, tangent) = (libm::cos(lean), libm::tan(lean));
    let below = weights.iter().enumerate().map(|(i, w)| if i == 0 { *w } else { w / cosine }).collect();
    // Sideways a disc gets w tan from the line below (none from the floor), and as much of what is above from the line above.
    let sideways = |i: usize| if i == 0 || i >= weights.len() { 0.0 } else { weights[i] * tangent };
    let walls = (0..weights.len()).map(|i| sideways(i) + sideways(i + 1)).collect();
    (below, walls)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::DVec2;

    #[test]
    fn every_body_carries_all_above_it() {
        assert_eq!(stack_forces(&[1.0, 2.0, 1000.0], 10.0), [10_030.0, 10_020.0, 10_000.0]);
        assert_eq!(stack_forces(&[], 10.0), [0.0; 0]);
    }

    #[test]
    fn discs_between_walls_are_in_balance() {
        let (masses, lean) = ([3.0, 1.0, 2.0, 0.5], 0.6f64);
        let (below, walls) = wedged_forces(&masses, 9.81, lean);
        for (i, mass) in masses.iter().enumerate() {
            // Even discs touch the left wall, odd ones the right; the line to the next one leans to the other side.
            let side = if i % 2 == 0 { 1.0 } else { -1.0 };
            let up = DVec2::new(side * lean.sin(), lean.cos());
            // From below: the line leaned the other way there, and pushes up it.
            let from_below =
                if i == 0 { below[0] * DVec2::Y } else { below[i] * DVec2::new(-side * lean.sin(), lean.cos()) };
            let from_above = below.get(i + 1).map_or(DVec2::ZERO, |force| -*force * up);
            let sum = from_below + from_above + walls[i] * side * DVec2::X - mass * 9.81 * DVec2::Y;
            assert!(sum.length() < 1e-13 * 100.0, "disc {i}: {sum:?}");
        }
    }
}
