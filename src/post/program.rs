//! What a program says besides its moves.

use crate::cutter::Cutter;
use crate::toolpath::Toolpath;

/// The unit of length a text is written in; inside everything is millimetres.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Unit {
    /// Millimetres.
    #[default]
    Mm,
    /// Inches.
    Inch,
}

impl Unit {
    /// Millimetres in one unit.
    pub fn millimetres(self) -> f64 {
        match self {
            Unit::Mm => 1.0,
            Unit::Inch => 25.4,
        }
    }
}

/// A toolpath with all that a machine must know to run it.
#[derive(Debug, Clone, PartialEq)]
pub struct Program {
    /// What is made; one line.
    pub part: String,
    /// The unit the text is written in. [`Program::cutter`] and [`Program::toolpath`] are millimetres all the same.
    pub unit: Unit,
    /// The cutter that the tip belongs to.
    pub cutter: Cutter,
    /// The cutter's place in the magazine.
    pub tool: u32,
    /// Revolutions a minute, clockwise seen from the spindle; `None` leaves the spindle to the operator.
    pub spindle_rpm: Option<f64>,
    /// The moves.
    pub toolpath: Toolpath,
}

impl Program {
    /// The part's name as one line of printable text without the signs that end a statement or a comment.
    pub(super) fn part_line(&self) -> String {
        plain_line(&self.part)
    }
}

/// `text` as one line of printable text without the signs that end a statement or a comment.
pub(super) fn plain_line(text: &str) -> String {
    let plain = |c: char| if c.is_control() || "$()%;".contains(c) { ' ' } else { c };
    let words = text.chars().map(plain).collect::<String>();
    words.split_whitespace().collect::<Vec<_>>().join(" ")
}
