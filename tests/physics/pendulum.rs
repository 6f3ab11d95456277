//! Pendulums: period with amplitude, tension, and what a rod keeps.

use super::figures::Figures;
use super::lab::*;
use std::f64::consts::TAU;
use tautline::engine::{Constraint, DVec2, Integrator, Kind, Method, Solver, World};

/// Arithmetic-geometric mean of `a` and `b`; quadratic convergence, eight rounds are far beyond a double.
fn mean(mut a: f64, mut b: f64) -> f64 {
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    a
}

/// Period [s] of a pendulum of 1 m let go at `amplitude` [rad]: T = 2π √(l/g) / agm(1, cos ½θ).
fn exact_period(amplitude: f64) -> f64 {
    TAU / (G.sqrt() * mean(1.0, (0.5 * amplitude).cos()))
}

/// 1 kg on a rod of 1 m, at rest, `angle` from the lowest point.
fn pendulum(angle: f64) -> World {
    let mut world = World::new();
    let mass = world.add_body(&point(v(angle.sin(), -angle.cos()), DVec2::ZERO)).unwrap();
    world.add_constraint(&Constraint::to_world(Kind::Rod { length: 1.0 }, mass, DVec2::ZERO)).unwrap();
    world
}

/// Mean period over the first two swings: from the first to the fifth passage of the lowest point, between samples on a
/// straight line.
fn period(amplitude: f64, method: Method) -> f64 {
    let mut world = pendulum(amplitude);
    let mut passages = Vec::new();
    let (mut time, mut x) = (0.0, position(&world, 0).x);
    watch(&mut world, method, 3.0 * exact_period(amplitude), |world, _| {
        let now = position(world, 0).x;
        if (now > 0.0) != (x > 0.0) {
            passages.push(time + (world.time() - time) * x / (x - now));
        }
        (time, x) = (world.time(), now);
    });
    (passages[4] - passages[0]) / 2.0
}

#[test]
fn the_elliptic_period_is_right_in_its_known_limits() {
    // Series for a small amplitude, and T(90°)/T(0) = 1.18034059901609 as tabulated.
    let small = TAU / G.sqrt();
    assert!((exact_period(0.01) / small - (1.0 + 1e-4 / 16.0)).abs() < 1e-10);
    assert!((exact_period(TAU / 4.0) / small - 1.180_340_599_016_09).abs() < 1e-12);
}

#[test]
fn the_pendulums_period_grows_with_its_amplitude_as_the_elliptic_integral() {
    let mut figures = Figures::default();
    for base in every_method(rate(60.0, 4, 10)) {
        for amplitude in [0.1, 1.0, 2.0] {
            let truth = exact_period(amplitude);
            let [coarse, fine] = [60.0, 240.0].map(|hz| (period(amplitude, Method { hz, ..base }) / truth - 1.0).abs());
            let name = format!("{}, amplitude {amplitude}", label(&base));
            // A first-order method at h = 4 ms is off by about h √(g/l) = 1.3 %; more where the amplitude is large,
            // since what it loses in height changes the period too. Projection damps, by design.
            let worst = if base.solver == Solver::Projection { 0.1 } else { 0.03 };
            figures.at_most(&format!("{name}, 240 substeps/s"), coarse, worst);
            // It must vanish with the step, as a first-order error does: a quarter, and room for the next term.
            figures.at_most(&format!("{name}, 960 substeps/s"), fine, (0.4 * coarse).max(2e-5));
        }
    }
}

#[test]
fn the_rods_multiplier_is_the_pendulums_tension() {
    let mut figures = Figures::default();
    let start = 1.2f64;
    for method in every_method(rate(240.0, 8, 10)) {
        let mut world = pendulum(start);
        let mut worst: f64 = 0.0;
        watch(&mut world, method, 1.5, |world, _| {
            let cos = -position(world, 0).y / position(world, 0).length();
            let truth = G * (3.0 * cos - 2.0 * start.cos());
            worst = worst.max((world.constraints().tension(0) - truth).abs());
        });
        // h = 0.5 ms: height, speed and the multiplier itself, of which that of the first substep still has half a
        // substep's share to find, are each off by O(h); 1 % of the largest tension covers them.
        figures.at_most(&format!("{}, tension off [N]", label(&method)), worst, 0.01 * 2.27 * G);
    }
}

