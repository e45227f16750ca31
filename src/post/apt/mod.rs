//! APT cutter-location text (`GOTO/x,y,z,i,j,k`), which post-processors for any machine read.
//!
//! Rounding: tips to 10⁻⁵ mm (10⁻⁶ inch), so by at most 0.03 µm in space; axes to 10⁻⁷, so by at most 0.02 µm at the
//! end of a 100 mm lever; feeds to 10⁻⁴ mm/min (10⁻⁵ inch/min).

mod read;
mod write;

pub use read::{Notes, read, read_with_notes};
pub use write::write;
