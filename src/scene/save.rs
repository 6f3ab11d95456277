//! From a document to a file, never leaving half of one.

use super::document::Document;
use super::error::{Problem, SceneError};
use super::read::options;
use crate::file::write_whole;
use ron::ser::PrettyConfig;
use std::path::Path;

/// The text of a document: one line a body, constraint, wall or generator. Numbers come back with the same bits.
pub fn to_ron(document: &Document) -> String {
    let pretty = PrettyConfig::new().depth_limit(2).indentor("    ").new_line("\n");
    let text = options().to_string_pretty(document, pretty);
    text.expect("a document holds nothing that RON cannot write") + "\n"
}

/// Writes a document to `path`. The old file, if any, is replaced only when the new one is complete on disk; it keeps its
/// permissions. A symbolic link stays one: what it leads to is replaced.
pub fn save(path: &Path, document: &Document) -> Result<(), SceneError> {
    save_text(path, &to_ron(document))
}

/// Writes a text to `path`, in the same way.
pub fn save_text(path: &Path, text: &str) -> Result<(), SceneError> {
    write_whole(path, text.as_bytes()).map_err(|error| {
        let problem = Problem::new(error.found, "a place for the file", error.mend);
        SceneError::file(path.to_string_lossy(), problem)
    })
}
