//! The shell: every panel in its place around the canvas, in one pass over an immutable frame.

use super::actions::{self, Scene};
use super::finder::Found;
use super::overlay::Ranges;
use super::plots::Plots;
use super::settings::Defaults;
use super::state::{Field, PlotTab, State};
use super::theme::{self, Theme};
use super::turns::{Reader, Turns};
use super::{
    canvas, companions, fault, finder, help, inspector, overlay, palette, scenes, settings, status, transport, view,
    widgets,
};
use crate::app::{Action, Camera, Command, Feedback, Frame, Spawn, Tools};
use crate::engine::{DVec2, Id, Method};
use crate::render::{Extra, ViewOptions};
use crate::scene::{Shipped, every_scene};
use egui::{CentralPanel, Margin, Panel, Rect, ScrollArea, Ui};
use std::sync::Arc;

/// Narrower plots would only be legends [points].
const NARROWEST_PLOT: f32 = 320.0;

/// A field that was not drawn within so many passes has no place in this window.
const MOST_AWAITED: u32 = 60;

/// Everything that the window shows around the scene.
#[derive(Default)]
pub struct Shell {
    pub(super) scenes: &'static [Shipped],
    pub(super) tools: Tools,
    pub(super) state: State,
    defaults: Defaults,
    plots: Plots,
    /// Opening of the scene that the tools belong to.
    opened: u64,
    /// Opening of the scene that the view was fitted to.
    fitted: Option<u64>,
    /// The theme that the context was last given.
    applied: Option<Theme>,
    /// Space moved the view while it was held.
    space_panned: bool,
    /// What the last edit had touched when something was placed; what is new is selected when it appears.
    placed: Option<Arc<Vec<Id>>>,
    /// What the simulation was last asked for beside itself: the truth, and a rival under this method.
    asked: (bool, Option<Method>),
    /// Whether there were two panes in the last pass.
    split: bool,
    /// Who reads the keyboard in this pass, and what had it at the end of the last one.
    reader: Reader,
    focused: Option<egui::Id>,
    /// For how many passes an opened field has not been drawn.
    awaited: u32,
    note: fault::Shown,
    /// The key of slow motion is held.
    slow: bool,
}

/// What came of a pass.
#[derive(Clone, Debug)]
pub struct ShellOutput {
    /// For the simulation thread, in order.
    pub commands: Vec<Command>,
    /// Where the scene lies [points of the screen].
    pub canvas: Rect,
    /// Where its rival lies, if there is one; as large as the canvas and seen by the same camera.
    pub rival: Option<Rect>,
    /// What the picture is to show.
    pub view: ViewOptions,
    /// The window is to fill the screen, or to give it back.
    pub full_screen: bool,
    /// The window is to close.
    pub quit: bool,
}

impl Shell {
    /// A shell that lists the shipped scenes.
    pub fn new() -> Shell {
        Shell { scenes: every_scene(), ..Shell::default() }
    }

    /// Gives `ctx` the fonts and the theme. [`Shell::show`] does so too, but then the first pass is still laid out with
    /// egui's own style.
    pub fn prepare(&mut self, ctx: &egui::Context) {
        if self.applied.is_none() {
            theme::install(ctx);
            ctx.add_plugin(Turns::default());
        }
        if self.applied != Some(self.state.theme) {
            theme::apply(ctx, self.state.theme);
            self.applied = Some(self.state.theme);
            ctx.request_repaint();
        }
    }

    /// The tools of the canvas: what is selected, hovered, held.
    pub fn tools(&self) -> &Tools {
        &self.tools
    }

    /// What the user set in the window itself.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// What the user sets in the window itself, for a window that starts otherwise.
    pub fn state_mut(&mut self) -> &mut State {
        &mut self.state
    }

    /// Selects these things and nothing else.
    pub fn select(&mut self, ids: Vec<Id>) {
        self.tools.select(ids);
    }

    /// Shows everything into the root `ui` and carries out what the user asks for. `ranges` are those of the picture.
    pub fn show(&mut self, ui: &mut Ui, frame: &Arc<Frame>, camera: &mut Camera, ranges: Ranges) -> ShellOutput {
        self.prepare(ui.ctx());
        self.follow(frame);
        let mut commands = Vec::new();
        self.ask(&mut commands);
        let typing = self.reader != Reader::Scene || self.state.help || ui.ctx().text_edit_focused();
        let mut actions = actions::pressed(ui, typing, &mut self.space_panned);
        let slow = !typing && actions::slow_motion_held(ui);
        if std::mem::replace(&mut self.slow, slow) != slow {
            commands.push(Command::Slow(slow));
        }
        if self.state.panels {
            self.panels(ui, frame, &mut actions, &mut commands);
        }
        let canvas = CentralPanel::no_frame().show(ui, |ui| self.canvas(ui, frame, camera, ranges, &mut actions)).inner;
        commands.extend(canvas.commands);
        fault::show(ui, frame, canvas.rect, &mut actions, &mut commands);
        fault::show_note(ui, frame, canvas.rect, &mut self.note, &mut commands);
        self.dialogs(ui, &mut actions, &mut commands);
        let (mut full_screen, mut quit) = (false, false);
        for action in actions {
            let scene =
                &mut Scene { frame, camera, commands: &mut commands, full_screen: &mut full_screen, quit: &mut quit };
            self.act(action, scene);
        }
        self.note_placed(frame, &commands);
        self.prepare(ui.ctx());
        self.give_turn(ui.ctx());
        let view = self.view_options(camera);
        ShellOutput { commands, canvas: canvas.rect, rival: canvas.rival, view, full_screen, quit }
    }

