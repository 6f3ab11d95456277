//! Few free bodies, from event to event: particles and discs without constraints that touch walls and each other.
//!
//! Between two events motion is in closed form ([`path`]). The next event is the first root of a gap, found to rounding ([`root`],
//! [`meeting`]): an impact, the end of a slide, the end of a wall's side. Impacts are ordered by time over the whole group, those of one instant
//! are a sequence of impacts of two ([`collide`]), and a run of bounces ends in rest where a rebound would last no time ([`Few`]). Contacts
//! that last carry the forces that their complementarity problem has ([`cone`], [`rest`]); where those change all the time, as under a disc
//! that rolls over another one, the motion is a differential equation until the set of contacts changes ([`rolling`]).
//!
//! Cost: O(bodies) an event, O(bodies²) a step, and a direct solve of the contacts that hang together with an event. Where discs overlap, where friction leaves no
//! set of contacts, or where events do not end, the group goes through the substeps in that step.

mod collide;
mod cone;
mod few;
mod meeting;
mod path;
mod record;
mod rest;
mod rolling;
mod root;
mod surfaces;
mod touch;

pub(crate) use few::Few;
