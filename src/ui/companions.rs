//! The worlds that follow the simulation, in words: how far it is from the truth, and from the same scene under another
//! method; and the section "A | B" where that method is chosen.

use super::settings::{integrator_help, solver_help};
use super::state::State;
use super::widgets::{self, Number};
use super::{format, theme};
use crate::app::companion::{Gap, Report, Standing};
use crate::app::keys::Shown;
use crate::app::{Action, Companion, Frame};
use crate::engine::{Integrator, Method, Solver};
use crate::measure::Uncertain;
use egui::{Color32, Ui};

/// How many steps a companion may be behind without a word.
const UNSEEN: f64 = 3.0;

/// A part of something, in percent: "0.0131 %".
pub fn percent(part: f64) -> String {
    format!("{} %", format::digits(100.0 * part))
}

/// A power of ten that is certain: "3e−12"; what lies below the rounding of a double is zero to it.
fn power(part: f64) -> String {
    if part == 0.0 { "0".into() } else { format::minus(format!("{part:.0e}")) }
}

/// "1.302 ± 0.002 mm RMS (0.013 %), 3.10 mm max (0.031 %)".
pub fn gap_text(gap: &Gap, length: f64) -> String {
    let rms = format::with_error(gap.rms, gap.uncertainty, "m");
    let max = format::si(gap.max, "m");
    format!("{rms} RMS ({}), {max} max ({})", percent(gap.rms / length), percent(gap.max / length))
}

/// ", 0.4 s behind", where that is more than a few steps.
fn behind(frame: &Frame, report: &Report) -> String {
    let behind = frame.world.time() - report.time;
    if behind * frame.method.hz > UNSEEN { format!(", {behind:.1} s behind") } else { String::new() }
}

/// The item of the status bar: text, colour, tooltip.
pub fn status(frame: &Frame, companion: &Companion, colours: &theme::Colours) -> (String, Color32, String) {
    let report = companion.report();
    let late = behind(frame, &report);
    let (text, colour) = match (&report.standing, &report.gap) {
        (Standing::Waiting, _) => ("…".into(), colours.weak),
        (Standing::Parted { after, chaotic }, _) => {
            (format!("unknown: {} after {after:.2} s", why_parted(*chaotic)), colours.warning)
        }
        (Standing::Over { after, touched: true }, _) => (format!("not known: changed at {after:.2} s"), colours.weak),
        (Standing::Over { after, touched: false }, _) => {
            (format!("{} RMS over its {after:.2} s", format::si(report.so_far, "m")), colours.text)
        }
        (Standing::Lost(_), _) => ("given up".into(), colours.warning),
        (_, Some(gap)) => (gap_text(gap, report.length) + &late, colours.text),
        (_, None) => ("no sample at this rate".into(), colours.weak),
    };
    let since = format!("since {:.2} s", report.since);
    let so_far = format::si(report.so_far, "m");
    let tooltip = format!(
        "{} Root mean square over all bodies at this instant and the largest distance, in metres and percent of the scene's \
         length of {}; over all samples {since}: {so_far}.",
        standing(&report),
        format::si(report.length, "m")
    );
    (text, colour, tooltip)
}

fn why_parted(chaotic: bool) -> &'static str {
    if chaotic { "chaotic" } else { "not converged" }
}

/// What a companion is worth, in a sentence or two.
fn standing(report: &Report) -> String {
    match &report.standing {
        Standing::Waiting => "It starts.".into(),
        Standing::Exact { error } => format!("The truth is known, to {} of the length.", power(*error)),
        Standing::Converged { to } => format!(
            "The most accurate method and a coarser one, from the same start and with the same inputs: converged to {} of the \
             length.",
            power(*to)
        ),
        Standing::Parted { after, chaotic } => format!(
            "No reference: {} after {after:.2} s. There a fine and a coarser run have parted by a thousandth of the length, so \
             neither is the truth. Restart for a new one.",
            why_parted(*chaotic)
        ),
        Standing::Over { touched: true, .. } => {
            "The motion of this scene is known, but it was changed. Ghost [Shift-H] computes the exact motion from now on.".into()
        }
        Standing::Over { after, .. } => {
            format!("The motion is known for {after:.2} s. Ghost [Shift-H] computes it from now on.")
        }
        Standing::Following => "The same scene and the same inputs under the other method.".into(),
        Standing::Lost(why) => format!("Given up at {:.2} s: {why}.", report.time),
    }
}

/// The note below the switch "Ghost".
pub fn truth_note(frame: &Frame) -> String {
    match &frame.companions.truth {
        Some(truth) => {
            let report = truth.report();
            standing(&report) + behind(frame, &report).trim_start_matches(',')
        }
        None => standing(&Report::default()),
    }
}

