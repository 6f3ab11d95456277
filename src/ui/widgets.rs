//! The rows that panels are made of: a label on the left, a value in a fixed column on the right, a dot if it was changed.

use super::icon::{self, Icon};
use super::{draft, theme};
use egui::{
    Align, DragValue, Label, Layout, Rect, Response, RichText, Role, ScrollArea, Sense, Slider, SliderClamping, Stroke,
    StrokeKind, Ui, UiBuilder, Vec2, WidgetInfo, vec2,
};
use std::ops::RangeInclusive;

/// A number that can be changed: what it is called, what it is measured in, and what it means.
#[derive(Clone, Debug)]
pub struct Number {
    pub name: &'static str,
    /// Unit after the value ("m/s²"), or nothing.
    pub unit: &'static str,
    pub range: RangeInclusive<f64>,
    /// What it means, for the tooltip.
    pub help: &'static str,
    /// Whether equal ratios lie equally far apart on the slider.
    pub logarithmic: bool,
    /// Most decimals shown.
    pub decimals: usize,
}

/// What happened to a control in this pass.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Change {
    /// The value is a new one.
    pub changed: bool,
    /// The hand has left it with a new value: the moment for an edit that is undone as one.
    pub settled: bool,
}

impl Number {
    fn tooltip(&self, reset: Option<f64>) -> String {
        let unit = if self.unit.is_empty() { "no unit".to_owned() } else { format!("in {}", self.unit) };
        let back = match reset {
            Some(value) => format!(" Double-click: back to {}.", self.with_unit(value)),
            None => String::new(),
        };
        format!(
            "{}\n{} to {}, {unit}. Drag, or click to type.{back}",
            self.help,
            super::format::digits(*self.range.start()),
            super::format::digits(*self.range.end()),
        )
    }

    fn with_unit(&self, value: f64) -> String {
        format!("{} {}", super::format::digits(value), self.unit).trim_end().to_owned()
    }
}

/// A row with a slider and a value, for what is tuned by feel. A double-click resets to `reset`.
pub fn slider(ui: &mut Ui, number: &Number, value: &mut f64, reset: Option<f64>) -> Change {
    control(ui, number, value, reset, true)
}

/// A row with a value to drag or type. A double-click resets to `reset`, if there is such a value.
pub fn number(ui: &mut Ui, number: &Number, value: &mut f64, reset: Option<f64>) -> Change {
    control(ui, number, value, reset, false)
}

/// The same for a whole number.
pub fn whole_slider(ui: &mut Ui, field: &Number, value: &mut u32, reset: Option<u32>) -> Change {
    let mut real = f64::from(*value);
    let change = slider(ui, field, &mut real, reset.map(f64::from));
    *value = real.round().clamp(0.0, f64::from(u32::MAX)) as u32;
    change
}

fn control(ui: &mut Ui, number: &Number, value: &mut f64, reset: Option<f64>, with_slider: bool) -> Change {
    let id = ui.scope_id().with(("draft", number.name));
    let tooltip = number.tooltip(reset);
    let before = draft::read(ui, id, *value);
    let mut edited = before;
    let is_reset = reset.is_none_or(|reset| reset == before);
    let (label, responses) = row(ui, number.name, !is_reset, |ui| {
        let mut responses =
            vec![ui.add_sized([theme::VALUE_WIDTH, theme::ROW - theme::GRID], drag(number, &mut edited))];
        if with_slider {
            ui.spacing_mut().slider_width = ui.available_width();
            let slider = Slider::new(&mut edited, number.range.clone())
                .logarithmic(number.logarithmic)
                .clamping(SliderClamping::Edits)
                .smallest_positive(smallest_positive(number))
                .step_by(if number.decimals == 0 { 1.0 } else { 0.0 })
                .show_value(false);
            let slider = ui.add(slider);
            responses.push(slider.interact(Sense::click_and_drag()));
        }
        responses
    });
    let label = label.on_hover_text(&tooltip);
    let held = responses.iter().any(|r| r.dragged() || r.has_focus());
    let stopped = responses.iter().any(|r| r.drag_stopped());
    let mut double_clicked = label.double_clicked();
    for (i, response) in responses.into_iter().enumerate() {
        double_clicked |= response.double_clicked();
        // The value comes first; where a slider follows, that one has the label's name and the value one of its own.
        let named = if with_slider && i == 0 {
            response.accessible_name(format!("{} value", number.name))
        } else {
            response.labelled_by(label.id)
        };
        named.on_hover_text(&tooltip);
    }
    if double_clicked && let Some(reset) = reset {
        edited = reset;
        ui.memory_mut(|memory| memory.stop_text_input());
    }
    *value = edited;
    let changed = edited != before;
    if changed {
        draft::write(ui, id, edited);
    } else if held {
        draft::touch(ui, id);
    }
    Change { changed, settled: (changed && !held) || stopped || (changed && double_clicked) }
}

