//! The course's linear solvers as solvers of a scene.

use tautline::engine::{Body, Constraint, DVec2, Integrator, Kind, LinearSolver, Method, Stepper, World};
use tautline::measure::{Measures, error_against};
use tautline::scene;
use tautline::truth::stored;

fn taylor(linear: LinearSolver, iterations: u32) -> Method {
    Method { integrator: Integrator::Taylor, accuracy: 1e-8, linear, iterations, ..Method::default() }
}

/// Error against the truth, worst linear residual, most sweeps, and the number of islands given up.
fn run(name: &str, method: Method, steps: usize) -> (f64, f64, u32, usize) {
    let truth = stored(name).unwrap();
    let mut world = scene::open(name).unwrap().world;
    let mut stepper = Stepper::new(method).unwrap();
    let mut motion = vec![world.bodies().position.clone()];
    let (mut residual, mut sweeps, mut given_up) = (0.0f64, 0, 0);
    for _ in 0..steps.min(truth.times.len() - 1) {
        let report = stepper.step(&mut world);
        assert!(report.divergence.is_none(), "{name}: {:?}", report.divergence);
        residual = residual.max(report.linear_residual);
        sweeps = sweeps.max(report.sweeps);
        given_up += report.given_up;
        motion.push(world.bodies().position.clone());
    }
    (error_against(&truth.positions[..motion.len()], &motion, truth.length).unwrap(), residual, sweeps, given_up)
}

#[test]
fn dense_methods_solve_a_scene_as_exactly_as_the_sparse_one() {
    for name in ["truth/double_pendulum", "truth/bridge", "truth/rope"] {
        for linear in LinearSolver::ALL.into_iter().filter(|linear| !linear.is_iterative()) {
            let (error, residual, _, given_up) = run(name, taylor(linear, 10), 15);
            println!("{name}, {}: error {error:.1e}, residual {residual:.1e}", linear.name());
            assert!(error < 1e-8 && given_up == 0, "{name}, {}: {error:e}", linear.name());
            // Backward stable methods leave some n ε times the growth of the solution.
            assert!(residual < 1e-9, "{name}, {}: {residual:e}", linear.name());
        }
    }
}

#[test]
fn conjugate_gradients_solve_n_rows_in_about_n_sweeps() {
    for (name, rows) in [("truth/double_pendulum", 2), ("truth/rope", 50)] {
        let (error, residual, sweeps, _) = run(name, taylor(LinearSolver::ConjugateGradients, 4 * rows + 20), 30);
        println!("{name}: error {error:.1e}, residual {residual:.1e} in {sweeps} sweeps");
        assert!(error < 1e-7 && residual < 1e-9, "{name}: {error:e}, {residual:e}");
    }
}

#[test]
fn sweeps_of_gauss_seidel_approach_the_solution_and_too_few_are_felt() {
    let name = "truth/double_pendulum";
    let errors = [1, 5, 60].map(|iterations| run(name, taylor(LinearSolver::GaussSeidel, iterations), 45).0);
    println!("{name}, Gauss-Seidel with 1, 5 and 60 sweeps: {:.1e}, {:.1e}, {:.1e}", errors[0], errors[1], errors[2]);
    assert!(errors[0] > 10.0 * errors[2] && errors[2] < 1e-7, "{errors:?}");
}

/// n rods from one fixed point to a body, all along x: A = n rows of ones over the mass, so that Jacobi's matrix 1 − D⁻¹A has the
/// eigenvalue 1 − n: it diverges for n > 2 where anything is left to correct, and Gauss-Seidel ends after one sweep.
fn parallel_rods(n: usize) -> World {
    let mut world = World::new();
    let a = world.add_body(&Body { position: DVec2::new(1.0, 0.0), radius: 0.0, ..Body::default() }).unwrap();
    for _ in 0..n {
        world.add_constraint(&Constraint::to_world(Kind::Rod { length: 1.0 }, a, DVec2::ZERO)).unwrap();
    }
    world
}

#[test]
fn redundant_rods_are_shared_reported_or_given_up_but_never_lost() {
    for linear in LinearSolver::ALL {
        let mut world = parallel_rods(3);
        let mut stepper = Stepper::new(taylor(linear, 50)).unwrap();
        let (mut given_up, mut redundant) = (0, 0);
        for _ in 0..30 {
            let report = stepper.step(&mut world);
            assert!(report.divergence.is_none(), "{}: {report:?}", linear.name());
            given_up += report.given_up;
            redundant = redundant.max(report.redundant);
        }
        println!("{}: {given_up} of 30 steps given up, {redundant} rows dropped", linear.name());
        assert!((world.bodies().position[0].length() - 1.0).abs() < 1e-2, "{}", linear.name());
        match linear {
            LinearSolver::SparseLdl | LinearSolver::LeastSquares => assert!(given_up == 0 && redundant == 2),
            LinearSolver::GaussSeidel | LinearSolver::ConjugateGradients => assert_eq!(given_up, 0),
            LinearSolver::Jacobi => assert!(given_up > 0, "its spectral radius is 2"),
            _ => {}
        }
    }
}

#[test]
fn a_large_island_is_solved_by_the_sparse_method_and_the_plan_says_so() {
    let net = scene::open("truth/rigid_net").unwrap().world;
    let method = taylor(LinearSolver::Lu, 10);
    let mut stepper = Stepper::new(method).unwrap();
    let plan = stepper.plan(&net);
    assert_eq!(plan.islands[0].linear.0, LinearSolver::SparseLdl);
    let sentence = plan.sentence(&net, &method);
    assert!(sentence.contains("solved by LU (1 island of more than 400 rows by sparse LDL)"), "{sentence}");
    let rope = scene::open("truth/rope").unwrap().world;
    let method = taylor(LinearSolver::GaussSeidel, 10);
    let mut stepper = Stepper::new(method).unwrap();
    let plan = stepper.plan(&rope);
    assert_eq!(plan.islands[0].linear, (LinearSolver::GaussSeidel, 10));
    let sentence = plan.sentence(&rope, &method);
    assert!(sentence.contains("solved by Gauss-Seidel in at most 10 sweeps"), "{sentence}");
}

#[test]
fn every_linear_solver_gives_the_same_bits_with_a_fresh_stepper() {
    for linear in LinearSolver::ALL {
        for integrator in [Integrator::Taylor, Integrator::Rattle, Integrator::RungeKutta4] {
            let method = Method { integrator, ..taylor(linear, 20) };
            let mut worlds = [(); 2].map(|()| scene::open("truth/bridge").unwrap().world);
            let mut stepper = Stepper::new(method).unwrap();
            for _ in 0..3 {
                stepper.step(&mut worlds[0]);
                Stepper::new(method).unwrap().step(&mut worlds[1]);
            }
            assert_eq!(worlds[0].hash(), worlds[1].hash(), "{}, {}", linear.name(), integrator.name());
            assert!(Measures::of(&worlds[0]).kinetic.is_finite());
        }
    }
}
