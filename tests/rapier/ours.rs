//! Our side of a comparison.

use super::{Run, cheapest};
use tautline::engine::{Method, Stepper, World};

/// Steps a copy of `world` at 60 Hz for so many samples.
pub fn run(world: &World, method: Method, samples: usize) -> Run {
    cheapest(|| {
        let (mut world, mut stepper) = (world.clone(), Stepper::new(method).unwrap());
        Run::of(world.bodies().position.clone(), samples, || {
            let report = stepper.step(&mut world);
            assert!(report.divergence.is_none(), "{report:?}");
            world.bodies().position.clone()
        })
    })
}

/// By accuracy.
pub fn to(accuracy: f64) -> Method {
    Method { automatic: true, accuracy, ..Method::default() }
}
