//! Trails: where bodies were a moment ago, fading.

use super::bodies::own_colour;
use super::marks::Ends;
use super::picture::{Picture, Scene};
use crate::engine::{DVec2, Id, Motion};
use std::collections::{BTreeMap, VecDeque};

/// Points of all trails together: what draws without being felt.
const ALL_POINTS: usize = 20_000;
/// Points of one trail: four seconds at 60 states a second.
const LONGEST: usize = 240;
/// Points of one trail in a crowd.
const SHORTEST: usize = 8;
/// Shortest piece that is drawn [points].
const LEAST_PIECE: f64 = 0.5;

/// Least time between two points [s]: a little less than a step at 60 Hz, so that none of those is left out.
const INTERVAL: f64 = 1.0 / 66.0;

/// Past positions of bodies, oldest first.
#[derive(Clone, Debug, Default)]
pub(super) struct Trails {
    paths: BTreeMap<Id, VecDeque<DVec2>>,
    /// Opening and tick of the frame recorded last.
    last: Option<(u64, u64)>,
    /// Simulated time of the last point [s].
    time: f64,
}

impl Trails {
    /// Takes note of a frame, once: of the selected bodies, or of all if none is selected.
    pub(super) fn record(&mut self, scene: &Scene<'_>) {
        let (frame, options) = (scene.frame, scene.options);
        let (opened, tick) = (frame.scene.opened, frame.world.tick());
        let continues = self.last.is_some_and(|(open, last)| open == opened && last <= tick);
        if !options.trails || !continues {
            self.paths.clear();
        }
        let seen = options.trails && continues && self.last == Some((opened, tick));
        let before = self.last.filter(|_| continues);
        self.last = options.trails.then_some((opened, tick));
        if !options.trails || seen {
            return;
        }
        let bodies = frame.world.bodies();
        let any_selected = options.selected.iter().any(|id| bodies.index_of(*id).is_some());
        let wanted = |index: &usize| {
            bodies.motion[*index] != Motion::Static && (!any_selected || scene.is_selected(bodies.id[*index]))
        };
        let count = (0..bodies.len()).filter(wanted).count();
        let capacity = (ALL_POINTS / count.max(1)).clamp(SHORTEST, LONGEST);
        self.paths.retain(|id, _| bodies.index_of(*id).is_some_and(|index| wanted(&index)));
        let ids = (0..bodies.len()).filter(wanted).map(|index| (index, bodies.id[index]));
        // The steps since the last picture. Those of other bodies, from before an edit, the simulation has forgotten itself.
        let since = before.map_or(tick, |(_, last)| last);
        for moment in frame.trace.read().iter().filter(|moment| moment.tick > since && moment.tick < tick) {
            if moment.positions.len() == bodies.len() && moment.time - self.time >= INTERVAL {
                self.time = moment.time;
                self.extend(ids.clone(), &moment.positions, capacity);
            }
        }
        self.time = frame.world.time();
        self.extend(ids, &bodies.position, capacity);
    }

    /// Appends a point to the path of each body.
    fn extend(&mut self, ids: impl Iterator<Item = (usize, Id)>, positions: &[DVec2], capacity: usize) {
        for (index, id) in ids {
            let path = self.paths.entry(id).or_default();
            path.push_back(positions[index]);
            while path.len() > capacity {
                path.pop_front();
            }
        }
    }
}

/// Draws the trails, ending where the bodies are drawn.
pub(super) fn draw_trails(picture: &mut Picture, trails: &Trails, scene: &Scene<'_>) {
    let bodies = scene.frame.world.bodies();
    for (id, path) in &trails.paths {
        let Some(index) = bodies.index_of(*id) else {
            continue;
        };
        let colour = own_colour(scene, index);
        // The newest point may lie ahead of the interpolated body; the trail ends at the body instead.
        let past = path.len().saturating_sub(1);
        let mut points = path.iter().take(past).copied().chain([scene.pose.position(index)]).enumerate();
        let Some((_, mut last)) = points.next().map(|(i, point)| (i, scene.view.place(point))) else {
            continue;
        };
        for (i, point) in points {
            let point = scene.view.place(point);
            // A body at rest, or seen from far away, leaves no line worth drawing.
            if point.distance_squared(last) < LEAST_PIECE * LEAST_PIECE {
                continue;
            }
            let age = i as f64 / past as f64;
            picture.line(&scene.view, [last, point], 2.0, Ends::Square, colour.with_opacity(0.7 * age * age));
            last = point;
        }
    }
}
