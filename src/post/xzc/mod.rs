//! Programs for a lathe whose C axis is a servo: G-code with X, Z and C, blocks of position, velocity and time, tables, and APT.
//!
//! Rounding: to the decimals of [`Rounding`], of lengths in mm and of angles in degrees. C runs on beyond a turn and never
//! jumps back. All writers state the words in the same sense, and readers give back what they mean: the nose centre and the angle of the
//! tool over the part.

mod apt;
mod gcode;
mod header;
mod pvt;
mod scan;
mod table;
mod words;

pub use apt::apt_program;
pub use gcode::{Dialect, Feed, read_gcode, write_gcode};
pub use header::{CWord, Reference, XWord};
pub use pvt::{read_pvt, write_pvt};
pub use table::{read_table, write_table};
pub use words::Rounding;

use crate::toolpath::{Nose, TurningPath};

/// A path on X, Z and C with all that a machine must know to run it.
#[derive(Debug, Clone, PartialEq)]
pub struct XzcProgram {
    /// What is made; one line.
    pub part: String,
    /// What cuts.
    pub nose: Nose,
    /// Which point of the tool the words state.
    pub reference: Reference,
    /// How X is stated.
    pub x_word: XWord,
    /// How C is stated.
    pub c_word: CWord,
    /// The tool's place in the turret.
    pub tool: u32,
    /// Speed of a mill's own spindle, 1/min; nothing for an insert.
    pub spindle_rpm: Option<f64>,
    /// How far above the path the nose comes and goes, mm.
    pub clearance: f64,
    /// Feed down to the path, mm/min.
    pub approach: f64,
    /// How far the control may round the corners between chords, mm.
    pub blend: f64,
    /// The motion of the nose centre, from rest to rest.
    pub path: TurningPath,
}
