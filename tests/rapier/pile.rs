//! What is stacked and piled, where no formula tells each place but heights and overlaps can be compared.

use super::witness::{DEFAULT, single};
use super::{Run, ours};
use tautline::engine::{Body, DVec2, Method, Wall, World};

/// Discs of which none turns, in a box of 2 m that is open above.
fn pile() -> World {
    let mut world = World::new();
    let corners = [(-1.0, 4.0), (-1.0, 0.0), (1.0, 0.0), (1.0, 4.0)].map(|(x, y)| DVec2::new(x, y));
    for pair in corners.windows(2) {
        world.add_wall(&Wall::segment(pair[0], pair[1])).unwrap();
    }
    for i in 0..100 {
        let (column, row) = (f64::from(i % 8), f64::from(i / 8));
        // Every other row is set off sideways, so that the discs do not stand on each other's tops.
        let position = DVec2::new(-0.82 + 0.22 * column + 0.06 * (row % 2.0), 0.15 + 0.22 * row);
        let radius = 0.08 + 0.002 * f64::from(i % 11);
        let mass = std::f64::consts::PI * radius * radius;
        world.add_body(&Body { position, radius, mass, ..Body::default() }).unwrap();
    }
    world
}

/// Top, mean height and deepest overlap at the end [m].
fn measure(world: &World, run: &Run) -> (f64, f64, f64) {
    let (at, radius) = (&run.motion[run.motion.len() - 1], &world.bodies().radius);
    let n = at.len();
    let top = (0..n).map(|i| at[i].y + radius[i]).fold(0.0, f64::max);
    let mean = at.iter().map(|at| at.y).sum::<f64>() / n as f64;
    let pairs = (0..n).flat_map(|i| (0..i).map(move |j| (i, j)));
    let overlap = pairs.map(|(i, j)| radius[i] + radius[j] - at[i].distance(at[j])).fold(0.0, f64::max);
    (top, mean, overlap)
}

#[test]
fn a_pile_comes_to_rest_as_high_as_rapiers_and_overlaps_less() {
    let world = pile();
    let (our, their) = (ours::run(&world, Method::default(), 480), single::run(&world, DEFAULT, 480));
    let ((top, mean, overlap), (their_top, their_mean, their_overlap)) =
        (measure(&world, &our), measure(&world, &their));
    let last = &our.motion[our.motion.len() - 2..];
    let fastest = last[0].iter().zip(&last[1]).map(|(a, b)| 60.0 * a.distance(*b)).fold(0.0, f64::max);
    println!("pile: top {top:.3} m, Rapier {their_top:.3}; mean height {mean:.4}, Rapier {their_mean:.4}");
    println!("deepest overlap {overlap:.1e} m, Rapier {their_overlap:.1e}; fastest of ours {fastest:.1e} m/s");
    println!("{:.0} µs/s, Rapier {:.0}", our.us_per_second(), their.us_per_second());
    // A pile is chaotic: which disc lies where differs, by how much it fills the box hardly. Half a disc at the top.
    assert!((top - their_top).abs() < 0.1, "tops differ");
    assert!((mean - their_mean).abs() < 0.03 * their_mean, "mean heights differ");
    // A tenth of a radius is what an eye sees.
    assert!(overlap < 0.008 && overlap <= their_overlap.max(1e-3), "overlaps");
    assert!(fastest < 0.01, "at rest");
}

#[test]
fn a_stack_of_ten_stands_in_both_and_sinks_less_in_ours() {
    let mut world = World::new();
    world.add_wall(&Wall::segment(DVec2::new(-5.0, 0.0), DVec2::new(5.0, 0.0))).unwrap();
    for i in 0..10 {
        let position = DVec2::new(0.0, 0.5 + f64::from(i));
        world.add_body(&Body { position, radius: 0.5, ..Body::default() }).unwrap();
    }
    let sunk = |run: &Run| {
        let [first, last] = [0, run.motion.len() - 1].map(|k| run.motion[k][9]);
        (first - last).length()
    };
    let (our, their) = (ours::run(&world, Method::default(), 121), single::run(&world, DEFAULT, 121));
    println!("top of ten after 2 s: {:.1e} m off, Rapier {:.1e}", sunk(&our), sunk(&their));
    println!("{:.0} µs/s, Rapier {:.0}", our.us_per_second(), their.us_per_second());
    // Exactly upright both are in balance, unstable but undisturbed; soft contacts give way by some mm each.
    assert!(sunk(&our) < 0.01 && sunk(&their) < 0.1 && sunk(&our) <= sunk(&their).max(1e-4));
}
