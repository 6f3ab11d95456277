//! From a document to a world that is ready to step.

use super::Setup;
use super::document::{BodyEntry, BodyFields, ConstraintEntry, Document, End, Settings, Truth, WallEntry};
use super::error::{Fault, Problem, SceneError};
use super::generator::{FreeGroups, check_point};
use super::names::Names;
use super::pass::Pass;
use crate::engine::{Anchor, Body, Constraint, DVec2, Kind, Shape, Spin, Wall, World};
use crate::truth::TruthError;

/// The most bodies that a scene may have, those of its generators included. Beyond it a step takes seconds.
pub const MOST_BODIES: u64 = 1_000_000;

impl Document {
    /// Builds the scene. Errors name the part of the document, since there is no text to point at.
    pub fn build(&self) -> Result<Setup, SceneError> {
        Ok(self.setup(&self.title)?)
    }

    pub(crate) fn setup(&self, name: &str) -> Result<Setup, Fault> {
        self.check_size()?;
        let mut world = World::new();
        self.settings.apply(&mut world).map_err(|fault| fault.within("settings"))?;
        let mut names = Names::default();
        for (index, entry) in self.bodies.iter().enumerate() {
            add_body(&mut world, &mut names, entry).map_err(|fault| fault.inside("bodies", index))?;
        }
        let mut groups = FreeGroups::default();
        for (index, generator) in self.generators.iter().enumerate() {
            let inside = |fault: Fault| fault.inside("generators", index);
            let first = world.bodies().len();
            let layout = generator.build(&mut world, &mut groups).map_err(inside)?;
            if let Some(name) = generator.name() {
                names.add_nodes(name, first, layout).map_err(inside)?;
            }
        }
        for (index, entry) in self.constraints.iter().enumerate() {
            add_constraint(&mut world, &names, entry).map_err(|fault| fault.inside("constraints", index))?;
        }
        for (index, entry) in self.walls.iter().enumerate() {
            add_wall(&mut world, entry).map_err(|fault| fault.inside("walls", index))?;
        }
        let truth = self.checked_truth(&world)?;
        Ok(Setup {
            name: name.to_owned(),
            file: None,
            title: if self.title.is_empty() { name.to_owned() } else { self.title.clone() },
            about: self.about.clone(),
            names: names.of_bodies(&world.bodies().id),
            world,
            method: self.settings.method(),
            view: self.checked_view()?,
            truth,
            pass: self.checked_pass()?,
        })
    }

    /// Refuses a scene that would not fit, before anything of it is built.
    fn check_size(&self) -> Result<(), Fault> {
        let mut bodies = self.bodies.len() as u64;
        for (index, generator) in self.generators.iter().enumerate() {
            let own = generator.body_count();
            bodies = bodies.saturating_add(own);
            if bodies > MOST_BODIES {
                let found = format!("a generator of {own} bodies, which makes {bodies} in all");
                let expected = format!("at most {MOST_BODIES} bodies in a scene");
                let problem = Problem::new(found, expected, "Make it smaller.");
                return Err(Fault::new(None, problem).inside("generators", index));
            }
        }
        Ok(())
    }

    fn checked_view(&self) -> Result<Option<(DVec2, f64)>, Fault> {
        let Some(view) = self.view else { return Ok(None) };
        let in_view = |fault: Fault| fault.within("view");
        check_point("centre", view.centre).map_err(in_view)?;
        if !(view.height >= 1e-6 && view.height <= 1e9) {
            return Err(in_view(Fault::value("height", view.height, "a height between 1e-6 and 1e9 m")));
        }
        Ok(Some((view.centre, view.height)))
    }

