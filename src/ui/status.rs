//! The bar at the bottom: counts, step time against its budget, real-time factor, tick and time, worst violation.

use super::format::{count, si};
use super::{companions, plots, theme, transport};
use crate::app::Frame;
use crate::engine::Id;
use egui::{Align, Color32, Label, Layout, Ui};

/// Shows the bar.
pub fn show(ui: &mut Ui, frame: &Frame, selection: &[Id]) {
    let colours = theme::colours(ui);
    let world = &frame.world;
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        ui.spacing_mut().item_spacing.x = 5.0 * theme::GRID;
        // What has no room is left out, the least important first: those that come last.
        let time = format!("{:.2} s", world.time());
        item(ui, "Time", time, colours.text, "Simulated time.");
        item(ui, "Step", count(world.tick() as usize), colours.text, "Steps taken.");
        let (text, colour) = pace(frame, &colours);
        item(ui, "", text, colour, "Simulated time against real time, over the last half second.");
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            // What was asked for comes first.
            for (label, companion) in [("Off truth", &frame.companions.truth), ("A | B", &frame.companions.rival)] {
                if let Some(companion) = companion {
                    let (text, colour, help) = companions::status(frame, companion, &colours);
                    item(ui, label, text, colour, &help);
                }
            }
            if let Some(fold) = frame.companions.truth.as_ref().and_then(|truth| truth.report().growth.clone()) {
                let help =
                    "By how much this motion itself has let errors grow: no accuracy of the steps can help that.";
                item(ui, "Errors grow", fold, colours.warning, help);
            }
            kept(ui, frame);
            selected(ui, frame, selection);
            item(ui, "Bodies", count(world.bodies().len()), colours.text, "Bodies in the world.");
            item(ui, "Constraints", count(world.constraints().len()), colours.text, "Rods, springs, ropes and pins.");
            item(ui, "Contacts", count(frame.measures.contacts), colours.text, "Contacts that touch or carry a force.");
            step_time(ui, frame);
            let violation = si(frame.measures.violation_max, "m");
            item(ui, "Violation", violation, colours.text, "Worst violation of a rod, a taut rope or a pin [m].");
        });
    });
}

/// Whether the accuracy that was asked for is kept, and if not, in how many of the steps that the plots reach back to.
fn kept(ui: &mut Ui, frame: &Frame) {
    if !frame.method.automatic {
        return;
    }
    let colours = theme::colours(ui);
    let (steps, lapsed) = {
        let samples = frame.plots.read();
        (samples.len(), samples.iter().filter(|sample| sample.fell_short).count())
    };
    let (text, colour) = match lapsed {
        0 => ("kept".to_owned(), colours.text),
        lapsed => (format!("not kept in {} of {} steps", count(lapsed), count(steps)), colours.warning),
    };
    let help = "Whether the accuracy that was asked for was kept in the last 20 s. Steps in which it was not are marked in the plot \
                of the local error.";
    item(ui, "Accuracy", text, colour, help);
}

/// Where the selected body is, with the error of that, if the truth is known.
fn selected(ui: &mut Ui, frame: &Frame, selection: &[Id]) {
    let &[id] = selection else { return };
    let body = frame.world.bodies().index_of(id);
    if let Some(text) = body.and_then(|body| companions::position(frame, body)) {
        let help = "Position of the selected body, and its distance from the truth with what that may be off by [m].";
        item(ui, &format!("Body {id}"), text, theme::colours(ui).text, help);
    }
}

fn step_time(ui: &mut Ui, frame: &Frame) {
    let colours = theme::colours(ui);
    let over = frame.report.step_us > plots::budget(frame);
    item(ui, "Step time", cost(frame), if over { colours.warning } else { colours.text }, COST_HELP);
}

/// What the last step took, of what it may take: "310 µs of 16.7 ms".
pub fn cost(frame: &Frame) -> String {
    format!("{} of {}", si(frame.report.step_us * 1e-6, "s"), si(plots::budget(frame) * 1e-6, "s"))
}

/// What [`cost`] is, for a tooltip.
pub const COST_HELP: &str = "Time that the last step took, of the time it may take to keep up with the wanted speed.";

fn pace(frame: &Frame, colours: &theme::Colours) -> (String, Color32) {
    if !frame.running {
        return ("Paused".into(), colours.weak);
    }
    let short = frame.speed.falls_short();
    (transport::real_time(frame.speed.achieved), if short { colours.warning } else { colours.text })
}

/// A label and a value, if there is room for both.
fn item(ui: &mut Ui, label: &str, value: String, colour: Color32, tooltip: &str) {
    let weak = theme::colours(ui).weak;
    let mut job = egui::text::LayoutJob::default();
    let font = egui::FontId::proportional(theme::BODY);
    // In one piece for a screen reader: with a space between the two.
    let (label, space) = if label.is_empty() { (String::new(), 0.0) } else { (format!("{label} "), 0.5 * theme::GRID) };
    job.append(&label, 0.0, egui::TextFormat::simple(font.clone(), weak));
    job.append(&value, space, egui::TextFormat::simple(font, colour));
    let galley = ui.painter().layout_job(job);
    if galley.size().x <= ui.available_width() {
        ui.add(Label::new(galley)).on_hover_text(tooltip);
    }
}
