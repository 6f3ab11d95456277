//! Closed forms against tables, against each other, and against their own differential equations.

use std::f64::consts::{FRAC_PI_2, PI};
use tautline::engine::DVec2;
use tautline::truth::closed_form::{Oscillator, Pendulum, fall_with_drag, jacobi, projectile, quarter_period};

const GRAVITY: DVec2 = DVec2::new(0.0, -9.81);

/// Relative distance, absolute where both are below 1.
fn assert_near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance * expected.abs().max(1.0), "{found:e} is not {expected:e}");
}

#[test]
fn elliptic_integrals_have_the_digits_of_the_tables() {
    // Abramowitz, Stegun, table 17.1 gives K by m = k²: m = 0, 0.5, 0.75, 0.99. Two roundings of the mean: 4 ulps.
    for (m, value) in [
        (0.0, FRAC_PI_2),
        (0.5, 1.854_074_677_301_371_9),
        (0.75, 2.156_515_647_499_643),
        (0.99, 3.695_637_362_989_874_7),
    ] {
        assert_near(quarter_period(f64::sqrt(m)), value, 1e-15 * 4.0);
    }
    // K(1/√2) is the lemniscate constant ϖ/√2 with ϖ = Γ(1/4)²/(2√(2π)).
    let gamma = libm::tgamma(0.25);
    assert_near(quarter_period(0.5_f64.sqrt()), gamma * gamma / (4.0 * PI.sqrt()), 2e-15);
}

#[test]
fn jacobi_functions_keep_their_identities_and_their_limits() {
    for k in [0.0, 0.1, 0.5, 0.7, 0.9, 0.999] {
        let quarter = quarter_period(k);
        for i in -40..=40 {
            let u = f64::from(i) * 0.37;
            let j = jacobi(u, k);
            assert_near(j.sn * j.sn + j.cn * j.cn, 1.0, 1e-15);
            assert_near(j.dn * j.dn + k * k * j.sn * j.sn, 1.0, 2e-15);
            // sn(u + K) = cn/dn. The argument is right to an ulp of 15, whence the tolerance.
            assert_near(jacobi(u + quarter, k).sn, j.cn / j.dn, 3e-14);
            // sn 2u = 2 sn cn dn / (1 − k² sn⁴)
            let double = 2.0 * j.sn * j.cn * j.dn / (1.0 - k * k * j.sn.powi(4));
            assert_near(jacobi(2.0 * u, k).sn, double, 3e-13);
        }
        let j = jacobi(quarter, k);
        assert_near(j.sn, 1.0, 1e-15);
        assert_near(j.dn, (1.0 - k * k).sqrt(), 1e-14);
    }
    let circle = jacobi(1.25, 0.0);
    assert_eq!((circle.sn, circle.cn, circle.dn), (libm::sin(1.25), libm::cos(1.25), 1.0));
}

#[test]
fn a_pendulum_starts_at_its_amplitude_falls_through_the_bottom_and_comes_back() {
    for amplitude in [0.01, 1.0, FRAC_PI_2, 3.0, -2.0] {
        let pendulum = Pendulum { length: 1.3, gravity: 9.81, amplitude };
        let at = |angle: f64| 1.3 * DVec2::new(libm::sin(angle), -libm::cos(angle));
        let period = pendulum.period();
        // At 3 rad the phase turns by 1e-15 a swing times the period's sensitivity, about 30.
        for (part, angle) in [(0.0, amplitude), (0.25, 0.0), (0.5, -amplitude), (1.0, amplitude), (3.0, amplitude)] {
            let distance = (pendulum.at(part * period) - at(angle)).length();
            assert!(distance < 1e-13, "{amplitude} rad at {part} periods: {distance:e}");
        }
    }
    let small = Pendulum { length: 1.0, gravity: 9.81, amplitude: 1e-4 };
    // 1 + θ²/16 + 11 θ⁴/3072 (Whittaker)
    assert_near(small.period(), 2.0 * PI / 9.81_f64.sqrt() * (1.0 + 1e-8 / 16.0), 1e-15);
}

#[test]
fn a_pendulum_keeps_its_energy() {
    let pendulum = Pendulum { length: 1.0, gravity: 9.81, amplitude: FRAC_PI_2 };
    let h = 1e-3;
    for i in 1..5000 {
        let t = f64::from(i) * 2e-3;
        // Central difference of sixth order, whose own error is far below what the phase's ulp of 4e-15 makes at 4.4 m/s when
        // it is divided by h: 4e-11 J.
        let difference = |n: f64| pendulum.at(t + n * h) - pendulum.at(t - n * h);
        let velocity = (45.0 * difference(1.0) - 9.0 * difference(2.0) + difference(3.0)) / (60.0 * h);
        let energy = 0.5 * velocity.length_squared() + 9.81 * pendulum.at(t).y;
        assert!(energy.abs() < 1e-10, "{energy:e} J at {t} s");
    }
}

#[test]
fn drag_tends_to_none_and_to_the_terminal_velocity() {
    let (start, velocity) = (DVec2::new(1.0, 2.0), DVec2::new(10.0, 10.0));
    let free = projectile(start, velocity, GRAVITY, 2.0);
    assert_eq!(free, start + DVec2::new(20.0, 20.0 - 2.0 * 9.81));
    assert_eq!(fall_with_drag(start, velocity, GRAVITY, 0.0, 2.0), (free, velocity + 2.0 * GRAVITY));
    // First order in the drag: −c (v t²/2 + g t³/6).
    let drag = 1e-7;
    let slowed = -drag * (2.0 * velocity + 8.0 / 6.0 * GRAVITY);
    // The next order is (c t)² of some 10 m, and the terminal velocity of 1e8 m/s costs eight digits.
    let found = fall_with_drag(start, velocity, GRAVITY, drag, 2.0).0;
    assert!((found - free - slowed).length() < 1e-7, "{}", (found - free - slowed).length());
    let (_, late) = fall_with_drag(start, velocity, GRAVITY, 3.0, 20.0);
    assert!((late - GRAVITY / 3.0).length() < 1e-14);
}

