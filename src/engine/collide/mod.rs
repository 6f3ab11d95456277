//! Collision detection: a broad phase over a sorted grid, a narrow phase by shape pair, a continuous check on fast motion.

mod broad;
mod grid;
mod guard;
mod narrow;
pub(crate) mod sweep;

pub(crate) use broad::BroadPhase;
pub(crate) use grid::Grid;
pub(crate) use guard::WallGuard;
pub(crate) use narrow::find_contacts;
