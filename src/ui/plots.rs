//! The plots at the bottom: energy by kind, violation and penetration, step time by stage.

use super::format::{round_si, si};
use super::state::{PlotTab, State};
use super::{lab, theme};
use crate::app::plot_data::{PLOT_SECONDS, Sample};
use crate::app::{Command, Companion, Frame};
use crate::engine::Stage;
use crate::measure::Measures;
use crate::render::legend::{SteadyRange, step_down, step_up};
use egui::{Color32, FontId, Id, Rangef, Role, Sense, Shape, Stroke, Ui, Vec2b, WidgetInfo, pos2};
use egui_plot::{AxisHints, FilledArea, GridMark, HLine, Line, LineStyle, MarkerShape, Plot, PlotBounds, PlotPoints};
use egui_plot::{PlotUi, Points, VLine};
use std::time::Instant;

/// Points a curve: more cannot be told apart on a screen and cost time in every pass.
const POINTS: usize = 500;
/// Least distance of two labels of the upward axis [points].
const LABEL_SPACING: f32 = 16.0;
/// Decades below the top of the logarithmic axis.
const DECADES: f64 = 8.0;
/// The same for local errors, which lie far below what is wanted of the whole.
const ERROR_DECADES: f64 = 9.0;
/// The same for distances from the truth, which reach from rounding to the scene's size.
const DISTANCE_DECADES: f64 = 12.0;
/// Range of a plot that has nothing but zeros to show [J].
const NO_ENERGY: f64 = 1.0;
/// The same for errors [m]: a thousandth of the diameter of a hair.
const NO_ERROR: f64 = 1e-7;
/// The budget of a step is in the plot while it is at most so many times what steps take.
const BUDGET_IN_SIGHT: f64 = 4.0;