#[test]
fn a_hardly_damped_fall_is_nearly_a_free_one_and_a_heavily_damped_one_keeps_its_terminal_speed() {
    let (v, g) = (DVec2::new(3.0, 4.0), DVec2::new(0.0, -9.81));
    for drag in [0.0, 5e-324, 1e-300, 1e-20, 1e-12, 1e-6] {
        let (position, velocity) = fall_with_drag(DVec2::ONE, v, g, drag, 3.0);
        let free = projectile(DVec2::ONE, v, g, 3.0);
        // The first term of drag: −drag (½ v t² + g t³/6), and one of second order.
        let first = free - drag * (4.5 * v + 4.5 * g);
        assert!((position - first).length() < 1e-13 + 100.0 * drag * drag, "{drag:e}: {position} {first}");
        assert!((velocity - (v + 3.0 * g)).length() < 1e-13 + 200.0 * drag, "{drag:e}: {velocity}");
    }
    for drag in [10.0, 1e3, 1e6] {
        let (position, velocity) = fall_with_drag(DVec2::ZERO, v, g, drag, 100.0);
        let (terminal, lost) = (g / drag, (v - g / drag) / drag);
        assert!((velocity - terminal).length() <= 1e-15 * terminal.length(), "{drag:e}: {velocity}");
        let expected = 100.0 * terminal + lost;
        assert!((position - expected).length() <= 1e-14 * expected.length(), "{drag:e}: {position} {expected}");
    }
    // Both ways of calculation meet where one takes over.
    let [below, above] = [0.5f64.next_down(), 0.5].map(|drag| fall_with_drag(DVec2::ZERO, v, g, drag, 1.0).0);
    assert!((below - above).length() < 1e-15, "{below} {above}");
}

#[test]
fn an_oscillator_however_damped_or_light_or_stiff_has_a_place() {
    for damping in [0.0, 1e-300, 1e-9, 1.0, 19.999_999_999, 20.0, 20.000_000_001, 40.0, 1e4, 1e8, 1e12] {
        for (mass, stiffness) in [(1.0, 100.0), (1e-12, 1e12), (1e12, 1e-6)] {
            let oscillator = Oscillator { mass, stiffness, damping, position: 0.25, velocity: -0.1 };
            for t in [0.0, 1e-9, 0.1, 4.0, 3600.0] {
                let (x, v) = oscillator.at(t);
                // ½ m v² + ½ k x² never grows.
                let energy = |x: f64, v: f64| 0.5 * mass * v * v + 0.5 * stiffness * x * x;
                let kept = energy(x, v) <= energy(0.25, -0.1) * (1.0 + 1e-9);
                assert!(kept, "damping {damping:e}, mass {mass:e}, t {t}: {x:e}, {v:e}");
            }
        }
    }
    // Far above criticality it creeps: m v̇ is nothing beside c v = −k x.
    let creeping = Oscillator { mass: 1.0, stiffness: 100.0, damping: 1e12, position: 0.25, velocity: 0.0 };
    let (x, v) = creeping.at(1e9);
    assert!((x - 0.25 * (-0.1f64).exp()).abs() < 1e-15 && (v + 1e-10 * x).abs() < 1e-24, "{x} {v}");
}

#[test]
fn the_three_regimes_of_an_oscillator_meet() {
    let oscillator = |damping| Oscillator { mass: 1.0, stiffness: 100.0, damping, position: 0.3, velocity: -2.0 };
    // k = 100, m = 1: critical at c = 20.
    let critical = oscillator(20.0).at(0.2);
    for beside in [20.0 - 1e-9, 20.0 + 1e-9] {
        let found = oscillator(beside).at(0.2);
        // dx/dc is below 1 m per N·s/m here.
        assert_near(found.0, critical.0, 1e-9);
        assert_near(found.1, critical.1, 1e-8);
    }
    let undamped = oscillator(0.0);
    for i in 0..100 {
        let t = 0.01 * f64::from(i);
        let expected = 0.3 * libm::cos(10.0 * t) - 0.2 * libm::sin(10.0 * t);
        assert_near(undamped.at(t).0, expected, 1e-15);
    }
}

#[test]
fn an_oscillator_obeys_its_equation_and_its_velocity_is_its_slope() {
    for damping in [0.2, 2.0, 20.0, 40.0] {
        let oscillator = Oscillator { mass: 2.0, stiffness: 50.0, damping, position: 0.3, velocity: 1.0 };
        let h = 1e-3;
        for i in 1..200 {
            let t = 0.01 * f64::from(i);
            let [before, now, after] = [t - h, t, t + h].map(|t| oscillator.at(t));
            // Second order: (rate h)²/6 with rates up to 20/s is 7e-5 of slopes up to 4 m/s and 100 m/s².
            let slope = (after.0 - before.0) / (2.0 * h);
            assert!((slope - now.1).abs() < 5e-4, "{damping}: {slope} and {}", now.1);
            let acceleration = (after.1 - before.1) / (2.0 * h);
            let force = -50.0 * now.0 - damping * now.1;
            assert!((2.0 * acceleration - force).abs() < 2e-2, "{damping}: {acceleration} and {force}");
        }
    }
}
