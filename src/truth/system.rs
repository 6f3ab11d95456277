//! The equations of motion of particles under gravity, drag, springs and rods: M a = f + Jᵀλ with J a = −J̇v.
//!
//! A rod of length L between a and b stands here as C = ½ (d·d − L²), d = b − a, so that C = 0 and its derivatives need no
//! root: J = (−dᵀ, dᵀ), Ċ = d·ḋ, J̇v = ḋ·ḋ (Hairer, Wanner, Solving Ordinary Differential Equations II, chapter VII).

use super::TruthError;
use super::double_double::{DoubleDouble, Vector};
use super::factor::Factor;
use crate::engine::{DVec2, Kind, Motion, World};

/// An end of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
enum End {
    /// Index among the moving particles.
    Moving(usize),
    Fixed(DVec2),
}

#[derive(Clone, Copy, Debug)]
struct Rod {
    ends: [End; 2],
    length: f64,
}

#[derive(Clone, Copy, Debug)]
struct Spring {
    ends: [End; 2],
    rest: f64,
    stiffness: f64,
    damping: f64,
}

/// A particle that two rods share: it adds sign/m · d(row)·d(column) to A.
#[derive(Clone, Copy, Debug)]
struct Coupling {
    row: usize,
    column: usize,
    weight: DoubleDouble,
}

/// The equations, and the room to evaluate them. The state is all positions, then all velocities, of the moving particles.
#[derive(Clone, Debug)]
pub(super) struct System {
    /// Dense index in the world of each moving particle.
    pub(super) bodies: Vec<usize>,
    mass: Vec<f64>,
    inverse_mass: Vec<DoubleDouble>,
    gravity: DVec2,
    drag: f64,
    rods: Vec<Rod>,
    springs: Vec<Spring>,
    couplings: Vec<Coupling>,
    factor: Factor,
    /// d of each rod.
    directions: Vec<Vector>,
    multipliers: Vec<DoubleDouble>,
}

impl System {
    /// The equations of a world, or what in it they do not cover.
    pub(super) fn new(world: &World) -> Result<System, TruthError> {
        refuse_what_has_no_equations(world)?;
        let bodies: Vec<usize> = (0..world.bodies().len()).filter(|&i| world.is_dynamic(i)).collect();
        let mut moving = vec![None; world.bodies().len()];
        bodies.iter().enumerate().for_each(|(index, &body)| moving[body] = Some(index));
        let (mut rods, mut springs) = (Vec::new(), Vec::new());
        for (i, kind) in world.constraints().kind.iter().enumerate() {
            let ends = ends(world, &moving, i);
            let held = ends.iter().all(|end| matches!(end, End::Fixed(_)));
            match *kind {
                _ if held => {}
                Kind::Rod { length } => rods.push(Rod { ends, length }),
                Kind::Spring { rest, stiffness, damping } => {
                    springs.push(Spring { ends, rest, stiffness: stiffness * world.tuning().stiffness, damping });
                }
                kind => return Err(unfit(format!("a constraint of kind {}", kind.name()))),
            }
        }
        // Nearby particles have nearby numbers in what generators make: this order keeps the envelope narrow.
        rods.sort_by_key(|rod: &Rod| {
            let mut numbers = rod.ends.map(|end| if let End::Moving(i) = end { i + 1 } else { 0 });
            numbers.sort_unstable();
            numbers
        });
        let mass: Vec<f64> = bodies.iter().map(|&i| world.bodies().mass[i]).collect();
        let inverse_mass: Vec<DoubleDouble> = mass.iter().map(|&m| DoubleDouble::from(1.0) / m.into()).collect();
        let couplings = couplings(&rods, &inverse_mass);
        let mut first: Vec<usize> = (0..rods.len()).collect();
        couplings.iter().for_each(|c| first[c.row] = first[c.row].min(c.column));
        Ok(System {
            bodies,
            mass,
            inverse_mass,
            gravity: world.gravity(),
            drag: world.drag(),
            directions: vec![Vector::ZERO; rods.len()],
            multipliers: vec![DoubleDouble::ZERO; rods.len()],
            rods,
            springs,
            couplings,
            factor: Factor::new(first),
        })
    }

