//! The pictures, drawn off screen: what is asserted is what is seen, in pixels.
#![cfg(feature = "desktop")]

mod common;

use std::sync::{Arc, OnceLock};
use std::time::Instant;
use tautline::app::companion::{Offsets, Report};
use tautline::app::{Camera, Companion, Frame, SceneInfo, Speed};
use tautline::engine::{
    Body, Constraint, DVec2, Grip, Id, Kind, Method, Motion, Spin, StepReport, Stepper, Wall, World,
};
use tautline::measure::Measures;
use tautline::render::marks::{DiscMark, Ends, MarkKind};
use tautline::render::offscreen::{FORMAT, begin_scene, render};
use tautline::render::{Colour, Extra, Gpu, Image, Picture, Renderer, Theme, ViewOptions, Viewport};

/// The device, made once for all tests; `None` where there is no adapter.
fn gpu() -> Option<&'static Gpu> {
    static GPU: OnceLock<Option<Gpu>> = OnceLock::new();
    GPU.get_or_init(|| common::require("a graphics adapter", Gpu::headless())).as_ref()
}

fn frame(world: World) -> Frame {
    Frame {
        sequence: 1,
        published: Instant::now(),
        scene: Arc::new(SceneInfo::default()),
        world,
        previous_position: Vec::new(),
        previous_angle: Vec::new(),
        method: Method::default(),
        report: StepReport::default(),
        measures: Measures::default(),
        plan: "".into(),
        running: false,
        speed: Speed { wanted: 1.0, slow: false, achieved: 1.0 },
        fault: None,
        note: None,
        saved: None,
        unsaved: None,
        undo: None,
        redo: None,
        plots: tautline::app::Plots::default(),
        trace: tautline::app::Trace::default(),
        touched: std::sync::Arc::default(),
        companions: tautline::app::Companions::default(),
        lab: tautline::app::Lab::default(),
        trial: None,
    }
}

fn camera(centre: DVec2, scale: f64, size: [u32; 2]) -> Camera {
    Camera { centre, scale, size: DVec2::new(f64::from(size[0]), f64::from(size[1])) }
}

fn bare() -> ViewOptions {
    ViewOptions { grid: false, ..ViewOptions::default() }
}

/// Draws a picture of a canvas of `points` at a scale factor.
fn shoot(gpu: &Gpu, picture: &Picture, points: [u32; 2], pixels_per_point: f32) -> Image {
    let mut renderer = Renderer::new(&gpu.device, FORMAT);
    let target = points.map(|side| (side as f32 * pixels_per_point) as u32);
    render(gpu, &mut renderer, picture, &Viewport::whole(target, pixels_per_point), |_| {}, |_| {}).unwrap()
}

fn shoot_world(gpu: &Gpu, world: &World, camera: &Camera, options: &ViewOptions, pixels_per_point: f32) -> Image {
    let mut picture = Picture::new();
    picture.build(&frame(world.clone()), camera, options, 1.0);
    shoot(gpu, &picture, [camera.size.x as u32, camera.size.y as u32], pixels_per_point)
}

fn white_disc(centre: [f32; 2], radius: f32) -> DiscMark {
    let white = Colour::hex(0xFFFFFF);
    let edge = centre[0].hypot(centre[1]) - radius;
    DiscMark { centre, radius, edge, heading: [0.0; 2], stroke_width: 0.0, fill: white, stroke: white }
}

/// How much of each pixel is white, from the dark background's level up.
fn coverages(image: &Image, background: Colour) -> impl Iterator<Item = f64> + '_ {
    let floor = f64::from(background.0[0]);
    image.rgba.chunks_exact(4).map(move |pixel| (f64::from(pixel[0]) - floor) / (255.0 - floor))
}

fn differing(image: &Image, background: Colour) -> usize {
    image.rgba.chunks_exact(4).filter(|pixel| pixel[..3] != background.0[..3]).count()
}

fn disc_world(at: DVec2, radius: f64) -> World {
    let mut world = World::new();
    world.add_body(&Body { position: at, radius, ..Body::default() }).unwrap();
    world
}

