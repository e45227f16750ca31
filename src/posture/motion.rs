//! The strip of a cutter whose posture changes as it goes.

use super::Turning;
use crate::contact::{FaceStrip, StripLimits, face_strip};
use crate::cutter::Cutter;
use crate::geometry::{Face, Uv};
use crate::math::frame::Frame;
use crate::toolpath::{CcPoint, Posture};
use glam::DVec3;

/// The exact strip about the contact `cc` at `uv` on `face`, while the contact moves along its feed at unit speed, its
/// frame turns by `spin` (radians per mm, in world axes), and its posture in that frame changes by `turning`.
///
/// What [`face_strip`] says of accuracy and poles holds here. A posture that changes turns the cutter not about its
/// contact but about the centre of the corner's circle above it, on which the contact then wanders: seen from the contact
/// the cutter slides under it by `r λ′` against the lean. Sideways edges are told apart by the direction of that motion.
pub fn moving_strip(
    face: &Face,
    cutter: &Cutter,
    cc: &CcPoint,
    uv: Uv,
    (spin, turning): (DVec3, Option<Turning>),
    limits: StripLimits,
) -> Option<FaceStrip> {
    let Some(turning) = turning else { return face_strip(face, cutter, cc, uv, spin, limits) };
    let Frame { f, b, n } = cc.frame;
    let (s, c) = libm::sincos(cc.posture.yaw);
    let (lean, beside) = (f * c + b * s, b * c - f * s);
    let spin = spin + n * turning.yaw + beside * turning.lead;
    let velocity = f - lean * (cutter.corner_radius * turning.lead);
    // The same motion at unit speed, in the frame whose feed is its direction.
    let speed = velocity.length();
    let frame = Frame::from_normal(n, velocity)?;
    let aside = libm::atan2(frame.f.dot(b), frame.f.dot(f));
    let posture = Posture { yaw: cc.posture.yaw - aside, ..cc.posture };
    face_strip(face, cutter, &CcPoint { frame, posture, ..*cc }, uv, spin / speed, limits)
}
