//! The banner over the scene when something failed: what, why, what to try.

use super::theme;
use crate::app::{Action, Command, Frame};
use egui::{Align2, Area, Id, Label, Order, Rect, RichText, Stroke, Ui, vec2};

/// Widest banner [points].
const WIDTH: f32 = 520.0;

/// Shows the frame's fault, if it has one, at the top of the canvas.
pub fn show(ui: &Ui, frame: &Frame, canvas: Rect, actions: &mut Vec<Action>, commands: &mut Vec<Command>) {
    let Some(fault) = &frame.fault else { return };
    let colours = theme::colours(ui);
    let width = WIDTH.min(canvas.width() - 8.0 * theme::GRID);
    Area::new(Id::unique("fault"))
        .order(Order::Middle)
        .pivot(Align2::CENTER_TOP)
        .fixed_pos(canvas.center_top() + vec2(0.0, 3.0 * theme::GRID))
        .show(ui.ctx(), |ui| {
            let stroke = Stroke::new(1.0, colours.error);
            egui::Frame::popup(ui.style()).fill(colours.overlay).stroke(stroke).inner_margin(12).show(ui, |ui| {
                ui.set_width(width);
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
