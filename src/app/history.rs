//! Undo and redo: whole states from before each edit, bounded in number and memory.

use crate::engine::{Method, World};
use crate::scene::Setup;
use std::collections::VecDeque;
use std::sync::Arc;

/// Everything that undo brings back.
#[derive(Clone, Debug)]
pub struct State {
    pub world: World,
    pub method: Method,
    /// The scene as it was opened; undoing an opening brings back the scene before it.
    pub start: Arc<Setup>,
}

/// A state and the name of the edit that left it.
#[derive(Clone, Debug)]
struct Entry {
    name: String,
    state: State,
}

/// How many edits can be undone.
const MOST_ENTRIES: usize = 200;
/// Memory for all of them together [bytes].
const MOST_BYTES: usize = 256 << 20;

/// The states before the edits made, and those after the edits undone.
#[derive(Clone, Debug, Default)]
pub struct History {
    undo: VecDeque<Entry>,
    redo: Vec<Entry>,
}

impl History {
    /// Notes the state before an edit; what could be redone is forgotten.
    pub fn record(&mut self, name: String, before: State) {
        self.redo.clear();
        self.undo.push_back(Entry { name, state: before });
        // The last entry stays however large it is: one edit can always be undone.
        while self.undo.len() > MOST_ENTRIES || (self.undo.len() > 1 && self.bytes() > MOST_BYTES) {
            self.undo.pop_front();
        }
    }

    /// The state before the last edit, in exchange for the one now.
    pub fn undo(&mut self, now: State) -> Option<State> {
        let entry = self.undo.pop_back()?;
        self.redo.push(Entry { name: entry.name, state: now });
        Some(entry.state)
    }

    /// The state from which the last undo came, in exchange for the one now.
    pub fn redo(&mut self, now: State) -> Option<State> {
        let entry = self.redo.pop()?;
        self.undo.push_back(Entry { name: entry.name, state: now });
        Some(entry.state)
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
        self.undo.iter().map(|entry| bytes(&entry.state.world)).sum()
    }
}

/// Estimate of a world's memory [bytes]: some 150 a body, 90 a constraint, 80 a contact, 60 a wall.
fn bytes(world: &World) -> usize {
    150 * world.bodies().len() + 90 * world.constraints().len() + 80 * world.contacts().len() + 60 * world.walls().len()
}
