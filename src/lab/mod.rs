//! The lab: speed against error of every method on a scene.
//!
//! - A [`Reference`] is the motion that others are compared with: stored or in closed form ([`Reference::known`]), or refined
//!   with the engine's most accurate method until two runs agree ([`refine`]).
//! - A [`Sweep`] measures a [`Point`] for every [`Setting`] (a [`Family`] of methods and its knobs), cheapest and most telling
//!   ones first. It is a state machine for a thread of its own: [`Sweep::advance`] measures the next point and can be cancelled
//!   at any step; [`Sweep::resume`] takes what was measured before; [`Sweep::progress`] tells how much is left.
//! - A [`Front`] is the points that no other beats in both: what to use for a wanted error or a wanted budget.
//! - [`report`] writes points: table, diagram as text, JSON lines, CSV, SVG, and the page of `docs/`.
//!
//! The rules of a measurement: error is the RMS distance to the reference over all bodies and all samples (60 a second), in
//! parts of the scene's length, from a run of its own; cost is CPU time of the measuring thread for stepping alone, in
//! microseconds per simulated second, median of at least five runs, the plan derived and the first step done before the clock
//! starts.
//!
//! ```no_run
//! use std::sync::{Arc, atomic::AtomicBool};
//! use tautline::lab::{Front, Outcome, Reference, Sweep, SweepOptions};
//!
//! let setup = tautline::scene::open("truth/rope").unwrap();
//! let reference = Reference::known(&setup).map(Arc::new);
//! let cancel = AtomicBool::new(false);
//! let mut sweep = Sweep::new(&setup.name, &setup.world, setup.method, 1.5, reference, SweepOptions::default());
//! while let Outcome::Point(_) | Outcome::Skipped(..) = sweep.advance(&cancel) {}
//! println!("{}", Front::of(sweep.points()).advice_for_error(1e-6));
//! ```

mod candidates;
mod clock;
mod front;
mod point;
mod published;
mod reference;
mod refine;
pub mod report;
mod setting;
mod sweep;
mod trial;

pub use clock::{CLOCK, thread_nanoseconds};
pub use front::{Front, Gain};
pub use point::{ErrorKind, Point};
pub use published::{published, published_on};
pub use reference::{Lost, Reference, Source, scene_length};
pub use refine::{LevelReport, NoReference, refine};
pub use setting::{Family, Setting};
pub use sweep::{Outcome, Progress, Skip, Sweep, SweepOptions, rate_fits};
