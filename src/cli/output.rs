//! Where rows go: a file or standard output.

use crate::file::{self, Sink, WriteError, check_writable, is_special, write_whole};
use crate::text::named;
use anyhow::anyhow;
use std::fmt::Display;
use std::io::{BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// The name of standard output.
const STDOUT: &str = "-";

/// A file or standard output, buffered. Its errors name the file and say what to do.
///
/// A file appears, in place of an old one, when it is committed; without that the old one stays. A pipe or a device
/// takes what is written as it comes.
pub(super) struct Output {
    name: String,
    inner: Inner,
}

enum Inner {
    Stdout(BufWriter<std::io::Stdout>),
    Once(BufWriter<Sink>),
    /// Written anew, whole, at every flush.
    Journal {
        path: PathBuf,
        bytes: Vec<u8>,
    },
}

impl Output {
    /// Begins the file `path`; `-` is standard output.
    pub(super) fn create(path: &Path) -> anyhow::Result<Output> {
        // A file that the shell has opened for us already is no file to replace.
        if is_stdout(path) {
            return Ok(Output::stdout());
        }
        let sink = Sink::create(path).map_err(|error| cannot_create(path, &error))?;
        Ok(Output { name: named(path), inner: Inner::Once(BufWriter::new(sink)) })
    }

    /// Begins the file `path` with `bytes`, all of which is on the disk after every flush, whatever happens then. For
    /// what is written seldom and is never large.
    pub(super) fn journal(path: &Path, bytes: Vec<u8>) -> anyhow::Result<Output> {
        if is_stdout(path) || is_special(path) {
            let mut output = Output::create(path)?;
            output.write_all(&bytes)?;
            return Ok(output);
        }
        check_writable(path).map_err(|error| cannot_create(path, &error))?;
        Ok(Output { name: named(path), inner: Inner::Journal { path: path.to_owned(), bytes } })
    }

    /// Standard output.
    pub(super) fn stdout() -> Output {
        Output { name: "to standard output".to_owned(), inner: Inner::Stdout(BufWriter::new(std::io::stdout())) }
    }

    /// Writes a line that somebody waits for.
    pub(super) fn line(&mut self, line: impl Display) -> std::io::Result<()> {
        writeln!(self, "{line}")?;
        self.flush()
    }

    /// Ends it: what was written is complete, and a file takes its place.
    pub(super) fn commit(mut self) -> std::io::Result<()> {
        self.flush()?;
        let Output { name, inner: Inner::Once(buffer) } = self else { return Ok(()) };
        let committed = match buffer.into_inner() {
            Ok(sink) => sink.commit().map_err(std::io::Error::from),
            Err(error) => Err(error.into_error()),
        };
        committed.map_err(|error| explain(&name, error))
    }
}

fn cannot_create(path: &Path, error: &WriteError) -> anyhow::Error {
    anyhow!("cannot create {}: {error}", named(path))
}

fn explain(name: &str, error: std::io::Error) -> std::io::Error {
    let advice = match error.kind() {
        ErrorKind::BrokenPipe => return error,
        ErrorKind::StorageFull => {
            format!("cannot write {name}: the disk is full; free some space or write elsewhere")
        }
        _ => format!("cannot write {name}: {error}"),
    };
    std::io::Error::new(error.kind(), advice)
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let Output { name, inner } = self;
        let written = match inner {
            Inner::Stdout(out) => out.write(bytes),
            Inner::Once(out) => out.write(bytes),
            Inner::Journal { bytes: all, .. } => all.write(bytes),
        };
        written.map_err(|error| explain(name, error))
    }

    fn flush(&mut self) -> std::io::Result<()> {
        let Output { name, inner } = self;
        let flushed = match inner {
            Inner::Stdout(out) => out.flush(),
            Inner::Once(out) => out.flush(),
            Inner::Journal { path, bytes } => write_whole(path, bytes).map_err(std::io::Error::from),
        };
        flushed.map_err(|error| explain(name, error))
    }
}

/// Whether what is written to `path` ends up where standard output goes.
pub(super) fn is_stdout(path: &Path) -> bool {
    is_same(path, Path::new(STDOUT))
}

/// Whether two names stand for one file or pipe, of which one may be `-`.
pub(super) fn is_same(a: &Path, b: &Path) -> bool {
    a == b || file::is_same(system_name(a), system_name(b))
}

fn system_name(path: &Path) -> &Path {
    if cfg!(unix) && path == Path::new(STDOUT) { Path::new("/dev/stdout") } else { path }
}

/// Refuses an output over a scene that is read, which only a scene of a file can be.
pub(super) fn spare_scene(option: &str, path: &Path, setup: &crate::scene::Setup) -> anyhow::Result<()> {
    match setup.file.as_deref().filter(|scene| is_same(path, scene)) {
        Some(scene) => anyhow::bail!("{option} would overwrite the scene {}: give it another file name", named(scene)),
        None => Ok(()),
    }
}
