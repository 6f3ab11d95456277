//! Fronts, interpolation and sentences against cases by hand.

use super::point;
use tautline::engine::{Integrator, Solver};
use tautline::lab::{Front, Point, Setting};

/// Cost and error of what is on the front of points with these.
fn front(figures: &[(f64, Option<f64>)]) -> Vec<(f64, f64)> {
    let points: Vec<Point> =
        figures.iter().enumerate().map(|(i, (cost, error))| point("rattle", i as u32 + 1, *cost, *error)).collect();
    Front::of(&points).points().iter().map(|point| (point.cpu_us_per_second, point.error.unwrap())).collect()
}

#[test]
fn the_front_is_what_no_other_beats_in_both() {
    let figures = [
        (300.0, Some(1e-6)),
        (100.0, Some(1e-2)),
        // Dearer than the one before and no better
        (200.0, Some(1e-2)),
        // As dear as the first and worse
        (300.0, Some(1e-5)),
        (150.0, Some(1e-3)),
        // Diverged
        (1.0, None),
        (400.0, Some(2e-6)),
    ];
    assert_eq!(front(&figures), [(100.0, 1e-2), (150.0, 1e-3), (300.0, 1e-6)]);
    assert_eq!(front(&[]), []);
    assert_eq!(front(&[(1.0, None)]), []);
    // Two alike: one of them.
    assert_eq!(front(&[(5.0, Some(0.1)), (5.0, Some(0.1))]), [(5.0, 0.1)]);
    // An error of nothing is the end of every front.
    assert_eq!(front(&[(5.0, Some(0.0)), (6.0, Some(1e-300))]), [(5.0, 0.0)]);
}

#[test]
fn along_the_front_logarithms_are_straight() {
    let points = [point("rattle", 1, 10.0, Some(1e-2)), point("taylor", 2, 1000.0, Some(1e-8))];
    let front = Front::of(&points);
    let close = |found: Option<f64>, expected: f64| (found.unwrap() / expected - 1.0).abs() < 1e-12;
    // Half-way between 10 and 1000 is 100, between 1e-2 and 1e-8 is 1e-5; a quarter is 10^1.5 and 10^-3.5.
    assert!(close(front.error_at(100.0), 1e-5));
    assert!(close(front.error_at(10f64.powf(1.5)), 10f64.powf(-3.5)));
    assert!(close(front.cost_for(1e-5), 100.0));
    assert!(close(front.error_at(10.0), 1e-2) && close(front.cost_for(1e-2), 10.0));
    // What is paid beyond the last brings nothing; what is wanted beyond it is not to be had.
    assert_eq!((front.error_at(1e6), front.error_at(9.9)), (Some(1e-8), None));
    assert_eq!((front.cost_for(1.0), front.cost_for(1e-9)), (Some(10.0), None));
    assert_eq!(Front::default().error_at(1.0), None);
}

#[test]
fn advice_names_a_setting_that_was_measured() {
    let points = [point("rattle", 4, 10.0, Some(1e-2)), point("energy-momentum", 1, 1000.0, Some(2.5e-8))];
    let front = Front::of(&points);
    assert_eq!(
        front.advice_for_error(1e-3),
        "For an error of 1e-3 use Energy–momentum midpoint, 1 substep: error 2.5e-8 at 1000 µs/s."
    );
    assert!(front.advice_for_error(1e-9).starts_with("Nothing measured reaches an error of 1e-9; the best is Energy"));
    assert_eq!(
        front.advice_for_budget(999.0),
        "For 999 µs per simulated second use RATTLE, 4 substeps: error 1e-2 at 10 µs/s."
    );
    assert!(front.advice_for_budget(1.0).contains("the cheapest is RATTLE"));
    assert_eq!(Front::default().advice_for_error(1.0), "Nothing with an error was measured yet.");
}

#[test]
fn the_gain_over_the_baseline_is_told_at_its_cost_and_at_its_error() {
    let base = Setting::BASELINE;
    let baseline = Point { iterations: base.iterations, ..point("semi-implicit-euler+pgs", 4, 100.0, Some(1e-2)) };
    assert_eq!(baseline.setting(), base);
    let points = [point("rattle", 1, 25.0, Some(5e-3)), point("taylor", 1, 100.0, Some(1e-8)), baseline.clone()];
    let gain = Front::of(&points).gain(&points, base).unwrap();
    let at_cost = gain.at_its_cost.clone().unwrap();
    assert_eq!((at_cost.0.method.key().as_str(), (at_cost.1 / 1e6 - 1.0).abs() < 1e-12), ("taylor", true));
    let at_error = gain.at_its_error.clone().unwrap();
    assert_eq!((at_error.0.method.key().as_str(), at_error.1), ("rattle", 4.0));
    let said = gain.sentence();
    assert!(said.contains("1e6 times smaller (Taylor") && said.contains("4.0 times cheaper (RATTLE"), "{said}");
    assert_eq!(Front::of(&points[..2]).gain(&points[..2], base), None);
    // One that is best itself has nothing to gain.
    let alone = [baseline];
    assert_eq!(Front::of(&alone).gain(&alone, base).unwrap().at_its_cost.unwrap().1, 1.0);
}

#[test]
fn settings_become_methods_and_say_what_they_are() {
    let scene = tautline::engine::Method { iterations: 33, baumgarte: 0.2, ..Default::default() };
    let swept = Setting::substepped(Integrator::VelocityVerlet, Solver::Projection, 16, 2).method(scene);
    assert_eq!((swept.integrator, swept.solver), (Integrator::VelocityVerlet, Solver::Projection));
    assert_eq!((swept.substeps, swept.iterations, swept.automatic, swept.baumgarte), (16, 2, false, 0.2));
    let dial = Setting::dial(1e-9).method(scene);
    assert_eq!((dial.automatic, dial.accuracy, dial.iterations), (true, 1e-9, 33));
    let labels =
        [Setting::BASELINE, Setting::dial(1e-9), Setting::direct(Integrator::Rattle, 4), Setting::taylor(1e-7)];
    let labels = labels.map(|setting| Setting { hz: 240.0, ..setting }.label());
    assert_eq!(
        labels,
        [
            "Semi-implicit Euler + PGS, 4 × 10 at 240 Hz",
            "Accuracy 1e-9 at 240 Hz",
            "RATTLE, 4 substeps at 240 Hz",
            "Taylor series to 1e-7 at 240 Hz"
        ]
    );
}
