//! The exact strip of a straight feed over a circular section: a plane, or a cylinder along its axis.

use super::envelope::Sweep;
use crate::cutter::Cutter;
use crate::geometry::Curvature;
use crate::math::frame::Frame;
use crate::math::root::bracketed;
use crate::toolpath::{CcPoint, Posture};
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// A tilt of the axis along or across the feed, radians, 0 to below π/2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Lean {
    /// Along the feed.
    Lead(f64),
    /// Across it, to the left.
    Lateral(f64),
}

impl Lean {
    /// The posture of the lean.
    pub fn posture(self) -> Posture {
        match self {
            Self::Lead(lead) => Posture { lead, yaw: 0.0 },
            Self::Lateral(lead) => Posture { lead, yaw: FRAC_PI_2 },
        }
    }
}

/// The strip of a straight feed, over a surface that is bent across the feed alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StraightStrip {
    /// From the contact's line to the left edge along the surface, mm.
    pub left: f64,
    /// The same to the right.
    pub right: f64,
    /// The chord between the edges, mm: the stepover between passes alike.
    pub stepover: f64,
    /// How far the cutter stands off the contact's line, mm: 0 but for [`super::two_contact`].
    pub lift: f64,
}

impl StraightStrip {
    fn new(left: f64, right: f64, curvature: f64, lift: f64) -> Self {
        let arc = left + right;
        let stepover =
            if curvature == 0.0 { arc } else { 2.0 * libm::sin(0.5 * arc * curvature) / curvature };
        Self { left, right, stepover, lift }
    }
}

/// The exact strip within `scallop` (mm, above 0) over a section of constant `curvature` (1/mm, above 0 where concave)
/// across a straight feed.
///
/// By lead the edges are those of the corner's envelope; by lateral tilt those of bottom, corners and side, which here
/// are their own envelope. `None` where the cutter gouges beside its contact (on a concave section the lead is below
/// [`super::matching_lead`], or the tilted bottom is longer than the hollow is wide; a conical bottom leans less than it
/// rises), where no edge is found below the widest place of the cutter, and for a lateral tilt of a cutter that is not a
/// bull-nose, ball or flat mill.
pub fn straight_strip(cutter: &Cutter, lean: Lean, curvature: f64, scallop: f64) -> Option<StraightStrip> {
    let section = Section { curvature, scallop };
    match lean {
        Lean::Lead(lead) => {
            let gouges = lead < super::matching_lead(cutter, &Curvature::across(curvature), 0.0)?
                || lead < cutter.bottom_angle;
            if gouges {
                return None;
            }
            section.by_lead(cutter, lead, 0.0, 0.0)
        }
        Lean::Lateral(tilt) => section.by_lateral_tilt(cutter, tilt),
    }
}

/// A circular section and the height over it at which a strip ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct Section {
    pub(super) curvature: f64,
    pub(super) scallop: f64,
}

/// A place of a profile: to the side, and up.
type Place = (f64, f64);

impl Section {
    /// Height of a place above the circle, `(1 − k d)/k` with `d` its distance to the centre, in a form that is good for
    /// planes too.
    fn height(&self, (y, z): Place) -> f64 {
        let k = self.curvature;
        let way = libm::hypot(1.0 - k * z, k * y);
        (2.0 * z - k * (y * y + z * z)) / (1.0 + way)
    }

    /// How far along the circle the foot of a place lies.
    fn along(&self, (y, z): Place) -> f64 {
        let k = self.curvature;
        if k == 0.0 { y } else { libm::atan2(k.abs() * y, 1.0 - k * z) / k.abs() }
    }

    /// Where `profile` reaches the limit between two arguments, along the circle; `None` where it does not reach it.
    fn edge(&self, from: f64, to: f64, profile: impl Fn(f64) -> Place) -> Option<f64> {
        let over = |s: f64| self.height(profile(s)) - self.scallop;
        let (low, high) = ((from, over(from)), (to, over(to)));
        // Fine enough for the corner of a bottom that lies flat, which passes within a millionth of a radian.
        let root = (low.1 <= 0.0 && high.1 >= 0.0).then(|| bracketed(over, low, high, 1e-15, 120))?;
        Some(self.along(profile(root.x)))
    }

