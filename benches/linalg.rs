//! What a factorisation and a solve cost: ropes of rods (chains), cloths of rods (grids).
//!
//! `cargo bench --bench linalg` prints time and throughput in rows a second, values written beforehand.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::time::Duration;
use tautline::engine::linalg::sparse::Ldl;

/// Rods between the given pairs of unit masses, two rods coupled where they share a mass, at a right angle or along a line.
fn rods(ends: &[(u32, u32)], masses: usize) -> Ldl {
    let mut at_mass = vec![Vec::new(); masses];
    for (rod, &(a, b)) in ends.iter().enumerate() {
        at_mass[a as usize].push(rod as u32);
        at_mass[b as usize].push(rod as u32);
    }
    let mut pairs = Vec::new();
    for rods in &at_mass {
        for (k, &i) in rods.iter().enumerate() {
            pairs.extend(rods[..k].iter().map(|&j| (i, j)));
        }
    }
    let mut ldl = Ldl::default();
    ldl.analyse(&vec![1; ends.len()], &pairs);
    for k in 0..ends.len() {
        let slot = ldl.diagonal_slot(k);
        ldl.values_mut()[slot] = 2.0;
    }
    for p in 0..pairs.len() {
        let slot = ldl.pair_slot(p).0;
        ldl.values_mut()[slot] += 0.3;
    }
    ldl
}

fn chain(links: u32) -> Ldl {
    let ends: Vec<_> = (0..links).map(|k| (k, k + 1)).collect();
    rods(&ends, links as usize + 1)
}

fn cloth(side: u32) -> Ldl {
    let mut ends = Vec::new();
    for y in 0..side {
        for x in 0..side {
            let at = y * side + x;
            if x + 1 < side {
                ends.push((at, at + 1));
            }
            if y + 1 < side {
                ends.push((at, at + side));
            }
        }
    }
    rods(&ends, (side * side) as usize)
}

fn bench(c: &mut Criterion, name: &str, size: u32, mut ldl: Ldl, rows: usize) {
    let mut group = c.benchmark_group(name);
    group.sample_size(20).measurement_time(Duration::from_secs(1)).warm_up_time(Duration::from_millis(300));
    group.throughput(Throughput::Elements(rows as u64));
    group.bench_function(BenchmarkId::new("factor", size), |bencher| bencher.iter(|| ldl.factor()));
    let (b, mut x) = (vec![1.0; rows], vec![0.0; rows]);
    group.bench_function(BenchmarkId::new("solve", size), |bencher| {
        bencher.iter(|| {
            x.copy_from_slice(&b);
            ldl.solve(&mut x);
        });
    });
    group.finish();
}

fn chains(c: &mut Criterion) {
    for links in [50, 500, 5000, 10000] {
        bench(c, "chain", links, chain(links), links as usize);
    }
}

fn cloths(c: &mut Criterion) {
    for side in [20, 50] {
        bench(c, "cloth", side, cloth(side), (2 * side * (side - 1)) as usize);
    }
}

fn analyses(c: &mut Criterion) {
    let mut group = c.benchmark_group("analyse");
    group.sample_size(10).measurement_time(Duration::from_secs(1)).warm_up_time(Duration::from_millis(300));
    group.bench_function(BenchmarkId::new("chain", 10000), |bencher| bencher.iter(|| chain(10000)));
    group.bench_function(BenchmarkId::new("cloth", 70), |bencher| bencher.iter(|| cloth(70)));
    group.finish();
}

criterion_group!(benches, chains, cloths, analyses);
criterion_main!(benches);
