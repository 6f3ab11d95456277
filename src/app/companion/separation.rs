//! How far two worlds are apart: now, since they began, and when it first could be seen.

use super::Pose;
use crate::engine::{DVec2, Id};
use crate::measure::{Distance, ErrorSum};
use std::sync::Arc;

/// Distance of a body from its double, in parts of the scene's length, from which the two can be told apart on a screen.
pub const VISIBLE: f64 = 0.01;

/// Distances of two worlds at one instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gap {
    /// Simulated time [s].
    pub time: f64,
    /// Root mean square over all bodies, those that are fixed too [m].
    pub rms: f64,
    /// Largest of one body [m].
    pub max: f64,
    /// What `rms` itself may be off by [m]: 0 where nothing is known of it.
    pub uncertainty: f64,
}

/// The first visible divergence of two worlds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parting {
    /// Simulated time [s].
    pub time: f64,
    /// The body that was furthest from its double.
    pub body: Id,
    /// Where the simulation had it then [m].
    pub here: DVec2,
    /// Where the other world had it then [m].
    pub there: DVec2,
}

/// By how much a world's bodies stand from those of the simulation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Offsets {
    /// The bodies, as the simulation orders them.
    pub bodies: Arc<Vec<Id>>,
    /// Shift of each [m].
    pub shift: Vec<DVec2>,
    /// Turn of each [rad]; empty if nothing turns or the turns are not known.
    pub turn: Vec<f64>,
}

/// Compares two worlds from step to step.
#[derive(Clone, Debug, Default)]
pub(super) struct Separation {
    pub gap: Option<Gap>,
    pub parting: Option<Parting>,
    pub offsets: Arc<Offsets>,
    bodies: Arc<Vec<Id>>,
    sum: ErrorSum,
}

impl Separation {
    /// Root mean square over all bodies and all samples so far [m].
    pub fn so_far(&self) -> f64 {
        self.sum.rms()
    }

    /// Takes note of where the simulation (`here`) and the other world (`there`) are; `length` [m] is the scene's, `uncertainty`
    /// [m] that of `there`. Nothing if they have not the same bodies.
    pub fn compare(&mut self, ids: &[Id], here: &Pose, there: &Pose, length: f64, uncertainty: f64) {
        let count = here.position.len();
        if ids.len() != count {
            return;
        }
        let Some(Distance { rms, max }) = self.sum.add(&there.position, &here.position) else { return };
        let shift: Vec<DVec2> = there.position.iter().zip(&here.position).map(|(b, a)| *b - *a).collect();
        self.gap = Some(Gap { time: here.time, rms, max, uncertainty });
        if self.parting.is_none() && max > VISIBLE * length {
            let by_length = |a: &usize, b: &usize| shift[*a].length_squared().total_cmp(&shift[*b].length_squared());
            let worst = (0..count).max_by(by_length).unwrap_or(0);
            let (body, here_at, there_at) = (ids[worst], here.position[worst], there.position[worst]);
            self.parting = Some(Parting { time: here.time, body, here: here_at, there: there_at });
        }
        let turn = if here.angle.len() == count && there.angle.len() == count {
            there.angle.iter().zip(&here.angle).map(|(b, a)| b - a).collect()
        } else {
            Vec::new()
        };
        if *self.bodies != ids {
            self.bodies = Arc::new(ids.to_vec());
        }
        self.offsets = Arc::new(Offsets { bodies: self.bodies.clone(), shift, turn });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pose(time: f64, points: &[(f64, f64)]) -> Pose {
        let position = points.iter().map(|(x, y)| DVec2::new(*x, *y)).collect();
        Pose { tick: 0, time, position, angle: Vec::new() }
    }

    #[test]
    fn distances_are_those_of_the_bodies_and_the_parting_is_kept() {
        let ids = [Id(1), Id(2)];
        let mut separation = Separation::default();
        separation.compare(
            &ids,
            &pose(0.0, &[(0.0, 0.0), (1.0, 0.0)]),
            &pose(0.0, &[(0.0, 0.0), (1.0, 0.0)]),
            10.0,
            0.0,
        );
        assert_eq!((separation.so_far(), separation.parting), (0.0, None));
        separation.compare(
            &ids,
            &pose(0.5, &[(0.0, 0.0), (1.0, 0.0)]),
            &pose(0.5, &[(0.0, 0.0), (1.0, 2.0)]),
            10.0,
            0.1,
        );
        let gap = separation.gap.expect("compared");
        // One of two bodies is 2 m off: √(4/2) m now, √(4/4) m over both samples.
        assert_eq!((gap.rms, gap.max, gap.uncertainty, separation.so_far()), (2f64.sqrt(), 2.0, 0.1, 1.0));
        let parting = separation.parting.expect("two metres of ten are seen");
        assert_eq!((parting.time, parting.body, parting.there), (0.5, Id(2), DVec2::new(1.0, 2.0)));
        separation.compare(
            &ids,
            &pose(1.0, &[(9.0, 0.0), (1.0, 0.0)]),
            &pose(1.0, &[(0.0, 0.0), (1.0, 2.0)]),
            10.0,
            0.0,
        );
        assert_eq!(separation.parting, Some(parting), "the first one counts");
        separation.compare(&ids[..1], &pose(2.0, &[(0.0, 0.0)]), &pose(2.0, &[]), 10.0, 0.0);
        assert_eq!(separation.gap.expect("kept").time, 1.0, "other bodies cannot be compared");
    }
}
