//! Shapes of the immovable surroundings: line segments and axis-aligned boxes.

use super::error::{EngineError, check, check_point};
use super::material::Material;
use glam::DVec2;
use serde::{Deserialize, Serialize};

/// The outline of a wall.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Shape {
    /// A line without thickness, solid from both sides.
    Segment {
        /// One end [m].
        from: DVec2,
        /// The other end [m]; the same point makes the wall a point.
        to: DVec2,
    },
    /// A solid box with sides along the axes.
    Box {
        /// Lower left corner [m].
        min: DVec2,
        /// Upper right corner [m], beyond `min` in both directions.
        max: DVec2,
    },
}

/// Something immovable that bodies touch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Wall {
    /// Where it is, and how it is bounded.
    pub shape: Shape,
    /// Coefficient of restitution, 0 … 1.
    pub restitution: f64,
    /// Coefficient of friction, ≥ 0.
    pub friction: f64,
}

impl Default for Wall {
    fn default() -> Self {
        Wall { shape: Shape::Segment { from: DVec2::ZERO, to: DVec2::X }, restitution: 0.0, friction: 0.5 }
    }
}

impl Wall {
    /// What it is made of.
    pub fn material(&self) -> Material {
        Material { restitution: self.restitution, friction: self.friction }
    }

    /// A segment wall with the default material.
    pub fn segment(from: DVec2, to: DVec2) -> Wall {
        Wall { shape: Shape::Segment { from, to }, ..Wall::default() }
    }

    /// A box wall with the default material.
    pub fn block(min: DVec2, max: DVec2) -> Wall {
        Wall { shape: Shape::Box { min, max }, ..Wall::default() }
    }

    /// Refuses NaN, infinities, an empty box and coefficients out of range. A segment may be a point.
    pub fn validate(&self) -> Result<(), EngineError> {
        match self.shape {
            Shape::Segment { from, to } => {
                check_point("start of the segment", from)?;
                check_point("end of the segment", to)?;
            }
            Shape::Box { min, max } => {
                check_point("lower corner of the box", min)?;
                check_point("upper corner of the box", max)?;
                check("width of the box", max.x - min.x, [1e-9, 1e9], "between 1e-9 and 1e9 m, with min left of max")?;
                check("height of the box", max.y - min.y, [1e-9, 1e9], "between 1e-9 and 1e9 m, with min below max")?;
            }
        }
        check("restitution", self.restitution, [0.0, 1.0], "between 0 and 1")?;
        check("friction", self.friction, [0.0, 1e3], "between 0 and 1000")
    }
}

impl Shape {
    /// Corners of the smallest axis-aligned box around the shape: lower left, upper right.
    pub fn bounds(&self) -> (DVec2, DVec2) {
        match *self {
            Shape::Segment { from, to } => (from.min(to), from.max(to)),
            Shape::Box { min, max } => (min, max),
        }
    }

    /// Distance from `point` to the shape [m], negative inside a box, and the outward unit normal there.
    ///
    /// On the shape itself the normal is that of the nearest side (for a segment its left-hand normal).
    pub fn distance(&self, point: DVec2) -> (f64, DVec2) {
        match *self {
            Shape::Segment { from, to } => segment_distance(from, to, point),
            Shape::Box { min, max } => box_distance(min, max, point),
        }
    }
}

fn segment_distance(from: DVec2, to: DVec2, point: DVec2) -> (f64, DVec2) {
    let along = to - from;
    let length_squared = along.length_squared();
    let t = if length_squared > 0.0 { ((point - from).dot(along) / length_squared).clamp(0.0, 1.0) } else { 0.0 };
    let away = point - (from + along * t);
    let distance = away.length();
    if distance > 0.0 {
        (distance, away / distance)
    } else if length_squared > 0.0 {
        (0.0, along.perp() / length_squared.sqrt())
    } else {
        (0.0, DVec2::Y)
    }
}

fn box_distance(min: DVec2, max: DVec2, point: DVec2) -> (f64, DVec2) {
    let away = point - point.clamp(min, max);
    let distance = away.length();
    if distance > 0.0 {
        return (distance, away / distance);
    }
    let sides = [
        (point.x - min.x, DVec2::NEG_X),
        (max.x - point.x, DVec2::X),
        (point.y - min.y, DVec2::NEG_Y),
        (max.y - point.y, DVec2::Y),
    ];
    let mut nearest = sides[0];
    for side in &sides[1..] {
        if side.0 < nearest.0 {
            nearest = *side;
        }
    }
    (-nearest.0, nearest.1)
}