/// Where a logarithmic scale that reaches zero begins: four decades below its end.
fn smallest_positive(number: &Number) -> f64 {
    if *number.range.start() > 0.0 { *number.range.start() } else { *number.range.end() * 1e-4 }
}

fn drag<'a>(number: &Number, value: &'a mut f64) -> DragValue<'a> {
    let speed = match (number.decimals, value.abs()) {
        (0, size) => (size * 0.02).max(0.1),
        (_, size) => (size * 0.01).max(10f64.powi(-(number.decimals.min(3) as i32))),
    };
    let decimals = number.decimals;
    let suffix = if number.unit.is_empty() { String::new() } else { format!(" {}", number.unit) };
    DragValue::new(value)
        .range(number.range.clone())
        .clamp_existing_to_range(false)
        .speed(speed)
        .custom_formatter(move |value, _| super::format::minus(trimmed(value, decimals)))
        .suffix(suffix)
        .update_while_editing(false)
}

/// At most `decimals` decimals and about five significant digits, without trailing zeros; powers of ten where that is shorter.
fn trimmed(value: f64, decimals: usize) -> String {
    let size = value.abs();
    if value != 0.0 && (size >= 1e6 || size < 0.5 * 10f64.powi(-(decimals as i32))) {
        return format!("{value:.2e}");
    }
    let shown = if size >= 1000.0 { decimals.min(1) } else { decimals };
    super::format::plain(value, shown)
}

/// A row: label on the left, a dot if `changed`, and what `content` adds from the right edge leftwards.
pub fn row<R>(ui: &mut Ui, label: &str, changed: bool, content: impl FnOnce(&mut Ui) -> R) -> (Response, R) {
    let size = vec2(ui.available_width(), theme::ROW);
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let colours = theme::colours(ui);
    let label_rect = Rect::from_min_size(rect.min, vec2(theme::LABEL_WIDTH, theme::ROW));
    let left = Layout::left_to_right(Align::Center);
    let mut label_ui = ui.new_child(UiBuilder::new().max_rect(label_rect).layout(left));
    let text = RichText::new(label).color(colours.weak);
    let label = label_ui.add(Label::new(text).truncate().sense(Sense::click()));
    if changed {
        let dot = label_rect.right_center() - vec2(theme::GRID, 0.0);
        ui.painter().circle_filled(dot, 2.5, colours.accent);
    }
    let rest = Rect::from_min_max(label_rect.right_top() + vec2(theme::GRID, 0.0), rect.max);
    let right = Layout::right_to_left(Align::Center);
    let inner = content(&mut ui.new_child(UiBuilder::new().max_rect(rest).layout(right)));
    (label, inner)
}

/// A row that only shows a value.
pub fn reading(ui: &mut Ui, label: &str, value: impl Into<String>, tooltip: &str) {
    let (label, value) = row(ui, label, false, |ui| ui.add(Label::new(value.into()).truncate()));
    label.on_hover_text(tooltip);
    value.on_hover_text(tooltip);
}

/// A row with a switch. Returns whether it was turned.
pub fn switch(ui: &mut Ui, label: &str, on: &mut bool, reset: Option<bool>, tooltip: &str) -> bool {
    let changed = reset.is_some_and(|reset| reset != *on);
    let before = *on;
    let (label, response) = row(ui, label, changed, |ui| toggle(ui, on));
    let label = label.on_hover_text(tooltip);
    response.labelled_by(label.id).on_hover_text(tooltip);
    if label.double_clicked()
        && let Some(reset) = reset
    {
        *on = reset;
    } else if label.clicked() {
        *on = !*on;
    }
    *on != before
}

fn toggle(ui: &mut Ui, on: &mut bool) -> Response {
    let (rect, mut response) = ui.allocate_exact_size(vec2(28.0, 16.0), Sense::click());
    if response.clicked() {
        *on = !*on;
        response.mark_changed();
    }
    response.widget_info(|| WidgetInfo::selected(Role::CheckBox, ui.is_enabled(), *on, ""));
    let colours = theme::colours(ui);
    let (back, knob) = if *on { (colours.accent, colours.on_accent) } else { (colours.field, colours.weak) };
    let border = if response.has_focus() || response.hovered() { colours.text } else { colours.line };
    let painter = ui.painter();
    painter.rect(rect, 8.0, back, Stroke::new(1.0, if *on { back } else { border }), StrokeKind::Inside);
    let x = if *on { rect.right() - 8.0 } else { rect.left() + 8.0 };
    painter.circle_filled(egui::pos2(x, rect.center().y), 5.0, knob);
    focus_ring(ui, &response, rect);
    response
}

