//! Ropes of 10 to 10,000 rigid links, let go from the horizontal, to an accuracy of 1e-3: cost and error by length.
//! `cargo bench --bench rope_lengths --no-default-features`
//!
//! Once with links of 0.1 m, and once with all ropes 5 m long. 1.5 s at 60 steps a second; one kilogram a metre.
//! Error: RMS distance over all nodes and samples from the same rope at 1e-9, in parts of its length; that this is the truth for
//! lengths where it can be known otherwise, tests/truth/rope_lengths.rs shows. Cost without planning, which comes with its own figure.

use std::time::Instant;
use tautline::engine::{Body, Constraint, DVec2, Kind, Method, Motion, Stepper, World};
use tautline::measure::error_against;

const STEPS: usize = 90;

fn main() {
    println!(
        "{:>8} {:>9} {:>10} {:>12} {:>12} {:>12}",
        "links", "link [m]", "error", "us/s", "ns/link/step", "plan [ms]"
    );
    for total in [None, Some(5.0)] {
        for links in [10, 100, 1000, 10_000] {
            let link = total.map_or(0.1, |total: f64| total / f64::from(links));
            let (motion, _, _) = run(links, link, 1e-3);
            let (exact, _, _) = run(links, link, 1e-9);
            let error = error_against(&exact, &motion, link * f64::from(links)).unwrap_or(f64::NAN);
            let mut costs: Vec<_> =
                (0..5).map(|_| run(links, link, 1e-3)).map(|(_, cost, plan)| (cost, plan)).collect();
            costs.sort_by(|a, b| a.0.total_cmp(&b.0));
            let (cost, plan) = costs[costs.len() / 2];
            let per_link = cost * 1e9 / (STEPS as f64 * f64::from(links));
            println!("{links:8} {link:9} {error:10.1e} {:12.0} {per_link:12.0} {:12.2}", cost * 1e6 / 1.5, plan * 1e3);
        }
    }
}

/// Positions of all samples, time of the steps and of the planning before them [s].
fn run(links: u32, link: f64, accuracy: f64) -> (Vec<Vec<DVec2>>, f64, f64) {
    let mut world = rope(links, link);
    let mut stepper = Stepper::new(Method { automatic: true, accuracy, ..Method::default() }).expect("a valid method");
    let start = Instant::now();
    stepper.plan(&world);
    let plan = start.elapsed().as_secs_f64();
    let mut motion = vec![world.bodies().position.clone()];
    let mut cost = 0.0;
    for _ in 0..STEPS {
        let start = Instant::now();
        let report = stepper.step(&mut world);
        cost += start.elapsed().as_secs_f64();
        if report.given_up > 0 {
            // More than 1000 steps a frame: this is no reference.
            return (Vec::new(), f64::NAN, plan);
        }
        motion.push(world.bodies().position.clone());
    }
    (motion, cost, plan)
}

fn rope(links: u32, link: f64) -> World {
    let mut world = World::new();
    let mut last = None;
    for i in 0..=links {
        let motion = if i == 0 { Motion::Static } else { Motion::Dynamic };
        let position = DVec2::new(f64::from(i) * link, 0.0);
        let node = Body { position, motion, mass: link, radius: 0.0, collides: false, ..Body::default() };
        let node = world.add_body(&node).expect("a valid body");
        if let Some(before) = last.replace(node) {
            world.add_constraint(&Constraint::between(Kind::Rod { length: link }, before, node)).expect("a valid rod");
        }
    }
    world
}