#[test]
fn a_disc_covers_its_area_and_its_edge_is_smooth() {
    let Some(gpu) = gpu() else { return };
    for (centre, radius, scale) in
        [([0.0, 0.0], 40.0, 1.0f32), ([3.3, -7.7], 12.5, 1.0), ([0.2, 0.4], 30.0, 2.0), ([1.0, 1.0], 25.0, 1.5)]
    {
        let mut picture = Picture::new();
        picture.push_disc(white_disc(centre, radius));
        let image = shoot(gpu, &picture, [100, 100], scale);
        let covered: f64 = coverages(&image, picture.background()).sum();
        let area = std::f64::consts::PI * f64::from(radius * scale).powi(2);
        println!("radius {radius} at {scale}×: {covered:.1} px of {area:.1}");
        assert!((covered / area - 1.0).abs() < 0.005, "{covered} px instead of {area}");
        let partial = coverages(&image, picture.background()).filter(|part| (0.02..0.98).contains(part)).count() as f64;
        // A ring one pixel wide, of which the outermost 2 % on either side are not counted.
        let ring = std::f64::consts::TAU * f64::from(radius * scale);
        assert!((0.8..1.2).contains(&(partial / ring)), "{partial} smooth pixels on a rim of {ring}");
    }
}

#[test]
fn the_same_picture_three_times_is_the_same_to_the_byte() {
    let Some(gpu) = gpu() else { return };
    let (world, _) = playground();
    let view = camera(DVec2::new(0.0, 1.0), 80.0, [400, 300]);
    let options = ViewOptions { contacts: true, velocities: true, ..ViewOptions::default() };
    let first = shoot_world(gpu, &world, &view, &options, 1.0);
    for _ in 0..2 {
        assert!(shoot_world(gpu, &world, &view, &options, 1.0) == first);
    }
}

#[test]
fn a_disc_is_seen_at_every_zoom() {
    let Some(gpu) = gpu() else { return };
    let world = disc_world(DVec2::ZERO, 0.5);
    for exponent in -3..=6 {
        let scale = 10f64.powi(exponent);
        let image = shoot_world(gpu, &world, &camera(DVec2::ZERO, scale, [64, 64]), &bare(), 1.0);
        let seen = differing(&image, Theme::Dark.palette().background) as f64;
        // A dot of radius 1.5 when far, the whole canvas when near; the rim's faintest pixels may round to nothing.
        let wanted = (std::f64::consts::PI * (0.5 * scale).max(1.5).powi(2)).min(64.0 * 64.0);
        println!("scale 1e{exponent}: {seen} px, {wanted:.0} covered");
        assert!(seen >= 0.9 * wanted, "{seen} px at {scale} points a metre instead of {wanted}");
    }
}

#[test]
fn the_edge_of_a_disc_of_a_million_metres_is_sharp_and_in_its_place() {
    let Some(gpu) = gpu() else { return };
    // The canvas shows 64 µm … 64 m around the disc's lowest point: a horizontal edge through its middle.
    for scale in [1.0, 1e3, 1e6] {
        let world = disc_world(DVec2::new(0.0, 1e6), 1e6);
        let image = shoot_world(gpu, &world, &camera(DVec2::ZERO, scale, [64, 64]), &bare(), 1.0);
        let background = Theme::Dark.palette().background.0;
        for x in [0, 20, 63] {
            let rows: Vec<bool> = (0..64).map(|y| image.pixel(x, y).unwrap() != background).collect();
            let expected: Vec<bool> = (0..64).map(|y| y < 32).collect();
            assert_eq!(rows, expected, "column {x} at {scale} points a metre");
        }
    }
}

#[test]
fn at_twice_the_scale_factor_everything_is_twice_as_large() {
    let Some(gpu) = gpu() else { return };
    let world = disc_world(DVec2::new(0.3, 0.2), 0.5);
    let view = camera(DVec2::ZERO, 40.0, [100, 80]);
    let one = shoot_world(gpu, &world, &view, &bare(), 1.0);
    let two = shoot_world(gpu, &world, &view, &bare(), 2.0);
    assert_eq!((two.width, two.height), (200, 160));
    // Centres of the pixels that are not background, in points.
    let middle = |image: &Image, scale: f64| {
        let background = Theme::Dark.palette().background.0;
        let mut sum = (0.0, 0.0, 0.0);
        for y in 0..image.height {
            for x in 0..image.width {
                if image.pixel(x, y).unwrap() != background {
                    sum = (sum.0 + (f64::from(x) + 0.5) / scale, sum.1 + (f64::from(y) + 0.5) / scale, sum.2 + 1.0);
                }
            }
        }
        (sum.0 / sum.2, sum.1 / sum.2, sum.2 / (scale * scale))
    };
    let ((x, y, area), (x2, y2, area2)) = (middle(&one, 1.0), middle(&two, 2.0));
    // Whole pixels are counted, so the area has the rim's granularity; its middle hardly.
    assert!((x - 62.0).abs() < 0.1 && (y - 32.0).abs() < 0.1, "({x}, {y})");
    assert!((x2 - x).abs() < 0.1 && (y2 - y).abs() < 0.1, "({x2}, {y2})");
    assert!((area2 / area - 1.0).abs() < 0.06, "{area2} against {area}");
}