    /// The strip by `lead`, lifted, whose edges lie beyond ± `from` (radians on the centre circle), where it is lower.
    pub(super) fn by_lead(&self, cutter: &Cutter, lead: f64, lift: f64, from: f64) -> Option<StraightStrip> {
        let frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
        let cc = CcPoint { point: DVec3::Z * lift, frame, posture: Lean::Lead(lead).posture() };
        let sweep = Sweep::new(cutter, &cc, DVec3::X, DVec3::ZERO);
        let left = sweep.left(DVec3::Y);
        let half = self.edge(from, FRAC_PI_2, |theta| {
            let p = sweep.point(left * theta);
            (p.y, p.z)
        })?;
        Some(StraightStrip::new(half, half, self.curvature, lift))
    }

    fn by_lateral_tilt(&self, cutter: &Cutter, tilt: f64) -> Option<StraightStrip> {
        if cutter.bottom_angle != 0.0 || cutter.taper != 0.0 {
            return None;
        }
        let (bottom, r) = (2.0 * cutter.center_radius, cutter.corner_radius);
        let (s, c) = libm::sincos(tilt);
        let far = (bottom * c, r + bottom * s);
        // Rounding at a contact is no gouge.
        if self.height((0.0, r)) < 0.999 * r || self.height(far) < r - 1e-9 * (r + bottom) {
            return None;
        }
        let corner = |angle: f64| (r * libm::sin(angle), r * (1.0 - libm::cos(angle)));
        let side = |w: f64| (r * c + w * s, r * (1.0 - s) + w * c);
        // In a hollow a straight line is highest where it passes the centre: the first edge lies before.
        let room = 1.0 / self.curvature - r;
        let before =
            |length: f64, middle: f64| if self.curvature > 0.0 { length.min(middle) } else { length };
        let left = self
            .edge(0.0, FRAC_PI_2 - tilt, corner)
            .or_else(|| self.edge(0.0, before(cutter.height - r, room * c), side))?;
        let ground = |w: f64| (r * s + w * c, r * (1.0 - c) + w * s);
        let far_corner = |angle: f64| {
            let (y, z) = corner(angle);
            (bottom * c + y, bottom * s + z)
        };
        let right = self
            .edge(0.0, tilt, corner)
            .or_else(|| self.edge(0.0, before(bottom, room * s), ground))
            .or_else(|| self.edge(tilt, FRAC_PI_2, far_corner))?;
        Some(StraightStrip::new(left, right, self.curvature, 0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::model_strip;
    use crate::geometry::Curvature;

    #[test]
    fn agrees_with_the_strip_over_the_quadratic_model() {
        let h = 0.01;
        for (r1, r, tilt, k) in
            [(3.0, 2.0, 0.3_f64, 0.0), (3.0, 2.0, 0.3, 0.02), (9.5, 3.0, 0.15, -0.01), (9.5, 3.0, 0.4, 0.01)]
        {
            let cutter = Cutter::bull_nose(2.0 * (r1 + r), r, 100.0).unwrap();
            let surface = Curvature { ff: 0.0, fb: 0.0, bb: k };
            for lean in [Lean::Lead(tilt), Lean::Lateral(tilt)] {
                let found = straight_strip(&cutter, lean, k, h).unwrap();
                let (left, right) = model_strip(&cutter, lean.posture(), &surface, h).half_widths().unwrap();
                assert!((found.left / left - 1.0).abs() < 1e-3, "{lean:?} {k}: {found:?} {left}");
                assert!((found.right / right - 1.0).abs() < 1e-3, "{lean:?} {k}: {found:?} {right}");
            }
        }
    }
}