    /// The state of a world that these equations were made of.
    pub(super) fn state_of(&self, world: &World) -> Vec<Vector> {
        let bodies = world.bodies();
        let positions = self.bodies.iter().map(|&i| bodies.position[i].into());
        positions.chain(self.bodies.iter().map(|&i| bodies.velocity[i].into())).collect()
    }

    /// The derivative of a state: velocities, then accelerations. One factorisation.
    pub(super) fn derivative(&mut self, state: &[Vector], derivative: &mut [Vector]) {
        let (q, v) = state.split_at(self.mass.len());
        let (rates, a) = derivative.split_at_mut(self.mass.len());
        rates.copy_from_slice(v);
        self.free_accelerations(q, v, a);
        if self.rods.is_empty() {
            return;
        }
        self.factorise(q);
        for (i, rod) in self.rods.iter().enumerate() {
            let spin = between(rod.ends, v);
            let closing = between(rod.ends, a);
            self.multipliers[i] = -(spin.dot(spin) + self.directions[i].dot(closing));
        }
        self.factor.solve(&mut self.multipliers);
        self.push_along_rods(a);
    }

    /// Moves a state to the nearest one, in the metric of the masses, with C = 0, then Ċ = 0. Quadratic convergence.
    pub(super) fn project(&mut self, state: &mut [Vector]) {
        if self.rods.is_empty() {
            return;
        }
        let (q, v) = state.split_at_mut(self.mass.len());
        // From an error of 1e-8 of a length two rounds reach rounding; more are for initial states that are badly given.
        for _ in 0..8 {
            self.factorise(q);
            let mut worst = 0.0_f64;
            for (i, rod) in self.rods.iter().enumerate() {
                let (d, length) = (self.directions[i], DoubleDouble::from(rod.length));
                let violation = (length * length - d.dot(d)).scaled(0.5);
                worst = worst.max(violation.abs().value() / (rod.length * rod.length));
                self.multipliers[i] = violation;
            }
            if worst < 1e-29 {
                break;
            }
            self.factor.solve(&mut self.multipliers);
            self.push_along_rods(q);
        }
        self.factorise(q);
        for (i, rod) in self.rods.iter().enumerate() {
            self.multipliers[i] = -self.directions[i].dot(between(rod.ends, v));
        }
        self.factor.solve(&mut self.multipliers);
        self.push_along_rods(v);
    }

    /// Kinetic, gravitational and elastic energy together [J]; the second is 0 at the origin.
    pub(super) fn energy(&self, state: &[Vector]) -> DoubleDouble {
        let (q, v) = state.split_at(self.mass.len());
        let mut energy = DoubleDouble::ZERO;
        for (i, &mass) in self.mass.iter().enumerate() {
            let kinetic = v[i].dot(v[i]).scaled(0.5);
            energy += DoubleDouble::from(mass) * (kinetic - Vector::from(self.gravity).dot(q[i]));
        }
        for spring in &self.springs {
            let d = between_points(spring.ends, q);
            let stretch = d.dot(d).sqrt() - spring.rest.into();
            energy += DoubleDouble::from(spring.stiffness).scaled(0.5) * stretch * stretch;
        }
        energy
    }

    /// What gravity, drag and springs do.
    fn free_accelerations(&self, q: &[Vector], v: &[Vector], a: &mut [Vector]) {
        let (gravity, drag) = (Vector::from(self.gravity), DoubleDouble::from(self.drag));
        for (a, v) in a.iter_mut().zip(v) {
            *a = gravity - v.times(drag);
        }
        for spring in &self.springs {
            let d = between_points(spring.ends, q);
            let length = d.dot(d).sqrt();
            if length.value() == 0.0 {
                continue; // No direction, hence no force, as in the engine.
            }
            let mut pull = DoubleDouble::from(spring.stiffness) * (length - spring.rest.into());
            if spring.damping != 0.0 {
                let rate = d.dot(between(spring.ends, v)) / length;
                pull += DoubleDouble::from(spring.damping) * rate;
            }
            push(spring.ends, d.times(-pull / length), &self.inverse_mass, a);
        }
    }

