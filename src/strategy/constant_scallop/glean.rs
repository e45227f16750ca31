//! What passes leave, and short passes for it.

use super::offset::Offset;
use crate::contact::Body;
use crate::cutter::Cutter;
use crate::geometry::{Fronts, IsoLine, Uv};
use crate::monitor::{Cancelled, Stage};
use crate::strategy::family::{Candidate, Family};
use crate::strategy::probe::Probe;
use crate::toolpath::{ClPoint, Pass, Station};
use glam::DVec3;

/// What may be left above the limit, as a share of it: nodes that lie on a cusp must not count.
const LEFT: f64 = 0.02;
/// Cells from a border that are looked at more closely, and how many places a side of each then has.
const RIM: usize = 3;
const FINER: usize = 6;
/// Levels beside that of a spot, in strips, at which a line is looked for if it has none: at a corner it is a point.
const ASIDE: [f64; 7] = [0.0, 0.1, -0.1, 0.2, -0.2, 0.35, -0.35];
/// Where directions at neighbouring nodes have a lower cosine than this (18°), strips bend or fronts meet.
const BENT: f64 = 0.95;
/// Places nearer to each other than this belong together, in strips.
const TOGETHER: f64 = 0.55;
/// How far from its contact a cutter is looked at, in strips.
const WIDE: f64 = 4.0;
/// Steps, each to two thirds of the last, of the search along a move for the place where it comes nearest.
const THIRDS: usize = 12;
/// Levels, in strips, that one short pass takes care of, and how much longer it is than what it is for.
const DEEP: f64 = 0.8;
const LONGER: f64 = 0.7;

/// Places that are looked at: the nodes of `offset`, and more where strips end or bend.
pub(super) fn places(family: &Family, offset: &Offset) -> Vec<Uv> {
    let (nu, nv) = offset.grid.size();
    let mut places: Vec<Uv> = (0..nu * nv).map(|node| offset.uv(node)).collect();
    let beside = |k: usize, count: usize, periodic: bool| !periodic && (k < RIM || k + RIM + 1 >= count);
    let fronts = Fronts::new(&offset.domain, &offset.grid);
    let ways: Vec<DVec3> = places
        .iter()
        .map(|&uv| {
            let rise = family.setup.field.surface_gradient(uv, &family.setup.face.jet(uv));
            if rise.is_finite() { rise.normalize_or_zero() } else { DVec3::ZERO }
        })
        .collect();
    let is_crest =
        |node: usize| fronts.around(node).into_iter().flatten().any(|n| ways[n].dot(ways[node]) < BENT);
    let mut crest = vec![false; nu * nv];
    for node in (0..nu * nv).filter(|&node| is_crest(node)) {
        crest[node] = true;
        fronts.around(node).into_iter().flatten().for_each(|n| crest[n] = true);
    }
    for j in 0..nv - 1 {
        for i in 0..nu - 1 {
            let rim = beside(i, nu, offset.domain.u.periodic) || beside(j, nv, offset.domain.v.periodic);
            if rim || crest[j * nu + i] {
                let (low, high) = (offset.grid.uv(i, j), offset.grid.uv(i + 1, j + 1));
                let at = |a: f64, b: f64, k: usize| a + (b - a) * k as f64 / FINER as f64;
                let inside = (0..(FINER + 1) * (FINER + 1)).map(|k| (k % (FINER + 1), k / (FINER + 1)));
                places.extend(inside.map(|(p, q)| Uv::new(at(low.u, high.u, p), at(low.v, high.v, q))));
            }
        }
    }
    places
}

/// The places where `passes` leave more than the limit and the cutter can go.
pub(super) fn left(
    family: &Family,
    places: &[Uv],
    passes: &[Pass],
    stage: &Stage,
) -> Result<Vec<Uv>, Cancelled> {
    let setup = &family.setup;
    let reach = WIDE * setup.strip;
    let boxes: Vec<(DVec3, DVec3)> = passes.iter().map(|pass| bounds(pass, reach)).collect();
    let height = (1.0 + LEFT) * setup.finish.scallop;
    let is_left = |uv: Uv| {
        let Some((jet, n)) = setup.face.at(uv) else { return false };
        let raised = jet.p + n * height;
        let near = passes
            .iter()
            .zip(&boxes)
            .filter(|(_, (low, high))| jet.p.cmpge(*low).all() && jet.p.cmple(*high).all());
        let is_cut = near
            .flat_map(|(pass, _)| pass.stations.windows(2))
            .any(|w| from_segment(jet.p, w) < reach && cuts(setup.cutter, w, raised));
        !is_cut && setup.probe(uv, false) != Probe::Blocked
    };
    let left = stage.map(places.len(), |k| is_left(places[k]))?;
    Ok(places.iter().zip(left).filter(|(_, left)| *left).map(|(&uv, _)| uv).collect())
}

