//! What tells one dialect's text from another's, as data.

use crate::machine::Control;

/// The text of a dialect.
///
/// Lines are written with these names replaced, and left out where nothing remains of them or where `{rpm}` is not known: `{part}`,
/// `{file}` (the part as one word), `{machine}`, `{d}` and `{r}` (the cutter's diameter and corner radius), `{length}` (the tool's), `{tool}`,
/// `{rpm}`, `{speed}` (` S` and the speed, or nothing), `{coolant}`, `{offset}` (the workpiece's origin in machine coordinates), `{top}` (Z at its
/// upper end, machine coordinates), `{rotary}` and `{xy}` (where the path begins, as the axes stand there), `{first}` (the same in the words of the path).
#[derive(Debug)]
pub(super) struct Format {
    pub(super) name: &'static str,
    /// What the control makes of a block.
    pub(super) control: Control,
    pub(super) feed: Feed,
    /// What stands before and after a remark.
    pub(super) remark: [&'static str; 2],
    /// The components of the tool's direction, where it is stated so.
    pub(super) vector: [&'static str; 3],
    /// Whether every line begins with its number, counted from 0.
    pub(super) counted: bool,
    /// Whether positive numbers have a sign.
    pub(super) plus: bool,
    pub(super) rapid: Rapid,
    pub(super) straight: Motion,
    /// Up to the tool above the part.
    pub(super) opening: &'static [&'static str],
    /// To where the path begins.
    pub(super) approach: &'static [&'static str],
    pub(super) closing: &'static [&'static str],
    /// Words that its reader knows, besides axes and F.
    pub(super) words: &'static [Words],
    /// Beginnings of lines that say nothing of the path.
    pub(super) passed: &'static [&'static str],
}

/// Words and what they do; one without a number is known with any.
pub(super) type Words = &'static [(&'static str, Option<f64>, Meaning)];

/// How the speed of a block is stated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Feed {
    /// As the inverse of its time in minutes (G93).
    InverseTime,
    /// As mm a minute of the tip; for blocks in which the tip stays, as degrees a minute.
    PerMinute,
}

/// The words of a straight move.
#[derive(Debug, Clone, Copy)]
pub(super) struct Motion {
    pub(super) code: &'static str,
    /// Whether the code holds until another.
    pub(super) modal: bool,
    /// What stands at the end of the block.
    pub(super) end: &'static str,
}

/// How rapid moves are written.
#[derive(Debug, Clone, Copy)]
pub(super) enum Rapid {
    Straight(Motion),
    /// As moves at the feed of the axes' greatest speed: the control's own rapid moves need not be straight.
    AtFeed,
}

/// What a word does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Meaning {
    Rapid,
    /// For this block alone.
    RapidOnce,
    Straight,
    InverseTime,
    PerMinute,
    /// The words after it state the path.
    PathOn,
    /// Likewise, and Z in the same block is the tool's length.
    PathOnWithLength,
    PathOff,
    /// The block is in machine coordinates.
    MachineCoordinates,
    End,
    /// It leaves the path alone.
    Nothing,
}
