//! What surfaces are made of, and what a contact has of the two that meet in it.

use super::world::Tuning;

/// A surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Coefficient of restitution, 0 … 1.
    pub restitution: f64,
    /// Coefficient of friction, ≥ 0.
    pub friction: f64,
}

impl Material {
    /// What a contact of two surfaces takes: the larger restitution and the geometric mean of the frictions, unless
    /// the world is tuned to one for all.
    #[must_use]
    pub fn mixed(self, other: Material, tuning: &Tuning) -> Material {
        Material {
            restitution: tuning.restitution.unwrap_or_else(|| self.restitution.max(other.restitution)),
            friction: tuning.friction.unwrap_or_else(|| (self.friction * other.friction).sqrt()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_contact_bounces_as_the_bouncier_one_and_rubs_as_both_unless_the_world_says_otherwise() {
        let (ice, rubber) =
            (Material { restitution: 0.1, friction: 0.04 }, Material { restitution: 0.8, friction: 1.0 });
        let plain = Tuning::default();
        assert_eq!(ice.mixed(rubber, &plain), Material { restitution: 0.8, friction: 0.2 });
        assert_eq!(rubber.mixed(ice, &plain), ice.mixed(rubber, &plain));
        let tuned = Tuning { restitution: Some(0.0), friction: Some(0.7), ..plain };
        assert_eq!(ice.mixed(rubber, &tuned), Material { restitution: 0.0, friction: 0.7 });
    }
}
