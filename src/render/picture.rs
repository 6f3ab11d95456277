//! A picture: the marks of one view of one frame, in the order in which they are drawn.

use super::bodies::{Mobility, draw_bodies, speed_extreme};
use super::colour::{Colour, Palette, Theme};
use super::ghost::draw_ghost;
use super::legend::SteadyRange;
use super::links::{Layer, draw_joints, draw_links, tension_extreme};
use super::marks::{BoxMark, DiscMark, Ends, LineMark, MarkKind, SpringMark};
use super::options::ViewOptions;
use super::overlays::{draw_contacts, draw_extras, draw_fault, draw_grip, draw_velocities, force_extreme};
use super::pose::Pose;
use super::surroundings::{draw_grid, draw_walls};
use super::trails::{Trails, draw_trails};
use super::view::{View, single};
use crate::app::drawn::Sizes;
use crate::app::{Camera, Frame};
use crate::engine::{DVec2, Id, World};
use std::ops::Range;

/// Consecutive marks of one kind: one draw call.
#[derive(Clone, Debug, PartialEq)]
pub struct Draw {
    /// Which of the picture's lists of marks is drawn from.
    pub kind: MarkKind,
    /// Indices into that list.
    pub marks: Range<u32>,
}

/// The marks of a view. Kept from frame to frame, since it remembers ranges and trails, and to reuse its memory.
#[derive(Clone, Debug, Default)]
pub struct Picture {
    theme: Theme,
    discs: Vec<DiscMark>,
    lines: Vec<LineMark>,
    springs: Vec<SpringMark>,
    boxes: Vec<BoxMark>,
    draws: Vec<Draw>,
    /// Of |tension| [N], speed [m/s] and contact force [N].
    ranges: [SteadyRange; 3],
    /// Opening of the scene that the ranges belong to.
    opened: u64,
    trails: Trails,
    notes: Notes,
    /// The ranges are those of another picture.
    borrowed: bool,
}

/// What is looked up for each body, gathered once a picture.
#[derive(Clone, Debug, Default)]
struct Notes {
    /// The selection, ascending.
    selected: Vec<Id>,
    sizes: Sizes,
}

impl Notes {
    fn gather(&mut self, world: &World, options: &ViewOptions) {
        self.selected.clear();
        self.selected.extend_from_slice(&options.selected);
        self.selected.sort_unstable();
        self.sizes.gather(world);
    }
}

/// What everything that draws is given: the frame, where it stands, how it is seen.
#[derive(Clone, Copy)]
pub(super) struct Scene<'a> {
    pub frame: &'a Frame,
    pub pose: Pose<'a>,
    pub view: View,
    pub options: &'a ViewOptions,
    pub sizes: &'a Sizes,
    selected: &'a [Id],
    pub palette: &'static Palette,
    pub tension: SteadyRange,
    pub speed: SteadyRange,
    pub force: SteadyRange,
}

impl Scene<'_> {
    /// Radius of body `index` [points].
    pub(super) fn radius(&self, index: usize) -> f64 {
        self.sizes.radius(&self.frame.world, index, self.view.scale)
    }

    pub(super) fn is_selected(&self, id: Id) -> bool {
        self.selected.binary_search(&id).is_ok()
    }

    /// Colour and width [points] of the outline of something selected or under the cursor.
    pub(super) fn outline(&self, id: Id) -> Option<(Colour, f32)> {
        if self.is_selected(id) {
            Some((self.palette.accent, 2.0))
        } else {
            (self.options.hovered == Some(id)).then_some((self.palette.hover, 1.5))
        }
    }
}

impl Picture {
    /// An empty picture.
    pub fn new() -> Picture {
        Picture::default()
    }