#[test]
fn the_force_on_a_body_is_what_its_velocity_gains() {
    // PGS with semi-implicit Euler is v' = v + h (g + Jᵀλ/m), x' = x + h v': the multipliers must account for every bit of it.
    let mut figures = Figures::default();
    let method = Method { integrator: Integrator::SemiImplicitEuler, solver: Solver::Pgs, ..rate(240.0, 1, 5) };
    let mut world = pendulum(1.5);
    let second = world.add_body(&point(v(2.0, 0.3), DVec2::ZERO)).unwrap();
    let first = world.bodies().id[0];
    let length = position(&world, 0).distance(v(2.0, 0.3));
    world.add_constraint(&Constraint::between(Kind::Rod { length }, first, second)).unwrap();
    let mut old = world.clone();
    let mut worst: f64 = 0.0;
    watch(&mut world, method, 5.0, |world, _| {
        let pull = |i: usize| {
            let (a, b) = old.ends(i);
            world.constraints().tension(i) * (b - a).normalize()
        };
        let gain = (velocity(world, 0) - velocity(&old, 0)) * method.hz;
        worst = worst.max((gain - v(0.0, -G) - pull(0) - pull(1)).length());
        let gain = (velocity(world, 1) - velocity(&old, 1)) * method.hz;
        worst = worst.max((gain - v(0.0, -G) + pull(1)).length());
        old = world.clone();
    });
    // Differences of velocities up to 5 m/s, times 240 Hz.
    figures.at_most("unexplained acceleration [m/s²]", worst, 1e-10);
}

#[test]
fn a_rod_keeps_its_length_and_a_spinning_pair_its_momentum() {
    let mut figures = Figures::default();
    for method in every_method(rate(240.0, 8, 10)) {
        let mut world = weightless();
        let a = world.add_body(&point(v(-0.5, 0.0), v(0.3, -2.0))).unwrap();
        let b = world.add_body(&point(v(0.5, 0.0), v(0.3, 2.0))).unwrap();
        world.add_constraint(&Constraint::between(Kind::Rod { length: 1.0 }, a, b)).unwrap();
        let mut worst: f64 = 0.0;
        let mut tension = 0.0;
        watch(&mut world, method, 2.0, |world, _| {
            worst = worst.max((position(world, 0).distance(position(world, 1)) - 1.0).abs());
            tension = world.constraints().tension(0);
        });
        let name = label(&method);
        // Two metres a second to each side turn by h · 4 rad in a substep: a drift along the tangent lengthens the rod by
        // ½ (4h)² = 2e-6 before it is corrected. PGS drifts along the chord; room for ten such substeps and the start.
        figures.at_most(&format!("{name}, length off [m]"), worst, 3e-5);
        let middle = 0.5 * (position(&world, 0) + position(&world, 1));
        figures.at_most(&format!("{name}, centre of mass off [m]"), middle.distance(v(0.6, 0.0)), 1e-9);
        // Moves of a projection are rounded at 1e-16 m and divided by h = 0.5 ms, 4,000 times.
        let rounding = if method.solver == Solver::Projection { 1e-9 } else { 1e-12 };
        figures.at_most(&format!("{name}, momentum off"), (momentum(&world) - v(0.6, 0.0)).length(), rounding);
        let spin = (velocity(&world, 1) - velocity(&world, 0)).length();
        // First order in 4 h = 0.2 % a radian, eight radians.
        figures.near(&format!("{name}, speed of turning [m/s]"), spin, 4.0, 0.08);
        // m ω² r, at the speed that is left.
        figures.near(&format!("{name}, tension [N]"), tension, 0.25 * spin * spin * 2.0, 0.02 * 8.0);
    }
}

#[test]
fn a_slack_rope_does_nothing_and_a_taut_one_holds() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 8, 10)) {
        let mut world = World::new();
        world.set_drag(0.5).unwrap();
        let mass = world.add_body(&point(v(0.3, -0.2), DVec2::ZERO)).unwrap();
        let mut free = world.clone();
        world.add_constraint(&Constraint::to_world(Kind::Rope { length: 1.0 }, mass, DVec2::ZERO)).unwrap();
        let mut stepper = tautline::engine::Stepper::new(method).unwrap();
        let mut free_stepper = stepper_of(method);
        let (mut longest, mut same) = (0.0f64, true);
        for _ in 0..1800 {
            stepper.step(&mut world);
            free_stepper.step(&mut free);
            // A substep before the rope could tighten nothing of it may be felt.
            let reach = position(&free, 0).length() + velocity(&free, 0).length() / method.hz;
            if same && reach < 1.0 {
                assert!(
                    position(&world, 0).distance(position(&free, 0)) < 1e-12,
                    "{}: a slack rope pulls",
                    label(&method)
                );
                assert!(world.constraints().tension(0).abs() < 1e-9, "{}: a slack rope has tension", label(&method));
            } else {
                same = false;
            }
            longest = longest.max(position(&world, 0).length());
        }
        // Drag that is split off takes its part of what gravity adds in a substep before the rope does: up to drag · h.
        let split = 1e-4 + 0.5 * method.substep_seconds();
        // It tightens at 4 m/s: 8 mm a substep, of which PGS lets none pass and feeds back what turning adds.
        figures.at_most(&format!("{}, longest [m]", label(&method)), longest, 1.003);
        figures.near(&format!("{}, tension at rest [N]", label(&method)), world.constraints().tension(0), G, split * G);
        figures.near(&format!("{}, rest at [m]", label(&method)), position(&world, 0).y, -1.0, 1e-3);
    }
}

fn stepper_of(method: Method) -> tautline::engine::Stepper {
    tautline::engine::Stepper::new(method).unwrap()
}
