//! From a file or a text to a document, with every mistake reported once, in place.

use super::document::{Document, VERSION};
use super::error::{Fault, Place, Problem, SceneError, shown};
use super::locate::{line_and_column, locate};
use super::nearest::nearest;
use super::{Setup, every_scene, find_shipped};
use crate::file::{Unreadable, read_bounded};
use ron::Options;
use ron::error::SpannedError;
use ron::extensions::Extensions;
use serde::Deserialize;
use std::ffi::OsStr;
use std::io::ErrorKind;
use std::path::Path;

/// The largest scene file that is read [bytes].
pub const LARGEST_FILE: u64 = 16 * 1024 * 1024;

/// Brackets within brackets that a scene may have; the format itself needs seven.
const DEEPEST: usize = 32;

/// Opens a shipped scene by its name or a scene file by its path, ready to run.
pub fn open(name_or_path: impl AsRef<OsStr>) -> Result<Setup, SceneError> {
    let path = Path::new(name_or_path.as_ref());
    let name = path.to_string_lossy();
    if let Some(scene) = find_shipped(path) {
        return parse(&name, scene.text);
    }
    let text = read_file(path).map_err(|error| suggest_shipped(error, path))?;
    let setup = parse(&name, &text)?;
    Ok(Setup { file: Some(path.to_owned()), ..setup })
}

/// Reads and builds the scene in `text`; `name` is what errors call it and the setup's name.
pub fn parse(name: &str, text: &str) -> Result<Setup, SceneError> {
    let document = Document::from_text(name, text)?;
    let setup = document.setup(name).map_err(|fault| in_text(name, text, fault))?;
    Ok(setup)
}

impl Document {
    /// Reads a document. Syntax, names and types of its fields are checked here, numbers and references when it is built.
    pub fn from_text(name: &str, text: &str) -> Result<Document, SceneError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let document: Document = match options().from_str(text) {
            Ok(document) => document,
            // A file of a later version has fields that this one does not know: say that, not which.
            Err(error) => {
                let version = version_of(text).filter(|version| *version != VERSION);
                return Err(version.map_or_else(
                    || syntax_error(name, text, &error),
                    |version| in_text(name, text, wrong_version(version)),
                ));
            }
        };
        if document.version != VERSION {
            return Err(in_text(name, text, wrong_version(document.version)));
        }
        Ok(document)
    }
}

/// How scenes are written and read: `Some(…)` may be left out, and a variant does not need two pairs of brackets.
pub(crate) fn options() -> Options {
    let extensions = Extensions::IMPLICIT_SOME | Extensions::UNWRAP_VARIANT_NEWTYPES;
    Options::default().with_default_extension(extensions).with_recursion_limit(DEEPEST)
}

/// Reads a scene file as text. Refuses, without reading or waiting, what is too large or no file on a disk.
pub fn read_file(path: &Path) -> Result<String, SceneError> {
    let name = path.to_string_lossy();
    let bytes =
        read_bounded(path, LARGEST_FILE).map_err(|error| SceneError::file(name.as_ref(), unreadable(&error)))?;
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let text = String::from_utf8_lossy(&error.as_bytes()[..valid]).into_owned();
        let found = format!("the byte 0x{:02x}, which is not UTF-8", error.as_bytes()[valid]);
        let mend = "Save the file as UTF-8 text, or check that it is a scene at all.";
        SceneError::text(name.as_ref(), line_and_column(&text, valid), Problem::new(found, "text in UTF-8", mend))
    })
}

fn unreadable(error: &Unreadable) -> Problem {
    const FILE: &str = "a scene file";
    const SCENE: &str = "a scene file or the name of a shipped scene";
    let (expected, mend) = match error {
        Unreadable::Folder => (FILE, "Name a file in it, for example one that ends in .ron."),
        Unreadable::Special | Unreadable::Pseudo => (FILE, "Write the scene to a file on a disk and name that."),
        Unreadable::Large { .. } => (
            "a scene of at most 16 MB",
            "Check that it is a scene; large scenes are written with generators such as Pile(count: 20000).",
        ),
        Unreadable::System(error) => return unreadable_to_system(error, SCENE),
    };
    Problem::new(error.to_string(), expected, mend)
}

fn unreadable_to_system(error: &std::io::Error, expected: &str) -> Problem {
    let (found, mend) = match error.kind() {
        ErrorKind::NotFound => ("no such file".to_owned(), "Check the name; `tautline scenes` lists the shipped ones."),
        ErrorKind::PermissionDenied => {
            ("a file that may not be read".to_owned(), "Change its permissions, or copy it somewhere else.")
        }
        _ => (format!("a file that cannot be read ({error})"), "Check the path and the disk."),
    };
    Problem::new(found, expected, mend)
}

