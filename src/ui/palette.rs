//! The panel on the left: the tools of the canvas and the things to spawn, each with its key.

use super::icon::{self, Icon};
use super::{theme, widgets};
use crate::app::tools::{Join, Tool};
use crate::app::{Action, Spawn};
use egui::{Align2, FontId, Rect, Role, Sense, Ui, Vec2, WidgetInfo, vec2};

const TOOLS: [(Tool, Icon); 7] = [
    (Tool::Drag, Icon::Hand),
    (Tool::Select, Icon::Pointer),
    (Tool::Cut, Icon::Cut),
    (Tool::Join(Join::Rod), Icon::Rod),
    (Tool::Join(Join::Spring), Icon::Spring),
    (Tool::Join(Join::Rope), Icon::Rope),
    (Tool::Wall, Icon::Wall),
];

const SPAWNS: [(Spawn, Icon); 7] = [
    (Spawn::Particle, Icon::Particle),
    (Spawn::Disc, Icon::Disc),
    (Spawn::Rod, Icon::Dumbbell),
    (Spawn::Spring, Icon::SpringPair),
    (Spawn::Rope, Icon::Chain),
    (Spawn::Cloth, Icon::Cloth),
    (Spawn::Pile, Icon::Pile),
];

/// Tools and things, two columns; the one in use is filled with the accent.
pub fn show(ui: &mut Ui, current: Tool, actions: &mut Vec<Action>) {
    widgets::section(ui, "Tools", true, |ui| grid(ui, &TOOLS, current, actions));
    let spawns = SPAWNS.map(|(spawn, icon)| (Tool::Spawn(spawn), icon));
    widgets::section(ui, "Add", true, |ui| grid(ui, &spawns, current, actions));
}

fn grid(ui: &mut Ui, tools: &[(Tool, Icon)], current: Tool, actions: &mut Vec<Action>) {
    let width = ((ui.available_width() - theme::GRID) / 2.0).floor();
    for pair in tools.chunks(2) {
        ui.add_space(theme::GRID);
        ui.horizontal(|ui| {
            for (tool, icon) in pair {
                if button(ui, *tool, *icon, width, *tool == current) {
                    actions.push(Action::Tool(*tool));
                }
            }
        });
    }
}

/// Icon, name and key in one row.
fn button(ui: &mut Ui, tool: Tool, icon: Icon, width: f32, selected: bool) -> bool {
    let action = Action::Tool(tool);
    let entry = action.entry();
    let name =
        if matches!(tool, Tool::Spawn(_)) { format!("Add {}", entry.name.to_lowercase()) } else { entry.name.into() };
    let (rect, response) = ui.allocate_exact_size(vec2(width, theme::ROW + theme::GRID), Sense::click());
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, selected, &name));
    let colours = theme::colours(ui);
    let (fill, ink, note) = if selected {
        (colours.accent, colours.on_accent, colours.on_accent)
    } else if response.hovered() || response.has_focus() {
        (colours.hover, colours.strong, colours.weak)
    } else {
        (colours.field, colours.text, colours.weak)
    };
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, theme::GRID, fill);
    let square = Rect::from_center_size(rect.left_center() + vec2(16.0, 0.0), Vec2::splat(16.0));
    icon::paint(&painter, square, icon, ink);
    let body = FontId::proportional(theme::BODY);
    painter.text(rect.left_center() + vec2(30.0, 0.0), Align2::LEFT_CENTER, short(entry.name), body, ink);
    if let Some(key) = entry.shortcuts.first() {
        let small = FontId::proportional(theme::SMALL);
        painter.text(rect.right_center() - vec2(6.0, 0.0), Align2::RIGHT_CENTER, key.to_string(), small, note);
    }
    response.on_hover_text(action.tooltip()).clicked()
}

/// "Join with a rod" is "Rod" where the heading says the rest.
fn short(name: &str) -> String {
    let word = name.strip_prefix("Join with a ").unwrap_or(name);
    let mut letters = word.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}
