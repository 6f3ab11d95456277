//! Whether two names stand for one file.

use std::fs::Metadata;
use std::path::{Path, PathBuf};

/// Where a chain of symbolic links leads, also if nothing is there yet.
pub fn behind_links(path: &Path) -> PathBuf {
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

/// Whether something is there that takes bytes as they come and cannot be replaced: a pipe, a terminal, the null
/// device.
pub fn is_special(path: &Path) -> bool {
    path.metadata().is_ok_and(|about| !about.is_file() && !about.is_dir())
}

/// Whether two names stand for one file or pipe, through links too and before the file is there.
pub fn is_same(a: &Path, b: &Path) -> bool {
    a == b || identity(a).is_some_and(|a| identity(b) == Some(a))
}

/// What a file is known by, whatever it is called.
#[derive(PartialEq)]
enum Identity {
    /// Device and number on it.
    #[cfg(unix)]
    Inode(u64, u64),
    /// The path without links, of a file that is not there yet or where nothing better is known.
    Path(PathBuf),
}

fn identity(path: &Path) -> Option<Identity> {
    match path.metadata() {
        Ok(about) => identity_of_existing(path, &about),
        Err(_) => {
            let target = behind_links(path);
            let folder = Path::new(".").join(target.parent()?).canonicalize().ok()?;
            Some(Identity::Path(folder.join(target.file_name()?)))
        }
    }
}

/// `None` for terminals, the null device and the like, which keep nothing that could be mixed up.
#[cfg(unix)]
fn identity_of_existing(_: &Path, about: &Metadata) -> Option<Identity> {
    use std::os::unix::fs::{FileTypeExt, MetadataExt};
    (!about.file_type().is_char_device()).then(|| Identity::Inode(about.dev(), about.ino()))
}

#[cfg(not(unix))]
fn identity_of_existing(path: &Path, _: &Metadata) -> Option<Identity> {
    path.canonicalize().ok().map(Identity::Path)
}