/// A row with a choice of a few. Each choice has a name and one line of help. Returns whether another was chosen.
pub fn choice<T: Copy + PartialEq>(
    ui: &mut Ui,
    label: &str,
    value: &mut T,
    reset: Option<T>,
    choices: &[(T, &str, &str)],
    tooltip: &str,
) -> bool {
    let before = *value;
    let current = choices.iter().find(|(choice, ..)| *choice == before).map_or("", |(_, name, _)| name);
    let changed = reset.is_some_and(|reset| reset != before);
    let (label_response, combo) = row(ui, label, changed, |ui| {
        let width = ui.available_width();
        egui::ComboBox::from_id_salt(label).selected_text(current).width(width).truncate().show_ui(ui, |ui| {
            for (choice, name, help) in choices {
                ui.selectable_value(value, *choice, *name).on_hover_text(*help);
            }
        })
    });
    let label_response = label_response.on_hover_text(tooltip);
    combo.response.labelled_by(label_response.id).on_hover_text(tooltip);
    if label_response.double_clicked()
        && let Some(reset) = reset
    {
        *value = reset;
    }
    *value != before
}

/// A square button with an icon; `selected` fills it with the accent.
pub fn icon_button(ui: &mut Ui, icon: Icon, name: &str, tooltip: &str, selected: bool, enabled: bool) -> Response {
    let sense = if enabled { Sense::click() } else { Sense::hover() };
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(theme::ICON_BUTTON), sense);
    response.widget_info(|| WidgetInfo::selected(Role::Button, enabled, selected, name));
    let colours = theme::colours(ui);
    let (fill, ink) = match (selected, enabled, response.hovered()) {
        (true, ..) => (Some(colours.accent), colours.on_accent),
        (_, false, _) => (None, colours.line),
        (_, _, true) => (Some(colours.hover), colours.strong),
        _ => (None, colours.text),
    };
    if let Some(fill) = fill {
        ui.painter().rect_filled(rect, theme::GRID, fill);
    }
    icon::paint(ui.painter(), Rect::from_center_size(rect.center(), Vec2::splat(16.0)), icon, ink);
    focus_ring(ui, &response, rect);
    response.on_hover_text(tooltip)
}

/// The frame that keyboard users follow.
fn focus_ring(ui: &Ui, response: &Response, rect: Rect) {
    if response.has_focus() {
        let stroke = Stroke::new(1.5, theme::colours(ui).accent);
        ui.painter().rect_stroke(rect.expand(1.5), theme::GRID, stroke, StrokeKind::Outside);
    }
}

/// What is too long for its place, with a bar beside it that is seen but does not shout: egui gives it the colour of text.
pub fn scroll(ui: &mut Ui, area: ScrollArea, content: impl FnOnce(&mut Ui)) {
    let bar = theme::colours(ui).weak.gamma_multiply(0.5);
    ui.scope(|ui| {
        let widgets = ui.visuals().widgets.clone();
        ui.visuals_mut().widgets.inactive.fg_stroke.color = bar;
        area.show(ui, |ui| {
            ui.visuals_mut().widgets = widgets;
            content(ui);
        });
    });
}

/// A heading and what belongs to it, with a line above; folded away by a click on the heading.
pub fn section(ui: &mut Ui, title: &str, open: bool, content: impl FnOnce(&mut Ui)) {
    foldable(ui, title, open, None, content);
}

/// The same, unfolded at first and whenever `unfold` says so.
pub fn section_opened(ui: &mut Ui, title: &str, unfold: Option<bool>, content: impl FnOnce(&mut Ui)) {
    foldable(ui, title, true, unfold, content);
}

/// Rows of a section that are seldom needed, folded away at first.
pub fn fold(ui: &mut Ui, title: &str, help: &str, content: impl FnOnce(&mut Ui)) {
    let words = RichText::new(title).color(theme::colours(ui).text);
    let header = egui::CollapsingHeader::new(words).id_salt(title).default_open(false).show_unindented(ui, content);
    header.header_response.on_hover_text(format!("{help} Click to fold or unfold."));
}

fn foldable(ui: &mut Ui, title: &str, open: bool, now: Option<bool>, content: impl FnOnce(&mut Ui)) {
    let line = ui.available_rect_before_wrap();
    ui.painter().hline(line.x_range(), line.top(), Stroke::new(1.0, theme::colours(ui).line));
    ui.add_space(theme::GRID);
    let heading = RichText::new(title).heading().color(theme::colours(ui).strong);
    let header = egui::CollapsingHeader::new(heading).id_salt(title).default_open(open).open(now);
    let header = header.show_unindented(ui, |ui| {
        // Rows are as high as they are far apart.
        ui.spacing_mut().item_spacing.y = 0.0;
        content(ui);
    });
    header.header_response.on_hover_text(format!("{title}: click to fold or unfold."));
    ui.add_space(2.0 * theme::GRID);
}

/// A paragraph in the colour of notes.
pub fn note(ui: &mut Ui, text: &str) {
    ui.add(Label::new(RichText::new(text).small().color(theme::colours(ui).weak)).wrap());
    ui.add_space(theme::GRID);
}
