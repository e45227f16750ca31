//! The motion of a lathe whose C axis is a servo: where X, Z and C stand, and when.
//!
//! Workpiece frame: z is the spindle axis, pointing out of the material towards the tool. A tool point at X, Z and C is at
//! `(X cos C, X sin C, Z)` on the workpiece: C is the angle at which the tool stands over the part.

/// Where the axes stand at one instant.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct AxisPoint {
    /// Distance of the nose centre from the spindle axis, mm.
    pub x: f64,
    /// Height of the nose centre, mm.
    pub z: f64,
    /// Angle of the tool over the part, radians, running on beyond a turn.
    pub c: f64,
    /// Seconds from the start of the path.
    pub time: f64,
    /// Velocities of X and Z, mm/s, and of C, rad/s.
    pub rates: [f64; 3],
}

/// What the control makes of two neighbouring points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Interpolation {
    /// X, Z and C each run linearly in time from one point to the next.
    #[default]
    Linear,
    /// X, Z and C are each the cubic in time with the positions and velocities of both points.
    Pvt,
}

/// The finishing motion of a lathe on X, Z and C, without approach and retreat.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TurningPath {
    /// The points in order; time rises.
    pub points: Vec<AxisPoint>,
    /// How the control goes between them.
    pub interpolation: Interpolation,
}

/// The part of a tool that turns or mills the surface: the sphere or the circle whose centre an [`AxisPoint`] states.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Nose {
    /// A ball-nose mill: a sphere of this radius, mm.
    Ball(f64),
    /// A round-nose insert: a circle of this radius, mm, in the X-Z plane.
    Insert(f64),
}

impl Nose {
    /// The same kind with another radius, mm.
    #[must_use]
    pub fn with_radius(self, radius: f64) -> Self {
        match self {
            Self::Ball(_) => Self::Ball(radius),
            Self::Insert(_) => Self::Insert(radius),
        }
    }

    /// The radius, mm.
    pub fn radius(self) -> f64 {
        match self {
            Self::Ball(radius) | Self::Insert(radius) => radius,
        }
    }
}
