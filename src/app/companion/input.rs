//! What happens to the simulation's world between two steps, as it reaches the worlds that follow it.

use crate::app::command::Edit;
use crate::app::edit;
use crate::app::error::Lost;
use crate::engine::{DVec2, Grip, Id, Tuning, World};

/// One change of a world from outside.
#[derive(Clone, Debug)]
pub enum Input {
    /// [m/s²]
    Gravity(DVec2),
    /// [1/s]
    Drag(f64),
    /// The values that stand in for those of all contacts and springs.
    Tuning(Tuning),
    /// A hand takes hold.
    Hold(Grip),
    /// The hand moves to a point [m]; the force of the hold is the follower's own.
    Move(DVec2),
    /// The hand lets go; the body keeps its velocity.
    Release,
    /// Something is added, changed or removed.
    Edit(Edit),
    /// Steps a second from now on [Hz]. How the simulation is stepped is not part of its motion.
    Rate(f64),
}

impl Input {
    /// An edit as the simulation carried it out; `touched` is what it made, changed or removed. A cut is by what it crossed
    /// there: elsewhere the same slash would cross something else.
    pub fn of_edit(edit: &Edit, touched: &[Id]) -> Input {
        match edit {
            Edit::Cut(..) => Input::Edit(Edit::Delete(touched.to_vec())),
            other => Input::Edit(other.clone()),
        }
    }

    /// Whether the exact motion of the scene is another one afterwards.
    pub fn touches(&self) -> bool {
        !matches!(self, Input::Rate(_))
    }

    /// Carries it out. On an error the world may be half changed.
    pub(super) fn apply(&self, world: &mut World) -> Result<(), Lost> {
        match self {
            Input::Gravity(gravity) => world.set_gravity(*gravity)?,
            Input::Drag(drag) => world.set_drag(*drag)?,
            Input::Tuning(tuning) => world.set_tuning(*tuning)?,
            Input::Hold(grip) => world.set_grip(Some(*grip))?,
            Input::Move(target) => {
                if let Some(grip) = world.grip().copied() {
                    world.set_grip(Some(Grip { target: *target, ..grip }))?;
                }
            }
            Input::Release => world.set_grip(None)?,
            Input::Edit(edit) => drop(edit::apply(world, edit)?),
            Input::Rate(_) => {}
        }
        Ok(())
    }
}
