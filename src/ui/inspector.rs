//! The inspector: what is selected, its properties to read and to change.

use super::format::si;
use super::widgets::{self, Number};
use crate::app::{Command, Edit, Frame, pick};
use crate::engine::{Body, Constraint, Id, Kind, Motion, Shape, Spin, Wall};
use egui::Ui;
use std::ops::RangeInclusive;

const MOTIONS: [(Motion, &str, &str); 3] = [
    (Motion::Dynamic, "Dynamic", "Moved by forces, constraints and contacts."),
    (Motion::Kinematic, "Kinematic", "Moves with its own velocity; nothing pushes it."),
    (Motion::Static, "Static", "Never moves."),
];

fn field(name: &'static str, unit: &'static str, range: RangeInclusive<f64>, help: &'static str) -> Number {
    Number { name, unit, range, help, logarithmic: false, decimals: 3 }
}

/// The section "Selection".
pub fn show(ui: &mut Ui, frame: &Frame, selection: &[Id], commands: &mut Vec<Command>) {
    widgets::section(ui, "Selection", true, |ui| match selection {
        [] => widgets::note(ui, "Nothing is selected. Click a body, a rod or a wall, or draw a box around some."),
        [id] => one(ui, frame, *id, commands),
        many => several(ui, frame, many, commands),
    });
}

fn one(ui: &mut Ui, frame: &Frame, id: Id, commands: &mut Vec<Command>) {
    let world = &frame.world;
    // Drafts of one thing must not show on the next.
    ui.push_id(id.0, |ui| match pick::item(world, id) {
        Some(pick::Item::Body(index)) => {
            let shown = world.bodies().get(index);
            let mut changed = shown;
            if body(ui, id, &mut changed) {
                commands.push(Command::Edit(Edit::ChangeBody { id, from: Box::new(shown), to: Box::new(changed) }));
            }
        }
        Some(pick::Item::Constraint(index)) => {
            let mut changed = world.constraint_at(index);
            let (a, b) = world.ends(index);
            if constraint(ui, id, &mut changed, a.distance(b), world.constraints().tension(index)) {
                commands.push(Command::Edit(Edit::SetKind(id, changed.kind)));
            }
        }
        Some(pick::Item::Wall(index)) => {
            let mut changed = world.walls()[index];
            if wall(ui, id, &mut changed) {
                commands.push(Command::Edit(Edit::SetWall(id, changed)));
            }
        }
        None => widgets::note(ui, "What was selected is gone."),
    });
}

fn body(ui: &mut Ui, id: Id, body: &mut Body) -> bool {
    widgets::reading(ui, "Body", id.to_string(), "The body's number, as in the trajectories of `tautline run`.");
    let mut changed = widgets::choice(ui, "Motion", &mut body.motion, None, &MOTIONS, "What may move the body.");
    let place = -1e4..=1e4;
    changed |= settled(ui, field("Position x", "m", place.clone(), "Centre, to the right."), &mut body.position.x);
    changed |= settled(ui, field("Position y", "m", place, "Centre, upwards."), &mut body.position.y);
    let speed = -1e4..=1e4;
    changed |= settled(ui, field("Velocity x", "m/s", speed.clone(), "To the right."), &mut body.velocity.x);
    changed |= settled(ui, field("Velocity y", "m/s", speed, "Upwards."), &mut body.velocity.y);
    let mass = "Mass. Without effect while the body is static or kinematic.";
    changed |= settled(ui, field("Mass", "kg", 1e-6..=1e6, mass), &mut body.mass);
    let smallest = if body.spin.is_some() { 1e-3 } else { 0.0 };
    let radius = "Radius; 0 is a point, which touches nothing. A body that turns needs one.";
    changed |= settled(ui, field("Radius", "m", smallest..=100.0, radius), &mut body.radius);
    changed |= spin(ui, body);
    changed |= material(ui, &mut body.restitution, &mut body.friction);
    changed |= widgets::switch(ui, "Collides", &mut body.collides, None, "Whether it can touch anything at all.");
    changed
}

fn spin(ui: &mut Ui, body: &mut Body) -> bool {
    let mut turns = body.spin.is_some();
    let help = "Whether the body has an angle: a disc turns and rolls, a particle does not.";
    let mut changed = widgets::switch(ui, "Turns", &mut turns, None, help);
    if changed {
        body.spin = turns.then(Spin::default);
        body.radius = if turns { body.radius.max(1e-3) } else { body.radius };
    }
    if let Some(spin) = &mut body.spin {
        let mut degrees = spin.angle.to_degrees();
        if settled(ui, field("Angle", "°", -1e6..=1e6, "From the x axis, counter-clockwise."), &mut degrees) {
            spin.angle = degrees.to_radians();
            changed = true;
        }
        let omega = field("Spin", "rad/s", -1e4..=1e4, "Angular velocity, counter-clockwise.");
        changed |= settled(ui, omega, &mut spin.omega);
    }
    changed
}

