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
    /// The point on the surface, millimetres; above it by as much as the cutter is lifted to lie on both sides of a hollow.
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

/// What keeps the lead at a contact from being less: less lead is a wider strip.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Bound {
    /// The posture was given and not chosen.
    #[default]
    Given,
    /// The least lead that was allowed.
    Least,
    /// With less the cutter would bend less than the surface and dig in at its contact.
    Curvature,
    /// With less the cutter would dig in beside its contact.
    Beside,
    /// With less the rear of the bottom, the side or the shank would dig in.
    Body,
    /// With less the holder would come into the part.
    Holder,
    /// Neighbours need so much, and the axis may turn no faster.
    Turn,
    /// No lead within the limits fits.
    Misfit,
    /// With less, strips would overlap more than they need to meet.
    Met,
}

/// What a contact gets done, and why the cutter leans as it does there. For people to see: planning takes no more from it than
/// how far about a contact to look.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Work {
    /// Width of the strip that the cutter finishes to the scallop height planned for, square to the feed, mm; at a border twice its half
    /// on the other side. `None` where borders end both halves, beyond the surface, and on meshes.
    pub strip: Option<f64>,
    /// What keeps the lead from being less.
    pub bound: Bound,
}

/// A contact point together with the location that touches it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// Where the cutter touches.
    pub cc: CcPoint,
    /// Where that puts the cutter.
    pub cl: ClPoint,
    /// What it does there.
    pub work: Work,
}

/// Where a move of a motion ends on the part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// Where the cutter touches, or its tip where it touches nothing, mm.
    pub point: DVec3,
    /// How it leans in its contact frame and what it does there; nothing where it touches nothing.
    pub contact: Option<(Posture, Work)>,
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
