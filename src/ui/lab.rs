//! The lab's panel: error over cost of every method on the open scene, drawn while it is measured; what to use for a wanted
//! error or a wanted budget; a click on a point loads its settings.

use super::state::State;
use super::{format, known, theme, widgets};
use crate::app::laboratory::Stage;
use crate::app::{Command, Frame, LabOrder, LabReport};
use crate::lab::report::mark::{Shape, look};
use crate::lab::{Family, Front, Point, Setting};
use egui::{
    Color32, DragValue, Id, Painter, Pos2, RichText, Role, ScrollArea, Sense, Stroke, TextEdit, Ui, WidgetInfo,
};
use egui_plot::{GridMark, Line, MarkerShape, Plot, PlotBounds, PlotPoint, PlotPoints, PlotResponse, PlotUi, Points};
use std::ops::RangeInclusive;

/// Width of the column beside the diagram [points].
const COLUMN: f32 = 300.0;
/// Height of the marks' names above the diagram at most [points].
const LEGEND: f32 = 48.0;
/// How near the pointer has to be to a point [points].
const REACH: f32 = 12.0;
/// An error of zero is drawn as this: below anything that a double resolves of a length.
const SMALLEST: f64 = 1e-18;

/// What a user asks the lab's advice for.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// Error in parts of the scene's length.
    pub error: f64,
    /// Cost [µs of CPU time per simulated second].
    pub budget: f64,
    /// Path to export to, without its ending.
    pub path: String,
}

impl Default for Wanted {
    fn default() -> Self {
        Wanted { error: 1e-6, budget: 1000.0, path: "lab".into() }
    }
}

/// Shows the panel. It starts by itself on a scene that is not measured yet.
pub fn show(ui: &mut Ui, frame: &Frame, state: &mut State, commands: &mut Vec<Command>) {
    let report = frame.lab.report();
    state.lab_known.follow(&frame.scene.name);
    let unmeasured = report.scene != frame.scene.name || report.stage == Stage::Idle && report.points.is_empty();
    if unmeasured && state.lab_known.started != Some(frame.scene.opened) {
        state.lab_known.started = Some(frame.scene.opened);
        commands.push(Command::Lab(LabOrder::Start));
    }
    let own = report.scene == frame.scene.name && !report.points.is_empty();
    let known = &state.lab_known.points;
    // Advice is taken from what is shown.
    let shown = if own { report.points.as_slice() } else { known };
    let front = Front::of(shown);
    ui.horizontal_top(|ui| {
        let size = egui::vec2(COLUMN.min(0.45 * ui.available_width()), ui.available_height());
        ui.allocate_ui_with_layout(size, egui::Layout::top_down(egui::Align::Min), |ui| {
            ui.set_width(size.x);
            let area = ScrollArea::vertical().id_salt("lab column").auto_shrink(false);
            widgets::scroll(ui, area, |ui| {
                controls(ui, frame, &report, commands);
                if !own && !known.is_empty() {
                    note(ui, &known::published_note(known.len()));
                }
                advice(ui, frame, shown, &front, &mut state.lab, commands);
                export(ui, &report, &mut state.lab, commands);
            });
        });
        ui.add_space(2.0 * theme::GRID);
        if shown.is_empty() {
            known::show(ui, frame, &report);
        } else {
            let faint = if own && report.stage != Stage::Finished { known.as_slice() } else { &[] };
            diagram(ui, frame, shown, faint, &front, commands);
        }
    });
}

