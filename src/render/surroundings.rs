//! What bodies move in: the grid and the walls.

use super::grid::{GridStep, lines};
use super::marks::{BoxMark, Ends, HATCH_PERIOD};
use super::picture::{Picture, Scene};
use super::view::single;
use crate::engine::{DVec2, Shape};

/// Lines at round coordinates, those through the origin stronger.
pub(super) fn draw_grid(picture: &mut Picture, scene: &Scene<'_>) {
    if !scene.options.grid {
        return;
    }
    let view = &scene.view;
    let step = GridStep::at_scale(view.scale);
    let palette = scene.palette;
    let minor = palette.grid_minor.with_opacity(step.minor_opacity);
    // Axes last, so that they lie on top where lines cross.
    for (distance, colour, all) in
        [(step.minor, minor, true), (step.major, palette.grid_major, true), (step.major, palette.axis, false)]
    {
        let (low, high) = view.bounds();
        for x in lines(low.x, high.x, distance).filter(|k| all || *k == 0.0).map(|k| k * distance) {
            let ends = [DVec2::new(x, low.y), DVec2::new(x, high.y)].map(|end| view.place(end));
            picture.line(view, ends, 1.0, Ends::Crisp, colour);
        }
        for y in lines(low.y, high.y, distance).filter(|k| all || *k == 0.0).map(|k| k * distance) {
            let ends = [DVec2::new(low.x, y), DVec2::new(high.x, y)].map(|end| view.place(end));
            picture.line(view, ends, 1.0, Ends::Crisp, colour);
        }
    }
}

/// Boxes hatched, segments as thick lines.
pub(super) fn draw_walls(picture: &mut Picture, scene: &Scene<'_>) {
    let (view, palette) = (&scene.view, scene.palette);
    for (id, wall) in scene.frame.world.wall_ids().iter().zip(scene.frame.world.walls()) {
        let outline = scene.outline(*id);
        match wall.shape {
            Shape::Segment { from, to } => {
                let ends = [view.place(from), view.place(to)];
                if let Some((colour, width)) = outline {
                    picture.line(view, ends, 3.0 + 2.0 * width, Ends::Round, colour);
                }
                picture.line(view, ends, 3.0, Ends::Round, palette.wall_edge);
            }
            Shape::Box { min, max } => {
                let (low, high) = (view.place(min), view.place(max));
                // The hatching is fixed to the lower left corner; the shader counts along (1, 1) in pixels, y down.
                let phase = -(low.x + low.y).rem_euclid(HATCH_PERIOD);
                let Some((low, high)) = view.clip_box(low, high) else {
                    continue;
                };
                let (stroke, stroke_width) = outline.unwrap_or((palette.wall_edge, 1.5));
                picture.push_box(BoxMark {
                    low: single(low),
                    high: single(high),
                    stroke_width,
                    phase: phase as f32,
                    fill: palette.wall_fill,
                    stroke,
                    hatch: palette.wall_hatch,
                });
            }
        }
    }
}
