//! What ties bodies together: rods, ropes, springs and pins, coloured by the force they carry.

use super::bodies::draw_bolt;
use super::colour::Colour;
use super::marks::{Ends, SpringMark};
use super::picture::{DiscStyle, Picture, Scene};
use super::view::single;
use crate::app::drawn::{self, Coil, PIN_RADIUS, ROD_WIDTH, ROPE_WIDTH};
use crate::engine::constraint::WORLD;
use crate::engine::{DVec2, Kind, World};

/// Width of a rope that hangs slack [points].
const SLACK_WIDTH: f32 = 1.25;
/// A longer spring [points] is drawn line by line: single precision would no longer place its wire.
const LONGEST_SPRING: f64 = 16_384.0;

/// The largest |tension| of a constraint that is coloured by it [N].
pub(super) fn tension_extreme(world: &World) -> f64 {
    let links = world.constraints();
    let carrying = (0..links.len()).filter(|&i| links.kind[i] != Kind::Pin);
    carrying.map(|i| links.tension(i).abs()).filter(|tension| tension.is_finite()).fold(0.0, f64::max)
}

/// Where a link lies.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Layer {
    /// Below the bodies that move: what ends at a body seems to be fixed to its edge.
    Below,
    /// Above them: a piece of a chain whose beads hide more than half of it.
    Above,
}

/// Draws the links of a layer: outlines, springs, then rods and ropes.
pub(super) fn draw_links(picture: &mut Picture, scene: &Scene<'_>, layer: Layer) {
    let links = scene.frame.world.constraints();
    let indices = || (0..links.len()).filter(|&index| layer_of(scene, index) == layer);
    for index in indices() {
        draw_outline(picture, scene, index);
    }
    for index in indices() {
        if let Kind::Spring { rest, .. } = links.kind[index] {
            draw_spring(picture, scene, index, rest);
        }
    }
    for index in indices() {
        match links.kind[index] {
            Kind::Rod { length } => draw_rod(picture, scene, index, length),
            Kind::Rope { length } => draw_rope(picture, scene, index, length),
            Kind::Spring { .. } | Kind::Pin => {}
        }
    }
}

fn layer_of(scene: &Scene<'_>, index: usize) -> Layer {
    let above = drawn::lies_above(&scene.frame.world, scene.sizes, index, scene.view.scale);
    if above { Layer::Above } else { Layer::Below }
}

/// Draws what lies over the bodies: pins, and the bolts of ends fixed to the world.
pub(super) fn draw_joints(picture: &mut Picture, scene: &Scene<'_>) {
    for index in 0..scene.frame.world.constraints().len() {
        draw_joint(picture, scene, index);
    }
}

/// Both ends on the canvas [points].
fn ends(scene: &Scene<'_>, index: usize) -> [DVec2; 2] {
    let links = scene.frame.world.constraints();
    [(links.a[index], links.at_a[index]), (links.b[index], links.at_b[index])]
        .map(|(body, at)| scene.view.place(scene.pose.point(body, at)))
}

fn colour(scene: &Scene<'_>, index: usize) -> Colour {
    if !scene.options.tension {
        return scene.palette.link;
    }
    scene.options.theme.diverging(scene.tension.share(scene.frame.world.constraints().tension(index)))
}

fn draw_outline(picture: &mut Picture, scene: &Scene<'_>, index: usize) {
    let Some((colour, extra)) = scene.outline(scene.frame.world.constraints().id[index]) else {
        return;
    };
    let [from, to] = ends(scene, index);
    if scene.frame.world.constraints().kind[index] == Kind::Pin {
        picture.disc(&scene.view, from, PIN_RADIUS + 3.0 + f64::from(extra), DiscStyle::ring(colour, extra));
    } else {
        picture.line(&scene.view, [from, to], 5.0 + 2.0 * extra, Ends::Round, colour.with_opacity(0.6));
    }
}

fn draw_rod(picture: &mut Picture, scene: &Scene<'_>, index: usize, length: f64) {
    let width = drawn::width(length, scene.view.scale, ROD_WIDTH) as f32;
    picture.line(&scene.view, ends(scene, index), width, Ends::Round, colour(scene, index));
}

