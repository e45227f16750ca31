//! The moves as a table for spreadsheets and scripts.

use super::number::{fixed, trimmed};
use crate::toolpath::{Rate, Role, Toolpath};
use std::fmt::Write;

/// One line a move after a header that states the units: index from 0, `cut` or `link`, feed in mm/min or `rapid`,
/// tip in millimetres, unit axis. Tips are rounded to 10⁻⁵ mm, axes to 10⁻⁷.
pub fn write(path: &Toolpath) -> String {
    let mut text = String::from("index,role,rate_mm_per_min,x_mm,y_mm,z_mm,i,j,k\n");
    for (index, step) in path.moves.iter().enumerate() {
        let role = match step.role {
            Role::Cut => "cut",
            Role::Link => "link",
        };
        let rate = match step.rate {
            Rate::Rapid => "rapid".to_owned(),
            Rate::Feed(feed) => trimmed(feed, 4),
        };
        let [x, y, z] = step.to.tip.to_array().map(|x| fixed(x, 5));
        let [i, j, k] = step.to.axis.to_array().map(|x| fixed(x, 7));
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{index},{role},{rate},{x},{y},{z},{i},{j},{k}");
    }
    text
}
