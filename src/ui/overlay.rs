//! What is written over the scene: grid labels, scale bar, legends, the read-out of what lies under the pointer.

use super::format::{digits, round_si, si};
use super::state::View;
use super::theme::{self, Colours, Theme};
use super::{inspector, state};
use crate::app::{Camera, Frame, pick};
use crate::engine::{DVec2, Id};
use crate::render::grid::Axis;
use crate::render::picture::VELOCITY_ARROW;
use crate::render::{colour, grid};
use egui::{Align2, Color32, FontId, Mesh, Painter, Pos2, Rect, Stroke, StrokeKind, Ui, pos2, vec2};

/// The ranges of the picture's legends, from `Picture`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ranges {
    /// Tension at the ends of the colour map [N]; 0 while nothing has carried a force.
    pub tension: f64,
    /// Speed of the longest arrow [m/s]; 0 while nothing has moved.
    pub speed: f64,
}

/// Distance of the legends from the canvas's edge [points].
const EDGE: f32 = 16.0;
/// Size of the tension legend's bar [points].
const BAR: egui::Vec2 = vec2(176.0, 8.0);

/// Everything that is written over the scene.
pub struct Overlay<'a> {
    pub frame: &'a Frame,
    pub camera: &'a Camera,
    pub view: View,
    pub theme: Theme,
    pub ranges: Ranges,
}

impl Overlay<'_> {
    /// Paints grid labels, scale bar and legends into `canvas`.
    pub fn paint(&self, ui: &Ui, canvas: Rect) {
        let painter = ui.painter_at(canvas);
        let colours = self.theme.colours();
        if self.view.grid {
            self.grid_labels(&painter, canvas, &colours);
        }
        self.scale_bar(&painter, canvas, &colours);
        // One row along the lower edge: the upper one is kept for what went wrong.
        let mut start = canvas.left_bottom() + vec2(56.0, -EDGE - 12.0);
        let links = !self.frame.world.constraints().is_empty();
        if self.view.tension && links && self.ranges.tension > 0.0 {
            self.tension_legend(&painter, start, &colours);
            start.x += BAR.x + 2.0 * EDGE;
        }
        if self.view.velocities && self.ranges.speed > 0.0 {
            self.velocity_legend(&painter, start, &colours);
        }
    }

    fn grid_labels(&self, painter: &Painter, canvas: Rect, colours: &Colours) {
        let font = FontId::proportional(theme::SMALL);
        for label in grid::labels(self.camera) {
            let at = label.at as f32;
            let (place, align) = match label.axis {
                Axis::X => (canvas.left_bottom() + vec2(at + 3.0, -2.0), Align2::LEFT_BOTTOM),
                Axis::Y => (canvas.left_top() + vec2(4.0, at - 1.0), Align2::LEFT_BOTTOM),
            };
            // The two rows would meet in the lower left corner.
            let in_corner = label.axis == Axis::Y && at > canvas.height() - 24.0;
            let behind_column = label.axis == Axis::X && at < 48.0;
            if !in_corner && !behind_column {
                painter.text(place, align, label.text, font.clone(), colours.weak.gamma_multiply(0.8));
            }
        }
    }

    fn scale_bar(&self, painter: &Painter, canvas: Rect, colours: &Colours) {
        let bar = grid::scale_bar(self.camera);
        let right = canvas.right_bottom() + vec2(-EDGE, -EDGE - 12.0);
        let left = right - vec2(bar.points as f32, 0.0);
        let stroke = Stroke::new(1.5, colours.text);
        let tick = vec2(0.0, theme::GRID);
        painter.line(vec![left - tick, left, right, right - tick], stroke);
        text(painter, left.lerp(right, 0.5) - vec2(0.0, 4.0), Align2::CENTER_BOTTOM, &bar.text, colours.text);
    }

    /// The diverging map with its ends and middle in newtons, its lower left corner at `start`.
    fn tension_legend(&self, painter: &Painter, start: Pos2, colours: &Colours) {
        let bar = Rect::from_min_size(start - vec2(0.0, BAR.y), BAR);
        let mut mesh = Mesh::default();
        const STEPS: u32 = 32;
        for i in 0..=STEPS {
            let share = f64::from(i) / f64::from(STEPS);
            let x = bar.left() + bar.width() * share as f32;
            let colour = shade(self.theme, 2.0 * share - 1.0);
            mesh.colored_vertex(pos2(x, bar.top()), colour);
            mesh.colored_vertex(pos2(x, bar.bottom()), colour);
            if i > 0 {
                let n = 2 * i;
                mesh.add_triangle(n - 2, n - 1, n);
                mesh.add_triangle(n - 1, n, n + 1);
            }
        }
        painter.add(mesh);
        painter.rect_stroke(bar, 0.0, Stroke::new(1.0, colours.line), StrokeKind::Outside);
        let above = vec2(0.0, -3.0);
        let end = round_si(self.ranges.tension, "N");
        let (push, pull) = (format!("{end} push"), format!("{end} pull"));
        small(painter, bar.left_top() + above, Align2::LEFT_BOTTOM, &push, colours.text);
        small(painter, bar.center_top() + above, Align2::CENTER_BOTTOM, "0", colours.text);
        small(painter, bar.right_top() + above, Align2::RIGHT_BOTTOM, &pull, colours.text);
    }

    /// An arrow of the length that the range's end has, with that speed.
    fn velocity_legend(&self, painter: &Painter, start: Pos2, colours: &Colours) {
        let length = VELOCITY_ARROW as f32;
        let start = start - vec2(0.0, 4.0);
        let colour = shown(self.theme.scene().palette().velocity);
        painter.arrow(start, vec2(length, 0.0), Stroke::new(1.75, colour));
        let label = round_si(self.ranges.speed, "m/s");
        text(painter, start + vec2(length + 8.0, 0.0), Align2::LEFT_CENTER, &label, colours.text);
    }

    /// What lies under the pointer, in words beside it.
    pub fn read_out(&self, ui: &Ui, canvas: Rect, hovered: Option<Id>, pointer: Option<Pos2>) {
        let (Some(id), Some(pointer)) = (hovered, pointer) else { return };
        let Some(words) = describe(self.frame, id) else { return };
        self.label(ui, canvas, pointer + vec2(14.0, 18.0), &words);
    }

    /// The one value of what is selected that matters most, beside it.
    pub fn selection_label(&self, ui: &Ui, canvas: Rect, selection: &[Id], hovered: Option<Id>) {
        let &[id] = selection else { return };
        if hovered == Some(id) {
            return;
        }
        let Some((at, words)) = value_label(self.frame, id) else { return };
        let place = self.camera.to_canvas(at);
        let place = canvas.min + vec2(place.x as f32, place.y as f32);
        if canvas.contains(place) {
            self.label(ui, canvas, place + vec2(12.0, -26.0), &words);
        }
    }

    /// Words on a plate that stays within the canvas.
    fn label(&self, ui: &Ui, canvas: Rect, at: Pos2, words: &str) {
        let painter = ui.painter_at(canvas);
        let colours = self.theme.colours();
        let galley = painter.layout_no_wrap(words.to_owned(), FontId::proportional(theme::SMALL + 1.0), colours.text);
        let size = galley.size() + vec2(12.0, 6.0);
        let room = canvas.shrink(4.0);
        let min =
            pos2(at.x.min(room.right() - size.x).max(room.left()), at.y.min(room.bottom() - size.y).max(room.top()));
        let plate = Rect::from_min_size(min, size);
        painter.rect(plate, theme::GRID, colours.overlay, Stroke::new(1.0, colours.line), StrokeKind::Inside);
        painter.galley(plate.min + vec2(6.0, 3.0), galley, colours.text);
    }
}

