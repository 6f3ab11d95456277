//! The banner over the scene when something failed: what, why, what to try; and a quieter one for what else a user should know.

use super::theme;
use crate::app::{Action, Command, Frame};
use egui::{Align2, Area, Color32, Id, Label, Order, Rect, RichText, Stroke, Ui, vec2};
use std::sync::Arc;

/// Widest banner [points].
const WIDTH: f32 = 520.0;

/// Shows the frame's fault, if it has one, at the top of the canvas.
pub fn show(ui: &Ui, frame: &Frame, canvas: Rect, actions: &mut Vec<Action>, commands: &mut Vec<Command>) {
    let Some(fault) = &frame.fault else { return };
    let colours = theme::colours(ui);
    banner(ui, "fault", canvas, colours.error, |ui| {
        // The first sentence says what failed; the rest why, and what to try.
        let (what, rest) = fault.split_once(". ").unwrap_or((fault, ""));
        ui.add(Label::new(RichText::new(sentence(what)).color(colours.strong).heading()).wrap());
        if !rest.is_empty() {
            ui.add(Label::new(rest).wrap());
        }
        ui.add_space(theme::GRID);
        ui.horizontal(|ui| {
            if ui.button("Dismiss").on_hover_text("Closes this note. The scene stays as it is.").clicked() {
                commands.push(Command::DismissFault);
            }
            // Starting anew mends a run that was lost, and nothing else.
            let lost = frame.report.divergence.is_some();
            if lost && ui.button("Restart scene").on_hover_text(Action::Restart.tooltip()).clicked() {
                commands.push(Command::DismissFault);
                actions.push(Action::Restart);
            }
        });
    });
}

/// How long a note stays if nobody dismisses it [s].
const NOTE_SECONDS: f64 = 12.0;

/// The note that is shown, and since when [s].
pub type Shown = Option<(Arc<str>, f64)>;

/// Shows the frame's note, if it has one, where a fault would be.
pub fn show_note(ui: &Ui, frame: &Frame, canvas: Rect, shown: &mut Shown, commands: &mut Vec<Command>) {
    let Some(note) = frame.note.as_ref().filter(|_| frame.fault.is_none()) else { return };
    let now = ui.input(|input| input.time);
    let since = match shown {
        Some((known, since)) if Arc::ptr_eq(known, note) => *since,
        _ => shown.insert((note.clone(), now)).1,
    };
    let left = since + NOTE_SECONDS - now;
    if left <= 0.0 {
        return commands.push(Command::DismissNote);
    }
    ui.ctx().request_repaint_after_secs(left as f32);
    banner(ui, "note", canvas, theme::colours(ui).line, |ui| {
        ui.add(Label::new(&**note).wrap());
        ui.horizontal(|ui| {
            if frame.undo.is_some() && ui.button("Undo").on_hover_text(Action::Undo.tooltip()).clicked() {
                commands.push(Command::Undo);
            }
            if ui.button("Dismiss").on_hover_text("Closes this note. The scene stays as it is.").clicked() {
                commands.push(Command::DismissNote);
            }
        });
    });
}

fn banner(ui: &Ui, name: &str, canvas: Rect, edge: Color32, content: impl FnOnce(&mut Ui)) {
    let colours = theme::colours(ui);
    let width = WIDTH.min(canvas.width() - 8.0 * theme::GRID);
    Area::new(Id::unique(name))
        .order(Order::Middle)
        .pivot(Align2::CENTER_TOP)
        .fixed_pos(canvas.center_top() + vec2(0.0, 3.0 * theme::GRID))
        .show(ui.ctx(), |ui| {
            let frame = egui::Frame::popup(ui.style()).fill(colours.overlay).stroke(Stroke::new(1.0, edge));
            frame.inner_margin(12).show(ui, |ui| {
                ui.set_width(width);
                content(ui);
            });
        });
}

/// `text` with a capital, unless it begins with something other than a word: a path, a name.
fn sentence(text: &str) -> String {
    let first = text.split(' ').next().unwrap_or_default();
    if !first.chars().all(char::is_alphabetic) {
        return text.to_owned();
    }
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::sentence;

    #[test]
    fn a_sentence_begins_with_a_capital_and_a_path_as_it_is() {
        assert_eq!(sentence("the run diverged: velocity"), "The run diverged: velocity");
        assert_eq!(sentence("élan"), "Élan");
        for path in ["mine.ron:3:5: found a comma", "./mine.ron: no such file", "brigde: found no such file", ""] {
            assert_eq!(sentence(path), path);
        }
    }
}
