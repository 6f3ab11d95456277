//! The tools of the canvas: what pointer and wheel do there. Turns pointer events into commands and into what is drawn
//! meanwhile (slash, ghost, hovered thing, selection). Knows no window and no toolkit.

use super::camera::Camera;
use super::command::{Command, Edit, Spawn};
use super::pick::{self, Handle};
use crate::engine::{Anchor, Constraint, DVec2, Id, Kind, Motion, Wall, World};

/// What the left button does on the canvas.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Takes hold of a body; on empty ground draws a selection box; a click selects.
    #[default]
    Drag,
    /// Selects by click or box.
    Select,
    /// Cuts what a slash crosses.
    Cut,
    /// Adds something where it is clicked.
    Spawn(Spawn),
    /// Joins what lies where the pointer is pressed with what lies where it is let go.
    Join(Join),
    /// Draws a wall.
    Wall,
}

/// What the join tool puts between two ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Join {
    /// Keeps the distance that the ends have.
    Rod,
    /// At rest at the distance that the ends have.
    Spring,
    /// Keeps the ends from parting further; resists pull only.
    Rope,
}

impl Tool {
    /// The name shown to a user.
    pub fn name(self) -> &'static str {
        match self {
            Tool::Drag => "Drag",
            Tool::Select => "Select",
            Tool::Cut => "Cut",
            Tool::Spawn(spawn) => spawn.name(),
            Tool::Join(Join::Rod) => "Join with a rod",
            Tool::Join(Join::Spring) => "Join with a spring",
            Tool::Join(Join::Rope) => "Join with a rope",
            Tool::Wall => "Wall",
        }
    }
}

/// A button of the pointer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Button {
    /// Works the tool in use.
    Left,
    /// Moves the view while it is held.
    Middle,
    /// Moves the view while it is held.
    Right,
}

/// What happened to the pointer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// A button goes down.
    Press(Button),
    /// With or without a button held.
    Move,
    /// A button goes up.
    Release(Button),
    /// It left the canvas, or the window lost the focus: whatever was going on is given up.
    Leave,
}

/// Keys held with the pointer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Modifiers {
    /// Snaps points to centres, ends, the grid and steps of 15°; selects as Ctrl does.
    pub shift: bool,
    /// Keeps to the exact point: nothing snaps.
    pub alt: bool,
    /// Adds to the selection, or takes one thing from it.
    pub ctrl: bool,
    /// Lets the left button move the view.
    pub space: bool,
}

/// One event of the pointer on the canvas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointerEvent {
    /// Where, in canvas points from the canvas's corner, y down.
    pub canvas: DVec2,
    /// What happened.
    pub phase: Phase,
    /// The keys held at that moment.
    pub modifiers: Modifiers,
}

/// What goes on between a press and its release.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Gesture {
    #[default]
    None,
    /// From the canvas point of the last event.
    Pan {
        last: DVec2,
        button: Button,
    },
    /// Since the canvas point of the press.
    Grip {
        /// What a click there selects: the body held, or what lies over it.
        picked: Id,
        /// The rod that was grabbed between its ends, and from that place to the end that is held [m].
        handle: Option<(Handle, DVec2)>,
        pressed: DVec2,
        moved: bool,
    },
    /// From a point of the world [m].
    Box {
        from: DVec2,
    },
    /// `cut` is how far it has cut already: what moves meanwhile is cut where the pointer meets it.
    Slash {
        from: DVec2,
        cut: DVec2,
        first: bool,
    },
    Join {
        from: Anchor,
        start: DVec2,
    },
    Wall {
        from: DVec2,
    },
}

