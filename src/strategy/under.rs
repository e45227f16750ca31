//! How deep the bottom of a cutter that has run over a border reaches into the face behind it.

use crate::contact::Body;
use crate::cutter::Cutter;
use crate::geometry::{Face, Uv};
use crate::toolpath::ClPoint;

/// Samples from the middle of the bottom to its rim.
const SAMPLES: i32 = 8;
/// Halvings of their distance: down to a thousandth of a millimetre, where a depth errs by nanometres.
const HALVINGS: usize = 9;

/// The least distance of the face from the cutter at `cl` beneath its bottom, mm, negative for digging in; `near` is a place
/// of the face beside it.
///
/// Sampled evenly and followed down along the lean and across it: where curvatures nearly match, what is deepest lies in a
/// long valley across the lean, in which steps along the parameters would stick.
pub(super) fn least_under(face: &Face, cutter: &Cutter, cl: &ClPoint, near: Uv) -> f64 {
    let Some((jet, n)) = face.at(near) else { return f64::INFINITY };
    let body = Body::new(cutter, cl);
    let lean = (cl.axis - n * n.dot(cl.axis)).try_normalize().unwrap_or_else(|| jet.du.normalize_or_zero());
    let beside = n.cross(lean);
    let domain = face.domain();
    let distance = |(along, across): (f64, f64)| {
        let way = cl.tip - jet.p + lean * along + beside * across;
        let Some((u, v)) = jet.pull_back(way) else { return f64::INFINITY };
        body.distance(face.surface.point(domain.clamp(Uv::new(near.u + u, near.v + v))))
    };
    let mut step = (cutter.center_radius + cutter.corner_radius) / f64::from(SAMPLES);
    let mut best = (f64::INFINITY, (0.0, 0.0));
    for i in -SAMPLES..=SAMPLES {
        for j in -SAMPLES..=SAMPLES {
            let at = (f64::from(i) * step, f64::from(j) * step);
            let here = distance(at);
            if here < best.0 {
                best = (here, at);
            }
        }
    }
    for _ in 0..HALVINGS {
        step *= 0.5;
        for (a, b) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
            let at = (best.1.0 + a * step, best.1.1 + b * step);
            let here = distance(at);
            if here < best.0 {
                best = (here, at);
            }
        }
    }
    best.0
}
