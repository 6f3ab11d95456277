//! What may touch what, as far as places do not matter.

use super::body::Bodies;

/// What matters of a body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    /// It collides and has a size.
    pub solid: bool,
    /// Bodies of the same group other than 0 do not touch each other.
    pub group: u32,
    /// A contact can move it.
    pub movable: bool,
}

impl Side {
    /// Whether two bodies may touch, if no constraint joins them.
    pub fn meets(self, other: Side) -> bool {
        self.solid && other.solid && (self.movable || other.movable) && (self.group == 0 || self.group != other.group)
    }
}

impl Bodies {
    /// Whether a body collides and has a size.
    pub(crate) fn is_solid(&self, index: usize) -> bool {
        self.collides[index] && self.radius[index] > 0.0
    }

    pub(crate) fn side(&self, index: usize) -> Side {
        Side { solid: self.is_solid(index), group: self.group[index], movable: self.inverse_mass[index] > 0.0 }
    }

    /// Whether two bodies may touch; `joined` are the pairs that constraints keep apart: ordered, smaller index first.
    pub(crate) fn may_touch(&self, joined: &[(u32, u32)], a: u32, b: u32) -> bool {
        let apart = || !joined.is_empty() && joined.binary_search(&(a.min(b), a.max(b))).is_ok();
        self.side(a as usize).meets(self.side(b as usize)) && !apart()
    }

    /// Whether a body may touch walls.
    pub(crate) fn may_touch_walls(&self, index: usize) -> bool {
        self.is_solid(index) && self.inverse_mass[index] > 0.0
    }
}
