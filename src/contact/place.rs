//! From contact point to cutter location and back.

use crate::cutter::Cutter;
use crate::math::frame::Frame;
use crate::toolpath::{CcPoint, ClPoint, Posture};
use glam::DVec3;

/// Unit axis of `posture` in `frame`: `cos λ · n + sin λ · (cos ω · f + sin ω · b)`.
pub fn axis(frame: &Frame, posture: Posture) -> DVec3 {
    let (sl, cl) = libm::sincos(posture.lead);
    frame.n * cl + lean(frame, posture) * sl
}

/// Unit tangent direction `t` that the axis leans to.
fn lean(frame: &Frame, posture: Posture) -> DVec3 {
    let (so, co) = libm::sincos(posture.yaw);
    frame.f * co + frame.b * so
}

/// Unit vector `u` from the disc's centre to the point of the centre circle above the contact.
pub(super) fn outward(frame: &Frame, posture: Posture) -> DVec3 {
    let (sl, cl) = libm::sincos(posture.lead);
    lean(frame, posture) * cl - frame.n * sl
}

/// Centre of the corner's centre circle, `p + r n − R1 u`, for a cutter whose corner touches `cc`.
///
/// With `λ = 0` the bottom lies flat on the tangent plane; the contact is then taken on the rim towards yaw.
pub fn center(cutter: &Cutter, cc: &CcPoint) -> DVec3 {
    cc.point + cc.frame.n * cutter.corner_radius - outward(&cc.frame, cc.posture) * cutter.center_radius
}

/// The cutter location that touches `cc` with the corner.
pub fn cl_of(cutter: &Cutter, cc: &CcPoint) -> ClPoint {
    let axis = axis(&cc.frame, cc.posture);
    ClPoint { tip: center(cutter, cc) - axis * cutter.center_height, axis }
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
