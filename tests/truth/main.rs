//! The truth itself: closed forms, the reference solver, and what is stored of it. Figures are printed; `--nocapture` to read.

mod closed_form;
mod dial;
mod energy_momentum;
mod forms;
mod orders;
mod reference;
mod rope_lengths;
mod stored;
mod taylor;
