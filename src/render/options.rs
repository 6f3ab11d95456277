//! What a view shows beside bodies, constraints and walls.

use super::colour::Theme;
use crate::engine::{DVec2, Id};

/// The view's switches, and what the hands are doing.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewOptions {
    /// The colours of the scene.
    pub theme: Theme,
    /// Draws lines at round distances under everything.
    pub grid: bool,
    /// Draws where bodies touch, with ticks for the normal forces.
    pub contacts: bool,
    /// Draws an arrow for the velocity of every body.
    pub velocities: bool,
    /// Draws where bodies were.
    pub trails: bool,
    /// Colours rods, ropes and springs by their tension.
    pub tension: bool,
    /// Colours moving bodies by their speed.
    pub speed: bool,
    /// Draws the truth, where the frame has one.
    pub ghost: bool,
    /// Bodies, constraints and walls.
    pub selected: Vec<Id>,
    /// What lies under the cursor, if anything.
    pub hovered: Option<Id>,
    /// The grabbed point and the cursor that pulls it [m], where they are not those of the body that is held: on a rod.
    pub grip: Option<(DVec2, DVec2)>,
    /// Marks of the tool in hand.
    pub extra: Vec<Extra>,
}

impl Default for ViewOptions {
    fn default() -> Self {
        ViewOptions {
            theme: Theme::default(),
            grid: true,
            contacts: false,
            velocities: false,
            trails: false,
            tension: true,
            speed: false,
            ghost: true,
            selected: Vec::new(),
            hovered: None,
            grip: None,
            extra: Vec::new(),
        }
    }
}

/// A mark that belongs to a tool and not to the world. Points and lengths in the world [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extra {
    /// The slash of a cut.
    Cut {
        /// Where the slash begins.
        from: DVec2,
        /// Where the cursor is.
        to: DVec2,
    },
    /// A line about to be made: a rod, a wall, the side of a selection.
    Line {
        /// One end.
        from: DVec2,
        /// The other end.
        to: DVec2,
    },
    /// A disc about to be made; a radius of 0 for a particle.
    Disc {
        /// Its middle.
        centre: DVec2,
        /// From the middle to the edge.
        radius: f64,
    },
    /// The point on which the cursor snaps.
    Snap {
        /// The point.
        at: DVec2,
    },
}
