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
    /// Changes the gravity of the world [m/s²].
    Gravity(DVec2),
    /// Changes the rate at which free motion dies away [1/s].
    Drag(f64),
    /// Changes the values that stand in for those of all contacts and springs.
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
        /// The body that is held.
        body: Id,
        /// Where on it the hold begins [m].
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
        /// Where the piece begins [m].
        from: DVec2,
        /// Where the piece ends [m].
        to: DVec2,
        /// Whether a new slash begins here, and with it a new entry of undo.
        first: bool,
    },
    /// Takes back the last edit, restart or opening, if there is one.
    Undo,
    /// Does again what was undone last, unless something was changed since.
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
        /// What to add.
        kind: Spawn,
        /// Where its middle goes [m]; of a rope the pinned end, of a cloth the middle of the top edge.
        at: DVec2,
        /// Radius of a particle [m], > 0.
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
        /// The body to change.
        id: Id,
        /// The body as the user saw it.
        from: Box<Body>,
        /// The body as the user wants it.
        to: Box<Body>,
    },
    /// Gives a constraint another kind, or its kind other numbers.
    SetKind(Id, Kind),
    /// Gives a wall another shape, restitution or friction.
    SetWall(Id, Wall),
    /// Joins two bodies, or a body and a point.
    Join(Constraint),
    /// Hangs a new particle of radius `size` [m] at `at` on a fixed point `from`.
    Hang {
        /// What it hangs on: a rod, rope or spring.
        kind: Kind,
        /// The fixed point [m].
        from: DVec2,
        /// Centre of the new particle [m].
        at: DVec2,
        /// Radius of the new particle [m].
        size: f64,
    },
    /// Adds an immovable segment or box.
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
    /// A body that does not turn.
    Particle,
    /// A body that turns and rolls.
    Disc,
    /// Two particles and a rod.
    Rod,
    /// Two particles and a spring.
    Spring,
    /// A chain of rods, its first particle pinned.
    Rope,
    /// A net of springs, two corners pinned.
    Cloth,
    /// A block of discs that falls apart.
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