/// What the canvas shows of the tool at work; points in the world [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Feedback {
    /// Nothing.
    None,
    /// From the grabbed point to the pointer; the frame's world holds the grip itself.
    Grip,
    /// The lower left and the upper right corner of the box.
    SelectionBox(DVec2, DVec2),
    /// Where the cut began, and the pointer.
    Slash(DVec2, DVec2),
    /// A thing about to be added, with the radius of its particles [m].
    Ghost {
        /// What a click would add.
        kind: Spawn,
        /// Where it would go, after snapping.
        at: DVec2,
        /// Radius of its particles [m].
        size: f64,
    },
    /// A constraint about to be made.
    Join {
        /// What would join the two ends.
        kind: Join,
        /// The end where the pointer was pressed.
        from: DVec2,
        /// The end where the pointer is, after snapping.
        to: DVec2,
    },
    /// The two ends of a wall about to be made.
    Wall(DVec2, DVec2),
}

/// Distance within which a point snaps to a centre or an end [canvas points].
const SNAP_REACH: f64 = 12.0;
/// A press and a release closer than this are a click [canvas points].
const CLICK_REACH: f64 = 4.0;
/// Zoom of one notch of the wheel.
pub const ZOOM_NOTCH: f64 = 1.1;

/// The tool in use, what is selected and what is under the pointer.
#[derive(Clone, Debug, Default)]
pub struct Tools {
    tool: Tool,
    selection: Vec<Id>,
    hovered: Option<Id>,
    gesture: Gesture,
    /// Where the pointer was last seen, after snapping [m].
    pointer: Option<DVec2>,
}

impl Tools {
    /// The tool in use.
    pub fn tool(&self) -> Tool {
        self.tool
    }

    /// Takes up a tool; what was going on is given up. The commands end a hold.
    pub fn set_tool(&mut self, tool: Tool) -> Vec<Command> {
        let commands = self.give_up();
        self.tool = tool;
        commands
    }

    /// What is selected, ascending.
    pub fn selection(&self) -> &[Id] {
        &self.selection
    }

    /// Selects these and nothing else.
    pub fn select(&mut self, mut ids: Vec<Id>) {
        ids.sort_unstable();
        ids.dedup();
        self.selection = ids;
    }

    /// What lies under the pointer.
    pub fn hovered(&self) -> Option<Id> {
        self.hovered
    }

    /// Whether a button holds something: a body, a slash, the view.
    pub fn busy(&self) -> bool {
        self.gesture != Gesture::None
    }

    /// Gives up, one thing a call: what is going on, else the tool, else the selection.
    pub fn escape(&mut self) -> Vec<Command> {
        if self.busy() {
            return self.give_up();
        }
        if self.tool != Tool::Drag {
            self.tool = Tool::Drag;
        } else {
            self.selection.clear();
        }
        Vec::new()
    }

    /// Forgets what is selected, hovered and going on: another scene was opened, whose ids mean other things.
    pub fn forget(&mut self) {
        *self = Tools { tool: self.tool, ..Tools::default() };
    }

    /// Forgets what no longer exists in `world`. To be called with every new frame.
    pub fn follow(&mut self, world: &World) {
        self.selection.retain(|id| pick::item(world, *id).is_some());
        self.hovered = self.hovered.filter(|id| pick::item(world, *id).is_some());
    }

    /// Turns the wheel by `notches` (forward: closer), so that the point under the pointer stays.
    pub fn wheel(&self, camera: &mut Camera, canvas: DVec2, notches: f64) {
        camera.zoom_at(canvas, ZOOM_NOTCH.powf(notches));
    }

    /// The place on a rod by which it is held and the pointer that pulls it [m].
    pub fn rod_held(&self, world: &World) -> Option<(DVec2, DVec2)> {
        let Gesture::Grip { handle: Some((handle, _)), .. } = self.gesture else { return None };
        Some((handle.places(world)?.1, self.pointer?))
    }

