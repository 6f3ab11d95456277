//! What touches and closes bounces, one pair after another; what does not bounce stops all at once.
//!
//! Simultaneous impacts are a sequence of impacts of two in a fixed order, so one runs through a row of balls as through Newton's cradle, and each
//! keeps momentum to rounding, and energy too where e = 1 without friction. Coulomb's law holds for the impulses: the tangential one ends the
//! sliding if |λ_t| ≤ μ λ_n allows it. Plastic impacts (e = 0, or a rebound too slow to be told from rest) hit a stack at once: Moreau's law
//! (J. J. Moreau, "Unilateral contact and dry friction in finite freedom dynamics", 1988), through [`Cone`].

use super::cone::{Cone, Normal};
use super::path::Path;
use super::rest::STICKS;
use super::touch::{Masses, Touch};

/// Passes over the contacts, before everything that still closes stops at once: 64 and four for each contact.
const PASSES: [usize; 2] = [64, 4];

/// Scratch memory, and the speed of rest.
#[derive(Debug, Default)]
pub(super) struct Collisions {
    /// A rebound that is slower ends in rest [m/s].
    pub rest: f64,
    /// Bounces since the start of the step.
    pub bounces: usize,
    plastic: Vec<Touch>,
    places: Vec<usize>,
}

impl Collisions {
    /// Changes the velocities until nothing closes. `false` if no impulses do that.
    pub fn resolve(&mut self, touches: &mut [Touch], cone: &mut Cone, masses: &Masses, paths: &mut [Path]) -> bool {
        for _ in 0..PASSES[0] + PASSES[1] * touches.len() {
            if self.bounce(touches, masses, paths) {
                continue;
            }
            let rest = self.rest;
            let stops = |touch: &Touch, speed: f64| touch.restitution * -speed <= rest;
            if !self.stop(touches, cone, masses, paths, stops) {
                return false;
            }
            if !touches.iter().any(|touch| self.closes(touch, paths)) {
                return true;
            }
        }
        self.stop(touches, cone, masses, paths, |_, _| true) && !touches.iter().any(|touch| self.closes(touch, paths))
    }

    /// Whether the surfaces approach by more than rounding.
    fn closes(&self, touch: &Touch, paths: &[Path]) -> bool {
        touch.normal_speed(paths) < -touch.rounding_speed(paths) - STICKS * self.rest
    }

    /// One pass of impacts of two; whether there were any.
    fn bounce(&mut self, touches: &mut [Touch], masses: &Masses, paths: &mut [Path]) -> bool {
        let before = self.bounces;
        for touch in touches {
            let speed = touch.normal_speed(paths);
            if self.closes(touch, paths) && touch.restitution * -speed > self.rest {
                let push = -(1.0 + touch.restitution) * speed * touch.normal_mass;
                let most = touch.friction * push;
                let rub = (-touch.tangent_speed(paths) * touch.tangent_mass).min(most).max(-most);
                touch.push([push, rub], masses, paths);
                self.bounces += 1;
            }
        }
        self.bounces > before
    }

    /// Stops at once what closes, of the contacts that `may` stop at their speed. `false` if it cannot.
    fn stop(
        &mut self,
        touches: &mut [Touch],
        cone: &mut Cone,
        masses: &Masses,
        paths: &mut [Path],
        may: impl Fn(&Touch, f64) -> bool,
    ) -> bool {
        self.plastic.clear();
        self.places.clear();
        let mut any = false;
        for (place, touch) in touches.iter().enumerate() {
            let speed = touch.normal_speed(paths);
            if speed <= touch.rounding_speed(paths) + STICKS * self.rest && may(touch, speed) {
                any |= self.closes(touch, paths);
                self.plastic.push(*touch);
                self.places.push(place);
            }
        }
        if !any {
            return true;
        }
        cone.begin(&self.plastic, masses);
        for (i, touch) in self.plastic.iter().enumerate() {
            cone.set_free(i, [touch.normal_speed(paths), touch.tangent_speed(paths)]);
        }
        if !cone.solve() {
            return false;
        }
        for (i, place) in self.places.iter().enumerate() {
            if cone.normal[i] == Normal::On {
                touches[*place].push(cone.multiplier(i), masses, paths);
            }
        }
        true
    }
}
