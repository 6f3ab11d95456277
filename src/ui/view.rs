//! The section "View": what the picture shows besides the bodies, and the theme.

use super::state::State;
use super::theme::Theme;
use super::widgets;
use crate::app::Action;
use crate::app::keys::Shown;
use egui::Ui;

/// The switches.
pub fn show(ui: &mut Ui, state: &mut State) {
    widgets::section(ui, "View", true, |ui| {
        let mut plain = State::default();
        for what in
            [Shown::Tension, Shown::Speed, Shown::Velocities, Shown::Contacts, Shown::Trails, Shown::Grid, Shown::Plots]
        {
            let (action, reset) = (Action::Toggle(what), *plain.shown(what));
            widgets::switch(ui, action.entry().name, state.shown(what), Some(reset), &action.tooltip());
        }
        let themes = [
            (Theme::Dark, "Dark", "Light letters on dark grey."),
            (Theme::Light, "Light", "Dark letters on light grey."),
        ];
        widgets::choice(ui, "Theme", &mut state.theme, Some(Theme::Dark), &themes, &Action::ToggleTheme.tooltip());
    });
}
