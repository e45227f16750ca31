//! Why a text cannot be read, or a program not be written.

use crate::cutter::CutterError;

/// Why a program text cannot be read; every variant that concerns a line names it, counted from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReadError {
    /// The text or the program is longer than the reader takes.
    #[error("the program is too long: at most {limit} {what}")]
    TooLong {
        /// What there is too much of.
        what: &'static str,
        /// How much would do.
        limit: usize,
    },
    /// A statement cannot be understood, or asks for what the reader cannot follow.
    #[error("line {line}: {word}: {message}")]
    Statement {
        /// The line in which the statement begins.
        line: usize,
        /// The word concerned.
        word: String,
        /// What would be right.
        message: String,
    },
    /// The cutter that the text states cannot exist.
    #[error("line {line}: CUTTER: {source}")]
    Cutter {
        /// The line of the `CUTTER` statement.
        line: usize,
        /// Which parameter is wrong.
        source: CutterError,
    },
    /// Something that must be stated is not.
    #[error("{what} is missing: state it as {example}")]
    Missing {
        /// What is missing.
        what: &'static str,
        /// How to state it.
        example: &'static str,
    },
}

impl ReadError {
    pub(super) fn statement(line: usize, word: &str, message: impl Into<String>) -> Self {
        // A damaged file may hold a word of any length.
        Self::Statement { line, word: word.chars().take(40).collect(), message: message.into() }
    }
}

/// Why a program cannot be written in a format.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum WriteError {
    /// A three-axis format was asked for a path whose axis leans.
    #[error(
        "move {index}: the axis leans by {degrees:.4}°, but three-axis G-code needs it upright (0, 0, 1): \
         plan without tilt or write APT"
    )]
    Tilted {
        /// The move, counted from 0.
        index: usize,
        /// The angle between axis and z.
        degrees: f64,
    },
    /// The path holds no move.
    #[error("the toolpath has no moves: plan at least one pass")]
    Empty,
    /// Straight moves were asked for a path that is cubic in time.
    #[error(
        "the path is cubic in time, which straight moves are not: write it as position, velocity and time"
    )]
    Cubic,
    /// A coordinate or feed is not a number that a machine can go to.
    #[error("move {index}: every coordinate must be finite and every feed above 0 mm/min")]
    NotFinite {
        /// The move, counted from 0.
        index: usize,
    },
}
