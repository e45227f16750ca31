//! The cutter: APT's seven parameters, its profile and the profile's inverse.

mod apt;
mod holder;
mod profile;
mod tool;

pub use apt::{Cutter, CutterError};
pub use holder::Holder;
pub use tool::Tool;