/// "Body 12 · 3.20 m/s · 0.500 kg", "Rod 44 · 12.3 N pull", "Wall 3".
pub fn describe(frame: &Frame, id: Id) -> Option<String> {
    let world = &frame.world;
    Some(match pick::item(world, id)? {
        pick::Item::Body(index) => {
            let body = world.bodies().get(index);
            let speed = digits(body.velocity.length());
            format!("Body {id} · {speed} m/s · {}", si(body.mass, "kg"))
        }
        pick::Item::Constraint(index) => {
            let kind = world.constraints().kind[index];
            let tension = inspector::tension_text(&kind, world.constraints().tension(index));
            format!("{} {id} · {tension}", kind.name())
        }
        pick::Item::Wall(_) => format!("Wall {id}"),
    })
}

fn value_label(frame: &Frame, id: Id) -> Option<(DVec2, String)> {
    let world = &frame.world;
    match pick::item(world, id)? {
        pick::Item::Body(index) => {
            let speed = si(world.bodies().velocity[index].length(), "m/s");
            Some((world.bodies().position[index], speed))
        }
        pick::Item::Constraint(index) => {
            let (a, b) = world.ends(index);
            let kind = world.constraints().kind[index];
            Some(((a + b) / 2.0, inspector::tension_text(&kind, world.constraints().tension(index))))
        }
        pick::Item::Wall(_) => None,
    }
}

fn text(painter: &Painter, at: Pos2, align: Align2, words: &str, colour: Color32) -> Rect {
    painter.text(at, align, words, FontId::proportional(theme::BODY), colour)
}

fn small(painter: &Painter, at: Pos2, align: Align2, words: &str, colour: Color32) -> Rect {
    painter.text(at, align, words, FontId::proportional(theme::SMALL), colour)
}

/// A colour of the tension map.
fn shade(theme: Theme, share: f64) -> Color32 {
    shown(theme.scene().diverging(share))
}

fn shown(colour: colour::Colour) -> Color32 {
    let [r, g, b, a] = colour.0;
    Color32::from_rgba_unmultiplied(r, g, b, a)
}

impl state::State {
    /// What the picture is to show, switches and hands together.
    pub fn overlay<'a>(&self, frame: &'a Frame, camera: &'a Camera, ranges: Ranges) -> Overlay<'a> {
        Overlay { frame, camera, view: self.view, theme: self.theme, ranges }
    }
}
