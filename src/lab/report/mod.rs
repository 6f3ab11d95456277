//! Points written down: [`json`], [`csv`], [`table`], a diagram as [`text`] and as [`svg`], and the [`page`] of `docs/`.

mod axis;
pub mod csv;
pub mod json;
pub mod mark;
pub mod page;
pub mod svg;
pub mod table;
pub mod text;
