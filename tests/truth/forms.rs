//! Closed forms as scenes name them: against the reference solver where that has equations, against fine steps of the engine
//! where bodies touch, and refused where they do not fit.

use tautline::engine::{Integrator, Method, Stepper};
use tautline::measure::error_against;
use tautline::scene::{self, Setup};
use tautline::truth::{ClosedForm, Trajectory, converge};

fn setup(text: &str) -> Setup {
    scene::parse("text", &format!("(version: 1, {text})")).unwrap_or_else(|error| panic!("{error}"))
}

fn known(setup: &Setup) -> Trajectory {
    setup.known_motion().unwrap_or_else(|| panic!("{}: nothing known", setup.name))
}

#[test]
fn every_shipped_scene_that_names_a_form_follows_the_reference_solver_too() {
    let mut forms = 0;
    for shipped in scene::every_scene() {
        let setup = scene::open(shipped.name).unwrap();
        let Some(span) = setup.truth.filter(|span| span.form.is_some()) else { continue };
        let exact = known(&setup);
        assert_eq!(exact.times.last(), Some(&span.seconds), "{}", shipped.name);
        forms += 1;
        let Ok(reference) = converge(&setup.world, span.seconds, span.length) else { continue };
        let error = error_against(&exact.positions, &reference.positions, span.length).unwrap();
        println!("{}: {error:.1e}", shipped.name);
        // Phases of up to 100 rad are right to 1e-14, and the length of a rod as built to an ulp.
        assert!(error < 1e-12, "{}: {error:e}", shipped.name);
    }
    assert!(forms >= 5, "{forms} scenes");
}

#[test]
fn forms_of_free_motion_are_read_off_any_world() {
    for text in [
        // Drag; gravity that is not vertical.
        r#"truth: (seconds: 2, length: 1, form: Projectile), settings: (drag: 0.7, gravity: (1, -3)),
           bodies: [Particle(position: (1, 2), velocity: (3, 4), radius: 0), Particle(mass: 3, velocity: (-1, 0), radius: 0)]"#,
        // A weight on a damped spring in air, hung from a static body, its stiffness tuned.
        r#"truth: (seconds: 3, length: 1, form: Oscillator), settings: (drag: 0.3, tuning: (stiffness: 2)),
           bodies: [Particle(name: "hook", motion: Static, position: (0.5, 2), radius: 0),
                    Particle(name: "weight", position: (0.5, 0), velocity: (0, 1.5), mass: 2, radius: 0)],
           constraints: [Spring(a: "weight", b: "hook", rest: 1.5, stiffness: 40, damping: 1)]"#,
        // Gravity to the side, a pivot off the origin, two pendulums.
        r#"truth: (seconds: 3, length: 1, form: Pendulum), settings: (gravity: (8, 6)),
           bodies: [Particle(name: "a", position: (1, 4), radius: 0), Particle(name: "b", position: (2, 1), mass: 5, radius: 0)],
           constraints: [Rod(a: (1, 1), b: "a"), Rod(a: "b", b: (2, 2.5))]"#,
    ] {
        let setup = setup(text);
        let span = setup.truth.unwrap();
        let reference = converge(&setup.world, span.seconds, span.length).unwrap();
        let error = error_against(&known(&setup).positions, &reference.positions, span.length).unwrap();
        println!("{:?}: {error:.1e}", span.form);
        assert!(error < 1e-13, "{:?}: {error:e}", span.form);
    }
}

/// RMS distance of the engine's motion from what is known, in parts of the length, at so many substeps.
fn engine_error(setup: &Setup, substeps: u32) -> f64 {
    let exact = known(setup);
    let mut world = setup.world.clone();
    let method = Method { integrator: Integrator::VelocityVerlet, substeps, ..Method::default() };
    let mut stepper = Stepper::new(method).unwrap();
    let mut motion = vec![world.bodies().position.clone()];
    for _ in 1..exact.times.len() {
        assert!(stepper.step(&mut world).divergence.is_none());
        motion.push(world.bodies().position.clone());
    }
    error_against(&exact.positions, &motion, exact.length).unwrap()
}