#[test]
fn forty_kilometres_away_looks_like_at_the_origin() {
    let Some(gpu) = gpu() else { return };
    // A whole number of metres that a double holds exactly together with the scene's sixteenths.
    let away = DVec2::new(40_000.0, -24_000.0);
    let scene = |at: DVec2| {
        let mut world = disc_world(at + DVec2::new(0.5, 0.25), 0.375);
        let a = world.add_body(&Body { position: at - DVec2::X, radius: 0.125, ..Body::default() }).unwrap();
        world.add_constraint(&Constraint::to_world(Kind::Rod { length: 1.0 }, a, at - DVec2::X + DVec2::Y)).unwrap();
        let spring = Kind::Spring { rest: 1.0, stiffness: 1.0, damping: 0.0 };
        world.add_constraint(&Constraint::to_world(spring, a, at + DVec2::X)).unwrap();
        world.add_wall(&Wall::block(at + DVec2::new(-1.5, -1.0), at + DVec2::new(1.5, -0.75))).unwrap();
        shoot_world(gpu, &world, &camera(at, 64.0, [240, 180]), &bare(), 1.0)
    };
    assert!(scene(away) == scene(DVec2::ZERO));
}

#[test]
fn particles_without_size_are_dots_that_can_be_seen() {
    let Some(gpu) = gpu() else { return };
    let image = shoot_world(gpu, &disc_world(DVec2::ZERO, 0.0), &camera(DVec2::ZERO, 1e-2, [40, 40]), &bare(), 1.0);
    let seen = differing(&image, Theme::Dark.palette().background);
    assert!((28..=46).contains(&seen), "{seen} px for a dot of radius 3");
}

#[test]
fn point_masses_on_links_have_bobs_and_a_heavy_one_a_larger_one() {
    for name in ["truth/pendulum", "truth/double_pendulum", "truth/heavy_rope", "truth/stiff_chain"] {
        let setup = tautline::scene::open(name).unwrap();
        let (centre, height) = setup.view.expect("a truth scene says what to show");
        let mut picture = Picture::new();
        let world = setup.world;
        let view = camera(centre, 500.0 / height, [700, 500]);
        picture.build(&frame(world.clone()), &view, &bare(), 1.0);
        let radius = |body: usize| {
            let at = (world.bodies().position[body] - centre) * view.scale;
            let near =
                |disc: &&DiscMark| (f64::from(disc.centre[0]) - at.x).hypot(f64::from(disc.centre[1]) - at.y) < 0.01;
            picture.discs().iter().find(near).expect("drawn").radius
        };
        let last = world.bodies().len() - 1;
        println!("{name}: {} points, the last {} points", radius(1), radius(last));
        assert!(radius(last) >= 4.5, "{name}: {} points", radius(last));
        if name == "truth/heavy_rope" {
            assert!(radius(last) > 2.0 * radius(1), "5000 times heavier");
        }
    }
}

