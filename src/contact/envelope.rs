//! The surface that a moving corner torus leaves behind.

use super::place::{Tilt, center_over};
use crate::cutter::Cutter;
use crate::math::frame::Frame;
use crate::toolpath::{CcPoint, Posture};
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

/// The tilt of `posture`, held [`LEAST_ANGLE`] apart from where the envelope degenerates.
pub(super) fn distinct_tilt(mut posture: Posture) -> Tilt {
    if posture.lead.abs() < LEAST_ANGLE {
        posture.lead = LEAST_ANGLE;
    }
    if libm::cos(posture.yaw).abs() < LEAST_ANGLE {
        posture.yaw -= LEAST_ANGLE * posture.yaw.signum();
    }
    Tilt::new(posture)
}

impl Sweep {
    /// The motion that carries `cc` at `velocity` (any speed) while turning by the angular velocity `spin` about it.
    pub fn new(cutter: &Cutter, cc: &CcPoint, velocity: DVec3, spin: DVec3) -> Self {
        Self::of_tilt(cutter, &distinct_tilt(cc.posture), cc.point, &cc.frame, velocity, spin)
    }

    /// [`Sweep::new`] with the posture made ready by [`distinct_tilt`], for many motions with one posture.
    pub(super) fn of_tilt(
        cutter: &Cutter,
        tilt: &Tilt,
        pivot: DVec3,
        frame: &Frame,
        velocity: DVec3,
        spin: DVec3,
    ) -> Self {
        let e1 = tilt.outward(frame);
        let e2 = tilt.axis(frame).cross(e1);
        // At the contact V × T is cos ω · n for positive lead.
        let sign = if velocity.cross(e2).dot(frame.n) >= 0.0 { 1.0 } else { -1.0 };
        Self {
            center: center_over(cutter, pivot, frame, e1),
            e1,
            e2,
            center_radius: cutter.center_radius,
            corner_radius: cutter.corner_radius,
            pivot,
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

    /// How the envelope leaves the contact as θ grows in the direction `toward` (±1), mm per radian.
    pub(super) fn departure(&self, toward: f64) -> DVec3 {
        // Small enough for the way to be straight, large enough not to drown in rounding.
        let little = 1e-5;
        (self.point(toward * little) - self.pivot) / little
    }

    /// The direction of θ (±1) that leads towards the left (`+b`) of the pass.
    pub fn left(&self, b: DVec3) -> f64 {
        if self.e2.dot(b) >= 0.0 { 1.0 } else { -1.0 }
    }
}
