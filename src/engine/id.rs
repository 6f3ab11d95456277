//! Names that outlive edits: an [`Id`] is never given twice in the life of a world, so a stale one is noticed, not misread.

use serde::{Deserialize, Serialize};

/// The name of a body, a constraint or a wall. Inside the engine dense indices are used; ids are for everyone else.
///
/// Ids grow in the order of creation and are never reused, so a sorted list of ids stays sorted under removal, and
/// an id is found by binary search.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Id(pub u64);

impl std::fmt::Display for Id {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.0)
    }
}

/// Index of `id` in the ascending list `ids`, if it is (still) there. O(log n).
pub(crate) fn find(ids: &[Id], id: Id) -> Option<usize> {
    ids.binary_search(&id).ok()
}
