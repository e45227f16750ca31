//! The surface that a moving corner torus leaves behind.

use super::place::{axis, center, outward};
use crate::cutter::Cutter;
use crate::toolpath::CcPoint;
use glam::DVec3;

/// A corner torus in motion, at one instant.
///
/// The centre circle is `C(θ) = c + R1 (cos θ u + sin θ (a × u))`, with the contact at θ = 0. With `T` its tangent
/// and `V` its velocity the envelope is `C ± r (T × V)/|T × V|`; the sign is the one that passes through the contact.
///
/// Source: the method of Liu and Liu 2013, eq. (8), with the true velocity of every point of the circle.
#[derive(Debug, Clone, Copy)]
pub struct Sweep {
    center: DVec3,
    e1: DVec3,
    e2: DVec3,
    center_radius: f64,
    corner_radius: f64,
    pivot: DVec3,
    velocity: DVec3,
    spin: DVec3,
    sign: f64,
}

/// The least angle, radians, that axis and normal, or lean and the square to feed, are held apart. At exactly zero a
/// whole arc of the envelope is born at one θ; so near to it the result differs by less than 1e-6 of a radius.
const LEAST_ANGLE: f64 = 1e-6;

impl Sweep {
    /// The motion that carries `cc` at `velocity` (any speed) while turning by the angular velocity `spin` about it.
    pub fn new(cutter: &Cutter, cc: &CcPoint, velocity: DVec3, spin: DVec3) -> Self {
        let mut cc = *cc;
        if cc.posture.lead.abs() < LEAST_ANGLE {
            cc.posture.lead = LEAST_ANGLE;
        }
        if libm::cos(cc.posture.yaw).abs() < LEAST_ANGLE {
            cc.posture.yaw -= LEAST_ANGLE * cc.posture.yaw.signum();
        }
        let e1 = outward(&cc.frame, cc.posture);
        let e2 = axis(&cc.frame, cc.posture).cross(e1);
        // At the contact V × T is cos ω · n for positive lead.
        let sign = if velocity.cross(e2).dot(cc.frame.n) >= 0.0 { 1.0 } else { -1.0 };
        Self {
            center: center(cutter, &cc),
            e1,
            e2,
            center_radius: cutter.center_radius,
            corner_radius: cutter.corner_radius,
            pivot: cc.point,
            velocity,
            spin,
            sign,
        }
    }

    /// The envelope's point at θ; at a θ where `T` and `V` are parallel, the centre circle's own point.
    pub fn point(&self, theta: f64) -> DVec3 {
        let (s, c) = libm::sincos(theta);
        let on_circle = self.center + (self.e1 * c + self.e2 * s) * self.center_radius;
        let tangent = self.e2 * c - self.e1 * s;
        let velocity = self.velocity + self.spin.cross(on_circle - self.pivot);
        let across = velocity.cross(tangent);
        let length = across.length();
        if length == 0.0 {
            return on_circle;
        }
        on_circle - across * (self.sign * self.corner_radius / length)
    }

    /// The direction of θ (±1) that leads towards the left (`+b`) of the pass.
    pub fn left(&self, b: DVec3) -> f64 {
        if self.e2.dot(b) >= 0.0 { 1.0 } else { -1.0 }
    }
}
