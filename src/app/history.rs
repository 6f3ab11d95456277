//! Undo and redo: whole states from before and after each edit, bounded in number and memory.

use super::takeback::without;
use crate::engine::{Method, World};
use crate::scene::Setup;
use std::collections::VecDeque;
use std::sync::Arc;

/// Everything that undo brings back.
#[derive(Clone, Debug)]
pub struct State {
    /// Every body, constraint and wall, and the time.
    pub world: World,
    /// How it was stepped then.
    pub method: Method,
    /// The scene as it was opened; undoing an opening brings back the scene before it.
    pub start: Arc<Setup>,
    /// It holds edits that were not saved.
    pub edited: bool,
}

impl State {
    /// This state, on the other side of an edit from `from`, as everything has moved until `now`.
    fn moved_with(&self, from: &State, now: &State) -> State {
        let State { world, method, start, edited } = self;
        let world = without(world, &from.world, &now.world);
        State { world, method: *method, start: start.clone(), edited: *edited }
    }
}

/// What undo takes back.
#[derive(Clone, Debug)]
enum Change {
    /// An edit or a setting. Time does not move with it: see [`without`].
    Edit { before: Box<State>, after: Box<State> },
    /// A restart or an opening: the state on its other side.
    Leap(Box<State>),
}

/// A change and its name.
#[derive(Clone, Debug)]
struct Entry {
    name: String,
    change: Change,
}

/// How many edits can be undone.
const MOST_ENTRIES: usize = 200;
/// Memory for all of them together [bytes].
const MOST_BYTES: usize = 256 << 20;

/// The changes made, and those undone.
#[derive(Clone, Debug, Default)]
pub struct History {
    undo: VecDeque<Entry>,
    redo: Vec<Entry>,
}

impl History {
    /// Notes an edit by the states just before and after it; what could be redone is forgotten.
    pub fn record(&mut self, name: String, before: State, after: State) {
        self.push(Entry { name, change: Change::Edit { before: Box::new(before), after: Box::new(after) } });
    }

    /// Notes that another run began, and the state in which the one before was left.
    pub fn record_leap(&mut self, name: String, before: State) {
        self.push(Entry { name, change: Change::Leap(Box::new(before)) });
    }

    /// Lets the last edit go on: what was changed again, from `before` to `after`, is undone together with it.
    pub fn extend(&mut self, now: &State, then: State) {
        self.redo.clear();
        if let Some(Entry { change: Change::Edit { before, after }, .. }) = self.undo.back_mut() {
            before.world = without(&before.world, &after.world, &now.world);
            **after = then;
        }
    }

    fn push(&mut self, entry: Entry) {
        self.redo.clear();
        self.undo.push_back(entry);
        // The last entry stays however large it is: one edit can always be undone.
        while self.undo.len() > MOST_ENTRIES || (self.undo.len() > 1 && self.bytes() > MOST_BYTES) {
            self.undo.pop_front();
        }
    }

    /// The state without the last change, in exchange for the one now.
    pub fn undo(&mut self, now: State) -> Option<State> {
        let mut entry = self.undo.pop_back()?;
        let state = match &mut entry.change {
            Change::Edit { before, after } => before.moved_with(after, &now),
            Change::Leap(other) => std::mem::replace(&mut **other, now),
        };
        self.redo.push(entry);
        Some(state)
    }

    /// The state with the change that was undone last, in exchange for the one now.
    pub fn redo(&mut self, now: State) -> Option<State> {
        let mut entry = self.redo.pop()?;
        let state = match &mut entry.change {
            Change::Edit { before, after } => after.moved_with(before, &now),
            Change::Leap(other) => std::mem::replace(&mut **other, now),
        };
        self.undo.push_back(entry);
        Some(state)
    }

    /// Name of the edit that undo would take back.
    pub fn undo_name(&self) -> Option<&str> {
        self.undo.back().map(|entry| entry.name.as_str())
    }

    /// Name of the edit that redo would make again.
    pub fn redo_name(&self) -> Option<&str> {
        self.redo.last().map(|entry| entry.name.as_str())
    }

    fn bytes(&self) -> usize {
        self.undo.iter().map(|entry| entry.change.bytes()).sum()
    }
}

impl Change {
    fn bytes(&self) -> usize {
        match self {
            Change::Edit { before, after } => bytes(&before.world) + bytes(&after.world),
            Change::Leap(other) => bytes(&other.world),
        }
    }
}

/// Estimate of a world's memory [bytes]: some 150 a body, 90 a constraint, 80 a contact, 60 a wall.
fn bytes(world: &World) -> usize {
    150 * world.bodies().len() + 90 * world.constraints().len() + 80 * world.contacts().len() + 60 * world.walls().len()
}
