//! Strip widths a second: exact over the model surface, exact over a spline surface, second order.

use divan::Bencher;
use divan::counter::ItemsCount;
use glam::DVec3;
use stepover::contact::{StripLimits, face_strip, model_strip, second_order_strip_width};
use stepover::cutter::Cutter;
use stepover::geometry::{Curvature, Face, Side};
use stepover::job;
use stepover::math::frame::Frame;
use stepover::toolpath::{CcPoint, Posture};

fn main() {
    divan::main();
}

/// Cutters, postures and curvatures as they occur, from a fixed sequence.
fn cases() -> Vec<(Cutter, Posture, Curvature)> {
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

#[divan::bench]
fn exact_over_model(bencher: Bencher) {
    let cases = cases();
    bencher.counter(ItemsCount::new(cases.len())).bench(|| {
        cases
            .iter()
            .filter_map(|(c, p, k)| model_strip(c, *p, k, 0.01).half_widths())
            .map(|(l, r)| l + r)
            .sum::<f64>()
    });
}

#[divan::bench]
fn second_order(bencher: Bencher) {
    let cases = cases();
    bencher
        .counter(ItemsCount::new(cases.len()))
        .bench(|| cases.iter().map(|(c, p, k)| second_order_strip_width(c, *p, k, 0.01)).sum::<f64>());
}

#[divan::bench]
fn exact_over_spline_surface(bencher: Bencher) {
    let spec = &job::gallery()[0].spec;
    let (shape, _) = spec.source.shape(None).unwrap();
    let job::Shape::Face(Face { surface, .. }) = shape else { return };
    let face = Face { surface, side: Side::Front };
    let cutter = Cutter::bull_nose(8.0, 2.0, 30.0).unwrap();
    let posture = Posture { lead: 0.14, yaw: 0.0 };
    let contacts: Vec<_> = (0..400)
        .filter_map(|i| {
            let uv = face.domain().at(0.1 + 0.04 * f64::from(i % 20), 0.1 + 0.04 * f64::from(i / 20));
            let (jet, n) = face.at(uv)?;
            Some((uv, CcPoint { point: jet.p, frame: Frame::from_normal(n, DVec3::X)?, posture }))
        })
        .collect();
    let limits = StripLimits { scallop: 0.02, gouge: 0.0005 };
    bencher.counter(ItemsCount::new(contacts.len())).bench(|| {
        contacts
            .iter()
            .filter(|(uv, cc)| face_strip(&face, &cutter, cc, *uv, DVec3::ZERO, limits).is_some())
            .count()
    });
}
