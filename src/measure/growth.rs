//! How far the motion itself carries errors: what becomes of a small disturbance.

use crate::engine::{DVec2, EngineError, Method, StepReport, Stepper, World};

/// From which growth on it is worth a word: below it an accuracy of 1e-3 is still one of a tenth.
pub const SENSITIVE: f64 = 20.0;

/// Size of the disturbance, in parts of the scene's length: so small that only its first power counts, so large that a
/// step which the two runs divide differently does not show. Their accuracy is [`ACCURACY`] or that of the run.
const SIZE: f64 = 1e-4;
const ACCURACY: f64 = 1e-6;

/// What the two runs may cost more than [`RATIO`] times the run beside them, in steps of one body: a second or so.
const MOST_WORK: u64 = 1_000_000;
const RATIO: u64 = 10;

/// Growth beyond which no digit of a number would be left; how far beyond says nothing more.
const TOTAL: f64 = 1e16;

/// The difference is brought back to [`SIZE`] when it has left it by this factor.
const LINEAR: f64 = 10.0;

/// Follows two runs of a world that begin with slightly different velocities, and says how far they part.
///
/// The difference of two neighbouring motions obeys a linear equation, so that it may be scaled whenever it grows too
/// large for that; the factors add up in a logarithm (Benettin, Galgani, Giorgilli, Strelcyn, Meccanica 15, 1980).
/// Velocities are disturbed by a smooth field over the scene, which no constraint contradicts; with a time unit of
/// √(length/gravity) they count as distances. Growth is the distance of the positions against the disturbance: 1 for a
/// pendulum that hangs, t in time units for what flies freely, sinh t for what stands on its head. What the run itself
/// does is not touched.
///
/// It ends where a step goes through the substeps, for these are not followed to an accuracy that could be amplified,
/// and where following both runs that exactly costs far more than the run itself.
pub struct Growth {
    base: World,
    disturbed: World,
    steppers: [Stepper; 2],
    /// Of the scene [m], and the time in which velocities are distances [s].
    length: f64,
    unit: f64,
    /// Logarithm of the factors by which the difference was scaled down.
    scaled: f64,
    /// The difference after the first step, when it fits the constraints [m]; 0 before.
    first: f64,
    /// Logarithm of the largest growth so far.
    largest: f64,
    /// Work of the two runs, and what they may do, in steps of one body.
    work: u64,
    allowed: u64,
    /// Where it ended [s].
    ended: Option<f64>,
}

/// Root mean squares over the bodies that move [m]: of positions alone, and with velocities and turns.
struct Difference {
    position: f64,
    whole: f64,
}

impl Growth {
    /// Follows `world` under `method` by accuracy; `length` [m] is that of the scene.
    ///
    /// # Errors
    /// If the method cannot be used.
    pub fn new(world: &World, method: &Method, length: f64) -> Result<Growth, EngineError> {
        let method = Method { automatic: true, accuracy: method.accuracy.min(ACCURACY), ..*method };
        let unit = unit(world, length);
        let mut disturbed = world.clone();
        disturb(&mut disturbed, length, unit);
        Ok(Growth {
            base: world.clone(),
            disturbed,
            steppers: [Stepper::new(method)?, Stepper::new(method)?],
            length,
            unit,
            scaled: 0.0,
            first: 0.0,
            largest: 0.0,
            work: 0,
            allowed: MOST_WORK,
            ended: None,
        })
    }

    /// Takes a step of both runs, if it has not ended, after the run beside them took one that told `report`.
    pub fn step(&mut self, report: &StepReport) {
        if self.ended.is_some() {
            return;
        }
        let time = self.base.time();
        let [base, disturbed] = &mut self.steppers;
        let reports = [base.step(&mut self.base), disturbed.step(&mut self.disturbed)];
        self.work += reports.iter().map(work).sum::<u64>();
        self.allowed += RATIO * work(report);
        let Difference { position, whole } = self.difference();
        let carried = |report: &StepReport| report.divergence.is_none() && report.substeps == 0;
        let followed = reports.iter().all(carried) && self.work <= self.allowed;
        if !followed || !whole.is_finite() {
            self.ended = Some(time);
            return;
        }
        if self.first == 0.0 {
            self.first = whole;
        } else if position > 0.0 {
            self.largest = self.largest.max(self.scaled + libm::log(position / self.first));
        }
        let wanted = SIZE * self.length;
        if whole > LINEAR * wanted || whole > 0.0 && whole < wanted / LINEAR {
            self.scale(wanted / whole);
            self.scaled += libm::log(whole / wanted);
        }
    }