#[test]
fn the_ghost_is_drawn_where_it_is_wanted_and_can_be_told_from_the_canvas() {
    let mut world = disc_world(DVec2::ZERO, 0.5);
    world.set_gravity(DVec2::ZERO).unwrap();
    let bodies = Arc::new(world.bodies().id.clone());
    let offsets = Offsets { bodies, shift: vec![DVec2::new(2.0, 0.0)], turn: Vec::new() };
    let report = Report { generation: 1, offsets: Arc::new(offsets), ..Report::default() };
    let mut frame = frame(world);
    frame.companions.truth = Some(Companion::fixed(report, []));
    let view = camera(DVec2::ZERO, 50.0, [400, 200]);
    let mut picture = Picture::new();
    for theme in [Theme::Dark, Theme::Light] {
        picture.build(&frame, &view, &ViewOptions { theme, ghost: false, ..bare() }, 1.0);
        assert_eq!(picture.discs().len(), 1, "nobody asked for it");
        picture.build(&frame, &view, &ViewOptions { theme, ghost: true, ..bare() }, 1.0);
        assert_eq!(picture.discs().len(), 2);
        if let Some(gpu) = gpu() {
            let image = shoot(gpu, &picture, [400, 200], 1.0);
            let luminance = |x: u32, y: u32| {
                let [r, g, b, _] = image.pixel(x, y).unwrap();
                let linear = |c: u8| (f64::from(c) / 255.0).powf(2.2);
                0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b)
            };
            let [ghost, ground] = [luminance(300, 100), luminance(20, 20)];
            let contrast = (ghost.max(ground) + 0.05) / (ghost.min(ground) + 0.05);
            println!("{theme:?}: contrast of the ghost {contrast:.1}");
            // What WCAG 2.1 asks of graphics that must be told from their ground.
            assert!(contrast >= 3.0, "{theme:?}: {contrast}");
        }
    }
}

#[test]
fn a_body_is_drawn_between_its_last_two_places() {
    let mut frame = frame(disc_world(DVec2::new(2.0, 0.0), 0.5));
    frame.previous_position = vec![DVec2::new(1.0, 0.0)];
    frame.previous_angle = vec![0.0];
    let mut picture = Picture::new();
    let places = [0.0, 0.25, 1.0, 7.0, f64::NAN].map(|alpha| {
        picture.build(&frame, &camera(DVec2::ZERO, 100.0, [600, 400]), &bare(), alpha);
        picture.discs()[0].centre[0]
    });
    assert_eq!(places, [100.0, 125.0, 200.0, 200.0, 200.0]);
}

#[test]
fn a_turning_disc_shows_its_angle_and_a_particle_none() {
    let mut world = disc_world(DVec2::ZERO, 0.5);
    let spin = Some(Spin { angle: std::f64::consts::FRAC_PI_2, omega: 0.0 });
    world.add_body(&Body { position: DVec2::X, radius: 0.5, spin, ..Body::default() }).unwrap();
    let mut picture = Picture::new();
    picture.build(&frame(world), &camera(DVec2::ZERO, 100.0, [600, 400]), &bare(), 1.0);
    assert_eq!(picture.discs()[0].heading, [0.0, 0.0]);
    let [x, y] = picture.discs()[1].heading;
    assert!(x.abs() < 1e-6 && (y - 1.0).abs() < 1e-6);
}

#[test]
fn a_hanging_rod_is_red_and_a_standing_one_blue() {
    let Some(gpu) = gpu() else { return };
    let mut world = World::new();
    for (x, y) in [(-1.0, -1.0), (1.0, 1.0)] {
        let body = world.add_body(&Body { position: DVec2::new(x, y), ..Body::default() }).unwrap();
        let rod = Constraint::to_world(Kind::Rod { length: 1.0 }, body, DVec2::new(x, 0.0));
        world.add_constraint(&rod).unwrap();
    }
    let mut stepper = Stepper::new(Method::default()).unwrap();
    stepper.step(&mut world);
    let image = shoot_world(gpu, &world, &camera(DVec2::ZERO, 50.0, [200, 200]), &bare(), 1.0);
    let [red, _, blue, _] = image.pixel(50, 125).unwrap();
    assert!(red > 2 * blue, "hanging: red {red}, blue {blue}");
    let [red, _, blue, _] = image.pixel(150, 75).unwrap();
    assert!(blue > 2 * red, "standing: red {red}, blue {blue}");
}

