//! The list of scenes: type to find one, open a file by its path, save under a path.

use super::state::{Field, State};
use super::{badge, theme, widgets};
use crate::app::{Command, Frame};
use crate::scene::Shipped;
use crate::text::named;
use crate::trial::Verdict;
use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{Align, Key, Label, RichText, ScrollArea, TextEdit, Ui};
use std::path::{Path, PathBuf};

/// The sections "Scenes" and "Save as…".
pub fn show(ui: &mut Ui, frame: &Frame, scenes: &[Shipped], state: &mut State, commands: &mut Vec<Command>) {
    let wanted = |state: &State, field| (state.focus == Some(field)).then_some(true);
    let open = wanted(state, Field::SceneFilter);
    widgets::section_opened(ui, "Scenes", open, |ui| list(ui, frame, scenes, state, commands));
    let open = wanted(state, Field::SavePath);
    widgets::section_opened(ui, "Save", open, |ui| save(ui, frame, state, commands));
}

/// The scenes whose name or title holds every word of `filter`, in their order.
pub fn found<'a>(scenes: &'a [Shipped], filter: &str) -> Vec<&'a Shipped> {
    let words: Vec<String> = filter.split_whitespace().map(str::to_lowercase).collect();
    let holds = |scene: &&Shipped| {
        let text = format!("{} {}", scene.name, scene.title).to_lowercase();
        words.iter().all(|word| text.contains(word.as_str()))
    };
    scenes.iter().filter(holds).collect()
}

/// What Enter opens: the first scene found, or else the text itself, as the path of a file or as a name that the error will
/// correct. Nothing for an empty text.
pub fn target(scenes: &[Shipped], filter: &str) -> Option<String> {
    let text = filter.trim();
    let is_path = text.contains('/') || text.contains('\\') || text.ends_with(".ron");
    if is_path {
        return Some(text.to_owned());
    }
    if text.is_empty() {
        return None;
    }
    let exact = scenes.iter().find(|scene| scene.name == text);
    let scene = exact.or(found(scenes, text).first().copied());
    Some(scene.map_or(text, |scene| scene.name).to_owned())
}

/// Gives a text field the keyboard, in sight, and selects what it holds, so that typing replaces it.
fn take_up(ui: &Ui, field: &egui::Response, text: &str) {
    field.request_focus();
    field.scroll_to_me(None);
    let mut edit = TextEditState::load(ui.ctx(), field.id).unwrap_or_default();
    edit.cursor.set_char_range(Some(CCursorRange::two(CCursor::new(0), CCursor::new(text.chars().count()))));
    edit.store(ui.ctx(), field.id);
}

fn list(ui: &mut Ui, frame: &Frame, scenes: &[Shipped], state: &mut State, commands: &mut Vec<Command>) {
    let hint = "Name, or path of a file";
    let edit = TextEdit::singleline(&mut state.scene_filter).hint_text(hint).desired_width(f32::INFINITY);
    let response = ui.add(edit).accessible_name("Find a scene");
    if state.takes_focus(Field::SceneFilter) {
        take_up(ui, &response, &state.scene_filter);
    }
    let entered = response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    response.on_hover_text("Type part of a name, or the path of a scene file; Enter opens, Esc clears. [Ctrl-O]");
    if entered && let Some(name) = target(scenes, &state.scene_filter) {
        commands.push(Command::Open(name));
        state.scene_filter.clear();
        state.focus = Some(Field::Canvas);
    }
    let found = found(scenes, &state.scene_filter);
    if found.is_empty() && !scenes.is_empty() {
        widgets::note(ui, "No scene of that name. Enter opens a path such as ./bridge.ron, Esc shows all scenes.");
    }
    let height = (ui.available_height() - 88.0).max(8.0 * theme::ROW);
    let area = ScrollArea::vertical().id_salt("scenes").max_height(height).auto_shrink([false, true]);
    widgets::scroll(ui, area, |ui| {
        ui.spacing_mut().item_spacing.y = 0.0;
        let mut section = scenes.first().map_or("", Shipped::section);
        for scene in found {
            if scene.section() != section {
                section = scene.section();
                ui.add_space(theme::GRID);
                widgets::note(ui, section);
            }
            let here = scene.name == frame.scene.name;
            let response = entry(ui, scene, here, state.verdicts.get(scene.name).map(|verdict| &**verdict));
            if here && state.listed != Some(frame.scene.opened) {
                state.listed = Some(frame.scene.opened);
                response.scroll_to_me(Some(Align::Center));
            }
            if response.clicked() {
                commands.push(Command::Open(scene.name.to_owned()));
                state.focus = Some(Field::Canvas);
            }
            if here && let Some(verdict) = &frame.trial {
                badge::details(ui, verdict);
            }
        }
    });
}

