//! Scene files: the shipped ones build, wrong ones give one message in place, written ones come back with the same bits.

use proptest::prelude::*;
use std::fs::File;
use tautline::engine::{Constraint, DVec2, Kind, Motion, Stepper};
use tautline::scene::{
    self, BodyEntry, BodyFields, ConstraintEntry, Document, End, Generator, Place, SceneError, Settings, Setup, Truth,
    View, WallEntry,
};

#[test]
fn every_shipped_scene_builds_and_explains_itself() {
    for shipped in every_scene() {
        let setup = open(shipped.name);
        assert_eq!(setup.title, shipped.title, "the list and the file of {} agree", shipped.name);
        assert!(setup.about.ends_with('.'), "{} says what to try", shipped.name);
        assert!(setup.view.is_some(), "{} says what to show", shipped.name);
        assert!(!setup.world.bodies().is_empty());
    }
    assert_eq!(scene::shipped()[0].name, "bridge", "the scene that opens by itself comes first");
}

/// The scenes of every section.
fn every_scene() -> impl Iterator<Item = &'static scene::Shipped> {
    scene::every_scene().iter()
}

#[test]
fn names_of_shipped_scenes_differ_and_those_without_a_known_motion_name_none() {
    let mut names: Vec<&str> = every_scene().map(|scene| scene.name).collect();
    names.sort_unstable();
    assert!(names.windows(2).all(|pair| pair[0] != pair[1]));
    assert!(scene::shipped().iter().all(|scene| open(scene.name).truth.is_none()));
    assert!(scene::truth_scenes().iter().all(|scene| open(scene.name).truth.is_some_and(|truth| truth.form.is_none())));
    for scene in every_scene() {
        let setup = open(scene.name);
        assert_eq!(setup.truth.is_some(), setup.known_motion().is_some(), "{}", scene.name);
    }
}

/// File, line, column and a part of the message. One mistake a file.
const BROKEN: &[(&str, usize, usize, &str)] = &[
    ("absurd_density", 3, 42, "a mass between 1e-12 and 1e12 kg"),
    ("absurd_mass", 3, 29, "found mass 1e300"),
    ("anchor_on_particle", 4, 39, "`at_a` on an end that does not turn"),
    ("bad_escape", 3, 17, "for a backslash"),
    ("binary", 1, 10, "not UTF-8"),
    ("control_characters", 1, 14, "found `\\u{1b}`"),
    ("deep", 1, 23, "found `[`"),
    ("deep_end", 1, 36, "found `(`"),
    ("dotted_name", 3, 25, "without dots"),
    ("duplicate_field", 3, 39, "a second `mass`"),
    ("duplicate_name", 5, 38, "a second \"ball\""),
    ("empty", 1, 1, "an empty file"),
    ("flat_view", 3, 36, "found height 0.0"),
    ("fraction_for_count", 3, 27, "expected a whole number"),
    ("full_pile", 3, 30, "room for 25"),
    ("future_version", 3, 14, "update tautline"),
    ("huge_cloth", 5, 9, "at most 1000000 bodies"),
    ("infinite_position", 3, 33, "found position inf"),
    ("inside_out_box", 3, 22, "with min left of max"),
    ("latin1", 3, 16, "the byte 0xe9"),
    ("list_without_brackets", 3, 13, "expected a list in [ ]"),
    ("mass_and_density", 3, 37, "a mass and a density"),
    ("missing_body", 6, 19, "Did you mean \"ball\"?"),
    ("missing_comma", 3, 5, "expected a comma"),
    ("missing_node", 4, 26, "rope.0 to rope.4"),
    ("nan_mass", 5, 38, "found mass NaN"),
    ("negative_count", 3, 28, "`-3`, which is out of range"),
    ("negative_mass", 6, 31, "found mass -2.0"),
    ("negative_stiffness", 4, 59, "found stiffness -5.0"),
    ("no_end", 5, 33, "found no `b`"),
    ("no_substeps", 3, 34, "between 1 and 1000"),
    ("no_version", 4, 1, "Write `version: 1,`"),
    ("not_ron", 1, 1, "as in `(version: 1)`"),
    ("number_for_end", 3, 26, "the name of a body in quotes"),
    ("number_with_unit", 4, 26, "without units"),
    ("only_comment", 2, 1, "the end of the file"),
    ("open_comment", 5, 1, "the end `*/`"),
    ("open_text", 3, 13, "closing quote"),
    ("particle_with_spin", 3, 48, "Write Disc"),
    ("point_of_one", 3, 31, "Write a point as (1.0, 2.0)"),
    ("point_of_three", 3, 36, "found `5`"),
    ("point_without_brackets", 3, 29, "a point such as (1.0, 2.0)"),
    ("rod_without_length", 4, 19, "rod length 0.0"),
    ("same_ends", 4, 37, "two different ends"),
    ("short_chord", 3, 54, "found chord 0.5"),
    ("short_line", 3, 26, "at least two points"),
    ("text_for_number", 4, 38, "found the text \"heavy\""),
    ("timeless_truth", 3, 22, "between 1/60 and 3600 s"),
    ("trailing", 2, 1, "`and` after the end"),
    ("truth_without_length", 3, 24, "Add `length: …`"),
    ("unclosed", 5, 1, "Close every bracket"),
    ("unfit_form", 3, 42, "no wall under it"),
    ("unknown_attribute", 1, 16, "scenes need none"),
    ("unknown_field", 4, 32, "Did you mean `mass`?"),
    ("unknown_form", 3, 42, "Did you mean `Bounce`?"),
    ("unknown_integrator", 3, 28, "Did you mean `VelocityVerlet`?"),
    ("unknown_kind", 4, 9, "Did you mean `Bridge`?"),
    ("unknown_setting", 4, 9, "Did you mean `gravity`?"),
    ("unknown_top_field", 3, 5, "the unknown field `colour`"),
    ("version_zero", 1, 11, "found version 0"),
];

