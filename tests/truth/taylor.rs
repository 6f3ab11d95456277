//! The accuracy dial and Taylor series on islands, against the stored truths and closed forms: the error stays within the wanted accuracy.

use tautline::engine::{Body, Carrier, Constraint, DVec2, Grip, Integrator, Kind, Method, Stepper, World};
use tautline::measure::error_against;
use tautline::scene;
use tautline::truth::stored;

fn by_accuracy(accuracy: f64) -> Method {
    Method { automatic: true, accuracy, ..Method::default() }
}

/// RMS distance from the truth in parts of the scene's length, and the largest violation [m].
fn error(name: &str, method: Method) -> (f64, f64) {
    let truth = stored(name).unwrap();
    let mut world = scene::open(name).unwrap().world;
    let mut stepper = Stepper::new(method).unwrap();
    let mut motion = vec![world.bodies().position.clone()];
    let mut violation: f64 = 0.0;
    for _ in 1..truth.times.len() {
        let report = stepper.step(&mut world);
        assert!(report.divergence.is_none(), "{name}: {}", report.divergence.unwrap());
        motion.push(world.bodies().position.clone());
        violation = violation.max(tautline::measure::Measures::of(&world).violation_max);
    }
    (error_against(&truth.positions, &motion, truth.length).unwrap(), violation)
}

#[test]
fn every_truth_scene_is_carried_to_the_wanted_accuracy() {
    for shipped in scene::truth_scenes() {
        let seconds = *stored(shipped.name).unwrap().times.last().unwrap();
        for accuracy in
            [0.1, 1e-2, 3e-3, 1e-3, 6e-4, 3e-4, 1e-4, 1e-5, 3e-6, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13]
        {
            let (error, violation) = error(shipped.name, by_accuracy(accuracy));
            println!("{}, wanted {accuracy:.0e}: error {error:.1e}, violation {violation:.1e} m", shipped.name);
            // The quick methods are held to what is wanted after a second or two; their errors grow with time.
            let allowed = if accuracy >= 6e-4 { accuracy * (seconds / 2.0).max(1.0) } else { accuracy };
            assert!(error < allowed, "{}, wanted {accuracy:e}: {error:e}", shipped.name);
            assert!(accuracy > 1e-10 || violation < 1e-10, "{}: {violation:e}", shipped.name);
        }
    }
}

#[test]
fn the_error_of_series_falls_with_the_wanted_accuracy() {
    // By hand: by accuracy a method of a fixed order may be better than asked for in a single step.
    let series = |accuracy| Method { integrator: Integrator::Taylor, accuracy, ..Method::default() };
    let errors = [1e-4, 1e-6, 1e-8, 1e-10].map(|accuracy| error("truth/double_pendulum", series(accuracy)).0);
    // Local errors are kept at a fixed part of what is wanted, so the error must fall with it, within the jumps of the order.
    assert!(errors.windows(2).all(|pair| pair[1] < 0.1 * pair[0]), "{errors:?}");
}

fn point(position: DVec2) -> Body {
    Body { position, radius: 0.0, ..Body::default() }
}

#[test]
fn a_rope_tightens_at_its_instant_and_a_ball_flies_freely_until_then() {
    let mut world = World::new();
    let ball = world.add_body(&point(DVec2::new(0.6, 0.0))).unwrap();
    let rope = Constraint::to_world(Kind::Rope { length: 1.0 }, ball, DVec2::ZERO);
    world.add_constraint(&rope).unwrap();
    let mut stepper = Stepper::new(by_accuracy(1e-12)).unwrap();
    // It falls 0.8 m, to where the rope is taut, 3 : 4.
    let fall = (2.0f64 * 0.8 / 9.81).sqrt();
    let (mut taut, speed) = (false, 9.81 * fall);
    while world.time() < 1.0 {
        stepper.step(&mut world);
        let (x, v, t) = (world.bodies().position[0], world.bodies().velocity[0], world.time());
        if t < fall {
            assert!((x - DVec2::new(0.6, -0.5 * 9.81 * t * t)).length() < 1e-13, "{x}");
        } else {
            // The radial part of the speed is gone, the rest keeps its energy.
            let energy = 0.5 * v.length_squared() + 9.81 * x.y;
            let left = 0.5 * (0.6 * speed) * (0.6 * speed) - 9.81 * 0.8;
            assert!(x.length() < 1.0 + 1e-12);
            assert!((energy - left).abs() < 1e-10, "{energy} for {left}");
            assert!(world.constraints().tension(0) > 0.0);
            taut = true;
        }
    }
    assert!(taut);
}

