//! From a running world back to a document: every body, constraint and wall on its own, as they stand.

use super::Setup;
use super::document::{
    BodyEntry, BodyFields, ConstraintEntry, Document, End, Settings, Truth, VERSION, View, WallEntry, is_zero_point,
};
use crate::engine::{Anchor, Body, Constraint, DVec2, Kind, Shape, Wall, World};
use std::collections::BTreeSet;

/// The document of a setup as it stands. Built again it has the same bits, except for what only the solver remembers
/// (time, contacts, multipliers, the mouse's grip).
pub fn capture(setup: &Setup) -> Document {
    let world = &setup.world;
    let names = names(setup);
    let named = |(index, (_, body)): (usize, (_, Body))| body_entry(names[index].clone(), &body);
    let constraints = 0..world.constraints().len();
    Document {
        version: VERSION,
        title: setup.title.clone(),
        about: setup.about.clone(),
        view: setup.view.map(|(centre, height)| View { centre, height }),
        truth: setup.truth.filter(|truth| still_fits(world, truth)),
        pass: setup.pass.clone(),
        settings: Settings::new(world.gravity(), world.drag(), world.tuning(), &setup.method),
        bodies: world.bodies().iter().enumerate().map(named).collect(),
        walls: world.walls().iter().map(wall_entry).collect(),
        generators: Vec::new(),
        constraints: constraints.map(|index| constraint_entry(world, &names, &world.constraint_at(index))).collect(),
    }
}

/// Whether the closed form that a scene names, if it names one, is still that of its world, which may have been edited.
fn still_fits(world: &World, truth: &Truth) -> bool {
    truth.form.is_none_or(|form| form.trajectory(world, truth.seconds, truth.length).is_ok())
}

/// Names by dense index: those of the scene's file, and others for the bodies that need one.
fn names(setup: &Setup) -> Vec<Option<String>> {
    let bodies = setup.world.bodies();
    let mut used = BTreeSet::new();
    let mut unused = |mut name: String| {
        // A body may have been called just as a generator's node is now.
        while !used.insert(name.clone()) {
            name.push('_');
        }
        name
    };
    let own = bodies.id.iter().map(|id| setup.names.get(id).cloned());
    let mut names: Vec<Option<String>> = own.map(|name| name.map(&mut unused)).collect();
    for (index, referred) in referred_bodies(&setup.world).into_iter().enumerate() {
        if referred && names[index].is_none() {
            names[index] = Some(unused(format!("b{index}")));
        }
    }
    names
}

/// Which bodies need a name, by dense index.
fn referred_bodies(world: &World) -> Vec<bool> {
    let mut referred = vec![false; world.bodies().len()];
    let constraints = world.constraints();
    for &end in constraints.a.iter().chain(&constraints.b) {
        if let Some(flag) = referred.get_mut(end as usize) {
            *flag = true;
        }
    }
    referred
}

fn body_entry(name: Option<String>, body: &Body) -> BodyEntry {
    let fields = BodyFields {
        name,
        motion: body.motion,
        position: body.position,
        velocity: body.velocity,
        angle: body.spin.map(|spin| spin.angle),
        omega: body.spin.map(|spin| spin.omega),
        mass: Some(body.mass),
        density: None,
        radius: body.radius,
        restitution: body.restitution,
        friction: body.friction,
        collides: body.collides,
        group: body.group,
    };
    if body.spin.is_some() { BodyEntry::Disc(fields) } else { BodyEntry::Particle(fields) }
}

fn constraint_entry(world: &World, names: &[Option<String>], constraint: &Constraint) -> ConstraintEntry {
    let (a, at_a) = end(world, names, &constraint.a);
    let (b, at_b) = end(world, names, &constraint.b);
    match constraint.kind {
        Kind::Rod { length } => ConstraintEntry::Rod { a, at_a, b, at_b, length: Some(length) },
        Kind::Rope { length } => ConstraintEntry::Rope { a, at_a, b, at_b, length: Some(length) },
        Kind::Spring { rest, stiffness, damping } => {
            ConstraintEntry::Spring { a, at_a, b, at_b, rest: Some(rest), stiffness, damping }
        }
        Kind::Pin => ConstraintEntry::Pin { a, at_a, b, at_b },
    }
}

fn end(world: &World, names: &[Option<String>], anchor: &Anchor) -> (End, Option<DVec2>) {
    match *anchor {
        Anchor::World(point) => (End::Point(point), None),
        Anchor::Body(id, local) => {
            let index = world.bodies().index_of(id).expect("a constraint's bodies exist");
            let turns = world.bodies().spin(index).is_some();
            let name = names[index].clone().expect("every body that a constraint refers to was named");
            (End::Body(name), (turns && !is_zero_point(&local)).then_some(local))
        }
    }
}

fn wall_entry(wall: &Wall) -> WallEntry {
    let Wall { shape, restitution, friction } = *wall;
    match shape {
        Shape::Segment { from, to } => WallEntry::Segment { from, to, restitution, friction },
        Shape::Box { min, max } => WallEntry::Box { min, max, restitution, friction },
    }
}
