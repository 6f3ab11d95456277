//! Springs and dampers: order of convergence, energy, the three regimes, and springs too stiff for the step.

use super::figures::{Figures, order};
use super::lab::*;
use std::f64::consts::TAU;
use tautline::engine::{Body, Constraint, DVec2, Integrator, Kind, Method, World};

/// Angular frequency of the test oscillators [rad/s]: one oscillation a second.
const OMEGA: f64 = TAU;

/// A mass on a spring along x, `stretch` from rest, with a damper and drag.
fn oscillator(stretch: f64, damping: f64, drag: f64) -> World {
    let mut world = weightless();
    world.set_drag(drag).unwrap();
    let mass = world.add_body(&point(v(1.0 + stretch, 0.0), DVec2::ZERO)).unwrap();
    let spring = Kind::Spring { rest: 1.0, stiffness: OMEGA * OMEGA, damping };
    world.add_constraint(&Constraint::to_world(spring, mass, DVec2::ZERO)).unwrap();
    world
}

/// Displacement and velocity at `t` of x″ + 2 γ x′ + ω² x = 0 from x = 1 at rest.
fn damped(gamma: f64, omega: f64, t: f64) -> (f64, f64) {
    let decay = (-gamma * t).exp();
    let square = omega * omega - gamma * gamma;
    if square.abs() < 1e-12 {
        (decay * (1.0 + gamma * t), -gamma * gamma * t * decay)
    } else if square > 0.0 {
        let d = square.sqrt();
        let (sin, cos) = (d * t).sin_cos();
        (decay * (cos + gamma / d * sin), -decay * omega * omega / d * sin)
    } else {
        let d = (-square).sqrt();
        let (sinh, cosh) = ((d * t).sinh(), (d * t).cosh());
        (decay * (cosh + gamma / d * sinh), -decay * omega * omega / d * sinh)
    }
}

/// Distance of the oscillator from the truth in phase space [m], after `t` seconds from a stretch of 0.3 m.
fn error(method: Method, damping: f64, drag: f64, t: f64) -> f64 {
    let mut world = oscillator(0.3, damping, drag);
    run(&mut world, method, t);
    let (x, speed) = damped(0.5 * (damping + drag), OMEGA, t);
    let off = v(position(&world, 0).x - 1.0 - 0.3 * x, (velocity(&world, 0).x - 0.3 * speed) / OMEGA);
    off.length()
}

#[test]
fn every_integrator_converges_with_its_order() {
    let mut figures = Figures::default();
    for base in every_integrator(Method::default()) {
        let nominal = if second_order(&base) { 2.0 } else { 1.0 };
        for (what, damping, drag) in [("alone", 0.0, 0.0), ("with a damper", 1.5, 0.0), ("with drag", 0.0, 1.5)] {
            // h ω from 0.025 to 0.003: small enough that the leading term of the error rules.
            let errors: Vec<f64> =
                (0..4).map(|k| error(Method { hz: 64.0 * f64::from(1 << k), ..base }, damping, drag, 1.25)).collect();
            let name = format!("{}, spring {what}: errors {errors:.2?}, order", base.integrator.name());
            figures.near(&name, order(&errors), nominal, 0.1);
        }
    }
}

#[test]
fn an_orbit_on_a_spring_in_the_plane_converges_with_its_order() {
    let mut figures = Figures::default();
    for base in every_integrator(Method::default()) {
        let nominal = if second_order(&base) { 2.0 } else { 1.0 };
        let errors: Vec<f64> = (0..4)
            .map(|k| {
                let method = Method { hz: 64.0 * f64::from(1 << k), ..base };
                // A spring of no rest length is isotropic: an ellipse about the point where it carries the weight.
                let mut world = World::new();
                let centre = v(0.0, -G / (OMEGA * OMEGA));
                let mass = world.add_body(&point(centre + v(1.0, 0.0), v(0.0, 0.5 * OMEGA))).unwrap();
                let spring = Kind::Spring { rest: 0.0, stiffness: OMEGA * OMEGA, damping: 0.0 };
                world.add_constraint(&Constraint::to_world(spring, mass, DVec2::ZERO)).unwrap();
                let t = 1.25;
                run(&mut world, method, t);
                let (sin, cos) = (OMEGA * t).sin_cos();
                let off = position(&world, 0) - centre - v(cos, 0.5 * sin);
                let off_speed = velocity(&world, 0) / OMEGA - v(-sin, 0.5 * cos);
                off.length().hypot(off_speed.length())
            })
            .collect();
        figures.near(&format!("{}: errors {errors:.2?}, order", base.integrator.name()), order(&errors), nominal, 0.1);
    }
}

