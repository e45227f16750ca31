//! The proof of a path on X, Z and C: in machine coordinates, as read back from its text, it cuts the part with the body of
//! the tool, and what it leaves is measured on rays from the spindle axis.
//!
//! Nothing here knows how a nose is placed on a surface. A ball cuts as a sphere moving in space over the turning part; an insert cuts in
//! the plane of the spindle axis and X, where its nose is a circle: what stays on a ray is the lower envelope of the
//! circles of all turns that pass it.
//!
//! Errors: a ball's closest approach within a move is found to 10⁻⁹ mm along the normal; an insert's residue is its vertical gap times
//! the normal's z, right to second order in the gap over the nose radius. Between samples nothing is known but what [`refine`]
//! finds around the extremes.

mod ball;
mod curve;
mod form;
mod insert;
mod ray;
mod refine;
mod verification;

pub use form::{Band, Form, Sagitta};
pub use verification::{
    Residue, Surface, TurnedError, TurnedOptions, TurnedPart, TurnedProof, verify_turned,
};
