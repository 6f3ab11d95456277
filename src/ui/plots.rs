//! The plots at the bottom: energy by kind, violation and penetration, step time by stage.

use super::format::{round_si, si};
use super::state::{PlotTab, State};
use super::theme;
use crate::app::Frame;
use crate::app::plot_data::{PLOT_SECONDS, Sample};
use crate::engine::Stage;
use crate::render::legend::SteadyRange;
use egui::scroll_area::ScrollBarVisibility;
use egui::{Color32, Id, Label, RichText, ScrollArea, Sense, Stroke, Ui, Vec2b};
use egui_plot::{FilledArea, GridMark, HLine, Line, LineStyle, Plot, PlotBounds, PlotPoints, PlotUi};
use std::time::Instant;

/// Points a curve: more cannot be told apart on a screen and cost time in every pass.
const POINTS: usize = 500;
/// Decades below the top of the logarithmic axis.
const DECADES: f64 = 8.0;
/// Least top of a range, so that an empty plot has one [the plot's unit].
const LEAST_TOP: f64 = 1e-12;

/// What the plots remember between passes: their ranges, so that they do not flicker.
#[derive(Clone, Debug, Default)]
pub struct Plots {
    /// Of the energies above and below zero [J].
    energy: [SteadyRange; 2],
    /// [m]
    violation: SteadyRange,
    /// [µs]
    step: SteadyRange,
    /// Opening of the scene that the ranges belong to.
    opened: u64,
}

/// How the samples of one bucket become one point.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Fold {
    Mean,
    /// The largest of each value by itself.
    Largest,
    /// All values of the sample whose sum is largest.
    WorstSum,
}

/// Curves over the same times.
struct Curves<const N: usize> {
    /// [s]
    times: Vec<f64>,
    values: Vec<[f64; N]>,
}

impl<const N: usize> Curves<N> {
    /// At most [`POINTS`] points; buckets are aligned to absolute time, so that old points never change.
    fn of(frame: &Frame, fold: Fold, value: impl Fn(&Sample) -> [f64; N]) -> Curves<N> {
        let width = PLOT_SECONDS / POINTS as f64;
        let mut curves = Curves { times: Vec::with_capacity(POINTS + 1), values: Vec::with_capacity(POINTS + 1) };
        let (mut bucket, mut count) = (f64::NEG_INFINITY, 0.0);
        for sample in frame.plots.read().iter() {
            let (time, new) = (sample.measures.time, value(sample));
            let index = (time / width).floor();
            match curves.values.last_mut().filter(|_| index == bucket) {
                Some(old) => {
                    count += 1.0;
                    merge(old, &new, fold, count);
                }
                None => {
                    (bucket, count) = (index, 1.0);
                    curves.times.push(time);
                    curves.values.push(new);
                }
            }
        }
        curves
    }

    fn line(&self, index: usize, map: impl Fn(f64) -> f64) -> PlotPoints<'static> {
        let points = self.times.iter().zip(&self.values);
        PlotPoints::new(points.map(|(time, values)| [*time, map(values[index])]).collect())
    }

    fn largest(&self, value: impl Fn(&[f64; N]) -> f64) -> f64 {
        self.values.iter().map(value).filter(|value| value.is_finite()).fold(0.0, f64::max)
    }
}

fn merge<const N: usize>(old: &mut [f64; N], new: &[f64; N], fold: Fold, count: f64) {
    if fold == Fold::WorstSum {
        if new.iter().sum::<f64>() > old.iter().sum::<f64>() {
            *old = *new;
        }
        return;
    }
    for (old, new) in old.iter_mut().zip(new) {
        *old = if fold == Fold::Mean { *old + (new - *old) / count } else { old.max(*new) };
    }
}

impl Plots {
    /// The tabs and the plot that is chosen.
    pub fn show(&mut self, ui: &mut Ui, frame: &Frame, state: &mut State) {
        if self.opened != frame.scene.opened {
            *self = Plots { opened: frame.scene.opened, ..Plots::default() };
        }
        ui.horizontal(|ui| {
            tabs(ui, state);
            ui.add_space(2.0 * theme::GRID);
            // A legend too long for a narrow window is scrolled, and does not push the window's panels apart.
            ScrollArea::horizontal().scroll_bar_visibility(ScrollBarVisibility::AlwaysHidden).show(
                ui,
                |ui| match state.plot {
                    PlotTab::Energy => energy_legend(ui, frame),
                    PlotTab::Violation => violation_legend(ui, frame, &mut state.plot_log),
                    PlotTab::StepTime => step_legend(ui, frame),
                },
            );
        });
        match state.plot {
            PlotTab::Energy => self.energy(ui, frame),
            PlotTab::Violation => self.violation(ui, frame, state.plot_log),
            PlotTab::StepTime => self.step(ui, frame),
        }
    }

