//! Why a file cannot be written, and what to do about it.

use std::io::ErrorKind;

/// Why a file cannot be written. What stood there before, if anything, stands there still.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{found}. {mend}")]
pub struct WriteError {
    /// What is in the way: "a folder of that name".
    pub found: String,
    /// What to do about it: a whole sentence.
    pub mend: &'static str,
    /// The system's kind of error; `InvalidInput` for what is refused before the system is asked.
    pub kind: ErrorKind,
}

impl WriteError {
    pub(super) fn new(found: impl Into<String>, mend: &'static str) -> WriteError {
        WriteError { found: found.into(), mend, kind: ErrorKind::InvalidInput }
    }
}

impl From<std::io::Error> for WriteError {
    fn from(error: std::io::Error) -> WriteError {
        let kind = error.kind();
        let (found, mend) = match kind {
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
        WriteError { found, mend, kind }
    }
}

impl From<WriteError> for std::io::Error {
    fn from(error: WriteError) -> std::io::Error {
        std::io::Error::new(error.kind, error)
    }
}
