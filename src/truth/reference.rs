//! The reference solver: the motion of a scene to far more digits than a double has.

use super::double_double::{DoubleDouble, Vector};
use super::extrapolation::Extrapolation;
use super::system::System;
use super::{Trajectory, TruthError};
use crate::engine::{DVec2, World};

/// Samples of a truth a simulated second [Hz].
pub const SAMPLES_PER_SECOND: u32 = 60;

/// Tolerances of a step, relative to the size of the scene, of the two runs whose distance is the agreement.
pub const TOLERANCES: [f64; 2] = [1e-19, 1e-22];

/// The shortest step before a run is given up [s].
const SHORTEST: f64 = 1e-9;

/// A run of a world in double-double arithmetic, one sample at a time.
#[derive(Clone, Debug)]
pub struct Reference {
    system: System,
    extrapolation: Extrapolation,
    state: Vec<Vector>,
    /// All bodies as they stood at first.
    start: Vec<DVec2>,
    samples: u32,
    /// The step to try next [s].
    next: f64,
}

impl Reference {
    /// A run from the state of `world`, with `tolerance` for the error of a step relative to the size of the scene; 1e-10 to
    /// 1e-26 is sensible. The initial state is first put on its constraints, from which doubles may be an ulp away.
    pub fn new(world: &World, tolerance: f64) -> Result<Reference, TruthError> {
        let mut system = System::new(world)?;
        let mut state = system.state_of(world);
        system.project(&mut state);
        let start = world.bodies().position.clone();
        let size = start.iter().map(|point| (*point - start[0]).length()).fold(0.0, f64::max);
        let extent = if size > 0.0 { size } else { 1.0 };
        let extrapolation = Extrapolation::new(tolerance, extent, state.len());
        Ok(Reference { system, extrapolation, state, start, samples: 0, next: 1e-3 })
    }

    /// Goes on to the next sample, 1/60 s later.
    pub fn advance(&mut self) -> Result<(), TruthError> {
        let mut rest = DoubleDouble::from(1.0) / DoubleDouble::from(f64::from(SAMPLES_PER_SECOND));
        while rest.value() > 0.0 {
            // The last step ends on the sample, and none that is left over is tiny.
            let whole = rest.value() <= 1.01 * self.next;
            let h = if whole { rest } else { DoubleDouble::from(self.next.min(0.5 * rest.value())) };
            let outcome = self.extrapolation.step(&mut self.system, &mut self.state, h);
            if outcome.accepted {
                self.system.project(&mut self.state);
                rest = if whole { DoubleDouble::ZERO } else { rest - h };
                // A step cut short by the sample says little about the next one.
                self.next = outcome.next.max(if h.value() < 0.5 * self.next { self.next } else { 0.0 });
            } else {
                self.next = outcome.next;
                if !(self.next >= SHORTEST) {
                    return Err(TruthError::Stalled { time: self.time() });
                }
            }
        }
        self.samples += 1;
        Ok(())
    }

    /// Time of the sample at hand [s].
    pub fn time(&self) -> f64 {
        f64::from(self.samples) / f64::from(SAMPLES_PER_SECOND)
    }

    /// Centres of all bodies in the order of the world, those that do not move included [m].
    pub fn positions(&self) -> Vec<DVec2> {
        self.filled(&self.state[..self.system.bodies.len()], self.start.clone())
    }

    /// Velocities of all bodies in the order of the world [m/s].
    pub fn velocities(&self) -> Vec<DVec2> {
        self.filled(&self.state[self.system.bodies.len()..], vec![DVec2::ZERO; self.start.len()])
    }

    /// Accelerations of all bodies in the order of the world, as forces and rods make them [m/s²].
    pub fn accelerations(&mut self) -> Vec<DVec2> {
        let mut derivative = vec![Vector::ZERO; self.state.len()];
        self.system.derivative(&self.state, &mut derivative);
        self.filled(&derivative[self.system.bodies.len()..], vec![DVec2::ZERO; self.start.len()])
    }

    /// Kinetic, gravitational and elastic energy together [J].
    pub fn energy(&self) -> DoubleDouble {
        self.system.energy(&self.state)
    }

    fn filled(&self, values: &[Vector], mut all: Vec<DVec2>) -> Vec<DVec2> {
        self.system.bodies.iter().zip(values).for_each(|(&body, value)| all[body] = value.value());
        all
    }

    /// Sum of the squared distances of all particles from those of another run of the same world [m²].
    fn squared_distance(&self, other: &Reference) -> f64 {
        let count = self.system.bodies.len();
        let differences = self.state[..count].iter().zip(&other.state[..count]).map(|(a, b)| (*a - *b).value());
        differences.map(DVec2::length_squared).sum()
    }
}

/// The converged motion of `world` over `seconds`, sampled every 1/60 s from 0 on; `length` [m] makes errors relative.
/// Two runs are done side by side with the tolerances of [`TOLERANCES`]; the finer one is returned with their distance.
/// From milliseconds for a pendulum to minutes for a net of hundreds of rods.
pub fn converge(world: &World, seconds: f64, length: f64) -> Result<Trajectory, TruthError> {
    let [mut coarse, mut fine] = [Reference::new(world, TOLERANCES[0])?, Reference::new(world, TOLERANCES[1])?];
    let steps = (seconds * f64::from(SAMPLES_PER_SECOND)).round() as usize;
    let (mut times, mut positions) = (vec![0.0], vec![fine.positions()]);
    let mut sum = 0.0;
    for _ in 0..steps {
        coarse.advance()?;
        fine.advance()?;
        sum += fine.squared_distance(&coarse);
        times.push(fine.time());
        positions.push(fine.positions());
    }
    let count = (times.len() * world.bodies().len()).max(1) as f64;
    Ok(Trajectory { times, positions, length, agreement: (sum / count).sqrt() / length })
}
