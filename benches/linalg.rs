//! What a factorisation and a solve cost: ropes (chains), bridges (chains of blocks), cloths of rods (grids).
//!
//! `cargo bench --bench linalg` prints time and throughput in rows a second, values written beforehand.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::time::Duration;
use tautline::engine::linalg::sparse::Ldl;
use tautline::engine::linalg::sparse::block_tridiagonal::{factor_block_tridiagonal, solve_block_tridiagonal};

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

/// A rope whose middle mass is held by a grip of two rows: no chain any more, but still without fill.
fn held_rope(links: u32) -> Ldl {
    let mut pairs: Vec<_> = (1..links).map(|k| (k, k - 1)).collect();
    pairs.extend([(links, links / 2), (links, links / 2 + 1)]);
    let mut sizes = vec![1; links as usize];
    sizes.push(2);
    blocks(&sizes, &pairs)
}

/// Hinges (2 rows) or welds (3 rows) in a row.
fn block_chain(links: u32, size: u8) -> Ldl {
    let pairs: Vec<_> = (1..links).map(|k| (k, k - 1)).collect();
    blocks(&vec![size; links as usize], &pairs)
}

/// 4 on the diagonal, 0.3 elsewhere.
fn blocks(sizes: &[u8], pairs: &[(u32, u32)]) -> Ldl {
    let mut ldl = Ldl::default();
    ldl.analyse(sizes, pairs);
    ldl.values_mut().fill(0.3);
    for (k, &size) in sizes.iter().enumerate() {
        let slot = ldl.diagonal_slot(k);
        (0..usize::from(size)).for_each(|row| ldl.values_mut()[slot + row * (usize::from(size) + 1)] = 4.0);
    }
    ldl
}

fn other_chains(c: &mut Criterion) {
    bench(c, "held rope", 5000, held_rope(5000), 5002);
    for size in [2, 3] {
        bench(c, &format!("chain of {size} x {size}"), 5000, block_chain(5000, size), 5000 * usize::from(size));
    }
    let mut group = c.benchmark_group("saddle tridiagonal of 3 x 3");
    let (n, off) = (5000, vec![[[0.1, 0.2, 0.3]; 3]; 4999]);
    let diagonal = vec![[[4.0, 0.5, 1.0], [0.5, 4.0, 1.0], [1.0, 1.0, 0.0]]; n];
    let (mut inverses, mut multipliers) = (diagonal.clone(), off.clone());
    group.sample_size(20).measurement_time(Duration::from_secs(1)).warm_up_time(Duration::from_millis(300));
    group.throughput(Throughput::Elements(n as u64));
    group.bench_function(BenchmarkId::new("factor", n), |bencher| {
        bencher.iter(|| factor_block_tridiagonal(&diagonal, &off, &off, &mut inverses, &mut multipliers));
    });
    let mut x = vec![[1.0; 3]; n];
    group.bench_function(BenchmarkId::new("solve", n), |bencher| {
        bencher.iter(|| {
            x.fill([1.0; 3]);
            solve_block_tridiagonal(&inverses, &multipliers, &off, &off, &mut x);
        });
    });
    group.finish();
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

criterion_group!(benches, chains, other_chains, cloths, analyses);
criterion_main!(benches);
