//! Arrows at the edge of the canvas to what moves out of view.

use super::format::{count, si};
use super::theme;
use crate::app::{Camera, Frame};
use crate::engine::{DVec2, Id, Motion};
use egui::{Align2, FontId, Pos2, Rect, Role, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo, vec2};

/// Distance of an arrow's tip from the edge, and size of the arrow [points].
const INSET: f64 = 12.0;
const SIZE: f32 = 11.0;
/// Bodies whose arrows would be nearer to each other than this share one [points].
const APART: f32 = 48.0;
/// Side of the square that takes a click [points].
const REACH: f32 = 28.0;

/// An arrow to one body or to several that lie the same way.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrow {
    /// Its tip on the screen, and where it points.
    pub tip: Pos2,
    direction: Vec2,
    /// The body nearest to the view, where it is [m], and how far from the middle of the view [m].
    pub body: Id,
    position: DVec2,
    distance: f64,
    /// How many bodies it stands for.
    pub count: usize,
}

impl Arrow {
    /// The part of the canvas that belongs to it.
    pub fn rect(&self) -> Rect {
        Rect::from_center_size(self.tip - self.direction * SIZE / 2.0, Vec2::splat(REACH))
    }
}

/// Arrows to all bodies that can move of which nothing is seen.
pub fn arrows(frame: &Frame, camera: &Camera, canvas: Rect) -> Vec<Arrow> {
    let bodies = frame.world.bodies();
    let half = camera.size / 2.0;
    let room = (half - INSET).max(DVec2::ONE);
    let mut arrows: Vec<Arrow> = Vec::new();
    for index in (0..bodies.len()).filter(|index| bodies.motion[*index] != Motion::Static) {
        let position = bodies.position[index];
        let from_middle = camera.to_canvas(position) - half;
        let beyond = from_middle.abs() - half;
        if beyond.max_element() <= bodies.radius[index] * camera.scale || !from_middle.is_finite() {
            continue;
        }
        let at_edge = from_middle * (room / from_middle.abs()).min_element();
        let tip = canvas.min + vec2((half.x + at_edge.x) as f32, (half.y + at_edge.y) as f32);
        let direction = from_middle.normalize_or_zero();
        let arrow = Arrow {
            tip,
            direction: vec2(direction.x as f32, direction.y as f32),
            body: bodies.id[index],
            position,
            distance: from_middle.length() / camera.scale,
            count: 1,
        };
        match arrows.iter_mut().find(|other| other.tip.distance(tip) < APART) {
            Some(other) => {
                let count = other.count + 1;
                let nearer = if arrow.distance < other.distance { arrow } else { other.clone() };
                *other = Arrow { count, ..nearer };
            }
            None => arrows.push(arrow),
        }
    }
    arrows
}

/// Draws them. A click on one brings what it points to into the middle of the view.
pub fn show(ui: &Ui, arrows: &[Arrow], camera: &mut Camera) {
    let colours = theme::colours(ui);
    for arrow in arrows {
        let response = ui.interact(arrow.rect(), egui::Id::unique(("out of view", arrow.body)), Sense::click());
        let name = match arrow.count {
            1 => format!("Body {} is out of view", arrow.body),
            many => format!("{} bodies are out of view", count(many)),
        };
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
        let ink = if response.hovered() { colours.strong } else { colours.text };
        let side = arrow.direction.rot90() * SIZE * 0.45;
        let back = arrow.tip - arrow.direction * SIZE;
        let outline = Stroke::new(1.0, colours.overlay);
        ui.painter().add(Shape::convex_polygon(vec![arrow.tip, back + side, back - side], ink, outline));
        if arrow.count > 1 {
            let at = back - arrow.direction * SIZE;
            ui.painter().text(at, Align2::CENTER_CENTER, count(arrow.count), FontId::proportional(theme::SMALL), ink);
        }
        let help =
            format!("{name}: {} from the middle. Click to see it, Home to see everything.", si(arrow.distance, "m"));
        if response.on_hover_text(help).clicked() {
            camera.centre = arrow.position;
        }
    }
}