#[test]
fn every_broken_scene_gets_one_message_at_the_place_of_its_mistake() {
    for (name, line, column, phrase) in BROKEN {
        let file = format!("tests/broken_scenes/{name}.ron");
        let error = scene::open(&file).expect_err(name);
        assert_eq!(error.place, Place::Text { file, line: *line, column: *column }, "{error}");
        let message = error.to_string();
        assert!(message.contains(phrase), "{message:?} does not contain {phrase:?}");
        assert!(
            message.contains("found ") && message.contains("expected ") && message.ends_with(['.', '?']),
            "{message}"
        );
        assert!(message.len() < 500 && !message.contains('\n'), "one line a person can read: {message}");
    }
}

#[test]
fn the_corpus_and_its_table_hold_the_same_files() {
    let files = std::fs::read_dir("tests/broken_scenes").expect("the corpus");
    let mut files: Vec<String> = files.map(|file| file.expect("a file").file_name().to_string_lossy().into()).collect();
    files.sort();
    let table: Vec<String> = BROKEN.iter().map(|(name, ..)| format!("{name}.ron")).collect();
    assert_eq!(files, table);
}

#[test]
fn files_that_are_no_scenes_are_refused_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    let missing = folder.path().join("missing.ron");
    assert_refused(&missing.display().to_string(), "no such file");
    assert_refused(&folder.path().display().to_string(), "found a folder");
    assert_refused("brigde", "Did you mean `bridge`?");
    assert_refused("", "no such file");
    let large = folder.path().join("large.ron");
    // A hole in the disk: 50 MB long, but nothing is read of it.
    File::create(&large).and_then(|file| file.set_len(50_000_000)).expect("a large file");
    assert_refused(&large.display().to_string(), "more than 16 MB");
}

fn assert_refused(path: &str, phrase: &str) {
    let error = scene::open(path).expect_err(phrase);
    assert_eq!(error.place, Place::File(path.to_owned()));
    assert!(error.to_string().contains(phrase), "{error}");
}

#[test]
#[cfg(unix)]
fn a_device_or_a_pipe_is_refused_without_waiting_for_it() {
    assert_refused("/dev/zero", "a pipe or a device");
    let folder = tempfile::tempdir().expect("a folder");
    assert_refused(&pipe_in(&folder).display().to_string(), "a pipe or a device");
}

