//! Both ways in which the machine can stand at the end of every move.

use super::{Kinematics, MotionError, Position};
use crate::math::angle::angle_between;
use crate::toolpath::{Move, Rate, Toolpath};
use std::f64::consts::TAU;

/// The end of a move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct End {
    /// The rotary axes in both solutions, in (−π, π].
    pub(super) rotary: [[f64; 2]; 2],
    /// The sine of the angle from where both solutions become one.
    pub(super) apart: f64,
    /// Whether the tool stands in the pole, where the first rotary axis is free.
    pub(super) is_free: bool,
    /// Whether the linear axes are within their limits in each.
    pub(super) holds: [bool; 2],
}

/// Within this angle of the pole, radians, the tool counts as standing in it, and the axis that is free there stays where it is. What
/// cutter-location text states of an axis is known to 10⁻⁷; the tool's axis is off by no more than this, 0.00006°.
const POLE: f64 = 1e-6;

/// Both ways to stand at the end of every move of `path`. In the pole the free axis stands as after the last move out of it, or, at the
/// beginning, as the first one.
///
/// Errors: no moves; a move that is not finite or fed at 0 or less; an axis that no position of the rotary axes gives the tool.
pub(super) fn ends(kinematics: &Kinematics, path: &Toolpath) -> Result<Vec<End>, MotionError> {
    if path.moves.is_empty() {
        return Err(MotionError::Empty);
    }
    let mut ends = Vec::with_capacity(path.moves.len());
    let mut last: Option<[f64; 2]> = None;
    for (index, step) in path.moves.iter().enumerate() {
        if !is_possible(step) {
            return Err(MotionError::NotFinite { index });
        }
        let ways = kinematics.ways(step.to.axis).ok_or_else(|| unreachable(kinematics, index, step))?;
        let is_free = kinematics.pole().is_some_and(|pole| pole.cross(step.to.axis).length() < POLE);
        let mut end = End { rotary: ways.pairs, apart: ways.apart, is_free, holds: [false; 2] };
        if let (true, Some(free)) = (is_free, last) {
            [end.rotary[0][0], end.rotary[1][0]] = free;
        } else if !is_free {
            let free = [end.rotary[0][0], end.rotary[1][0]];
            if last.is_none() {
                // Those before it were all in the pole.
                ends.iter_mut().for_each(|end: &mut End| [end.rotary[0][0], end.rotary[1][0]] = free);
            }
            last = Some(free);
        }
        ends.push(end);
    }
    for (end, step) in ends.iter_mut().zip(&path.moves) {
        end.holds = end.rotary.map(|rotary| {
            let Position { linear, .. } = kinematics.at(step.to.tip, rotary);
            kinematics.axes()[..3].iter().zip(linear.to_array()).all(|(axis, at)| axis.holds(at))
        });
    }
    Ok(ends)
}

/// An angle within half a turn of 0, radians.
pub(super) fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

fn is_possible(step: &Move) -> bool {
    let feeds = match step.rate {
        Rate::Rapid => true,
        Rate::Feed(feed) => feed > 0.0 && feed.is_finite(),
    };
    let unit = (step.to.axis.length() - 1.0).abs() < 1e-6;
    feeds && step.to.tip.is_finite() && unit
}

fn unreachable(kinematics: &Kinematics, index: usize, step: &Move) -> MotionError {
    let letters: Vec<String> = kinematics.axes()[3..].iter().map(|axis| axis.letter.to_string()).collect();
    let axes =
        if letters.is_empty() { "a machine without rotary axes".into() } else { letters.join(" and ") };
    let degrees = angle_between(step.to.axis, kinematics.upright()).to_degrees();
    MotionError::Unreachable { index, point: step.to.tip, degrees, axes }
}
