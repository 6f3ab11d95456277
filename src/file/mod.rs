//! Files as the program writes and reads them: written whole or not at all, read within bounds, told apart whatever
//! they are called. A room of its own below all others, since every room that has something to keep writes it here.

mod error;
mod part;
mod read;
mod same;
mod whole;

pub use error::WriteError;
pub use read::{Unreadable, read_bounded};
pub use same::{behind_links, is_same, is_special};
pub use whole::{Sink, WholeFile, check_writable, write_new, write_whole};
