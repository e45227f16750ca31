//! Programs as text, out and in: APT cutter-location files, three-axis G-code, tables; and those of lathes on X, Z and C.
//!
//! What a writer writes its reader reads back, within the stated rounding; and writing what was read gives the same bytes.

pub mod apt;
pub mod csv;
pub mod gcode;
pub mod xzc;

mod error;
mod mark;
mod number;
mod program;
pub mod svg;

pub use error::{ReadError, WriteError};
pub use program::{Program, Unit};