/// What the plots remember between passes: their ranges, so that they do not flicker.
#[derive(Clone, Debug, Default)]
pub struct Plots {
    /// Of the energies above and below zero [J].
    energy: [SteadyRange; 2],
    /// [m]
    violation: SteadyRange,
    /// In parts of an island's size.
    local_error: SteadyRange,
    /// [m]
    distance: SteadyRange,
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
        let samples = frame.plots.read();
        Curves::folded(fold, samples.iter().map(|sample| (sample.measures.time, value(sample))))
    }

    /// The same of times and values, times ascending.
    fn folded(fold: Fold, samples: impl Iterator<Item = (f64, [f64; N])>) -> Curves<N> {
        let width = PLOT_SECONDS / POINTS as f64;
        let mut curves = Curves { times: Vec::with_capacity(POINTS + 1), values: Vec::with_capacity(POINTS + 1) };
        let (mut bucket, mut count) = (f64::NEG_INFINITY, 0.0);
        for (time, new) in samples {
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

    fn times_where(&self, wanted: impl Fn(&[f64; N]) -> bool) -> impl Iterator<Item = f64> {
        self.times.iter().zip(&self.values).filter(move |(_, values)| wanted(values)).map(|(time, _)| *time)
    }

    /// The longest runs of points that are wanted, in the order of time.
    fn parts(&self, wanted: impl Fn(&[f64; N]) -> bool) -> impl Iterator<Item = impl Iterator<Item = (f64, [f64; N])>> {
        let mut from = 0;
        std::iter::from_fn(move || {
            let start = from + self.values[from..].iter().position(&wanted)?;
            let length = self.values[start..].iter().position(|values| !wanted(values));
            from = length.map_or(self.values.len(), |length| start + length);
            let range = start..from;
            Some(self.times[range.clone()].iter().copied().zip(self.values[range].iter().copied()))
        })
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
    pub fn show(&mut self, ui: &mut Ui, frame: &Frame, state: &mut State, commands: &mut Vec<Command>) {
        if self.opened != frame.scene.opened {
            *self = Plots { opened: frame.scene.opened, ..Plots::default() };
        }
        ui.horizontal_wrapped(|ui| {
            tabs(ui, state);
            ui.add_space(2.0 * theme::GRID);
            match state.plot {
                PlotTab::Energy => energy_legend(ui, frame),
                PlotTab::Violation => violation_legend(ui, frame, &mut state.plot_log),
                PlotTab::LocalError => local_error_legend(ui, frame),
                PlotTab::Distance => distance_legend(ui, frame),
                PlotTab::StepTime => step_legend(ui, frame),
                PlotTab::Lab => {}
            }
        });
        match state.plot {
            PlotTab::Energy => self.energy(ui, frame),
            PlotTab::Violation => self.violation(ui, frame, state.plot_log),
            PlotTab::LocalError => self.local_error(ui, frame),
            PlotTab::Distance => self.distance(ui, frame),
            PlotTab::StepTime => self.step(ui, frame),
            PlotTab::Lab => lab::show(ui, frame, state, commands),
        }
    }

    /// The tabs alone, in a low window: a click on one unfolds its plot.
    pub fn show_folded(&mut self, ui: &mut Ui, state: &mut State) {
        ui.horizontal_centered(|ui| tabs(ui, state));
    }

    fn energy(&mut self, ui: &mut Ui, frame: &Frame) {
        let curves = Curves::of(frame, Fold::Mean, |sample| energies(&sample.measures));
        // Before the first step there is no sample yet, but there are energies.
        let current = energies(&frame.measures);
        let most = |values: &[f64; 4], sign: f64| values.iter().fold(0.0, |most, v| f64::max(most, sign * v));
        let largest = |sign: f64| curves.largest(|values| most(values, sign)).max(most(&current, sign));
        let now = Instant::now();
        self.energy[0].update(largest(1.0), now);
        self.energy[1].update(largest(-1.0), now);
        let colours = theme::colours(ui).series;
        let range = match [-self.energy[1].top(), self.energy[0].top()] {
            [0.0, 0.0] => [0.0, NO_ENERGY],
            range => range,
        };
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
        let top = if self.violation.top() > 0.0 { self.violation.top() } else { NO_ERROR };
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

    fn local_error(&mut self, ui: &mut Ui, frame: &Frame) {
        let curves = Curves::of(frame, Fold::Largest, |sample| {
            let fell_short = f64::from(u8::from(sample.fell_short));
            [sample.local_error, fell_short]
        });
        let wanted = frame.method.accuracy;
        self.local_error.update(curves.largest(|values| values[0]).max(wanted), Instant::now());
        let theme::Colours { series, weak, warning, .. } = theme::colours(ui);
        let high = self.local_error.top().log10().ceil();
        let low = high - ERROR_DECADES;
        let label = |mark: GridMark| format!("1e{}", mark.value);
        let map = |value: f64| value.max(1e-300).log10().max(low);
        plot(ui, "Local error plot", frame, Rise { range: [low, high], decades: true }, label, |plot| {
            // Steps that nothing estimated leave a gap.
            for part in curves.parts(|values| values[0] > 0.0) {
                let points = part.map(|(time, values)| [time, map(values[0])]).collect();
                plot.line(Line::new("Local error", PlotPoints::new(points)).color(series[0]).width(1.5));
            }
            plot.hline(HLine::new("Wanted", map(wanted)).color(weak).style(LineStyle::dashed_loose()));
            // At the top, where no curve hides them.
            let lapsed: Vec<[f64; 2]> = curves.times_where(|values| values[1] > 0.0).map(|time| [time, high]).collect();
            plot.points(Points::new("Not kept", lapsed).shape(MarkerShape::Down).radius(4.0).color(warning));
        });
    }

    fn distance(&mut self, ui: &mut Ui, frame: &Frame) {
        let of = |companion: &Companion| {
            let gaps = companion.gaps();
            Curves::folded(Fold::Largest, gaps.iter().map(|gap| (gap.time, [gap.rms, gap.max, gap.uncertainty])))
        };
        let companions = [&frame.companions.truth, &frame.companions.rival];
        let curves: Vec<(usize, Curves<3>)> = companions
            .into_iter()
            .enumerate()
            .filter_map(|(index, companion)| companion.as_ref().map(|companion| (index, of(companion))))
            .collect();
        let largest = curves.iter().map(|(_, curves)| curves.largest(|values| values[1])).fold(0.0, f64::max);
        self.distance.update(largest, Instant::now());
        let top = if self.distance.top() > 0.0 { self.distance.top() } else { NO_ERROR };
        let high = top.log10().ceil();
        let low = high - DISTANCE_DECADES;
        let label = |mark: GridMark| round_si(10f64.powf(mark.value), "m");
        let map = |value: f64| value.max(1e-300).log10().max(low);
        let parting = frame.companions.rival.as_ref().and_then(|rival| rival.report().parting);
        let theme::Colours { series, weak, warning, .. } = theme::colours(ui);
        plot(ui, "Distance plot", frame, Rise { range: [low, high], decades: true }, label, |plot| {
            for (index, curves) in &curves {
                for (part, name) in DISTANCES[*index].iter().enumerate() {
                    plot.line(Line::new(name.0, curves.line(part, map)).color(series[2 * index + part]).width(1.5));
                }
                if curves.largest(|values| values[2]) > 0.0 {
                    let line = Line::new("Uncertainty", curves.line(2, map)).color(weak);
                    plot.line(line.style(LineStyle::dashed_loose()).width(1.0));
                }
            }
            if let Some(parting) = parting {
                plot.vline(VLine::new("Parted", parting.time).color(warning).style(LineStyle::dashed_loose()));
            }
        });
    }

    fn step(&mut self, ui: &mut Ui, frame: &Frame) {
        let curves = Curves::of(frame, Fold::WorstSum, |sample| sample.stage_us);
        self.step.update(curves.largest(|values| values.iter().sum()), Instant::now());
        let (colours, weak) = (theme::colours(ui).series, theme::colours(ui).weak);
        let budget = budget(frame);
        let label = |mark: GridMark| round_si(mark.value * 1e-6, "s");
        let top = self.step.top().max(1.0);
        // Far above, it would press the steps to the ground; the legend says it in any case.
        let top = if budget <= BUDGET_IN_SIGHT * top { top.max(budget) } else { top };
        let rise = Rise { range: [0.0, top], decades: false };
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

/// In the order of [`ENERGIES`] [J].
fn energies(m: &Measures) -> [f64; 4] {
    [m.kinetic, m.potential, m.elastic, m.total_energy()]
}

/// Time that a step may take to keep up with the wanted speed [µs].
pub fn budget(frame: &Frame) -> f64 {
    1e6 / (frame.method.hz * frame.speed.rate().max(1e-6))
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

/// Curves of the truth and of the rival: root mean square and largest distance.
const DISTANCES: [[(&str, &str); 2]; 2] = [
    [
        ("Off truth, RMS", "Root mean square over all bodies of the distance from the truth."),
        ("Off truth, max", "Largest distance of a body from the truth."),
    ],
    [
        ("A | B, RMS", "Root mean square over all bodies of the distance between the two methods."),
        ("A | B, max", "Largest distance of a body between the two methods."),
    ],
];

fn distance_legend(ui: &mut Ui, frame: &Frame) {
    let theme::Colours { series, weak, warning, .. } = theme::colours(ui);
    let companions = [&frame.companions.truth, &frame.companions.rival];
    if companions.iter().all(|companion| companion.is_none()) {
        ui.label(egui::RichText::new("Switch on Ghost [Shift-H] or A | B [Shift-B] to see distances.").color(weak));
        return;
    }
    for (index, companion) in companions.into_iter().enumerate() {
        let Some(report) = companion.as_ref().map(Companion::report) else { continue };
        let values = report.gap.map(|gap| [gap.rms, gap.max]);
        for (part, (name, help)) in DISTANCES[index].iter().enumerate() {
            let value = values.map_or("none".into(), |values| si(values[part], "m"));
            entry(ui, series[2 * index + part], name, &value, help);
        }
        if let Some(gap) = report.gap.filter(|gap| gap.uncertainty > 0.0) {
            let help = "What the distance from the truth may itself be off by: the distance of two runs of different fineness.";
            marked(ui, dashed(weak), "Uncertainty", &si(gap.uncertainty, "m"), help);
        }
        if let (1, Some(parting)) = (index, report.parting) {
            let help = "When a body of A and its double of B were first a hundredth of the scene's length apart.";
            marked(ui, dashed(warning), "Parted", &format!("{:.2} s", parting.time), help);
        }
    }
}

fn tabs(ui: &mut Ui, state: &mut State) {
    for tab in PlotTab::ALL {
        let response = ui.selectable_label(state.plot == tab, tab.name()).on_hover_text(tab.help());
        if response.clicked() {
            // A second click on a tab folds the plots away, and the next unfolds them.
            let folded = state.plot == tab && state.plots_panel == Some(true);
            (state.plot, state.plots_panel) = (tab, Some(!folded));
        }
    }
}

fn energy_legend(ui: &mut Ui, frame: &Frame) {
    let colours = theme::colours(ui).series;
    for ((name, help), (value, colour)) in ENERGIES.iter().zip(energies(&frame.measures).into_iter().zip(colours)) {
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

fn local_error_legend(ui: &mut Ui, frame: &Frame) {
    let theme::Colours { series, weak, warning, .. } = theme::colours(ui);
    let value = match frame.report.local_error {
        0.0 => "not estimated".to_owned(),
        error => format!("{error:.0e}"),
    };
    let help = "Estimated error of the last step alone, in parts of an island's size. By accuracy every method estimates it; of those \
                chosen by hand, Taylor series, RATTLE and Radau's.";
    entry(ui, series[0], "Local error", &value, help);
    let help =
        "Wanted accuracy of the motion after a second or so: the dashed line. Each step has to stay well below it.";
    marked(ui, dashed(weak), "Wanted", &format!("{:.0e}", frame.method.accuracy), help);
    let lapsed = frame.plots.read().iter().filter(|sample| sample.fell_short).count();
    if lapsed > 0 {
        let help = "Steps of the last 20 s in which the accuracy was not kept: the marks along the top.";
        marked(ui, down_mark(warning), "Not kept", &format!("{lapsed} steps"), help);
    }
}

/// The mark of a step that did not keep its accuracy, for [`marked`].
fn down_mark(colour: Color32) -> impl Fn(Rangef, f32) -> Vec<Shape> {
    move |at, y| {
        let corners = [(-4.0, -4.0), (4.0, -4.0), (0.0, 4.0)].map(|(dx, dy)| pos2(at.center() + dx, y + dy));
        vec![Shape::convex_polygon(corners.to_vec(), colour, Stroke::NONE)]
    }
}

/// A dashed line for [`marked`].
fn dashed(colour: Color32) -> impl Fn(Rangef, f32) -> Vec<Shape> {
    move |at, y| Shape::dashed_line(&[pos2(at.min, y), pos2(at.max, y)], (1.5, colour), 4.0, 2.0)
}

fn step_legend(ui: &mut Ui, frame: &Frame) {
    let theme::Colours { series, weak, .. } = theme::colours(ui);
    for ((stage, micros), colour) in Stage::ALL.iter().zip(frame.report.stage_us).zip(series) {
        let help = format!("{}: time of this stage in the last step.", stage.name());
        entry(ui, colour, stage.name(), &si(micros * 1e-6, "s"), &help);
    }
    let help = "Time that a step may take to keep up with the wanted speed: the dashed line. It is out of sight while steps \
                take far less.";
    marked(ui, dashed(weak), "Budget", &si(budget(frame) * 1e-6, "s"), help);
}

/// A stroke of a curve's colour, its name and its value now.
fn entry(ui: &mut Ui, colour: Color32, name: &str, value: &str, tooltip: &str) {
    marked(ui, |at, y| vec![Shape::hline(at, y, Stroke::new(3.0, colour))], name, value, tooltip);
}

/// A line as in the plot, a name and a value, in one piece when the row is wrapped.
fn marked(ui: &mut Ui, line: impl Fn(Rangef, f32) -> Vec<Shape>, name: &str, value: &str, tooltip: &str) {
    const LINE: f32 = 14.0;
    /// Room for "−999 mJ", so that the row does not dance with its digits.
    const VALUE: f32 = 56.0;
    let colours = theme::colours(ui);
    let words =
        |text: &str, colour| ui.painter().layout_no_wrap(text.into(), FontId::proportional(theme::BODY), colour);
    let (name_words, value_words) = (words(name, colours.weak), words(value, colours.text));
    let after_name = LINE + 2.0 * theme::GRID + name_words.size().x;
    let size = egui::vec2(after_name + value_words.size().x.max(VALUE), theme::ROW);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("{name} {value}")));
    let y = rect.center().y;
    ui.painter().extend(line(Rangef::new(rect.left(), rect.left() + LINE), y));
    for (x, words) in [(LINE + theme::GRID, name_words), (after_name, value_words)] {
        let at = pos2(rect.left() + x, y - words.size().y / 2.0);
        ui.painter().galley(at, words, colours.text);
    }
    response.on_hover_text(tooltip);
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

/// At least two labelled lines at round values, as close as their labels allow; `height` is that of the plot [points].
fn rounds((from, to): (f64, f64), height: f32) -> Vec<GridMark> {
    let span = to - from;
    let closest = span * f64::from(LABEL_SPACING / height.max(1.0));
    let step = step_down(span / 2.0).max(step_up(closest).min(step_down(span)));
    if !(step > 0.0) {
        return Vec::new();
    }
    let marks = (from / step).ceil() as i64..=(to / step).floor() as i64;
    marks.map(|k| GridMark { value: k as f64 * step, step_size: step }).collect()
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
        .x_grid_spacer(|input| seconds(input.bounds))
        .x_axis_formatter(|mark, _| format!("{} s", mark.value))
        .custom_y_axes(vec![
            AxisHints::new_y()
                .min_thickness(56.0)
                .label_spacing(LABEL_SPACING - 4.0..=LABEL_SPACING)
                .formatter(move |mark, _| label(mark)),
        ])
        .sense(Sense::hover());
    plot = if rise.decades {
        plot.y_grid_spacer(|input| decades(input.bounds))
    } else {
        plot.y_grid_spacer(move |input| rounds(input.bounds, size.y))
    };
    let response = plot.show(ui, move |plot| {
        plot.set_auto_bounds(Vec2b::FALSE);
        plot.set_plot_bounds(bounds);
        draw(plot);
    });
    response.response.on_hover_cursor(egui::CursorIcon::Crosshair);
}