    fn energy(&mut self, ui: &mut Ui, frame: &Frame) {
        let curves = Curves::of(frame, Fold::Mean, |sample| {
            let m = &sample.measures;
            [m.kinetic, m.potential, m.elastic, m.total_energy()]
        });
        let largest = |sign: f64| curves.largest(|values| values.iter().fold(0.0, |most, v| f64::max(most, sign * v)));
        let now = Instant::now();
        self.energy[0].update(largest(1.0), now);
        self.energy[1].update(largest(-1.0), now);
        let colours = theme::colours(ui).series;
        let range = [-self.energy[1].top(), self.energy[0].top().max(LEAST_TOP)];
        let label = |mark: GridMark| round_si(mark.value, "J");
        plot(ui, "Energy plot", frame, Rise { range, decades: false }, label, |plot| {
            for (index, (name, _)) in ENERGIES.iter().enumerate() {
                plot.line(Line::new(*name, curves.line(index, |v| v)).color(colours[index]).width(1.5));
            }
        });
    }

    fn violation(&mut self, ui: &mut Ui, frame: &Frame, logarithmic: bool) {
        let curves =
            Curves::of(frame, Fold::Largest, |sample| [sample.measures.violation_max, sample.measures.penetration_max]);
        self.violation.update(curves.largest(|values| values[0].max(values[1])), Instant::now());
        let colours = theme::colours(ui).series;
        let top = self.violation.top().max(LEAST_TOP);
        let high = top.log10().ceil();
        let range = if logarithmic { [high - DECADES, high] } else { [0.0, top] };
        let label = move |mark: GridMark| {
            if logarithmic { round_si(10f64.powf(mark.value), "m") } else { round_si(mark.value, "m") }
        };
        let map = |value: f64| if logarithmic { value.max(1e-300).log10().max(high - DECADES) } else { value };
        plot(ui, "Error plot", frame, Rise { range, decades: logarithmic }, label, |plot| {
            for (index, (name, _)) in VIOLATIONS.iter().enumerate() {
                plot.line(Line::new(*name, curves.line(index, map)).color(colours[index]).width(1.5));
            }
        });
    }

    fn step(&mut self, ui: &mut Ui, frame: &Frame) {
        let curves = Curves::of(frame, Fold::WorstSum, |sample| sample.stage_us);
        self.step.update(curves.largest(|values| values.iter().sum()), Instant::now());
        let (colours, weak) = (theme::colours(ui).series, theme::colours(ui).weak);
        let budget = 1e6 / (frame.method.hz * frame.speed.wanted.max(1e-6));
        let label = |mark: GridMark| round_si(mark.value * 1e-6, "s");
        let rise = Rise { range: [0.0, self.step.top().max(1.0)], decades: false };
        plot(ui, "Step time plot", frame, rise, label, |plot| {
            let mut below = vec![0.0; curves.times.len()];
            for (index, stage) in Stage::ALL.iter().enumerate() {
                let above: Vec<f64> =
                    below.iter().zip(&curves.values).map(|(low, values)| low + values[index]).collect();
                let area = FilledArea::new(stage.name(), &curves.times, &below, &above);
                plot.add(area.fill_color(colours[index].gamma_multiply(0.75)).stroke(Stroke::NONE));
                below = above;
            }
            plot.hline(HLine::new("Budget", budget).color(weak).style(LineStyle::dashed_loose()));
        });
    }
}

const ENERGIES: [(&str, &str); 4] = [
    ("Kinetic", "Energy of translation and rotation."),
    ("Potential", "Energy in gravity, zero at the height of the origin."),
    ("Elastic", "Energy in springs."),
    ("Total", "The sum. It stays where nothing takes energy away or gives some."),
];

const VIOLATIONS: [(&str, &str); 2] = [
    ("Violation", "Worst violation of a rod, a taut rope or a pin."),
    ("Penetration", "Deepest overlap of two surfaces."),
];

fn tabs(ui: &mut Ui, state: &mut State) {
    for tab in PlotTab::ALL {
        let response = ui.selectable_label(state.plot == tab, tab.name()).on_hover_text(tab.help());
        if response.clicked() {
            state.plot = tab;
        }
    }
}

fn energy_legend(ui: &mut Ui, frame: &Frame) {
    let m = &frame.measures;
    let colours = theme::colours(ui).series;
    for ((name, help), (value, colour)) in
        ENERGIES.iter().zip([m.kinetic, m.potential, m.elastic, m.total_energy()].into_iter().zip(colours))
    {
        entry(ui, colour, name, &si(value, "J"), help);
    }
}