#[test]
fn energy_stays_bounded_over_a_hundred_periods_in_the_symplectic_integrators() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 1, 4)) {
        if method.integrator == Integrator::ExplicitEuler {
            continue;
        }
        let mut world = oscillator(0.3, 0.0, 0.0);
        let start = 0.5 * OMEGA * OMEGA * 0.09;
        let (mut low, mut high) = (f64::INFINITY, 0.0f64);
        let (mut early, mut late) = (0.0f64, 0.0f64);
        watch(&mut world, method, 100.0, |world, _| {
            let stretch = position(world, 0).x - 1.0;
            let energy = (kinetic_energy(world) + 0.5 * OMEGA * OMEGA * stretch * stretch) / start;
            (low, high) = (low.min(energy), high.max(energy));
            if world.time() <= 10.0 {
                early = early.max(energy);
            } else if world.time() >= 90.0 {
                late = late.max(energy);
            }
        });
        // What the method conserves in place of the energy E is E ∓ ½ h ω · ω x v (semi-implicit Euler), off by at most ½ h ω
        // of it, or ½ v² + ½ ω² x² (1 ∓ ¼ (h ω)²) (Verlet).
        let turn = method.substep_seconds() * OMEGA;
        let room = if second_order(&method) { 0.25 * turn * turn } else { 0.5 * turn };
        figures.at_most(&format!("{}, highest energy over the first", label(&method)), high, 1.0 / (1.0 - room));
        figures.at_most(&format!("{}, first over the lowest energy", label(&method)), 1.0 / low, 1.0 / (1.0 - room));
        // No drift: the crests of the last ten periods are those of the first ten, up to where samples fall on them.
        figures.near(&format!("{}, drift of the crests", label(&method)), late, early, 0.02 * room);
    }
}

#[test]
fn explicit_euler_gains_energy_at_its_known_rate() {
    let mut figures = Figures::default();
    let method = Method { integrator: Integrator::ExplicitEuler, ..rate(120.0, 2, 1) };
    let mut world = oscillator(1e-3, 0.0, 0.0);
    run(&mut world, method, 10.0);
    let stretch = position(&world, 0).x - 1.0;
    let energy = kinetic_energy(&world) + 0.5 * OMEGA * OMEGA * stretch * stretch;
    let turn = method.substep_seconds() * OMEGA;
    let grown = (1.0 + turn * turn).powi(2400);
    // The stretch is the difference of lengths near 1 m: 1e-16 of 1e-3 m, 2,400 times.
    figures.near("growth of the energy", energy / (0.5 * OMEGA * OMEGA * 1e-6), grown, 1e-9 * grown);
}

#[test]
fn a_damped_oscillator_follows_all_three_regimes() {
    let mut figures = Figures::default();
    for method in every_method(rate(240.0, 4, 10)) {
        let turn = method.substep_seconds() * OMEGA;
        for ratio in [0.2, 1.0, 3.0] {
            let worst = [0.25, 0.5, 1.0, 2.0]
                .map(|t| error(method, 2.0 * ratio * OMEGA, 0.0, t))
                .into_iter()
                .fold(0.0, f64::max);
            // Local errors of ½ h ω or (h ω)² of the stretch, per radian, with the dashpot's 2 ζ on top.
            let stiff = turn * 2.0 * (1.0 + ratio);
            let tolerance = 0.3 * if second_order(&method) { stiff * stiff } else { stiff };
            figures.at_most(&format!("{}, damping ratio {ratio}, error [m]", label(&method)), worst, tolerance);
        }
    }
}

#[test]
fn a_spring_too_stiff_for_the_step_is_solved_and_stays_stable() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 4, 10)) {
        let mut world = World::new();
        let mass = world.add_body(&point(v(0.3, -1.0), DVec2::ZERO)).unwrap();
        let spring = Kind::Spring { rest: 1.0, stiffness: 1e9, damping: 0.0 };
        world.add_constraint(&Constraint::to_world(spring, mass, DVec2::ZERO)).unwrap();
        let farthest = |world: &World| (position(world, 0).length() - 1.0).abs();
        let mut worst: f64 = 0.0;
        watch(&mut world, method, 10.0, |world, _| worst = worst.max(farthest(world)));
        // The first stretch is √1.09 − 1 = 0.044 m; a stable spring never exceeds it.
        figures.at_most(&format!("{}, stretch [m]", label(&method)), worst, 0.0441);
        figures.at_most(&format!("{}, stretch in the end [m]", label(&method)), farthest(&world), 1e-3);
    }
}

