//! Contacts that last, and their forces.
//!
//! On a side of a wall the normal stays, so with constant forces all acceleration is constant: sliding, sticking and rolling are in closed form.
//! Two discs, or a disc and a corner, keep their normal only while their centres do not pass each other, as in a stack. Where one rolls over
//! another the forces change all the time, and the motion is no longer in closed form ([`super::rolling`]).

use super::cone::{Cone, Normal, Tangent};
use super::path::Path;
use super::touch::{Masses, Touch};
use glam::DVec2;

/// Part of the speed of rest below which surfaces stick.
pub(super) const STICKS: f64 = 1e-3;
/// Part of gravity below which an acceleration is rounding.
const STILL: f64 = 1e-10;

/// A contact that lasts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Held {
    pub touch: Touch,
    /// Along the normal and the tangent [N].
    pub force: [f64; 2],
    /// Since when [s].
    pub since: f64,
    /// The surfaces slide.
    pub slides: bool,
    /// The force changes all the time.
    pub curved: bool,
    /// Its place in the problem that it was found by.
    row: usize,
}

/// What the forces of a group are like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Forces {
    Constant,
    Changing,
    Unknown,
}

/// What is constant for a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Surroundings {
    pub gravity: DVec2,
    /// Relative speed below which what touches stays [m/s].
    pub rest: f64,
}

/// Finds the forces of all of `touches` that do not part, drives the bodies of `group` with them and gravity, and adds those that last to `held`;
/// these act in the set of `cone` then, others do not.
pub(super) fn settle(
    (group, touches): (&[usize], &[Touch]),
    surroundings: &Surroundings,
    (cone, resting): (&mut Cone, &mut Vec<Touch>),
    masses: &Masses,
    paths: &mut [Path],
    held: &mut Vec<Held>,
) -> Forces {
    let gravity = surroundings.gravity.length();
    for place in group {
        paths[*place].drive = if masses.inverse_mass[*place] > 0.0 { surroundings.gravity } else { DVec2::ZERO };
        paths[*place].turn = 0.0;
    }
    let stays = |touch: &Touch| touch.normal_speed(paths) <= surroundings.rest + touch.rounding_speed(paths);
    resting.clear();
    resting.extend(touches.iter().filter(|touch| stays(touch)));
    if resting.is_empty() {
        return Forces::Constant;
    }
    cone.begin(resting, masses);
    for (i, touch) in resting.iter().enumerate() {
        let free = touch.normal.dot(paths[touch.a].drive - paths[touch.b].drive) + touch.parting(paths);
        cone.set_free(i, [free, touch.tangent_drive(paths)]);
        if free > STILL * gravity {
            cone.normal[i] = Normal::Off;
        }
        let speed = touch.tangent_speed(paths);
        if speed.abs() > STICKS * surroundings.rest + touch.rounding_speed(paths) {
            cone.tangent[i] = Tangent::Slide(-speed.signum());
            cone.slides[i] = true;
        }
    }
    if !cone.solve() {
        return Forces::Unknown;
    }
    let since = paths[group[0]].since;
    let first_new = held.len();
    for (row, touch) in resting.iter().enumerate().filter(|(row, _)| cone.normal[*row] == Normal::On) {
        let force = cone.multiplier(row);
        touch.drive(force, masses, paths);
        let slides = matches!(cone.tangent[row], Tangent::Slide(_));
        held.push(Held { touch: Touch { impulse: [0.0; 2], ..*touch }, force, since, slides, curved: false, row });
    }
    stop_rounding((group, resting), surroundings, cone, masses, paths);
    // A contact that turns and carries nothing is left on its own.
    let turns = |touch: &Touch| touch.side.is_none() && passes(touch, surroundings, paths);
    let loaded = |one: &Held| one.force[0] > STILL * gravity * one.touch.normal_mass;
    let curved = held[first_new..].iter().any(|one| turns(&one.touch) && loaded(one));
    cone.normal.fill(Normal::Off);
    let mut place = 0;
    held.retain_mut(|one| {
        place += 1;
        if place <= first_new {
            return true;
        }
        let stays = loaded(one) || !turns(&one.touch);
        if stays {
            one.curved = curved;
            cone.normal[one.row] = Normal::On;
        }
        stays
    });
    if curved { Forces::Changing } else { Forces::Constant }
}

/// Whether the centres pass each other, or begin to.
fn passes(touch: &Touch, surroundings: &Surroundings, paths: &[Path]) -> bool {
    let drive = touch.tangent().dot(paths[touch.a].drive - paths[touch.b].drive);
    touch.passing_speed(paths).abs() > STICKS * surroundings.rest + touch.rounding_speed(paths)
        || drive.abs() > STILL * surroundings.gravity.length()
}

/// Takes away what speed is left where surfaces rest and stick, and accelerations of rounding: nothing creeps.
fn stop_rounding(
    (group, resting): (&[usize], &[Touch]),
    surroundings: &Surroundings,
    cone: &mut Cone,
    masses: &Masses,
    paths: &mut [Path],
) {
    let still = 1e-3 * STILL * surroundings.gravity.length();
    for place in group {
        let path = &mut paths[*place];
        path.drive = if path.drive.length() <= still { DVec2::ZERO } else { path.drive };
    }
    let mut any = false;
    for (i, touch) in resting.iter().enumerate() {
        let [normal, tangent] = [touch.normal_speed(paths), touch.tangent_speed(paths)];
        let sticks = cone.tangent[i] == Tangent::Stick;
        any |= cone.normal[i] == Normal::On && (normal != 0.0 || sticks && tangent != 0.0);
        cone.set_free(i, [normal, tangent]);
    }
    if any && cone.solve_set() {
        for (i, touch) in resting.iter().enumerate().filter(|(i, _)| cone.normal[*i] == Normal::On) {
            let mut touch = *touch;
            touch.push(cone.multiplier(i), masses, paths);
        }
    }
}
