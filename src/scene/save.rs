//! From a document to a file, never leaving half of one.

use super::document::Document;
use super::error::{Problem, SceneError};
use super::read::options;
use ron::ser::PrettyConfig;
use std::fs::File;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

/// The text of a document: one line a body, constraint, wall or generator. Numbers come back with the same bits.
pub fn to_ron(document: &Document) -> String {
    let pretty = PrettyConfig::new().depth_limit(2).indentor("    ").new_line("\n");
    let text = options().to_string_pretty(document, pretty);
    text.expect("a document holds nothing that RON cannot write") + "\n"
}

/// Writes a document to `path`. The old file, if any, is replaced only when the new one is complete on disk; it keeps its
/// permissions, and a symbolic link stays one.
pub fn save(path: &Path, document: &Document) -> Result<(), SceneError> {
    let target = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let beside = beside(&target);
    let written = write_whole(&beside, &to_ron(document))
        .and_then(|()| match std::fs::metadata(&target) {
            Ok(old) if old.is_file() => std::fs::set_permissions(&beside, old.permissions()),
            _ => Ok(()),
        })
        .and_then(|()| std::fs::rename(&beside, &target));
    written.map_err(|error| {
        // The name is ours alone; if it was never made there is nothing to remove.
        let _ = std::fs::remove_file(&beside);
        SceneError::file(path.display().to_string(), unwritable(&error))
    })
}

fn write_whole(path: &Path, text: &str) -> std::io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(text.as_bytes())?;
    file.sync_all()
}

/// A name in the same folder, so that the rename stays on one disk.
fn beside(path: &Path) -> PathBuf {
    let mut name = std::ffi::OsString::from(".");
    name.push(path.file_name().unwrap_or_else(|| "scene".as_ref()));
    name.push(format!(".{}.part", std::process::id()));
    path.with_file_name(name)
}

fn unwritable(error: &std::io::Error) -> Problem {
    let (found, mend) = match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            ("a full disk".to_owned(), "Free some space or save elsewhere; the old file is as it was.")
        }
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            ("a folder that may not be written to".to_owned(), "Save to another folder, or change its permissions.")
        }
        ErrorKind::NotFound | ErrorKind::NotADirectory => {
            ("no such folder".to_owned(), "Create the folder first, or save to another one.")
        }
        ErrorKind::IsADirectory => ("a folder of that name".to_owned(), "Choose another name."),
        _ => (format!("a file that cannot be written ({error})"), "Check the path and the disk."),
    };
    Problem::new(found, "a place for the scene", mend)
}
