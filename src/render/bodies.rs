//! Bodies: particles as dots, discs with a spoke, static ones bolted to the canvas.

use super::colour::{Colour, viridis};
use super::picture::{DiscStyle, Picture, Scene};
use crate::engine::{DVec2, Motion, World};

/// The largest speed of a body [m/s].
pub(super) fn speed_extreme(world: &World) -> f64 {
    world.bodies().velocity.iter().fold(0.0, |largest, velocity| velocity.length().max(largest))
}

/// Which bodies are drawn: links may lie between the two.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Mobility {
    Moving,
    Fixed,
}

/// Draws bodies, and the outlines of those selected or under the cursor.
pub(super) fn draw_bodies(picture: &mut Picture, scene: &Scene<'_>, mobility: Mobility) {
    let world = &scene.frame.world;
    let bodies = world.bodies();
    let wanted = |index: &usize| (bodies.motion[*index] == Motion::Static) == (mobility == Mobility::Fixed);
    for index in (0..bodies.len()).filter(wanted) {
        let at = scene.view.place(scene.pose.position(index));
        let radius = scene.radius(index);
        if bodies.motion[index] == Motion::Static {
            draw_bolt(picture, scene, at, radius);
        } else {
            let stroke_width = (0.08 * radius).clamp(0.75, 2.0) as f32;
            let fill = body_colour(scene, index);
            let style = DiscStyle {
                fill,
                stroke: fill.mix(scene.palette.body_stroke, 0.75),
                stroke_width,
                heading: scene.pose.angle(index).filter(|_| radius > 4.0),
            };
            picture.disc(&scene.view, at, radius, style);
            if bodies.motion[index] == Motion::Kinematic {
                picture.disc(&scene.view, at, 0.6 * radius, DiscStyle::ring(scene.palette.fixed_stroke, stroke_width));
            }
        }
        if let Some((colour, width)) = scene.outline(bodies.id[index]) {
            let ring = radius + 2.0 + f64::from(width);
            picture.disc(&scene.view, at, ring, DiscStyle::ring(colour, width));
        }
    }
}

/// The mark of what is fixed to the world: a plate with a bolt in its middle.
pub(super) fn draw_bolt(picture: &mut Picture, scene: &Scene<'_>, at: DVec2, radius: f64) {
    let palette = scene.palette;
    let plate = DiscStyle { fill: palette.fixed, stroke: palette.fixed_stroke, stroke_width: 1.5, heading: None };
    picture.disc(&scene.view, at, radius, plate);
    picture.disc(&scene.view, at, (0.3 * radius).min(4.0), DiscStyle::plain(palette.fixed_stroke));
}

fn body_colour(scene: &Scene<'_>, index: usize) -> Colour {
    let bodies = scene.frame.world.bodies();
    if scene.options.speed {
        return viridis(scene.speed.share(bodies.velocity[index].length()));
    }
    own_colour(scene, index)
}

/// The colour that a body keeps: for those that move by themselves given out in turn, by id; a particle within
/// something (a rope, a cloth) is grey, so that the colours of the tension beside it can be read.
pub(super) fn own_colour(scene: &Scene<'_>, index: usize) -> Colour {
    let bodies = scene.frame.world.bodies();
    if scene.sizes.links[index] > 1 && bodies.spin(index).is_none() {
        return scene.palette.node;
    }
    let colours = &scene.palette.bodies;
    colours[(bodies.id[index].0 % colours.len() as u64) as usize]
}
