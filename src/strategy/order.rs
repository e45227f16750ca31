//! In which order passes are cut.

use crate::math::frame::Frame;
use crate::toolpath::Pass;

/// `passes` in an order in which each begins near where the last one ended: the first stays first, and the next is always
/// the one whose start is nearest, or, if they may be `turned`, whose nearer end is. Ties go to the earlier one.
///
/// Only passes of an upright cutter may be turned: elsewhere the posture belongs to the direction of feed.
pub fn nearest_next(passes: Vec<Pass>, turned: bool) -> Vec<Pass> {
    let mut open: Vec<Option<Pass>> = passes.into_iter().map(Some).collect();
    let mut ordered: Vec<Pass> = Vec::with_capacity(open.len());
    // Passes before this one are all taken.
    let mut first = 0;
    while first < open.len() {
        let at = ordered.last().and_then(|p| p.stations.last()).map(|s| s.cl.tip);
        let mut best: Option<(f64, usize, bool)> = None;
        for (i, pass) in open.iter().enumerate().skip(first) {
            let Some(pass) = pass else { continue };
            let (Some(start), Some(end)) = (pass.stations.first(), pass.stations.last()) else { continue };
            let Some(at) = at else {
                best = Some((0.0, i, false));
                break;
            };
            let mut consider = |tip: glam::DVec3, turn| {
                let away = tip.distance_squared(at);
                if best.is_none_or(|(d, ..)| away < d) {
                    best = Some((away, i, turn));
                }
            };
            consider(start.cl.tip, false);
            if turned {
                consider(end.cl.tip, true);
            }
        }
        let Some((_, i, turn)) = best else { break };
        if let Some(pass) = open[i].take() {
            ordered.push(if turn { reversed(pass) } else { pass });
        }
        while first < open.len() && open[first].is_none() {
            first += 1;
        }
    }
    ordered
}

/// The pass cut the other way: feed and left change sign, and with them the yaw, so that the axis stays.
fn reversed(mut pass: Pass) -> Pass {
    pass.stations.reverse();
    for station in &mut pass.stations {
        let Frame { f, b, n } = station.cc.frame;
        station.cc.frame = Frame { f: -f, b: -b, n };
        station.cc.posture.yaw += std::f64::consts::PI;
    }
    pass
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::toolpath::{CcPoint, ClPoint, Posture, Station, Work};
    use glam::DVec3;

    fn pass(from: f64, to: f64, y: f64) -> Pass {
        let station = |x| {
            let point = DVec3::new(x, y, 0.0);
            let frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
            let cc = CcPoint { point, frame, posture: Posture::default() };
            Station { cc, cl: ClPoint { tip: point, axis: DVec3::Z }, work: Work::default() }
        };
        Pass { stations: vec![station(from), station(to)] }
    }

    fn starts(passes: &[Pass]) -> Vec<(f64, f64)> {
        passes.iter().map(|p| (p.stations[0].cc.point.x, p.stations[0].cc.point.y)).collect()
    }

    #[test]
    fn lines_become_a_snake_where_they_may_turn() {
        let lines = vec![pass(0.0, 9.0, 0.0), pass(0.0, 9.0, 1.0), pass(0.0, 9.0, 2.0)];
        assert_eq!(starts(&nearest_next(lines.clone(), true)), [(0.0, 0.0), (9.0, 1.0), (0.0, 2.0)]);
        assert_eq!(starts(&nearest_next(lines, false)), [(0.0, 0.0), (0.0, 1.0), (0.0, 2.0)]);
    }

    #[test]
    fn no_pass_is_lost_and_the_axis_stays() {
        let lines: Vec<Pass> =
            (0..20).map(|i| pass(f64::from(i % 7), f64::from(i % 5) + 8.0, f64::from(i * 7 % 20))).collect();
        let ordered = nearest_next(lines.clone(), true);
        assert_eq!(ordered.len(), lines.len());
        assert!(ordered.iter().flat_map(|p| &p.stations).all(|s| s.cl.axis == DVec3::Z));
    }
}