/// A body's position and what it may be off by, where the truth is known: "x 1.302 ± 0.002 m, y −441 ± 2 mm".
pub fn position(frame: &Frame, body: usize) -> Option<String> {
    let report = frame.companions.truth.as_ref()?.report();
    let offsets = &report.offsets;
    if *offsets.bodies != frame.world.bodies().id {
        return None;
    }
    let error = Some(offsets.shift[body].length() + report.gap.as_ref().map_or(0.0, |gap| gap.uncertainty));
    let at = frame.world.bodies().position[body];
    let [x, y] = [at.x, at.y].map(|value| Uncertain { value, error }.shown("m"));
    Some(format!("x {x}, y {y}"))
}

const ACCURACY: Number = Number {
    name: "B accuracy",
    unit: "",
    range: 1e-14..=1e-2,
    help: "Wanted error of B after a second or so, in parts of an island's size.",
    logarithmic: true,
    decimals: 0,
};

const SUBSTEPS: Number = Number {
    name: "B substeps",
    unit: "",
    range: 1.0..=64.0,
    help: "Parts that a step of B is cut into.",
    logarithmic: true,
    decimals: 0,
};

const ITERATIONS: Number = Number {
    name: "B iterations",
    unit: "",
    range: 1.0..=1000.0,
    help: "Sweeps of B's solver over all constraints and contacts in a substep.",
    logarithmic: true,
    decimals: 0,
};

/// The method that B begins with: the other way from A's, by hand or by accuracy.
pub fn first_method(own: &Method) -> Method {
    Method { automatic: !own.automatic, accuracy: own.accuracy.min(1e-9), ..*own }
}

/// The section "A | B".
pub fn rival_section(ui: &mut Ui, frame: &Frame, state: &mut State) {
    widgets::section(ui, "A | B", true, |ui| {
        let action = Action::Toggle(Shown::Rival);
        widgets::switch(ui, "Side by side", &mut state.rival, Some(false), &action.tooltip());
        if !state.rival {
            return;
        }
        let first = first_method(&frame.method);
        let method = state.rival_method.get_or_insert(first);
        choose(ui, method, &first);
        let Some(rival) = &frame.companions.rival else { return };
        let report = rival.report();
        if let Some(frame) = report.frame.as_ref().filter(|frame| !frame.plan.is_empty()) {
            widgets::note(ui, &format!("B: {}", frame.plan));
        }
        if let Some(gap) = &report.gap {
            widgets::note(ui, &format!("Apart: {}.", gap_text(gap, report.length)));
        }
        if matches!(report.standing, Standing::Lost(_)) {
            widgets::note(ui, &standing(&report));
        }
        widgets::note(ui, &parting_text(&report));
    });
}

/// When the two could first be told apart.
pub fn parting_text(report: &Report) -> String {
    match &report.parting {
        Some(parting) => {
            format!("Seen to part at {:.2} s: body {} by a hundredth of the length.", parting.time, parting.body)
        }
        None => format!("Not seen to part since {:.2} s. Restart to compare from the start.", report.since),
    }
}

fn choose(ui: &mut Ui, method: &mut Method, first: &Method) {
    let help = "B's plan chooses how islands that nothing can touch are carried, for the accuracy wanted.";
    widgets::switch(ui, "B by accuracy", &mut method.automatic, Some(first.automatic), help);
    if method.automatic || method.integrator.is_direct() {
        widgets::slider(ui, &ACCURACY, &mut method.accuracy, Some(first.accuracy));
    }
    if method.automatic {
        let help = "How B steps what its plan does not carry whole.";
        widgets::fold(ui, "B by hand", help, |ui| choose_by_hand(ui, method, first));
    } else {
        choose_by_hand(ui, method, first);
    }
}

fn choose_by_hand(ui: &mut Ui, method: &mut Method, first: &Method) {
    widgets::whole_slider(ui, &SUBSTEPS, &mut method.substeps, Some(first.substeps));
    widgets::whole_slider(ui, &ITERATIONS, &mut method.iterations, Some(first.iterations));
    let integrators = Integrator::ALL.map(|kind| (kind, kind.name(), integrator_help(kind)));
    let help = "How B carries positions and velocities through a substep.";
    widgets::choice(ui, "B integrator", &mut method.integrator, Some(first.integrator), &integrators, help);
    let solvers = Solver::ALL.map(|kind| (kind, kind.name(), solver_help(kind)));
    let help = "How B solves constraints and contacts within a substep.";
    widgets::choice(ui, "B solver", &mut method.solver, Some(first.solver), &solvers, help);
}

/// A method in a few words, for the label of a pane: "by accuracy, 1e−9", "RATTLE, 4 substeps".
pub fn method_text(method: &Method) -> String {
    if method.automatic {
        return format!("by accuracy, {}", power(method.accuracy));
    }
    if method.integrator == Integrator::Taylor {
        return format!("{}, {}", method.integrator.name(), power(method.accuracy));
    }
    let substeps = if method.substeps == 1 { "1 substep".into() } else { format!("{} substeps", method.substeps) };
    if method.integrator.is_direct() {
        return format!("{}, {substeps}", method.integrator.name());
    }
    format!("{}, {}, {substeps} × {}", method.integrator.name(), method.solver.name(), method.iterations)
}
