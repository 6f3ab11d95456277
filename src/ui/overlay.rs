//! What is written over the scene: grid labels, scale bar, legends, the read-out of what lies under the pointer.

use super::format::{digits, round_si, si};
use super::state::View;
use super::theme::{self, Colours, Theme};
use super::{companions, inspector, state};
use crate::app::companion::Report;
use crate::app::{Camera, Frame, pick};
use crate::engine::{DVec2, Id};
use crate::render::grid::Axis;
use crate::render::picture::VELOCITY_ARROW;
use crate::render::{self, colour, grid};
use egui::{
    Align, Align2, Color32, FontId, Galley, Label, Mesh, Painter, Pos2, Rect, RichText, Stroke, StrokeKind, Ui, pos2,
    vec2,
};
use std::sync::Arc;

/// The ranges of the picture's legends, from `Picture`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ranges {
    /// Tension at the ends of the colour map [N]; 0 while nothing has carried a force.
    pub tension: f64,
    /// Speed of the longest arrow [m/s]; 0 while nothing has moved.
    pub speed: f64,
}

/// Distance of the scale bar's plate from the canvas's right edge [points].
const EDGE: f32 = 8.0;
/// Distance of the plates from the canvas's lower edge, where the grid's labels are [points].
const LIFT: f32 = 18.0;
/// Height of the plate of a legend [points].
const PLATE_HEIGHT: f32 = 32.0;
/// Between a plate's edge and what is on it [points].
const PADDING: f32 = 7.0;
/// Width of the plate of a colour map [points].
const MAP_WIDTH: f32 = 190.0;
/// Height of the map itself [points].
const BAR_HEIGHT: f32 = 7.0;

