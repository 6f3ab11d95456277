//! What the simulation thread publishes: one immutable picture of everything that the window shows.

use super::companion::Companions;
use super::laboratory::Lab;
use super::plot_data::Plots;
use super::trace::Trace;
use crate::engine::{DVec2, Id, Method, StepReport, World};
use crate::file::is_same;
use crate::measure::Measures;
use crate::scene::Setup;
use crate::trial::Verdict;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

/// The scene that is open.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneInfo {
    /// Shipped name ("bridge") or path.
    pub name: String,
    /// Heading for the user; the name where the scene has none.
    pub title: String,
    /// One or two sentences for the user: what it shows, what to try; may be empty.
    pub about: String,
    /// Rectangle that the scene asks to show: centre and height [m].
    pub view: Option<(DVec2, f64)>,
    /// Corners of the smallest box around everything at the start [m]; `None` if the scene is empty.
    pub bounds: Option<(DVec2, DVec2)>,
    /// Counts openings and restarts, so that the window knows when to fit its view anew.
    pub opened: u64,
}

impl Frame {
    /// Whether a scene that is saved to `path` would take the place of a file which is not its own.
    pub fn would_replace(&self, path: &Path) -> bool {
        let own = [Some(self.scene.name.as_str()), self.saved.as_deref()];
        path.exists() && !own.into_iter().flatten().any(|own| is_same(Path::new(own), path))
    }
}

/// Speed as wanted and as achieved, in simulated seconds a second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speed {
    /// As the user set it, 0.01 … 10; slow motion is not counted in.
    pub wanted: f64,
    /// Slow motion is on: a part of what is wanted.
    pub slow: bool,
    /// Averaged over about half a second.
    pub achieved: f64,
}

/// Speed in slow motion, in parts of the wanted one.
pub const SLOW: f64 = 0.1;

impl Speed {
    /// What the simulation tries to keep to at the moment.
    pub fn rate(&self) -> f64 {
        if self.slow { SLOW * self.wanted } else { self.wanted }
    }

    /// Whether it clearly falls behind.
    pub fn falls_short(&self) -> bool {
        self.achieved < 0.95 * self.rate()
    }
}

/// One state of the simulation, whole. The window reads it and never waits for the next.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Counts frames.
    pub sequence: u64,
    /// When it was published.
    pub published: Instant,
    /// The scene that it belongs to.
    pub scene: Arc<SceneInfo>,
    /// A copy of the world after the last step or edit.
    pub world: World,
    /// Positions one step before [m], by body index, for interpolation; empty if there is no such state: after an edit.
    pub previous_position: Vec<DVec2>,
    /// Angles one step before [rad], 0 for particles; empty where `previous_position` is.
    pub previous_angle: Vec<f64>,
    /// How the world is stepped.
    pub method: Method,
    /// What the last step told of itself.
    pub report: StepReport,
    /// Energies, momenta and violations of this state.
    pub measures: Measures,
    /// The last 20 s of measures and stage times, every step of them.
    pub plots: Plots,
    /// Where the bodies were after each of the last steps.
    pub trace: Trace,
    /// What the plan decided, in one sentence.
    pub plan: Arc<str>,
    /// Whether time runs; `false` while paused.
    pub running: bool,
    /// How fast it runs and should run.
    pub speed: Speed,
    /// What went wrong last, and how to mend it, until dismissed or resolved.
    pub fault: Option<String>,
    /// What happened last that a user should know, until it is dismissed or out of date.
    pub note: Option<Arc<str>>,
    /// The file that the scene was last written to, until it is edited or left.
    pub saved: Option<String>,
    /// The scene as it was opened, if it was edited since then and not written to a file.
    pub unsaved: Option<Arc<Setup>>,
    /// Name of the edit that undo would take back; `None` if there is none.
    pub undo: Option<String>,
    /// Name of the edit that redo would make again; `None` if there is none.
    pub redo: Option<String>,
    /// What the last edit made or changed; another `Arc` after every edit.
    pub touched: Arc<Vec<Id>>,
    /// The truth and the rival, where they are wanted.
    pub companions: Companions,
    /// What the lab has measured.
    pub lab: Lab,
    /// How the scene's trial stands, if it has one.
    pub trial: Option<Arc<Verdict>>,
}
