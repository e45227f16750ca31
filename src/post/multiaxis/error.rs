//! Why a machine's program cannot be written.

/// Why a machine's program cannot be written in a dialect.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PostError {
    /// The path holds no move.
    #[error("the path has no moves: plan at least one pass")]
    Empty,
    /// A position or a time is not a number.
    #[error("move {index}: every position and time must be finite")]
    NotFinite {
        /// The move of the toolpath, counted from 0.
        index: usize,
    },
    /// The dialect cannot state what the machine does.
    #[error("{dialect} {message}")]
    Dialect {
        /// The dialect's name.
        dialect: &'static str,
        /// What would be right.
        message: &'static str,
    },
    /// The program is longer than asked for.
    #[error(
        "the program has {blocks} blocks, more than the {most} that the control takes: give it a coarser tolerance, or split it"
    )]
    TooLong {
        /// Its blocks.
        blocks: usize,
        /// How many there may be.
        most: usize,
    },
}