fn material(ui: &mut Ui, restitution: &mut f64, friction: &mut f64) -> bool {
    let bounce = "Coefficient of restitution; a contact takes the larger of the two.";
    let slide = "Coefficient of friction; a contact takes the geometric mean of the two.";
    settled(ui, field("Own restitution", "", 0.0..=1.0, bounce), restitution)
        | settled(ui, field("Own friction", "", 0.0..=10.0, slide), friction)
}

fn constraint(ui: &mut Ui, id: Id, constraint: &mut Constraint, distance: f64, tension: f64) -> bool {
    let name = constraint.kind.name();
    widgets::reading(ui, name, id.to_string(), "The constraint's number.");
    let mut changed = kind(ui, &mut constraint.kind, distance);
    changed |= match &mut constraint.kind {
        Kind::Rod { length } => settled(ui, field("Length", "m", 1e-3..=1e4, "Distance that the rod keeps."), length),
        Kind::Rope { length } => {
            settled(ui, field("Length", "m", 1e-3..=1e4, "Distance that the rope allows."), length)
        }
        Kind::Spring { rest, stiffness, damping } => {
            let force = Number {
                logarithmic: true,
                decimals: 2,
                ..field("Spring constant", "N/m", 0.0..=1e6, "Force a metre of stretch.")
            };
            settled(ui, field("Rest length", "m", 0.0..=1e4, "Length without force."), rest)
                | settled(ui, force, stiffness)
                | settled(ui, field("Damping", "N·s/m", 0.0..=1e5, "Force against each m/s of stretching."), damping)
        }
        Kind::Pin => false,
    };
    widgets::reading(ui, "Distance", si(distance, "m"), "Distance of the two ends now.");
    widgets::reading(
        ui,
        "Tension",
        tension_text(&constraint.kind, tension),
        "The solver's multiplier: what the constraint pulls with.",
    );
    changed
}

/// A tension in words: a rod pulls or pushes, a pin only holds.
pub fn tension_text(kind: &Kind, tension: f64) -> String {
    match kind {
        Kind::Pin => si(tension, "N"),
        _ if tension < 0.0 => format!("{} push", si(-tension, "N")),
        _ => format!("{} pull", si(tension, "N")),
    }
}

/// Rod, rope and spring turn into each other at the length they have.
fn kind(ui: &mut Ui, kind: &mut Kind, distance: f64) -> bool {
    if *kind == Kind::Pin {
        return false;
    }
    let names = [
        ("Rod", "Rod", "The distance of the ends stays."),
        ("Rope", "Rope", "The distance of the ends does not grow."),
        ("Spring", "Spring", "Pulls or pushes towards its rest length."),
    ];
    let mut name = kind.name();
    let changed = widgets::choice(ui, "Kind", &mut name, None, &names, "What the constraint asks for.");
    if changed {
        let length = distance.max(1e-3);
        *kind = match name {
            "Rod" => Kind::Rod { length },
            "Rope" => Kind::Rope { length },
            _ => Kind::Spring { rest: length, stiffness: 1000.0, damping: 1.0 },
        };
    }
    changed
}

fn wall(ui: &mut Ui, id: Id, wall: &mut Wall) -> bool {
    let (name, size) = match wall.shape {
        Shape::Segment { from, to } => ("Segment", si(from.distance(to), "m")),
        Shape::Box { min, max } => ("Box", format!("{} × {}", si(max.x - min.x, "m"), si(max.y - min.y, "m"))),
    };
    widgets::reading(ui, "Wall", id.to_string(), "The wall's number.");
    widgets::reading(ui, name, size, "Its shape and size. Walls never move.");
    material(ui, &mut wall.restitution, &mut wall.friction)
}

/// A value whose edit counts when the hand leaves it, so that it is undone as one.
fn settled(ui: &mut Ui, field: Number, value: &mut f64) -> bool {
    widgets::number(ui, &field, value, None).settled
}

fn several(ui: &mut Ui, frame: &Frame, ids: &[Id], commands: &mut Vec<Command>) {
    let bodies: Vec<Id> = ids.iter().copied().filter(|id| frame.world.bodies().index_of(*id).is_some()).collect();
    let mass: f64 = bodies.iter().filter_map(|id| frame.world.body(*id).ok()).map(|body| body.mass).sum();
    widgets::reading(ui, "Selected", ids.len().to_string(), "Bodies, constraints and walls together.");
    widgets::reading(ui, "Bodies", bodies.len().to_string(), "Bodies among them.");
    widgets::reading(ui, "Total mass", si(mass, "kg"), "Of the selected bodies.");
    ui.horizontal(|ui| {
        for (name, pinned, help) in [
            ("Pin", true, "Fixes the selected bodies where they are. [N]"),
            ("Unpin", false, "Frees the selected bodies. [N]"),
        ] {
            if ui.button(name).on_hover_text(help).clicked() {
                commands.push(Command::Edit(Edit::Pin(bodies.clone(), pinned)));
            }
        }
        if ui.button("Delete").on_hover_text("Removes what is selected and what hangs on it. [Delete]").clicked() {
            commands.push(Command::Edit(Edit::Delete(ids.to_vec())));
        }
    });
}
