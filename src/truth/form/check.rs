//! Watches that a motion by formulas stays where they hold: nothing goes through anything, and what lies on a wall stays over it.
//!
//! It looks at the samples only; what is thin and fast enough to pass between two of them is not seen.

use super::impacts::can_touch;
use super::motion::{Ground, Motion, Part};
use crate::engine::{DVec2, Shape, World};

/// Deepest overlap that is rounding [m].
const ROUNDING: f64 = 1e-8;

/// What could happen in a motion, found once.
pub(super) struct Watch<'a> {
    world: &'a World,
    /// Bodies that move and could touch walls.
    solid: Vec<usize>,
    /// Pairs that could touch, at least one of which moves.
    pairs: Vec<[usize; 2]>,
    grounds: Vec<(usize, Ground)>,
}

impl<'a> Watch<'a> {
    pub(super) fn new(world: &'a World, motion: &Motion) -> Watch<'a> {
        let bodies = world.bodies();
        let solid: Vec<usize> = (0..bodies.len())
            .filter(|&i| world.is_dynamic(i) && bodies.collides[i] && bodies.radius[i] > 0.0)
            .collect();
        let others =
            |&a: &usize| (0..bodies.len()).filter(move |&b| b > a || !world.is_dynamic(b)).map(move |b| [a, b]);
        let pairs = solid.iter().flat_map(others).filter(|&[a, b]| a != b && can_touch(world, a, b)).collect();
        let grounds = motion.parts.iter().filter_map(|part| match part {
            Part::Axes { body, ground: Some(ground), .. } => Some((*body, *ground)),
            _ => None,
        });
        Watch { world, solid, pairs, grounds: grounds.collect() }
    }

    /// Says what is wrong with the sample at `time`.
    pub(super) fn look(&mut self, time: f64, sample: &[DVec2]) -> Result<(), String> {
        let radius = &self.world.bodies().radius;
        for &[a, b] in &self.pairs {
            if sample[a].distance(sample[b]) < radius[a] + radius[b] - ROUNDING {
                return Err(format!("bodies {a} and {b}, which meet at {time:.3} s"));
            }
        }
        for &i in &self.solid {
            for (number, wall) in self.world.walls().iter().enumerate() {
                if distance(&wall.shape, sample[i]) < radius[i] - ROUNDING {
                    return Err(format!("body {i} and wall {number}, which meet at {time:.3} s"));
                }
            }
        }
        for &(i, ground) in &self.grounds {
            let way = ground.to - ground.from;
            if !(0.0..=way.length_squared()).contains(&(sample[i] - ground.from).dot(way)) {
                return Err(format!("body {i}, which comes to the end of its plane at {time:.3} s"));
            }
        }
        Ok(())
    }
}

/// From a point to a wall [m]; 0 within a box.
fn distance(shape: &Shape, point: DVec2) -> f64 {
    match *shape {
        Shape::Box { min, max } => (point - point.clamp(min, max)).length(),
        Shape::Segment { from, to } => {
            let way = to - from;
            let part = ((point - from).dot(way) / way.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            (point - from - part * way).length()
        }
    }
}
