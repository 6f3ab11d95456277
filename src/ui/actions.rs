//! Carries out the actions of the table in `app::keys`, whether they come from a key, a button or the palette of actions.

use super::shell::Shell;
use super::state::{Field, Finder, PlotTab};
use crate::app::keys::{self, Shortcut};
use crate::app::{Action, Camera, Command, Edit, Frame, pick};
use crate::engine::{DVec2, Id, Motion};
use egui::{Event, Key, Modifiers};

/// Slowest and fastest speed that the buttons and keys reach [simulated seconds a second].
pub const SPEEDS: [f64; 2] = [0.01, 10.0];
/// How far beside the original a duplicate lands [canvas points].
const DUPLICATE_OFFSET: f64 = 32.0;
/// Room beside what lies furthest out, as a factor.
const SIDE_MARGIN: f64 = 1.04;
/// Zoom of one press of a key.
const ZOOM: f64 = 1.25;

/// What an action needs besides the shell.
pub struct Scene<'a> {
    pub frame: &'a Frame,
    pub camera: &'a mut Camera,
    pub commands: &'a mut Vec<Command>,
    /// Set by the two actions that only the window can carry out.
    pub full_screen: &'a mut bool,
    pub quit: &'a mut bool,
}

impl Shell {
    /// Carries out an action.
    pub(super) fn act(&mut self, action: Action, scene: &mut Scene) {
        let frame = scene.frame;
        match action {
            Action::ToggleRun => scene.commands.push(Command::Run(!frame.running)),
            Action::StepOnce => scene.commands.push(Command::StepOnce),
            Action::Restart => scene.commands.push(Command::Restart),
            Action::Slower => scene.commands.push(Command::Speed(speed(frame.speed.wanted, 0.5))),
            Action::Faster => scene.commands.push(Command::Speed(speed(frame.speed.wanted, 2.0))),
            Action::SlowMotion => scene.commands.push(Command::Slow(!frame.speed.slow)),
            Action::Undo if frame.undo.is_some() => scene.commands.push(Command::Undo),
            Action::Redo if frame.redo.is_some() => scene.commands.push(Command::Redo),
            Action::Undo | Action::Redo => {}
            Action::NewScene => scene.commands.push(Command::New),
            Action::PreviousScene => scene.commands.extend(self.neighbour(frame, -1)),
            Action::NextScene => scene.commands.extend(self.neighbour(frame, 1)),
            Action::ZoomIn => scene.camera.zoom_at(scene.camera.size / 2.0, ZOOM),
            Action::ZoomOut => scene.camera.zoom_at(scene.camera.size / 2.0, 1.0 / ZOOM),
            Action::FitAll => fit_all(frame, scene.camera),
            Action::FitSelection => fit(frame, scene.camera, self.tools.selection()),
            Action::Duplicate | Action::Delete | Action::Pin | Action::SelectAll => {
                self.act_on_selection(action, scene)
            }
            Action::Tool(tool) => scene.commands.extend(self.tools.set_tool(tool)),
            Action::Toggle(what) => {
                let on = self.state.shown(what);
                *on = !*on;
            }
            Action::Lab => {
                (self.state.panels, self.state.plots, self.state.plot) = (true, true, PlotTab::Lab);
            }
            Action::ToggleTheme => self.state.theme = self.state.theme.other(),
            Action::FullScreen => *scene.full_screen = true,
            Action::Quit => *scene.quit = true,
            Action::Escape => self.escape(scene.commands),
            Action::OpenByName | Action::Save | Action::TogglePanels | Action::Palette | Action::Help => {
                self.act_on_window(action);
            }
        }
    }

    fn act_on_selection(&mut self, action: Action, scene: &mut Scene) {
        let selection = self.tools.selection().to_vec();
        let bodies = scene.frame.world.bodies();
        let edit = match action {
            Action::SelectAll => return self.tools.select(bodies.id.clone()),
            _ if selection.is_empty() => return,
            Action::Duplicate => {
                let offset = DUPLICATE_OFFSET / scene.camera.scale;
                Edit::Duplicate(selection, DVec2::new(offset, offset))
            }
            Action::Pin => {
                let chosen: Vec<Id> = selection.into_iter().filter(|id| bodies.index_of(*id).is_some()).collect();
                let free = chosen.iter().any(|id| is_free(scene.frame, *id));
                Edit::Pin(chosen, free)
            }
            _ => Edit::Delete(selection),
        };
        scene.commands.push(Command::Edit(edit));
    }

    fn act_on_window(&mut self, action: Action) {
        let state = &mut self.state;
        match action {
            Action::OpenByName => {
                state.panels = true;
                state.focus = Some(Field::SceneFilter);
            }
            Action::Save => {
                state.panels = true;
                state.focus = Some(Field::SavePath);
            }
            Action::TogglePanels => state.panels = !state.panels,
            Action::Palette => {
                state.finder = Some(Finder::default());
                state.focus = Some(Field::ActionQuery);
            }
            _ => state.help = !state.help,
        }
    }

    /// Gives up one thing: the palette, the help, what is typed to find a scene, then what the tool is about.
    fn escape(&mut self, commands: &mut Vec<Command>) {
        if self.state.finder.take().is_some() {
            self.state.focus = Some(Field::Canvas);
        } else if self.state.help {
            self.state.help = false;
        } else if !self.tools.busy() && !self.state.scene_filter.is_empty() {
            self.state.scene_filter.clear();
            self.state.focus = Some(Field::Canvas);
        } else {
            commands.extend(self.tools.escape());
        }
    }

