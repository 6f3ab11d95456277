//! A warm step allocates nothing.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicU64, Ordering};
use tautline::engine::{Integrator, LinearSolver, Method, Solver, Stepper, World};
use tautline::scene;

/// The system's allocator, counting.
struct Counting;

static ALLOCATIONS: AtomicU64 = AtomicU64::new(0);

// SAFETY: every call is handed to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Allocations in 100 steps of a shipped scene after `warm_up` steps.
fn allocations(name: &str, change: impl Fn(Method) -> Method, warm_up: u32) -> u64 {
    let setup = scene::open(name).unwrap();
    let mut world: World = setup.world;
    let mut stepper = Stepper::new(change(setup.method)).unwrap();
    (0..warm_up).for_each(|_| drop(stepper.step(&mut world)));
    let before = ALLOCATIONS.load(Ordering::Relaxed);
    (0..100).for_each(|_| drop(stepper.step(&mut world)));
    ALLOCATIONS.load(Ordering::Relaxed) - before
}

/// The only test in this file: another one at the same time would be counted too.
#[test]
fn a_warm_step_allocates_nothing() {
    // Warm is a scene that has had its largest number of contacts. The pile has come to rest by 10 s.
    let scenes = [
        ("bridge", 600),
        ("rope", 60),
        ("cloth", 60),
        ("newtons_cradle", 300),
        ("stack", 60),
        ("soft_body", 600),
        ("pile", 600),
    ];
    assert!(ALLOCATIONS.load(Ordering::Relaxed) > 0, "the counter counts");
    for (name, warm_up) in scenes {
        // The pile once, as it takes a while to come to rest.
        for solver in Solver::ALL.into_iter().filter(|solver| name != "pile" || *solver == Solver::Pgs) {
            let found = allocations(name, |method| Method { automatic: false, solver, ..method }, warm_up);
            println!("{name}, {}: {found} allocations in 100 warm steps", solver.name());
            assert_eq!(found, 0, "{name}, {}", solver.name());
        }
    }
    for name in ["truth/bridge", "truth/cloth", "truth/stiff_chain", "truth/rigid_net"] {
        for integrator in Integrator::ALL.into_iter().filter(|integrator| integrator.is_direct()) {
            let found = allocations(name, |method| Method { automatic: false, integrator, ..method }, 10);
            assert_eq!(found, 0, "{name}, {}", integrator.name());
        }
    }
    for name in ["disc_chain", "crank", "hard/heavy_disc_chain"] {
        for accuracy in [1e-3, 1e-9] {
            let found = allocations(name, |method| Method { accuracy, ..method }, 60);
            assert_eq!(found, 0, "{name} to {accuracy:e}");
        }
    }
    for (name, warm_up) in [("hard/bouncing_ball", 300), ("hard/weighing", 10), ("hard/bounce_box", 60), ("stack", 10)]
    {
        let found = allocations(name, |method| Method { automatic: true, ..method }, warm_up);
        assert_eq!(found, 0, "{name} by accuracy");
    }
    // Warm is an island that has seen a contest of all methods which may be the cheapest in the motion that it goes through.
    for name in ["truth/bridge", "truth/rope", "truth/heavy_rope", "truth/stiff_chain"] {
        for accuracy in [1e-3, 1e-6, 1e-9] {
            let found = allocations(name, |method| Method { accuracy, ..method }, 1800);
            println!("{name} to {accuracy:e}: {found} allocations");
            assert_eq!(found, 0, "{name} to {accuracy:e}");
        }
    }
    for linear in LinearSolver::ALL {
        let found = allocations(
            "truth/bridge",
            |method| Method { automatic: false, integrator: Integrator::Rattle, linear, ..method },
            10,
        );
        assert_eq!(found, 0, "{}", linear.name());
    }
}
