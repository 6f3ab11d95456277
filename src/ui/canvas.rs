//! The canvas: an egui widget that shows nothing itself and hands pointer, wheel and pinch to the tools and the camera.

use super::actions::is_free;
use super::theme;
use crate::app::tools::{Button, Modifiers, Phase, PointerEvent, Tool, Tools};
use crate::app::{Action, Camera, Command, Frame, pick};
use crate::engine::DVec2;
use egui::{
    CursorIcon, Event, EventFilter, Id, MouseWheelUnit, PointerButton, Pos2, Rect, Response, Role, Sense, Stroke, Ui,
    WidgetInfo, pos2, vec2,
};

/// Points of smooth scrolling that count as a notch of the wheel.
const POINTS_A_NOTCH: f32 = 40.0;

/// The widget's id: there is one scene.
pub fn id() -> Id {
    Id::unique("scene canvas")
}

/// Takes all the room that is left: where the scene goes, and where its rival does, if it has one. Both are equally large.
pub fn room(ui: &mut Ui, rival: bool) -> (Rect, Option<Rect>) {
    let rect = ui.available_rect_before_wrap();
    ui.advance_cursor_after_rect(rect);
    if !rival {
        return (rect, None);
    }
    let middle = rect.center().x;
    let half = vec2(((rect.width() - BETWEEN) / 2.0).floor(), rect.height());
    ui.painter().vline(middle, rect.y_range(), Stroke::new(BETWEEN, theme::colours(ui).line));
    let left = Rect::from_min_size(rect.min, half);
    (left, Some(Rect::from_min_size(pos2(rect.right() - half.x, rect.top()), half)))
}

/// The pane of the rival: the wheel, a pinch and a drag move the view of both.
pub fn follow(ui: &Ui, rect: Rect, camera: &mut Camera) {
    let response = ui.interact(rect, Id::unique("rival canvas"), Sense::drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "Rival canvas"));
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_description(RIVAL_HELP));
    if response.dragged() {
        camera.pan(point(response.drag_delta()));
    }
    let canvas = Canvas { ui, rect, covered: &[], blocked: ui.ctx().any_popup_open() };
    for event in ui.input(|input| input.events.clone()) {
        match event {
            Event::MouseWheel { unit, delta, .. } => canvas.wheel(unit, delta.y, &Tools::default(), camera),
            Event::Zoom(factor) => canvas.pinch(factor, camera),
            _ => {}
        }
    }
}

/// Width of the line between two panes [points].
const BETWEEN: f32 = 2.0;

const RIVAL_HELP: &str = "The same scene under the other method. Drag or turn the wheel to move the view of both.";

/// Lays the scene's widget into `rect`. Returns what happened there.
pub fn allocate(ui: &Ui, rect: Rect) -> Response {
    let response = ui.interact(rect, id(), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "Scene canvas"));
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_description(HELP));
    response
}

/// What a screen reader says of the canvas; a tooltip would hide the scene.
const HELP: &str = "The scene. Drag a body to take hold of it, right-click for a menu, turn the wheel to zoom.";

/// Hands the pass's events to the tools, but for those on what lies over the scene (`covered`). Returns the commands that
/// follow.
pub fn handle(
    ui: &Ui,
    response: &Response,
    covered: &[Rect],
    tools: &mut Tools,
    frame: &Frame,
    camera: &mut Camera,
) -> Vec<Command> {
    let mut commands = Vec::new();
    let canvas = Canvas { ui, rect: response.rect, covered, blocked: ui.ctx().any_popup_open() };
    let (events, held, space) =
        ui.input(|input| (input.events.clone(), input.modifiers, input.key_down(egui::Key::Space)));
    let modifiers = |held: egui::Modifiers| Modifiers { shift: held.shift, alt: held.alt, ctrl: held.command, space };
    for event in events {
        let (pos, phase, keys) = match event {
            Event::PointerMoved(pos) if tools.busy() || canvas.at(pos) => (pos, Phase::Move, held),
            Event::PointerMoved(pos) => (pos, Phase::Leave, held),
            Event::PointerButton { pos, button, pressed: true, modifiers } if canvas.at(pos) => {
                response.request_focus();
                let Some(button) = held_button(button) else { continue };
                (pos, Phase::Press(button), modifiers)
            }
            Event::PointerButton { pos, button, pressed: false, modifiers } if tools.busy() => {
                let Some(button) = held_button(button) else { continue };
                (pos, Phase::Release(button), modifiers)
            }
            Event::PointerGone | Event::WindowFocused(false) => (response.rect.min, Phase::Leave, held),
            Event::MouseWheel { unit, delta, .. } => {
                canvas.wheel(unit, delta.y, tools, camera);
                continue;
            }
            Event::Zoom(factor) => {
                canvas.pinch(factor, camera);
                continue;
            }
            _ => continue,
        };
        let canvas = point(pos - response.rect.min);
        let event = PointerEvent { canvas, phase, modifiers: modifiers(keys) };
        commands.extend(tools.pointer(&event, &frame.world, camera));
    }
    commands
}