    /// Draws `frame` as `camera` sees it, `alpha` (0 … 1) of the way from the state before to the state now.
    pub fn build(&mut self, frame: &Frame, camera: &Camera, options: &ViewOptions, alpha: f64) {
        self.clear(options.theme);
        let extremes = [tension_extreme(&frame.world), speed_extreme(&frame.world), force_extreme(&frame.world)];
        self.follow(frame, extremes);
        let [tension, speed, force] = self.ranges;
        let (mut trails, mut notes) = (std::mem::take(&mut self.trails), std::mem::take(&mut self.notes));
        notes.gather(&frame.world, options);
        let scene = Scene {
            frame,
            pose: Pose::new(frame, alpha),
            view: View::new(camera),
            options,
            sizes: &notes.sizes,
            selected: &notes.selected,
            palette: options.theme.palette(),
            tension,
            speed,
            force,
        };
        trails.record(&scene);
        self.draw(&scene, &trails);
        (self.trails, self.notes) = (trails, notes);
    }

    /// Takes over the ranges of `other`, so that a colour means the same in both: for a picture beside it. They are its own
    /// again when it is built without.
    pub fn borrow_ranges(&mut self, other: &Picture) {
        self.ranges = other.ranges;
        self.borrowed = true;
    }

    /// Lets the ranges follow the frame: anew with every scene, and only upwards while nothing moves.
    fn follow(&mut self, frame: &Frame, extremes: [f64; 3]) {
        if std::mem::take(&mut self.borrowed) {
            return;
        }
        if self.opened != frame.scene.opened {
            self.opened = frame.scene.opened;
            self.ranges = Default::default();
        }
        for (range, extreme) in self.ranges.iter_mut().zip(extremes) {
            if frame.running {
                range.update(extreme, frame.published);
            } else {
                range.rise(extreme);
            }
        }
    }

    /// Every layer, from the lowest to the topmost.
    fn draw(&mut self, scene: &Scene<'_>, trails: &Trails) {
        draw_grid(self, scene);
        draw_walls(self, scene);
        draw_trails(self, trails, scene);
        draw_ghost(self, scene);
        draw_links(self, scene, Layer::Below);
        draw_bodies(self, scene, Mobility::Moving);
        draw_links(self, scene, Layer::Above);
        draw_bodies(self, scene, Mobility::Fixed);
        draw_joints(self, scene);
        draw_contacts(self, scene);
        draw_velocities(self, scene);
        draw_fault(self, scene);
        draw_grip(self, scene);
        draw_extras(self, scene);
    }

    /// Takes every mark away, and sets the theme; ranges and trails stay.
    pub fn clear(&mut self, theme: Theme) {
        self.theme = theme;
        self.discs.clear();
        self.lines.clear();
        self.springs.clear();
        self.boxes.clear();
        self.draws.clear();
    }

    /// The colour of the empty canvas.
    pub fn background(&self) -> Colour {
        self.theme.palette().background
    }

    /// Tension at the ends of the colour map [N]; 0 while nothing has carried a force.
    pub fn tension_range(&self) -> f64 {
        self.ranges[0].top()
    }

    /// Speed at the upper end of the colour map [m/s], and of a velocity arrow of length [`VELOCITY_ARROW`].
    pub fn speed_range(&self) -> f64 {
        self.ranges[1].top()
    }

    /// Contact force [N] at which a contact's tick is [`FORCE_TICK`] long.
    pub fn force_range(&self) -> f64 {
        self.ranges[2].top()
    }

    /// The draw calls, in order.
    pub fn draws(&self) -> &[Draw] {
        &self.draws
    }

    /// The discs, in order.
    pub fn discs(&self) -> &[DiscMark] {
        &self.discs
    }

    /// The lines, in order.
    pub fn lines(&self) -> &[LineMark] {
        &self.lines
    }

    /// The springs, in order.
    pub fn springs(&self) -> &[SpringMark] {
        &self.springs
    }

    /// The marks of each kind as bytes, in the order of [`MarkKind`].
    pub(super) fn instances(&self) -> [&[u8]; 4] {
        [
            bytemuck::cast_slice(&self.discs),
            bytemuck::cast_slice(&self.lines),
            bytemuck::cast_slice(&self.springs),
            bytemuck::cast_slice(&self.boxes),
        ]
    }

