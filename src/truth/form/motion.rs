//! A world's motion by formulas.

use crate::engine::DVec2;
use crate::truth::closed_form::{
    BouncingBall, Encounter, Oscillator, Pendulum, Roll, Slide, elastic_row, fall_with_drag, reflected,
};

/// Where every body of a world is, at any time.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// All bodies at time 0; those that no part moves stay there [m].
    pub(super) start: Vec<DVec2>,
    pub(super) parts: Vec<Part>,
}

/// One or more bodies whose motion is a formula of its own. Bodies are dense indices.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Part {
    Free {
        body: usize,
        velocity: DVec2,
        gravity: DVec2,
        drag: f64,
    },
    /// A motion along two axes, each by itself.
    Axes {
        body: usize,
        axes: [DVec2; 2],
        courses: [Course; 2],
        ground: Option<Ground>,
    },
    /// `down` is the direction of gravity, `arm` the distance of the centre from the pivot [m].
    Pendulum {
        body: usize,
        pivot: DVec2,
        down: DVec2,
        arm: f64,
        pendulum: Pendulum,
    },
    Pair {
        bodies: [usize; 2],
        encounter: Encounter,
    },
    /// Balls in the order of their places along the axis; a place is the way from the first one's start.
    Row {
        bodies: Vec<usize>,
        origin: DVec2,
        axis: DVec2,
        places: Vec<f64>,
        velocities: Vec<f64>,
        diameter: f64,
    },
}

/// The straight piece of a wall that a body lies or bounces on [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ground {
    pub from: DVec2,
    pub to: DVec2,
}

/// Way along an axis from the place at time 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Course {
    Still,
    Accelerated {
        velocity: f64,
        acceleration: f64,
    },
    Oscillator(Oscillator),
    Bounce(BouncingBall),
    Slide(Slide),
    Roll(Roll),
    /// Between two walls, as ways from the start.
    Reflected {
        velocity: f64,
        walls: [f64; 2],
    },
}

impl Course {
    fn at(&self, t: f64) -> f64 {
        match self {
            Course::Still => 0.0,
            Course::Accelerated { velocity, acceleration } => t * (velocity + 0.5 * acceleration * t),
            Course::Oscillator(oscillator) => oscillator.at(t).0 - oscillator.position,
            Course::Bounce(ball) => ball.at(t).height - ball.height,
            Course::Slide(slide) => slide.at(t).0,
            Course::Roll(roll) => roll.at(t).way,
            Course::Reflected { velocity, walls } => reflected(0.0, *velocity, *walls, t).0,
        }
    }
}

impl Motion {
    /// Centres of all bodies at time `t` ≥ 0, in the order of the world [m].
    pub fn at(&self, t: f64) -> Vec<DVec2> {
        let mut positions = self.start.clone();
        for part in &self.parts {
            match part {
                Part::Free { body, velocity, gravity, drag } => {
                    positions[*body] = fall_with_drag(self.start[*body], *velocity, *gravity, *drag, t).0;
                }
                Part::Axes { body, axes, courses, .. } => {
                    positions[*body] += courses[0].at(t) * axes[0] + courses[1].at(t) * axes[1];
                }
                Part::Pendulum { body, pivot, down, arm, pendulum } => {
                    let at = arm / pendulum.length * pendulum.at(t);
                    positions[*body] = *pivot + at.x * down.perp() - at.y * *down;
                }
                Part::Pair { bodies, encounter } => {
                    let found = encounter.at(t);
                    bodies.iter().zip(found).for_each(|(body, (position, _))| positions[*body] = position);
                }
                Part::Row { bodies, origin, axis, places, velocities, diameter } => {
                    let found = elastic_row(places, velocities, *diameter, t);
                    bodies.iter().zip(found).for_each(|(body, place)| positions[*body] = *origin + place * *axis);
                }
            }
        }
        positions
    }
}
