//! Programs for machines whose axes are described, in the dialects of their controls, out and in.
//!
//! A dialect states the motion in one of three ways: as positions of all axes, with the kinematics applied; as the tip on the workpiece
//! and the rotary axes; or as the tip and the direction of the tool. Words of X, Y and Z are workpiece coordinates while the
//! rotary axes stand at 0: the control's work offset (G54) is the workpiece's origin, and the tool's length is switched on.
//!
//! Rounding: to the decimals of [`Layout`]. The tip is exact for the rounded rotary axes (see [`crate::machine::drive`]), so that with four
//! decimals it is off by at most 0.09 µm in space.

mod dialect;
mod error;
mod format;
mod layout;
mod names;
mod read;
mod scan;
mod words;
mod write;

pub use dialect::Dialect;
pub use error::PostError;
pub use layout::Layout;
pub use read::read;
pub use write::write;

use crate::cutter::Cutter;
use crate::machine::{AxisPath, Kinematics};

/// The motion of a machine's axes with all that its control must know to run it.
#[derive(Debug, Clone, PartialEq)]
pub struct MachineProgram<'a> {
    /// What is made; one line.
    pub part: &'a str,
    /// The machine's name; one line.
    pub machine: &'a str,
    /// The machine with its tool.
    pub kinematics: &'a Kinematics,
    /// The cutter that the tip belongs to.
    pub cutter: Cutter,
    /// The tool's place in the magazine, and of its length in the control's table.
    pub tool: u32,
    /// Revolutions a minute, clockwise seen from the spindle; `None` leaves the spindle to the operator.
    pub spindle_rpm: Option<f64>,
    /// Whether coolant is switched on.
    pub coolant: bool,
    /// The motion, made for [`Dialect::control`].
    pub path: &'a AxisPath,
}