fn pipe_in(folder: &tempfile::TempDir) -> std::path::PathBuf {
    let pipe = folder.path().join("pipe.ron");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status().expect("mkfifo runs");
    assert!(made.success());
    pipe
}

#[test]
fn errors_of_a_document_without_text_name_its_part() {
    let wrong = BodyEntry::Disc(BodyFields { mass: Some(f64::NAN), ..BodyFields::default() });
    let document = Document { bodies: vec![BodyEntry::Disc(BodyFields::default()), wrong], ..Document::default() };
    let error = document.build().expect_err("a mass that is not a number");
    assert_eq!(error.place, Place::Part("scene.bodies[1].mass".to_owned()));
}

#[test]
fn numbers_that_are_none_are_found_in_the_field_where_they_stand() {
    let generators = [
        ("Rope", ["from", "to"]),
        ("Bridge", ["from", "to"]),
        ("Pile", ["min", "max"]),
        ("Cloth", ["corner"; 2]),
        ("Net", ["corner"; 2]),
        ("Stack", ["base"; 2]),
        ("SoftBody", ["centre"; 2]),
        ("Cradle", ["centre"; 2]),
    ];
    for (generator, fields) in generators {
        for (field, point) in fields.iter().zip(["(NaN, 0)", "(0, -1e308)"]) {
            let text = format!("(version: 1, generators: [{generator}({field}: {point})])");
            let message = scene::parse("a.ron", &text).expect_err("no place for a body").to_string();
            let column = text.find(point).expect("the point") + 1;
            assert!(message.starts_with(&format!("a.ron:1:{column}: found {field} ")), "{text}: {message}");
        }
    }
    for field in ["hz", "baumgarte", "accuracy", "drag"] {
        let text = format!("(version: 1, settings: ({field}: NaN))");
        let message = scene::parse("a.ron", &text).expect_err("no setting").to_string();
        let column = text.find("NaN").expect("the number") + 1;
        assert!(message.starts_with(&format!("a.ron:1:{column}: found {field} NaN")), "{message}");
    }
    for generator in ["Cradle(radius: NaN)", "Cradle(balls: 1, radius: 1e308)", "Stack(radius: inf)"] {
        let text = format!("(version: 1, generators: [{generator}])");
        let message = scene::parse("a.ron", &text).expect_err("no radius").to_string();
        assert!(message.contains("found radius ") && message.contains("between 0 and 1000000 m"), "{message}");
    }
}

#[test]
fn a_box_of_the_wrong_width_is_told_both_limits() {
    for (min, max) in [("(-1e9, 0)", "(1e9, 1)"), ("(1, 0)", "(0, 1)"), ("(0, 1)", "(1, 0)"), ("(0, -1e9)", "(1, 1e9)")]
    {
        let text = format!("(version: 1, walls: [Box(min: {min}, max: {max})])");
        let message = scene::parse("a.ron", &text).expect_err("no box").to_string();
        assert!(message.contains("between 1e-9 and 1e9 m, with min "), "{message}");
    }
}

#[test]
fn names_that_fill_pages_are_not_printed_whole() {
    let long = "ä".repeat(10_000);
    for text in [
        format!("bodies: [Particle(name: \"{long}\"), Particle(name: \"{long}\")]"),
        format!("bodies: [Particle(name: \"{long}.\")]"),
        format!("bodies: [Particle()], constraints: [Rod(a: \"{long}\", b: (0, 0))]"),
        format!("bodies: [Particle(name: \"{long}\")], constraints: [Rod(a: \"other\", b: (0, 0))]"),
        format!("bodies: [Particle(name: \"{long}\")], constraints: [Rod(a: \"{long}.1\", b: (0, 0))]"),
        format!("generators: [Rope(name: \"{long}\")], constraints: [Rod(a: \"{long}.9999\", b: (0, 0))]"),
        format!("{long}: 3"),
        format!("bodies: [{long}()]"),
        format!("settings: {long}(drag: 1)"),
        format!("settings: (drag: \"{long}\")"),
        format!("settings: (solver: \"{long}\")"),
        format!("bodies: [Particle()], constraints: [Rod(a: \"\", b: {long})]"),
    ] {
        let message = scene::parse("a.ron", &format!("(version: 1, {text})")).expect_err("a mistake").to_string();
        assert!(message.chars().count() < 400, "{} characters: {message}", message.chars().count());
    }
}

