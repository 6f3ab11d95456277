//! The file that a new one is written to until it is complete: its name, its lock, and what becomes of one left behind.

use std::fs::{File, TryLockError};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Names tried before it is given up: each is taken only by a file that is being written, or one that may not be
/// removed.
const ATTEMPTS: u32 = 100;

/// A new, empty, locked file in the folder of `target`, so that the rename stays on one disk. Its name is short, since
/// the target's may already be as long as a name can be, and nobody else's. What killed programs left there is removed
/// first.
pub(super) fn create_beside(target: &Path) -> std::io::Result<(PathBuf, File)> {
    remove_stale(folder_of(target));
    for attempt in 0..ATTEMPTS {
        let part = target.with_file_name(format!(".tautline.{}.{attempt}.part", std::process::id()));
        match File::create_new(&part) {
            // Between the two somebody may have taken it for one left behind.
            Ok(file) if is_ours(&file, &part) => return Ok((part, file)),
            Ok(_) => {}
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
    Err(std::io::Error::new(ErrorKind::AlreadyExists, "every name for an unfinished file is taken"))
}

/// Locks a file that was just made. Where there are no locks nothing is ever taken for left behind, so none is needed.
fn is_ours(file: &File, part: &Path) -> bool {
    !matches!(file.try_lock(), Err(TryLockError::WouldBlock)) && part.exists()
}

fn folder_of(target: &Path) -> &Path {
    target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Removes the unfinished files of programs that were killed. A program that still writes holds a lock on its own,
/// which the system takes from it when it ends, however it ends. What cannot be removed stays: it is in nobody's way.
fn remove_stale(folder: &Path) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for entry in entries.flatten().filter(|entry| is_part(&entry.file_name().to_string_lossy())) {
        // Not what a link leads to, and no folder.
        if !entry.file_type().is_ok_and(|kind| kind.is_file()) {
            continue;
        }
        let path = entry.path();
        if File::options().write(true).open(&path).is_ok_and(|file| file.try_lock().is_ok()) {
            let _ = std::fs::remove_file(path);
        }
    }
}

/// Whether a name is one that [`create_beside`] gives: ".tautline.1234.0.part", numbers as they are written.
fn is_part(name: &str) -> bool {
    let number =
        |text: &str, most: u32| text.parse::<u32>().is_ok_and(|number| number <= most && text == number.to_string());
    name.strip_prefix(".tautline.")
        .and_then(|name| name.strip_suffix(".part"))
        .and_then(|numbers| numbers.split_once('.'))
        .is_some_and(|(process, attempt)| number(process, u32::MAX) && number(attempt, ATTEMPTS - 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_names_of_our_own_are_parts() {
        assert!(is_part(".tautline.1234.0.part") && is_part(".tautline.1.99.part"));
        for other in [
            ".tautline.part",
            ".tautline.notes.part",
            ".tautline.1234.part",
            ".tautline.1234.0.0.part",
            ".tautline.1234.100.part",
            ".tautline.01234.0.part",
            ".tautline.+1.0.part",
            ".tautline.1234.0.part.bak",
            "tautline.1234.0.part",
            "scene.ron.part",
        ] {
            assert!(!is_part(other), "{other}");
        }
    }

    #[test]
    fn what_is_still_written_is_left_alone_and_what_was_left_is_removed() {
        let folder = tempfile::tempdir().expect("a folder");
        let target = folder.path().join("a.csv");
        let (held, file) = create_beside(&target).expect("a part");
        let left = folder.path().join(".tautline.4000000000.3.part");
        let (folder_of_that_name, mine) =
            (folder.path().join(".tautline.4000000000.4.part"), folder.path().join(".tautline.mine.part"));
        std::fs::write(&left, "half a").expect("a file");
        std::fs::write(&mine, "kept").expect("a file");
        std::fs::create_dir(&folder_of_that_name).expect("a folder");
        let (second, _) = create_beside(&target).expect("another part");
        assert!(held.exists() && second.exists() && second != held);
        assert!(!left.exists() && mine.exists() && folder_of_that_name.exists());
        drop(file);
        create_beside(&target).expect("a third part");
        assert!(!held.exists() || held.metadata().is_ok_and(|about| about.len() == 0), "the first is no more");
    }
}
