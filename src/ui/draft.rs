//! Values that were changed here but have not come back from the simulation thread yet.
//!
//! A frame is always a little old, up to a whole step when the machine is overloaded. A control that showed it while it
//! is being dragged would jump back; so it shows its draft until the frame agrees or half a second has passed.

use egui::{Id, Ui};

/// Time after which a change that never arrived is given up: it was refused, and the fault banner says why [s].
const PATIENCE: f64 = 0.5;

#[derive(Clone, Copy)]
struct Draft {
    value: f64,
    /// When it was last touched [s].
    touched: f64,
}

/// What the control `id` should show, where the frame says `shown`.
pub fn read(ui: &Ui, id: Id, shown: f64) -> f64 {
    let now = ui.input(|input| input.time);
    match ui.data(|data| data.get_temp::<Draft>(id)) {
        Some(draft) if draft.value != shown && now - draft.touched < PATIENCE => {
            ui.ctx().request_repaint_after_secs(PATIENCE as f32);
            draft.value
        }
        Some(_) => {
            ui.data_mut(|data| data.remove::<Draft>(id));
            shown
        }
        None => shown,
    }
}

/// Keeps `value` as the draft of the control `id`.
pub fn write(ui: &Ui, id: Id, value: f64) {
    let touched = ui.input(|input| input.time);
    ui.data_mut(|data| data.insert_temp(id, Draft { value, touched }));
}

/// Keeps an existing draft alive while its control is held.
pub fn touch(ui: &Ui, id: Id) {
    if let Some(draft) = ui.data(|data| data.get_temp::<Draft>(id)) {
        write(ui, id, draft.value);
    }
}