#[test]
fn rods_lie_over_the_beads_of_a_chain_that_would_hide_them() {
    let draws = |radius: f64| {
        let mut world = World::new();
        let beads: Vec<Id> = (0..4)
            .map(|i| Body { position: DVec2::new(0.2 * f64::from(i), 0.0), radius, ..Body::default() })
            .map(|bead| world.add_body(&bead).unwrap())
            .collect();
        for pair in beads.windows(2) {
            world.add_constraint(&Constraint::between(Kind::Rod { length: 0.2 }, pair[0], pair[1])).unwrap();
        }
        let mut picture = Picture::new();
        picture.build(&frame(world), &camera(DVec2::ZERO, 100.0, [600, 400]), &bare(), 1.0);
        // The rod in the middle is the one with beads at both ends.
        let middle = picture.lines().iter().position(|line| (line.start[0] - 20.0).abs() < 1e-3).unwrap() as u32;
        let of = |kind: MarkKind, mark: u32| {
            picture.draws().iter().position(|draw| draw.kind == kind && draw.marks.contains(&mark)).unwrap()
        };
        of(MarkKind::Line, middle) > of(MarkKind::Disc, 1)
    };
    assert!(draws(0.1) && !draws(0.04));
}

#[test]
fn springs_of_a_mesh_are_plain_lines() {
    let mut world = World::new();
    let hub = world.add_body(&Body::default()).unwrap();
    let mut kinds = Vec::new();
    for i in 0..5 {
        let position = 2.0 * DVec2::from_angle(f64::from(i));
        let rim = world.add_body(&Body { position, ..Body::default() }).unwrap();
        let spring = Kind::Spring { rest: 2.0, stiffness: 1.0, damping: 0.0 };
        world.add_constraint(&Constraint::between(spring, hub, rim)).unwrap();
        let mut picture = Picture::new();
        picture.build(&frame(world.clone()), &camera(DVec2::ZERO, 50.0, [600, 400]), &bare(), 1.0);
        kinds.push((picture.springs().len(), picture.lines().len()));
    }
    assert_eq!(kinds, [(1, 0), (2, 0), (3, 0), (0, 4), (0, 5)]);
}

#[test]
fn a_stretched_spring_keeps_its_windings() {
    let windings = |distance: f64| {
        let mut world = World::new();
        let a = world.add_body(&Body::default()).unwrap();
        let spring = Kind::Spring { rest: 1.0, stiffness: 1.0, damping: 0.0 };
        world.add_constraint(&Constraint::to_world(spring, a, DVec2::new(distance, 0.0))).unwrap();
        let mut picture = Picture::new();
        picture.build(&frame(world), &camera(DVec2::ZERO, 100.0, [600, 400]), &bare(), 1.0);
        let spring = picture.springs()[0];
        (spring.windings, spring.half_width)
    };
    assert_eq!(windings(0.6), windings(2.0));
}

#[test]
fn a_short_spring_is_still_a_coil() {
    // From 8 points on; nearer ones are a dash.
    let kinds = [7.0, 9.0, 14.0, 20.0, 40.0].map(|scale| {
        let mut world = World::new();
        let a = world.add_body(&Body::default()).unwrap();
        let spring = Kind::Spring { rest: 0.9, stiffness: 1.0, damping: 0.0 };
        world.add_constraint(&Constraint::to_world(spring, a, DVec2::X)).unwrap();
        let mut picture = Picture::new();
        picture.build(&frame(world), &camera(DVec2::ZERO, scale, [600, 400]), &bare(), 1.0);
        picture.springs().first().map_or(0.0, |spring| spring.windings)
    });
    assert_eq!(kinds, [0.0, 2.0, 2.0, 4.0, 8.0]);
}

#[test]
fn ranges_belong_to_a_scene_and_stay_while_it_is_paused() {
    let mut world = disc_world(DVec2::ZERO, 0.5);
    let id = world.bodies().id[0];
    let mut at_speed = |speed: f64| {
        world.set_body(id, &Body { velocity: DVec2::new(speed, 0.0), ..Body::default() }).unwrap();
        world.clone()
    };
    let (fast, slow) = (frame(at_speed(8.0)), at_speed(1.0));
    let mut picture = Picture::new();
    let mut range = |frame: &Frame| {
        picture.build(frame, &camera(DVec2::ZERO, 100.0, [600, 400]), &bare(), 1.0);
        picture.speed_range()
    };
    assert_eq!(range(&fast), 10.0);
    let later = |seconds| Instant::now() + std::time::Duration::from_secs(seconds);
    for seconds in [1, 60, 120] {
        assert_eq!(range(&Frame { world: slow.clone(), published: later(seconds), ..fast.clone() }), 10.0);
    }
    let info = SceneInfo { opened: 1, ..SceneInfo::default() };
    assert_eq!(range(&Frame { world: slow, scene: Arc::new(info), ..fast }), 1.0);
}

