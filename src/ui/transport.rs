//! The bar at the top: run and pause, speed, undo and redo, the scene's title, help and theme.

use super::actions::SPEEDS;
use super::icon::Icon;
use super::shell::Unfolded;
use super::theme::{self, Theme};
use super::widgets::icon_button;
use super::{draft, format};
use crate::app::{Action, Command, Frame};
use egui::{Align, DragValue, Label, Layout, RichText, Sense, Ui};

/// From this width the bar has room for the speed in words, and from the other one for the buttons that have a key anyway
/// [points].
const ROOM_FOR_SPEED: f32 = 740.0;
const ROOM_FOR_ALL: f32 = 620.0;

/// Shows the bar; what was pressed goes to `actions`.
pub fn show(
    ui: &mut Ui,
    frame: &Frame,
    theme: &mut Theme,
    unfolded: Unfolded,
    actions: &mut Vec<Action>,
    commands: &mut Vec<Command>,
) {
    let small = ui.available_width() < ROOM_FOR_ALL;
    ui.horizontal_centered(|ui| {
        let (icon, name) = if frame.running { (Icon::Pause, "Pause") } else { (Icon::Run, "Run") };
        act(ui, icon, name, Action::ToggleRun, frame.running, true, actions);
        act(ui, Icon::Step, "Step", Action::StepOnce, false, true, actions);
        act(ui, Icon::Restart, "Restart", Action::Restart, false, true, actions);
        gap(ui);
        speed(ui, frame, actions, commands);
        gap(ui);
        history(ui, frame, actions);
        gap(ui);
        title(ui, frame, if small { 5.0 } else { 7.0 });
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            act(ui, Icon::Help, "Help", Action::Help, false, true, actions);
            act(ui, Icon::Search, "Find an action", Action::Palette, false, true, actions);
            let (icon, name) = match theme {
                Theme::Dark => (Icon::Light, "Light theme"),
                Theme::Light => (Icon::Dark, "Dark theme"),
            };
            if !small && icon_button(ui, icon, name, &Action::ToggleTheme.tooltip(), false, true).clicked() {
                *theme = theme.other();
            }
            act(ui, Icon::Panels, "Hide panels", Action::TogglePanels, false, true, actions);
            let name = if unfolded.settings { "Fold settings" } else { "Unfold settings" };
            act(ui, Icon::Right, name, Action::SettingsPanel, false, true, actions);
            let name = if unfolded.tools { "Fold tools" } else { "Unfold tools" };
            act(ui, Icon::Left, name, Action::ToolsPanel, false, true, actions);
            if !small {
                act(ui, Icon::Fit, "Fit all", Action::FitAll, false, true, actions);
            }
        });
    });
}

fn act(ui: &mut Ui, icon: Icon, name: &str, action: Action, selected: bool, enabled: bool, actions: &mut Vec<Action>) {
    if icon_button(ui, icon, name, &action.tooltip(), selected, enabled).clicked() {
        actions.push(action);
    }
}

fn gap(ui: &mut Ui) {
    ui.add_space(theme::GRID);
    let rect = ui.available_rect_before_wrap();
    let middle = ui.max_rect().center().y;
    let stroke = egui::Stroke::new(1.0, theme::colours(ui).line);
    ui.painter().vline(rect.left(), (middle - 10.0)..=(middle + 10.0), stroke);
    ui.add_space(2.0 * theme::GRID);
}

fn speed(ui: &mut Ui, frame: &Frame, actions: &mut Vec<Action>, commands: &mut Vec<Command>) {
    act(ui, Icon::Slower, "Slower", Action::Slower, false, true, actions);
    let id = ui.scope_id().with("speed");
    let before = draft::read(ui, id, frame.speed.wanted);
    let mut wanted = before;
    let drag = DragValue::new(&mut wanted)
        .range(SPEEDS[0]..=SPEEDS[1])
        .speed(before * 0.02)
        .max_decimals(4)
        .custom_formatter(|value, _| format::plain(value, 4))
        .suffix(" ×")
        .update_while_editing(false);
    let response = ui.add_sized([56.0, theme::ROW], drag).accessible_name("Speed");
    if response.double_clicked() {
        wanted = 1.0;
        ui.memory_mut(|memory| memory.stop_text_input());
    }
    response.on_hover_text(
        "Wanted speed, in simulated seconds a second: 1 × is real time. 0.01 to 10. Double-click: back to 1. [−] [=]",
    );
    if wanted != before {
        draft::write(ui, id, wanted);
        commands.push(Command::Speed(wanted));
    }
    act(ui, Icon::Faster, "Faster", Action::Faster, false, true, actions);
    // The status bar says the same.
    if ui.max_rect().width() < ROOM_FOR_SPEED {
        return;
    }
    let (text, colour) = achieved(ui, frame);
    let label = Label::new(RichText::new(text).color(colour)).sense(Sense::hover());
    ui.add_sized([104.0, theme::ROW], label)
        .on_hover_text("Speed achieved over the last half second. Below the wanted speed the steps take too long.");
}

fn achieved(ui: &Ui, frame: &Frame) -> (String, egui::Color32) {
    let colours = theme::colours(ui);
    if !frame.running {
        return ("paused".into(), colours.weak);
    }
    let short = frame.speed.falls_short();
    (real_time(frame.speed.achieved), if short { colours.warning } else { colours.weak })
}

/// A speed in words: "62 % of real time".
pub fn real_time(achieved: f64) -> String {
    format!(
        "{} % of real time",
        format::digits((achieved * 100.0).round()).trim_end_matches(".0").trim_end_matches(".00")
    )
}

fn history(ui: &mut Ui, frame: &Frame, actions: &mut Vec<Action>) {
    for (icon, action, name, edit) in
        [(Icon::Undo, Action::Undo, "Undo", &frame.undo), (Icon::Redo, Action::Redo, "Redo", &frame.redo)]
    {
        let tooltip = match edit {
            Some(edit) => format!("{name}: {edit}. {}", action.tooltip()),
            None => format!("Nothing to {}. {}", name.to_lowercase(), action.tooltip()),
        };
        if icon_button(ui, icon, name, &tooltip, false, edit.is_some()).clicked() {
            actions.push(action);
        }
    }
}

fn title(ui: &mut Ui, frame: &Frame, buttons: f32) {
    let colours = theme::colours(ui);
    let scene = &frame.scene;
    let name = if scene.title.is_empty() { &scene.name } else { &scene.title };
    // The buttons at the right keep their room.
    let room = (ui.available_width() - buttons * (theme::ICON_BUTTON + theme::GRID) - 4.0 * theme::GRID).max(0.0);
    // Less would only show the beginning of a word.
    const LEAST: f32 = 64.0;
    if room < LEAST {
        return;
    }
    ui.allocate_ui_with_layout(egui::vec2(room, theme::ROW), Layout::left_to_right(Align::Center), |ui| {
        let heading = Label::new(RichText::new(name).heading().color(colours.strong)).truncate();
        ui.add(heading).on_hover_text(&scene.about);
        if ui.available_width() < LEAST {
            return;
        }
        let first = scene.about.split(". ").next().unwrap_or_default();
        let about = Label::new(RichText::new(first).color(colours.weak)).truncate().show_tooltip_when_elided(false);
        ui.add(about).on_hover_text(&scene.about);
    });
}
