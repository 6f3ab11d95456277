//! What is wrong with a scene file: where, what was found, what was expected, and how to mend it.

use crate::engine::EngineError;
use crate::text::escaped;
use std::borrow::Cow;
use std::fmt;

/// The one message about a scene that cannot be used. It is fit for a terminal, whatever stands in the file and its
/// name.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", escaped(&format!("{place}: {problem}")))]
pub struct SceneError {
    /// Where in the file or the document.
    pub place: Place,
    /// What stands there, what should, and how to mend it.
    pub problem: Box<Problem>,
}

/// Where a scene is wrong.
#[derive(Clone, Debug, PartialEq)]
pub enum Place {
    /// The file as a whole.
    File(String),
    /// A place in its text; line and column count from 1, the column in characters.
    Text {
        /// The scene's name or path.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Character of the line, from 1.
        column: usize,
    },
    /// A part of a document that has no text, such as `bodies[3].mass`.
    Part(String),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::File(name) | Place::Part(name) => f.write_str(name),
            Place::Text { file, line, column } => write!(f, "{file}:{line}:{column}"),
        }
    }
}

/// What is wrong, as three parts of a sentence.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// What stands there.
    pub found: String,
    /// What should stand there.
    pub expected: String,
    /// What to do about it: a whole sentence.
    pub mend: String,
}

impl Problem {
    /// A problem from its three parts.
    pub fn new(found: impl Into<String>, expected: impl Into<String>, mend: impl Into<String>) -> Problem {
        Problem { found: found.into(), expected: expected.into(), mend: mend.into() }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "found {}, expected {}. {}", self.found, self.expected, self.mend)
    }
}

impl SceneError {
    /// An error about a file as a whole.
    pub fn file(file: impl Into<String>, problem: Problem) -> SceneError {
        SceneError { place: Place::File(file.into()), problem: Box::new(problem) }
    }

    /// An error at a place in a file's text, from 1.
    pub fn text(file: impl Into<String>, [line, column]: [usize; 2], problem: Problem) -> SceneError {
        SceneError { place: Place::Text { file: file.into(), line, column }, problem: Box::new(problem) }
    }
}

/// A name or a text of a file as a message shows it: its beginning, if it is long, with nothing in it that a terminal
/// obeys.
pub(crate) fn shown(name: &str) -> Cow<'_, str> {
    const LONGEST: usize = 48;
    match name.char_indices().nth(LONGEST) {
        Some((end, _)) => Cow::Owned(format!("{}…", escaped(&name[..end]))),
        None => escaped(name),
    }
}

/// One step of the way from a document to one of its parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Step {
    Field(&'static str),
    Index(usize),
}

/// A problem with a part of a document, before it is known where that part stands in a text.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// From the document inwards.
    pub(crate) path: Vec<Step>,
    pub(crate) problem: Box<Problem>,
}

impl Fault {
    /// A fault of the part at hand, or of one of its fields.
    pub(crate) fn new(field: Option<&'static str>, problem: Problem) -> Fault {
        Fault { path: field.map(Step::Field).into_iter().collect(), problem: Box::new(problem) }
    }

    /// A fault of a value that is out of its range.
    pub(crate) fn value(field: &'static str, value: f64, expected: impl Into<String>) -> Fault {
        Fault::new(Some(field), Problem::new(format!("{field} {value:?}"), expected, "Change the number."))
    }

    /// The same fault, seen from the list that holds the part.
    pub(crate) fn inside(mut self, list: &'static str, index: usize) -> Fault {
        self.path.splice(0..0, [Step::Field(list), Step::Index(index)]);
        self
    }

    /// The same fault, seen from the record that holds the part.
    pub(crate) fn within(mut self, field: &'static str) -> Fault {
        self.path.insert(0, Step::Field(field));
        self
    }

    /// The path as a user reads it: `bodies[3].mass`.
    pub(crate) fn part(&self) -> String {
        let mut part = String::from("scene");
        for step in &self.path {
            match step {
                Step::Field(field) => part.push_str(&format!(".{field}")),
                Step::Index(index) => part.push_str(&format!("[{index}]")),
            }
        }
        part
    }
}

impl From<Fault> for SceneError {
    fn from(fault: Fault) -> SceneError {
        SceneError { place: Place::Part(fault.part()), problem: fault.problem }
    }
}

/// What the engine refuses, as a fault of the field that it comes from.
impl From<EngineError> for Fault {
    fn from(error: EngineError) -> Fault {
        match error {
            EngineError::BadValue { what, value, expected } => {
                let mend = format!("Change the {what} to a value in that range.");
                Fault::new(field_of(what), Problem::new(format!("{what} {value:?}"), expected, mend))
            }
            EngineError::SameEnds => Fault::new(
                Some("b"),
                Problem::new(
                    "two ends that are the same body or both fixed",
                    "two different ends, at least one of them a body",
                    "Name another body at one end.",
                ),
            ),
            EngineError::NoBody(_) | EngineError::NoConstraint(_) | EngineError::NoWall(_) => {
                Fault::new(None, Problem::new(error.to_string(), "something that exists", "Name another one."))
            }
        }
    }
}

/// The field of the format behind a quantity of the engine.
fn field_of(what: &str) -> Option<&'static str> {
    const FIELDS: [(&str, &str); 31] = [
        ("gravity", "gravity"),
        ("drag", "drag"),
        ("hz", "hz"),
        ("substeps", "substeps"),
        ("iterations", "iterations"),
        ("baumgarte", "baumgarte"),
        ("accuracy", "accuracy"),
        ("stiffness factor", "stiffness"),
        ("position", "position"),
        ("speed", "velocity"),
        ("mass", "mass"),
        ("radius", "radius"),
        ("radius of a body with spin", "radius"),
        ("restitution", "restitution"),
        ("friction", "friction"),
        ("angle", "angle"),
        ("angular velocity", "omega"),
        ("rod length", "length"),
        ("rope length", "length"),
        ("rest length", "rest"),
        ("stiffness", "stiffness"),
        ("spring damping", "damping"),
        ("first anchor", "a"),
        ("second anchor", "b"),
        ("start of the segment", "from"),
        ("end of the segment", "to"),
        ("lower corner of the box", "min"),
        ("upper corner of the box", "max"),
        ("width of the box", "min"),
        ("height of the box", "min"),
        ("view height", "height"),
    ];
    FIELDS.iter().find(|(name, _)| *name == what).map(|(_, field)| *field)
}
