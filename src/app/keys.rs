//! Every action that a user can ask for by key, with its shortcut, its name and what it does: the one table behind the
//! keyboard, the help, the tooltips and the palette of actions.

use super::command::Spawn;
use super::tools::{Join, Tool};

/// Something that a key, a button or the palette of actions can ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Lets time run, or stops it.
    ToggleRun,
    /// Takes one step and pauses.
    StepOnce,
    /// Back to the start of the scene; the solver's settings stay.
    Restart,
    /// Halves the wanted speed, down to a hundredth of real time.
    Slower,
    /// Doubles the wanted speed, up to ten times real time.
    Faster,
    /// A tenth of the speed while the key is held; chosen by name, until it is chosen again.
    SlowMotion,
    /// Opens the scene before this one in the list.
    PreviousScene,
    /// Opens the scene after this one in the list.
    NextScene,
    /// Puts the keyboard into the field that finds scenes and opens files.
    OpenByName,
    /// Opens an empty scene.
    NewScene,
    /// Puts the keyboard into the field with the path to write to.
    Save,
    /// Shows a smaller part of the world.
    ZoomIn,
    /// Shows a larger part of the world.
    ZoomOut,
    /// Shows the scene's own view, or everything if it has none.
    FitAll,
    /// Shows what is selected, as large as it fits.
    FitSelection,
    /// Hides all panels at once, or shows them again.
    TogglePanels,
    /// Shows or hides the panel on the left.
    ToolsPanel,
    /// Shows or hides the panel on the right.
    SettingsPanel,
    /// Takes back the last edit, restart or opening.
    Undo,
    /// Does again what was undone last.
    Redo,
    /// Copies what is selected, a little to the side.
    Duplicate,
    /// Removes what is selected and what hangs on it.
    Delete,
    /// Fixes the selected bodies where they are, or frees them.
    Pin,
    /// Selects every body; constraints and walls are left out.
    SelectAll,
    /// Takes up a tool; what was going on is given up.
    Tool(Tool),
    /// Shows or hides something.
    Toggle(Shown),
    /// Opens the lab's panel.
    Lab,
    /// Light or dark.
    ToggleTheme,
    /// Opens the list in which actions and scenes are found by typing.
    Palette,
    /// Shows or hides the list of all shortcuts.
    Help,
    /// Fills the screen with the window, or gives it back.
    FullScreen,
    /// Closes the window.
    Quit,
    /// Gives up one thing: a dialog, what is going on, the tool, or the selection.
    Escape,
}

/// What the view can show or leave out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// Colours of rods, ropes and springs by their tension [N].
    Tension,
    /// Colours of moving bodies by their speed [m/s].
    Speed,
    /// An arrow for the velocity of every body [m/s].
    Velocities,
    /// Where bodies touch, and the normal force [N].
    Contacts,
    /// Where bodies were, fading.
    Trails,
    /// Lines at round distances, with units [m].
    Grid,
    /// Curves over time, at the bottom.
    Plots,
    /// The exact motion, drawn translucently with the simulation.
    Ghost,
    /// The same scene under another method, beside the simulation.
    Rival,
}

/// A key with the modifiers that must be held, and no others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shortcut {
    /// Whether Ctrl must be held, the command key on a Mac.
    pub ctrl: bool,
    /// Whether Shift must be held.
    pub shift: bool,
    /// Name of the key as in the W3C's key values where it has one there ("ArrowRight"), else the character it types.
    pub key: &'static str,
}

impl std::fmt::Display for Shortcut {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let key = match self.key {
            "ArrowRight" => "→",
            "Escape" => "Esc",
            // After a hyphen another one would not be seen.
            "-" if self.ctrl || self.shift => "Minus",
            "-" => "−",
            key => key,
        };
        write!(f, "{}{}{key}", if self.ctrl { "Ctrl-" } else { "" }, if self.shift { "Shift-" } else { "" })
    }
}

/// One line of the table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// What the line asks for; no two lines ask for the same.
    pub action: Action,
    /// The shortcuts, the one to show first.
    pub shortcuts: &'static [Shortcut],
    /// Two or three words, as in the help and the palette of actions.
    pub name: &'static str,
    /// One or two whole sentences: what it does.
    pub help: &'static str,
}

const fn key(key: &'static str) -> Shortcut {
    Shortcut { ctrl: false, shift: false, key }
}

