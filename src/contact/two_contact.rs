//! Two contacts at once on a concave strip: the cutter lies on both sides of a hollow, its middle lifted a little.
//!
//! Across a straight feed the corner sweeps the r-offset of the ellipse with semi-axes `R1` and `b = R1 sin λ`. It stays
//! in a hollow of radius `Ra` as long as the ellipse stays in the circle of radius `K = Ra − r` about the same centre.
//! With the ellipse's middle at the distance `g` below that centre, the square of the distance of its points is
//! `R1² sin² t + (g + b cos t)²`, which is greatest at `cos t = g b/(R1² cos² λ)`, or in the middle if that is above 1.
//! Set equal to `K²` this gives `g = cos λ √(K² − R1²)`, and with `sin λm = R1/K` (where the curvatures match) the lift
//! `K − b − g = K (1 − cos(λm − λ))`: what a chord of the ball of radius K misses when it is turned by `λm − λ`.

use super::matching::matching_lead;
use super::straight::{Section, StraightStrip};
use crate::cutter::Cutter;
use crate::geometry::Curvature;

/// A cutter on both sides of a hollow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoContact {
    /// Lead, radians.
    pub lead: f64,
    /// The strip, with the lift (mm) of the middle, which is also the height left there.
    pub strip: StraightStrip,
}

/// The strip within `scallop` (mm) with `lead` (radians, from 0 to [`matching_lead`]), lifted until both sides touch a
/// section of this `curvature` (1/mm) and nothing digs in.
///
/// `None` for a ball, on planes and convex sections, in a hollow too narrow, for a lead above the matching one (one contact will do)
/// or below the bottom's own angle, and where the lift exceeds the scallop.
pub fn two_contact(cutter: &Cutter, lead: f64, curvature: f64, scallop: f64) -> Option<TwoContact> {
    let matching = matching_lead(cutter, &Curvature::across(curvature), 0.0)?;
    let (r1, room) = (cutter.center_radius, 1.0 / curvature - cutter.corner_radius);
    if r1 == 0.0 || curvature <= 0.0 || !(cutter.bottom_angle..=matching).contains(&lead) {
        return None;
    }
    let lift = room * one_less_cosine(matching - lead);
    // The widest placement lifts by just the scallop.
    if lift > scallop * (1.0 + 1e-9) {
        return None;
    }
    let (s, c) = libm::sincos(lead);
    let cosine = (room * room - r1 * r1).sqrt() * s / (r1 * c);
    let contact = libm::acos(cosine.min(1.0));
    // Half way to the contacts the cutter is lower than in the middle, and no edge lies before them.
    let strip = Section { curvature, scallop }.by_lead(cutter, lead, lift, 0.5 * contact)?;
    Some(TwoContact { lead, strip })
}

/// The widest strip with two contacts: the less the lead the wider, so the least lead at which the middle stays within
/// `scallop` (mm), `λm − arccos(1 − h/K)`, or else 0. `None` as for [`two_contact`].
pub fn widest_two_contact(cutter: &Cutter, curvature: f64, scallop: f64) -> Option<TwoContact> {
    let matching = matching_lead(cutter, &Curvature::across(curvature), 0.0)?;
    let room = 1.0 / curvature - cutter.corner_radius;
    // The arccosine in a form that is good for small angles.
    let turn = 2.0 * libm::asin((0.5 * scallop / room).sqrt().min(1.0));
    two_contact(cutter, (matching - turn).max(cutter.bottom_angle), curvature, scallop)
}

/// `1 − cos x` without cancellation.
fn one_less_cosine(x: f64) -> f64 {
    let s = libm::sin(0.5 * x);
    2.0 * s * s
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mill(r1: f64, r: f64) -> Cutter {
        Cutter::bull_nose(2.0 * (r1 + r), r, 100.0).unwrap()
    }

    #[test]
    fn less_lead_is_wider() {
        for (r1, r, ra, h) in
            [(9.5, 3.0, 50.0, 0.01), (3.0, 2.0, 50.0, 0.01), (1.0, 2.0, 30.0, 0.5), (4.0, 0.5, 10.0, 0.2)]
        {
            let cutter = mill(r1, r);
            let matching = matching_lead(&cutter, &Curvature::across(1.0 / ra), 0.0).unwrap();
            let best = widest_two_contact(&cutter, 1.0 / ra, h).unwrap();
            let mut before = 0.0;
            for i in 0..=40 {
                let lead = matching + (best.lead - matching) * f64::from(i) / 40.0;
                let found = two_contact(&cutter, lead, 1.0 / ra, h).unwrap().strip.stepover;
                assert!(found > before, "{r1} {ra}: {lead} {found} {before}");
                before = found;
            }
            assert!(best.lead == 0.0 || (best.strip.lift / h - 1.0).abs() < 1e-9, "{best:?}");
            assert!(two_contact(&cutter, matching + 1e-3, 1.0 / ra, h).is_none());
        }
        assert!(widest_two_contact(&mill(9.5, 3.0), 1e-5, 1e-4).is_some());
        assert!(widest_two_contact(&mill(0.0, 5.0), 0.02, 0.01).is_none());
        assert!(widest_two_contact(&mill(9.5, 3.0), 0.0, 0.01).is_none());
        assert!(widest_two_contact(&mill(9.5, 3.0), -0.02, 0.01).is_none());
        assert!(widest_two_contact(&mill(9.5, 3.0), 0.09, 0.01).is_none());
    }
}
