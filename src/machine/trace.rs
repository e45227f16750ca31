//! Where the tool goes while the axes go straight from one position to the next.

use super::follow::LARGEST_TURN;
use super::{Control, Kinematics, Position, Tolerance};
use crate::toolpath::ClPoint;

/// Appends places of the tool from `from`, without it, to `to`, such that straight moves of tip and axis between them stay within
/// `tolerance` of how the machine goes under a `control`.
///
/// Straight moves of all axes bend the tip's way and the axis' where rotary axes turn; a control that keeps the tip on its line still
/// bends the axis'.
pub fn trace(
    kinematics: &Kinematics,
    control: Control,
    [from, to]: [&Position; 2],
    tolerance: &Tolerance,
    places: &mut Vec<ClPoint>,
) {
    let (start, end) = (kinematics.pose(from), kinematics.pose(to));
    let at = |t: f64| match control {
        Control::Axes => kinematics.pose(&from.lerp(to, t)),
        Control::Tip | Control::Vector => {
            ClPoint { tip: start.tip.lerp(end.tip, t), axis: kinematics.pointing(from.lerp(to, t).rotary) }
        }
    };
    let turn = (0..2).map(|k| (to.rotary[k] - from.rotary[k]).abs()).fold(0.0, f64::max);
    let keeps = |[a, b]: [&ClPoint; 2], middle: &ClPoint, share: f64| {
        let axis = a.axis.lerp(b.axis, 0.5).normalize_or(a.axis);
        turn * share <= LARGEST_TURN
            && middle.tip.distance(a.tip.lerp(b.tip, 0.5)) <= tolerance.chord
            && middle.axis.distance(axis) <= tolerance.axis
    };
    let mut left = vec![(1.0, end)];
    let (mut begin, mut begun) = (0.0, start);
    while let Some(&(share, end)) = left.last() {
        let half = 0.5 * (begin + share);
        let middle = at(half);
        // Halves of halves end far below what any tolerance asks for.
        if keeps([&begun, &end], &middle, share - begin) || share - begin < 1e-6 {
            left.pop();
            places.push(end);
            (begin, begun) = (share, end);
        } else {
            left.push((half, middle));
        }
    }
}