    /// Settles who reads the keyboard next.
    fn give_turn(&mut self, ctx: &egui::Context) {
        let focused = ctx.memory(|memory| memory.focused());
        let before = std::mem::replace(&mut self.focused, focused);
        let opened = self.state.focus.is_some_and(|field| field != Field::Canvas);
        self.awaited = if opened { self.awaited + 1 } else { 0 };
        if self.awaited > MOST_AWAITED {
            self.state.focus = None;
        }
        self.reader = if opened {
            Reader::Awaited
        } else if self.state.focus == Some(Field::Canvas) {
            ctx.memory_mut(|memory| memory.request_focus(canvas::id()));
            Reader::Scene
        } else if ctx.text_edit_focused() || self.state.finder.is_some() {
            Reader::Field
        } else if focused.is_some() && focused != before && focused != Some(canvas::id()) {
            // It may be a number that becomes a field when it is drawn with the keyboard.
            Reader::Awaited
        } else {
            Reader::Scene
        };
        let waiting = ctx.with_plugin(|turns: &mut Turns| {
            turns.reader = self.reader;
            turns.waiting()
        });
        if waiting == Some(true) || self.reader == Reader::Awaited {
            ctx.request_repaint();
        }
    }

    /// Asks the simulation for what is wanted beside it, if that is something else than before.
    fn ask(&mut self, commands: &mut Vec<Command>) {
        let (truth, rival) = (self.state.view.ghost, self.state.rival_method.filter(|_| self.state.rival));
        if self.asked.0 != truth {
            commands.push(Command::Truth(truth));
        }
        if self.asked.1 != rival {
            commands.push(Command::Rival(rival));
        }
        self.asked = (truth, rival);
    }

    fn follow(&mut self, frame: &Arc<Frame>) {
        self.defaults.follow(frame);
        if self.state.rival && self.state.rival_method.is_none() {
            self.state.rival_method = Some(companions::first_method(&frame.method));
        }
        if let Some(verdict) = &frame.trial {
            let known = self.state.verdicts.get(&frame.scene.name);
            if known.is_none_or(|known| !Arc::ptr_eq(known, verdict)) {
                self.state.verdicts.insert(frame.scene.name.clone(), verdict.clone());
            }
        }
        if self.opened != frame.scene.opened {
            self.opened = frame.scene.opened;
            self.tools.forget();
            self.placed = None;
        }
        if let Some(before) = &self.placed
            && !Arc::ptr_eq(before, &frame.touched)
        {
            self.tools.select(frame.touched.to_vec());
            self.placed = None;
        }
        self.tools.follow(&frame.world);
    }

    fn note_placed(&mut self, frame: &Frame, commands: &[Command]) {
        if commands.iter().any(|command| matches!(command, Command::Edit(edit) if edit.places())) {
            self.placed = Some(frame.touched.clone());
        }
    }

    fn panels(&mut self, ui: &mut Ui, frame: &Frame, actions: &mut Vec<Action>, commands: &mut Vec<Command>) {
        let colours = self.state.theme.colours();
        let plate = |horizontal: i8, vertical: i8| {
            egui::Frame::NONE.fill(colours.panel).inner_margin(Margin::symmetric(horizontal, vertical))
        };
        Panel::top("transport").exact_size(theme::TOP_BAR).frame(plate(12, 0)).show(ui, |ui| {
            transport::show(ui, frame, &mut self.state.theme, actions, commands);
        });
        Panel::bottom("status")
            .exact_size(theme::ROW + theme::GRID)
            .frame(plate(12, 0))
            .show(ui, |ui| status::show(ui, frame, self.tools.selection()));
        Panel::left("tools").default_size(216.0).size_range(180.0..=360.0).frame(plate(12, 8)).show(ui, |ui| {
            widgets::scroll(ui, ScrollArea::vertical().auto_shrink(false), |ui| {
                palette::show(ui, self.tools.tool(), actions);
                scenes::show(ui, frame, self.scenes, &mut self.state, commands);
            });
        });
        Panel::right("settings").default_size(304.0).size_range(272.0..=480.0).frame(plate(12, 8)).show(ui, |ui| {
            widgets::scroll(ui, ScrollArea::vertical().auto_shrink(false), |ui| {
                inspector::show(ui, frame, self.tools.selection(), commands);
                settings::show(ui, frame, &self.defaults, commands);
                companions::rival_section(ui, frame, &mut self.state);
                view::show(ui, frame, &mut self.state);
            });
        });
        if self.state.plots && ui.available_width() >= NARROWEST_PLOT {
            // The lab's diagram wants more room than a curve.
            let (id, height) = if self.state.plot == PlotTab::Lab { ("lab", 320.0) } else { ("plots", 176.0) };
            Panel::bottom(id).resizable(true).default_size(height).size_range(112.0..=480.0).frame(plate(12, 8)).show(
                ui,
                |ui| {
                    self.plots.show(ui, frame, &mut self.state, commands);
                },
            );
        }
    }

