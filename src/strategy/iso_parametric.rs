//! Passes along the lines of one parameter.

use super::family::Family;
use super::{Finish, Order, Planned, StrategyError};
use crate::cutter::Tool;
use crate::geometry::{Along, Face, Field};
use crate::monitor::Stage;
use crate::posture::Rule;

/// Passes of `face` that run along the parameter `along` at steps of the other, the axis
/// leaning by `rule`.
///
/// Each pass lies as far from the last as lets their strips meet everywhere, so the spacing of a whole pass follows its
/// worst point. On a periodic face the last pass meets the first.
pub fn iso_parametric(
    face: &Face,
    tool: &Tool,
    along: Along,
    rule: Rule,
    finish: Finish,
    order: Order,
    stage: &Stage,
) -> Result<Planned, StrategyError> {
    Family::of_rule(face, tool, &rule, finish, fields(along), order, stage)
}

/// The parameter whose level lines run `along` the other, and that.
pub(super) fn fields(along: Along) -> (Field, Field) {
    match along {
        Along::U => (Field::V, Field::U),
        Along::V => (Field::U, Field::V),
    }
}
