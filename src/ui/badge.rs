//! The badge of a scene that tries the engine: what its pass is, what the value is so far, and how it stands.

use super::format::{digits, minus, round_si, si};
use super::{theme, widgets};
use crate::scene::Limit;
use crate::trial::{Line, State, Verdict};
use egui::{Pos2, Stroke, Ui, vec2};

/// "joint gap < 1 mm".
pub fn limit_text(limit: &Limit) -> String {
    if let Limit::Redundant(least) = limit {
        return format!("all {least} redundant rows reported");
    }
    if let Limit::Moving(most) = limit {
        return format!("at most {most} moving at the end");
    }
    format!("{} < {}", limit.name(), quantity(limit.bound(), limit.unit(), round_si))
}

/// A value with its unit; a part of something as a power of ten.
fn quantity(value: f64, unit: &str, with_unit: fn(f64, &str) -> String) -> String {
    match (unit, value) {
        ("", 0.0) => "0".into(),
        ("", value) if value.abs() < 1e-2 => minus(format!("{value:.0e}")),
        ("", value) => digits(value),
        (unit, value) => with_unit(value, unit),
    }
}

fn value_text(line: &Line) -> String {
    if line.value.is_nan() {
        return "not known".into();
    }
    match line.limit {
        Limit::Redundant(_) | Limit::Moving(_) => digits(line.value),
        limit => quantity(line.value, limit.unit(), si),
    }
}

/// "joint gap < 1 mm: 3.10 nm so far".
fn line_text(line: &Line) -> String {
    let kept = if line.is_kept() { "" } else { ", too much" };
    format!("{}: {} so far{kept}", limit_text(&line.limit), value_text(line))
}

/// How the trial stands: "not yet, 4.2 of 10 s", "passed".
pub fn state_text(verdict: &Verdict) -> String {
    match verdict.state {
        State::Running => format!("{}, {:.1} of {} s", verdict.state.name(), verdict.time, verdict.seconds),
        state => state.name().to_owned(),
    }
}

/// The whole of it, for a tooltip and a screen reader.
pub fn summary(verdict: &Verdict) -> String {
    let lines: Vec<String> = verdict.lines.iter().map(line_text).collect();
    format!("Pass: {}. {}.", state_text(verdict), lines.join("; "))
}

/// What a pass asks for, of a scene that has not been run.
pub fn wanted(pass: &crate::scene::Pass) -> String {
    let limits: Vec<String> = pass.limits.iter().map(limit_text).collect();
    format!("Pass, not tried: {} for {} s, as it opens.", limits.join(" and "), pass.seconds)
}

/// Width of the mark with its room [points].
pub const WIDTH: f32 = 16.0;

/// Paints the mark beside an entry: a ring while untried, filled while it runs, a tick or a cross. The entry's tooltip says the
/// same in words.
pub fn paint(ui: &Ui, at: Pos2, state: Option<State>) {
    let (colours, painter) = (theme::colours(ui), ui.painter());
    match state {
        None => drop(painter.circle_stroke(at, 4.0, Stroke::new(1.0, colours.weak))),
        Some(State::Running) => drop(painter.circle_filled(at, 4.0, colours.accent)),
        Some(State::Void) => drop(painter.circle_filled(at, 2.0, colours.weak)),
        Some(State::Passed) => {
            let points = [vec2(-4.5, 0.0), vec2(-1.5, 3.5), vec2(4.5, -4.0)].map(|offset| at + offset);
            painter.line(points.to_vec(), Stroke::new(2.0, colours.good));
        }
        Some(State::Failed) => {
            let stroke = Stroke::new(2.0, colours.error);
            painter.line_segment([at + vec2(-3.5, -3.5), at + vec2(3.5, 3.5)], stroke);
            painter.line_segment([at + vec2(-3.5, 3.5), at + vec2(3.5, -3.5)], stroke);
        }
    }
}

/// Below the entry of the scene that is open: a line for each limit, and how the trial stands.
pub fn details(ui: &mut Ui, verdict: &Verdict) {
    for line in &verdict.lines {
        widgets::note(ui, &line_text(line));
    }
    widgets::note(ui, &format!("Pass: {}", state_text(verdict)));
}