fn entry(ui: &mut Ui, scene: &Shipped, here: bool, verdict: Option<&Verdict>) -> egui::Response {
    let button = egui::Button::selectable(here, scene.title).truncate();
    let opens = format!("Opens \"{}\". [ and ] go through the list.", scene.name);
    let Some(pass) = scene.pass() else {
        let response = ui.add_sized([ui.available_width(), theme::ROW], LeftAligned(button));
        return response.on_hover_text(opens);
    };
    let words = verdict.map_or_else(|| badge::wanted(pass), badge::summary);
    let width = ui.available_width() - badge::WIDTH - theme::GRID;
    let response = ui.add_sized([width, theme::ROW], LeftAligned(button));
    let mark = response.rect.right_center() + egui::vec2(theme::GRID + badge::WIDTH / 2.0, 0.0);
    badge::paint(ui, mark, verdict.map(|verdict| verdict.state));
    response.on_hover_text(format!("{opens}\n{words}"))
}

/// `add_sized` centres; a list reads better from the left.
struct LeftAligned<'a>(egui::Button<'a>);

impl egui::Widget for LeftAligned<'_> {
    fn ui(self, ui: &mut Ui) -> egui::Response {
        let size = egui::vec2(ui.available_width(), theme::ROW);
        let layout = egui::Layout::top_down_justified(egui::Align::LEFT);
        ui.allocate_ui_with_layout(size, layout, |ui| ui.add(self.0.min_size(size))).inner
    }
}

fn save(ui: &mut Ui, frame: &Frame, state: &mut State, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        let width = ui.available_width() - 76.0;
        let edit = TextEdit::singleline(&mut state.save_path).hint_text("Path of a file").desired_width(width);
        let response = ui.add(edit).accessible_name("Path to save to");
        if state.takes_focus(Field::SavePath) {
            take_up(ui, &response, &state.save_path);
        }
        let entered = response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        response.on_hover_text("File to write the scene to, as it stands; `tautline check` reads it too. [Ctrl-S]");
        let button = ui.button("Save as…").on_hover_text("Writes the scene as it stands to this file. [Ctrl-S]");
        if (entered || button.clicked()) && !state.save_path.trim().is_empty() {
            save_to(state.save_path.trim().into(), frame, state, commands);
        }
    });
    replace(ui, state, commands);
    if let Some(path) = &frame.saved {
        ui.add(Label::new(RichText::new(format!("Saved to {path}")).weak()).truncate());
    }
}

/// Saves, or asks first where another file would be lost.
fn save_to(path: PathBuf, frame: &Frame, state: &mut State, commands: &mut Vec<Command>) {
    if frame.would_replace(&path) {
        state.replace = Some(path);
        return;
    }
    commands.push(Command::SaveAs(path));
    (state.replace, state.focus) = (None, Some(Field::Canvas));
}

/// Asks whether a file may be replaced, as long as its name stands in the field.
fn replace(ui: &mut Ui, state: &mut State, commands: &mut Vec<Command>) {
    let typed = Path::new(state.save_path.trim());
    state.replace = state.replace.take().filter(|path| path == typed);
    let Some(path) = state.replace.clone() else { return };
    let question = format!("{} is there already and is not this scene's file.", named(&path));
    ui.add(Label::new(RichText::new(question).color(theme::colours(ui).warning)).wrap());
    let answers = ui.horizontal(|ui| {
        if ui.button("Replace it").on_hover_text("The file is lost; this scene takes its place.").clicked() {
            commands.push(Command::SaveAs(path));
            (state.replace, state.focus) = (None, Some(Field::Canvas));
        }
        if ui.button("Keep it").on_hover_text("Nothing is written. Type another name to save.").clicked() {
            (state.replace, state.focus) = (None, Some(Field::SavePath));
        }
    });
    // The section is the last one of its panel.
    answers.response.scroll_to_me(Some(Align::BOTTOM));
}
