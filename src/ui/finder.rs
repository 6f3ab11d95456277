//! The palette of actions: type a few letters, get every action and scene that fits, with its shortcut; Enter does it.

use super::state::{Field, State};
use super::{theme, widgets};
use crate::app::{Action, keys};
use crate::scene::Shipped;
use egui::{Align2, FontId, Id, Key, Modal, Response, Role, ScrollArea, Sense, TextEdit, Ui, WidgetInfo, vec2};

/// Lines in sight; the others are reached by scrolling.
const LINES: f32 = 12.0;
/// Height that is left to the field above them and to the window around [points].
const MARGIN: f32 = 200.0;

/// What was chosen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Found {
    /// To be carried out as by its key.
    Action(Action),
    /// The name of a scene.
    Scene(String),
}

/// One line of the list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// What is found by, shown first.
    pub name: String,
    /// The first key of an action as shown to a user; empty if there is none, as for scenes.
    pub shortcut: String,
    /// What choosing it does; searched too.
    pub help: String,
    /// What choosing it gives.
    pub found: Found,
}

/// The actions and scenes whose name holds every word of `query`; names that begin with it first.
pub fn find(query: &str, scenes: &[Shipped]) -> Vec<Line> {
    let query = query.trim().to_lowercase();
    let fits = |line: &Line| {
        let text = format!("{} {}", line.name, line.help).to_lowercase();
        query.split_whitespace().all(|word| text.contains(word))
    };
    let mut lines: Vec<Line> = actions().chain(scenes.iter().map(scene_line)).filter(fits).collect();
    lines.sort_by_key(|line| {
        let name = line.name.to_lowercase();
        (!name.starts_with(&query), !name.contains(&query))
    });
    lines
}

fn actions() -> impl Iterator<Item = Line> {
    keys::ENTRIES.iter().map(|entry| Line {
        name: entry.name.to_owned(),
        shortcut: entry.shortcuts.first().map(ToString::to_string).unwrap_or_default(),
        help: entry.help.to_owned(),
        found: Found::Action(entry.action),
    })
}

fn scene_line(scene: &Shipped) -> Line {
    Line {
        name: format!("Open {}", scene.title),
        shortcut: String::new(),
        help: format!("Opens the scene \"{}\".", scene.name),
        found: Found::Scene(scene.name.to_owned()),
    }
}

/// Shows the palette over everything. Returns what was chosen; `state.finder` is gone when it is closed.
pub fn show(ctx: &egui::Context, scenes: &[Shipped], state: &mut State) -> Option<Found> {
    let mut finder = state.finder.take()?;
    state.takes_focus(Field::ActionQuery);
    let area = Modal::default_area(Id::unique("finder")).anchor(Align2::CENTER_TOP, vec2(0.0, 96.0));
    let frame = egui::Frame::popup(&ctx.style_of(ctx.theme())).inner_margin(8);
    let modal = Modal::new(Id::unique("finder")).area(area).frame(frame).show(ctx, |ui| {
        ui.set_width(480.0);
        // Before the field, which would take the arrows itself.
        let moved =
            ui.input(|input| i32::from(input.key_pressed(Key::ArrowDown)) - i32::from(input.key_pressed(Key::ArrowUp)));
        let edit =
            TextEdit::singleline(&mut finder.query).hint_text("Find an action or a scene").desired_width(f32::INFINITY);
        let response = ui.add(edit).accessible_name("Action or scene");
        let entered = response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        // While the list is open whatever is typed belongs to it, also after a click beside the field or an Enter in vain.
        if !response.has_focus() {
            response.request_focus();
        }
        let lines = find(&finder.query, scenes);
        let count = lines.len();
        let before = finder.chosen;
        if response.changed() {
            finder.chosen = 0;
        } else if count > 0 {
            finder.chosen = (finder.chosen as i32 + moved).clamp(0, count as i32 - 1) as usize;
        }
        let follow = response.changed() || finder.chosen != before;
        response.on_hover_text("Type some letters; arrows choose, Enter does it. [Ctrl-K]");
        ui.add_space(theme::GRID);
        let mut chosen = entered.then_some(finder.chosen);
        if lines.is_empty() {
            widgets::note(ui, "Nothing found. Esc closes this list.");
        }
        let room = ui.ctx().content_rect().height() - MARGIN;
        let height = (LINES * (theme::ROW + 2.0 * theme::GRID)).min(room);
        // What is scrolled in a window of its own is given little room otherwise.
        let area = ScrollArea::vertical().max_height(height).min_scrolled_height(height).auto_shrink([false, true]);
        widgets::scroll(ui, area, |ui| {
            for (index, line) in lines.iter().enumerate() {
                let response = row(ui, line, index == finder.chosen);
                if follow && index == finder.chosen {
                    response.scroll_to_me(None);
                }
                if response.clicked() {
                    chosen = Some(index);
                }
            }
        });
        chosen.and_then(|index| lines.get(index)).map(|line| line.found.clone())
    });
    if modal.inner.is_none() && !modal.should_close() {
        state.finder = Some(finder);
    } else {
        state.focus = Some(Field::Canvas);
    }
    modal.inner
}

fn row(ui: &mut Ui, line: &Line, chosen: bool) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), theme::ROW + theme::GRID), Sense::click());
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, &line.name));
    let colours = theme::colours(ui);
    let (fill, ink, note) = match (chosen, response.hovered()) {
        (true, _) => (colours.accent, colours.on_accent, colours.on_accent),
        (_, true) => (colours.hover, colours.strong, colours.weak),
        _ => (colours.panel, colours.text, colours.weak),
    };
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, theme::GRID, fill);
    let font = FontId::proportional(theme::BODY);
    let inset = vec2(2.0 * theme::GRID, 0.0);
    painter.text(rect.left_center() + inset, Align2::LEFT_CENTER, &line.name, font.clone(), ink);
    painter.text(rect.right_center() - inset, Align2::RIGHT_CENTER, &line.shortcut, font, note);
    response.on_hover_text(&line.help)
}