#[test]
fn a_hold_pulls_with_a_bounded_force_and_damps_as_its_closed_form() {
    let mut world = World::new();
    world.set_gravity(DVec2::ZERO).unwrap();
    let ball = world.add_body(&point(DVec2::new(0.1, 0.0))).unwrap();
    world.set_grip(Some(Grip::new(ball, DVec2::ZERO, DVec2::ZERO, 1.0))).unwrap();
    let mut stepper = Stepper::new(by_accuracy(1e-12)).unwrap();
    for _ in 0..30 {
        stepper.step(&mut world);
        let turn = std::f64::consts::TAU * 7.5 * world.time();
        let exact = 0.1 * (1.0 + turn) * (-turn).exp();
        assert!((world.bodies().position[0].x - exact).abs() < 1e-13);
    }
    // Far away the bound acts: a constant force of 100 weights.
    world.set_body(ball, &point(DVec2::new(1e4, 0.0))).unwrap();
    (0..6).for_each(|_| drop(stepper.step(&mut world)));
    let fallen = 1e4 - world.bodies().position[0].x;
    assert!((fallen - 0.5 * 981.0 * 0.01).abs() < 1e-9, "{fallen}");
}

#[test]
fn redundant_rods_are_dropped_and_contradictory_ones_given_up() {
    let mut world = World::new();
    let a = world.add_body(&point(DVec2::new(1.0, 0.0))).unwrap();
    for _ in 0..2 {
        world.add_constraint(&Constraint::to_world(Kind::Rod { length: 1.0 }, a, DVec2::ZERO)).unwrap();
    }
    let mut stepper = Stepper::new(Method { integrator: Integrator::Taylor, ..Method::default() }).unwrap();
    let report = stepper.step(&mut world);
    assert!(report.divergence.is_none() && report.redundant == 1, "{report:?}");
    assert!((world.bodies().position[0].length() - 1.0).abs() < 1e-12);
    world.add_constraint(&Constraint::to_world(Kind::Rod { length: 3.0 }, a, DVec2::ZERO)).unwrap();
    let before = world.clone();
    let report = stepper.step(&mut world);
    // No position meets both lengths: the island goes to the solver that settles between them, and the report says so.
    assert!(report.divergence.is_none() && report.given_up == 1 && world != before, "{report:?}");
}

#[test]
fn the_plan_says_what_it_carries_and_what_it_leaves_to_the_substeps() {
    let heavy = scene::open("heavy_rope").unwrap();
    let mut stepper = Stepper::new(heavy.method).unwrap();
    let plan = stepper.plan(&heavy.world);
    assert!(plan.islands.len() == 1 && plan.islands[0].carrier == Carrier::Cheapest && !plan.rest);
    assert!(plan.sentence(&heavy.world, &heavy.method).contains("1 island by the cheapest method within 1e-9"));
    let told = |name| {
        let world = scene::open(name).unwrap().world;
        let mut stepper = Stepper::new(by_accuracy(1e-9)).unwrap();
        let plan = stepper.plan(&world);
        (plan.few.as_ref().map_or(0, |few| few.bodies.len()), plan.sentence(&world, &by_accuracy(1e-9)))
    };
    let (few, stack) = told("stack");
    assert!(few == 10 && stack.contains("10 free bodies from impact to impact in closed form"), "{stack}");
    let (_, pile) = told("pile");
    assert!(pile.contains("heaps of more than 128 through the substeps"), "{pile}");
}