#[test]
fn generators_make_the_bodies_and_constraints_that_they_promise() {
    let counts = |text: &str| {
        let setup = parse(&format!("(version: 1, generators: [{text}])"));
        [setup.world.bodies().len(), setup.world.constraints().len()]
    };
    assert_eq!(counts("Rope(links: 7)"), [8, 7]);
    assert_eq!(counts("Bridge(links: 40)"), [41, 40]);
    // 3 rows of 3 threads, 4 columns of 2, and two diagonals in each of 6 fields
    assert_eq!(counts("Cloth(columns: 4, rows: 3)"), [12, 9 + 8 + 12]);
    assert_eq!(counts("Cloth(columns: 4, rows: 3, diagonals: false)"), [12, 9 + 8]);
    assert_eq!(counts("Net(columns: 4, rows: 3)"), [12, 9 + 8]);
    // ring, second neighbours, third points, opposite pairs
    assert_eq!(counts("SoftBody(nodes: 12)"), [12, 12 + 12 + 12 + 6]);
    assert_eq!(counts("SoftBody(nodes: 13, filling: Wheel)"), [14, 13 * 5]);
    assert_eq!(counts("Stack(count: 3)"), [3, 0]);
    assert_eq!(counts("Pile(count: 50)"), [50, 0]);
    assert_eq!(counts("Cradle(balls: 4)"), [4, 4]);
}

#[test]
fn the_discs_of_a_pile_do_not_overlap_and_follow_the_seed() {
    let pile = |seed: u32| parse(&format!("(version: 1, generators: [Pile(count: 200, seed: {seed})])")).world;
    let world = pile(5);
    let bodies = world.bodies();
    for i in 0..bodies.len() {
        assert!((0.05..0.1).contains(&bodies.radius[i]));
        for j in 0..i {
            let gap = (bodies.position[i] - bodies.position[j]).length() - bodies.radius[i] - bodies.radius[j];
            // Cells touch at most at a point; rounding of a coordinate of a few metres is below 1e-14.
            assert!(gap > -1e-14, "discs {i} and {j} overlap by {}", -gap);
        }
    }
    assert_eq!(world, pile(5));
    assert_ne!(world, pile(6));
}

#[test]
fn constraints_refer_to_nodes_by_name() {
    let setup = parse(
        r#"(version: 1,
            bodies: [Disc(name: "ball", position: (3, 1), angle: 1.5707963267948966, radius: 0.5)],
            generators: [Rope(name: "rope", links: 4), Cloth(name: "cloth", columns: 3, rows: 2)],
            constraints: [Rod(a: "rope.4", b: "cloth.1.1"), Rod(a: "ball", at_a: (0.5, 0), b: (3, 5))])"#,
    );
    let (world, first) = (&setup.world, setup.world.constraints().len() - 2);
    let (a, b) = world.ends(first);
    assert_eq!(a, DVec2::new(2.0, 0.0), "the end of the rope");
    assert_eq!(b, DVec2::new(0.1, -0.1), "second column, second row");
    let (anchor, _) = world.ends(first + 1);
    // The anchor is on the disc's own x axis, which points up; a quarter turn in doubles is right to an ulp.
    assert!((anchor - DVec2::new(3.0, 1.5)).length() < 1e-15, "{anchor}");
}

#[test]
fn rows_of_a_net_with_a_chord_lie_on_a_circle() {
    let world = parse("(version: 1, generators: [Net(columns: 8, rows: 2, spacing: 0.1, chord: 0.6)])").world;
    let row = &world.bodies().position[..8];
    assert_eq!((row[0], row[7]), (DVec2::ZERO, DVec2::new(0.6, 0.0)));
    // Coordinates below a metre: an ulp or two of 1e-16 each.
    row.windows(2).for_each(|pair| assert!(((pair[1] - pair[0]).length() - 0.1).abs() < 1e-15));
    let turn = |k: usize| (row[k + 1] - row[k]).angle_to(row[k + 2] - row[k + 1]);
    (0..6).for_each(|k| assert!(turn(k) > 0.1 && (turn(k) - turn(0)).abs() < 1e-13, "hangs down, bends evenly"));
}

