//! Keys in their turn: what is typed belongs to what the keys before it have opened.
//!
//! A window that draws slowly is handed several keys and clicks for one pass. A key that opens a field, moves the keyboard or
//! takes up a tool changes what the next ones mean, but only once its pass is over. So a pass is given the events up to such a
//! key, and the rest waits for the next: nothing is lost and nothing is read by the wrong one.

use super::actions;
use egui::{Context, Event, Key, Modifiers, Plugin, RawInput};
use std::collections::VecDeque;

/// Who reads the keyboard in the next pass.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Reader {
    /// The scene: keys are shortcuts.
    #[default]
    Scene,
    /// A field: keys are text.
    Field,
    /// A field that was opened, but has not been drawn yet.
    Awaited,
}

/// The events that wait for their turn.
#[derive(Default)]
pub(super) struct Turns {
    queue: VecDeque<Event>,
    pub(super) reader: Reader,
}

impl Turns {
    /// Whether some events wait for the next pass.
    pub(super) fn waiting(&self) -> bool {
        !self.queue.is_empty()
    }
}

impl Plugin for Turns {
    fn debug_name(&self) -> &'static str {
        "turns"
    }

    fn input_hook(&mut self, _: &Context, input: &mut RawInput) {
        self.queue.extend(input.events.drain(..));
        let mut turn = Turn::of(self.reader);
        while let Some(event) = self.queue.pop_front() {
            if !turn.takes(&event) {
                self.queue.push_front(event);
                break;
            }
            input.events.push(event);
        }
    }
}

/// What one pass has been given so far.
struct Turn {
    reader: Reader,
    /// Something was typed into the field.
    typed: bool,
    /// A button of the pointer was pressed or let go: it may move the keyboard.
    clicked: bool,
    /// The last event ends the pass; the text that its key types still belongs to it.
    over: bool,
    has_text: bool,
}

impl Turn {
    fn of(reader: Reader) -> Turn {
        Turn { reader, typed: false, clicked: false, over: false, has_text: false }
    }

    /// Whether the pass takes `event` too. The first that it does not take ends it.
    fn takes(&mut self, event: &Event) -> bool {
        if self.over {
            return std::mem::take(&mut self.has_text) && matches!(event, Event::Text(_));
        }
        match event {
            Event::Key { key, pressed: true, repeat, modifiers, .. } => self.takes_key(*key, *modifiers, *repeat),
            Event::Text(_) | Event::Ime(_) | Event::Paste(_) | Event::Copy | Event::Cut => {
                let takes = self.reader != Reader::Awaited && !self.clicked;
                self.typed |= takes && self.reader == Reader::Field;
                takes
            }
            Event::PointerButton { .. } => {
                let takes = self.reader != Reader::Awaited && !self.typed;
                self.clicked |= takes;
                takes
            }
            _ => true,
        }
    }

    fn takes_key(&mut self, key: Key, modifiers: Modifiers, repeat: bool) -> bool {
        if self.reader == Reader::Awaited || self.clicked {
            return false;
        }
        let moves_keyboard = matches!(key, Key::Enter | Key::Tab | Key::Escape);
        if self.reader == Reader::Field {
            let chooses = matches!(key, Key::ArrowUp | Key::ArrowDown);
            let ends = moves_keyboard || actions::works_while_typing(key, modifiers);
            // What is done with the text, or chosen for it, is seen first.
            if self.typed && (ends || chooses) {
                return false;
            }
            self.typed |= !chooses;
            self.over = ends;
        } else {
            self.over = !repeat && (moves_keyboard || actions::turns(key, modifiers));
            self.has_text = self.over && is_plain(modifiers);
        }
        true
    }
}

/// Whether a key with these modifiers types its letter.
fn is_plain(modifiers: Modifiers) -> bool {
    !(modifiers.command || modifiers.ctrl || modifiers.alt || modifiers.mac_cmd)
}