#[test]
fn a_weight_on_a_stiff_spring_hangs_where_hooke_says() {
    let mut figures = Figures::default();
    for method in every_method(rate(60.0, 4, 10)) {
        for stiffness in [1e3, 1e5, 1e7] {
            let mut world = World::new();
            world.set_drag(5.0).unwrap();
            let mass = world.add_body(&point(v(0.0, -1.0), DVec2::ZERO)).unwrap();
            let spring = Kind::Spring { rest: 1.0, stiffness, damping: 2.0 * stiffness.sqrt() };
            world.add_constraint(&Constraint::to_world(spring, mass, DVec2::ZERO)).unwrap();
            run(&mut world, method, 10.0);
            let name = format!("{}, {stiffness:.0e} N/m", label(&method));
            // At rest every method balances the same forces; what is left of the start has decayed by e⁻²⁵. Drag that is split
            // off takes its part of what gravity adds in a substep before the spring does: up to drag · h = 2.1 % of it.
            let part = 1e-3 + 5.0 * method.substep_seconds();
            figures.near(
                &format!("{name}, stretch [m]"),
                -1.0 - position(&world, 0).y,
                G / stiffness,
                part * G / stiffness,
            );
            figures.near(&format!("{name}, tension [N]"), world.constraints().tension(0), G, part * G);
        }
    }
}

/// Distance from the anchor of a mass of 1 kg on a spring and a damper that turns as a rod does, largest within `seconds`: along the
/// pendulum's motion, c r' = N − k (r − L) with N the rod's tension. Classical Runge–Kutta on the pendulum, 10 µs a step.
fn creep(length: f64, [gravity, start, speed]: [f64; 3], [stiffness, damping]: [f64; 2], seconds: f64) -> f64 {
    let rate = |[angle, omega, stretch]: [f64; 3]| {
        let tension = gravity * angle.cos() + length * omega * omega;
        [omega, -gravity / length * angle.sin(), (tension - stiffness * stretch) / damping]
    };
    let moved = |y: [f64; 3], k: [f64; 3], h: f64| [y[0] + h * k[0], y[1] + h * k[1], y[2] + h * k[2]];
    let (h, mut y, mut most) = (1e-5, [start, speed / length, 0.0], 0.0f64);
    for _ in 0..(seconds / h).round() as u64 {
        let k1 = rate(y);
        let k2 = rate(moved(y, k1, 0.5 * h));
        let k3 = rate(moved(y, k2, 0.5 * h));
        let k4 = rate(moved(y, k3, h));
        y = moved(moved(moved(moved(y, k1, h / 6.0), k2, h / 3.0), k3, h / 3.0), k4, h / 6.0);
        most = most.max(y[2]);
    }
    most
}

#[test]
fn a_mass_on_a_very_stiff_damper_swings_as_on_a_rod_and_creeps_as_its_tension_says() {
    let mut figures = Figures::default();
    let quarter = 0.5 * std::f64::consts::PI;
    // Gravity, angle from the pull of gravity, speed; length; stiffness, damping.
    for (motion, length, spring) in [
        ([9.81, quarter, 0.0], 1.0, [100.0, 1e6]),
        ([9.81, -quarter, 0.0], 1.0, [100.0, 1e6]),
        ([0.0, 0.3, 1.0], 1.0, [0.001, 1e9]),
        ([9.81, 0.0, 3.0], 2.0, [0.0, 1e8]),
        ([9.81, 1.0, -2.0], 0.5, [1e3, 1e5]),
    ] {
        let exact = creep(length, motion, spring, 20.0);
        let [gravity, angle, speed] = motion;
        let out = v(angle.sin(), -angle.cos());
        let by_hand = [1, 4, 16].map(|substeps| rate(60.0, substeps, 10));
        let velocity_verlet = Method { integrator: Integrator::VelocityVerlet, ..Method::default() };
        let accurate = [1e-3, 1e-6].map(|accuracy| Method { automatic: true, accuracy, ..Method::default() });
        for method in by_hand.into_iter().chain([velocity_verlet]).chain(accurate) {
            let mut world = weightless();
            world.set_gravity(v(0.0, -gravity)).unwrap();
            let mass = Body { collides: false, ..ball(length * out, speed * out.perp()) };
            let id = world.add_body(&mass).unwrap();
            let kind = Kind::Spring { rest: length, stiffness: spring[0], damping: spring[1] };
            world.add_constraint(&Constraint::to_world(kind, id, DVec2::ZERO)).unwrap();
            let mut most = 0.0f64;
            watch(&mut world, method, 20.0, |world, _| most = most.max(position(world, 0).length() - length));
            let name = format!(
                "{motion:?}, {spring:?}, {} × {}, automatic {}",
                label(&method),
                method.substeps,
                method.automatic
            );
            // Of a creep of micrometres an accuracy of 1e-3 need not know anything.
            let known = if method.automatic { 0.1 * method.accuracy * length } else { 0.0 };
            figures.near(&format!("{name}: creep [m]"), most, exact, 0.03 * exact + known);
        }
    }
}