/// Scenes in which bodies touch, and the error that fine substeps of 1/60/256 s may leave.
const TOUCHING: [(&str, f64); 8] = [
    // Three balls of different restitution on one floor, one of them thrown sideways on smooth ground.
    (
        r#"truth: (seconds: 2, length: 1, form: Bounce),
           bodies: [Particle(position: (0, 1.1), restitution: 0.8), Particle(position: (1, 1.6), restitution: 0.3),
                    Particle(position: (2, 0.6), velocity: (0.5, -1), restitution: 0.9, friction: 0)],
           walls: [Segment(from: (-1, 0), to: (6, 0))]"#,
        2e-3,
    ),
    // A ball on a smooth slope.
    (
        r#"truth: (seconds: 1.5, length: 1, form: Bounce),
           bodies: [Particle(position: (0, 1), restitution: 0.7, friction: 0)], walls: [Segment(from: (-1, 0.5), to: (9, -4.5))]"#,
        2e-3,
    ),
    // Oblique, rough, with spin, falling.
    (
        r#"truth: (seconds: 1, length: 1, form: Exchange),
           bodies: [Disc(position: (-1, 0), velocity: (3, 0), omega: 20, radius: 0.2, mass: 2, restitution: 0.6, friction: 0.3),
                    Disc(position: (0.5, 0.15), velocity: (-1, 0.2), radius: 0.3, friction: 0.3)]"#,
        2e-3,
    ),
    (
        r#"truth: (seconds: 1, length: 1, form: Row), settings: (gravity: (0, 0)),
           bodies: [Particle(position: (-1, 0), velocity: (5, 0), restitution: 1), Particle(position: (0, 0), restitution: 1),
                    Particle(position: (0.5, 0), restitution: 1), Particle(position: (0.9, 0), velocity: (-1, 0), restitution: 1)]"#,
        1e-3,
    ),
    (
        r#"truth: (seconds: 4, length: 1, form: Billiard), settings: (gravity: (0, 0)),
           bodies: [Particle(position: (0.3, 0.2), velocity: (3, 2), restitution: 1, friction: 0)],
           walls: [Line(points: [(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)], friction: 0)]"#,
        1e-3,
    ),
    // Thrown up the slope: it stops, and slides down again.
    (
        r#"truth: (seconds: 2, length: 1, form: Slide),
           bodies: [Particle(position: (0, 0.1), velocity: (-2, 0), friction: 0.25)],
           walls: [Segment(from: (-9, 0), to: (9, 0), friction: 0.25)], settings: (gravity: (4, -9))"#,
        2e-3,
    ),
    // Thrown without spin: it slips, then rolls.
    (
        r#"truth: (seconds: 2, length: 1, form: Roll),
           bodies: [Disc(position: (0, 0.1), velocity: (3, 0), friction: 0.3)],
           walls: [Segment(from: (-1, 0), to: (20, 0), friction: 0.3)]"#,
        2e-3,
    ),
    // Down a box's top that gravity slants, spun the wrong way.
    (
        r#"truth: (seconds: 1, length: 1, form: Roll),
           bodies: [Disc(position: (0, 0.2), omega: 30, radius: 0.2, friction: 0.5)],
           walls: [Box(min: (-9, -1), max: (9, 0), friction: 0.5)], settings: (gravity: (3, -9))"#,
        2e-3,
    ),
];

#[test]
fn fine_steps_of_the_engine_come_near_to_every_form_of_contact() {
    for (text, most) in TOUCHING {
        let setup = setup(text);
        let [coarse, fine] = [4, 256].map(|substeps| engine_error(&setup, substeps));
        println!("{:?}: {coarse:.1e} with 4 substeps, {fine:.1e} with 256", setup.truth.unwrap().form);
        // Of first order at least where something touches: the figure says that it is the same motion.
        assert!(fine < most, "{text}: {fine:e}");
    }
}

