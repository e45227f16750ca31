//! Strip widths that cost next to nothing, for comparing postures.

use crate::contact::second_order_strip_width;
use crate::cutter::Cutter;
use crate::geometry::Curvature;
use crate::toolpath::Posture;

/// The least lead, radians, at which the cutter yawed by `yaw` bends nowhere less than the `surface`; `None` where even
/// its corner bends less.
///
/// With `t` along the lean and `s` square to it the relative curvature is `[[1/r − S_tt, −S_ts], [−S_ts, c − S_ss]]`, with
/// `c = sin λ/(R1 + r sin λ)`. It is positive semidefinite from `c = S_ss + r S_ts²/(1 − r S_tt)` on.
pub(super) fn matching_lead(cutter: &Cutter, surface: &Curvature, yaw: f64) -> Option<f64> {
    let s = surface.turned(yaw);
    let (big, r) = (cutter.center_radius, cutter.corner_radius);
    let room = 1.0 - r * s.ff;
    if room <= 0.0 {
        return None;
    }
    let across = s.bb + r * s.fb * s.fb / room;
    let sine = across * big / (1.0 - across * r);
    match across {
        c if c <= 0.0 => Some(0.0),
        c if c * r < 1.0 && sine <= 1.0 => Some(libm::asin(sine)),
        _ => None,
    }
}

/// The width of the strip within `scallop` (mm) to the fourth order of the cutter's own profile, mm: finite where
/// curvatures match, where the second order alone knows no end.
///
/// The profile across the feed is an ellipse with semi-axes `R1` and `R1 sin λ`, moved outwards by `r`: its height grows as
/// `c y²/2 + β y⁴` with `β = R1 sin λ/(8 (R1 + r sin λ)⁴) + c³/8`.
pub(super) fn estimated_width(cutter: &Cutter, posture: Posture, surface: &Curvature, scallop: f64) -> f64 {
    let second = second_order_strip_width(cutter, posture, surface, scallop);
    let half_bend = 4.0 * scallop / (second * second);
    let sine = libm::sin(posture.lead);
    let stretch = cutter.center_radius + cutter.corner_radius * sine;
    let (c, square) = (sine / stretch, stretch * stretch);
    let beta = cutter.center_radius * sine / (8.0 * square * square) + c * c * c / 8.0;
    let root = (half_bend * half_bend + 4.0 * beta * scallop).sqrt();
    2.0 * (2.0 * scallop / (half_bend + root)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{cutter_curvature, model_strip};

    #[test]
    fn matching_leads_leave_one_direction_without_relative_curvature() {
        let cutter = Cutter::bull_nose(25.0, 3.0, 50.0).unwrap();
        for (yaw, surface) in [
            (0.0, Curvature { ff: 0.01, fb: 0.0, bb: 0.02 }),
            (0.3, Curvature { ff: -0.02, fb: 0.006, bb: 0.015 }),
            (-0.7, Curvature { ff: 0.03, fb: -0.01, bb: 0.02 }),
        ] {
            let lead = matching_lead(&cutter, &surface, yaw).unwrap();
            let k = cutter_curvature(&cutter, Posture { lead, yaw }) - surface;
            assert!(lead > 0.0 && k.det().abs() < 1e-12 && k.ff > 0.0, "{lead} {k:?}");
        }
        let tight = Curvature { ff: 0.4, fb: 0.0, bb: 0.0 };
        assert_eq!(matching_lead(&cutter, &tight, 0.0), None);
    }

    #[test]
    fn estimates_stay_near_the_exact_width_up_to_the_match() {
        let cutter = Cutter::bull_nose(25.0, 3.0, 50.0).unwrap();
        for bend in [-0.03, 0.0, 0.01, 0.02] {
            let surface = Curvature { ff: 0.0, fb: 0.0, bb: bend };
            let least = matching_lead(&cutter, &surface, 0.0).unwrap().max(0.05);
            for lead in [least + 1e-4, least + 0.03, least + 0.1] {
                let posture = Posture { lead, yaw: 0.0 };
                let (l, r) = model_strip(&cutter, posture, &surface, 0.01).half_widths().unwrap();
                let width = estimated_width(&cutter, posture, &surface, 0.01);
                assert!((width / (l + r) - 1.0).abs() < 0.05, "{bend} {lead}: {width} {}", l + r);
            }
        }
    }
}
