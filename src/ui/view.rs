//! The section "View": what the picture shows besides the bodies, and the theme.

use super::state::State;
use super::theme::Theme;
use super::{companions, widgets};
use crate::app::keys::Shown;
use crate::app::{Action, Frame};
use egui::Ui;

const SWITCHES: [Shown; 8] = [
    Shown::Tension,
    Shown::Speed,
    Shown::Velocities,
    Shown::Contacts,
    Shown::Trails,
    Shown::Grid,
    Shown::Ghost,
    Shown::Plots,
];

/// The switches.
pub fn show(ui: &mut Ui, frame: &Frame, state: &mut State) {
    widgets::section(ui, "View", true, |ui| {
        let mut plain = State::default();
        for what in SWITCHES {
            let (action, reset) = (Action::Toggle(what), *plain.shown(what));
            widgets::switch(ui, action.entry().name, state.shown(what), Some(reset), &action.tooltip());
            if what == Shown::Ghost && state.view.ghost {
                widgets::note(ui, &companions::truth_note(frame));
            }
        }
        let themes = [
            (Theme::Dark, "Dark", "Light letters on dark grey."),
            (Theme::Light, "Light", "Dark letters on light grey."),
        ];
        widgets::choice(ui, "Theme", &mut state.theme, Some(Theme::Dark), &themes, &Action::ToggleTheme.tooltip());
    });
}