fn controls(ui: &mut Ui, frame: &Frame, report: &LabReport, commands: &mut Vec<Command>) {
    let busy = matches!(report.stage, Stage::Measuring | Stage::Refining { .. });
    ui.horizontal(|ui| {
        let mut button = |ui: &mut Ui, name: &str, enabled: bool, order: LabOrder, help: &str| {
            let response = ui.add_enabled(enabled, egui::Button::new(name)).on_hover_text(help);
            if response.on_disabled_hover_text(help).clicked() {
                commands.push(Command::Lab(order));
            }
        };
        let start = if report.points.is_empty() { "Start" } else { "Start anew" };
        let help = "Measures error and cost of every method on the open scene: as it was opened, or as it stands if it was \
                    changed by hand. The simulation goes on.";
        button(ui, start, !busy, LabOrder::Start, help);
        button(ui, "Stop", busy, LabOrder::Stop, "Ends the measuring after the step at hand. What was measured stays.");
        let stopped = report.stage == Stage::Stopped;
        button(ui, "Resume", stopped, LabOrder::Resume, "Goes on where it was stopped.");
    });
    let progress = report.progress.filter(|_| busy);
    if let Some(progress) = progress {
        let part = progress.done as f32 / progress.total.max(1) as f32;
        let text = format!("{} of {}, {:.0} s left", progress.done, progress.total, progress.seconds_left.ceil());
        let colours = theme::colours(ui);
        let text = RichText::new(text).color(colours.strong);
        let bar = egui::ProgressBar::new(part).desired_width(ui.available_width() - 4.0 * theme::GRID).text(text);
        let bar = bar.fill(colours.accent.gamma_multiply(0.6)).corner_radius(theme::GRID);
        ui.add(bar).on_hover_text("Settings tried so far, of all, and an estimate of the time that the rest takes.");
    }
    note(ui, &stage_text(report));
    if !report.scene.is_empty() && report.scene != frame.scene.name {
        note(ui, &format!("These are of another scene: {}.", report.title));
    }
}

fn stage_text(report: &LabReport) -> String {
    let points = report.points.len();
    let slow = if report.slow > 0 { format!(", {} settings too slow", report.slow) } else { String::new() };
    let against = match (&report.stage, report.reference.as_str()) {
        (Stage::Idle, "") => {
            return "Error: RMS distance from the truth in parts of the length. Cost: CPU time.".into();
        }
        (_, "") => String::new(),
        (_, reference) => format!(" Against: {reference}, over {} s.", format::plain(report.seconds, 2)),
    };
    match &report.stage {
        Stage::Idle => format!("Stopped before there was a reference.{against}"),
        Stage::Refining { runs, part } => format!("Reference: run {}, {:.0} %.", runs + 1, 100.0 * part),
        Stage::Measuring => format!("{points} points{slow}.{against}"),
        Stage::Stopped => format!("Stopped: {points} points{slow}.{against}"),
        Stage::Finished => format!("Finished: {points} points{slow}.{against}"),
        Stage::Failed(why) => format!("Failed: {why}."),
    }
}

/// Two fields, what to use for each, and a button that does.
fn advice(
    ui: &mut Ui,
    frame: &Frame,
    points: &[Point],
    front: &Front,
    wanted: &mut Wanted,
    commands: &mut Vec<Command>,
) {
    if points.is_empty() {
        return;
    }
    let help = "Wanted error, in parts of the scene's length. Drag, or click to type.";
    let error = Field { name: "Wanted error", unit: "", range: 1e-16..=1.0, help };
    let use_it = error.show(ui, &mut wanted.error);
    note(ui, &front.advice_for_error(wanted.error));
    let best = front.cheapest_for(wanted.error).filter(|_| use_it);
    commands.extend(best.map(|point| load(point, frame)));
    let help =
        "Wanted budget, in microseconds of CPU time per simulated second: 1e6 is a whole core. Drag, or click to type.";
    let budget = Field { name: "Wanted budget", unit: " µs/s", range: 0.1..=1e7, help };
    let use_it = budget.show(ui, &mut wanted.budget);
    note(ui, &front.advice_for_budget(wanted.budget));
    let best = front.best_within(wanted.budget).filter(|_| use_it);
    commands.extend(best.map(|point| load(point, frame)));
    if let Some(gain) = front.gain(points, Setting::BASELINE) {
        note(ui, &gain.sentence());
    }
}

