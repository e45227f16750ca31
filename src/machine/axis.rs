//! One axis of a machine: what it does, how far, how fast.

use glam::DVec3;

/// How an axis moves what it carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Joint {
    /// Along a direction.
    Linear {
        /// Where the carried side goes as the axis' number rises; unit.
        direction: DVec3,
    },
    /// About a line.
    Rotary {
        /// About which the carried side turns by the right hand as the axis' number rises; unit.
        direction: DVec3,
        /// A point of the line while every axis stands at 0, machine frame, mm.
        point: DVec3,
    },
}

/// Which side of the machine an axis moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Carries {
    /// The table's.
    Workpiece,
    /// The spindle's.
    Tool,
}

/// An axis. Linear ones are stated in mm, rotary ones in radians; rates per second, per second² and per second³.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    /// Its letter in programs, upper case.
    pub letter: char,
    /// How it moves.
    pub joint: Joint,
    /// What it moves.
    pub carries: Carries,
    /// Least and greatest position; `None` for one that goes on without end.
    pub limits: Option<[f64; 2]>,
    /// Greatest speed, above 0.
    pub speed: f64,
    /// Greatest acceleration, above 0.
    pub acceleration: f64,
    /// Greatest jerk, above 0.
    pub jerk: f64,
}

impl Axis {
    /// Whether it turns.
    pub fn is_rotary(&self) -> bool {
        matches!(self.joint, Joint::Rotary { .. })
    }

    /// A position, a speed or a limit of it as a person reads it: in mm or degrees, a second.
    pub fn shown(&self, x: f64) -> f64 {
        if self.is_rotary() { x.to_degrees() } else { x }
    }

    /// The unit of [`Axis::shown`], as it stands behind a number.
    pub fn unit(&self) -> &'static str {
        if self.is_rotary() { "°" } else { " mm" }
    }

    /// Whether `position` is within the limits.
    pub(super) fn holds(&self, position: f64) -> bool {
        within(self.limits, position)
    }
}

/// Whether a position is within limits, give or take a rounding error.
pub(super) fn within(limits: Option<[f64; 2]>, position: f64) -> bool {
    // Far below the last digit of any program, far above the rounding of positions.
    const SLACK: f64 = 1e-9;
    limits.is_none_or(|[low, high]| position >= low - SLACK && position <= high + SLACK)
}
