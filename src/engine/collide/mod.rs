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

use super::plan::Plan;
use super::world::World;

/// Whether two bodies may touch: both can, one of them can be moved, and neither a group nor a constraint keeps them apart.
pub(crate) fn may_touch(world: &World, plan: &Plan, a: u32, b: u32) -> bool {
    let bodies = &world.bodies;
    let (i, j) = (a as usize, b as usize);
    let joined = || !plan.joined.is_empty() && plan.joined.binary_search(&(a.min(b), a.max(b))).is_ok();
    bodies.collides[i]
        && bodies.collides[j]
        && (bodies.inverse_mass[i] > 0.0 || bodies.inverse_mass[j] > 0.0)
        && (bodies.group[i] == 0 || bodies.group[i] != bodies.group[j])
        && bodies.radius[i] > 0.0
        && bodies.radius[j] > 0.0
        && !joined()
}

/// Whether a body may touch walls.
pub(crate) fn may_touch_walls(world: &World, body: u32) -> bool {
    let i = body as usize;
    world.bodies.collides[i] && world.bodies.inverse_mass[i] > 0.0 && world.bodies.radius[i] > 0.0
}
