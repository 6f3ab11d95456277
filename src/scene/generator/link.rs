//! What joins one node of a generator to the next.

use crate::engine::Kind;
use serde::{Deserialize, Serialize};

/// A link between two nodes, as long as they are apart when built.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Link {
    /// Keeps the distance, against pull and push.
    #[default]
    Rod,
    /// Resists pull only.
    Rope,
    /// [N/m] and [N·s/m].
    Spring {
        /// Force over elongation [N/m].
        stiffness: f64,
        /// Force over the speed of elongation [N·s/m].
        #[serde(default)]
        damping: f64,
    },
}

impl Link {
    /// The constraint over a distance [m].
    pub(super) fn over(self, distance: f64) -> Kind {
        match self {
            Link::Rod => Kind::Rod { length: distance },
            Link::Rope => Kind::Rope { length: distance },
            Link::Spring { stiffness, damping } => Kind::Spring { rest: distance, stiffness, damping },
        }
    }
}