fn draw_rope(picture: &mut Picture, scene: &Scene<'_>, index: usize, length: f64) {
    let [from, to] = ends(scene, index);
    let down = scene.frame.world.gravity().try_normalize().unwrap_or(DVec2::NEG_Y);
    let sag = sag(to - from, length * scene.view.scale, down);
    if sag < 1.0 {
        let width = drawn::width(length, scene.view.scale, ROPE_WIDTH) as f32;
        picture.line(&scene.view, [from, to], width, Ends::Round, colour(scene, index));
        return;
    }
    const PIECES: usize = 16;
    let point = |i: usize| {
        let t = i as f64 / PIECES as f64;
        from.lerp(to, t) + down * (sag * 4.0 * t * (1.0 - t))
    };
    for i in 0..PIECES {
        picture.line(&scene.view, [point(i), point(i + 1)], SLACK_WIDTH, Ends::Round, scene.palette.link);
    }
}

/// How far a slack rope of `length` between two ends `across` apart hangs below the middle of its chord, along `down`.
///
/// A chain's shape depends on its ends only through the part of their distance across gravity, `span`, and the length
/// reduced by the part along it, √(length² − drop²). With s = reduced − span, √(3/8 span s + s²/4) is the sag of a shallow
/// parabola for small s, and exact for a rope that hangs double; in between it is within 4 %.
fn sag(across: DVec2, length: f64, down: DVec2) -> f64 {
    let drop = across.dot(down);
    let span = across.perp_dot(down).abs();
    let spare = (length * length - drop * drop).max(0.0).sqrt() - span;
    if spare > 0.0 { (0.375 * span * spare + 0.25 * spare * spare).sqrt() } else { 0.0 }
}

fn draw_spring(picture: &mut Picture, scene: &Scene<'_>, index: usize, rest: f64) {
    let [from, to] = ends(scene, index);
    let length = (to - from).length();
    let Coil { rest, windings, half_width } = drawn::coil(rest, length, scene.view.scale);
    let wire = (0.2 * half_width).clamp(1.0, 3.0);
    let colour = colour(scene, index);
    if drawn::is_plain(&scene.frame.world, scene.sizes, index, length) {
        picture.line(&scene.view, [from, to], ROD_WIDTH[0] as f32, Ends::Round, colour);
        return;
    }
    let stub = (0.08 * rest).max(2.0 * wire).min(0.2 * length);
    if length > LONGEST_SPRING {
        draw_long_spring(picture, scene, [from, to], Wire { stub, half_width, windings, width: wire as f32, colour });
        return;
    }
    let reach = length / 2.0 + half_width;
    if scene.view.sees_disc((from + to) / 2.0, reach) {
        picture.push_spring(SpringMark {
            start: single(from),
            end: single(to),
            half_width: half_width as f32,
            wire: wire as f32,
            stub: stub as f32,
            windings: windings as f32,
            colour,
        });
    }
}

/// A spring's wire on the canvas [points].
struct Wire {
    stub: f64,
    half_width: f64,
    windings: f64,
    width: f32,
    colour: Colour,
}

/// The wire of `spring.wgsl` as clipped lines in double precision.
fn draw_long_spring(picture: &mut Picture, scene: &Scene<'_>, [from, to]: [DVec2; 2], wire: Wire) {
    let along = (to - from).normalize_or(DVec2::X);
    let strokes = 2.0 * wire.windings;
    let stroke = ((to - from).length() - 2.0 * wire.stub) / strokes;
    let corner = |k: usize| {
        let side = if k % 2 == 1 { -1.0 } else { 1.0 };
        from + along * (wire.stub + (k as f64 - 0.5) * stroke) + along.perp() * (side * wire.half_width)
    };
    let mut last = from + along * wire.stub;
    picture.line(&scene.view, [from, last], wire.width, Ends::Round, wire.colour);
    for k in 1..=strokes as usize {
        picture.line(&scene.view, [last, corner(k)], wire.width, Ends::Round, wire.colour);
        last = corner(k);
    }
    let stub = to - along * wire.stub;
    picture.line(&scene.view, [last, stub], wire.width, Ends::Round, wire.colour);
    picture.line(&scene.view, [stub, to], wire.width, Ends::Round, wire.colour);
}