    fn canvas(
        &mut self,
        ui: &mut Ui,
        frame: &Frame,
        camera: &mut Camera,
        ranges: Ranges,
        actions: &mut Vec<Action>,
    ) -> CanvasOutput {
        let (rect, rival) = canvas::room(ui, self.state.rival);
        let response = canvas::allocate(ui, rect);
        if self.state.takes_focus(Field::Canvas) {
            response.request_focus();
        }
        camera.size = DVec2::new(f64::from(rect.width()), f64::from(rect.height()));
        if self.fitted != Some(frame.scene.opened) {
            self.fitted = Some(frame.scene.opened);
            actions::fit_all(frame, camera);
        } else if self.split != rival.is_some() {
            // Each pane shows what the whole canvas did.
            camera.scale *= if rival.is_some() { 0.5 } else { 2.0 };
        }
        self.split = rival.is_some();
        if let Some(rival) = rival {
            canvas::follow(ui, rival, camera);
        }
        let commands = canvas::handle(ui, &response, &mut self.tools, frame, camera);
        canvas::context_menu(&response, &mut self.tools, frame, camera, actions);
        canvas::decorate(ui, &response, &self.tools);
        let overlay = self.state.overlay(frame, camera, ranges);
        overlay.paint(ui, rect);
        if frame.world.bodies().is_empty() && frame.world.walls().is_empty() {
            overlay::hint(ui, rect);
        }
        let hovered = self.tools.hovered().filter(|_| !self.tools.busy());
        overlay.selection_label(ui, rect, self.tools.selection(), hovered);
        overlay.read_out(ui, rect, hovered, response.hover_pos());
        if let (Some(beside), Some(companion)) = (rival, &frame.companions.rival) {
            overlay.panes(ui, [rect, beside], &companion.report());
        }
        CanvasOutput { rect, rival, commands }
    }

    fn dialogs(&mut self, ui: &Ui, actions: &mut Vec<Action>, commands: &mut Vec<Command>) {
        if self.state.help && help::show(ui.ctx()) {
            self.state.help = false;
        }
        match finder::show(ui.ctx(), self.scenes, &mut self.state) {
            Some(Found::Action(action)) => actions.push(action),
            Some(Found::Scene(name)) => commands.push(Command::Open(name)),
            None => {}
        }
    }

    fn view_options(&self, camera: &Camera) -> ViewOptions {
        let view = self.state.view;
        ViewOptions {
            theme: self.state.theme.scene(),
            grid: view.grid,
            contacts: view.contacts,
            velocities: view.velocities,
            trails: view.trails,
            tension: view.tension,
            speed: view.speed,
            ghost: view.ghost,
            selected: self.tools.selection().to_vec(),
            hovered: self.tools.hovered(),
            grip_cursor: None,
            extra: extras(self.tools.feedback(camera)),
        }
    }
}

struct CanvasOutput {
    rect: Rect,
    rival: Option<Rect>,
    commands: Vec<Command>,
}

/// The marks of the tool at work.
fn extras(feedback: Feedback) -> Vec<Extra> {
    match feedback {
        Feedback::None | Feedback::Grip => Vec::new(),
        Feedback::SelectionBox(min, max) => {
            let corners = [min, DVec2::new(max.x, min.y), max, DVec2::new(min.x, max.y)];
            (0..4).map(|i| Extra::Line { from: corners[i], to: corners[(i + 1) % 4] }).collect()
        }
        Feedback::Slash(from, to) => vec![Extra::Cut { from, to }],
        Feedback::Join { from, to, .. } => vec![Extra::Line { from, to }, Extra::Snap { at: to }],
        Feedback::Wall(from, to) => vec![Extra::Line { from, to }, Extra::Snap { at: to }],
        Feedback::Ghost { kind, at, size } => ghost(kind, at, size),
    }
}

/// What is about to be added: its first body, and a second one where there are just two.
fn ghost(kind: Spawn, at: DVec2, size: f64) -> Vec<Extra> {
    let disc = |centre| Extra::Disc { centre, radius: size };
    match kind {
        Spawn::Particle | Spawn::Disc => vec![disc(at)],
        Spawn::Rod | Spawn::Spring | Spawn::Rope | Spawn::Cloth | Spawn::Pile => vec![disc(at), Extra::Snap { at }],
    }
}
