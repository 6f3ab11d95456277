//! The help: every action of the table with its shortcuts, and what the mouse does.

use super::{theme, widgets};
use crate::app::keys::ENTRIES;
use egui::{Grid, Id, Label, Modal, RichText, ScrollArea, Ui};

const MOUSE: [(&str, &str, &str); 6] = [
    ("Use the tool", "Left drag", "Takes hold of a body, draws a box, a slash, a wall; a click selects or adds."),
    ("Move the view", "Right or middle drag", "Also with the left button while Space is held."),
    ("Zoom", "Wheel, pinch", "The point under the pointer stays where it is."),
    ("Menu", "Right click", "What can be done with what is there."),
    ("Snap", "Shift", "To centres, ends and the grid, or in steps of 15°; adds to the selection. Alt turns it off."),
    ("Reset a value", "Double click", "Back to the value with which the scene was opened."),
];

/// Shows the help over everything. Returns whether it was closed.
pub fn show(ctx: &egui::Context) -> bool {
    let room = ctx.content_rect().size() * 0.85;
    let size = room.min(egui::vec2(720.0, 900.0));
    let frame = egui::Frame::popup(&ctx.style_of(ctx.theme())).inner_margin(16);
    let area = Modal::default_area(Id::unique("help")).default_size(size);
    let modal = Modal::new(Id::unique("help")).area(area).frame(frame).show(ctx, |ui| {
        ui.set_width(size.x);
        let mut close = false;
        ui.horizontal(|ui| {
            ui.heading("Help");
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                close = ui.button("Close").on_hover_text("Closes the help. [Esc]").clicked();
            });
        });
        ui.add_space(2.0 * theme::GRID);
        let height = size.y - 4.0 * theme::ROW;
        widgets::scroll(ui, ScrollArea::vertical().max_height(height).auto_shrink([false, true]), |ui| {
            let mouse = MOUSE.iter().map(|(name, hand, help)| (*name, (*hand).to_owned(), *help));
            let keys = ENTRIES.iter().map(|entry| {
                let keys: Vec<String> = entry.shortcuts.iter().map(ToString::to_string).collect();
                (entry.name, keys.join("  "), entry.help)
            });
            table(ui, mouse.chain(keys));
        });
        close
    });
    modal.inner || modal.should_close()
}

fn table(ui: &mut Ui, rows: impl Iterator<Item = (&'static str, String, &'static str)>) {
    let colours = theme::colours(ui);
    Grid::new("actions").num_columns(3).spacing([6.0 * theme::GRID, theme::GRID]).show(ui, |ui| {
        for (name, keys, help) in rows {
            ui.label(name);
            ui.label(RichText::new(keys).color(colours.accent));
            ui.add(Label::new(RichText::new(help).color(colours.weak)).wrap());
            ui.end_row();
        }
    });
}
