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
                ui.add(Label::new(RichText::new(first_letter_up(what)).color(colours.strong).heading()).wrap());
                if !rest.is_empty() {
                    ui.add(Label::new(rest).wrap());
                }
                ui.add_space(theme::GRID);
                ui.horizontal(|ui| {
                    if ui.button("Dismiss").on_hover_text("Closes this note. The scene stays as it is.").clicked() {
                        commands.push(Command::DismissFault);
                    }
                    let restart = ui.button("Restart scene").on_hover_text(Action::Restart.tooltip());
                    if restart.clicked() {
                        commands.push(Command::DismissFault);
                        actions.push(Action::Restart);
                    }
                });
            });
        });
}

fn first_letter_up(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}