fn violation_legend(ui: &mut Ui, frame: &Frame, logarithmic: &mut bool) {
    let colours = theme::colours(ui).series;
    let values = [frame.measures.violation_max, frame.measures.penetration_max];
    for ((name, help), (value, colour)) in VIOLATIONS.iter().zip(values.into_iter().zip(colours)) {
        entry(ui, colour, name, &si(value, "m"), help);
    }
    ui.checkbox(logarithmic, "Logarithmic").on_hover_text("Axis in powers of ten, or linear from zero.");
}

fn step_legend(ui: &mut Ui, frame: &Frame) {
    let colours = theme::colours(ui).series;
    for ((stage, micros), colour) in Stage::ALL.iter().zip(frame.report.stage_us).zip(colours) {
        // Six names fill the row; their values are in the plot.
        swatch(ui, colour, stage.name(), &format!("{} of the last step.", si(micros * 1e-6, "s")));
        ui.add_space(theme::GRID);
    }
}

/// A swatch, a name and the value now.
fn entry(ui: &mut Ui, colour: Color32, name: &str, value: &str, tooltip: &str) {
    swatch(ui, colour, name, tooltip);
    // A fixed width, so that the row does not dance with its digits.
    let width = 60.0;
    ui.allocate_ui_with_layout(egui::vec2(width, theme::ROW), egui::Layout::left_to_right(egui::Align::Center), |ui| {
        ui.set_min_width(width);
        ui.add(Label::new(value).truncate()).on_hover_text(tooltip);
    });
}

fn swatch(ui: &mut Ui, colour: Color32, name: &str, tooltip: &str) {
    let (rect, _) = ui.allocate_exact_size(egui::vec2(10.0, theme::ROW), Sense::hover());
    ui.painter().hline(rect.x_range(), rect.center().y, Stroke::new(3.0, colour));
    ui.label(RichText::new(name).color(theme::colours(ui).weak)).on_hover_text(tooltip);
}

/// The upward axis of a plot.
struct Rise {
    /// In the plot's unit, or its logarithm to the base of ten.
    range: [f64; 2],
    /// A line for every power of ten.
    decades: bool,
}

/// A line every second, a label every five.
fn seconds(bounds: (f64, f64)) -> Vec<GridMark> {
    whole_marks(bounds, 5)
}

/// A line every power of ten, a label where the unit's prefix changes.
fn decades(bounds: (f64, f64)) -> Vec<GridMark> {
    whole_marks(bounds, 3)
}

/// Marks at whole numbers, every `label`-th of them a main one.
fn whole_marks((from, to): (f64, f64), label: i64) -> Vec<GridMark> {
    let step = |n: i64| if n % label == 0 { label as f64 } else { 1.0 };
    (from.ceil() as i64..=to.floor() as i64).map(|n| GridMark { value: n as f64, step_size: step(n) }).collect()
}

/// A plot of the last twenty seconds with a fixed range upwards.
fn plot<'a>(
    ui: &mut Ui,
    name: &'static str,
    frame: &Frame,
    rise: Rise,
    label: impl Fn(GridMark) -> String + 'a,
    draw: impl FnOnce(&mut PlotUi<'a>) + 'a,
) {
    let [low, high] = rise.range;
    let end = frame.measures.time.max(PLOT_SECONDS);
    let margin = (high - low) * 0.05;
    let bounds = PlotBounds::from_min_max([end - PLOT_SECONDS, low - margin], [end, high + margin]);
    let colours = theme::colours(ui);
    // The last label of the time axis is centred on the plot's end.
    let size = ui.available_size() - egui::vec2(4.0 * theme::GRID, 0.0);
    let mut plot = Plot::new(name)
        .id(Id::unique(name))
        .width(size.x)
        .height(size.y)
        .allow_zoom(false)
        .allow_drag(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_axis_zoom_drag(false)
        .allow_double_click_reset(false)
        .set_margin_fraction(egui::Vec2::ZERO)
        .show_background(false)
        .grid_color(colours.weak.gamma_multiply(0.5))
        .y_axis_min_width(56.0)
        .x_grid_spacer(|input| seconds(input.bounds))
        .x_axis_formatter(|mark, _| format!("{} s", mark.value))
        .y_axis_formatter(move |mark, _| label(mark))
        .sense(Sense::hover());
    if rise.decades {
        plot = plot.y_grid_spacer(|input| decades(input.bounds));
    }
    let response = plot.show(ui, move |plot| {
        plot.set_auto_bounds(Vec2b::FALSE);
        plot.set_plot_bounds(bounds);
        draw(plot);
    });
    response.response.on_hover_cursor(egui::CursorIcon::Crosshair);
}
