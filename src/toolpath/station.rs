//! Where the cutter touches, how it leans, and where that puts it.

use crate::math::frame::Frame;
use glam::DVec3;

/// How the axis leans in the contact frame: `a = cos λ · n + sin λ · (cos ω · f + sin ω · b)`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Posture {
    /// Lead λ, radians: the angle between axis and normal. Positive leans along the direction that yaw names.
    pub lead: f64,
    /// Yaw ω, radians: the direction of the lean, counted from feed towards the left of the pass.
    pub yaw: f64,
}

/// A cutter-contact point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CcPoint {
    /// The point on the surface, millimetres.
    pub point: DVec3,
    /// Feed, left of the pass, and outward normal.
    pub frame: Frame,
    /// How the axis leans in that frame.
    pub posture: Posture,
}

/// A cutter location: where the tip is and where the spindle stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClPoint {
    /// The cutter's tip, on its axis, millimetres.
    pub tip: DVec3,
    /// Unit vector from the tip to the spindle.
    pub axis: DVec3,
}

/// A contact point together with the location that touches it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// Where the cutter touches.
    pub cc: CcPoint,
    /// Where that puts the cutter.
    pub cl: ClPoint,
}

/// An unbroken run of the cutter over the surface, in feed direction.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Pass {
    /// At least two stations.
    pub stations: Vec<Station>,
}

impl Pass {
    /// Length along the contact points, millimetres.
    pub fn length(&self) -> f64 {
        self.stations.windows(2).map(|w| w[0].cc.point.distance(w[1].cc.point)).sum()
    }
}
