//! What a step costs, and how that grows: ropes, cloths and piles, per body and per constraint.
//!
//! `cargo bench --bench step` prints the time of one step (1/60 s: 4 substeps × 10 sweeps, semi-implicit Euler, PGS; piles
//! 4 sweeps) and the throughput in constraints (ropes, cloths) or bodies (piles) a second. The error of the same settings is
//! measured by the tests; a time alone says nothing about a method.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::time::Duration;
use tautline::engine::{Stepper, World};
use tautline::scene::{Setup, parse};

/// A scene of one generator line, as a file would state it.
fn scene(settings: &str, walls: &str, generator: &str) -> Setup {
    let text = format!("(version: 1, settings: ({settings}), walls: [{walls}], generators: [{generator}])");
    parse("bench", &text).expect("the bench's scenes are right")
}

/// Times steps of a world that has run for `seconds`, so that piles lie and ropes hang.
fn bench_step(c: &mut Criterion, group: &str, size: usize, setup: Setup, seconds: f64, elements: fn(&World) -> usize) {
    let mut world = setup.world;
    let mut stepper = Stepper::new(setup.method).expect("the bench's method is right");
    for _ in 0..(seconds * setup.method.hz) as usize {
        assert_eq!(stepper.step(&mut world).divergence, None);
    }
    let mut group = c.benchmark_group(group);
    group.sample_size(10).measurement_time(Duration::from_secs(3)).warm_up_time(Duration::from_millis(500));
    group.throughput(Throughput::Elements(elements(&world) as u64));
    group.bench_function(BenchmarkId::from_parameter(size), |bencher| bencher.iter(|| stepper.step(&mut world)));
    group.finish();
}

fn ropes(c: &mut Criterion) {
    for links in [50, 500, 5000] {
        let end = links as f64 * 0.1;
        let rope = format!("Rope(from: (0, 0), to: ({end:?}, 0), links: {links}, mass: 0.1)");
        bench_step(c, "rope", links, scene("", "", &rope), 0.5, |world| world.constraints().len());
    }
}

fn cloths(c: &mut Criterion) {
    for side in [20, 50] {
        let cloth = format!("Cloth(corner: (0, 0), columns: {side}, rows: {side})");
        bench_step(c, "cloth", side, scene("", "", &cloth), 0.5, |world| world.constraints().len());
    }
}

fn piles(c: &mut Criterion) {
    for (count, width, seconds) in [(200, 3.0, 5.0), (2000, 10.0, 5.0), (20000, 32.0, 3.0)] {
        let half = width / 2.0;
        let walls = format!(
            "Box(min: (-{0}, -1), max: ({0}, 0)), Box(min: (-{0}, 0), max: (-{half}, {width})), Box(min: ({half}, 0), max: ({0}, {width}))",
            half + 1.0
        );
        let pile =
            format!("Pile(count: {count}, min: (-{half:?}, 0), max: ({half:?}, {width:?}), radius: (0.05, 0.1))");
        let setup = scene("iterations: 4", &walls, &pile);
        bench_step(c, "pile", count, setup, seconds, |world| world.bodies().len());
    }
}

criterion_group!(benches, ropes, cloths, piles);
criterion_main!(benches);
