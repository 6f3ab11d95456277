//! Unsaved work, kept when the window ends in another way than its user asked for.

use super::Frame;
use crate::file::{WriteError, write_new};
use crate::scene::{self, Setup};
use crate::text::named;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// A folder holds so many rescued states of one scene at most.
const MOST: u32 = 1000;

/// Why a folder does not take unsaved work.
#[derive(Debug, thiserror::Error)]
pub enum RescueError {
    /// It cannot be written to.
    #[error("cannot write into {folder}: {why}")]
    Write {
        /// As a user would type it.
        folder: String,
        /// Why not.
        why: WriteError,
    },
    /// As many as there may be are there already.
    #[error("cannot write into {folder}: {MOST} rescued states of this scene are there already")]
    Full {
        /// As a user would type it.
        folder: String,
    },
}

/// Writes the scene as it stands to a new file, if it was edited since it was last written: beside its own file, or
/// where there is none or that folder takes none in the folder for the state of programs, or else in that for temporary
/// files. The path, or `None` if there is nothing to keep.
///
/// # Errors
/// If no folder takes it: why the last one does not.
pub fn rescue(frame: &Frame) -> Option<Result<PathBuf, RescueError>> {
    let start = frame.unsaved.as_deref()?;
    let setup = Setup { world: frame.world.clone(), method: frame.method, ..start.clone() };
    let text = scene::to_ron(&scene::capture(&setup));
    let stem = start.file.as_deref().and_then(Path::file_stem).map_or_else(|| stem(&start.name), OsString::from);
    let mut last = None;
    for folder in folders(start.file.as_deref()) {
        match write(&folder, &stem, text.as_bytes()) {
            Ok(path) => return Some(Ok(path)),
            Err(error) => last = Some(error),
        }
    }
    last.map(Err)
}

/// The last part of a shipped scene's name.
fn stem(name: &str) -> OsString {
    name.rsplit('/').next().unwrap_or(name).replace(' ', "_").into()
}

/// Where it may be kept, the best place first.
fn folders(file: Option<&Path>) -> Vec<PathBuf> {
    let beside = file.map(|file| match file.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    });
    let set = |name| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    // The places that the XDG Base Directory Specification names, and Windows' own.
    let state = set("XDG_STATE_HOME")
        .or_else(|| set("LOCALAPPDATA"))
        .or_else(|| set("HOME").map(|home| home.join(".local/state")))
        .map(|state| state.join("tautline"));
    beside.into_iter().chain(state).chain([std::env::temp_dir()]).collect()
}

/// Writes to the first name that nothing has: "tower.rescued.ron", "tower.rescued-2.ron".
fn write(folder: &Path, stem: &std::ffi::OsStr, bytes: &[u8]) -> Result<PathBuf, RescueError> {
    // Where it is there already, or cannot be made, writing says so.
    let _ = std::fs::create_dir_all(folder);
    for number in 1..=MOST {
        let mut name = stem.to_owned();
        name.push(if number == 1 { ".rescued.ron".to_owned() } else { format!(".rescued-{number}.ron") });
        let path = folder.join(name);
        match write_new(&path, bytes) {
            Ok(()) => return Ok(path),
            Err(error) if error.kind == std::io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(RescueError::Write { folder: named(folder), why: error }),
        }
    }
    Err(RescueError::Full { folder: named(folder) })
}