/// The command that steps the simulation as a point was.
fn load(point: &Point, frame: &Frame) -> Command {
    Command::Method(point.setting().method(frame.method))
}

/// A value that advice is asked for.
struct Field {
    name: &'static str,
    unit: &'static str,
    range: RangeInclusive<f64>,
    help: &'static str,
}

impl Field {
    /// The row; whether the advice is to be followed.
    fn show(self, ui: &mut Ui, value: &mut f64) -> bool {
        let Field { name, unit, range, help } = self;
        let row = ui.horizontal(|ui| {
            let label = ui.label(RichText::new(name).color(theme::colours(ui).weak));
            let speed = 0.02 * *value;
            let drag = DragValue::new(value).range(range).speed(speed).suffix(unit).update_while_editing(false);
            let drag = drag.custom_formatter(move |value, _| {
                if unit.is_empty() { format::minus(format!("{value:.0e}")) } else { format::digits(value) }
            });
            ui.add(drag).labelled_by(label.id).on_hover_text(help);
            label.on_hover_text(help);
            let button = ui.button("Use").on_hover_text("Steps the simulation with the settings named below.");
            let clicked = button.clicked();
            button.accessible_name(format!("Use for the {}", name.to_lowercase()));
            clicked
        });
        row.inner
    }
}

fn export(ui: &mut Ui, report: &LabReport, wanted: &mut Wanted, commands: &mut Vec<Command>) {
    if report.points.is_empty() {
        return;
    }
    ui.horizontal(|ui| {
        let edit = TextEdit::singleline(&mut wanted.path).hint_text("Path").desired_width(96.0);
        let help = "Path of the file to write, without its ending.";
        ui.add(edit).accessible_name("Path to export to").on_hover_text(help);
        for (name, ending, help) in [
            ("CSV", "csv", "Writes all points as comma-separated values."),
            ("JSON", "jsonl", "Writes all points as lines of JSON, which `tautline lab --resume` reads."),
            ("SVG", "svg", "Writes the diagram as a picture."),
        ] {
            if ui.button(name).on_hover_text(help).clicked() && !wanted.path.trim().is_empty() {
                let path = format!("{}.{ending}", wanted.path.trim());
                commands.push(Command::Lab(LabOrder::Export(path.into())));
            }
        }
    });
    if let Some(saved) = &report.saved {
        note(ui, &format!("Saved to {saved}"));
    }
}

/// Where a point lies in the diagram: powers of ten of cost and error.
fn place(point: &Point) -> Option<[f64; 2]> {
    let error = point.error.filter(|error| error.is_finite())?;
    Some([point.cpu_us_per_second.log10(), error.max(SMALLEST).log10()])
}

/// The points, and faintly behind them those that were published.
fn diagram(ui: &mut Ui, frame: &Frame, points: &[Point], faint: &[Point], front: &Front, commands: &mut Vec<Command>) {
    let places: Vec<(usize, [f64; 2])> =
        points.iter().enumerate().filter_map(|(index, point)| Some((index, place(point)?))).collect();
    ui.vertical(|ui| {
        // In a small window the names are scrolled, so that the diagram keeps its room.
        let area = ScrollArea::vertical().id_salt("lab legend").max_height(LEGEND).auto_shrink([false, true]);
        widgets::scroll(ui, area, |ui| legend(ui, points));
        let colours = theme::colours(ui);
        let all = || points.iter().chain(faint).filter_map(place);
        let bounds = [0, 1].map(|axis| whole_decades(all().map(|place| place[axis])));
        let response = plot(&colours).show(ui, |plot| {
            let [x, y] = bounds;
            plot.set_plot_bounds(PlotBounds::from_min_max([x[0], y[0]], [x[1], y[1]]));
            let behind: Vec<[f64; 2]> = faint.iter().filter_map(place).collect();
            let marks = Points::new("Published", PlotPoints::new(behind)).radius(2.0).allow_hover(false);
            plot.points(marks.color(colours.weak.gamma_multiply(0.5)));
            let line: Vec<[f64; 2]> = front.points().iter().filter_map(place).collect();
            plot.line(Line::new("Front", PlotPoints::new(line)).color(colours.strong).width(2.0).allow_hover(false));
            for family in Family::ALL {
                marks_of(plot, &colours, points, front, family);
            }
        });
        hover(ui, frame, points, &places, &response, commands);
    });
}

