//! Turning the axis that is free in the pole on the way through it, and not all at once.

use super::choose::Chosen;
use super::ends::End;
use crate::toolpath::Move;

/// Spreads the turn of the first rotary axis over every run of moves in which the tool stays in the pole, evenly along the tip's way from
/// where it comes in to where it goes out. Without this the tool would stand still where it goes out, and mark the part.
///
/// A run at the beginning or the end of the path, or one on which the tool is turned over, has nothing to spread.
pub(super) fn spread(chosen: &mut [Chosen], ends: &[End], moves: &[Move]) {
    let mut at = 1;
    while at < ends.len() {
        let count = ends[at..].iter().take_while(|end| end.is_free).count();
        if count > 0 && !ends[at - 1].is_free && at + count < ends.len() {
            spread_run(&mut chosen[at - 1..=at + count], &moves[at - 1..=at + count]);
        }
        at += count + 1;
    }
}

/// From before the first to after the last of a run.
fn spread_run(chosen: &mut [Chosen], moves: &[Move]) {
    let [before, run @ .., after] = chosen else { return };
    if run.iter().any(|at| at.leave.is_some()) {
        return;
    }
    let ways: Vec<f64> = moves.windows(2).map(|pair| pair[0].to.tip.distance(pair[1].to.tip)).collect();
    let (whole, from) = (ways.iter().sum::<f64>(), before.leave.unwrap_or(before.arrive)[0]);
    if whole <= 0.0 {
        return;
    }
    let turn = after.arrive[0] - from;
    let mut gone = 0.0;
    for (at, way) in run.iter_mut().zip(&ways) {
        gone += way;
        at.arrive[0] = from + turn * gone / whole;
    }
}