    /// What to draw of the tool at work.
    pub fn feedback(&self, camera: &Camera) -> Feedback {
        let Some(to) = self.pointer else { return Feedback::None };
        match (self.gesture, self.tool) {
            (Gesture::Grip { .. }, _) => Feedback::Grip,
            (Gesture::Box { from }, _) => Feedback::SelectionBox(from.min(to), from.max(to)),
            (Gesture::Slash { from, .. }, _) => Feedback::Slash(from, to),
            (Gesture::Join { start, .. }, Tool::Join(kind)) => Feedback::Join { kind, from: start, to },
            (Gesture::Wall { from }, _) => Feedback::Wall(from, to),
            (Gesture::None, Tool::Spawn(kind)) => Feedback::Ghost { kind, at: to, size: spawn_size(camera) },
            _ => Feedback::None,
        }
    }

    /// Takes one event of the pointer; moves the camera if it pans.
    pub fn pointer(&mut self, event: &PointerEvent, world: &World, camera: &mut Camera) -> Vec<Command> {
        match event.phase {
            Phase::Leave => {
                self.hovered = None;
                let commands = self.give_up();
                self.pointer = None;
                commands
            }
            Phase::Press(button) => self.press(button, event, world, camera),
            Phase::Move => self.moved(event, world, camera),
            Phase::Release(button) => self.release(button, event, world, camera),
        }
    }

    fn press(&mut self, button: Button, event: &PointerEvent, world: &World, camera: &Camera) -> Vec<Command> {
        if self.busy() {
            return Vec::new();
        }
        if button != Button::Left || event.modifiers.space {
            self.gesture = Gesture::Pan { last: event.canvas, button };
            return Vec::new();
        }
        let free = camera.to_world(event.canvas);
        let at = snap(event, world, camera, None);
        self.pointer = Some(at);
        match self.tool {
            Tool::Drag => return self.take_hold(event.canvas, world, camera),
            Tool::Select => self.gesture = Gesture::Box { from: free },
            Tool::Cut => self.gesture = Gesture::Slash { from: free, cut: free, first: true },
            Tool::Spawn(kind) => return vec![Command::Edit(Edit::Spawn { kind, at, size: spawn_size(camera) })],
            Tool::Join(_) => {
                let (from, start) = anchor(event, world, camera);
                self.gesture = Gesture::Join { from, start };
            }
            Tool::Wall => self.gesture = Gesture::Wall { from: at },
        }
        Vec::new()
    }

    /// Takes hold of the body or rod at a canvas point; on empty ground draws a box.
    fn take_hold(&mut self, pressed: DVec2, world: &World, camera: &Camera) -> Vec<Command> {
        let at = camera.to_world(pressed);
        if let Some(body) = pick::pick_body(world, camera, pressed) {
            let picked = pick::pick(world, camera, pressed).unwrap_or(body);
            self.gesture = Gesture::Grip { picked, handle: None, pressed, moved: false };
            return vec![Command::Grab { body, at }];
        }
        if let Some(handle) = pick::pick_handle(world, camera, pressed) {
            let end = handle.places(world).map_or(at, |(end, _)| end);
            let Handle { link: picked, body, .. } = handle;
            self.gesture = Gesture::Grip { picked, handle: Some((handle, end - at)), pressed, moved: false };
            return vec![Command::Grab { body, at: end }];
        }
        self.gesture = Gesture::Box { from: at };
        Vec::new()
    }

    fn moved(&mut self, event: &PointerEvent, world: &World, camera: &mut Camera) -> Vec<Command> {
        if let Gesture::Pan { last, .. } = &mut self.gesture {
            camera.pan(event.canvas - *last);
            *last = event.canvas;
            return Vec::new();
        }
        self.track(event, world, camera);
        if let Gesture::Slash { cut, first, .. } = &mut self.gesture {
            let from = std::mem::replace(cut, camera.to_world(event.canvas));
            return vec![Command::Slash { from, to: *cut, first: std::mem::take(first) }];
        }
        if let Gesture::Grip { pressed, moved, handle, .. } = &mut self.gesture {
            *moved |= pressed.distance(event.canvas) > CLICK_REACH;
            // Of a rod the end is led, as far from the pointer as it was: led by where the place is now it would never rest.
            let lead = handle.map_or(DVec2::ZERO, |(_, lead)| lead);
            return vec![Command::MoveGrip(camera.to_world(event.canvas) + lead)];
        }
        Vec::new()
    }

