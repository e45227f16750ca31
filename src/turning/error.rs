//! Why a part cannot be turned as asked.

use crate::monitor::Cancelled;
use std::fmt;

/// A place on the workpiece, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spot {
    /// From the spindle axis, mm.
    pub x: f64,
    /// From the spindle axis, mm.
    pub y: f64,
}

impl fmt::Display for Spot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let angle = libm::atan2(self.y, self.x).to_degrees();
        write!(
            f,
            "x {:.3}, y {:.3} mm (radius {:.3} mm at {angle:.2}°)",
            self.x,
            self.y,
            libm::hypot(self.x, self.y)
        )
    }
}

/// Why a part cannot be turned as asked. Where a value would do, it is named.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TurningError {
    /// The aperture is larger than the surface.
    #[error("the aperture goes beyond the surface at {at}: {reach}; {percent:.1} % of its size would do")]
    Reach {
        /// Where.
        at: Spot,
        /// How far the surface reaches.
        reach: String,
        /// How much of the aperture's size, from its centre, would do, %: 0 if not even its centre is on the surface.
        percent: f64,
    },
    /// The tool does not fit into a hollow.
    #[error(
        "the nose of radius {radius} mm does not fit the hollow of radius {hollow:.4} mm at {at}: at most {most} mm would do"
    )]
    Hollow {
        /// The tool's radius, mm.
        radius: f64,
        /// The smallest radius of the surface that the nose meets, mm.
        hollow: f64,
        /// A radius that would do, mm.
        most: f64,
        /// Where.
        at: Spot,
    },
    /// The section through the axis is steeper than the edge reaches.
    #[error(
        "the section is {slope:.2}° steep at {at}, but the edge reaches to {sweep:.2}°: at least {least:.1}° would do"
    )]
    Sweep {
        /// Steepness, degrees.
        slope: f64,
        /// What the edge reaches, degrees.
        sweep: f64,
        /// What would do, degrees.
        least: f64,
        /// Where.
        at: Spot,
    },
    /// The flank would rub.
    #[error(
        "the surface falls by {slope:.2}° along the cut at {at}, but the flank clears {clearance:.2}°: at least {least:.1}° would do"
    )]
    Clearance {
        /// Slope along the cut, degrees.
        slope: f64,
        /// Clearance, degrees.
        clearance: f64,
        /// What would do, degrees.
        least: f64,
        /// Where.
        at: Spot,
    },
    /// The face of the tool would lean too far back against the cut.
    #[error(
        "the surface rises by {slope:.2}° along the cut at {at}, which leaves a rake of {rake:.2}° where at least {limit:.2}° are asked for: a tool with {least:.1}° would do"
    )]
    Rake {
        /// Slope along the cut, degrees.
        slope: f64,
        /// What is left of the rake, degrees.
        rake: f64,
        /// What is asked for, degrees.
        limit: f64,
        /// The tool's rake that would do, degrees.
        least: f64,
        /// Where.
        at: Spot,
    },
    /// The nose touches nowhere at a place of the path.
    #[error(
        "the nose finds no single place to touch at X {x:.3} mm, C {degrees:.3}°: the surface beyond the aperture bends more than the nose; at most {most} mm would do there"
    )]
    NoTouch {
        /// Distance from the axis, mm.
        x: f64,
        /// Angle, degrees.
        degrees: f64,
        /// The radius of a nose that does, mm.
        most: f64,
    },
    /// Points lie too far apart.
    #[error(
        "the motion between points is {error:.6} mm off at X {x:.3} mm, C {degrees:.3}° (limit {limit} mm): {least}"
    )]
    Chord {
        /// Error of the height, mm.
        error: f64,
        /// What is allowed, mm.
        limit: f64,
        /// Distance from the axis, mm.
        x: f64,
        /// Angle, degrees.
        degrees: f64,
        /// What would do, in words.
        least: String,
    },
    /// An axis cannot follow.
    #[error(
        "{what} of {axis} reaches {value:.4} {unit} at X {x:.3} mm, C {degrees:.3}° (limit {limit} {unit}): at most {rpm:.3} rpm would do"
    )]
    Limit {
        /// `velocity`, `acceleration` or `jerk`.
        what: &'static str,
        /// `X`, `Z` or `C`.
        axis: &'static str,
        /// The unit of value and limit.
        unit: &'static str,
        /// What is reached.
        value: f64,
        /// What is allowed.
        limit: f64,
        /// Distance from the axis, mm.
        x: f64,
        /// Angle, degrees.
        degrees: f64,
        /// The highest speed at which it is kept.
        rpm: f64,
    },
    /// No speed is slow enough.
    #[error(
        "the limits allow at most {rpm:.4} rpm, below the least of {least} rpm: {what} of {axis} at X {x:.3} mm, C {degrees:.3}° would have to reach {needed:.4} {unit}"
    )]
    TooSlow {
        /// What the limits allow.
        rpm: f64,
        /// What the machine needs at least.
        least: f64,
        /// `velocity`, `acceleration` or `jerk`.
        what: &'static str,
        /// `X`, `Z` or `C`.
        axis: &'static str,
        /// Its unit.
        unit: &'static str,
        /// The limit that would do.
        needed: f64,
        /// Distance from the axis, mm.
        x: f64,
        /// Angle, degrees.
        degrees: f64,
    },
    /// More points than a program can hold.
    #[error("the path would have {count:.3e} points; at most {limit} are planned: {hint}")]
    TooMany {
        /// About how many.
        count: f64,
        /// How many would do.
        limit: usize,
        /// What to change.
        hint: &'static str,
    },
    /// Told to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
