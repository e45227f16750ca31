//! What helps to understand a job: places on its surface, when which material goes, and figures to learn from.

mod lesson;
mod place;
mod removal;
mod restarts;

pub use lesson::{
    StudiedPasses, StudiedSection, StudiedWidths, studied_passes, studied_section, studied_widths,
};
pub use place::{Place, Subject};
pub use removal::{Removed, drawing, removed};
pub use restarts::{Family, Restarts, StudiedPath, restarts};

use serde::Serialize;

/// As JSON text.
pub fn json(value: &impl Serialize) -> String {
    // Finite numbers and lists always have a JSON form.
    serde_json::to_string(value).unwrap_or_default()
}