    /// By how much errors that were made at the start have grown at most so far, ≥ 1; `None` where nothing is known: at
    /// the start, and where the first step already went through the substeps or nothing moves.
    pub fn factor(&self) -> Option<f64> {
        // What overflows is sensitive beyond all use.
        (self.first > 0.0).then(|| libm::exp(self.largest.min(700.0)))
    }

    /// Since when it is not followed any more [s].
    pub fn ended(&self) -> Option<f64> {
        self.ended
    }

    /// "4e5-fold", if they grow enough to say so.
    pub fn fold(&self) -> Option<String> {
        let factor = self.factor().filter(|factor| *factor >= SENSITIVE)?;
        Some(match factor {
            _ if factor < 1e3 => format!("{factor:.0}-fold"),
            _ if factor < TOTAL => format!("{factor:.0e}-fold"),
            _ => format!("more than {TOTAL:e}-fold"),
        })
    }

    /// "errors grow 4e5-fold in this motion", if they grow enough to say so.
    pub fn sentence(&self) -> Option<String> {
        let fold = self.fold()?;
        Some(match self.ended {
            None => format!("errors grow {fold} in this motion"),
            Some(time) => format!("errors grow {fold} in the first {time:.2} s"),
        })
    }

    /// Does the same to both worlds, such as what a hand does to the run that is followed. Where it cannot be done it ends here.
    pub fn change(&mut self, mut change: impl FnMut(&mut World) -> bool) {
        let done = [&mut self.base, &mut self.disturbed].map(&mut change);
        if done != [true; 2] || self.base.bodies().id != self.disturbed.bodies().id {
            self.ended.get_or_insert(self.base.time());
        }
    }

    /// Steps at another rate from now on [Hz].
    ///
    /// # Errors
    /// If there is no such rate.
    pub fn set_rate(&mut self, hz: f64) -> Result<(), EngineError> {
        let method = Method { hz, ..*self.steppers[0].method() };
        self.steppers.iter_mut().try_for_each(|stepper| stepper.set_method(method))
    }

    fn difference(&self) -> Difference {
        let (a, b) = (self.base.bodies(), self.disturbed.bodies());
        let (mut position, mut velocity, mut turns, mut count) = (0.0, 0.0, 0.0, 0_u32);
        for i in (0..a.len()).filter(|&i| self.base.is_dynamic(i)) {
            position += (b.position[i] - a.position[i]).length_squared();
            velocity += (b.velocity[i] - a.velocity[i]).length_squared();
            count += 1;
            // A turn moves the rim.
            if let (Some(first), Some(second)) = (a.spin(i), b.spin(i)) {
                let (turned, faster) = (second.angle - first.angle, second.omega - first.omega);
                let rim = a.radius[i] * a.radius[i];
                turns += rim * (turned * turned + self.unit * self.unit * faster * faster);
            }
        }
        let mean = |squares: f64| (squares / f64::from(count.max(1))).sqrt();
        Difference { position: mean(position), whole: mean(position + self.unit * self.unit * velocity + turns) }
    }

    /// Moves the disturbed run towards the other one, or away from it.
    fn scale(&mut self, factor: f64) {
        let (a, b) = (&self.base.bodies, &mut self.disturbed.bodies);
        let scale = |there: &mut DVec2, here: &DVec2| *there = *here + factor * (*there - *here);
        b.position.iter_mut().zip(&a.position).for_each(|(there, here)| scale(there, here));
        b.velocity.iter_mut().zip(&a.velocity).for_each(|(there, here)| scale(there, here));
        let scale = |there: &mut f64, here: &f64| *there = *here + factor * (*there - *here);
        b.rotors.angle.iter_mut().zip(&a.rotors.angle).for_each(|(there, here)| scale(there, here));
        b.rotors.omega.iter_mut().zip(&a.rotors.omega).for_each(|(there, here)| scale(there, here));
    }
}

/// What a step took, in steps of one body.
fn work(report: &StepReport) -> u64 {
    report.bodies as u64 * u64::from(report.island_steps.max(report.substeps).max(1) + report.retries)
}

/// The time in which the scene moves by its length [s]: of a fall, or else of its fastest body; 1 s where nothing
/// moves.
fn unit(world: &World, length: f64) -> f64 {
    let gravity = world.gravity().length();
    let fastest = world.bodies().velocity.iter().map(|velocity| velocity.length()).fold(0.0, f64::max);
    match (gravity > 0.0, fastest > 0.0) {
        (true, _) => (length / gravity).sqrt(),
        (false, true) => length / fastest,
        (false, false) => 1.0,
    }
}