    /// Opens the scene `by` places further in the list, round the end.
    fn neighbour(&self, frame: &Frame, by: isize) -> Option<Command> {
        let count = self.scenes.len() as isize;
        let here = self.scenes.iter().position(|scene| scene.name == frame.scene.name);
        let next = match here {
            Some(here) => (here as isize + by).rem_euclid(count),
            None if count > 0 => 0,
            None => return None,
        };
        Some(Command::Open(self.scenes[next as usize].name.to_owned()))
    }
}

/// Whether a body can be moved: what the pin action makes of a mixed selection.
pub fn is_free(frame: &Frame, id: Id) -> bool {
    frame.world.body(id).is_ok_and(|body| body.motion == Motion::Dynamic)
}

/// `wanted` times `factor`, within what the controls reach.
fn speed(wanted: f64, factor: f64) -> f64 {
    (wanted * factor).clamp(SPEEDS[0], SPEEDS[1])
}

/// Shows the scene's own view, or else everything.
pub fn fit_all(frame: &Frame, camera: &mut Camera) {
    match frame.scene.view {
        // A scene asks for a height. On a narrow canvas all that was there at its start must be seen too, the walls
        // included, unless it lies far out.
        Some((centre, height)) => {
            let far = frame.scene.bounds.map_or(0.0, |(min, max)| (centre.x - min.x).max(max.x - centre.x));
            let half = DVec2::new((SIDE_MARGIN * far).min(height), height / 2.0);
            camera.show(centre - half, centre + half);
        }
        None => fit(frame, camera, &[]),
    }
}

fn fit(frame: &Frame, camera: &mut Camera, ids: &[Id]) {
    if let Some((min, max)) = pick::bounds(&frame.world, ids) {
        camera.fit(min, max);
    }
}

/// The actions whose keys were pressed in this pass. While something else than the scene reads the keyboard (`typing`) only
/// those with Ctrl or a function key that no text field uses, and Escape.
///
/// Space pans while the pointer is dragged, so it runs or pauses when it is let go without that.
pub fn pressed(ui: &egui::Ui, typing: bool, space_panned: &mut bool) -> Vec<Action> {
    // Enter and Space press a button that was reached by Tab.
    let focused = ui.memory(|memory| memory.focused()).is_some() && !canvas_focused(ui);
    ui.input(|input| {
        if input.key_down(Key::Space) && input.pointer.any_down() {
            *space_panned = true;
        }
        let mut actions = Vec::new();
        for event in &input.events {
            let Event::Key { key, pressed, repeat, modifiers, .. } = event else { continue };
            let space = *key == Key::Space;
            if (space && focused) || *pressed == space || (*repeat && !repeats(*key)) {
                continue;
            }
            if space && std::mem::take(space_panned) {
                continue;
            }
            // That one lasts as long as its key is held: see `slow_motion_held`.
            let begins = |action: &Action| *action != Action::SlowMotion && (!typing || allowed_while_typing(*action));
            actions.extend(action_of(*key, *modifiers).filter(begins));
        }
        actions
    })
}

/// Whether the key of slow motion is held now.
pub fn slow_motion_held(ui: &egui::Ui) -> bool {
    let key = Action::SlowMotion.entry().shortcuts.first().and_then(|shortcut| Key::from_name(shortcut.key));
    ui.input(|input| !input.modifiers.command && key.is_some_and(|key| input.key_down(key)))
}

/// Whether the scene itself has the keyboard.
fn canvas_focused(ui: &egui::Ui) -> bool {
    ui.memory(|memory| memory.focused()) == Some(super::canvas::id())
}

fn repeats(key: Key) -> bool {
    matches!(key, Key::Period | Key::ArrowRight | Key::Minus | Key::Equals | Key::Plus | Key::Z | Key::Y)
}

fn allowed_while_typing(action: Action) -> bool {
    matches!(
        action,
        Action::OpenByName
            | Action::Save
            | Action::NewScene
            | Action::Palette
            | Action::Help
            | Action::FullScreen
            | Action::Quit
            | Action::Escape
    )
}

/// Whether a key begins something that changes what the next keys and clicks mean, so that they must wait until it is done.
pub fn turns(key: Key, modifiers: Modifiers) -> bool {
    match action_of(key, modifiers) {
        Some(
            Action::ToggleRun
            | Action::StepOnce
            | Action::Slower
            | Action::Faster
            | Action::SlowMotion
            | Action::ZoomIn
            | Action::ZoomOut
            | Action::FitAll
            | Action::FitSelection
            | Action::Undo
            | Action::Redo
            | Action::ToggleTheme
            | Action::Toggle(_),
        )
        | None => key == Key::Space,
        Some(_) => true,
    }
}

/// Whether a key begins an action even while a field reads the keyboard.
pub fn works_while_typing(key: Key, modifiers: Modifiers) -> bool {
    action_of(key, modifiers).is_some_and(allowed_while_typing)
}

fn action_of(key: Key, modifiers: Modifiers) -> Option<Action> {
    let fits = |shortcut: &Shortcut| {
        // "+" lies on another key's Shift on many keyboards.
        let shift = shortcut.shift == modifiers.shift || shortcut.key == "+";
        shift && shortcut.ctrl == modifiers.command && !modifiers.alt && Key::from_name(shortcut.key) == Some(key)
    };
    keys::ENTRIES.iter().find(|entry| entry.shortcuts.iter().any(fits)).map(|entry| entry.action)
}
