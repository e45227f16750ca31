//! The cutter: APT's seven parameters, its profile and the profile's inverse.

mod apt;
mod profile;

pub use apt::{Cutter, CutterError};
