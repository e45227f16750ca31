//! What the axes can do.

use super::dynamics::{Dynamics, Peak};

/// The largest velocity, acceleration and jerk of X, Z and C; X and Z in mm, C in radians, and seconds. Infinite where there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// In the order of [`Dynamics::peaks`].
    pub most: [[f64; 3]; 3],
}

/// The limit that is reached first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strictest {
    /// How many times as fast the path may go: below 1 where it is too fast.
    pub share: f64,
    /// Which axis: 0 X, 1 Z, 2 C.
    pub axis: usize,
    /// What of it: 0 velocity, 1 acceleration, 2 jerk.
    pub kind: usize,
    /// Where it is reached.
    pub peak: Peak,
    /// The limit.
    pub limit: f64,
}

/// The limit that a path reaches first when it goes ever faster; `None` where none ever is.
///
/// Velocity grows with the speed, acceleration with its square, jerk with its cube, whether the spindle's speed is even or follows the
/// surface.
pub fn strictest(dynamics: &Dynamics, limits: &Limits) -> Option<Strictest> {
    let mut found: Option<Strictest> = None;
    for axis in 0..3 {
        for kind in 0..3 {
            let limit = limits.most[axis][kind];
            let [way, ramp] = [&dynamics.peaks, &dynamics.ramps].map(|peaks| peaks[axis][kind]);
            let peak = if ramp.value > way.value { ramp } else { way };
            let ratio = limit / peak.value;
            let share = match kind {
                0 => ratio,
                1 => ratio.sqrt(),
                _ => ratio.cbrt(),
            };
            if share.is_finite() && found.is_none_or(|f| share < f.share) {
                found = Some(Strictest { share, axis, kind, peak, limit });
            }
        }
    }
    found
}

impl Strictest {
    /// `X`, `Z` or `C`.
    pub fn axis_name(&self) -> &'static str {
        ["X", "Z", "C"][self.axis]
    }

    /// What of it.
    pub fn kind_name(&self) -> &'static str {
        ["velocity", "acceleration", "jerk"][self.kind]
    }

    /// The unit in which a person reads it, and what values are multiplied by to be in it.
    pub fn unit(&self) -> (&'static str, f64) {
        match (self.axis, self.kind) {
            (2, 0) => ("°/s", 1.0_f64.to_degrees()),
            (2, 1) => ("°/s²", 1.0_f64.to_degrees()),
            (2, _) => ("°/s³", 1.0_f64.to_degrees()),
            (_, 0) => ("mm/s", 1.0),
            (_, 1) => ("mm/s²", 1.0),
            _ => ("mm/s³", 1.0),
        }
    }
}
