//! The circle model of the stepover: the cutter's profile across the feed taken for a circle.
//!
//! Here to learn from and to stand beside the exact stepover ([`super::straight_strip`]), which is what paths are planned
//! with. By lead the true profile curves away from the circle, so the model promises too much: 16 % on a plane
//! (R1 = 1, r = 2, h = 0.5 mm, lead 15°), and without bound as the effective radius nears that of a hollow.
//!
//! Source: optimisation of the stepover of a toroidal cutter at constant scallop height in multi-axis machining (in
//! Chinese, with tilt angle and effective radius), eqs. (1)–(13), corrected where a function says so.

use super::straight::Lean;
use crate::cutter::Cutter;

/// Radius (mm) of the circle that touches the profile of a cutter with `lead` (radians, 0 to π/2) at its contact,
/// `R1/sin λ + r`: eq. (1). Infinite at a lead of 0, unless the cutter is a ball.
pub fn effective_radius(center_radius: f64, corner_radius: f64, lead: f64) -> f64 {
    if center_radius == 0.0 { corner_radius } else { center_radius / libm::sin(lead) + corner_radius }
}

/// Stepover (mm) on a plane between two passes with these effective radii (mm): eqs. (2)–(4), `s = Σ Re sin θe` with
/// `cos θe = (Re − h)/Re`. `None` where a radius is infinite (the model diverges) or not above the `scallop` (mm).
pub fn plane_circle_stepover(radii: [f64; 2], scallop: f64) -> Option<f64> {
    let [first, second] = radii.map(|re| {
        (re.is_finite() && re > scallop).then(|| {
            let cosine = (re - scallop) / re;
            re * libm::sin(libm::acos(cosine))
        })
    });
    Some(first? + second?)
}

/// Stepover (mm) on a plane by a `tilt` (radians, above 0, below π/2) across the feed: eqs. (5)–(7), the passes meeting
/// where one's corner or side and the other's bottom or far corner reach the `scallop`.
///
/// Corrected: the profile's radius is the corner's, r, where the paper has the effective one; and in (7) the side begins
/// at the height `r(1 − sin λ)`, where the paper lets it begin with the bottom, at `r(1 − cos λ)`. So corrected it is no
/// model: the profile is made of these arcs and lines. `None` for a scallop above the far corner.
pub fn lateral_circle_stepover(
    center_radius: f64,
    corner_radius: f64,
    tilt: f64,
    scallop: f64,
) -> Option<f64> {
    let (r1, r, h) = (center_radius, corner_radius, scallop);
    let (s, c) = libm::sincos(tilt);
    let arc = |h: f64| r * libm::sin(libm::acos((r - h) / r));
    let over_side = h - r * (1.0 - s);
    let outer = if over_side > 0.0 { r * c + over_side * s / c } else { arc(h) };
    let over_bottom = h - r * (1.0 - c);
    let inner = if over_bottom <= 0.0 {
        // Fig. 4a: corner with corner.
        arc(h)
    } else if over_bottom <= 2.0 * r1 * s {
        // Figs. 5 and 6: with the bottom.
        r * s + over_bottom * c / s
    } else if h <= r + 2.0 * r1 * s {
        // Fig. 4b: with the far corner.
        2.0 * r1 * c + arc(h - 2.0 * r1 * s)
    } else {
        return None;
    };
    Some(outer + inner)
}

/// Stepover (mm, the chord) over a circular section of this `curvature` (1/mm, above 0 where concave, not 0) between
/// passes with these effective radii (mm): eqs. (8)–(13), `s = 2 Ra sin((θ1 + θ2)/2)`, with the angles by the law of
/// cosines at once, `cos θ = [(Ra ∓ Re)² + (Ra ∓ h)² − Re²] / [2 (Ra ∓ Re)(Ra ∓ h)]` (upper sign concave).
///
/// `None` where the model diverges: an infinite radius, on a concave section one that is not below the section's, or a
/// circle that nowhere stands as high as the `scallop` (mm).
pub fn curved_circle_stepover(radii: [f64; 2], curvature: f64, scallop: f64) -> Option<f64> {
    let [first, second] = radii.map(|re| surface_angle(re, curvature, scallop));
    let turn = first? + second?;
    Some(2.0 * libm::sin(0.5 * turn) / curvature.abs())
}

/// Angle θ at the section's centre from a contact to where a circle of radius `re` stands as high as the scallop.
fn surface_angle(re: f64, curvature: f64, scallop: f64) -> Option<f64> {
    let ra = 1.0 / curvature.abs();
    let sign = -curvature.signum();
    let (centers, level) = (ra + sign * re, ra + sign * scallop);
    if !(centers > 0.0 && centers.is_finite() && level > 0.0) {
        return None;
    }
    let cosine = (centers * centers + level * level - re * re) / (2.0 * centers * level);
    (cosine > -1.0 && cosine < 1.0).then(|| libm::acos(cosine))
}

/// Stepover (mm, the chord) of the circle model for any lean over a section of this `curvature` (1/mm, concave above 0).
///
/// `None` where the model diverges or does not reach: as the functions for the single cases state; for a lateral tilt
/// over a curved section, which the paper leaves out, where the passes do not meet on their corners.
pub fn circle_stepover(cutter: &Cutter, lean: Lean, curvature: f64, scallop: f64) -> Option<f64> {
    let (r1, r) = (cutter.center_radius, cutter.corner_radius);
    match lean {
        Lean::Lead(lead) => {
            let radii = [effective_radius(r1, r, lead); 2];
            if curvature == 0.0 {
                plane_circle_stepover(radii, scallop)
            } else {
                curved_circle_stepover(radii, curvature, scallop)
            }
        }
        Lean::Lateral(tilt) if curvature == 0.0 => lateral_circle_stepover(r1, r, tilt, scallop),
        Lean::Lateral(tilt) => {
            let theta = surface_angle(r, curvature, scallop)?;
            // The angle θe on the corner, from how far the meeting point lies to the side.
            let level = 1.0 / curvature.abs() - curvature.signum() * scallop;
            let on_corner = libm::asin((level * libm::sin(theta) / r).min(1.0));
            let is_corner = on_corner <= tilt && on_corner <= std::f64::consts::FRAC_PI_2 - tilt;
            is_corner.then(|| 2.0 * libm::sin(theta) / curvature.abs())
        }
    }
}
