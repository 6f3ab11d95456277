//! Free bodies, from event to event: particles and discs without constraints that touch walls and each other.
//!
//! Between two events motion is in closed form ([`path`]). The next event is the first root of a gap, found to rounding ([`root`],
//! [`meeting`]): an impact, the end of a slide, the end of a wall's side. Impacts are ordered by time over the whole group, those of one instant
//! are a sequence of impacts of two ([`collide`]), and a run of bounces ends in rest where a rebound would last no time ([`Few`]). Contacts
//! that last carry the forces that their complementarity problem has ([`cone`], [`rest`]); where those change all the time, as under a disc
//! that rolls over another one, the motion is a differential equation until the set of contacts changes ([`rolling`]).
//!
//! Bodies that cannot meet in a step are carried apart ([`clusters`]). Cost: O(bodies) an event, O(bodies²) a step of a cluster, and a direct solve of
//! the contacts that hang together with an event. A cluster that is too large or that something else can reach, in which discs overlap, in which friction
//! leaves no set of contacts, or of which the events do not end, goes through the substeps in that step; so does what comes after the work
//! of a step has become more than it should cost in the time that it simulates.

mod clusters;
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

pub(crate) use few::{Fared, Few, MOST_TOGETHER};
