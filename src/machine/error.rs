//! Why a machine cannot be, or cannot follow a path.

use super::Axis;
use glam::DVec3;

/// Why a description is no machine that can be planned for.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{field}: {message}")]
pub struct MachineError {
    /// What is wrong, as `axes.C.point`.
    pub field: String,
    /// What would be right.
    pub message: String,
}

impl MachineError {
    /// That of a field.
    pub fn new(field: impl Into<String>, message: impl Into<String>) -> Self {
        Self { field: field.into(), message: message.into() }
    }
}

/// Why a machine cannot follow a path. Moves are counted from 0; points are tips in the workpiece frame, mm.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MotionError {
    /// The path holds no move.
    #[error("the toolpath has no moves: plan at least one pass")]
    Empty,
    /// A move is no motion.
    #[error("move {index}: every coordinate must be finite and every feed above 0 mm/min")]
    NotFinite {
        /// The move.
        index: usize,
    },
    /// No position of the rotary axes gives the tool that axis.
    #[error(
        "move {index} to ({:.3}, {:.3}, {:.3}): the axis leans by {degrees:.3}°, which {axes} cannot do: \
         plan with less tilt, or take a machine with other rotary axes", point.x, point.y, point.z
    )]
    Unreachable {
        /// The move.
        index: usize,
        /// Its tip.
        point: DVec3,
        /// Angle between the tool and where it points while the rotary axes stand at 0.
        degrees: f64,
        /// The machine's rotary axes.
        axes: String,
    },
    /// An axis would leave its limits.
    #[error(
        "move {index} to ({:.3}, {:.3}, {:.3}): {letter} would go to {position:.3}{unit}, but its limits are {low:.3} to \
         {high:.3}{unit}: clamp the part elsewhere, or take another machine", point.x, point.y, point.z
    )]
    Limit {
        /// The move.
        index: usize,
        /// Its tip.
        point: DVec3,
        /// The axis.
        letter: char,
        /// Where it would go, mm or degrees.
        position: f64,
        /// Least position, mm or degrees.
        low: f64,
        /// Greatest position, mm or degrees.
        high: f64,
        /// ` mm` or `°`.
        unit: &'static str,
    },
    /// An axis must turn back, and the cutter is never out of the part to do it.
    #[error(
        "move {index} to ({:.3}, {:.3}, {:.3}): {letter} is at its limit and must turn back, but since move {since} the path offers \
         no link to do it on (two moves between passes, one after the other): cut in shorter passes, or start elsewhere",
         point.x, point.y, point.z
    )]
    NoTurn {
        /// The move.
        index: usize,
        /// Its tip.
        point: DVec3,
        /// The axis.
        letter: char,
        /// The last move at whose end the axis might have turned back; 0 if there was none.
        since: usize,
    },
    /// Two neighbouring positions cannot be joined within the tolerance.
    #[error(
        "move {index} to ({:.3}, {:.3}, {:.3}): the rotary axes would jump: the tolerances of tip and axis must be above 0",
        point.x, point.y, point.z
    )]
    Jump {
        /// The move.
        index: usize,
        /// Its tip.
        point: DVec3,
    },
}

impl MotionError {
    /// `axis` would leave its limits at `position`, on move `index` to `point`.
    pub(super) fn limit(index: usize, point: DVec3, axis: &Axis, position: f64) -> Self {
        let [low, high] = axis.limits.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]).map(|x| axis.shown(x));
        let (position, unit) = (axis.shown(position), axis.unit());
        Self::Limit { index, point, letter: axis.letter, position, low, high, unit }
    }
}