#[test]
fn a_spring_is_drawn_as_a_coil_of_that_many_windings() {
    let Some(gpu) = gpu() else { return };
    let mut world = World::new();
    let left = Body { motion: Motion::Static, position: DVec2::new(-1.0, 0.0), ..Body::default() };
    let a = world.add_body(&left).unwrap();
    let spring = Kind::Spring { rest: 1.0, stiffness: 1.0, damping: 0.0 };
    world.add_constraint(&Constraint::to_world(spring, a, DVec2::new(1.0, 0.0))).unwrap();
    let view = camera(DVec2::ZERO, 140.0, [400, 200]);
    let image = shoot_world(gpu, &world, &view, &ViewOptions { tension: false, ..bare() }, 1.0);
    let mut picture = Picture::new();
    picture.build(&frame(world), &view, &bare(), 1.0);
    let windings = picture.springs()[0].windings as usize;
    // Along the spring's axis the wire is crossed twice a winding, between the stubs.
    let background = Theme::Dark.palette().background.0;
    let lit: Vec<bool> = (66..334).map(|x| image.pixel(x, 100).unwrap() != background).collect();
    let crossings = lit.windows(2).filter(|pair| pair[0] && !pair[1]).count();
    assert!(crossings.abs_diff(2 * windings) <= 2, "{crossings} crossings of {windings} windings");
}

#[test]
fn ten_thousand_discs_take_one_draw_call() {
    let mut world = World::new();
    for i in 0..10_000 {
        let position = DVec2::new(f64::from(i % 100), f64::from(i / 100));
        world.add_body(&Body { position, radius: 0.4, ..Body::default() }).unwrap();
    }
    let frame = frame(world);
    let view = camera(DVec2::splat(50.0), 6.0, [640, 640]);
    let mut picture = Picture::new();
    picture.build(&frame, &view, &bare(), 1.0);
    assert_eq!(picture.discs().len(), 10_000);
    assert_eq!(picture.draws().len(), 1);
    let start = Instant::now();
    for _ in 0..20 {
        picture.build(&frame, &view, &bare(), 1.0);
    }
    println!("10,000 discs: {:.2} ms to build the picture", start.elapsed().as_secs_f64() * 50.0);
}

#[test]
fn what_is_out_of_sight_is_not_drawn() {
    let mut world = disc_world(DVec2::new(100.0, 0.0), 0.5);
    world.add_wall(&Wall::segment(DVec2::new(50.0, 0.0), DVec2::new(50.0, 9.0))).unwrap();
    world.add_wall(&Wall::block(DVec2::new(-90.0, 0.0), DVec2::new(-80.0, 9.0))).unwrap();
    let mut picture = Picture::new();
    picture.build(&frame(world), &camera(DVec2::ZERO, 100.0, [600, 400]), &bare(), 1.0);
    assert!(picture.draws().is_empty(), "{:?}", picture.draws());
}

#[test]
fn trails_follow_the_selected_bodies_and_start_anew_with_the_scene() {
    let mut world = disc_world(DVec2::ZERO, 0.1);
    world.set_gravity(DVec2::ZERO).unwrap();
    let id = world.bodies().id[0];
    world.set_body(id, &Body { velocity: DVec2::new(6.0, 0.0), radius: 0.1, ..Body::default() }).unwrap();
    let mut frame = frame(world);
    let mut stepper = Stepper::new(Method::default()).unwrap();
    let options = ViewOptions { trails: true, ..bare() };
    let view = camera(DVec2::ZERO, 100.0, [600, 400]);
    let mut picture = Picture::new();
    let mut lines = |frame: &Frame| {
        picture.build(frame, &view, &options, 1.0);
        picture.lines().len()
    };
    assert_eq!(lines(&frame), 0);
    for pieces in 1..=5 {
        stepper.step(&mut frame.world);
        assert_eq!(lines(&frame), pieces);
        assert_eq!(lines(&frame), pieces, "the same state leaves no second point");
    }
    frame.scene = Arc::new(SceneInfo { opened: 1, ..SceneInfo::default() });
    assert_eq!(lines(&frame), 0);
}

