//! Marks: the few shapes of which every picture is made, one plain instance structure each.
//!
//! Lengths are in points (logical pixels), counted from the middle of the canvas, x to the right, y up. They are found in
//! double precision relative to the camera, so that single precision is enough however far from the origin a scene lies.

use super::colour::Colour;
use bytemuck::{Pod, Zeroable};

/// A disc with a stroke inside its edge.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct DiscMark {
    /// The middle.
    pub centre: [f32; 2],
    /// From the centre to the outer edge of the stroke.
    pub radius: f32,
    /// |centre| − radius, found in double precision: keeps the edge of a huge disc sharp.
    pub edge: f32,
    /// Unit vector along which a spoke is drawn; (0, 0) for none.
    pub heading: [f32; 2],
    /// Width of the edge; 0 for none.
    pub stroke_width: f32,
    /// Inside the stroke; may be clear.
    pub fill: Colour,
    /// The edge and the spoke.
    pub stroke: Colour,
}

/// How a [`LineMark`] ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// A half circle beyond the end.
    Round,
    /// Cut off square, so that translucent segments can be laid end to end.
    Square,
    /// Square, and the line is moved to whole pixels: for lines along the axes.
    Crisp,
}

/// A segment of constant width.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct LineMark {
    /// One end of the axis.
    pub start: [f32; 2],
    /// The other end of the axis.
    pub end: [f32; 2],
    /// Across the line.
    pub width: f32,
    /// One of [`Ends`], as a number.
    pub ends: u32,
    /// Of the whole line.
    pub colour: Colour,
}

/// A spring: a coil of a fixed number of windings between two straight stubs.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SpringMark {
    /// One end, where the first stub begins.
    pub start: [f32; 2],
    /// The other end.
    pub end: [f32; 2],
    /// Half the width of the coil.
    pub half_width: f32,
    /// Width of the wire.
    pub wire: f32,
    /// Length of the stub at each end.
    pub stub: f32,
    /// A whole number, at least 1.
    pub windings: f32,
    /// Of the wire.
    pub colour: Colour,
}

/// A hatched box along the axes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct BoxMark {
    /// Lower left corner.
    pub low: [f32; 2],
    /// Upper right corner.
    pub high: [f32; 2],
    /// Width of the edge.
    pub stroke_width: f32,
    /// Where the hatching starts, 0 … [`HATCH_PERIOD`].
    pub phase: f32,
    /// Between the lines of the hatching.
    pub fill: Colour,
    /// The edge.
    pub stroke: Colour,
    /// The lines of the hatching.
    pub hatch: Colour,
}

/// Distance of two lines of a box's hatching along an axis [points]; the same number stands in `block.wgsl`.
pub const HATCH_PERIOD: f64 = 12.0;

/// The kinds of mark; each has a pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MarkKind {
    /// [`DiscMark`]
    Disc,
    /// [`LineMark`]
    Line,
    /// [`SpringMark`]
    Spring,
    /// [`BoxMark`]
    Box,
}