/// Radius of the ring where two panes parted [points].
const PARTING_RADIUS: f32 = 9.0;

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
        let bar = self.scale_bar(&painter, canvas, &colours);
        // Along the lower edge: the upper one is kept for what went wrong.
        let mut shelf = Shelf::new(canvas, bar);
        let links = !self.frame.world.constraints().is_empty();
        if self.view.tension && links && self.ranges.tension > 0.0 {
            let end = round_si(self.ranges.tension, "N");
            let words = [format!("{end} push"), "0".into(), format!("{end} pull")];
            let colour = |share| shown(self.theme.scene().diverging(2.0 * share - 1.0));
            shelf.take(MAP_WIDTH).inspect(|plate| map_legend(&painter, *plate, colour, &words, &colours));
        }
        if self.view.speed && self.ranges.speed > 0.0 {
            let words = ["0".into(), String::new(), round_si(self.ranges.speed, "m/s")];
            let colour = |share| shown(render::viridis(share));
            shelf.take(MAP_WIDTH).inspect(|plate| map_legend(&painter, *plate, colour, &words, &colours));
        }
        if self.view.velocities && self.ranges.speed > 0.0 {
            let label = round_si(self.ranges.speed, "m/s");
            let galley = painter.layout_no_wrap(label, FontId::proportional(theme::SMALL), colours.text);
            let width = VELOCITY_ARROW as f32 + 8.0 + galley.size().x + 2.0 * PADDING;
            shelf.take(width).inspect(|plate| self.velocity_legend(&painter, *plate, galley, &colours));
        }
    }

    /// What is written over two panes side by side: their methods, and where they parted first.
    pub fn panes(&self, ui: &Ui, [own, beside]: [Rect; 2], report: &Report) {
        let painter = ui.painter_at(beside);
        if self.view.grid {
            self.grid_labels(&painter, beside, &self.theme.colours());
        }
        let title = |rect: Rect, text: String| self.label(ui, rect, rect.left_top() + vec2(8.0, 8.0), &text);
        title(own, format!("A: {}", companions::method_text(&self.frame.method)));
        match &report.frame {
            Some(frame) => title(beside, format!("B: {}", companions::method_text(&frame.method))),
            None => title(beside, "B: starting".into()),
        }
        if let Some(gap) = &report.gap {
            let text = format!("Apart: {}", companions::gap_text(gap, report.length));
            self.label(ui, beside, beside.left_top() + vec2(8.0, 34.0), &text);
        }
        let Some(parting) = &report.parting else { return };
        for (rect, at) in [(own, parting.here), (beside, parting.there)] {
            let place = self.camera.to_canvas(at);
            let place = rect.min + vec2(place.x as f32, place.y as f32);
            let colours = self.theme.colours();
            let painter = ui.painter_at(rect);
            painter.circle_stroke(place, PARTING_RADIUS, Stroke::new(1.5, colours.warning));
            if rect.contains(place) {
                self.label(ui, rect, place + vec2(12.0, -26.0), &format!("parted at {:.2} s", parting.time));
            }
        }
    }

    fn grid_labels(&self, painter: &Painter, canvas: Rect, colours: &Colours) {
        let font = FontId::proportional(theme::SMALL);
        let ground = shown(self.theme.scene().palette().background).gamma_multiply(0.8);
        for label in grid::labels(self.camera) {
            let at = label.at as f32;
            let galley = painter.layout_no_wrap(label.text, font.clone(), colours.weak);
            let corner = match label.axis {
                Axis::X => canvas.left_bottom() + vec2(at + 3.0, -2.0),
                Axis::Y => canvas.left_top() + vec2(4.0, at - 1.0),
            };
            let place = Align2::LEFT_BOTTOM.anchor_size(corner, galley.size());
            // The two rows would meet in the lower left corner; half a number would be another one.
            let in_corner = label.axis == Axis::Y && at > canvas.height() - 24.0;
            let behind_column = label.axis == Axis::X && at < 48.0;
            if !in_corner && !behind_column && canvas.contains_rect(place) {
                painter.rect_filled(place.expand2(vec2(2.0, 0.0)), 2.0, ground);
                painter.galley(place.min, galley, colours.weak);
            }
        }
    }

    /// The scale bar on its plate, in the lower right corner; where the plate lies.
    fn scale_bar(&self, painter: &Painter, canvas: Rect, colours: &Colours) -> Rect {
        let bar = grid::scale_bar(self.camera);
        let galley = painter.layout_no_wrap(bar.text, FontId::proportional(theme::SMALL), colours.text);
        let length = bar.points as f32;
        let size = vec2(length.max(galley.size().x) + 2.0 * PADDING, PLATE_HEIGHT);
        let plate = Rect::from_min_size(canvas.right_bottom() - vec2(EDGE, LIFT) - size, size);
        draw_plate(painter, plate, colours);
        let stroke = Stroke::new(1.5, colours.text);
        let tick = vec2(0.0, theme::GRID);
        let middle = plate.center_bottom() - vec2(0.0, PADDING);
        let (left, right) = (middle - vec2(length / 2.0, 0.0), middle + vec2(length / 2.0, 0.0));
        painter.line(vec![left - tick, left, right, right - tick], stroke);
        let words = Align2::CENTER_TOP.anchor_size(plate.center_top() + vec2(0.0, 3.0), galley.size());
        painter.galley(words.min, galley, colours.text);
        plate
    }

    /// An arrow of the length that the range's end has, with that speed in words.
    fn velocity_legend(&self, painter: &Painter, plate: Rect, words: Arc<Galley>, colours: &Colours) {
        draw_plate(painter, plate, colours);
        let start = plate.left_center() + vec2(PADDING, 0.0);
        let arrow = vec2(VELOCITY_ARROW as f32, 0.0);
        let colour = shown(self.theme.scene().palette().velocity);
        painter.arrow(start, arrow, Stroke::new(1.75, colour));
        let place = start + arrow + vec2(8.0, -words.size().y / 2.0);
        painter.galley(place, words, colours.text);
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

/// What to do with a scene in which there is nothing yet.
pub fn hint(ui: &mut Ui, canvas: Rect) {
    const WORDS: &str = "Nothing is here yet.\nPress a key 1 … 7, or choose something under Add, and click here to place it.\n\
                         W draws a wall, J, K and L join. Ctrl-O opens a scene.";
    let size = vec2((canvas.width() - 8.0 * theme::GRID).clamp(1.0, 420.0), 80.0);
    let words = RichText::new(WORDS).color(theme::colours(ui).weak);
    ui.put(Rect::from_center_size(canvas.center(), size), Label::new(words).wrap().halign(Align::Center));
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

/// Places for the plates of legends along the lower edge, from left to right and then upwards.
struct Shelf {
    left: f32,
    right: f32,
    /// Lower left corner of the next plate.
    next: Pos2,
}

impl Shelf {
    /// Between the column of grid labels and the scale bar.
    fn new(canvas: Rect, scale_bar: Rect) -> Shelf {
        let left = canvas.left() + 48.0;
        Shelf { left, right: scale_bar.left() - 2.0 * theme::GRID, next: pos2(left, canvas.bottom() - LIFT) }
    }

    /// A place for a plate, if the canvas is wide enough for it.
    fn take(&mut self, width: f32) -> Option<Rect> {
        if self.left + width > self.right {
            return None;
        }
        if self.next.x + width > self.right {
            self.next = pos2(self.left, self.next.y - PLATE_HEIGHT - theme::GRID);
        }
        let plate = Rect::from_min_size(self.next - vec2(0.0, PLATE_HEIGHT), vec2(width, PLATE_HEIGHT));
        self.next.x += width + 2.0 * theme::GRID;
        Some(plate)
    }
}

/// The ground of a legend, which keeps it legible over walls and bodies.
fn draw_plate(painter: &Painter, plate: Rect, colours: &Colours) {
    painter.rect_filled(plate, theme::GRID, colours.overlay);
}

/// A colour map, shares 0 … 1 from left to right, with words over its left end, middle and right end.
fn map_legend(painter: &Painter, plate: Rect, colour: impl Fn(f64) -> Color32, words: &[String; 3], colours: &Colours) {
    const STEPS: u32 = 32;
    draw_plate(painter, plate, colours);
    let room = plate.shrink2(vec2(PADDING, 0.0));
    let bar = Rect::from_min_max(
        pos2(room.left(), plate.bottom() - PADDING - BAR_HEIGHT),
        room.right_bottom() - vec2(0.0, PADDING),
    );
    let mut mesh = Mesh::default();
    for i in 0..=STEPS {
        let share = f64::from(i) / f64::from(STEPS);
        let x = bar.left() + bar.width() * share as f32;
        for y in [bar.top(), bar.bottom()] {
            mesh.colored_vertex(pos2(x, y), colour(share));
        }
        if i > 0 {
            let n = 2 * i;
            mesh.add_triangle(n - 2, n - 1, n);
            mesh.add_triangle(n - 1, n, n + 1);
        }
    }
    painter.add(mesh);
    painter.rect_stroke(bar, 0.0, Stroke::new(1.0, colours.line), StrokeKind::Outside);
    let places = [
        (bar.left_top(), Align2::LEFT_BOTTOM),
        (bar.center_top(), Align2::CENTER_BOTTOM),
        (bar.right_top(), Align2::RIGHT_BOTTOM),
    ];
    for ((at, align), words) in places.into_iter().zip(words) {
        painter.text(at - vec2(0.0, 2.0), align, words, FontId::proportional(theme::SMALL), colours.text);
    }
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
