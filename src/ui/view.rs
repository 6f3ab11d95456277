//! The section "View": what the picture shows besides the bodies, and the theme.

use super::state::State;
use super::theme::Theme;
use super::widgets;
use egui::Ui;

/// The switches.
pub fn show(ui: &mut Ui, state: &mut State) {
    widgets::section(ui, "View", true, |ui| {
        let view = &mut state.view;
        let plain = super::state::View::default();
        for (label, on, reset, help) in [
            ("Tension", &mut view.tension, plain.tension, "Colours rods, ropes and springs by their tension [N]."),
            ("Speed", &mut view.speed, plain.speed, "Colours moving bodies by their speed [m/s]."),
            ("Velocities", &mut view.velocities, plain.velocities, "An arrow for the velocity of every body [m/s]."),
            ("Contacts", &mut view.contacts, plain.contacts, "Where bodies touch, and the normal force [N]."),
            ("Trails", &mut view.trails, plain.trails, "Where bodies were, fading."),
            ("Grid", &mut view.grid, plain.grid, "Lines at round distances, with units [m]."),
            ("Plots", &mut state.plots, true, "Energy, error and step time at the bottom."),
        ] {
            widgets::switch(ui, label, on, Some(reset), help);
        }
        let themes = [
            (Theme::Dark, "Dark", "Light letters on dark grey."),
            (Theme::Light, "Light", "Dark letters on light grey."),
        ];
        widgets::choice(ui, "Theme", &mut state.theme, Some(Theme::Dark), &themes, "Dark or light.");
    });
}
