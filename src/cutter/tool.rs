//! What stands in the spindle.

use super::{Cutter, Holder};

/// A cutter and what holds it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tool {
    /// The cutter, with a shank as wide as its side at the top.
    pub cutter: Cutter,
    /// What holds it; nothing else is looked at where it is not known.
    pub holder: Option<Holder>,
}