    fn release(&mut self, button: Button, event: &PointerEvent, world: &World, camera: &Camera) -> Vec<Command> {
        match self.gesture {
            Gesture::Pan { button: held, .. } if held != button => return Vec::new(),
            Gesture::Pan { .. } => {}
            _ if button != Button::Left => return Vec::new(),
            _ => self.track(event, world, camera),
        }
        let to = self.pointer.unwrap_or_else(|| camera.to_world(event.canvas));
        match (std::mem::take(&mut self.gesture), self.tool) {
            (Gesture::Grip { picked, moved, .. }, _) => {
                if !moved {
                    self.choose(vec![picked], event.modifiers);
                }
                vec![Command::Release]
            }
            (Gesture::Box { from }, _) => {
                let click = camera.to_canvas(from).distance(event.canvas) <= CLICK_REACH;
                let picked = || pick::pick(world, camera, event.canvas).into_iter().collect();
                let found = if click { picked() } else { pick::within(world, from.min(to), from.max(to)) };
                self.choose(found, event.modifiers);
                Vec::new()
            }
            (Gesture::Slash { from, first, .. }, _) => vec![Command::Slash { from, to, first }],
            (Gesture::Join { from, start }, Tool::Join(kind)) => {
                let (end, to) = anchor(event, world, camera);
                join(world, camera, kind, (from, start), (end, to)).map(Command::Edit).into_iter().collect()
            }
            (Gesture::Wall { from }, _) if camera.to_canvas(from).distance(camera.to_canvas(to)) > CLICK_REACH => {
                vec![Command::Edit(Edit::AddWall(Wall::segment(from, to)))]
            }
            _ => Vec::new(),
        }
    }

    /// Notes where the pointer is and what lies there.
    fn track(&mut self, event: &PointerEvent, world: &World, camera: &Camera) {
        self.hovered = match self.gesture {
            Gesture::None | Gesture::Join { .. } => pick::pick(world, camera, event.canvas),
            _ => None,
        };
        self.pointer = Some(match self.gesture {
            Gesture::Grip { .. } | Gesture::Box { .. } | Gesture::Slash { .. } => camera.to_world(event.canvas),
            Gesture::Join { .. } => anchor(event, world, camera).1,
            Gesture::Wall { from } => snap(event, world, camera, Some(from)),
            _ => snap(event, world, camera, None),
        });
    }

    fn choose(&mut self, found: Vec<Id>, modifiers: Modifiers) {
        if !(modifiers.shift || modifiers.ctrl) {
            return self.select(found);
        }
        // Adding what is there already takes it away, one thing at a time.
        if let [one] = found[..]
            && self.selection.contains(&one)
        {
            return self.selection.retain(|id| *id != one);
        }
        let all = self.selection.iter().copied().chain(found).collect();
        self.select(all);
    }

    fn give_up(&mut self) -> Vec<Command> {
        match std::mem::take(&mut self.gesture) {
            Gesture::Grip { .. } => vec![Command::Release],
            _ => Vec::new(),
        }
    }
}

/// The radius of a spawned particle [m]: a round number near a hundredth of the height of the view.
pub fn spawn_size(camera: &Camera) -> f64 {
    round_step(camera.size.y.max(1.0) / camera.scale / 100.0)
}

/// Distance of the grid's lines at this zoom [m]: a round number, 40 … 100 canvas points wide.
pub fn grid_step(camera: &Camera) -> f64 {
    round_step(40.0 / camera.scale)
}

/// The smallest of 1, 2, 5 times a power of ten that is at least `least` (> 0).
fn round_step(least: f64) -> f64 {
    let power = 10f64.powf(least.log10().floor());
    let factor = [1.0, 2.0, 5.0, 10.0].into_iter().find(|factor| factor * power >= least * (1.0 - 1e-9));
    factor.unwrap_or(10.0) * power
}