/// Names the shipped scene that was probably meant, if the file does not exist.
fn suggest_shipped(mut error: SceneError, path: &Path) -> SceneError {
    if let Some(known) = nearest(&path.to_string_lossy(), every_scene().iter().map(|scene| scene.name))
        && matches!(error.place, Place::File(_))
        && !path.exists()
    {
        error.problem.mend = format!("Did you mean `{known}`? `tautline scenes` lists the shipped ones.");
    }
    error
}

/// The version that a text claims, whatever else is in it; `None` if that cannot be read.
fn version_of(text: &str) -> Option<u32> {
    #[derive(Deserialize)]
    struct Header {
        version: u32,
    }
    options().from_str::<Header>(text).ok().map(|header| header.version)
}

fn wrong_version(version: u32) -> Fault {
    let mend = if version > VERSION {
        "The file comes from a later program: update tautline, or write the scene in version 1."
    } else {
        "Write `version: 1`."
    };
    Fault::new(Some("version"), Problem::new(format!("version {version}"), format!("version {VERSION}"), mend))
}

/// A fault of a part of a document, at the place where that part stands in the text.
pub(crate) fn in_text(name: &str, text: &str, fault: Fault) -> SceneError {
    let place = line_and_column(text, locate(text, &fault.path));
    SceneError::text(name, place, *fault.problem)
}

/// What the RON reader reports, in the words of the format.
fn syntax_error(name: &str, text: &str, error: &SpannedError) -> SceneError {
    use ron::Error;
    let (start, end) = (&error.span.start, &error.span.end);
    // Names are reported after they were read, so their start is the place; everything else is where the reader stands.
    let place = match error.code {
        Error::NoSuchStructField { .. }
        | Error::NoSuchEnumVariant { .. }
        | Error::DuplicateStructField { .. }
        | Error::InvalidValueForType { .. }
        | Error::IntegerOutOfBounds
        | Error::ExpectedDifferentStructName { .. } => [start.line, start.col],
        _ => [end.line, end.col],
    };
    let place = if matches!(error.code, Error::IntegerOutOfBounds) { at_sign(text, place) } else { place };
    if text.trim().is_empty() {
        let mend = "Start with `(version: 1, bodies: [Disc(position: (0, 1))])`.";
        return SceneError::text(name, [1, 1], Problem::new("an empty file", "a scene", mend));
    }
    SceneError::text(name, place, syntax_problem(&error.code, &token_at(text, place)))
}

fn syntax_problem(code: &ron::Error, token: &str) -> Problem {
    use ron::Error;
    match code {
        Error::NoSuchStructField { expected, found, .. } => unknown("field", found, expected),
        Error::NoSuchEnumVariant { expected, found, .. } => unknown("kind", found, expected),
        Error::DuplicateStructField { field, .. } => {
            Problem::new(format!("a second `{field}`"), "each field once", "Remove one of the two.")
        }
        Error::MissingStructField { field: "version", .. } => {
            Problem::new("no version", "`version: 1` in the scene", "Write `version: 1,` as the first line after `(`.")
        }
        Error::MissingStructField { field, .. } => Problem::new(
            format!("no `{field}` before this"),
            format!("a value for `{field}`"),
            format!("Add `{field}: …` to the brackets that end here."),
        ),
        Error::InvalidValueForType { expected, found } => {
            let found = ["unsigned integer", "signed integer", "floating point number"]
                .iter()
                .fold(found.clone(), |text, long| text.replace(long, "number"));
            Problem::new(shown(&found), expected.clone(), "Change the value.")
        }
        // The only lists of a fixed length are points and pairs.
        Error::ExpectedDifferentLength { found, .. } => {
            Problem::new(format!("the end after {found} of two numbers"), "two numbers", "Write a point as (1.0, 2.0).")
        }
        Error::ExpectedDifferentStructName { expected, found } => Problem::new(
            format!("`{}`", shown(found)),
            format!("`{expected}` or nothing"),
            "Remove the name before the bracket.",
        ),
        Error::ExceededRecursionLimit => Problem::new(
            "brackets nested too deeply",
            format!("at most {DEEPEST} levels"),
            "Remove the extra brackets.",
        ),
        Error::Eof => Problem::new(END, "the rest of the scene", CLOSE),
        Error::ExpectedComma if token.starts_with("`.") => {
            Problem::new(format!("the fraction {token}"), "a whole number", "Write a whole number such as 4.")
        }
        Error::TrailingCharacters => {
            Problem::new(format!("{token} after the end of the scene"), "nothing more", "Remove it, or move it inside.")
        }
        Error::IntegerOutOfBounds => {
            Problem::new(format!("{token}, which is out of range"), "a whole number from 0 to 4294967295", "Change it.")
        }
        Error::InvalidEscape(_) => Problem::new(
            "an unknown escape in a string",
            "one of \\n, \\t, \\\", \\\\",
            "Write `\\\\` for a backslash.",
        ),
        other => {
            let (expected, mend) = expectation(other);
            Problem::new(token, expected, if token == END { CLOSE } else { mend })
        }
    }
}