const fn ctrl(key: &'static str) -> Shortcut {
    Shortcut { ctrl: true, shift: false, key }
}

const fn shift(key: &'static str) -> Shortcut {
    Shortcut { ctrl: false, shift: true, key }
}

const fn entry(action: Action, shortcuts: &'static [Shortcut], name: &'static str, help: &'static str) -> Entry {
    Entry { action, shortcuts, name, help }
}

/// The table, in the order of the help.
pub const ENTRIES: &[Entry] = &[
    entry(Action::ToggleRun, &[key("Space"), key("P")], "Run or pause", "Lets time run, or stops it."),
    entry(Action::StepOnce, &[key("."), key("ArrowRight")], "Step", "Takes one step of the simulation and pauses."),
    entry(
        Action::Restart,
        &[key("R")],
        "Restart",
        "Back to the start of the scene, with the solver's settings as they are. Can be undone.",
    ),
    entry(Action::Slower, &[key("-")], "Slower", "Halves the speed, down to a hundredth of real time."),
    entry(Action::Faster, &[key("="), key("+")], "Faster", "Doubles the speed, up to ten times real time."),
    entry(
        Action::SlowMotion,
        &[key("M")],
        "Slow motion",
        "A tenth of the speed while the key is held. Chosen by its name it stays so until it is chosen again.",
    ),
    entry(Action::PreviousScene, &[key("[")], "Previous scene", "Opens the scene before this one in the list."),
    entry(Action::NextScene, &[key("]")], "Next scene", "Opens the scene after this one in the list."),
    entry(Action::OpenByName, &[ctrl("O")], "Open…", "Opens a scene by its name, or a scene file by its path."),
    entry(
        Action::NewScene,
        &[ctrl("N")],
        "New scene",
        "Opens an empty scene to build in. The scene before it comes back by Undo.",
    ),
    entry(Action::Save, &[ctrl("S")], "Save as…", "Writes the scene as it stands to a file."),
    entry(Action::ZoomIn, &[ctrl("=")], "Zoom in", "Shows a smaller part of the world. The wheel zooms to the cursor."),
    entry(
        Action::ZoomOut,
        &[ctrl("-")],
        "Zoom out",
        "Shows a larger part of the world. The wheel zooms to the cursor.",
    ),
    entry(Action::FitAll, &[key("Home")], "Fit all", "Shows the scene's own view, or everything."),
    entry(Action::FitSelection, &[key("F")], "Fit selection", "Shows what is selected, as large as it fits."),
    entry(Action::TogglePanels, &[key("Tab")], "Hide panels", "Hides the panels, or shows them again."),
    entry(Action::ToolsPanel, &[key("T")], "Tools and scenes", "Shows or hides the panel on the left."),
    entry(Action::SettingsPanel, &[key("I")], "Settings", "Shows or hides the panel on the right."),
    entry(Action::Undo, &[ctrl("Z")], "Undo", "Takes back the last edit, restart or opening."),
    entry(Action::Redo, &[ctrl("Y"), Shortcut { shift: true, ..ctrl("Z") }], "Redo", "Does again what was undone."),
    entry(Action::Duplicate, &[ctrl("D")], "Duplicate", "Copies what is selected."),
    entry(
        Action::Delete,
        &[key("Delete"), key("Backspace")],
        "Delete",
        "Removes what is selected and what hangs on it.",
    ),
    entry(Action::Pin, &[key("N")], "Pin or unpin", "Fixes the selected bodies where they are, or frees them."),
    entry(Action::SelectAll, &[ctrl("A")], "Select all", "Selects every body."),
    entry(
        Action::Tool(Tool::Drag),
        &[key("V")],
        "Drag",
        "Drag a body by the point you take hold of, and throw it. A click selects.",
    ),
    entry(Action::Tool(Tool::Select), &[key("S")], "Select", "Select by click, or with a box; Shift adds."),
    entry(Action::Tool(Tool::Cut), &[key("C")], "Cut", "A slash cuts every rod, spring, rope and pin that it crosses."),
    entry(
        Action::Tool(Tool::Join(Join::Rod)),
        &[key("J")],
        "Join with a rod",
        "Drag from body to body, or to a free point: the distance stays. Between free points a new particle hangs.",
    ),
    entry(
        Action::Tool(Tool::Join(Join::Spring)),
        &[key("K")],
        "Join with a spring",
        "Drag from body to body, or to a free point: a spring at rest.",
    ),
    entry(
        Action::Tool(Tool::Join(Join::Rope)),
        &[key("L")],
        "Join with a rope",
        "Drag from body to body, or to a free point: the distance does not grow.",
    ),
    entry(Action::Tool(Tool::Wall), &[key("W")], "Wall", "Draw a wall. Shift turns it in steps of 15°."),
    entry(
        Action::Tool(Tool::Spawn(Spawn::Particle)),
        &[key("1")],
        "Particle",
        "Click: a particle, which does not turn.",
    ),
    entry(Action::Tool(Tool::Spawn(Spawn::Disc)), &[key("2")], "Disc", "Click: a disc that turns and rolls."),
    entry(Action::Tool(Tool::Spawn(Spawn::Rod)), &[key("3")], "Rod", "Click: two particles joined by a rod."),
    entry(Action::Tool(Tool::Spawn(Spawn::Spring)), &[key("4")], "Spring", "Click: two particles joined by a spring."),
    entry(
        Action::Tool(Tool::Spawn(Spawn::Rope)),
        &[key("5")],
        "Rope",
        "Click: a chain of rods, its first particle pinned.",
    ),
    entry(
        Action::Tool(Tool::Spawn(Spawn::Cloth)),
        &[key("6")],
        "Cloth",
        "Click: a net of springs, two corners pinned.",
    ),
    entry(Action::Tool(Tool::Spawn(Spawn::Pile)), &[key("7")], "Pile", "Click: a block of discs that falls apart."),
    entry(
        Action::Toggle(Shown::Tension),
        &[shift("T")],
        "Tension",
        "Colours rods, ropes and springs by their tension [N].",
    ),
    entry(Action::Toggle(Shown::Speed), &[shift("S")], "Speed", "Colours moving bodies by their speed [m/s]."),
    entry(
        Action::Toggle(Shown::Velocities),
        &[shift("V")],
        "Velocities",
        "An arrow for the velocity of every body [m/s].",
    ),
    entry(Action::Toggle(Shown::Contacts), &[shift("C")], "Contacts", "Where bodies touch, and the normal force [N]."),
    entry(Action::Toggle(Shown::Trails), &[shift("L")], "Trails", "Where bodies were, fading."),
    entry(Action::Toggle(Shown::Grid), &[shift("G")], "Grid", "Lines at round distances, with units [m]."),
    entry(Action::Toggle(Shown::Plots), &[shift("P")], "Plots", "Energy, error and step time at the bottom."),
    entry(
        Action::Toggle(Shown::Ghost),
        &[shift("H")],
        "Ghost",
        "The exact motion drawn translucently with the simulation, and how far the simulation is from it.",
    ),
    entry(
        Action::Toggle(Shown::Rival),
        &[shift("B")],
        "A | B",
        "The same scene and the same inputs under another method, side by side.",
    ),
    entry(
        Action::Lab,
        &[ctrl("L")],
        "Lab",
        "Error over cost of every method on this scene, measured in the background.",
    ),
    entry(Action::ToggleTheme, &[shift("D")], "Theme", "Changes between dark and light."),
    entry(Action::Palette, &[ctrl("K")], "Find an action", "Lists every action with its shortcut; type to find one."),
    entry(Action::Help, &[key("F1")], "Help", "Lists every action with its shortcut."),
    entry(Action::FullScreen, &[key("F11")], "Full screen", "Fills the screen with the window, or gives it back."),
    entry(Action::Quit, &[ctrl("Q")], "Quit", "Closes the window."),
    entry(
        Action::Escape,
        &[key("Escape")],
        "Cancel",
        "Gives up what is going on: a slash, a dialog, the selection, the tool.",
    ),
];

impl Action {
    /// The action's line in the table.
    pub fn entry(self) -> &'static Entry {
        ENTRIES.iter().find(|entry| entry.action == self).expect("a test looks up every action in the table")
    }

    /// Name, help and shortcut for a tooltip.
    pub fn tooltip(self) -> String {
        let entry = self.entry();
        match entry.shortcuts.first() {
            Some(shortcut) => format!("{} [{shortcut}]", entry.help),
            None => entry.help.to_owned(),
        }
    }
}