/// The points of a family, those on the front larger and brighter.
fn marks_of<'a>(plot: &mut PlotUi<'a>, colours: &theme::Colours, points: &[Point], front: &Front, family: Family) {
    let (shape, filled, colour) = look(family);
    for (on_front, radius, brightness) in [(false, 3.5, 0.65), (true, 5.5, 1.0)] {
        let wanted = |point: &&Point| point.method == family && front.contains(point) == on_front;
        let own: Vec<[f64; 2]> = points.iter().filter(wanted).filter_map(place).collect();
        let colour = family_colour(colours, colour).gamma_multiply(brightness);
        let marks = Points::new(family.name(), PlotPoints::new(own)).shape(marker(shape)).filled(filled);
        plot.points(marks.color(colour).radius(radius).allow_hover(false));
    }
}

/// Whole powers of ten around values, with a little room: from and to.
fn whole_decades(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    if !(low <= high) {
        return [0.0, 1.0];
    }
    [low.floor() - 0.1, high.ceil().max(low.floor() + 1.0) + 0.1]
}

/// The families that have a point, with their marks, in a row that wraps.
fn legend(ui: &mut Ui, points: &[Point]) {
    let colours = theme::colours(ui);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = egui::vec2(3.0 * theme::GRID, 0.0);
        for family in Family::ALL.into_iter().filter(|family| points.iter().any(|point| point.method == *family)) {
            let (shape, filled, colour) = look(family);
            let font = egui::FontId::proportional(theme::SMALL);
            let words = ui.painter().layout_no_wrap(family.name(), font, colours.weak);
            let (rect, response) = ui.allocate_exact_size(egui::vec2(14.0 + words.size().x, 16.0), Sense::hover());
            response.widget_info(|| WidgetInfo::labeled(Role::Label, true, family.name()));
            paint_mark(
                ui.painter(),
                rect.left_center() + egui::vec2(5.0, 0.0),
                shape,
                filled,
                family_colour(&colours, colour),
            );
            let at = egui::pos2(rect.left() + 14.0, rect.center().y - words.size().y / 2.0);
            ui.painter().galley(at, words, colours.weak);
        }
    });
}

