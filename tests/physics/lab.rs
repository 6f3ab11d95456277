//! One-line worlds, methods and runs.

use tautline::engine::{Body, DVec2, Integrator, Method, Solver, StepReport, Stepper, Wall, World};

/// Gravity of the tests [m/s²].
pub const G: f64 = 9.81;

pub fn v(x: f64, y: f64) -> DVec2 {
    DVec2::new(x, y)
}

/// A world without gravity.
pub fn weightless() -> World {
    let mut world = World::new();
    world.set_gravity(DVec2::ZERO).unwrap();
    world
}

/// A disc of 1 kg and 0.1 m without spin, friction or restitution.
pub fn ball(position: DVec2, velocity: DVec2) -> Body {
    Body { position, velocity, friction: 0.0, ..Body::default() }
}

/// A mass of 1 kg that touches nothing.
pub fn point(position: DVec2, velocity: DVec2) -> Body {
    Body { position, velocity, radius: 0.0, ..Body::default() }
}

/// A segment wall without friction.
pub fn smooth(from: DVec2, to: DVec2) -> Wall {
    Wall { friction: 0.0, ..Wall::segment(from, to) }
}

/// `base` with every integrator of the substep loop and every solver.
pub fn every_method(base: Method) -> impl Iterator<Item = Method> {
    let solvers = move |integrator| Solver::ALL.map(|solver| Method { integrator, solver, ..base });
    Integrator::SUBSTEPPED.into_iter().flat_map(solvers)
}

/// `base` with every integrator of the substep loop: for motion that no solver touches.
pub fn every_integrator(base: Method) -> impl Iterator<Item = Method> {
    Integrator::SUBSTEPPED.into_iter().map(move |integrator| Method { integrator, ..base })
}

/// Steps of 1/hz seconds of so many substeps, each of so many sweeps.
pub fn rate(hz: f64, substeps: u32, iterations: u32) -> Method {
    Method { hz, substeps, iterations, ..Method::default() }
}

/// "Velocity Verlet, PGS on velocities"
pub fn label(method: &Method) -> String {
    format!("{}, {}", method.integrator.name(), method.solver.name())
}

/// Whether the integrator is one of the second order.
pub fn second_order(method: &Method) -> bool {
    matches!(method.integrator, Integrator::PositionVerlet | Integrator::VelocityVerlet)
}

/// Steps `world` for `seconds` and shows every step to `see`. Divergence fails the test.
pub fn watch(world: &mut World, method: Method, seconds: f64, mut see: impl FnMut(&World, &StepReport)) {
    let mut stepper = Stepper::new(method).unwrap();
    for _ in 0..(seconds * method.hz).round() as u64 {
        let report = stepper.step(world);
        assert!(report.divergence.is_none(), "{}: {}", label(&method), report.divergence.unwrap());
        see(world, &report);
    }
}

/// Steps `world` for `seconds`.
pub fn run(world: &mut World, method: Method, seconds: f64) {
    watch(world, method, seconds, |_, _| {});
}

pub fn position(world: &World, body: usize) -> DVec2 {
    world.bodies().position[body]
}

pub fn velocity(world: &World, body: usize) -> DVec2 {
    world.bodies().velocity[body]
}

/// Linear momentum of all bodies [kg·m/s].
pub fn momentum(world: &World) -> DVec2 {
    let bodies = world.bodies();
    (0..bodies.len()).map(|i| bodies.mass[i] * bodies.velocity[i]).sum()
}

/// Kinetic energy of translation and rotation of all bodies [J].
pub fn kinetic_energy(world: &World) -> f64 {
    let bodies = world.bodies();
    let of = |i: usize| {
        let spin = bodies.spin(i).map_or(0.0, |spin| 0.25 * (bodies.radius[i] * spin.omega).powi(2));
        bodies.mass[i] * (0.5 * bodies.velocity[i].length_squared() + spin)
    };
    (0..bodies.len()).map(of).sum()
}