const END: &str = "the end of the file";
const CLOSE: &str = "Close every bracket and quote that was opened.";

/// What the reader expected, and the usual cause, for errors that carry nothing but their kind.
fn expectation(code: &ron::Error) -> (String, &'static str) {
    use ron::Error;
    let (expected, mend) = match code {
        Error::ExpectedFloat => ("a number", "Write a number such as 0.5, without unit and quotes."),
        Error::ExpectedInteger => ("a whole number", "Write a whole number such as 4."),
        Error::ExpectedBoolean => ("true or false", "Write true or false, without quotes."),
        Error::ExpectedString => ("a text in quotes", "Put it in double quotes."),
        Error::ExpectedStringEnd => ("the closing quote of a text", "Close the text with a double quote."),
        Error::ExpectedNamedStructLike("DVec2") => {
            ("a point such as (1.0, 2.0)", "Write both coordinates in brackets.")
        }
        Error::ExpectedStructLike | Error::ExpectedNamedStructLike(_) => {
            ("an opening bracket `(`", "Put the fields in ( ), as in `(version: 1)`.")
        }
        Error::ExpectedStructLikeEnd => ("a comma or the closing bracket `)`", "Add what is missing, or remove this."),
        Error::ExpectedArray => ("a list in [ ]", "Put the entries in square brackets, also if there is only one."),
        Error::ExpectedArrayEnd => ("a comma or the closing bracket `]`", "Add what is missing, or remove this."),
        Error::ExpectedComma => ("a comma", "Separate entries with commas, and write numbers without units."),
        Error::ExpectedMapColon => ("a colon after the name of a field", "Write fields as `name: value`."),
        Error::ExpectedIdentifier | Error::InvalidIdentifier(_) => {
            ("the name of a field or a kind", "Write fields as `name: value`, and kinds as in `Disc(radius: 0.5)`.")
        }
        Error::ExpectedUnit => ("an empty `()`", "Remove what is in the brackets."),
        Error::UnclosedBlockComment => ("the end `*/` of a comment", "Close the comment."),
        Error::ExpectedAttribute | Error::ExpectedAttributeEnd | Error::NoSuchExtension(_) => {
            ("a known `#![enable(…)]` line or none", "Remove the line; scenes need none.")
        }
        Error::UnderscoreAtBeginning | Error::FloatUnderscore | Error::InvalidIntegerDigit { .. } => {
            ("a plain number", "Write the number with digits, a point and an exponent only.")
        }
        other => return (format!("something else ({other})"), "Compare with a shipped scene under scenes/."),
    };
    (expected.to_owned(), mend)
}

fn unknown(what: &str, found: &str, expected: &[&str]) -> Problem {
    let known = expected.join(", ");
    let mend = match nearest(found, expected.iter().copied()) {
        Some(meant) => format!("Did you mean `{meant}`?"),
        None => "Remove it or use one of those.".to_owned(),
    };
    Problem::new(format!("the unknown {what} `{}`", shown(found)), format!("one of {known}"), mend)
}

/// The reader steps over the sign of a number before it reports the number.
fn at_sign(text: &str, [line, column]: [usize; 2]) -> [usize; 2] {
    let before = text.lines().nth(line - 1).and_then(|line| line.chars().nth(column.checked_sub(2)?));
    [line, if before == Some('-') { column - 1 } else { column }]
}

/// What stands at a place, as a user would point at it.
fn token_at(text: &str, [line, column]: [usize; 2]) -> String {
    let mut lines = text.lines().skip(line - 1);
    let rest: String = lines.next().unwrap_or("").chars().skip(column - 1).take(24).collect();
    let is_word = |c: char| c.is_alphanumeric() || "_.+-".contains(c);
    let word: String = rest.chars().take_while(|c| is_word(*c)).collect();
    match rest.chars().next() {
        None if lines.all(|line| line.trim().is_empty()) => END.to_owned(),
        None => "the end of the line".to_owned(),
        Some('"') => format!("the text {}", rest.split_inclusive('"').take(2).collect::<String>()),
        Some(first) if word.is_empty() => format!("`{first}`"),
        Some(_) => format!("`{word}`"),
    }
}
