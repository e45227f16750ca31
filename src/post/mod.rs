//! Programs as text, out and in: APT cutter-location files, three-axis G-code, tables; those of lathes on X, Z and C, and those of machines
//! whose axes are described.
//!
//! What a writer writes its reader reads back, within the stated rounding; and writing what was read gives the same bytes.

pub mod apt;
pub mod csv;
pub mod gcode;
#[cfg(feature = "kinematics")]
pub mod multiaxis;
pub mod xzc;

mod digits;
mod error;
mod mark;
mod number;
mod program;
pub mod svg;

pub use error::{ReadError, WriteError};
pub use program::{Program, Unit};
