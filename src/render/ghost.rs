//! The ghost: the truth, drawn translucently below the simulation.
//!
//! It stands where the picture has the simulation, shifted by what separated the two when they were last compared: so it
//! moves evenly between two steps, and a truth that comes a step later does not make it jump.

use super::colour::Colour;
use super::marks::Ends;
use super::picture::{DiscStyle, Picture, Scene};
use crate::app::companion::Offsets;
use crate::app::drawn::{self, ROD_WIDTH};
use crate::engine::constraint::WORLD;
use crate::engine::{DVec2, Kind, Motion};

/// How far behind the simulation the truth may be and still be drawn [s]: later the shift would be that of another motion.
pub const LATEST: f64 = 0.1;

/// How much of what is below is hidden.
const OPACITY: f64 = 0.5;

/// Draws the ghost, if the frame has one that is not too late.
pub(super) fn draw_ghost(picture: &mut Picture, scene: &Scene<'_>) {
    let world = &scene.frame.world;
    let Some(truth) = scene.frame.companions.truth.as_ref().filter(|_| scene.options.ghost) else { return };
    let report = truth.report();
    let fits = *report.offsets.bodies == world.bodies().id;
    if !fits || report.offsets.bodies.is_empty() || world.time() - report.time > LATEST {
        return;
    }
    let ghost = Ghost { scene, offsets: &report.offsets };
    let colour = scene.palette.ghost.with_opacity(OPACITY);
    let links = world.constraints();
    for index in 0..links.len() {
        if links.kind[index] != Kind::Pin {
            let ends = [(links.a[index], links.at_a[index]), (links.b[index], links.at_b[index])];
            let ends = ends.map(|(body, at)| scene.view.place(ghost.point(body, at)));
            picture.line(&scene.view, ends, ROD_WIDTH[0] as f32, Ends::Square, colour);
        }
    }
    for index in (0..world.bodies().len()).filter(|index| world.bodies().motion[*index] != Motion::Static) {
        ghost.draw_body(picture, index, colour);
    }
}

struct Ghost<'a> {
    scene: &'a Scene<'a>,
    offsets: &'a Offsets,
}

impl Ghost<'_> {
    fn position(&self, body: usize) -> DVec2 {
        self.scene.pose.position(body) + self.offsets.shift[body]
    }

    fn angle(&self, body: usize) -> Option<f64> {
        let turn = self.offsets.turn.get(body).copied().unwrap_or(0.0);
        self.scene.pose.angle(body).map(|angle| angle + turn)
    }

    /// An anchor in the world [m]: `body` as constraints store it.
    fn point(&self, body: u32, at: DVec2) -> DVec2 {
        if body == WORLD {
            return at;
        }
        let centre = self.position(body as usize);
        match self.angle(body as usize) {
            Some(angle) if at != DVec2::ZERO => centre + DVec2::from_angle(angle).rotate(at),
            _ => centre,
        }
    }

    fn draw_body(&self, picture: &mut Picture, body: usize, colour: Colour) {
        let radius = drawn::radius(&self.scene.frame.world, body, self.scene.view.scale);
        let at = self.scene.view.place(self.position(body));
        // Known motions say nothing of angles.
        let turns = !self.offsets.turn.is_empty() && radius > 4.0;
        let style =
            DiscStyle { fill: colour, stroke: colour, stroke_width: 1.0, heading: self.angle(body).filter(|_| turns) };
        picture.disc(&self.scene.view, at, radius, style);
    }
}
