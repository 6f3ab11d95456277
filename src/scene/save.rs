//! From a document to a file, never leaving half of one.

use super::document::Document;
use super::error::{Problem, SceneError};
use super::read::options;
use ron::ser::PrettyConfig;
use std::fs::{File, Permissions};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

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
    let refused = |problem: Problem| SceneError::file(path.display().to_string(), problem);
    let target = behind_links(path);
    let permissions = permissions_to_keep(&target).map_err(refused)?;
    let (part, file) = create_beside(&target).map_err(|error| refused(unwritable(&error)))?;
    let written = write_whole(file, permissions, text).and_then(|()| std::fs::rename(&part, &target));
    written.map_err(|error| {
        // What cannot be removed either is hidden, and the error at hand matters more.
        let _ = std::fs::remove_file(&part);
        refused(unwritable(&error))
    })
}

/// Where a chain of symbolic links leads, also if nothing is there yet.
pub(crate) fn behind_links(path: &Path) -> PathBuf {
    let mut target = path.to_owned();
    // The system itself follows no longer chains; what is still a link then is one that leads back to itself.
    for _ in 0..40 {
        match std::fs::read_link(&target) {
            Ok(next) => target = target.with_file_name("").join(next),
            Err(_) => break,
        }
    }
    target
}

/// Permissions of the file that is to be replaced, if there is one. Refuses what must not be replaced.
fn permissions_to_keep(target: &Path) -> Result<Option<Permissions>, Problem> {
    let about = match std::fs::metadata(target) {
        Ok(about) => about,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(unwritable(&error)),
    };
    if about.is_dir() {
        return Err(unwritable(&ErrorKind::IsADirectory.into()));
    }
    let refused = |found: &str| Problem::new(found, PLACE, "Choose another name.");
    if !about.is_file() {
        return Err(refused("a pipe or a device"));
    }
    if about.permissions().readonly() {
        return Err(refused("a file that is read-only"));
    }
    Ok(Some(about.permissions()))
}

/// A new file in the same folder, so that the rename stays on one disk. Its name is short, since the target's may already
/// be as long as a name can be, and nobody else's.
fn create_beside(target: &Path) -> std::io::Result<(PathBuf, File)> {
    let mut attempt = 0;
    loop {
        let part = target.with_file_name(format!(".tautline.{}.{attempt}.part", std::process::id()));
        match File::create_new(&part) {
            Ok(file) => return Ok((part, file)),
            Err(error) if error.kind() == ErrorKind::AlreadyExists && attempt < 100 => attempt += 1,
            Err(error) => return Err(error),
        }
    }
}

fn write_whole(mut file: File, permissions: Option<Permissions>, text: &str) -> std::io::Result<()> {
    // Before anything is in it that not everybody may read.
    permissions.map_or(Ok(()), |permissions| file.set_permissions(permissions))?;
    file.write_all(text.as_bytes())?;
    file.sync_all()
}

const PLACE: &str = "a place for the file";

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
    Problem::new(found, PLACE, mend)
}