/// Adds a smooth field of velocities. Its waves are longer than the scene, so that it wakes slow modes, and in no
/// simple relation to it or to each other, so that no symmetry keeps it from any direction.
fn disturb(world: &mut World, length: f64, unit: f64) {
    let size = SIZE * length / unit;
    for i in 0..world.bodies.len() {
        if world.is_dynamic(i) {
            let at = world.bodies.position[i] / length;
            let field = DVec2::new(libm::sin(1.9 * at.x + 3.1 * at.y + 0.7), libm::sin(2.7 * at.x - 1.3 * at.y + 1.9));
            world.bodies.velocity[i] += size * field;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::{Anchor, Body, Constraint, Kind};

    const GRAVITY: f64 = 9.81;

    /// One body on a rod of `length` from the origin, at an angle from straight down [rad].
    fn pendulum(length: f64, angle: f64) -> World {
        let mut world = World::new();
        let position = length * DVec2::new(libm::sin(angle), -libm::cos(angle));
        let bob = world.add_body(&Body { position, radius: 0.0, ..Body::default() }).expect("a sound body");
        let rod = Constraint { kind: Kind::Rod { length }, a: Anchor::World(DVec2::ZERO), b: Anchor::centre(bob) };
        world.add_constraint(&rod).expect("a sound rod");
        world
    }

    fn after(world: &World, length: f64, seconds: f64) -> Growth {
        let mut growth = Growth::new(world, &Method::default(), length).expect("a sound method");
        let steps = (seconds * Method::default().hz).round() as u32;
        (0..steps).for_each(|_| growth.step(&StepReport::default()));
        growth
    }

    fn near(growth: &Growth, expected: f64, tolerance: f64) {
        let found = growth.factor().expect("it moves");
        println!("grown {found:.5e}, expected {expected:.5e}");
        assert!((found / expected - 1.0).abs() < tolerance, "{found:e} is not {expected:e}");
        assert_eq!(growth.ended(), None);
    }

    #[test]
    fn a_pendulum_that_hangs_does_not_let_errors_grow() {
        // sin(ωt) in time units of 1/ω, for each length.
        for length in [0.1, 1.0, 50.0] {
            near(&after(&pendulum(length, 1e-3), length, 20.0), 1.0, 1e-2);
        }
        assert_eq!(after(&pendulum(1.0, 1e-3), 1.0, 1.0).sentence(), None);
    }

    #[test]
    fn a_pendulum_on_its_head_lets_them_grow_exponentially() {
        for (length, seconds) in [(1.0, 2.0), (1.0, 6.0), (0.25, 3.0), (10.0, 8.0)] {
            // From the first step on, after which it counts.
            let t = (GRAVITY / length).sqrt() * seconds;
            near(&after(&pendulum(length, std::f64::consts::PI), length, seconds), libm::sinh(t), 0.1);
        }
        let sentence = after(&pendulum(1.0, std::f64::consts::PI), 1.0, 6.0).sentence().expect("it is sensitive");
        assert!(sentence.starts_with("errors grow 7e7-fold"), "{sentence}");
    }

    #[test]
    fn what_flies_freely_lets_them_grow_with_the_time() {
        for (length, seconds) in [(1.0, 5.0), (20.0, 60.0)] {
            let mut world = World::new();
            let particle = Body { velocity: DVec2::new(3.0, 4.0), radius: 0.0, ..Body::default() };
            world.add_body(&particle).expect("a sound body");
            near(&after(&world, length, seconds), seconds * (GRAVITY / length).sqrt(), 2e-2);
        }
    }

    /// A double pendulum of two particles of 1 kg on rods of 1 m: angles from straight down and their rates, by the
    /// textbook's equations M(θ) θ̈ = f (Lagrange), which know nothing of rods.
    type Angles = [f64; 4];

    fn slope([a, b, va, vb]: Angles) -> Angles {
        let (sin, cos) = libm::sincos(a - b);
        let fa = -sin * vb * vb - 2.0 * GRAVITY * libm::sin(a);
        let fb = sin * va * va - GRAVITY * libm::sin(b);
        let determinant = 2.0 - cos * cos;
        [va, vb, (fa - cos * fb) / determinant, (2.0 * fb - cos * fa) / determinant]
    }

    /// Runge and Kutta's step of order 4.
    fn advance(state: Angles, h: f64) -> Angles {
        let add = |k: Angles, h: f64| -> Angles { std::array::from_fn(|i| state[i] + h * k[i]) };
        let k1 = slope(state);
        let k2 = slope(add(k1, h / 2.0));
        let k3 = slope(add(k2, h / 2.0));
        let k4 = slope(add(k3, h));
        std::array::from_fn(|i| state[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]))
    }

    /// Where both particles are and how fast.
    fn places([a, b, va, vb]: Angles) -> [DVec2; 4] {
        let arm = |angle: f64| DVec2::new(libm::sin(angle), -libm::cos(angle));
        let across = |angle: f64| DVec2::new(libm::cos(angle), libm::sin(angle));
        [arm(a), arm(a) + arm(b), va * across(a), va * across(a) + vb * across(b)]
    }

    #[test]
    fn a_double_pendulum_lets_them_grow_as_its_equations_do() {
        let start: Angles = [3.0, 2.5, 0.0, 0.0];
        let mut world = pendulum(1.0, start[0]);
        let first = world.bodies().id[0];
        let position = places(start)[1];
        let second = world.add_body(&Body { position, radius: 0.0, ..Body::default() }).expect("a sound body");
        world.add_constraint(&Constraint::between(Kind::Rod { length: 1.0 }, first, second)).expect("a sound rod");

        // The same disturbance, far smaller, as far as the rods let it: least squares of the velocities.
        let length = 2.0;
        let unit = unit(&world, length);
        let mut kicked = world.clone();
        disturb(&mut kicked, length, unit);
        let [v1, v2] = [kicked.bodies().velocity[0], kicked.bodies().velocity[1]];
        let [across_a, across_b] = [0, 1].map(|i| DVec2::new(libm::cos(start[i]), libm::sin(start[i])));
        let (fa, fb, cos) = (across_a.dot(v1 + v2), across_b.dot(v2), libm::cos(start[0] - start[1]));
        let determinant = 2.0 - cos * cos;
        let size = 1e-6;
        let mut pair = [
            start,
            [start[0], start[1], size * (fa - cos * fb) / determinant, size * (2.0 * fb - cos * fa) / determinant],
        ];
        let (mut baseline, mut largest) = (0.0, 0.0_f64);
        for step in 0..300 {
            (0..100).for_each(|_| pair = pair.map(|state| advance(state, 1.0 / 6000.0)));
            let [a, b] = pair.map(places);
            let apart: [f64; 4] = std::array::from_fn(|i| (b[i] - a[i]).length_squared());
            let position = apart[0] + apart[1];
            if step == 0 {
                baseline = (position + unit * unit * (apart[2] + apart[3])).sqrt();
            } else {
                largest = largest.max(position.sqrt());
            }
        }
        let growth = after(&world, length, 5.0);
        near(&growth, largest / baseline, 0.05);
        assert!(largest / baseline > SENSITIVE && growth.sentence().is_some());
    }

    #[test]
    fn what_costs_too_much_is_left_and_what_exceeds_all_bounds_is_not_counted() {
        let mut growth = after(&pendulum(1.0, std::f64::consts::PI), 1.0, 6.0);
        (growth.work, growth.allowed) = (10, 10);
        growth.step(&StepReport::default());
        assert!((growth.ended().expect("it ended") - 6.0).abs() < 1e-9);
        assert_eq!(growth.sentence().as_deref(), Some("errors grow 7e7-fold in the first 6.00 s"));
        growth.largest = 1e4;
        assert_eq!(growth.sentence().as_deref(), Some("errors grow more than 1e16-fold in the first 6.00 s"));
        assert!(growth.factor().is_some_and(f64::is_finite));
    }

    #[test]
    fn what_is_done_to_the_run_is_done_to_both_worlds() {
        // Upright for a second, and then without gravity: what has grown goes on evenly.
        let mut growth = after(&pendulum(1.0, std::f64::consts::PI), 1.0, 1.0);
        growth.change(|world| world.set_gravity(DVec2::ZERO).is_ok());
        growth.set_rate(120.0).expect("a rate");
        (0..120).for_each(|_| growth.step(&StepReport::default()));
        let rate = GRAVITY.sqrt();
        near(&growth, libm::sinh(rate) + rate * libm::cosh(rate), 0.02);
        growth.change(|world| world.set_gravity(DVec2::NAN).is_ok());
        assert!(growth.ended().is_some(), "it cannot follow any more");
    }

    #[test]
    fn where_nothing_moves_nothing_grows() {
        let mut world = World::new();
        assert_eq!(after(&world, 1.0, 0.5).factor(), None);
        let fixed = Body { motion: crate::engine::Motion::Static, ..Body::default() };
        world.add_body(&fixed).expect("a sound body");
        assert_eq!(after(&world, 1.0, 0.5).factor(), None);
    }
}
