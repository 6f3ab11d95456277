//! What a user sets in the window itself: theme, panels, what is drawn, what is typed. None of it touches the simulation.

use super::known::Known;
use super::lab::Wanted;
use super::theme::Theme;
use crate::app::keys::Shown;
use crate::engine::Method;
use crate::trial::Verdict;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

/// What the picture shows besides the bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct View {
    /// Where bodies touch, and the normal force [N].
    pub contacts: bool,
    /// An arrow for the velocity of every body [m/s].
    pub velocities: bool,
    /// Where bodies were, fading.
    pub trails: bool,
    /// Moving bodies coloured by their speed.
    pub speed: bool,
    /// Rods and springs coloured by their tension.
    pub tension: bool,
    /// Lines at round distances, with units [m].
    pub grid: bool,
    /// The truth, drawn with the simulation.
    pub ghost: bool,
}

impl Default for View {
    fn default() -> Self {
        View {
            contacts: false,
            velocities: false,
            trails: false,
            speed: false,
            tension: true,
            grid: true,
            ghost: false,
        }
    }
}

/// The plots at the bottom.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PlotTab {
    /// Kinetic, potential, elastic and total energy [J].
    #[default]
    Energy,
    /// Worst violation of a constraint and deepest overlap [m].
    Violation,
    /// Estimated error of each step, in parts of an island's size.
    LocalError,
    /// From the truth and from the other method [m].
    Distance,
    /// Time of a step, split by stage [µs].
    StepTime,
    /// Error over cost of every method on this scene.
    Lab,
}

impl PlotTab {
    /// All of them, in the order of their tabs.
    pub const ALL: [PlotTab; 6] =
        [PlotTab::Energy, PlotTab::Violation, PlotTab::LocalError, PlotTab::Distance, PlotTab::StepTime, PlotTab::Lab];

    /// The name shown to a user.
    pub fn name(self) -> &'static str {
        ["Energy", "Error", "Local error", "Distance", "Step time", "Lab"][self as usize]
    }

    /// What it shows, for its tooltip.
    pub fn help(self) -> &'static str {
        [
            "Kinetic, potential, elastic and total energy [J] over simulated time.",
            "Worst violation of a rod, rope or pin and deepest overlap of two surfaces [m] over simulated time.",
            "Estimated error of each step, in parts of an island's size, over simulated time.",
            "Distance of the bodies from the truth (Ghost) and from the other method (A | B) [m] over simulated time.",
            "Time of a step [µs], split by stage, over simulated time.",
            "Error over cost of every method on this scene, measured in the background. [Ctrl-L]",
        ][self as usize]
    }
}

/// A text field that is to take the keyboard in the next pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Field {
    /// Where a scene is found by name, or a file opened by path.
    SceneFilter,
    /// Where the path to write to stands.
    SavePath,
    /// Where an action is found by typing.
    ActionQuery,
    /// Not a text field: the scene itself.
    Canvas,
}

/// The palette of actions while it is open.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Finder {
    /// What was typed; empty finds everything.
    pub query: String,
    /// Which of the lines found is chosen.
    pub chosen: usize,
}

/// Everything of the kind.
#[derive(Clone, Debug)]
pub struct State {
    /// Dark or light, for the panels and the scene alike.
    pub theme: Theme,
    /// All panels at once, for Tab.
    pub panels: bool,
    /// Whether the user wants the plots.
    pub plots: bool,
    /// The tools at the left, where the user wants them otherwise than the window has room; `None` leaves it to that.
    pub tools_panel: Option<bool>,
    /// The settings at the right, likewise.
    pub settings_panel: Option<bool>,
    /// The plots below, likewise.
    pub plots_panel: Option<bool>,
    /// Which of the plots is in front.
    pub plot: PlotTab,
    /// The violation plot's axis in powers of ten.
    pub plot_log: bool,
    /// What the picture of the scene shows.
    pub view: View,
    /// The same scene under another method, beside the simulation.
    pub rival: bool,
    /// That method, once it was chosen or first wanted.
    pub rival_method: Option<Method>,
    /// How the trials of scenes went in this session, by their names.
    pub verdicts: BTreeMap<String, Arc<Verdict>>,
    /// What the lab is to give advice for.
    pub lab: Wanted,
    /// What the lab knows of the open scene before it is measured.
    pub lab_known: Known,
    /// What was typed to find a scene or a file; empty lists all scenes.
    pub scene_filter: String,
    /// Opening of the scene that was last brought into sight in the list.
    pub listed: Option<u64>,
    /// Where the scene is to be written, as typed.
    pub save_path: String,
    /// A file of that name is there, and the user was asked whether it may be replaced.
    pub replace: Option<PathBuf>,
    /// Whether the list of shortcuts lies over everything.
    pub help: bool,
    /// The palette of actions; `None` while it is closed.
    pub finder: Option<Finder>,
    /// What is to take the keyboard in the next pass; `None` leaves it where it is.
    pub focus: Option<Field>,
}

impl Default for State {
    fn default() -> Self {
        State {
            theme: Theme::default(),
            panels: true,
            plots: true,
            tools_panel: None,
            settings_panel: None,
            plots_panel: None,
            plot: PlotTab::default(),
            plot_log: true,
            view: View::default(),
            rival: false,
            rival_method: None,
            verdicts: BTreeMap::new(),
            lab: Wanted::default(),
            lab_known: Known::default(),
            scene_filter: String::new(),
            listed: None,
            save_path: "my scene.ron".into(),
            replace: None,
            help: false,
            finder: None,
            focus: Some(Field::Canvas),
        }
    }
}

impl State {
    /// The switch of something that is shown or left out.
    pub fn shown(&mut self, what: Shown) -> &mut bool {
        match what {
            Shown::Tension => &mut self.view.tension,
            Shown::Speed => &mut self.view.speed,
            Shown::Velocities => &mut self.view.velocities,
            Shown::Contacts => &mut self.view.contacts,
            Shown::Trails => &mut self.view.trails,
            Shown::Grid => &mut self.view.grid,
            Shown::Plots => &mut self.plots,
            Shown::Ghost => &mut self.view.ghost,
            Shown::Rival => &mut self.rival,
        }
    }

    /// Whether `field` is to take the keyboard now; asks only once.
    pub fn takes_focus(&mut self, field: Field) -> bool {
        let takes = self.focus == Some(field);
        if takes {
            self.focus = None;
        }
        takes
    }
}
