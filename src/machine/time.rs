//! How long a machine takes, with its axes' acceleration and jerk.

use super::{Axis, AxisMove, AxisPath};
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
/// that does both they may add up.
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
    let found: Vec<Option<Block>> = path.moves.windows(2).map(|pair| Block::of(axes, pair)).collect();
    let blocks: Vec<Block> = found.iter().copied().flatten().collect();
    let corners = corners(axes, &blocks, smoothing(axes, path));
    let mut taken =
        blocks.iter().zip(corners.windows(2)).map(|(block, ends)| block.seconds(ends[0], ends[1]));
    let moves = found.iter().map(|block| block.and_then(|_| taken.next()).unwrap_or(0.0));
    std::iter::once(0.0).chain(moves).take(path.moves.len()).collect()
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

/// A move as the time that it takes at its own speed, and the axes' speeds then.
#[derive(Debug, Clone, Copy)]
struct Block {
    /// Seconds at full speed, above 0.
    nominal: f64,
    /// Of the axes at full speed, mm/s and rad/s.
    speeds: [f64; 5],
    /// How fast the share of the full speed may change, 1/s.
    acceleration: f64,
}

impl Block {
    fn of(axes: &[Axis], pair: &[AxisMove]) -> Option<Self> {
        let [from, to] = pair else { return None };
        let nominal = to.seconds;
        if nominal <= 0.0 {
            return None;
        }
        let (a, b) = (from.at.all(), to.at.all());
        let speeds: [f64; 5] = std::array::from_fn(|k| (b[k] - a[k]) / nominal);
        let least = |least: f64, (axis, speed): (&Axis, &f64)| least.min(axis.acceleration / speed.abs());
        let acceleration = axes.iter().zip(&speeds).fold(f64::INFINITY, least);
        Some(Self { nominal, speeds, acceleration })
    }

    /// The time from a share of the full speed to another, speeding up to the full speed between if there is room.
    fn seconds(&self, from: f64, to: f64) -> f64 {
        let a = self.acceleration;
        if a.is_infinite() {
            return self.nominal;
        }
        // Up to the peak and down again takes (2 peak² − from² − to²) / 2a of the way.
        let peak = (0.5 * (2.0 * a * self.nominal + from * from + to * to)).sqrt().clamp(from.max(to), 1.0);
        let ramps = (2.0 * peak * peak - from * from - to * to) / (2.0 * a);
        (2.0 * peak - from - to) / a + (self.nominal - ramps).max(0.0) / peak
    }
}

/// The share of the full speed at both ends of every block.
fn corners(axes: &[Axis], blocks: &[Block], smoothing: f64) -> Vec<f64> {
    let mut shares = vec![0.0; blocks.len() + 1];
    for (k, pair) in blocks.windows(2).enumerate() {
        shares[k + 1] = turning(axes, &pair[0], &pair[1], smoothing);
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

/// The greatest share of the full speed, up to 1, at which the axes can turn from one block into the next.
///
/// An axis whose speed jumps by Δv is accelerated by Δv over the moving average; where blocks are shorter than that, several jumps fall into
/// it, and the acceleration is that of a curve, Δv over the mean of both blocks' times. At the share s the jump is s Δv and the times are 1/s as
/// long.
fn turning(axes: &[Axis], before: &Block, after: &Block, smoothing: f64) -> f64 {
    let time = 0.5 * (before.nominal + after.nominal);
    let mut share = 1.0f64;
    for (k, axis) in axes.iter().enumerate() {
        let jump = (after.speeds[k] - before.speeds[k]).abs();
        if jump > 0.0 {
            let alone = axis.acceleration * smoothing / jump;
            let curve = (axis.acceleration * time / jump).sqrt();
            share = share.min(alone).min(curve);
        }
    }
    share
}
