//! Why a file cannot be read.

use super::{Format, MAX_BYTES};

/// Where in a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// At a byte, counted from 0.
    Byte(usize),
    /// In a line, counted from 1.
    Line(usize),
    /// In a cell of a table: line and column, counted from 1.
    Cell {
        /// The line.
        line: usize,
        /// The column.
        column: usize,
    },
    /// In an entity of an IGES file.
    Entity {
        /// Its type.
        kind: i64,
        /// The sequence number of its first line in the directory, as in `D5`.
        directory: usize,
    },
    /// In a part of the file that has this name.
    Field(String),
    /// In the file as a whole.
    Whole,
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Place::Byte(byte) => write!(f, "byte {byte}"),
            Place::Line(line) => write!(f, "line {line}"),
            Place::Cell { line, column } => write!(f, "line {line}, column {column}"),
            Place::Entity { kind, directory } => write!(f, "entity D{directory} (type {kind})"),
            Place::Field(name) => write!(f, "{name}"),
            Place::Whole => f.write_str("whole file"),
        }
    }
}

/// Why a file cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ImportError {
    /// The file has no bytes.
    #[error("the file is empty")]
    Empty,
    /// The file has more than [`MAX_BYTES`].
    #[error("the file has {found} bytes; at most {MAX_BYTES} are read: export it coarser")]
    TooLarge {
        /// Its size.
        found: usize,
    },
    /// The format is known, but not read.
    #[error("{format} is not read; {}", format.instead())]
    Unsupported {
        /// The format.
        format: Format,
    },
    /// The content resembles no format known.
    #[error(
        "the content is of no format known; export a mesh as STL or OBJ, surfaces as IGES (entity 128), \
         heights as text, or a spline surface as JSON"
    )]
    Unrecognised,
    /// The file breaks its format's rules.
    #[error("{format}, {place}: {message}")]
    Malformed {
        /// The format.
        format: Format,
        /// Where.
        place: Place,
        /// What is wrong and what would be right.
        message: String,
    },
}

impl ImportError {
    pub(super) fn at(format: Format, place: Place, message: impl Into<String>) -> Self {
        Self::Malformed { format, place, message: message.into() }
    }
}
