//! How far a program that was read back is from the path that it was made of.

use crate::math::angle::angle_between;
use crate::toolpath::{ClPoint, Toolpath};

/// The largest differences at the ends of the path's moves.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Deviation {
    /// Of the tip, mm.
    pub tip_mm: f64,
    /// Of the axis, degrees.
    pub axis_deg: f64,
}

/// How far a place may be from the end of a move and still be taken for it: of the tip, mm, and of the axis, radians. Both are many
/// times what rounding does, and far less than a skipped block would leave.
const NEAR: [f64; 2] = [0.01, 1e-3];

/// Compares the ends of the moves of `path`, in their order, with the places that `read` comes through: each with the nearest of those that
/// follow one another near to it. `None` if it does not come near to one of them.
pub fn deviation(path: &Toolpath, read: &Toolpath) -> Option<Deviation> {
    let mut worst = Deviation::default();
    let mut left = &read.moves[..];
    for step in &path.moves {
        let first = left.iter().position(|place| is_near(&place.to, &step.to, 1.0))?;
        // What bows on its way does not leave at once where it came near.
        let near = left[first..].iter().take_while(|place| is_near(&place.to, &step.to, 2.0));
        let (best, place) = near
            .enumerate()
            .min_by(|(_, a), (_, b)| off(&a.to, &step.to).total_cmp(&off(&b.to, &step.to)))?;
        worst.tip_mm = worst.tip_mm.max(place.to.tip.distance(step.to.tip));
        worst.axis_deg = worst.axis_deg.max(angle_between(place.to.axis, step.to.axis).to_degrees());
        // The next may end in the same place.
        left = &left[first + best..];
    }
    Some(worst)
}

/// Within `times` of [`NEAR`].
fn is_near(a: &ClPoint, b: &ClPoint, times: f64) -> bool {
    a.tip.distance(b.tip) < times * NEAR[0] && a.axis.distance(b.axis) < times * NEAR[1]
}

/// A difference that counts a radian as the end of a 10 mm lever.
fn off(a: &ClPoint, b: &ClPoint) -> f64 {
    a.tip.distance(b.tip) + 10.0 * a.axis.distance(b.axis)
}
