//! The proof: a path, as read back from its text, cuts samples of the surface, and what it leaves is measured.
//!
//! Point-vector simulation: for each sample `p` with outward normal `n`, the line `p + t n` is entered by the moving
//! cutter first at some `t`, the *excess* left there. A negative excess is a gouge: how deep `p` ever is in the cutter,
//! which on open ground is the depth along the line, and on the crest of a thin wall what is shaved off it. Nothing here
//! knows how a path is planned: the cutter's body, its motion and its distance are stated anew, from the path and seven
//! parameters alone.
//!
//! Errors and where they are bounded: the time within a move ([`Body`]'s motion is cut so finely that the closest
//! approach is found to 0.05 µm), the gaps between samples ([`Statistics::excess_error`]), rounding (10⁻⁹ mm).

mod body;
mod bound;
mod cells;
mod cut;
mod entry;
mod floor;
mod hull;
mod motion;
mod patch;
mod refine;
#[cfg(feature = "study")]
mod removal;
mod samples;
mod statistics;
mod sweeps;
mod turning;
mod verification;

pub use body::Body;
pub use floor::{Class, Floor, floor};
#[cfg(feature = "study")]
pub use removal::{Removal, removal};
pub use samples::{Grid, Sample, SampleError, Samples};
pub use statistics::{Extreme, Histogram, Statistics};
pub use turning::{
    Band, Form, Residue, Sagitta, Surface, TurnedError, TurnedOptions, TurnedPart, TurnedProof, verify_turned,
};
pub use verification::{Options, Refined, Verification, VerifyError, verify};
