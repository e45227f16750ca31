//! How the axis leans along whole families of passes: fixed, matched to the surface's curvature, or for the widest strips.
//!
//! A posture is a function of the place on the face and of the way of feed there. [`choose`] finds it once for a face, at
//! the nodes of a grid, and [`PostureField`] answers for any place between them.

mod bound;
mod choose;
mod clear;
mod field;
mod fit;
mod lattice;
mod lead;
mod lift;
mod motion;
mod rule;
mod spline;
mod yaw;

pub use choose::{Ground, choose};
pub use field::{PostureField, Turning};
pub use motion::moving_strip;
pub use rule::{Limits, Rule};
