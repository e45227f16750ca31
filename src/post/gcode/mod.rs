//! G-code for three-axis mills (RS-274, the dialect that Fanuc-like controls and LinuxCNC share).
//!
//! Rounding: positions to 10⁻⁴ mm, so by at most 0.09 µm in space; feeds to 10⁻³ mm/min.

mod read;
mod write;

pub use read::read;
pub use write::write;