#[test]
fn a_scene_that_does_not_fit_its_form_says_what_does_not() {
    for (text, what) in [
        (
            "form: Projectile), bodies: [Particle(position: (0, 0.5))], walls: [Segment(from: (-1, 0), to: (1, 0))]",
            "meet at",
        ),
        ("form: Projectile)", "nothing that moves"),
        (
            r#"form: Pendulum), bodies: [Particle(name: "a", radius: 0)], constraints: [Spring(a: "a", b: (1, 0), stiffness: 9)]"#,
            "a spring on it",
        ),
        (
            r#"form: Pendulum), bodies: [Particle(name: "a", radius: 0, velocity: (0, 1))], constraints: [Rod(a: "a", b: (1, 0))]"#,
            "a velocity",
        ),
        (
            r#"form: Oscillator), bodies: [Particle(name: "a", radius: 0)], constraints: [Spring(a: "a", b: (1, 0), stiffness: 9)]"#,
            "across",
        ),
        (
            r#"form: Oscillator), bodies: [Particle(name: "a", radius: 0, velocity: (0, 5))], constraints: [Spring(a: "a", b: (0, 1), rest: 0.3, stiffness: 9)]"#,
            "through the fixed",
        ),
        ("form: Bounce), bodies: [Particle(position: (0, 1))]", "no wall under it"),
        (
            "form: Bounce), bodies: [Particle(position: (0, 1), velocity: (1, 0))], walls: [Segment(from: (-1, 0), to: (9, 0))]",
            "not straight",
        ),
        (
            "form: Bounce), bodies: [Particle(position: (0, 1), velocity: (1, 0), friction: 0)], walls: [Segment(from: (-1, 0), to: (1, 0))]",
            "the end of its plane",
        ),
        ("form: Slide), bodies: [Particle(position: (0, 1))], walls: [Segment(from: (-1, 0), to: (9, 0))]", "a gap"),
        (
            "form: Slide), bodies: [Disc(position: (0, 0.1))], walls: [Segment(from: (-1, 0), to: (9, 0))]",
            "a disc that turns",
        ),
        (
            "form: Roll), bodies: [Disc(position: (0, 0.1), velocity: (3, 0))], walls: [Segment(from: (-1, 0), to: (1, 0))]",
            "the end of its plane",
        ),
        (
            "form: Exchange), bodies: [Particle(), Particle(position: (1, 0)), Particle(position: (2, 0))]",
            "no two bodies",
        ),
        (
            "form: Stack), bodies: [Particle(position: (0, 0.1)), Particle(position: (0.01, 0.3))], walls: [Segment(from: (-1, 0), to: (1, 0))]",
            "stands on nothing",
        ),
        ("form: Row), bodies: [Particle(restitution: 1), Particle(position: (1, 0))], settings: (gravity: (0, 0))", ""),
        (
            "form: Row), bodies: [Particle(), Particle(position: (1, 0))], settings: (gravity: (0, 0))",
            "a restitution other than 1",
        ),
        ("form: Billiard), bodies: [Particle(velocity: (1, 0))], settings: (gravity: (0, 0))", "no wall along"),
        ("form: Billiard), bodies: [Particle()]", "gravity"),
    ] {
        let text = format!("(version: 1, truth: (seconds: 2, length: 1, {text})");
        match scene::parse("text", &text) {
            Ok(_) => assert_eq!(what, "", "{text} is accepted"),
            Err(error) => {
                let message = error.to_string();
                assert!(!what.is_empty() && message.contains(what), "{text}: {message}");
                assert!(message.contains("name another form"), "{message}");
            }
        }
    }
}

#[test]
fn every_form_has_the_name_that_a_scene_file_uses() {
    for form in ClosedForm::ALL {
        assert_eq!(format!("{form:?}"), form.name());
    }
}

#[test]
fn an_edited_world_is_not_saved_with_a_form_that_it_no_longer_follows() {
    let mut setup = setup(TOUCHING[0].0);
    let captured = scene::capture(&setup);
    assert_eq!((captured.truth, captured.build().unwrap().truth), (setup.truth, setup.truth));
    setup.world.set_drag(1.0).unwrap();
    assert_eq!(scene::capture(&setup).truth, None);
    // Once it moves, it is no longer let go at rest.
    let mut pendulum = scene::open("hard/pendulum").unwrap();
    Stepper::new(pendulum.method).unwrap().step(&mut pendulum.world);
    assert_eq!((scene::capture(&pendulum).truth, pendulum.known_motion()), (None, None));
    let mut stored = scene::open("truth/pendulum").unwrap();
    assert!(stored.known_motion().is_some());
    Stepper::new(stored.method).unwrap().step(&mut stored.world);
    assert_eq!(stored.known_motion(), None);
}
