//! A file that appears when it is complete, and otherwise not at all.

use super::error::WriteError;
use super::part::create_beside;
use super::same::{behind_links, is_special};
use std::fs::{File, Permissions};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

/// A file under way: written beside the one that it is to be, which it replaces only once it is complete on disk.
/// Dropped before that it leaves no trace. Not buffered.
///
/// The old file keeps its permissions, and a symbolic link stays one: what it leads to is replaced. Folders, pipes,
/// devices and read-only files are refused.
pub struct WholeFile {
    target: PathBuf,
    part: PathBuf,
    /// Locked for as long as it is open, which tells others that it is not one left behind.
    file: Option<File>,
}

impl WholeFile {
    /// Begins a file that is to be at `path`.
    pub fn create(path: &Path) -> Result<WholeFile, WriteError> {
        let target = behind_links(path);
        let permissions = permissions_to_keep(&target)?;
        let (part, file) = create_beside(&target)?;
        let whole = WholeFile { target, part, file: Some(file) };
        // Before anything is in it that not everybody may read.
        if let (Some(permissions), Some(file)) = (permissions, &whole.file) {
            file.set_permissions(permissions)?;
        }
        Ok(whole)
    }

    /// Brings everything to the disk and puts the file in its place.
    pub fn commit(mut self) -> Result<(), WriteError> {
        // Kept open, hence locked, until it has its name.
        let Some(file) = &self.file else { return Ok(()) };
        file.sync_all()?;
        if cfg!(windows) {
            // An open file cannot be renamed there.
            self.file = None;
        }
        std::fs::rename(&self.part, &self.target)?;
        self.part.clear();
        Ok(())
    }
}

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.file.as_mut().map_or(Ok(bytes.len()), |file| file.write(bytes))
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.file.as_mut().map_or(Ok(()), Write::flush)
    }
}

impl Drop for WholeFile {
    fn drop(&mut self) {
        if self.part.as_os_str().is_empty() {
            return;
        }
        self.file = None;
        // What cannot be removed is hidden, and removed by whoever writes into this folder next.
        let _ = std::fs::remove_file(&self.part);
    }
}

/// Permissions of the file that is to be replaced, if there is one. Refuses what must not be replaced.
fn permissions_to_keep(target: &Path) -> Result<Option<Permissions>, WriteError> {
    let about = match std::fs::metadata(target) {
        Ok(about) => about,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(error.into()),
    };
    if about.is_dir() {
        return Err(std::io::Error::from(ErrorKind::IsADirectory).into());
    }
    if !about.is_file() {
        return Err(WriteError::new("a pipe or a device", "Choose another name."));
    }
    if about.permissions().readonly() {
        return Err(WriteError::new("a file that is read-only", "Choose another name."));
    }
    Ok(Some(about.permissions()))
}

/// Writes a file whole, or leaves what is there as it was.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    let mut file = WholeFile::create(path)?;
    file.write_all(bytes)?;
    file.commit()
}

/// Writes a file whole where nothing of that name is; otherwise the error is of the kind `AlreadyExists`.
pub fn write_new(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    // An empty file holds the name, which two programs may want at once.
    File::create_new(path)?;
    write_whole(path, bytes).inspect_err(|_| drop(std::fs::remove_file(path)))
}

/// Whether a file could be written there, before something is calculated that could not be kept.
pub fn check_writable(path: &Path) -> Result<(), WriteError> {
    if is_special(path) { Ok(()) } else { WholeFile::create(path).map(drop) }
}

/// Where bytes go that somebody named a place for: a file that appears whole, or a pipe or a device, which take them as
/// they come.
pub enum Sink {
    /// A file that is not there before it is committed.
    Whole(WholeFile),
    /// A pipe or a device; what was written stays written.
    Stream(File),
}

impl Sink {
    /// Opens what stands at `path`, or begins a file there.
    pub fn create(path: &Path) -> Result<Sink, WriteError> {
        if is_special(path) {
            return Ok(Sink::Stream(File::options().write(true).open(path)?));
        }
        Ok(Sink::Whole(WholeFile::create(path)?))
    }

    /// Ends it: a file takes its place.
    pub fn commit(self) -> Result<(), WriteError> {
        match self {
            Sink::Whole(file) => file.commit(),
            Sink::Stream(mut stream) => Ok(stream.flush()?),
        }
    }
}

impl Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        match self {
            Sink::Whole(file) => file.write(bytes),
            Sink::Stream(stream) => stream.write(bytes),
        }
    }

    fn flush(&mut self) -> std::io::Result<()> {
        match self {
            Sink::Whole(file) => file.flush(),
            Sink::Stream(stream) => stream.flush(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).expect("the folder");
        let mut names: Vec<String> =
            entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_appears_when_it_is_complete_and_not_before() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.csv");
        std::fs::write(&path, "old").expect("a file");
        let mut file = WholeFile::create(&path).expect("a place");
        file.write_all(b"new").expect("room");
        file.flush().expect("room");
        assert_eq!(std::fs::read_to_string(&path).expect("the file"), "old");
        file.commit().expect("room");
        assert_eq!(std::fs::read_to_string(&path).expect("the file"), "new");
        assert_eq!(names(folder.path()), ["a.csv"]);
    }

    #[test]
    fn a_file_that_is_given_up_leaves_no_trace() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut file = WholeFile::create(&folder.path().join("a.csv")).expect("a place");
        file.write_all(&[b'x'; 100_000]).expect("room");
        drop(file);
        check_writable(&folder.path().join("b.csv")).expect("a place");
        assert_eq!(names(folder.path()), Vec::<String>::new());
        assert!(check_writable(&folder.path().join("missing/b.csv")).is_err());
    }

    #[test]
    fn a_new_file_replaces_nothing() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.ron");
        write_new(&path, b"first").expect("a place");
        assert_eq!(write_new(&path, b"second").expect_err("it is there").kind, ErrorKind::AlreadyExists);
        assert_eq!(std::fs::read(&path).expect("the file"), b"first");
        assert_eq!(names(folder.path()), ["a.ron"]);
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn devices_take_bytes_as_they_come() {
        let mut null = Sink::create(Path::new("/dev/null")).expect("the null device");
        null.write_all(b"gone").expect("it takes all");
        null.commit().expect("nothing to do");
        assert!(Path::new("/dev/null").metadata().is_ok_and(|about| !about.is_file()));
        let mut full = Sink::create(Path::new("/dev/full")).expect("a device");
        let error = full.write_all(b"too much").expect_err("it is full");
        assert_eq!(WriteError::from(error).found, "a full disk");
        assert!(WholeFile::create(Path::new("/dev/null")).is_err());
    }
}
