//! The bodies of a group and what they can touch: who touches whom now, and who meets whom when.

use super::meeting;
use super::path::{Drag, Path};
use super::root::Rounding;
use super::touch::{AT_END, Masses, Touch, side_of};
use crate::engine::body::NO_ROTOR;
use crate::engine::filter::Side;
use crate::engine::world::{Touching, World};

/// Surfaces nearer than this part of the smaller radius touch, and a few ulps of the coordinates more.
const TOUCH: f64 = 1e-11;
/// Surfaces that overlap by more than this part of the smaller radius are not carried.
const DEEP: f64 = 1e-4;
/// A wall goes on in another one where that is no farther than this part of the radius of the body that touches there.
const JOINED: f64 = 1e-6;

/// Bodies of a group and static ones in their reach, by place; dense indices of the world ascend with the places.
#[derive(Debug, Default)]
pub(super) struct Surfaces {
    pub body: Vec<u32>,
    pub masses: Masses,
    pub drag: Drag,
    radius: Vec<f64>,
    group: Vec<u32>,
    /// It can touch at all.
    solid: Vec<bool>,
}

/// Two surfaces overlap by more than is carried.
pub(super) struct TooDeep;

impl Surfaces {
    /// Makes the group anew, of dense indices, ascending.
    pub fn build(&mut self, world: &World, bodies: impl Iterator<Item = u32>) {
        self.body.clear();
        self.body.extend(bodies);
        let Surfaces { body, masses, drag, radius, group, solid } = self;
        let (all, rotors) = (&world.bodies, &world.bodies.rotors);
        let inertia = |i: usize| match all.rotor[i] {
            NO_ROTOR => 0.0,
            rotor => rotors.inverse_inertia[rotor as usize],
        };
        let of = || body.iter().map(|i| *i as usize);
        // After the last body the immovable world.
        masses.inverse_mass.clear();
        masses.inverse_mass.extend(of().map(|i| all.inverse_mass[i]).chain([0.0]));
        masses.inverse_inertia.clear();
        masses.inverse_inertia.extend(of().map(inertia).chain([0.0]));
        *drag = Drag(world.drag);
        radius.clear();
        radius.extend(of().map(|i| all.radius[i]));
        group.clear();
        group.extend(of().map(|i| all.group[i]));
        solid.clear();
        solid.extend(of().map(|i| all.is_solid(i)));
    }

    pub fn len(&self) -> usize {
        self.body.len()
    }

    /// Of all that can touch [m].
    pub fn least_radius(&self) -> f64 {
        let solid = self.radius.iter().zip(&self.solid).filter(|(_, solid)| **solid);
        solid.fold(f64::INFINITY, |least, (radius, _)| least.min(*radius))
    }

    pub fn is_dynamic(&self, place: usize) -> bool {
        self.masses.inverse_mass[place] > 0.0
    }

    fn side(&self, place: usize) -> Side {
        Side { solid: self.solid[place], group: self.group[place], movable: self.is_dynamic(place) }
    }

    fn may_touch(&self, i: usize, j: usize) -> bool {
        i != j && self.side(i).meets(self.side(j))
    }

    /// A gap that is nothing between two bodies [m]: a few ulps of what it is computed from.
    fn rounding_gap(&self, i: usize, j: usize, here: &[Path]) -> f64 {
        let size = |place: usize| here[place].position.abs().max_element() + self.radius[place];
        4.0 * f64::EPSILON * (size(i) + size(j))
    }

    /// A speed that is nothing, with room to what counts as closing [m/s].
    fn rounding_rate(&self, i: usize, here: &[Path]) -> f64 {
        2.0 * here[i].rounding_speed(self.radius[i])
    }

    /// Calls `visit` with every body that touches body `i`, ascending.
    pub fn touching(&self, i: usize, here: &[Path], mut visit: impl FnMut(usize)) -> Result<(), TooDeep> {
        for j in (0..self.len()).filter(|j| self.may_touch(i, *j)) {
            let least = self.radius[i].min(self.radius[j]);
            let gap = (here[i].position - here[j].position).length() - self.radius[i] - self.radius[j];
            if gap <= TOUCH * least + self.rounding_gap(i, j, here) {
                // Written so that a NaN is too deep.
                if !(gap >= -DEEP * least - self.rounding_gap(i, j, here)) {
                    return Err(TooDeep);
                }
                visit(j);
            }
        }
        Ok(())
    }

    /// The contact of two bodies, the one with the smaller place first.
    pub fn touch_of(&self, world: &World, i: usize, j: usize, here: &[Path]) -> Touch {
        let (a, b) = (i.min(j), i.max(j));
        let offset = here[a].position - here[b].position;
        let normal = offset.normalize_or(glam::DVec2::Y);
        let with = Touching::Body(self.body[b]);
        Touch::of(world, &self.masses, (a, b), self.body[a], with, (normal, offset.length()))
    }