struct Canvas<'a> {
    ui: &'a Ui,
    rect: Rect,
    covered: &'a [Rect],
    /// A menu is open: what happens beside it closes it, and nothing else.
    blocked: bool,
}

impl Canvas<'_> {
    /// Whether a point of the screen belongs to the scene, and not to a panel, a banner or the edge that resizes a panel.
    fn at(&self, pos: Pos2) -> bool {
        let edge = self.ui.style().interaction.resize_grab_radius_side;
        let on_top = self.ui.ctx().layer_id_at(pos).is_none_or(|layer| layer == self.ui.layer_id());
        let covered = self.covered.iter().any(|rect| rect.contains(pos));
        !self.blocked && on_top && !covered && self.rect.shrink(edge).contains(pos)
    }

    fn pointer(&self) -> Option<Pos2> {
        self.ui.input(|input| input.pointer.latest_pos()).filter(|pos| self.at(*pos))
    }

    fn wheel(&self, unit: MouseWheelUnit, delta: f32, tools: &Tools, camera: &mut Camera) {
        let Some(pos) = self.pointer() else { return };
        let notches = match unit {
            MouseWheelUnit::Line => delta,
            MouseWheelUnit::Point => delta / POINTS_A_NOTCH,
            MouseWheelUnit::Page => delta * 5.0,
        };
        tools.wheel(camera, point(pos - self.rect.min), f64::from(notches));
    }

    fn pinch(&self, factor: f32, camera: &mut Camera) {
        if let Some(pos) = self.pointer() {
            camera.zoom_at(point(pos - self.rect.min), f64::from(factor));
        }
    }
}

fn held_button(button: PointerButton) -> Option<Button> {
    match button {
        PointerButton::Primary => Some(Button::Left),
        PointerButton::Secondary => Some(Button::Right),
        PointerButton::Middle => Some(Button::Middle),
        PointerButton::Extra1 | PointerButton::Extra2 => None,
    }
}

fn point(v: egui::Vec2) -> DVec2 {
    DVec2::new(f64::from(v.x), f64::from(v.y))
}

/// Keeps Tab (and Escape, while it has something to give up) from leaving the canvas, and shapes the cursor.
pub fn decorate(ui: &Ui, response: &Response, tools: &Tools) {
    if response.has_focus() {
        let escape = tools.busy() || tools.tool() != Tool::Drag || !tools.selection().is_empty();
        let filter = EventFilter { tab: true, horizontal_arrows: true, vertical_arrows: true, escape };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    }
    let cursor = match tools.tool() {
        Tool::Drag if tools.busy() => CursorIcon::Grabbing,
        Tool::Drag if tools.hovered().is_some() => CursorIcon::Grab,
        Tool::Drag | Tool::Select => CursorIcon::Default,
        Tool::Cut | Tool::Spawn(_) | Tool::Join(_) | Tool::Wall => CursorIcon::Crosshair,
    };
    if response.hovered() {
        ui.ctx().set_cursor_icon(cursor);
    }
}

/// The menu of a right click: on something not selected it selects that first.
pub fn context_menu(response: &Response, tools: &mut Tools, frame: &Frame, camera: &Camera, actions: &mut Vec<Action>) {
    if response.secondary_clicked()
        && let Some(pos) = response.interact_pointer_pos()
    {
        let hit = pick::pick(&frame.world, camera, point(pos - response.rect.min));
        if let Some(id) = hit.filter(|id| !tools.selection().contains(id)) {
            tools.select(vec![id]);
        }
    }
    response.context_menu(|ui| {
        ui.set_min_width(160.0);
        let selection = tools.selection();
        let mut entries = vec![];
        if !selection.is_empty() {
            let free = selection.iter().any(|id| is_free(frame, *id));
            entries.push((if free { "Pin" } else { "Unpin" }, Action::Pin));
            entries.push(("Duplicate", Action::Duplicate));
            entries.push(("Delete", Action::Delete));
            entries.push(("Fit selection", Action::FitSelection));
        }
        entries.push(("Select all", Action::SelectAll));
        entries.push(("Fit all", Action::FitAll));
        for (name, action) in entries {
            let key = action.entry().shortcuts.first().map(ToString::to_string).unwrap_or_default();
            let button = egui::Button::new(name).shortcut_text(egui::RichText::new(key).color(theme::colours(ui).weak));
            if ui.add(button).on_hover_text(action.tooltip()).clicked() {
                actions.push(action);
                ui.close();
            }
        }
    });
}
