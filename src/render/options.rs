//! What a view shows beside bodies, constraints and walls.

use super::colour::Theme;
use crate::engine::{DVec2, Id};

/// The view's switches, and what the hands are doing.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewOptions {
    pub theme: Theme,
    pub grid: bool,
    pub contacts: bool,
    pub velocities: bool,
    pub trails: bool,
    /// Colours rods, ropes and springs by their tension.
    pub tension: bool,
    /// Colours moving bodies by their speed.
    pub speed: bool,
    /// Draws the truth, where the frame has one.
    pub ghost: bool,
    /// Bodies, constraints and walls.
    pub selected: Vec<Id>,
    pub hovered: Option<Id>,
    /// Where the cursor pulls the grabbed point [m], when the window knows it better than the frame.
    pub grip_cursor: Option<DVec2>,
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
            grip_cursor: None,
            extra: Vec::new(),
        }
    }
}

/// A mark that belongs to a tool and not to the world. Points and lengths in the world [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extra {
    /// The slash of a cut.
    Cut { from: DVec2, to: DVec2 },
    /// A line about to be made: a rod, a wall, the side of a selection.
    Line { from: DVec2, to: DVec2 },
    /// A disc about to be made; a radius of 0 for a particle.
    Disc { centre: DVec2, radius: f64 },
    /// The point on which the cursor snaps.
    Snap { at: DVec2 },
}
