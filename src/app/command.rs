//! What the window asks of the simulation thread. Commands are queued and carried out in order, between two steps.

use super::laboratory::LabOrder;
use crate::engine::{Body, Constraint, DVec2, Id, Kind, Method, Tuning, Wall};

/// A request to the simulation thread.
#[derive(Clone, Debug)]
pub enum Command {
    /// Runs or pauses.
    Run(bool),
    /// Takes one step (and pauses).
    StepOnce,
    /// Back to the start of the scene, with the solver's settings as they are; edits since then are given up (and can be undone).
    Restart,
    /// Wanted speed: simulated seconds a second, 0.01 … 10.
    Speed(f64),
    /// Slow motion, at [`super::frame::SLOW`] of the wanted speed, or no longer.
    Slow(bool),
    /// Opens a shipped scene by name, or a scene file by path. On failure the running scene stays and a fault is shown.
    Open(String),
    /// Opens a scene file by its path, which need not be text.
    OpenFile(std::path::PathBuf),
    /// Opens a new, empty scene.
    New,
    /// Writes the world as it stands to a scene file.
    SaveAs(std::path::PathBuf),
    /// Changes how the world is stepped.
    Method(Method),
    Gravity(DVec2),
    Drag(f64),
    Tuning(Tuning),
    /// Lets the truth follow the simulation further than it is known, or no longer. A motion that is known is compared in any
    /// case.
    Truth(bool),
    /// Lets a rival under this method follow the simulation, gives it this method, or ends it.
    Rival(Option<Method>),
    /// Has the lab measure the open scene.
    Lab(LabOrder),
    /// Takes hold of a body at a point of the world; replaces any hold.
    Grab {
        body: Id,
        at: DVec2,
    },
    /// Moves the hold's target [m].
    MoveGrip(DVec2),
    /// Lets go; the body keeps its velocity.
    Release,
    /// An edit, undone as one.
    Edit(Edit),
    /// A piece of a slash, from point to point: cuts what it crosses [m]. All pieces since the first are undone as one.
    Slash {
        from: DVec2,
        to: DVec2,
        first: bool,
    },
    Undo,
    Redo,
    /// Forgets the shown fault.
    DismissFault,
    /// Forgets the shown note.
    DismissNote,
    /// Ends the thread.
    Quit,
}

/// A change of the scene while it runs.
#[derive(Clone, Debug)]
pub enum Edit {
    /// Adds something at a point [m]. `size` is the radius of one particle of it [m]; everything else follows from it.
    Spawn {
        kind: Spawn,
        at: DVec2,
        size: f64,
    },
    /// Copies bodies, the constraints among them, and walls, shifted by an offset [m].
    Duplicate(Vec<Id>, DVec2),
    /// Removes bodies (with what hangs on them), constraints and walls.
    Delete(Vec<Id>),
    /// Removes every rod, spring, rope and pin that the line between two points crosses.
    Cut(DVec2, DVec2),
    /// Fixes bodies where they are, or frees them.
    Pin(Vec<Id>, bool),
    /// Gives a body those properties of `to` that differ from `from`; the rest, such as the motion since `from` was read, stays.
    ChangeBody {
        id: Id,
        from: Box<Body>,
        to: Box<Body>,
    },
    SetKind(Id, Kind),
    SetWall(Id, Wall),
    /// Joins two bodies, or a body and a point.
    Join(Constraint),
    /// Hangs a new particle of radius `size` [m] at `at` on a fixed point `from`.
    Hang {
        kind: Kind,
        from: DVec2,
        at: DVec2,
        size: f64,
    },
    AddWall(Wall),
}

impl Edit {
    /// Whether it puts something new into the scene: what was just placed is selected.
    pub fn places(&self) -> bool {
        use Edit::{AddWall, Duplicate, Hang, Join, Spawn};
        matches!(self, Spawn { .. } | Duplicate(..) | Join(_) | Hang { .. } | AddWall(_))
    }

    /// The name under which undo and redo offer it.
    pub fn name(&self) -> String {
        match self {
            Edit::Spawn { kind, .. } => format!("Add {}", kind.name().to_lowercase()),
            Edit::Duplicate(..) => "Duplicate".into(),
            Edit::Delete(ids) if ids.len() > 1 => format!("Delete {} things", ids.len()),
            Edit::Delete(_) => "Delete".into(),
            Edit::Cut(..) => "Cut".into(),
            Edit::Pin(_, true) => "Pin".into(),
            Edit::Pin(_, false) => "Unpin".into(),
            Edit::ChangeBody { id, .. } => format!("Change body {id}"),
            Edit::SetKind(id, kind) => format!("Change {} {id}", kind.name().to_lowercase()),
            Edit::SetWall(id, _) => format!("Change wall {id}"),
            Edit::Join(constraint) => format!("Add {}", constraint.kind.name().to_lowercase()),
            Edit::Hang { kind, .. } => format!("Add {}", kind.name().to_lowercase()),
            Edit::AddWall(_) => "Add wall".into(),
        }
    }
}

/// What the palette offers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spawn {
    Particle,
    Disc,
    /// Two particles and a rod.
    Rod,
    /// Two particles and a spring.
    Spring,
    Rope,
    Cloth,
    Pile,
}

impl Spawn {
    /// All of them, in the order of the palette and of the number keys 1 … 7.
    pub const ALL: [Spawn; 7] =
        [Spawn::Particle, Spawn::Disc, Spawn::Rod, Spawn::Spring, Spawn::Rope, Spawn::Cloth, Spawn::Pile];

    /// The name shown to a user.
    pub fn name(self) -> &'static str {
        ["Particle", "Disc", "Rod", "Spring", "Rope", "Cloth", "Pile"][self as usize]
    }
}