    /// Adds a disc over everything so far.
    pub fn push_disc(&mut self, disc: DiscMark) {
        self.discs.push(disc);
        self.note(MarkKind::Disc, self.discs.len());
    }

    /// Adds a line over everything so far.
    pub fn push_line(&mut self, line: LineMark) {
        self.lines.push(line);
        self.note(MarkKind::Line, self.lines.len());
    }

    /// Adds a spring over everything so far.
    pub fn push_spring(&mut self, spring: SpringMark) {
        self.springs.push(spring);
        self.note(MarkKind::Spring, self.springs.len());
    }

    /// Adds a box over everything so far.
    pub fn push_box(&mut self, block: BoxMark) {
        self.boxes.push(block);
        self.note(MarkKind::Box, self.boxes.len());
    }

    /// Lets the mark just added join the last draw call, or begin a new one.
    fn note(&mut self, kind: MarkKind, count: usize) {
        let end = count as u32;
        match self.draws.last_mut() {
            Some(draw) if draw.kind == kind => draw.marks.end = end,
            _ => self.draws.push(Draw { kind, marks: end - 1..end }),
        }
    }

    /// A disc at a place [points], if it is seen; `heading` [rad] gives it a spoke.
    pub(super) fn disc(&mut self, view: &View, at: DVec2, radius: f64, style: DiscStyle) {
        if !view.sees_disc(at, radius) {
            return;
        }
        self.push_disc(DiscMark {
            centre: single(at),
            radius: radius as f32,
            edge: (at.length() - radius) as f32,
            heading: style.heading.map_or([0.0; 2], |angle| single(DVec2::from_angle(angle))),
            stroke_width: style.stroke_width,
            fill: style.fill,
            stroke: style.stroke,
        });
    }

    /// The visible part of a line between two places [points], `width` wide [points].
    pub(super) fn line(&mut self, view: &View, [from, to]: [DVec2; 2], width: f32, ends: Ends, colour: Colour) {
        if let Some((from, to)) = view.clip(from, to) {
            self.push_line(LineMark { start: single(from), end: single(to), width, ends: ends as u32, colour });
        }
    }

    /// An arrow between two places [points].
    pub(super) fn arrow(&mut self, view: &View, from: DVec2, to: DVec2, colour: Colour) {
        const WIDTH: f32 = 1.75;
        /// Length of a barb at most, and as a share of the arrow's [points].
        const BARB: (f64, f64) = (7.0, 0.4);
        let along = to - from;
        let length = along.length();
        if length < 1.0 {
            return;
        }
        self.line(view, [from, to], WIDTH, Ends::Round, colour);
        let back = -along / length * BARB.0.min(BARB.1 * length);
        for turn in [0.5, -0.5] {
            self.line(view, [to, to + DVec2::from_angle(turn).rotate(back)], WIDTH, Ends::Round, colour);
        }
    }
}

/// Length of the velocity arrow of a body that moves at the speed range's upper end [points].
pub const VELOCITY_ARROW: f64 = 60.0;
/// Length of the tick of a contact that carries the force range's upper end [points].
pub const FORCE_TICK: f64 = 40.0;

/// How a disc is painted.
#[derive(Clone, Copy)]
pub(super) struct DiscStyle {
    pub fill: Colour,
    pub stroke: Colour,
    /// [points]
    pub stroke_width: f32,
    /// Direction of the spoke [rad].
    pub heading: Option<f64>,
}

impl DiscStyle {
    /// A disc of one colour.
    pub(super) fn plain(fill: Colour) -> DiscStyle {
        DiscStyle { fill, stroke: fill, stroke_width: 0.0, heading: None }
    }

    /// A circle without a fill.
    pub(super) fn ring(stroke: Colour, stroke_width: f32) -> DiscStyle {
        DiscStyle { fill: Colour::CLEAR, stroke, stroke_width, heading: None }
    }
}
