//! Contacts that last: their forces, constant until the next event.
//!
//! On a side of a wall the normal stays, so with constant forces all acceleration is constant: sliding, sticking and rolling are in closed form.
//! Two discs, or a disc and a corner, keep their normal only while their centres do not pass each other, as in a stack. Where one rolls over
//! another the forces change all the time; that is not carried here, and said.

use super::cone::{Cone, Normal, Tangent};
use super::path::Path;
use super::touch::{AT_END, Masses, Touch};
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
}

/// What is constant for a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Surroundings {
    pub gravity: DVec2,
    /// Relative speed below which what touches stays [m/s].
    pub rest: f64,
}

/// Finds the forces of all of `touches` that do not part, drives the bodies of `group` with them and gravity, and adds those that last to `held`.
/// `false` if the forces would not be constant, or none are found.
pub(super) fn settle(
    (group, touches): (&[usize], &[Touch]),
    surroundings: &Surroundings,
    (cone, resting): (&mut Cone, &mut Vec<Touch>),
    masses: &Masses,
    paths: &mut [Path],
    held: &mut Vec<Held>,
) -> bool {
    let gravity = surroundings.gravity.length();
    for place in group {
        paths[*place].drive = if masses.inverse_mass[*place] > 0.0 { surroundings.gravity } else { DVec2::ZERO };
        paths[*place].turn = 0.0;
    }
    let stays = |touch: &Touch| touch.normal_speed(paths) <= surroundings.rest + touch.rounding_speed(paths);
    resting.clear();
    resting.extend(touches.iter().filter(|touch| stays(touch)));
    if resting.is_empty() {
        return true;
    }
    cone.begin(resting, masses);
    for (i, touch) in resting.iter().enumerate() {
        let free = touch.normal.dot(paths[touch.a].drive - paths[touch.b].drive) + parting(touch, paths);
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
        return false;
    }
    let last = paths[group[0]].since;
    let first_new = held.len();
    for (i, touch) in resting.iter().enumerate().filter(|(i, _)| cone.normal[*i] == Normal::On) {
        let force = cone.multiplier(i);
        touch.drive(force, masses, paths);
        let slides = matches!(cone.tangent[i], Tangent::Slide(_));
        held.push(Held { touch: Touch { impulse: [0.0; 2], ..*touch }, force, since: last, slides });
    }
    stop_rounding((group, resting), surroundings, cone, masses, paths);
    let mut lasts = true;
    let mut place = 0;
    held.retain(|one| {
        place += 1;
        if place <= first_new {
            return true;
        }
        let touch = &one.touch;
        let moves = passing(touch, surroundings, paths);
        let turns = match touch.side {
            None => moves != 0.0,
            Some([back, ahead]) => moves != 0.0 && (if moves > 0.0 { ahead } else { back }) <= AT_END * touch.distance,
        };
        let loaded = one.force[0] > STILL * gravity * touch.normal_mass;
        lasts &= !(turns && loaded);
        !turns
    });
    lasts
}

/// Acceleration by which surfaces part when their centres pass each other, without any force [m/s²].
fn parting(touch: &Touch, paths: &[Path]) -> f64 {
    match touch.side {
        Some(_) => 0.0,
        None => {
            let speed = touch.passing_speed(paths);
            speed * speed / touch.distance
        }
    }
}

/// Whether and in which direction along the tangent the centres pass each other: its sign, or 0.
fn passing(touch: &Touch, surroundings: &Surroundings, paths: &[Path]) -> f64 {
    let speed = touch.passing_speed(paths);
    if speed.abs() > STICKS * surroundings.rest + touch.rounding_speed(paths) {
        return speed.signum();
    }
    let drive = touch.tangent().dot(paths[touch.a].drive - paths[touch.b].drive);
    if drive.abs() > STILL * surroundings.gravity.length() { drive.signum() } else { 0.0 }
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
