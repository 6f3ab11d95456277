//! What is known of a scene before the lab has measured it: published points, or the scene's size, truth and plan in words.

use super::{companions, format, theme, widgets};
use crate::app::laboratory::Stage;
use crate::app::{Frame, LabReport};
use crate::lab::{Point, published, published_on, scene_length};
use egui::{Label, RichText, ScrollArea, Ui};

/// What is known of the open scene before it is measured here.
#[derive(Clone, Debug, Default)]
pub struct Known {
    /// Opening for which the lab was last started by itself.
    pub(super) started: Option<u64>,
    /// The scene and its published points.
    scene: Option<String>,
    pub(super) points: Vec<Point>,
}

impl Known {
    /// Looks the scene up, if it is another one than before.
    pub(super) fn follow(&mut self, scene: &str) {
        if self.scene.as_deref() != Some(scene) {
            self.scene = Some(scene.to_owned());
            self.points = published(scene);
        }
    }
}

/// Where the points come from that are shown before there are own ones.
pub(super) fn published_note(count: usize) -> String {
    format!(
        "Shown are {count} points measured before, on an {}, of the scene as it opens. Those of this machine take their place as \
         they come.",
        published_on()
    )
}

/// What stands in the diagram's place: what is known of the scene, and what comes.
pub(super) fn show(ui: &mut Ui, frame: &Frame, report: &LabReport) {
    let (world, colours) = (&frame.world, theme::colours(ui));
    let truth = frame.companions.truth.as_ref().map(|truth| truth.report());
    let length = truth.as_ref().map_or_else(|| scene_length(world), |truth| truth.length);
    let title = if frame.scene.title.is_empty() { &frame.scene.name } else { &frame.scene.title };
    let counts = format!(
        "{} bodies, {} rods, ropes, springs and pins, {} walls; length {}.",
        format::count(world.bodies().len()),
        format::count(world.constraints().len()),
        format::count(world.walls().len()),
        format::si(length, "m")
    );
    let reference = match truth {
        Some(_) => companions::truth_note(frame),
        None => {
            "No exact motion is stored: the most accurate method is refined first, until two runs agree, and errors are \
             distances from it."
                .into()
        }
    };
    let next = match &report.stage {
        Stage::Refining { .. } => "The reference is computed now, the points come after it.",
        Stage::Failed(_) => "It could not be measured.",
        _ => {
            "Every method comes over its own knobs, the most telling settings first. The simulation goes on meanwhile."
        }
    };
    let area = ScrollArea::vertical().id_salt("lab known").auto_shrink(false);
    let lines = |ui: &mut Ui| {
        ui.add(Label::new(RichText::new(title).heading().color(colours.strong)).wrap());
        for text in [counts.as_str(), &reference, &*frame.plan, next].into_iter().filter(|text| !text.is_empty()) {
            ui.add(Label::new(RichText::new(text).color(colours.weak)).wrap());
            ui.add_space(theme::GRID);
        }
    };
    widgets::scroll(ui, area, |ui| drop(ui.vertical(lines)));
}