fn draw_joint(picture: &mut Picture, scene: &Scene<'_>, index: usize) {
    let links = scene.frame.world.constraints();
    let [from, to] = ends(scene, index);
    if links.kind[index] == Kind::Pin {
        let style = DiscStyle {
            fill: scene.palette.background,
            stroke: scene.palette.fixed_stroke,
            stroke_width: 1.5,
            heading: None,
        };
        picture.disc(&scene.view, from, PIN_RADIUS, style);
        return;
    }
    for (body, at) in [(links.a[index], from), (links.b[index], to)] {
        if body == WORLD {
            draw_bolt(picture, scene, at, PIN_RADIUS + 1.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slack_rope_hangs_as_long_as_it_is() {
        for (across, length) in [
            (DVec2::new(1.0, 0.0), 1.02),
            (DVec2::new(1.0, 0.0), 2.0),
            (DVec2::new(1.0, 0.7), 1.6),
            (DVec2::new(0.0, 1.0), 3.0),
            (DVec2::ZERO, 2.0),
        ] {
            let sag = sag(across, length, DVec2::NEG_Y);
            let point = |t: f64| across * t + DVec2::NEG_Y * (sag * 4.0 * t * (1.0 - t));
            let drawn: f64 =
                (0..1000).map(|i| (point((i + 1) as f64 / 1e3) - point(f64::from(i) / 1e3)).length()).sum();
            // The stated 4 % of the sag, and what a parabola differs from a chain.
            assert!((drawn - length).abs() < 0.06 * length, "{drawn} m drawn of {length} m across {across}");
        }
    }

    #[test]
    fn a_taut_rope_does_not_sag() {
        assert_eq!(sag(DVec2::new(3.0, 4.0), 5.0, DVec2::NEG_Y), 0.0);
        assert_eq!(sag(DVec2::new(3.0, 4.0), 4.9, DVec2::NEG_Y), 0.0);
    }

    #[test]
    fn a_rod_that_pulls_is_red_and_one_that_pushes_blue() {
        use crate::app::{Camera, Frame, SceneInfo, Speed};
        use crate::engine::{Body, Constraint, Method, StepReport};
        use crate::measure::Measures;
        use crate::render::{Theme, ViewOptions};

        let mut world = World::new();
        for y in [0.0, 1.0, 2.0] {
            let body = world.add_body(&Body::default()).unwrap();
            let rod = Constraint::to_world(Kind::Rod { length: 1.0 }, body, DVec2::new(1.0, y));
            world.add_constraint(&rod).unwrap();
        }
        // A pull is a negative multiplier.
        world.constraints.force = [-50.0, 50.0, 0.0].map(|force| DVec2::new(force, 0.0)).to_vec();
        let frame = Frame {
            sequence: 0,
            published: std::time::Instant::now(),
            scene: std::sync::Arc::new(SceneInfo::default()),
            world,
            previous_position: Vec::new(),
            previous_angle: Vec::new(),
            method: Method::default(),
            report: StepReport::default(),
            measures: Measures::default(),
            plots: crate::app::Plots::default(),
            trace: crate::app::Trace::default(),
            plan: "".into(),
            running: true,
            speed: Speed { wanted: 1.0, slow: false, achieved: 1.0 },
            fault: None,
            note: None,
            saved: None,
            unsaved: None,
            undo: None,
            redo: None,
            touched: std::sync::Arc::default(),
            companions: crate::app::Companions::default(),
            lab: crate::app::Lab::default(),
            trial: None,
        };
        let camera = Camera { centre: DVec2::ZERO, scale: 50.0, size: DVec2::new(400.0, 300.0) };
        let mut picture = Picture::new();
        picture.build(&frame, &camera, &ViewOptions { grid: false, ..ViewOptions::default() }, 1.0);
        let colours: Vec<Colour> = picture.lines().iter().map(|line| line.colour).collect();
        assert_eq!(colours, [1.0, -1.0, 0.0].map(|share| Theme::Dark.diverging(share)));
        assert_eq!(picture.tension_range(), 50.0);
    }
}
