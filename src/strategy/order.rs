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

/// A side of the feed, seen against the surface normal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Where `b` of the contact frame points.
    Left,
    /// The other one: with what is uncut there a spindle that turns clockwise climbs.
    Right,
}

/// `passes`, none of them turned, each followed by the nearest one beside it; begun with the first, or with the last if the next pass then
/// lies more often on the `side` of the one before.
pub fn one_sided(passes: Vec<Pass>, side: Side) -> Vec<Pass> {
    let mut order = beside(&passes, 0);
    let on_side = order.windows(2).filter(|pair| is_on(&passes[pair[0]], &passes[pair[1]], side)).count();
    if 2 * on_side + 1 < order.len() {
        order = beside(&passes, passes.len() - 1);
    }
    let mut open: Vec<Option<Pass>> = passes.into_iter().map(Some).collect();
    order.into_iter().filter_map(|i| open[i].take()).collect()
}

/// Stations of a pass that tell how near it is.
const LOOKS: usize = 24;

/// The passes in an order in which each is followed by the one that comes nearest to its middle.
fn beside(passes: &[Pass], first: usize) -> Vec<usize> {
    let mut open: Vec<usize> = (0..passes.len()).collect();
    let mut order = Vec::with_capacity(passes.len());
    let mut next = first;
    while let Some(at) = open.iter().position(|i| *i == next) {
        order.push(open.remove(at));
        let away = |i: &usize| nearest(&passes[next], &passes[*i]).map_or(f64::INFINITY, |(d, _)| d);
        let Some(nearest) = open.iter().min_by(|a, b| away(a).total_cmp(&away(b))) else { break };
        next = *nearest;
    }
    order
}

/// How near a pass comes to the middle of another, squared, and where from there.
fn nearest(before: &Pass, after: &Pass) -> Option<(f64, glam::DVec3)> {
    let at = before.stations.get(before.stations.len() / 2)?.cc.point;
    let looks = after.stations.iter().step_by(1 + after.stations.len() / LOOKS);
    let away = looks.map(|station| station.cc.point - at).map(|way| (way.length_squared(), way));
    away.min_by(|a, b| a.0.total_cmp(&b.0))
}

fn is_on(before: &Pass, after: &Pass, side: Side) -> bool {
    let left = || Some(before.stations.get(before.stations.len() / 2)?.cc.frame.b);
    let across = nearest(before, after).zip(left()).map(|((_, way), left)| way.dot(left));
    across.is_some_and(|x| (x > 0.0) == (side == Side::Left))
}

/// The pass cut the other way: feed and left change sign, and with them the yaw, so that the axis stays.
pub(super) fn reversed(mut pass: Pass) -> Pass {
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
    fn what_is_uncut_is_on_the_side_asked_for() {
        // Fed along +x, with y rising to the left.
        let lines = vec![pass(0.0, 9.0, 0.0), pass(0.0, 9.0, 1.0), pass(0.0, 9.0, 2.0)];
        for side in [Side::Left, Side::Right] {
            let ordered = one_sided(lines.clone(), side);
            let ys: Vec<f64> = starts(&ordered).iter().map(|start| start.1).collect();
            assert_eq!(ys, if side == Side::Left { [0.0, 1.0, 2.0] } else { [2.0, 1.0, 0.0] });
            assert!(starts(&ordered).iter().all(|start| start.0 == 0.0));
        }
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
