//! What lies over the scene: contacts, velocities, the hand's grip, the mark of a fault, and the marks of tools.

use super::marks::Ends;
use super::options::Extra;
use super::picture::{DiscStyle, FORCE_TICK, Picture, Scene, VELOCITY_ARROW};
use crate::app::drawn::LEAST_DOT;
use crate::engine::{Contact, Motion, World};

/// The largest normal force of a contact [N].
pub(super) fn force_extreme(world: &World) -> f64 {
    world.contacts().iter().map(|contact| contact.normal_force).filter(|force| force.is_finite()).fold(0.0, f64::max)
}

/// Every contact that touches: its point, and a tick along its normal as long as its force is large.
pub(super) fn draw_contacts(picture: &mut Picture, scene: &Scene<'_>) {
    let world = &scene.frame.world;
    let touching = |force: f64, gap: f64| scene.options.contacts && (force > 0.0 || gap <= 0.0);
    let contacts = || world.contacts().iter().filter(|contact| touching(contact.normal_force, contact.gap));
    let place = |contact: &Contact| scene.view.place(contact.point + scene.pose.shift(contact.a as usize));
    // Among small discs the marks are small too, so that a pile shows its chains of force.
    let size = |contact: &Contact| (0.3 * scene.radius(contact.a as usize)).clamp(0.75, 2.5);
    for contact in contacts() {
        let at = place(contact);
        let length = 2.0 * size(contact) + FORCE_TICK * scene.force.share(contact.normal_force);
        let width = 0.7 * size(contact) as f32;
        picture.line(&scene.view, [at, at + contact.normal * length], width, Ends::Round, scene.palette.contact);
    }
    for contact in contacts() {
        picture.disc(&scene.view, place(contact), size(contact), DiscStyle::plain(scene.palette.contact));
    }
}

/// An arrow for the velocity of every body that moves.
pub(super) fn draw_velocities(picture: &mut Picture, scene: &Scene<'_>) {
    if !scene.options.velocities {
        return;
    }
    let bodies = scene.frame.world.bodies();
    for index in (0..bodies.len()).filter(|&index| bodies.motion[index] != Motion::Static) {
        let velocity = bodies.velocity[index];
        let length = VELOCITY_ARROW * scene.speed.share(velocity.length());
        if length < 2.0 {
            continue;
        }
        let from = scene.view.place(scene.pose.position(index));
        let to = from + velocity.normalize_or_zero() * length;
        picture.arrow(&scene.view, from, to, scene.palette.velocity);
    }
}

/// A ring around the body at which the run diverged.
pub(super) fn draw_fault(picture: &mut Picture, scene: &Scene<'_>) {
    let world = &scene.frame.world;
    let body = scene.frame.report.divergence.as_ref().map(|divergence| divergence.body);
    let Some(index) = body.and_then(|id| world.bodies().index_of(id)) else {
        return;
    };
    let at = scene.view.place(scene.pose.position(index));
    for (gap, width) in [(6.0, 2.5), (12.0, 1.0)] {
        let ring = scene.radius(index) + gap;
        picture.disc(&scene.view, at, ring, DiscStyle::ring(scene.palette.warning, width));
    }
}

/// A line from the grabbed point to the cursor, redder the more of the grip's largest force is in use.
pub(super) fn draw_grip(picture: &mut Picture, scene: &Scene<'_>) {
    let world = &scene.frame.world;
    let Some(grip) = world.grip() else {
        return;
    };
    let Some(index) = world.bodies().index_of(grip.body) else {
        return;
    };
    let own = (scene.pose.point(index as u32, grip.local), grip.target);
    let (held, hand) = scene.options.grip.unwrap_or(own);
    let [held, hand] = [held, hand].map(|point| scene.view.place(point));
    let colour = scene.options.theme.diverging(grip.load());
    picture.line(&scene.view, [held, hand], 2.0, Ends::Round, colour);
    picture.disc(&scene.view, held, LEAST_DOT, DiscStyle::plain(colour));
    picture.disc(&scene.view, hand, LEAST_DOT + 2.0, DiscStyle::ring(colour, 1.5));
}

/// The marks of the tool in hand.
pub(super) fn draw_extras(picture: &mut Picture, scene: &Scene<'_>) {
    let (view, accent) = (&scene.view, scene.palette.accent);
    for extra in &scene.options.extra {
        match *extra {
            Extra::Cut { from, to } => {
                picture.line(view, [view.place(from), view.place(to)], 2.0, Ends::Round, scene.palette.warning);
            }
            Extra::Line { from, to } => {
                picture.line(view, [view.place(from), view.place(to)], 2.0, Ends::Round, accent.with_opacity(0.8));
            }
            Extra::Disc { centre, radius } => {
                let style = DiscStyle {
                    fill: accent.with_opacity(0.25),
                    stroke: accent.with_opacity(0.8),
                    stroke_width: 1.5,
                    heading: None,
                };
                picture.disc(view, view.place(centre), (radius * view.scale).max(LEAST_DOT), style);
            }
            Extra::Snap { at } => picture.disc(view, view.place(at), 6.0, DiscStyle::ring(accent, 1.5)),
        }
    }
}