    /// Adds the contacts of body `i` with walls, but for those with the seams of a floor made of pieces.
    pub fn touch_walls(&self, world: &World, i: usize, here: &[Path], touches: &mut Vec<Touch>) -> Result<(), TooDeep> {
        if !self.solid[i] {
            return Ok(());
        }
        let (centre, radius, first) = (here[i].position, self.radius[i], touches.len());
        for (wall, shape) in world.walls.iter().map(|wall| &wall.shape).enumerate() {
            let (distance, normal) = shape.distance(centre);
            let (gap, nothing) = (distance - radius, self.rounding_gap(i, i, here));
            if gap <= TOUCH * radius + nothing {
                if !(gap >= -DEEP * radius - nothing) {
                    return Err(TooDeep);
                }
                let with = Touching::Wall(wall as u32);
                let mut touch = Touch::of(world, &self.masses, (i, self.len()), self.body[i], with, (normal, distance));
                touch.side = side_of(shape, centre, normal, radius);
                touches.push(touch);
            }
        }
        self.leave_out_seams(world, i, here, touches, first);
        Ok(())
    }

    /// Removes contacts from `first` on, all of body `i`, with ends of walls where another wall goes on that it touches with its side.
    fn leave_out_seams(&self, world: &World, i: usize, here: &[Path], touches: &mut Vec<Touch>, first: usize) {
        let path = &here[i];
        let ends = |touch: &Touch| {
            let along = touch.tangent();
            let speed = along.dot(path.velocity);
            let heading = if speed != 0.0 { speed } else { along.dot(path.drive) };
            match touch.side {
                None => true,
                Some([back, ahead]) => {
                    heading > 0.0 && ahead <= AT_END * self.radius[i]
                        || heading < 0.0 && back <= AT_END * self.radius[i]
                }
            }
        };
        let mut place = first;
        while place < touches.len() {
            let touch = touches[place];
            let foot = path.position - touch.distance * touch.normal;
            let goes_on = touches[first..].iter().any(|other| {
                let Touching::Wall(wall) = other.with else { return false };
                other.with != touch.with
                    && !ends(other)
                    && world.walls[wall as usize].shape.distance(foot).0 <= JOINED * self.radius[i]
            });
            if ends(&touch) && goes_on {
                touches.remove(place);
            } else {
                if ends(&touch) {
                    // From here on it turns about the end.
                    touches[place].side = None;
                }
                place += 1;
            }
        }
    }

    /// When body `i` meets body `j`, within `end` [s] from now; `still` is a speed that is nothing [m/s].
    pub fn meets(&self, i: usize, j: usize, here: &[Path], end: f64, still: f64) -> Option<f64> {
        if !self.may_touch(i, j) {
            return None;
        }
        let motion = here[i].against(&here[j]);
        let rate = 2.0 * still + self.rounding_rate(i, here) + self.rounding_rate(j, here);
        let rounding = Rounding { gap: self.rounding_gap(i, j, here), rate };
        meeting::with_disc(&motion, self.drag, self.radius[i] + self.radius[j], end, rounding)
    }

    /// When body `i` meets a wall, within `end` [s] from now.
    pub fn meets_wall(&self, world: &World, i: usize, wall: usize, here: &[Path], end: f64, still: f64) -> Option<f64> {
        if !self.solid[i] {
            return None;
        }
        let (path, shape, radius) = (&here[i], &world.walls[wall].shape, self.radius[i]);
        let rounding = Rounding { gap: self.rounding_gap(i, i, here), rate: 2.0 * still + self.rounding_rate(i, here) };
        let time = meeting::with_wall(path, self.drag, (shape, radius), end, rounding)?;
        // Not the end of a wall that goes on in another one on which the body is.
        let there = path.at(path.since + time, self.drag);
        let (distance, normal) = shape.distance(there.position);
        let foot = there.position - distance * normal;
        let nothing = TOUCH * radius + rounding.gap;
        let is_on = |other: &crate::engine::shape::Shape| {
            let (apart, up) = other.distance(there.position);
            apart - radius <= nothing
                && other.distance(foot).0 <= JOINED * radius
                && side_of(other, there.position, up, radius).is_some()
        };
        let joined = side_of(shape, there.position, normal, radius).is_none()
            && world.walls.iter().enumerate().any(|(other, its)| other != wall && is_on(&its.shape));
        (!joined).then_some(time)
    }

    /// When a contact that lasts changes, within `end` [s] from now: sliding stops, or the side of a wall ends.
    pub fn changes(&self, touch: &Touch, slides: bool, here: &[Path], end: f64, still: f64) -> Option<f64> {
        let mut first: Option<f64> = None;
        let mut keep = |time: Option<f64>| {
            if let Some(time) = time.filter(|time| *time <= end) {
                first = Some(first.map_or(time, |first| first.min(time)));
            }
        };
        if slides {
            keep(meeting::standstill(touch.tangent_speed(here), touch.tangent_drive(here), self.drag));
        }
        if let Some([back, ahead]) = touch.side {
            let rounding = Rounding { gap: self.rounding_gap(touch.a, touch.a, here), rate: still };
            let (speed, drive) = (touch.passing_speed(here), touch.tangent().dot(here[touch.a].drive));
            for (way, sign) in [(ahead, 1.0), (back, -1.0)] {
                keep(meeting::after_way(way, sign * speed, sign * drive, self.drag, end, rounding));
            }
        }
        first
    }
}
