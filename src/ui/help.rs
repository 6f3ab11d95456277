//! The help: every action of the table with its shortcuts, and what the mouse does.

use super::theme;
use crate::app::keys::ENTRIES;
use egui::{Grid, Id, Label, Modal, RichText, ScrollArea, Ui};

const MOUSE: [(&str, &str); 6] = [
    ("Left drag", "The tool in use: take hold of a body, draw a box, slash, join."),
    ("Right or middle drag, Space-drag", "Moves the view."),
    ("Wheel, pinch", "Zooms to the pointer."),
    ("Right click", "Menu of what is there."),
    ("Shift", "Snaps to centres, ends, the grid, or 15°; adds to the selection. Alt turns snapping off."),
    ("Double click on a value", "Back to the scene's own value."),
];

/// Shows the help over everything. Returns whether it was closed.
pub fn show(ctx: &egui::Context) -> bool {
    let modal = Modal::new(Id::unique("help")).show(ctx, |ui| {
        ui.set_width(560.0);
        let mut close = false;
        ui.horizontal(|ui| {
            ui.heading("Help");
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                close = ui.button("Close").on_hover_text("Closes the help. [Esc]").clicked();
            });
        });
        ui.add_space(2.0 * theme::GRID);
        let height = ui.ctx().content_rect().height() * 0.75;
        ScrollArea::vertical().max_height(height).auto_shrink([false, true]).show(ui, |ui| {
            table(ui, "mouse", MOUSE.iter().map(|(what, help)| ((*what).to_owned(), String::new(), *help)));
            ui.add_space(3.0 * theme::GRID);
            let keys = ENTRIES.iter().map(|entry| {
                let keys: Vec<String> = entry.shortcuts.iter().map(ToString::to_string).collect();
                (entry.name.to_owned(), keys.join("  "), entry.help)
            });
            table(ui, "keys", keys);
        });
        close
    });
    modal.inner || modal.should_close()
}

fn table(ui: &mut Ui, id: &str, rows: impl Iterator<Item = (String, String, &'static str)>) {
    let weak = theme::colours(ui).weak;
    Grid::new(id).num_columns(3).spacing([4.0 * theme::GRID, theme::GRID]).striped(false).show(ui, |ui| {
        for (name, keys, help) in rows {
            ui.label(name);
            ui.label(RichText::new(keys).color(theme::colours(ui).accent));
            ui.add(Label::new(RichText::new(help).color(weak)).wrap());
            ui.end_row();
        }
    });
}
