//! Which axis keeps the machine from standing somewhere.

use super::ends::End;
use super::{Axis, Kinematics, MotionError};
use crate::toolpath::Move;
use std::f64::consts::TAU;

/// An axis beyond its limits.
#[derive(Debug, Clone, Copy)]
pub(super) struct Beyond<'a> {
    pub(super) axis: &'a Axis,
    /// Where it would stand; of all turns of a rotary axis the one nearest to its limits.
    position: f64,
    /// How far beyond, in shares of its range.
    by: f64,
}

/// The axes that would be beyond their limits at the end of `step` in one of its two solutions.
pub(super) fn beyond<'a>(kinematics: &'a Kinematics, step: &Move, end: &End, way: usize) -> Vec<Beyond<'a>> {
    let position = kinematics.at(step.to.tip, end.rotary[way]);
    let look = |(axis, at): (&'a Axis, f64)| {
        let [low, high] = axis.limits?;
        let outside = |x: f64| (low - x).max(x - high).max(0.0);
        let turns: &[f64] = if axis.is_rotary() { &[0.0, -TAU, TAU] } else { &[0.0] };
        let nearest =
            turns.iter().map(|turn| at + turn).min_by(|a, b| outside(*a).total_cmp(&outside(*b)))?;
        // Where X, Y and Z have come to lie in one plane, no position is enough.
        let by = if at.is_finite() { outside(nearest) / (high - low) } else { f64::INFINITY };
        (by > 0.0).then_some(Beyond { axis, position: nearest, by })
    };
    kinematics.axes().iter().zip(position.all()).filter_map(look).collect()
}

/// Why neither solution stands at the end of move `index`: in the better of them, the axis that is the farthest beyond its limits.
pub(super) fn out_of_limits(kinematics: &Kinematics, index: usize, step: &Move, end: &End) -> MotionError {
    let farthest =
        |way: usize| beyond(kinematics, step, end, way).into_iter().max_by(|a, b| a.by.total_cmp(&b.by));
    let better = [0, 1].into_iter().filter_map(farthest).min_by(|a, b| a.by.total_cmp(&b.by));
    match better {
        Some(Beyond { axis, position, .. }) => MotionError::limit(index, step.to.tip, axis, position),
        None => MotionError::Jump { index, point: step.to.tip },
    }
}
