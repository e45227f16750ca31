//! Places whose strips are computed.

use glam::DVec3;
use stepover::cutter::Cutter;
use stepover::geometry::{Curvature, Face, Uv};
use stepover::job;
use stepover::math::frame::Frame;
use stepover::toolpath::{CcPoint, Posture};

/// Cutters, postures and curvatures as they occur, from a fixed sequence.
pub(crate) fn cases() -> Vec<(Cutter, Posture, Curvature)> {
    let mut state = 1u64;
    let mut next = |low: f64, high: f64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (state >> 11) as f64 / (1u64 << 53) as f64
    };
    (0..1000)
        .map(|_| {
            let (r1, r) = (next(1.0, 12.0), next(0.5, 3.0));
            let cutter = Cutter::bull_nose(2.0 * (r1 + r), r, 100.0).unwrap();
            let posture = Posture { lead: next(0.1, 0.5), yaw: next(-0.7, 0.7) };
            (
                cutter,
                posture,
                Curvature { ff: next(-0.03, 0.005), fb: next(-0.005, 0.005), bb: next(-0.03, 0.005) },
            )
        })
        .collect()
}

/// Contacts all over the first surface of the gallery.
pub(crate) fn contacts() -> (Option<Face>, Vec<(Uv, CcPoint)>) {
    let shape = job::gallery()[0].spec.source.shape(None);
    let Ok((job::Shape::Face(face), _)) = shape else { return (None, Vec::new()) };
    let posture = Posture { lead: 0.14, yaw: 0.0 };
    let contacts = (0..400)
        .filter_map(|i| {
            let uv = face.domain().at(0.1 + 0.04 * f64::from(i % 20), 0.1 + 0.04 * f64::from(i / 20));
            let (jet, n) = face.at(uv)?;
            Some((uv, CcPoint { point: jet.p, frame: Frame::from_normal(n, DVec3::X)?, posture }))
        })
        .collect();
    (Some(face), contacts)
}
