//! The turns of a rotary axis: all the numbers that stand for one angle.

use super::Axis;
use super::axis::within;
use super::ends::wrapped;
use std::f64::consts::{PI, TAU};

/// Turns of an axis that its limits allow.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turns {
    least: i32,
    pub(super) count: usize,
    pub(super) limits: Option<[f64; 2]>,
    pub(super) speed: f64,
}

impl Turns {
    /// An axis without limits has one entry, which stands for all of its turns.
    pub(super) fn of(axis: Option<&Axis>) -> Self {
        let none = Self { least: 0, count: 1, limits: None, speed: 1.0 };
        let Some(&Axis { limits, speed, .. }) = axis else { return none };
        let Some([low, high]) = limits else { return Self { speed, ..none } };
        let least = ((low - PI) / TAU).ceil() as i32;
        let most = ((high + PI) / TAU).floor() as i32;
        Self { least, count: (most - least + 1).max(1) as usize, limits, speed }
    }

    pub(super) fn angle(&self, base: f64, turn: usize) -> f64 {
        base + TAU * f64::from(self.least + turn as i32)
    }

    /// The turn that brings `base` nearest to `angle`, if the limits allow it.
    pub(super) fn nearest(&self, base: f64, angle: f64) -> Option<usize> {
        if self.limits.is_none() {
            return Some(0);
        }
        let turn = ((angle - base) / TAU).round() as i32 - self.least;
        let turn = usize::try_from(turn).ok().filter(|turn| *turn < self.count)?;
        let to = self.angle(base, turn);
        within(self.limits, to).then_some(turn)
    }

    /// How far it is from one angle to another, radians: an axis without end takes the shorter way.
    pub(super) fn travel(&self, from: f64, to: f64) -> f64 {
        if self.limits.is_some() { to - from } else { wrapped(to - from) }
    }
}
