//! Contacts whose forces change all the time: a disc that rolls over another one or over a corner, and all that hangs on it.
//!
//! While the set of acting and sticking contacts stays, M v̇ = f + Jᵀλ, J v̇ = −J̇ v is a smooth differential equation: the classical
//! Runge–Kutta method takes it, two halves a step, whose difference to a whole one is the estimate of the error; after that positions and
//! velocities are moved onto the contacts. Order 4. The step ends where the set changes, found by bisection. Cost: twelve solves a step.

use super::cone::{Cone, Normal, Tangent};
use super::path::{Drag, Path};
use super::touch::{Masses, Touch, side_of};
use crate::engine::world::{Touching, World};
use glam::DVec2;

/// Halvings on the way to a change of the set: to 1e-12 of the step.
const HALVINGS: u32 = 40;
/// Steps tried for one that is precise enough.
const TRIES: u32 = 12;
/// Forces and speeds that are rounding, as a part of the largest.
const NOTHING: f64 = 1e-10;

/// What the equations are made of.
#[derive(Clone, Copy)]
pub(super) struct Frame<'a> {
    pub world: &'a World,
    pub masses: &'a Masses,
    pub drag: Drag,
}

/// Bodies that move on together from an instant, with a set of contacts that stays until another one.
#[derive(Debug, Default)]
pub(super) struct Curve {
    /// [s]
    pub since: f64,
    pub until: f64,
    pub bodies: Vec<usize>,
    start: Vec<Path>,
    touches: Vec<Touch>,
    normal: Vec<Normal>,
    tangent: Vec<Tangent>,
}

impl Curve {
    /// Begins with the bodies where `paths` has them, and with those contacts that act in the solution of `cone`.
    pub fn begin(&mut self, since: f64, bodies: &[usize], paths: &[Path], touches: &[Touch], cone: &Cone) {
        self.since = since;
        self.bodies.clear();
        self.bodies.extend_from_slice(bodies);
        self.start.clear();
        self.start.extend(bodies.iter().map(|place| paths[*place]));
        self.touches.clear();
        self.normal.clear();
        self.tangent.clear();
        for (i, touch) in touches.iter().enumerate().filter(|(i, _)| cone.normal[*i] == Normal::On) {
            self.touches.push(*touch);
            self.normal.push(cone.normal[i]);
            self.tangent.push(cone.tangent[i]);
        }
    }
}

/// Change of a body in time.
#[derive(Clone, Copy, Debug, Default)]
struct Rate {
    velocity: DVec2,
    acceleration: DVec2,
    omega: f64,
    turn: f64,
}

/// Scratch memory.
#[derive(Debug, Default)]
pub(super) struct Rolling {
    base: Vec<Path>,
    rate: Vec<Rate>,
    sum: Vec<Rate>,
    touches: Vec<Touch>,
    coarse: Vec<Path>,
    fine: Vec<Path>,
}

impl Rolling {
    /// Chooses the length of the step, up to the time `end` [s], with an error of `tolerance` [m] for each whole `end`, and no farther than that from
    /// a parabola. `false` if no step is precise enough.
    pub fn plan(
        &mut self,
        curve: &mut Curve,
        end: f64,
        tolerance: f64,
        frame: &Frame,
        cone: &mut Cone,
        paths: &[Path],
    ) -> bool {
        let mut length = end - curve.since;
        for _ in 0..TRIES {
            let mut coarse = std::mem::take(&mut self.coarse);
            let mut fine = std::mem::take(&mut self.fine);
            coarse.clear();
            coarse.extend_from_slice(paths);
            fine.clear();
            fine.extend_from_slice(paths);
            let solved = self.whole(curve, length, frame, cone, &mut coarse)
                && self.halves(curve, length, frame, cone, &mut fine);
            let error = curve
                .bodies
                .iter()
                .map(|b| (coarse[*b].position - fine[*b].position).length() / 15.0)
                .fold(0.0, f64::max);
            let bend = self.bend(curve, length, frame.drag, &fine);
            (self.coarse, self.fine) = (coarse, fine);
            let allowed = tolerance * length / end;
            if solved && error <= allowed && bend <= tolerance {
                curve.until = if length == end - curve.since { end } else { curve.since + length };
                self.stop_at_change(curve, frame, cone, paths);
                return true;
            }
            // An unsolved step is cut, as one whose error is no number.
            let excess = libm::pow(error / allowed, 0.25).max(libm::cbrt(bend / tolerance));
            let factor = if solved && excess.is_finite() { 0.9 / excess } else { 0.25 };
            length *= factor.clamp(0.1, 0.7);
        }
        false
    }