    /// A = J M⁻¹ Jᵀ at `q`, factorised.
    fn factorise(&mut self, q: &[Vector]) {
        for (direction, rod) in self.directions.iter_mut().zip(&self.rods) {
            *direction = between_points(rod.ends, q);
        }
        self.factor.clear();
        for coupling in &self.couplings {
            let product = self.directions[coupling.row].dot(self.directions[coupling.column]);
            self.factor.add(coupling.row, coupling.column, coupling.weight * product);
        }
        self.factor.factorise();
    }

    /// Adds M⁻¹ Jᵀ λ.
    fn push_along_rods(&self, to: &mut [Vector]) {
        for ((rod, direction), multiplier) in self.rods.iter().zip(&self.directions).zip(&self.multipliers) {
            push(rod.ends, direction.times(*multiplier), &self.inverse_mass, to);
        }
    }
}

/// Adds `force`/m at the second end, and the opposite at the first.
fn push(ends: [End; 2], force: Vector, inverse_mass: &[DoubleDouble], to: &mut [Vector]) {
    if let End::Moving(i) = ends[1] {
        to[i] = to[i] + force.times(inverse_mass[i]);
    }
    if let End::Moving(i) = ends[0] {
        to[i] = to[i] - force.times(inverse_mass[i]);
    }
}

/// Second end minus first, of positions.
fn between_points(ends: [End; 2], q: &[Vector]) -> Vector {
    let point = |end| match end {
        End::Moving(i) => q[i],
        End::Fixed(point) => point.into(),
    };
    point(ends[1]) - point(ends[0])
}

/// Second end minus first, of velocities or accelerations, which are zero where nothing moves.
fn between(ends: [End; 2], values: &[Vector]) -> Vector {
    let value = |end| if let End::Moving(i) = end { values[i] } else { Vector::ZERO };
    value(ends[1]) - value(ends[0])
}

/// Which rods share which particles: the entries of A below and on the diagonal.
fn couplings(rods: &[Rod], inverse_mass: &[DoubleDouble]) -> Vec<Coupling> {
    let mut at_particle: Vec<Vec<(usize, bool)>> = vec![Vec::new(); inverse_mass.len()];
    for (row, rod) in rods.iter().enumerate() {
        for (side, end) in rod.ends.iter().enumerate() {
            if let End::Moving(i) = end {
                at_particle[*i].push((row, side == 1));
            }
        }
    }
    let mut couplings = Vec::new();
    for (rods, &weight) in at_particle.iter().zip(inverse_mass) {
        for (k, &(row, row_side)) in rods.iter().enumerate() {
            for &(column, column_side) in &rods[..=k] {
                let weight = if row_side == column_side { weight } else { -weight };
                couplings.push(Coupling { row, column, weight });
            }
        }
    }
    couplings
}

fn ends(world: &World, moving: &[Option<usize>], constraint: usize) -> [End; 2] {
    let constraints = world.constraints();
    let (a, b) = world.ends(constraint);
    let end = |body: u32, point| match moving.get(body as usize).copied().flatten() {
        Some(index) => End::Moving(index),
        None => End::Fixed(point),
    };
    [end(constraints.a[constraint], a), end(constraints.b[constraint], b)]
}

fn unfit(what: String) -> TruthError {
    TruthError::Unfit { what }
}

fn refuse_what_has_no_equations(world: &World) -> Result<(), TruthError> {
    let bodies = world.bodies();
    if bodies.spinning() > 0 {
        return Err(unfit("a disc that turns".to_owned()));
    }
    if bodies.motion.contains(&Motion::Kinematic) {
        return Err(unfit("a kinematic body".to_owned()));
    }
    if world.grip().is_some() {
        return Err(unfit("the mouse's grip".to_owned()));
    }
    let touching: Vec<usize> = (0..bodies.len()).filter(|&i| bodies.collides[i] && bodies.radius[i] > 0.0).collect();
    let same_group = |i: &usize| bodies.group[*i] != 0 && bodies.group[*i] == bodies.group[touching[0]];
    if !touching.is_empty() && !world.walls().is_empty() {
        return Err(unfit("a body that can touch a wall".to_owned()));
    }
    if touching.len() > 1 && !touching.iter().all(same_group) {
        return Err(unfit("two bodies that can touch each other".to_owned()));
    }
    Ok(())
}