    fn checked_pass(&self) -> Result<Option<Pass>, Fault> {
        let Some(pass) = &self.pass else { return Ok(None) };
        let in_pass = |fault: Fault| fault.within("pass");
        if !(pass.seconds >= 1.0 / 60.0 && pass.seconds <= 3600.0) {
            return Err(in_pass(Fault::value("seconds", pass.seconds, "a time between 1/60 and 3600 s")));
        }
        if pass.limits.is_empty() {
            let problem = Problem::new("no limits", "at least one limit", "Write one, such as `limits: [Gap(1e-3)]`.");
            return Err(in_pass(Fault::new(Some("limits"), problem)));
        }
        for (index, limit) in pass.limits.iter().enumerate() {
            if !(limit.bound() > 0.0 && limit.bound() <= 1e12) {
                let problem = Problem::new(
                    format!("a limit of {:?}", limit.bound()),
                    "a number above 0, 1e12 at most",
                    "Change it; a limit is what a value must stay below.",
                );
                return Err(in_pass(Fault::new(None, problem).inside("limits", index)));
            }
        }
        Ok(Some(pass.clone()))
    }

    fn checked_truth(&self, world: &World) -> Result<Option<Truth>, Fault> {
        let Some(truth) = self.truth else { return Ok(None) };
        let in_truth = |fault: Fault| fault.within("truth");
        if !(truth.seconds >= 1.0 / 60.0 && truth.seconds <= 3600.0) {
            return Err(in_truth(Fault::value("seconds", truth.seconds, "a time between 1/60 and 3600 s")));
        }
        if !(truth.length >= 1e-9 && truth.length <= 1e9) {
            return Err(in_truth(Fault::value("length", truth.length, "a length between 1e-9 and 1e9 m")));
        }
        if let Some(form) = truth.form
            && let Err(TruthError::Misfit { what, holds, .. }) = form.trajectory(world, truth.seconds, truth.length)
        {
            let problem = Problem::new(what, holds, "Change the scene, name another form, or remove `form`.");
            return Err(in_truth(Fault::new(Some("form"), problem)));
        }
        Ok(self.truth)
    }
}

impl Settings {
    fn apply(&self, world: &mut World) -> Result<(), Fault> {
        world.set_gravity(self.gravity)?;
        world.set_drag(self.drag)?;
        world.set_tuning(self.tuning).map_err(|error| Fault::from(error).within("tuning"))?;
        Ok(self.method().validate()?)
    }
}

fn add_body(world: &mut World, names: &mut Names, entry: &BodyEntry) -> Result<(), Fault> {
    let (body, name) = match entry {
        BodyEntry::Particle(fields) => (particle(fields)?, &fields.name),
        BodyEntry::Disc(fields) => (disc(fields)?, &fields.name),
    };
    let index = world.bodies().len();
    world.add_body(&body)?;
    match name {
        Some(name) => names.add_body(name, index),
        None => Ok(()),
    }
}

fn particle(fields: &BodyFields) -> Result<Body, Fault> {
    if let Some((field, _)) =
        [("angle", fields.angle), ("omega", fields.omega)].iter().find(|(_, value)| value.is_some())
    {
        let problem = Problem::new(format!("a particle with `{field}`"), "a Disc", "Write Disc, or remove the field.");
        return Err(Fault::new(Some(field), problem));
    }
    body(fields)
}

fn disc(fields: &BodyFields) -> Result<Body, Fault> {
    let spin = Spin { angle: fields.angle.unwrap_or(0.0), omega: fields.omega.unwrap_or(0.0) };
    Ok(Body { spin: Some(spin), ..body(fields)? })
}

fn body(fields: &BodyFields) -> Result<Body, Fault> {
    let mass = match (fields.mass, fields.density) {
        (Some(_), Some(_)) => {
            let problem = Problem::new("a mass and a density", "one of the two", "Remove one of them.");
            return Err(Fault::new(Some("density"), problem));
        }
        (Some(mass), None) => mass,
        (None, Some(density)) => disc_mass(density, fields.radius)?,
        (None, None) => Body::default().mass,
    };
    Ok(Body {
        motion: fields.motion,
        position: fields.position,
        velocity: fields.velocity,
        mass,
        radius: fields.radius,
        spin: None,
        restitution: fields.restitution,
        friction: fields.friction,
        collides: fields.collides,
        group: fields.group,
    })
}