#[test]
fn pins_of_a_grid_are_where_they_are_asked_for() {
    let pinned = |pins: &str| {
        let setup = parse(&format!("(version: 1, generators: [Net(columns: 5, rows: 3, pins: {pins})])"));
        let motion = &setup.world.bodies().motion;
        (0..motion.len()).filter(|&i| motion[i] == Motion::Static).collect::<Vec<_>>()
    };
    assert_eq!(pinned("Corners"), [0, 4]);
    assert_eq!(pinned("Top"), [0, 1, 2, 3, 4]);
    assert_eq!(pinned("TopCentre(3)"), [1, 2, 3]);
    assert_eq!(pinned("TopCentre(4294967295)"), [0, 1, 2, 3, 4]);
    assert_eq!(pinned("None"), [0_usize; 0]);
}

#[test]
fn a_document_comes_back_from_its_text_unchanged() {
    for shipped in every_scene() {
        let document = Document::from_text(shipped.name, shipped.text).unwrap_or_else(|error| panic!("{error}"));
        let again = Document::from_text(shipped.name, &scene::to_ron(&document));
        assert_eq!(Ok(document), again, "{}", shipped.name);
    }
}

#[test]
fn a_captured_world_comes_back_with_the_same_bits() {
    for shipped in every_scene() {
        let mut setup = open(shipped.name);
        let mut stepper = Stepper::new(setup.method).expect("a sound method");
        for _ in 0..20 {
            stepper.step(&mut setup.world);
        }
        let text = scene::to_ron(&scene::capture(&setup));
        let again = scene::parse(shipped.name, &text).unwrap_or_else(|error| panic!("{error}"));
        assert_same_bits(&setup, &again);
        assert_eq!(scene::to_ron(&scene::capture(&again)), text, "{}", shipped.name);
    }
}

