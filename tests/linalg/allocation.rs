//! A warm factorisation and a warm solve allocate nothing. Counted by thread, as the other tests run at the same time.

use crate::problems::*;
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use tautline::engine::linalg::dense::{Cholesky, Lu, Matrix, Qr, SingularValues};
use tautline::engine::linalg::iterative::{
    Csr, Preconditioner, Stop, Workspace, conjugate_gradients, gauss_seidel, jacobi, projected_gauss_seidel,
};
use tautline::engine::linalg::sparse::Ldl;

/// The system's allocator, counting.
struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

fn count() {
    // Not there any more while the thread ends.
    let _ = ALLOCATIONS.try_with(|count| count.set(count.get() + 1));
}

// SAFETY: every call is handed to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn allocations(work: impl FnOnce()) -> u64 {
    let before = ALLOCATIONS.get();
    work();
    ALLOCATIONS.get() - before
}

#[test]
fn the_counter_counts() {
    assert!(allocations(|| drop(std::hint::black_box(vec![1.0; 100]))) > 0);
}

/// Straight after the analysis, with rows to be dropped and listed too.
#[test]
fn sparse_factor_and_solve_allocate_nothing() {
    let random = &mut Random(17);
    let parts =
        [chain(9, 1), chain(6, 2), chain(5, 3), grid(5, 2), tree(9, random), anything(12, 2, random), chain(1, 3)];
    let constraints = side_by_side(&parts, random);
    let jacobian = constraints.jacobian(random);
    let matrix = &jacobian * jacobian.transpose();
    let b = &jacobian * random.vector(jacobian.ncols());
    let (mut ldl, _): (Ldl, _) = prepared(&constraints, &matrix);
    let (mut x, mut r) = (b.clone(), b.clone());
    let found = allocations(|| {
        assert!(ldl.factor().dropped > 0);
        ldl.solve(x.as_mut_slice());
        ldl.refine(b.as_slice(), x.as_mut_slice());
        ldl.residual(b.as_slice(), x.as_slice(), r.as_mut_slice());
    });
    assert_eq!(found, 0);
}

#[test]
fn dense_methods_allocate_nothing_for_the_second_matrix() {
    let n = 12;
    let spd =
        |shift: f64| Matrix::from_fn(n, n, |i, j| if i == j { 4.0 + shift } else { 1.0 / (1.0 + (i + j) as f64) });
    let (first, second) = (spd(0.0), spd(1.0));
    let (mut lu, mut cholesky, mut qr, mut singular) =
        (Lu::default(), Cholesky::default(), Qr::default(), SingularValues::default());
    let (b, mut x) = (vec![1.0; n], vec![1.0; n]);
    let mut work = |matrix: &Matrix| {
        lu.factor(matrix).unwrap();
        lu.solve(&mut x);
        cholesky.factor(matrix).unwrap();
        cholesky.solve(&mut x);
        qr.factor(matrix, 1e-12).unwrap();
        qr.solve(&b, &mut x);
        singular.of(matrix).unwrap();
    };
    work(&first);
    assert_eq!(allocations(|| work(&second)), 0);
}

#[test]
fn iterations_allocate_nothing_the_second_time() {
    let n = 30;
    let entries: Vec<_> = (0..n).flat_map(|i| [(i, i, 3.0), (i, (i + 1) % n, -1.0), ((i + 1) % n, i, -1.0)]).collect();
    let (a, b, mut workspace) = (Csr::from_entries(n as usize, &entries), vec![1.0; n as usize], Workspace::default());
    let stop = Stop { tolerance: 1e-10, sweeps: 500 };
    let mut x = vec![0.0; n as usize];
    let mut work = || {
        x.fill(0.0);
        jacobi(&a, &b, &mut x, 0.5, stop, &mut workspace);
        gauss_seidel(&a, &b, &mut x, 1.0, stop, &mut workspace);
        projected_gauss_seidel(&a, &b, &mut x, |_| (0.0, 0.5), 1.0, stop, &mut workspace);
        conjugate_gradients(&a, &b, &mut x, Preconditioner::Diagonal, stop, &mut workspace);
    };
    work();
    assert_eq!(allocations(work), 0);
}