    /// How far the bodies are in the middle from the parabolas through both ends [m], by which meetings with others are found.
    fn bend(&self, curve: &Curve, length: f64, drag: Drag, end: &[Path]) -> f64 {
        let (half, whole) = (drag.weights(0.5 * length), drag.weights(length));
        let from_parabola = |(k, place): (usize, &usize)| {
            let start = &curve.start[k];
            let drive = (end[*place].position - start.position - whole.first * start.velocity) / whole.second;
            // The second half step began there.
            (self.base[k].position - start.position - half.first * start.velocity - half.second * drive).length()
        };
        curve.bodies.iter().enumerate().map(from_parabola).fold(0.0, f64::max)
    }

    /// Where the bodies are at `time`, in `paths`, moved onto their contacts. `false` if it cannot be solved for.
    pub fn evaluate(&mut self, curve: &Curve, time: f64, frame: &Frame, cone: &mut Cone, paths: &mut [Path]) -> bool {
        let solved = self.halves(curve, time - curve.since, frame, cone, paths);
        curve.bodies.iter().for_each(|place| paths[*place].since = time);
        solved
    }

    /// Ends the step where the set of contacts no longer holds.
    fn stop_at_change(&mut self, curve: &mut Curve, frame: &Frame, cone: &mut Cone, paths: &[Path]) {
        let mut state = std::mem::take(&mut self.coarse);
        let whole = curve.until - curve.since;
        let mut holds = |rolling: &mut Rolling, length: f64| {
            state.clear();
            state.extend_from_slice(paths);
            rolling.halves(curve, length, frame, cone, &mut state) && rolling.keeps_set(curve, frame, cone, &mut state)
        };
        if !holds(self, whole) {
            let (mut low, mut high) = (0.0, whole);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                *(if holds(self, middle) { &mut low } else { &mut high }) = middle;
            }
            curve.until = curve.since + high;
        }
        self.coarse = state;
    }

    /// Whether all contacts still press, stick within their cones, slide the same way, and are with the same part of a wall.
    fn keeps_set(&mut self, curve: &Curve, frame: &Frame, cone: &mut Cone, paths: &mut [Path]) -> bool {
        if !self.accelerate(curve, frame, cone, paths) {
            return false;
        }
        let most = (0..self.touches.len()).map(|i| cone.multiplier(i)[0]).fold(0.0, f64::max);
        self.touches.iter().enumerate().all(|(i, touch)| {
            let [pressed, rubbed] = cone.multiplier(i);
            let holds = match curve.tangent[i] {
                Tangent::Stick => rubbed.abs() <= touch.friction * pressed + NOTHING * most,
                Tangent::Slide(sign) => {
                    touch.friction == 0.0 || sign * touch.tangent_speed(paths) <= touch.rounding_speed(paths)
                }
            };
            holds && pressed >= -NOTHING * most && on_same_part(touch, frame, paths)
        })
    }

    /// One Runge–Kutta step of `length` [s] from the curve's start.
    fn whole(&mut self, curve: &Curve, length: f64, frame: &Frame, cone: &mut Cone, paths: &mut [Path]) -> bool {
        curve.bodies.iter().zip(&curve.start).for_each(|(place, start)| paths[*place] = *start);
        self.step(curve, length, frame, cone, paths)
    }

    /// Two of half the length, then onto the contacts.
    fn halves(&mut self, curve: &Curve, length: f64, frame: &Frame, cone: &mut Cone, paths: &mut [Path]) -> bool {
        self.whole(curve, 0.5 * length, frame, cone, paths) && self.step(curve, 0.5 * length, frame, cone, paths) && {
            self.project(curve, frame, cone, paths);
            true
        }
    }

    fn step(&mut self, curve: &Curve, h: f64, frame: &Frame, cone: &mut Cone, paths: &mut [Path]) -> bool {
        let n = curve.bodies.len();
        self.base.clear();
        self.base.extend(curve.bodies.iter().map(|place| paths[*place]));
        self.rate.clear();
        self.rate.resize(n, Rate::default());
        self.sum.clear();
        self.sum.resize(n, Rate::default());
        for (shift, weight) in [(0.0, 1.0 / 6.0), (0.5, 1.0 / 3.0), (0.5, 1.0 / 3.0), (1.0, 1.0 / 6.0)] {
            for (k, place) in curve.bodies.iter().enumerate() {
                paths[*place] = moved(&self.base[k], &self.rate[k], shift * h);
            }
            if !self.accelerate(curve, frame, cone, paths) {
                return false;
            }
            for (k, place) in curve.bodies.iter().enumerate() {
                let (path, sum) = (&paths[*place], &mut self.sum[k]);
                let rate = Rate {
                    velocity: path.velocity,
                    acceleration: path.drive - frame.drag.0 * path.velocity,
                    omega: path.omega,
                    turn: path.turn - frame.drag.0 * path.omega,
                };
                self.rate[k] = rate;
                sum.velocity += weight * rate.velocity;
                sum.acceleration += weight * rate.acceleration;
                sum.omega += weight * rate.omega;
                sum.turn += weight * rate.turn;
            }
        }
        for (k, place) in curve.bodies.iter().enumerate() {
            paths[*place] = moved(&self.base[k], &self.sum[k], h);
        }
        true
    }

    /// Forces of the set of contacts where the bodies are.
    fn accelerate(&mut self, curve: &Curve, frame: &Frame, cone: &mut Cone, paths: &mut [Path]) -> bool {
        for place in &curve.bodies {
            paths[*place].drive = frame.world.gravity;
            paths[*place].turn = 0.0;
        }
        self.refresh(curve, frame, paths);
        self.begin(curve, frame, cone);
        for (i, touch) in self.touches.iter().enumerate() {
            let free = touch.normal.dot(paths[touch.a].drive - paths[touch.b].drive) + touch.parting(paths);
            cone.set_free(i, [free, touch.tangent_drive(paths)]);
        }
        let solved = cone.solve_set();
        for (i, touch) in self.touches.iter().enumerate() {
            touch.drive(cone.multiplier(i), frame.masses, paths);
        }
        solved
    }

    /// Moves the bodies onto their contacts, and their velocities along them: the shortest way, weighed by the masses. What redundant contacts
    /// disagree on by rounding is left.
    fn project(&mut self, curve: &Curve, frame: &Frame, cone: &mut Cone, paths: &mut [Path]) {
        self.refresh(curve, frame, paths);
        self.begin(curve, frame, cone);
        for (i, touch) in self.touches.iter().enumerate() {
            // Only along the normals.
            cone.tangent[i] = Tangent::Slide(0.0);
            cone.set_free(i, [touch.distance - curve.touches[i].distance, 0.0]);
        }
        if cone.solve_set() {
            for (i, touch) in self.touches.iter().enumerate() {
                let push = cone.multiplier(i)[0] * touch.normal;
                paths[touch.a].position += frame.masses.inverse_mass[touch.a] * push;
                paths[touch.b].position -= frame.masses.inverse_mass[touch.b] * push;
            }
        }
        self.refresh(curve, frame, paths);
        self.begin(curve, frame, cone);
        for (i, touch) in self.touches.iter().enumerate() {
            cone.set_free(i, [touch.normal_speed(paths), touch.tangent_speed(paths)]);
        }
        if cone.solve_set() {
            for (i, touch) in self.touches.iter_mut().enumerate() {
                touch.push(cone.multiplier(i), frame.masses, paths);
            }
        }
    }

    fn begin(&self, curve: &Curve, frame: &Frame, cone: &mut Cone) {
        cone.begin(&self.touches, frame.masses);
        cone.normal.clone_from(&curve.normal);
        cone.tangent.clone_from(&curve.tangent);
    }

    /// Normals and distances where the bodies are.
    fn refresh(&mut self, curve: &Curve, frame: &Frame, paths: &[Path]) {
        self.touches.clone_from(&curve.touches);
        for touch in &mut self.touches {
            let centre = paths[touch.a].position;
            (touch.distance, touch.normal) = match touch.with {
                Touching::Body(_) => {
                    let offset = centre - paths[touch.b].position;
                    (offset.length(), offset.normalize_or(touch.normal))
                }
                Touching::Wall(wall) => frame.world.walls[wall as usize].shape.distance(centre),
            };
        }
    }
}

/// Whether a wall is touched with a side where it was one, and else with a corner or an end.
fn on_same_part(touch: &Touch, frame: &Frame, paths: &[Path]) -> bool {
    let Touching::Wall(wall) = touch.with else { return true };
    let shape = &frame.world.walls[wall as usize].shape;
    let side = side_of(shape, paths[touch.a].position, touch.normal, touch.distance);
    match touch.side {
        Some(_) => side.is_some(),
        None => side.is_none_or(|[back, ahead]| back.min(ahead) <= 0.0),
    }
}

fn moved(base: &Path, rate: &Rate, h: f64) -> Path {
    Path {
        position: base.position + h * rate.velocity,
        velocity: base.velocity + h * rate.acceleration,
        angle: base.angle + h * rate.omega,
        omega: base.omega + h * rate.turn,
        ..*base
    }
}
