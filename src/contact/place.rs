//! From contact point to cutter location and back.

use crate::cutter::Cutter;
use crate::math::frame::Frame;
use crate::toolpath::{CcPoint, ClPoint, Posture};
use glam::DVec3;

/// Sines and cosines of a posture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tilt {
    lead: (f64, f64),
    yaw: (f64, f64),
}

impl Tilt {
    pub(super) fn new(posture: Posture) -> Self {
        Self { lead: libm::sincos(posture.lead), yaw: libm::sincos(posture.yaw) }
    }

    /// Unit tangent direction `t` that the axis leans to.
    fn lean(&self, frame: &Frame) -> DVec3 {
        let (so, co) = self.yaw;
        frame.f * co + frame.b * so
    }

    /// Unit axis.
    pub(super) fn axis(&self, frame: &Frame) -> DVec3 {
        let (sl, cl) = self.lead;
        frame.n * cl + self.lean(frame) * sl
    }

    /// Unit vector `u` from the disc's centre to the point of the centre circle above the contact.
    pub(super) fn outward(&self, frame: &Frame) -> DVec3 {
        let (sl, cl) = self.lead;
        self.lean(frame) * cl - frame.n * sl
    }
}

/// Unit axis of `posture` in `frame`: `cos λ · n + sin λ · (cos ω · f + sin ω · b)`.
pub fn axis(frame: &Frame, posture: Posture) -> DVec3 {
    Tilt::new(posture).axis(frame)
}

/// Centre of the corner's centre circle, `p + r n − R1 u`, for a cutter whose corner touches `cc`.
///
/// With `λ = 0` the bottom lies flat on the tangent plane; the contact is then taken on the rim towards yaw.
pub fn center(cutter: &Cutter, cc: &CcPoint) -> DVec3 {
    center_over(cutter, cc.point, &cc.frame, Tilt::new(cc.posture).outward(&cc.frame))
}

/// [`center`], with `outward` computed already.
pub(super) fn center_over(cutter: &Cutter, point: DVec3, frame: &Frame, outward: DVec3) -> DVec3 {
    point + frame.n * cutter.corner_radius - outward * cutter.center_radius
}

/// The cutter location that touches `cc` with the corner.
pub fn cl_of(cutter: &Cutter, cc: &CcPoint) -> ClPoint {
    let tilt = Tilt::new(cc.posture);
    let axis = tilt.axis(&cc.frame);
    let center = center_over(cutter, cc.point, &cc.frame, tilt.outward(&cc.frame));
    ClPoint { tip: center - axis * cutter.center_height, axis }
}

/// The point of the corner that touches a surface whose outward unit normal there is `n`; `None` where the axis is
/// parallel to `n` and the whole bottom touches.
pub fn contact_of(cutter: &Cutter, cl: &ClPoint, n: DVec3) -> Option<DVec3> {
    let center = cl.tip + cl.axis * cutter.center_height;
    if cutter.center_radius == 0.0 {
        return Some(center - n * cutter.corner_radius);
    }
    let u = (cl.axis * n.dot(cl.axis) - n).try_normalize()?;
    Some(center + u * cutter.center_radius - n * cutter.corner_radius)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contact_point_survives_the_way_to_the_location_and_back() {
        let n = DVec3::new(0.2, -0.5, 0.9).normalize();
        let frame = Frame::from_normal(n, DVec3::new(1.0, 0.3, 0.0)).unwrap();
        for cutter in [
            Cutter::bull_nose(10.0, 2.0, 30.0).unwrap(),
            Cutter::ball(6.0, 30.0).unwrap(),
            Cutter::conical(12.0, 1.0, 0.2, 30.0).unwrap(),
        ] {
            for (lead, yaw) in [(0.1, 0.0), (0.4, 2.0), (0.02, -1.0)] {
                let cc = CcPoint { point: DVec3::new(3.0, 4.0, 5.0), frame, posture: Posture { lead, yaw } };
                let cl = cl_of(&cutter, &cc);
                assert!((cl.axis.length() - 1.0).abs() < 1e-14);
                assert!((cl.axis.dot(n) - libm::cos(lead)).abs() < 1e-14);
                let back = contact_of(&cutter, &cl, n).unwrap();
                assert!(back.distance(cc.point) < 1e-12, "{back} {}", cc.point);
            }
        }
    }
}