fn paint_mark(painter: &Painter, at: Pos2, shape: Shape, filled: bool, colour: Color32) {
    const R: f32 = 4.0;
    let corners = |offsets: &[(f32, f32)]| offsets.iter().map(|(x, y)| at + R * egui::vec2(*x, *y)).collect::<Vec<_>>();
    let stroke = Stroke::new(1.5, colour);
    let polygon: &[(f32, f32)] = match shape {
        Shape::Circle => {
            let fill = if filled { colour } else { Color32::TRANSPARENT };
            painter.circle(at, R, fill, stroke);
            return;
        }
        Shape::Plus | Shape::Cross => {
            let (a, b) = if shape == Shape::Plus {
                (egui::vec2(R, 0.0), egui::vec2(0.0, R))
            } else {
                (egui::vec2(R, R), egui::vec2(R, -R))
            };
            painter.line_segment([at - a, at + a], stroke);
            painter.line_segment([at - b, at + b], stroke);
            return;
        }
        Shape::Square => &[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
        Shape::Diamond => &[(0.0, -1.2), (1.2, 0.0), (0.0, 1.2), (-1.2, 0.0)],
        Shape::Up => &[(0.0, -1.1), (1.1, 0.9), (-1.1, 0.9)],
        Shape::Down => &[(0.0, 1.1), (1.1, -0.9), (-1.1, -0.9)],
    };
    let fill = if filled { colour } else { Color32::TRANSPARENT };
    painter.add(egui::Shape::convex_polygon(corners(polygon), fill, stroke));
}

/// Explains the point under the pointer; a click loads its settings.
fn hover(
    ui: &Ui,
    frame: &Frame,
    points: &[Point],
    places: &[(usize, [f64; 2])],
    response: &PlotResponse<()>,
    commands: &mut Vec<Command>,
) {
    let Some(pointer) = response.response.hover_pos() else { return };
    let distance = |place: &[f64; 2]| {
        let at = response.transform.position_from_point(&PlotPoint::new(place[0], place[1]));
        at.distance(pointer)
    };
    let nearest = places.iter().map(|(index, place)| (*index, distance(place))).min_by(|a, b| a.1.total_cmp(&b.1));
    let Some((index, _)) = nearest.filter(|(_, distance)| *distance <= REACH) else { return };
    let point = &points[index];
    ui.ctx().set_cursor_icon(egui::CursorIcon::PointingHand);
    response.response.clone().on_hover_text_at_pointer(explain(point));
    if response.response.clicked() {
        commands.push(load(point, frame));
    }
}

/// What a point is, in a few lines.
pub fn explain(point: &Point) -> String {
    let error = point.error.map_or("none".into(), |error| format!("{error:.1e}"));
    format!(
        "{}\nError: {error} of the length ({})\nCost: {} µs of CPU time per simulated second\nWorst violation: {}\nEnergy drift: \
         {:.1e}\nClick to step the simulation so.",
        point.setting().label(),
        point.error_kind,
        format::digits(point.cpu_us_per_second),
        format::si(point.violation_max, "m"),
        point.energy_drift,
    )
}

fn plot(colours: &theme::Colours) -> Plot<'static> {
    let power = |mark: GridMark| format!("1e{}", mark.value.round());
    Plot::new("Lab diagram")
        .id(Id::unique("lab diagram"))
        .allow_zoom(false)
        .allow_drag(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_double_click_reset(false)
        .show_background(false)
        .show_x(false)
        .show_y(false)
        .grid_color(colours.weak.gamma_multiply(0.5))
        .x_grid_spacer(|input| decades(input.bounds))
        .y_grid_spacer(|input| decades(input.bounds))
        .x_axis_formatter(move |mark, _| power(mark))
        .y_axis_formatter(move |mark, _| power(mark))
        .x_axis_label("Cost [µs/s]")
        .y_axis_label("Error")
        .sense(Sense::click())
}

/// A line every power of ten, a label at each, or at every third where there are many.
fn decades((from, to): (f64, f64)) -> Vec<GridMark> {
    let every = if to - from > 8.0 { 3 } else { 1 };
    let step = |n: i64| if n % every == 0 { every as f64 } else { 1.0 };
    (from.ceil() as i64..=to.floor() as i64).map(|n| GridMark { value: n as f64, step_size: step(n) }).collect()
}

fn marker(shape: Shape) -> MarkerShape {
    match shape {
        Shape::Circle => MarkerShape::Circle,
        Shape::Square => MarkerShape::Square,
        Shape::Diamond => MarkerShape::Diamond,
        Shape::Up => MarkerShape::Up,
        Shape::Down => MarkerShape::Down,
        Shape::Plus => MarkerShape::Plus,
        Shape::Cross => MarkerShape::Cross,
    }
}

/// The colour of that number in `lab::report::mark`.
fn family_colour(colours: &theme::Colours, index: usize) -> Color32 {
    let [blue, orange, green, strong, pink, vermilion] = colours.series;
    [blue, vermilion, green, pink, strong, orange, colours.weak][index.min(6)]
}

fn note(ui: &mut Ui, text: &str) {
    widgets::note(ui, text);
}