/// The pointer in the world: with Shift on the nearest centre or end, else on the grid, and (given a start) in steps of 15°.
fn snap(event: &PointerEvent, world: &World, camera: &Camera, start: Option<DVec2>) -> DVec2 {
    let free = camera.to_world(event.canvas);
    if !event.modifiers.shift || event.modifiers.alt {
        return free;
    }
    if let Some(mark) = nearest_mark(world, free, SNAP_REACH / camera.scale) {
        return mark;
    }
    match start {
        Some(start) => {
            let step = 15f64.to_radians();
            let angle = ((free - start).to_angle() / step).round() * step;
            let direction = DVec2::from_angle(angle);
            start + direction * (free - start).dot(direction)
        }
        None => {
            let step = grid_step(camera);
            (free / step).round() * step
        }
    }
}

/// The nearest centre of a body or end of a constraint or wall within `reach` [m].
fn nearest_mark(world: &World, point: DVec2, reach: f64) -> Option<DVec2> {
    let centres = world.bodies().position.iter().copied();
    let ends = (0..world.constraints().len()).flat_map(|i| <[DVec2; 2]>::from(world.ends(i)));
    let corners = world.walls().iter().flat_map(|wall| match wall.shape {
        crate::engine::Shape::Segment { from, to } => [from, to],
        crate::engine::Shape::Box { min, max } => [min, max],
    });
    let marks = centres.chain(ends).chain(corners).map(|mark| (mark.distance(point), mark));
    marks.filter(|(distance, _)| *distance <= reach).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, mark)| mark)
}

/// The end of a constraint at the pointer, and where it is [m]: a body's centre if it is near, else the point of the body, else a
/// free point. Alt keeps to the exact point.
fn anchor(event: &PointerEvent, world: &World, camera: &Camera) -> (Anchor, DVec2) {
    let free = camera.to_world(event.canvas);
    let body = pick::pick_body(world, camera, event.canvas);
    let Some((id, index)) = body.and_then(|id| Some((id, world.bodies().index_of(id)?))) else {
        let point = snap(event, world, camera, None);
        return (Anchor::World(point), point);
    };
    let centre = world.bodies().position[index];
    let near_centre = !event.modifiers.alt && centre.distance(free) * camera.scale <= SNAP_REACH;
    if near_centre || world.bodies().spin(index).is_none() {
        return (Anchor::centre(id), centre);
    }
    (Anchor::Body(id, world.to_local(index, free)), free)
}

/// The constraint between two ends as they stand, unless both are the same or coincide. Between two free points it hangs a
/// new particle at the second, for two fixed ends would hold nothing.
fn join(world: &World, camera: &Camera, kind: Join, from: (Anchor, DVec2), to: (Anchor, DVec2)) -> Option<Edit> {
    let length = from.1.distance(to.1);
    let hangs = from.0.body().is_none() && to.0.body().is_none();
    if hangs && length * camera.scale <= CLICK_REACH {
        return None;
    }
    let size = spawn_size(camera);
    let new_mass = hangs.then(|| super::edit::particle(to.1, size).mass);
    let kind = match kind {
        Join::Rod => Kind::Rod { length },
        Join::Rope => Kind::Rope { length },
        Join::Spring => {
            let mass = |anchor: &Anchor| anchor.body().and_then(|id| world.body(id).ok()).filter(moves).map(|b| b.mass);
            let mass = [mass(&from.0), mass(&to.0), new_mass].into_iter().flatten().reduce(f64::min).unwrap_or(1.0);
            super::edit::spring(length, mass)
        }
    };
    if hangs {
        return Some(Edit::Hang { kind, from: from.1, at: to.1, size });
    }
    let constraint = Constraint { kind, a: from.0, b: to.0 };
    constraint.validate().ok().map(|()| Edit::Join(constraint))
}

fn moves(body: &crate::engine::Body) -> bool {
    body.motion == Motion::Dynamic
}
