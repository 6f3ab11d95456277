//! Where rows go: a file or standard output, and whether two names stand for the same one.

use crate::scene::behind_links;
use anyhow::Context;
use std::fmt::Display;
use std::fs::{File, Metadata};
use std::io::{BufWriter, ErrorKind, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// The name of standard output.
const STDOUT: &str = "-";

/// A file or standard output, buffered. Its errors name the file and say what to do.
pub(super) struct Output {
    name: String,
    inner: BufWriter<Box<dyn Write>>,
}

impl Output {
    /// Creates or empties the file `name`; `-` is standard output.
    pub(super) fn create(name: &str) -> anyhow::Result<Output> {
        if name == STDOUT {
            return Ok(Output::stdout());
        }
        let file = File::create(Path::new(name)).with_context(|| format!("cannot create {name}"))?;
        Ok(Output { name: name.to_owned(), inner: BufWriter::new(Box::new(file)) })
    }

    /// Opens the file `name`, cuts it after its first `keep` bytes and goes on there.
    pub(super) fn append(name: &str, keep: u64) -> anyhow::Result<Output> {
        let open = || -> std::io::Result<File> {
            let mut file = File::options().write(true).open(name)?;
            file.set_len(keep)?;
            file.seek(SeekFrom::End(0))?;
            Ok(file)
        };
        let file = open().with_context(|| format!("cannot go on with {name}"))?;
        Ok(Output { name: name.to_owned(), inner: BufWriter::new(Box::new(file)) })
    }

    /// Standard output.
    pub(super) fn stdout() -> Output {
        Output { name: "to standard output".to_owned(), inner: BufWriter::new(Box::new(std::io::stdout())) }
    }

    /// Writes a line that somebody waits for.
    pub(super) fn line(&mut self, line: impl Display) -> std::io::Result<()> {
        writeln!(self, "{line}")?;
        self.flush()
    }

    pub(super) fn explain(&self, error: std::io::Error) -> std::io::Error {
        let name = &self.name;
        let advice = match error.kind() {
            ErrorKind::BrokenPipe => return error,
            ErrorKind::StorageFull => {
                format!("cannot write {name}: the disk is full; free some space or write elsewhere")
            }
            _ => format!("cannot write {name}: {error}"),
        };
        std::io::Error::new(error.kind(), advice)
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.inner.write(bytes).map_err(|error| self.explain(error))
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.inner.flush().map_err(|error| self.explain(error))
    }
}

/// Whether what is written to `name` ends up where standard output goes.
pub(super) fn is_stdout(name: &str) -> bool {
    is_same(name, STDOUT)
}

/// Whether two names stand for one file or pipe, through links too and before the file is there.
pub(super) fn is_same(a: &str, b: &str) -> bool {
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

fn identity(name: &str) -> Option<Identity> {
    let path = Path::new(if cfg!(unix) && name == STDOUT { "/dev/stdout" } else { name });
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
