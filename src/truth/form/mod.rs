//! Which closed form a world follows, and its motion by it: what a scene names with `truth: (…, form: Bounce)`.
//!
//! The numbers of a formula are read off the world, so that a scene states none of them twice; a world that the formula is not
//! for is refused with what does not fit.

mod check;
mod contacts;
mod free;
mod impacts;
mod motion;

pub use motion::Motion;

use super::{SAMPLES_PER_SECOND, Trajectory, TruthError};
use crate::engine::{Motion as Mobility, World};
use serde::{Deserialize, Serialize};

/// The most bodies that may move in a scene with a closed form: every pair is watched for touching.
const MOST_MOVING: usize = 100;

/// A motion that [`super::closed_form`] has a formula for. One name covers every body of a scene that moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ClosedForm {
    /// Bodies that fly freely, with or without drag.
    Projectile,
    /// Bodies that swing along a spring to a fixed point, damped or not.
    Oscillator,
    /// Bodies on a rod to a fixed point, or discs pinned off their centres, let go at rest.
    Pendulum,
    /// Balls that bounce on a plane.
    Bounce,
    /// Bodies that meet in pairs, with nothing else near.
    Exchange,
    /// Equal balls on a line that meet elastically, in empty space or on a smooth floor.
    Row,
    /// Balls between elastic walls along the axes.
    Billiard,
    /// Blocks on a slope.
    Slide,
    /// Discs that turn, on a slope.
    Roll,
    /// Bodies that stand upright on each other and stay.
    Stack,
}

impl ClosedForm {
    /// All of them.
    pub const ALL: [ClosedForm; 10] = {
        use ClosedForm::*;
        [Projectile, Oscillator, Pendulum, Bounce, Exchange, Row, Billiard, Slide, Roll, Stack]
    };

    /// The name in a scene file.
    pub fn name(self) -> &'static str {
        match self {
            ClosedForm::Projectile => "Projectile",
            ClosedForm::Oscillator => "Oscillator",
            ClosedForm::Pendulum => "Pendulum",
            ClosedForm::Bounce => "Bounce",
            ClosedForm::Exchange => "Exchange",
            ClosedForm::Row => "Row",
            ClosedForm::Billiard => "Billiard",
            ClosedForm::Slide => "Slide",
            ClosedForm::Roll => "Roll",
            ClosedForm::Stack => "Stack",
        }
    }

    /// What a scene of this form holds, as the end of a sentence.
    pub fn holds(self) -> &'static str {
        match self {
            ClosedForm::Projectile => "bodies that nothing holds and that touch nothing",
            ClosedForm::Oscillator => "bodies that each swing along one spring to a fixed point",
            ClosedForm::Pendulum => "bodies that each start at rest on one rod or pin to a fixed point, without drag",
            ClosedForm::Bounce => "balls that each fall onto one plane, without drag or slip along it",
            ClosedForm::Exchange => "bodies that meet in pairs with nothing else near, without drag",
            ClosedForm::Row => {
                "equal balls on one line, fully elastic, without drag, and without gravity or on a smooth floor"
            }
            ClosedForm::Billiard => "balls between fully elastic smooth walls along the axes, without gravity and drag",
            ClosedForm::Slide => "particles that touch one plane each, without drag",
            ClosedForm::Roll => "discs that turn and touch one plane each, without drag",
            ClosedForm::Stack => "bodies at rest, each exactly above another or on a level plane, and touching it",
        }
    }

    /// The formulas with the numbers of `world`, whose state is that of time 0.
    pub fn motion(self, world: &World) -> Result<Motion, TruthError> {
        let parts = self.parts(world).map_err(|what| self.misfit(what))?;
        Ok(Motion { start: world.bodies().position.clone(), parts })
    }

    /// The motion over `seconds`, sampled every 1/60 s from 0 on; `length` [m] makes errors relative. Bodies that the formulas
    /// would lead through each other or through walls, or beyond the end of what they lie on, are refused.
    pub fn trajectory(self, world: &World, seconds: f64, length: f64) -> Result<Trajectory, TruthError> {
        let motion = self.motion(world)?;
        let rate = f64::from(SAMPLES_PER_SECOND);
        let times: Vec<f64> = (0..=(seconds * rate).round() as u64).map(|k| k as f64 / rate).collect();
        let mut watch = check::Watch::new(world, &motion);
        let mut positions = Vec::with_capacity(times.len());
        for &time in &times {
            let sample = motion.at(time);
            if !sample.iter().all(|position| position.is_finite()) {
                return Err(self.misfit("numbers so far apart that its formula cannot be calculated".to_owned()));
            }
            watch.look(time, &sample).map_err(|what| self.misfit(what))?;
            positions.push(sample);
        }
        Ok(Trajectory { times, positions, length, agreement: 0.0 })
    }

    fn parts(self, world: &World) -> Result<Vec<motion::Part>, String> {
        let moving = moving(world)?;
        let each = |part: fn(&World, usize) -> Result<motion::Part, String>| {
            moving.iter().map(|&i| part(world, i).map_err(|what| format!("{what} (body {i})"))).collect()
        };
        match self {
            ClosedForm::Projectile => each(free::projectile),
            ClosedForm::Oscillator => each(free::oscillator),
            ClosedForm::Pendulum => each(free::pendulum),
            ClosedForm::Bounce => each(contacts::bounce),
            ClosedForm::Slide => each(contacts::slide),
            ClosedForm::Roll => each(contacts::roll),
            ClosedForm::Billiard => each(impacts::billiard),
            ClosedForm::Exchange => impacts::exchange(world, &moving),
            ClosedForm::Stack => contacts::stack(world, &moving).map(|()| Vec::new()),
            ClosedForm::Row => impacts::row(world, &moving).map(|part| vec![part]),
        }
    }

    fn misfit(self, what: String) -> TruthError {
        TruthError::Misfit { form: self.name(), what, holds: self.holds() }
    }
}

/// Dense indices of the bodies that move.
fn moving(world: &World) -> Result<Vec<usize>, String> {
    let bodies = world.bodies();
    if bodies.motion.contains(&Mobility::Kinematic) {
        return Err("a kinematic body".into());
    }
    if world.grip().is_some() {
        return Err("a body that the mouse holds".into());
    }
    let moving: Vec<usize> = (0..bodies.len()).filter(|&i| world.is_dynamic(i)).collect();
    match moving.len() {
        0 => Err("nothing that moves".into()),
        n if n > MOST_MOVING => Err(format!("{n} bodies that move, more than {MOST_MOVING}")),
        _ => Ok(moving),
    }
}

/// Dense indices of the constraints on body `i`.
fn links(world: &World, i: usize) -> Vec<usize> {
    let c = world.constraints();
    (0..c.len()).filter(|&k| c.a[k] as usize == i || c.b[k] as usize == i).collect()
}

/// Refuses a body that anything is tied to.
fn refuse_links(world: &World, i: usize) -> Result<(), String> {
    match links(world, i).first() {
        Some(&k) => Err(format!("a {} on it", world.constraints().kind[k].name().to_lowercase())),
        None => Ok(()),
    }
}

fn refuse_drag(world: &World) -> Result<(), String> {
    if world.drag() == 0.0 { Ok(()) } else { Err(format!("a drag of {:?} 1/s", world.drag())) }
}