#[test]
fn a_trail_goes_through_the_steps_between_two_pictures() {
    let mut world = disc_world(DVec2::new(1.0, 0.0), 0.1);
    let hanger = Constraint::to_world(Kind::Rod { length: 1.0 }, world.bodies().id[0], DVec2::ZERO);
    world.add_constraint(&hanger).unwrap();
    let mut frame = frame(world);
    let mut stepper = Stepper::new(Method::default()).unwrap();
    let options = ViewOptions { trails: true, tension: false, ..bare() };
    let view = camera(DVec2::ZERO, 100.0, [600, 400]);
    let mut picture = Picture::new();
    picture.build(&frame, &view, &options, 1.0);
    for _ in 0..30 {
        stepper.step(&mut frame.world);
        frame.trace.push(&frame.world);
    }
    picture.build(&frame, &view, &options, 1.0);
    // One piece a step, but for the first, which is too short to be drawn, and the rod: the pendulum's arc, a metre from its
    // pivot, and no chord across it.
    assert_eq!(picture.lines().len(), 30);
    let trail = picture.lines().iter().filter(|line| line.ends == Ends::Square as u32);
    // Points on the canvas: 100 of them are a metre, of which the rod may be off by some thousandths.
    let off = trail.map(|line| (line.start[0].hypot(line.start[1]) - 100.0).abs()).fold(0.0, f32::max);
    assert!(off < 0.5, "{off} points beside the arc");
}

#[test]
fn nothing_is_drawn_outside_the_canvas() {
    let Some(gpu) = gpu() else { return };
    let mut picture = Picture::new();
    picture.push_disc(white_disc([0.0, 0.0], 500.0));
    let mut renderer = Renderer::new(&gpu.device, FORMAT);
    let viewport = Viewport { corner: [10.0, 20.0], size: [30.0, 40.0], target: [64, 80], pixels_per_point: 1.0 };
    let image = render(gpu, &mut renderer, &picture, &viewport, |_| {}, |_| {}).unwrap();
    for y in 0..80 {
        for x in 0..64 {
            let inside = (10..40).contains(&x) && (20..60).contains(&y);
            assert_eq!(image.pixel(x, y).unwrap() == [255; 4], inside, "pixel {x}, {y}");
        }
    }
    // A canvas wholly off the target, as during a resize, draws nothing and breaks nothing.
    let viewport = Viewport { corner: [100.0, 0.0], ..viewport };
    let image = render(gpu, &mut renderer, &picture, &viewport, |_| {}, |_| {}).unwrap();
    assert_eq!(differing(&image, picture.background()), 0);
}

#[test]
fn a_hook_draws_over_the_scene() {
    let Some(gpu) = gpu() else { return };
    let mut renderer = Renderer::new(&gpu.device, FORMAT);
    let mut picture = Picture::new();
    picture.push_disc(white_disc([0.0, 0.0], 500.0));
    let red = Colour::hex(0xFF0000);
    let image = render(
        gpu,
        &mut renderer,
        &picture,
        &Viewport::whole([16, 16], 1.0),
        |_| {},
        |canvas| {
            drop(begin_scene(canvas.encoder, canvas.target, red));
        },
    );
    assert_eq!(differing(&image.unwrap(), red), 0);
}

#[test]
fn selection_and_tools_show_the_accent() {
    let Some(gpu) = gpu() else { return };
    let (world, ball) = playground();
    let view = camera(DVec2::new(0.0, 1.0), 80.0, [400, 300]);
    let accent = Theme::Dark.palette().accent.0;
    let count = |options: &ViewOptions| {
        shoot_world(gpu, &world, &view, options, 1.0).rgba.chunks_exact(4).filter(|pixel| *pixel == accent).count()
    };
    assert_eq!(count(&bare()), 0);
    assert!(count(&ViewOptions { selected: vec![ball], ..bare() }) > 50);
    let snap = Extra::Snap { at: DVec2::new(0.0, 2.0) };
    assert!(count(&ViewOptions { extra: vec![snap], ..bare() }) > 5);
}

