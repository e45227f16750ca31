//! How long a machine takes, with its axes' acceleration and jerk.

use super::stretch::{Block, stretches};
use super::{Axis, AxisPath};
use crate::toolpath::{Rate, Role};

/// Seconds by kind of move.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Times {
    /// Cutting.
    pub cut: f64,
    /// Links at feed.
    pub link: f64,
    /// Rapid.
    pub rapid: f64,
    /// Starting and stopping with bounded jerk, once for the whole program.
    pub settling: f64,
}

impl Times {
    /// All of it.
    pub fn total(&self) -> f64 {
        self.cut + self.link + self.rapid + self.settling
    }
}

/// The time that the axes need for `path` from rest to rest.
///
/// The control is taken to look ahead over the whole program: it goes at the greatest share of every move's own speed from which it can slow
/// down in time, with no axis accelerating by more than it can, and passes the corners between moves no faster than the axes can turn
/// there. Jerk is bounded as most controls do it, by running the axes' speeds through a moving average of the duration τ, the longest of
/// acceleration over jerk of the axes that move: a jump of speed of Δv becomes an acceleration of Δv/τ, and a change of acceleration of a
/// becomes a jerk of a/τ. That rounds corners, and ends the program τ later. Speeding up and turning are bounded one by one; on an axis
/// that does both they may add up. Moves in which all axes keep their speeds count as one, so that the time is the same in however many
/// blocks a motion is stated.
///
/// Source of the filter: L. Biagiotti, C. Melchiorri, FIR filters for online trajectory planning with time- and frequency-domain
/// specifications, 2012. Not counted: dwells, tool changes, spindles that run up.
pub fn estimate(axes: &[Axis], path: &AxisPath) -> Times {
    let mut times = Times::default();
    let durations = durations(axes, path);
    for (step, seconds) in path.moves.iter().zip(&durations) {
        match (step.rate, step.role) {
            (Rate::Rapid, _) => times.rapid += seconds,
            (Rate::Feed(_), Role::Cut) => times.cut += seconds,
            (Rate::Feed(_), Role::Link) => times.link += seconds,
        }
    }
    if durations.iter().any(|seconds| *seconds > 0.0) {
        times.settling = smoothing(axes, path);
    }
    times
}

/// How long each move of `path` takes, s, in the way of [`estimate`]; 0 for the first, and for those in which nothing moves.
pub fn durations(axes: &[Axis], path: &AxisPath) -> Vec<f64> {
    let stretches = stretches(axes, path);
    let blocks: Vec<Block> = stretches.iter().map(|stretch| stretch.block).collect();
    let corners = corners(axes, &blocks, smoothing(axes, path));
    let mut durations = vec![0.0; path.moves.len()];
    for (stretch, ends) in stretches.iter().zip(corners.windows(2)) {
        let profile = stretch.block.profile(ends[0], ends[1]);
        let (mut gone, mut before) = (0.0, 0.0);
        for (duration, step) in durations[stretch.moves()].iter_mut().zip(&path.moves[stretch.moves()]) {
            gone += step.seconds;
            let after = profile.seconds(gone.min(stretch.block.nominal));
            (*duration, before) = (after - before, after);
        }
    }
    durations
}

/// The duration of the moving average, s: what the axes that move need to come to their full acceleration.
pub fn smoothing(axes: &[Axis], path: &AxisPath) -> f64 {
    let moves = |k: usize| path.moves.windows(2).any(|pair| pair[0].at.all()[k] != pair[1].at.all()[k]);
    axes.iter()
        .enumerate()
        .filter(|(k, _)| moves(*k))
        .map(|(_, axis)| axis.acceleration / axis.jerk)
        .fold(0.0, f64::max)
}

/// The share of the full speed at both ends of every block.
fn corners(axes: &[Axis], blocks: &[Block], smoothing: f64) -> Vec<f64> {
    let mut shares = vec![0.0; blocks.len() + 1];
    for (k, share) in shares.iter_mut().enumerate().take(blocks.len()).skip(1) {
        *share = turning(axes, blocks.split_at(k), smoothing);
    }
    // What the blocks after it let it slow down from, and what those before it let it come to.
    for k in (0..blocks.len()).rev() {
        let room = 2.0 * blocks[k].acceleration * blocks[k].nominal;
        shares[k] = shares[k].min((shares[k + 1] * shares[k + 1] + room).sqrt());
    }
    for k in 0..blocks.len() {
        let room = 2.0 * blocks[k].acceleration * blocks[k].nominal;
        shares[k + 1] = shares[k + 1].min((shares[k] * shares[k] + room).sqrt());
    }
    shares
}

/// The greatest share of the full speed, up to 1, at which the axes can turn from the blocks before a corner into those after it.
///
/// After the moving average an axis is accelerated by the change of its speed over τ. At the share s what lies within τ is what full speed goes
/// through in s τ, and the change is s times as much: a corner by itself is passed at s Δv = a τ, and a curve of the acceleration a' at s² a' = a,
/// in however many corners it is stated. So s Δv(s τ) ≤ a τ, where Δv is the largest change from some time before the corner to as long
/// after it, up to s τ apart: what turns back within τ counts too.
fn turning(axes: &[Axis], (before, after): (&[Block], &[Block]), smoothing: f64) -> f64 {
    /// By how much longer the next time is that is looked at: speeds change little meanwhile.
    const NEXT: f64 = 1.1;
    let (mut left, mut right) = (before.len() - 1, 0);
    let mut share = 1.0f64;
    let mut ends = [before[left].nominal, after[0].nominal];
    let (mut time, mut look) = (0.0, 0.0);
    while time < 0.5 * share * smoothing || time == 0.0 {
        if time >= look {
            for (k, axis) in axes.iter().enumerate() {
                let jump = (after[right].speeds[k] - before[left].speeds[k]).abs();
                if share * jump > axis.acceleration * smoothing {
                    share = (axis.acceleration * smoothing / jump).max(2.0 * time / smoothing);
                }
            }
            look = NEXT * time;
        }
        time = ends[0].min(ends[1]);
        if ends[0] <= time {
            let Some(next) = left.checked_sub(1) else { break };
            left = next;
            ends[0] += before[left].nominal;
        }
        if ends[1] <= time {
            right += 1;
            let Some(next) = after.get(right) else { break };
            ends[1] += next.nominal;
        }
    }
    share
}
