//! At which lead curvatures match.

use crate::cutter::Cutter;
use crate::geometry::Curvature;

/// The least lead, radians, at which the cutter yawed by `yaw` (radians) bends nowhere less than a surface with these
/// curvatures in the contact frame: with less it gouges, unless lifted. 0 where every lead above 0 will do; `None` where
/// even its corner bends less, or no lead is enough.
///
/// Across a straight feed it is `sin λm = R1/(Ra − r)` in a hollow of radius `Ra`. In general,
/// with `t` along the lean and `s` square to it the relative curvature is `[[1/r − S_tt, −S_ts], [−S_ts, c − S_ss]]`, with
/// `c = sin λ/(R1 + r sin λ)`. It is positive semidefinite from `c = S_ss + r S_ts²/(1 − r S_tt)` on.
pub fn matching_lead(cutter: &Cutter, surface: &Curvature, yaw: f64) -> Option<f64> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::cutter_curvature;
    use crate::toolpath::Posture;

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
}