#[test]
fn a_picture_of_an_impossible_size_or_path_is_refused_with_a_reason() {
    let Some(gpu) = gpu() else { return };
    let mut renderer = Renderer::new(&gpu.device, FORMAT);
    let picture = Picture::new();
    for target in [[0, 10], [10, 1_000_000]] {
        let error = render(gpu, &mut renderer, &picture, &Viewport::whole(target, 1.0), |_| {}, |_| {}).unwrap_err();
        assert!(error.to_string().contains("each side must be between 1 and"), "{error}");
    }
    let image = shoot(gpu, &picture, [8, 8], 1.0);
    let folder = tempfile::tempdir().unwrap();
    let nowhere = folder.path().join("missing").join("picture.png");
    let error = image.write_png(&nowhere).unwrap_err().to_string();
    assert!(error.contains("picture.png") && error.contains("could not be written"), "{error}");
    let path = folder.path().join("picture.png");
    image.write_png(&path).unwrap();
    let decoder = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(&path).unwrap()));
    let mut reader = decoder.read_info().unwrap();
    let mut rgba = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut rgba).unwrap();
    assert_eq!(rgba, image.rgba);
}

#[test]
fn both_themes_tell_bodies_walls_and_grid_from_the_canvas() {
    let Some(gpu) = gpu() else { return };
    let (world, _) = playground();
    let view = camera(DVec2::new(0.0, 1.0), 80.0, [400, 300]);
    for theme in [Theme::Dark, Theme::Light] {
        let image = shoot_world(gpu, &world, &view, &ViewOptions { theme, ..ViewOptions::default() }, 1.0);
        let palette = theme.palette();
        let count = |colour: Colour| image.rgba.chunks_exact(4).filter(|pixel| *pixel == colour.0).count();
        assert!(count(palette.background) > 20_000);
        assert!(count(palette.grid_major) > 200 && count(palette.axis) > 200);
        assert!(count(palette.wall_fill) > 1_000 && count(palette.wall_hatch) > 100);
        assert!(palette.bodies.iter().map(|colour| count(*colour)).sum::<usize>() > 500);
        let file = format!("scene_{theme:?}.png").to_lowercase();
        image.write_png(&std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(file)).unwrap();
    }
}

/// One of everything, by hand; also the id of a ball.
fn playground() -> (World, Id) {
    let mut world = World::new();
    world.add_wall(&Wall::block(DVec2::new(-4.0, -1.5), DVec2::new(4.0, -0.5))).unwrap();
    world.add_wall(&Wall::segment(DVec2::new(0.8, -0.5), DVec2::new(2.2, 0.2))).unwrap();
    let pin =
        |x: f64, y: f64| Body { motion: Motion::Static, position: DVec2::new(x, y), radius: 0.05, ..Body::default() };
    let mut last = world.add_body(&pin(-2.0, 2.0)).unwrap();
    for i in 1..=12 {
        let x = f64::from(i) / 12.0;
        let position = DVec2::new(-2.0 + 2.4 * x, 2.0 - 2.4 * x * (1.0 - x));
        let next =
            if i == 12 { pin(position.x, position.y) } else { Body { position, radius: 0.04, ..Body::default() } };
        let next = world.add_body(&next).unwrap();
        world.add_constraint(&Constraint::between(Kind::Rod { length: 0.21 }, last, next)).unwrap();
        last = next;
    }
    let spin = Some(Spin { angle: 0.7, omega: 1.0 });
    let ball =
        Body { position: DVec2::new(-1.0, -0.1), radius: 0.4, spin, velocity: DVec2::new(1.0, 0.5), ..Body::default() };
    let ball = world.add_body(&ball).unwrap();
    let weight = world.add_body(&Body { position: DVec2::new(1.4, 1.0), radius: 0.15, ..Body::default() }).unwrap();
    let spring = Kind::Spring { rest: 1.0, stiffness: 100.0, damping: 0.0 };
    world.add_constraint(&Constraint::to_world(spring, weight, DVec2::new(1.4, 2.4))).unwrap();
    let bob = world.add_body(&Body { position: DVec2::new(0.9, 1.6), radius: 0.08, ..Body::default() }).unwrap();
    world.add_constraint(&Constraint::between(Kind::Rope { length: 1.0 }, last, bob)).unwrap();
    world.set_grip(Some(Grip::new(ball, DVec2::new(0.1, 0.2), DVec2::new(-0.5, 0.7), 1.0))).unwrap();
    (world, ball)
}