/// Mass [kg] of a disc of `density` [kg/m²] and `radius` [m].
pub(crate) fn disc_mass(density: f64, radius: f64) -> Result<f64, Fault> {
    let mass = density * std::f64::consts::PI * radius * radius;
    if (1e-12..=1e12).contains(&mass) {
        return Ok(mass);
    }
    let found = format!("density {density:?}, which with radius {radius:?} makes a mass of {mass:?} kg");
    let mend = "Change the density or the radius.";
    Err(Fault::new(Some("density"), Problem::new(found, "a mass between 1e-12 and 1e12 kg", mend)))
}

fn add_constraint(world: &mut World, names: &Names, entry: &ConstraintEntry) -> Result<(), Fault> {
    use ConstraintEntry::{Pin, Rod, Rope, Spring};
    let (Rod { a, at_a, b, at_b, .. }
    | Rope { a, at_a, b, at_b, .. }
    | Spring { a, at_a, b, at_b, .. }
    | Pin { a, at_a, b, at_b }) = entry;
    let a = anchor(world, names, ["a", "at_a"], a, *at_a)?;
    let b = anchor(world, names, ["b", "at_b"], b, *at_b)?;
    let distance = (position(world, &a) - position(world, &b)).length();
    let kind = match *entry {
        Rod { length, .. } => Kind::Rod { length: length.unwrap_or(distance) },
        Rope { length, .. } => Kind::Rope { length: length.unwrap_or(distance) },
        Spring { rest, stiffness, damping, .. } => Kind::Spring { rest: rest.unwrap_or(distance), stiffness, damping },
        Pin { .. } => Kind::Pin,
    };
    world.add_constraint(&Constraint { kind, a, b })?;
    Ok(())
}

fn anchor(
    world: &World,
    names: &Names,
    [field, at_field]: [&'static str; 2],
    end: &End,
    at: Option<DVec2>,
) -> Result<Anchor, Fault> {
    let (anchor, turns) = match end {
        End::Point(point) => (Anchor::World(*point), false),
        End::Body(reference) => {
            let index = names.find(field, reference)?;
            let local = at.unwrap_or(DVec2::ZERO);
            (Anchor::Body(world.bodies().id[index], local), world.bodies().spin(index).is_some())
        }
    };
    if at.is_some() && !turns {
        let found = format!("`{at_field}` on an end that does not turn");
        let mend = "Remove it: a particle is held at its centre, a fixed end where it is.";
        return Err(Fault::new(Some(at_field), Problem::new(found, "a Disc at that end", mend)));
    }
    Ok(anchor)
}

/// Where an anchor is as built [m].
fn position(world: &World, anchor: &Anchor) -> DVec2 {
    match *anchor {
        Anchor::World(point) => point,
        Anchor::Body(id, local) => world.bodies().index_of(id).map_or(local, |index| world.to_world(index, local)),
    }
}

fn add_wall(world: &mut World, entry: &WallEntry) -> Result<(), Fault> {
    let mut add =
        |shape: Shape, restitution: f64, friction: f64| world.add_wall(&Wall { shape, restitution, friction });
    match *entry {
        WallEntry::Segment { from, to, restitution, friction } => {
            add(Shape::Segment { from, to }, restitution, friction)?;
        }
        WallEntry::Box { min, max, restitution, friction } => {
            add(Shape::Box { min, max }, restitution, friction)?;
        }
        WallEntry::Line { ref points, restitution, friction } => {
            if points.len() < 2 {
                let found = "a line of fewer than two points";
                return Err(Fault::new(Some("points"), Problem::new(found, "at least two points", "Add a point.")));
            }
            for pair in points.windows(2) {
                add(Shape::Segment { from: pair[0], to: pair[1] }, restitution, friction)?;
            }
        }
    }
    Ok(())
}