fn bounds(pass: &Pass, more: f64) -> (DVec3, DVec3) {
    let none = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) =
        pass.stations.iter().fold(none, |(low, high), s| (low.min(s.cc.point), high.max(s.cc.point)));
    (low - more, high + more)
}

fn from_segment(point: DVec3, ends: &[Station]) -> f64 {
    let (a, b) = (ends[0].cc.point, ends[1].cc.point);
    let way = b - a;
    let t = ((point - a).dot(way) / way.length_squared()).clamp(0.0, 1.0);
    point.distance(if t.is_finite() { a + way * t } else { a })
}

/// Whether the cutter takes `point` away as it goes from one station to the next.
fn cuts(cutter: &Cutter, ends: &[Station], point: DVec3) -> bool {
    let (a, b) = (ends[0].cl, ends[1].cl);
    let away = |t: f64| {
        let axis = a.axis.lerp(b.axis, t).normalize();
        Body::new(cutter, &ClPoint { tip: a.tip.lerp(b.tip, t), axis }).distance(point)
    };
    // Nothing of the cutter moves farther than this from where it is half way.
    let turn = a.axis.distance(b.axis);
    let most = 0.5 * (a.tip.distance(b.tip) + turn * (cutter.center_radius + 3.0 * cutter.corner_radius));
    let middle = away(0.5);
    if middle <= 0.0 || middle > most {
        return middle <= 0.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..THIRDS {
        let (one, two) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        let (at_one, at_two) = (away(one), away(two));
        if at_one <= 0.0 || at_two <= 0.0 {
            return true;
        }
        if at_one < at_two { high = two } else { low = one }
    }
    away(0.0) <= 0.0 || away(1.0) <= 0.0
}

/// Short passes over the places `left`.
pub(super) fn short_passes(family: &Family, left: &[Uv], stage: &Stage) -> Result<Vec<Candidate>, Cancelled> {
    let setup = &family.setup;
    let mut found = Vec::new();
    for spot in spots(family, left) {
        let levels = || spot.iter().map(|&(uv, p)| setup.field.value(uv, p));
        let low = levels().fold(f64::INFINITY, f64::min);
        let high = levels().fold(f64::NEG_INFINITY, f64::max);
        let points: Vec<DVec3> = spot.iter().map(|(_, p)| *p).collect();
        let count = ((high - low) / DEEP).floor() + 1.0;
        for i in 0..count as usize {
            let level = low + (high - low) * (i as f64 + 0.5) / count;
            let pieces = ASIDE
                .into_iter()
                .map(|aside| pieces(family, level + aside, &points))
                .find(|pieces| !pieces.is_empty());
            if let Some(pieces) = pieces {
                found.push(family.probed(level, pieces, false, &stage.quiet())?);
            }
        }
    }
    Ok(found)
}

/// The places in groups that hang together, with their points.
fn spots(family: &Family, left: &[Uv]) -> Vec<Vec<(Uv, DVec3)>> {
    let near = TOGETHER * family.setup.strip;
    let mut open: Vec<(Uv, DVec3)> =
        left.iter().map(|&uv| (uv, family.setup.face.surface.point(uv))).collect();
    let mut spots = Vec::new();
    while let Some(first) = open.pop() {
        let mut spot = vec![first];
        let mut next = 0;
        while next < spot.len() {
            let here = spot[next].1;
            let (beside, rest): (Vec<_>, Vec<_>) =
                open.into_iter().partition(|(_, p)| p.distance_squared(here) < near * near);
            spot.extend(beside);
            open = rest;
            next += 1;
        }
        spots.push(spot);
    }
    spots
}

/// The pieces of the lines of `level` beside some of the `points`.
fn pieces(family: &Family, level: f64, points: &[DVec3]) -> Vec<IsoLine> {
    let setup = &family.setup;
    let near = LONGER * setup.strip;
    let is_near = |uv: &Uv| {
        let here = setup.face.surface.point(*uv);
        points.iter().any(|p| p.distance_squared(here) < near * near)
    };
    let mut pieces = Vec::new();
    for line in family.lines.lines(level) {
        for run in line.nodes.chunk_by(|a, b| is_near(a) && is_near(b)) {
            if run.len() > 1 {
                pieces.push(IsoLine { level: line.level, nodes: run.to_vec(), closed: false });
            }
        }
    }
    pieces
}
