//! The moves as a table for spreadsheets and scripts.

use super::number::{fixed, trimmed};
use crate::toolpath::{Bound, Rate, Role, Toolpath, Touch};
use std::fmt::Write;

/// One line a move after a header that states the units: index from 0, `cut` or `link`, feed in mm/min or `rapid`,
/// tip in millimetres, unit axis; and where the cutter touches at the end of the move, the contact point, lead and yaw in its
/// frame, the width of the strip that it finishes there where that is known, and what keeps its lead from being less.
/// Strips are those of the scallop height that passes were planned for, which a safety factor makes less than the limit.
/// Tips and contact points are rounded to 10⁻⁵ mm, axes to 10⁻⁷, angles to 10⁻³ degrees, strips to 10⁻⁴ mm.
///
/// `touches` belong to the moves of `path` in their order; those that are missing are left empty.
pub fn write(path: &Toolpath, touches: &[Touch]) -> String {
    let mut text = String::from(HEADER);
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
        let _ = writeln!(text, "{index},{role},{rate},{x},{y},{z},{i},{j},{k},{}", touch(touches.get(index)));
    }
    text
}

const HEADER: &str = "index,role,rate_mm_per_min,x_mm,y_mm,z_mm,i,j,k,contact_x_mm,contact_y_mm,contact_z_mm,lead_deg,yaw_deg,\
                      strip_mm,lead_bound\n";

/// The columns that tell of the contact.
fn touch(touch: Option<&Touch>) -> String {
    let Some(Touch { point, contact: Some((posture, work)) }) = touch else { return ",,,,,,".to_owned() };
    let [x, y, z] = point.to_array().map(|x| fixed(x, 5));
    let [lead, yaw] = [posture.lead, posture.yaw].map(|angle| fixed(angle.to_degrees(), 3));
    let strip = work.strip.map_or(String::new(), |strip| fixed(strip, 4));
    format!("{x},{y},{z},{lead},{yaw},{strip},{}", name(work.bound))
}

fn name(bound: Bound) -> &'static str {
    match bound {
        Bound::Given => "given",
        Bound::Least => "least",
        Bound::Curvature => "curvature",
        Bound::Beside => "beside",
        Bound::Body => "body",
        Bound::Holder => "holder",
        Bound::Turn => "turn",
        Bound::Misfit => "misfit",
        Bound::Met => "met",
    }
}