#[test]
fn a_captured_world_keeps_the_names_of_its_bodies() {
    let setup = parse(
        "(version: 1,
        bodies: [Particle(name: \"b1\"), Particle(position: (1, 0)), Disc(name: \"line_0\", position: (2, 0))],
        generators: [Rope(name: \"line\", from: (0, 5), to: (1, 5), links: 1), Cloth(name: \"net\", columns: 2, rows: 2)],
        constraints: [Rod(a: \"b1\", b: \"line.1\")])",
    );
    let mut world = setup.world.clone();
    let unnamed = world.bodies().id[1];
    world.add_constraint(&Constraint::to_world(Kind::Rod { length: 1.0 }, unnamed, DVec2::ZERO)).expect("a sound rod");
    let document = scene::capture(&Setup { world, ..setup });
    let names: Vec<&str> = document
        .bodies
        .iter()
        .map(|entry| match entry {
            BodyEntry::Particle(fields) | BodyEntry::Disc(fields) => fields.name.as_deref().unwrap_or("none"),
        })
        .collect();
    assert_eq!(names, ["b1", "b1_", "line_0", "line_0_", "line_1", "net_0_0", "net_1_0", "net_0_1", "net_1_1"]);
    document.build().expect("names that are used once");
}

fn assert_same_bits(one: &Setup, two: &Setup) {
    let bits = |setup: &Setup| {
        let (bodies, constraints) = (setup.world.bodies(), setup.world.constraints());
        let spins = (0..bodies.len()).flat_map(|i| bodies.spin(i)).flat_map(|spin| [spin.angle, spin.omega]);
        let vectors = [&bodies.position, &bodies.velocity, &constraints.at_a, &constraints.at_b];
        let vectors = vectors.into_iter().flatten().flat_map(|v| [v.x, v.y]);
        let scalars =
            [&bodies.mass, &bodies.radius, &bodies.restitution, &bodies.friction].into_iter().flatten().copied();
        spins.chain(vectors).chain(scalars).map(f64::to_bits).collect::<Vec<u64>>()
    };
    assert_eq!(bits(one), bits(two), "{}", one.name);
    let (a, b) = (&one.world, &two.world);
    assert_eq!(a.constraints().kind, b.constraints().kind);
    assert_eq!([&a.constraints().a, &a.constraints().b], [&b.constraints().a, &b.constraints().b]);
    assert_eq!(a.walls(), b.walls());
    assert_eq!((&a.bodies().motion, &a.bodies().group), (&b.bodies().motion, &b.bodies().group));
    assert_eq!((a.gravity(), a.drag(), a.tuning()), (b.gravity(), b.drag(), b.tuning()));
    assert_eq!((one.method, one.view, &one.about), (two.method, two.view, &two.about));
    // What moved on may no longer be at the start of the closed form that it names.
    let dropped = two.truth.is_none() && one.truth.is_some_and(|truth| truth.form.is_some());
    assert!(one.truth == two.truth || dropped, "{}: {:?}", one.name, two.truth);
}

#[test]
fn saving_replaces_the_file_whole_or_leaves_it_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mine.ron");
    let document = scene::capture(&open("rope"));
    scene::save(&path, &document).expect("a place to write");
    scene::save(&path, &document).expect("a file to replace");
    assert_eq!(open(&path.display().to_string()).world.bodies().len(), 51);
    let names: Vec<_> =
        std::fs::read_dir(&folder).expect("the folder").map(|file| file.expect("a file").file_name()).collect();
    assert_eq!(names, ["mine.ron"], "nothing else is left behind");
}

#[test]
#[cfg(unix)]
fn saving_through_a_link_replaces_what_it_leads_to_and_keeps_its_permissions() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    std::fs::create_dir(at("deep")).expect("a folder in it");
    symlink("deep/second", at("first")).expect("a link");
    symlink("../mine.ron", at("deep/second")).expect("a link to a file that is not there yet");
    let document = scene::capture(&open("rope"));
    scene::save(&at("first"), &document).expect("a place to write");
    std::fs::set_permissions(at("mine.ron"), PermissionsExt::from_mode(0o640)).expect("own permissions");
    scene::save(&at("first"), &document).expect("a file to replace");
    assert!(at("first").is_symlink() && at("deep/second").is_symlink());
    let about = at("mine.ron").symlink_metadata().expect("the file that the links lead to");
    assert!(about.is_file());
    assert_eq!(about.permissions().mode() & 0o777, 0o640);
    assert_eq!(open(&at("first").display().to_string()).world.bodies().len(), 51);
    assert_eq!(std::fs::read_dir(at("deep")).expect("the folder").count(), 1, "nothing else is left behind");
}

#[test]
fn saving_leaves_alone_what_is_not_to_be_replaced() {
    let folder = tempfile::tempdir().expect("a folder");
    let refused = |path: &std::path::Path, phrase: &str| {
        let message = scene::save(path, &Document::default()).expect_err("not to be replaced").to_string();
        assert!(message.contains(phrase) && message.contains("Choose another name."), "{message}");
    };
    let path = folder.path().join("kept.ron");
    std::fs::write(&path, "kept").expect("a file");
    let mut permissions = path.metadata().expect("the file").permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(&path, permissions).expect("own permissions");
    refused(&path, "a file that is read-only");
    assert_eq!(std::fs::read_to_string(&path).expect("the file"), "kept");
    if cfg!(unix) {
        refused(&pipe_in(&folder), "a pipe or a device");
    }
}

#[test]
fn a_name_as_long_as_names_can_be_is_saved_to() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a".repeat(251) + ".ron");
    scene::save(&path, &Document::default()).expect("255 bytes, which every file system of today takes");
    assert!(path.is_file());
}

#[test]
fn saving_where_nothing_can_be_saved_says_why() {
    let folder = tempfile::tempdir().expect("a folder");
    let save =
        |path: &std::path::Path| scene::save(path, &Document::default()).expect_err("no place to write").to_string();
    assert!(save(&folder.path().join("missing/mine.ron")).contains("no such folder"));
    assert!(save(folder.path()).contains("a folder of that name"));
    assert!(save(std::path::Path::new("/proc/mine.ron")).contains("expected a place for the file"));
}

fn open(name: &str) -> Setup {
    scene::open(name).unwrap_or_else(|error| panic!("{error}"))
}

fn parse(text: &str) -> Setup {
    scene::parse("text", text).unwrap_or_else(|error| panic!("{error}"))
}

/// Any error about a text must say where.
fn has_position(result: &Result<Setup, SceneError>, text: &str) -> bool {
    match result {
        Ok(_) => true,
        Err(SceneError { place: Place::Text { line, column, .. }, .. }) => {
            let lines: Vec<&str> = text.split('\n').collect();
            *line >= 1 && *line <= lines.len() && *column >= 1 && *column <= lines[line - 1].chars().count() + 1
        }
        Err(_) => false,
    }
}

/// Numbers of every kind that a file can hold.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -10.0..10.0,
        1 => any::<f64>(),
        1 => prop::sample::select(vec![0.0, -0.0, 1.0, 1e-300, 1e300, f64::INFINITY, f64::NAN]),
    ]
}

fn point() -> impl Strategy<Value = DVec2> {
    (number(), number()).prop_map(|(x, y)| DVec2::new(x, y))
}

fn name() -> impl Strategy<Value = String> {
    prop::sample::select(vec!["a", "b", "rope", "rope.3", "net.1.2", "", "Ünï", "a \"b\"\n"]).prop_map(str::to_owned)
}

fn body() -> impl Strategy<Value = BodyEntry> {
    let properties = (prop::option::of(name()), point(), point(), prop::option::of(number()), number(), any::<u32>());
    (properties, any::<bool>(), prop::option::of(number())).prop_map(|(properties, turns, omega)| {
        let (name, position, velocity, mass, radius, group) = properties;
        let fields = BodyFields { name, position, velocity, mass, radius, group, omega, ..BodyFields::default() };
        if turns { BodyEntry::Disc(fields) } else { BodyEntry::Particle(fields) }
    })
}

fn end() -> impl Strategy<Value = End> {
    prop_oneof![name().prop_map(End::Body), point().prop_map(End::Point)]
}

fn constraint() -> impl Strategy<Value = ConstraintEntry> {
    (end(), prop::option::of(point()), end(), prop::option::of(number()), number(), 0..4).prop_map(
        |(a, at_a, b, length, stiffness, kind)| match kind {
            0 => ConstraintEntry::Rod { a, at_a, b, at_b: None, length },
            1 => ConstraintEntry::Rope { a, at_a, b, at_b: None, length },
            2 => ConstraintEntry::Spring { a, at_a, b, at_b: None, rest: length, stiffness, damping: stiffness },
            _ => ConstraintEntry::Pin { a, at_a, b, at_b: None },
        },
    )
}

fn wall() -> impl Strategy<Value = WallEntry> {
    (prop::collection::vec(point(), 0..4), point(), point(), number(), 0..3).prop_map(
        |(points, from, to, friction, kind)| match kind {
            0 => WallEntry::Segment { from, to, restitution: 0.0, friction },
            1 => WallEntry::Box { min: from, max: to, restitution: friction, friction },
            _ => WallEntry::Line { points, restitution: 0.0, friction },
        },
    )
}

fn generator() -> impl Strategy<Value = Generator> {
    (name(), 0..30_u32, number(), 0..8).prop_map(|(name, count, size, kind)| {
        let text = match kind {
            0 => format!("Rope(name: {name:?}, links: {count}, mass: {size:?})"),
            1 => format!("Bridge(name: {name:?}, links: {count}, sag: {size:?})"),
            2 => format!("Cloth(name: {name:?}, columns: {count}, rows: {count}, spacing: {size:?})"),
            3 => format!("SoftBody(name: {name:?}, nodes: {count}, radius: {size:?})"),
            4 => format!("Net(name: {name:?}, columns: {count}, rows: 2, pins: TopCentre({count}), spacing: {size:?})"),
            5 => format!("Stack(name: {name:?}, count: {count}, radius: {size:?})"),
            6 => format!("Pile(name: {name:?}, count: {count}, radius: (0.1, {size:?}))"),
            _ => format!("Cradle(name: {name:?}, balls: {count}, angle: {size:?})"),
        };
        let document = Document::from_text("generator", &format!("(version: 1, generators: [{text}])"));
        document.unwrap_or_else(|error| panic!("{error}: {text}")).generators.remove(0)
    })
}

fn document() -> impl Strategy<Value = Document> {
    let lists = (
        prop::collection::vec(body(), 0..5),
        prop::collection::vec(generator(), 0..3),
        prop::collection::vec(constraint(), 0..5),
        prop::collection::vec(wall(), 0..3),
    );
    (lists, point(), number(), number()).prop_map(|((bodies, generators, constraints, walls), gravity, hz, height)| {
        Document {
            title: "Drawn at random \"\\".to_owned(),
            view: Some(View { centre: gravity, height }),
            truth: Some(Truth { seconds: hz, length: height, form: None }),
            settings: Settings { gravity, hz, ..Settings::default() },
            bodies,
            generators,
            constraints,
            walls,
            ..Document::default()
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_bytes_are_refused_in_place(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let text = String::from_utf8_lossy(&bytes).into_owned();
        prop_assert!(has_position(&scene::parse("random", &text), &text));
    }

    #[test]
    fn random_brackets_and_words_are_refused_in_place(
        words in prop::collection::vec(prop::sample::select(vec![
            "(", ")", "[", "]", "{", "}", ",", ":", "\"", "'", "r#", "//", "/*", "*/", "\n", " ", "-", "1", "0.5", "NaN",
            "version", "bodies", "Disc", "Some", "#![enable(", "é", "\\", "constraints", "Rod", "a", "version: 1,",
        ]), 0..40),
    ) {
        let text = words.concat();
        prop_assert!(has_position(&scene::parse("random", &text), &text));
    }

    #[test]
    fn a_shipped_scene_with_a_random_change_builds_or_is_refused_in_place(
        which in 0..scene::shipped().len(),
        place in any::<prop::sample::Index>(),
        removed in 0..12_usize,
        added in "[-(){}\\[\\],:\"'a-z0-9.#/* \n]{0,6}",
    ) {
        let mut letters: Vec<char> = scene::shipped()[which].text.chars().collect();
        let start = place.index(letters.len());
        letters.splice(start..(start + removed).min(letters.len()), added.chars());
        let text: String = letters.into_iter().collect();
        prop_assert!(has_position(&scene::parse("changed", &text), &text), "{}", text);
    }

    #[test]
    fn a_random_document_comes_back_and_builds_or_is_refused_in_place(document in document()) {
        let text = scene::to_ron(&document);
        let again = Document::from_text("random", &text);
        // NaN is not equal to itself, hence the comparison of what is written.
        prop_assert_eq!(again.as_ref().map(scene::to_ron), Ok(text.clone()));
        let built = scene::parse("random", &text);
        prop_assert!(has_position(&built, &text));
        prop_assert_eq!(built.is_ok(), document.build().is_ok());
    }
}

#[test]
#[cfg(unix)]
fn many_generators_are_read_in_a_time_that_grows_with_their_number() {
    let cpu = || {
        let now = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
        now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
    };
    let kinds: [fn(usize) -> String; 4] = [
        |i| format!("Rope(name: \"rope{i}\", from: ({i}, 0), to: ({i}, -1), links: 1)"),
        |i| format!("Stack(name: \"stack{i}\", base: ({i}, 0), count: 1)"),
        |i| format!("Cloth(corner: ({i}, 0), columns: 2, rows: 2)"),
        |i| format!("SoftBody(centre: ({i}, 0), nodes: 6)"),
    ];
    for kind in kinds {
        let seconds = |count: usize, last: &str| {
            let all: Vec<String> = (0..count).map(kind).chain([last.to_owned()]).collect();
            let text = format!("(version: 1, generators: [{}])", all.join(",\n"));
            let begun = cpu();
            let built = scene::parse("many.ron", &text);
            assert_eq!(built.is_ok(), last == "Rope()", "{:?}", built.err());
            cpu() - begun
        };
        // The last one good, and with a mistake that is to be found.
        for last in ["Rope()", "Rope(links: 0)"] {
            let [few, many] = [2_000, 20_000].map(|count| (0..2).map(|_| seconds(count, last)).fold(1e9, f64::min));
            println!("{} … {last}: {few:.3} s, ten times as many {many:.3} s", kind(0));
            // 10 if it grows with their number, 100 with its square.
            assert!(many < 30.0 * few.max(0.002), "{few} s, {many} s");
        }
    }
}
