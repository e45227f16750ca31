//! Whether a spline surface closes on itself.

use super::{Along, NurbsSurface};
use crate::geometry::{Jet, Surface, Uv};
use glam::DVec3;

/// Distance of end curves that still coincide, over the size of the surface. Exchange files round coordinates to nine or ten
/// digits; a gap that somebody meant is far larger.
const COINCIDENT: f64 = 1e-8;

/// Sine of the angle between tangents over the seam that still counts as smooth: the files' rounding, over neighbouring
/// control points a ten-thousandth of the surface apart, turns a tangent by up to 1e-4.
const SMOOTH_SINE: f64 = 1e-4;

/// A tangent shorter than this part of the surface's size over the domain's length has no direction: a pole.
const NO_TANGENT: f64 = 1e-9;

/// Whether the end curves in `along` coincide and the tangents across them have one direction.
///
/// Both are compared at `2 degree + 1` places of each span of the other parameter, which is what it takes to tell two rational
/// curves apart.
pub(super) fn is_smoothly_closed(surface: &NurbsSurface, along: Along) -> bool {
    let other = match along {
        Along::U => Along::V,
        Along::V => Along::U,
    };
    let (lo, hi) = surface.hull_bounds();
    let size = lo.distance(hi);
    let domain = surface.domain();
    let range = match along {
        Along::U => domain.u,
        Along::V => domain.v,
    };
    let at = |end: f64, t: f64| {
        let (uv, tangent): (Uv, fn(&Jet) -> DVec3) = match along {
            Along::U => (Uv::new(end, t), |jet| jet.du),
            Along::V => (Uv::new(t, end), |jet| jet.dv),
        };
        let jet = surface.jet(uv);
        (jet.p, tangent(&jet))
    };
    if !size.is_finite() {
        return false;
    }
    let least = NO_TANGENT * size / range.length();
    let mut smooth_somewhere = false;
    for t in surface.parameters(other, 2 * surface.degree(other) + 1) {
        let ((p, a), (q, b)) = (at(range.lo, t), at(range.hi, t));
        if p.distance(q) > COINCIDENT * size {
            return false;
        }
        let (la, lb) = (a.length(), b.length());
        if la <= least && lb <= least {
            continue;
        }
        if !(a.cross(b).length() <= SMOOTH_SINE * la * lb && a.dot(b) > 0.0) {
            return false;
        }
        smooth_somewhere = true;
    }
    smooth_somewhere
}
