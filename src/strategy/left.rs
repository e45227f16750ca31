//! What passes leave at given places, measured by the cutter's own places on their moves.

use super::probe::Setup;
use crate::contact::Body;
use crate::cutter::Cutter;
use crate::geometry::Uv;
use crate::math::bvh::{Aabb, Bvh};
use crate::math::order::{rank, sort_by_key};
use crate::toolpath::{ClPoint, Pass, Station};
use glam::DVec3;
use std::ops::Range;

/// Moves in a leaf of the tree.
const LEAF: usize = 4;
/// The share of the scallop that the search along a move for the place where it comes nearest may miss.
const MISS: f64 = 0.005;
/// How far from where they touch it is looked for what moves cut, in strips, the widest of them.
const WIDE: f64 = 0.75;
/// Ways that count as none, mm.
const ROUNDING: f64 = 1e-9;
/// Steps of that search at most, each to two thirds of the last.
const THIRDS: usize = 40;

/// The moves of passes, found by the places beside them.
pub(super) struct Moves<'a> {
    setup: &'a Setup<'a>,
    /// The cutter, wherever it stands.
    body: Body,
    moves: Vec<Part>,
    tree: Bvh,
    /// What moves cut so near to the face that it counts is no farther than this from where they touch, mm.
    wide: f64,
}

impl<'a> Moves<'a> {
    pub(super) fn new<'p>(setup: &'a Setup<'a>, passes: impl Iterator<Item = &'p Pass>) -> Self {
        let pairs = passes.flat_map(|pass| pass.stations.windows(2));
        Self::of(setup, pairs.map(|pair| [pair[0], pair[1]]).collect())
    }

    pub(super) fn of(setup: &'a Setup<'a>, moves: Vec<[Station; 2]>) -> Self {
        let boxes: Vec<Aabb> =
            moves.iter().map(|ends| Aabb::around(ends.iter().map(|s| s.cc.point))).collect();
        let tree = Bvh::new(&boxes, LEAF);
        let body = Body::new(setup.cutter, &ClPoint { tip: DVec3::ZERO, axis: DVec3::Z });
        // Half a strip would do, were strips told everywhere.
        let strips = moves.iter().flatten().filter_map(|station| station.work.strip);
        let widest = strips.fold(setup.strip, f64::max);
        let wide = (WIDE * widest).min(2.0 * setup.cutter.largest_radius());
        let moves = moves.into_iter().map(|ends| Part::new(setup, &body, ends)).collect();
        Self { setup, body, moves, tree, wide }
    }

    /// All moves, pass after pass.
    pub(super) fn all(&self) -> &[Part] {
        &self.moves
    }

    /// The point at `uv` and the one so far above it along the normal, mm; `None` where there is no normal.
    fn place(&self, uv: Uv, above: f64) -> Option<(DVec3, DVec3)> {
        self.setup.face.at(uv).map(|(jet, n)| (jet.p, jet.p + n * above))
    }

    /// Whether more than `limit` (mm, along the normal) is left at `uv`; where there is no normal, nothing is.
    pub(super) fn leave(&self, uv: Uv, limit: f64) -> bool {
        let is_left = |place| !self.cut(place, self.wide, |k| self.moves.get(k));
        self.place(uv, limit).is_some_and(is_left)
    }

    /// The numbers of the moves that leave less than `limit` (mm, along the normal) at `uv`.
    #[cfg(feature = "flow")]
    pub(super) fn cutters_at(&self, uv: Uv, limit: f64) -> Vec<usize> {
        self.place(uv, limit).map_or_else(Vec::new, |place| self.cutters(place, self.wide))
    }

    /// The numbers of the moves that take away the second of two points, of those that touch no farther than `wide` (mm) from the first.
    pub(super) fn cutters(&self, place: (DVec3, DVec3), wide: f64) -> Vec<usize> {
        let mut cutters = Vec::new();
        let all = |k: usize| self.moves.get(k);
        self.find(place, wide, all, |k| {
            cutters.push(k);
            false
        });
        cutters
    }

    /// How much is left at `uv`, mm along the normal, to a `fine`ness in mm and rather more; `None` where it is as much as `most` (mm).
    #[cfg(any(test, feature = "flow"))]
    pub(super) fn height(&self, uv: Uv, most: f64, fine: f64) -> Option<f64> {
        let (point, _) = self.place(uv, most)?;
        let left = self.around((point, most)).height(uv, most, fine);
        (left < most).then_some(left)
    }

    /// The moves that may leave less than others within `reach` (mm) of `middle`.
    pub(super) fn around(&self, around: (DVec3, f64)) -> Near<'_> {
        self.near(around, self.wide, |k| self.moves.get(k))
    }

    /// Whether what `part` has of one of the moves, by its number, takes away `top`, which stands above `point` on the face. Moves
    /// that touch farther than `wide` (mm) from there are not looked at.
    pub(super) fn cut<'p>(
        &self,
        place: (DVec3, DVec3),
        wide: f64,
        part: impl Fn(usize) -> Option<&'p Part>,
    ) -> bool {
        self.find(place, wide, part, |_| true)
    }

    /// The same, until `is_enough` says so of the number of a move whose part takes it away; whether it did.
    pub(super) fn find<'p>(
        &self,
        (point, top): (DVec3, DVec3),
        wide: f64,
        part: impl Fn(usize) -> Option<&'p Part>,
        mut is_enough: impl FnMut(usize) -> bool,
    ) -> bool {
        // The nearest moves come first: mostly one of them cuts.
        let bound = |node: usize| 1.0 - self.tree.boxes()[node].distance_squared(point) / (wide * wide);
        let mut is_found = |place: usize| {
            let k = self.tree.order()[place] as usize;
            part(k).is_some_and(|part| self.cuts(part, top)) && is_enough(k)
        };
        let found = |mut places: Range<usize>, best| if places.any(&mut is_found) { 1.0 } else { best };
        self.tree.highest(0.0, bound, found) > 0.0
    }

    /// The moves of which `part` has something that may cut within `reach` (mm) of `middle`, asked at once for many places there; those
    /// that touch farther than `wide` (mm) from all of them are left out.
    pub(super) fn near<'p>(
        &self,
        (middle, reach): (DVec3, f64),
        wide: f64,
        part: impl Fn(usize) -> Option<&'p Part>,
    ) -> Near<'_> {
        let far = wide + reach;
        let mut found = Vec::new();
        self.tree.visit_leaves(
            |leaf| leaf.distance_squared(middle) < far * far,
            |leaf, places| {
                for k in self.tree.order()[places].iter().map(|&k| k as usize) {
                    let Some(part) = part(k) else { continue };
                    // From one place to another the distance from a cutter changes by no more than the way between them.
                    let away = part.middle.distance(middle) - part.most;
                    if away <= reach + ROUNDING {
                        found.push((away, (leaf, k)));
                    }
                }
            },
        );
        sort_by_key(&mut found, |(away, (_, k))| (rank(*away), *k as u32));
        Near { moves: self, wide, found: found.into_iter().map(|(_, found)| found).collect() }
    }

    /// A straight move, ready to be asked what it cuts.
    pub(super) fn part(&self, ends: [Station; 2]) -> Part {
        Part::new(self.setup, &self.body, ends)
    }

    /// Whether the cutter takes `point` away on its way along a part.
    pub(super) fn cuts(&self, part: &Part, point: DVec3) -> bool {
        let most = part.most;
        if part.middle.is_clear(point, most) {
            return false;
        }
        let middle = part.middle.distance(point);
        if middle <= 0.0 || middle > most {
            return middle <= 0.0;
        }
        let cutter = self.setup.cutter;
        let away = |t: f64| part.at(cutter, &self.body, t).distance(point);
        // About the place where it comes nearest the distance grows with the square of the way, at least as fast as beside the
        // corner.
        let fine = (2.0 * MISS * self.setup.finish.scallop * cutter.corner_radius).sqrt();
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..THIRDS {
            let way = 2.0 * most * (high - low);
            if way < fine {
                break;
            }
            let (one, two) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            let (at_one, at_two) = (away(one), away(two));
            if at_one <= 0.0 || at_two <= 0.0 {
                return true;
            }
            if at_one.min(at_two) > way {
                return false;
            }
            // The cutter is convex, and so is the distance along a straight way: lines through two of three places hold it from below.
            let whole = low <= 0.0 && high >= 1.0;
            if whole && least([at_one, middle, at_two]) > part.bent {
                return false;
            }
            *(if at_one < at_two { &mut high } else { &mut low }) = if at_one < at_two { two } else { one };
        }
        away(0.0) <= 0.0 || away(1.0) <= 0.0
    }
}

/// The moves that may cut something at places near one another.
pub(super) struct Near<'m> {
    moves: &'m Moves<'m>,
    /// Moves that touch farther than this from a place are not looked at, mm.
    wide: f64,
    /// The leaf of the tree and the number of each, those that reach deepest first.
    found: Vec<(usize, usize)>,
}

impl Near<'_> {
    /// How much is left at `uv`, mm along the normal, to a `fine`ness in mm and rather more; `most` where it is more.
    pub(super) fn height(&self, uv: Uv, most: f64, fine: f64) -> f64 {
        let Self { moves, wide, found } = self;
        let Some((jet, n)) = moves.setup.face.at(uv) else { return 0.0 };
        let mut left = most;
        for &(leaf, k) in found {
            let part = &moves.moves[k];
            let cuts = |height: f64| moves.cuts(part, jet.p + n * height);
            let is_beside = moves.tree.boxes()[leaf].distance_squared(jet.p) < wide * wide;
            if !is_beside || !cuts(left) {
                continue;
            }
            let mut low = 0.0;
            while left - low > fine {
                let middle = 0.5 * (low + left);
                *(if cuts(middle) { &mut left } else { &mut low }) = middle;
            }
        }
        left
    }

    /// As [`Moves::find`] does among all moves.
    pub(super) fn find<'p>(
        &self,
        (point, top): (DVec3, DVec3),
        part: impl Fn(usize) -> Option<&'p Part>,
        mut is_enough: impl FnMut(usize) -> bool,
    ) -> bool {
        let Self { moves, wide, found } = self;
        found.iter().any(|&(leaf, k)| {
            let is_beside = moves.tree.boxes()[leaf].distance_squared(point) < wide * wide;
            is_beside && part(k).is_some_and(|part| moves.cuts(part, top)) && is_enough(k)
        })
    }
}

/// A straight move or a part of one, with what is asked of it first: where the cutter stands half way.
#[derive(Debug, Clone, Copy)]
pub(super) struct Part {
    pub(super) ends: [Station; 2],
    middle: Body,
    /// Nothing near the bottom moves farther than this from where it is half way, mm.
    most: f64,
    /// How far a point's way past the cutter is from straight, mm.
    bent: f64,
}

/// The least that a convex function on 0 to 1 with these values at 1/3, 1/2 and 2/3 may have.
fn least([one, middle, two]: [f64; 3]) -> f64 {
    let between = 2.0 * middle - one.max(two);
    between.min(3.0 * one - 2.0 * middle).min(3.0 * two - 2.0 * middle)
}

impl Part {
    fn new(setup: &Setup, body: &Body, ends: [Station; 2]) -> Self {
        let cutter = setup.cutter;
        let [a, b] = ends.map(|station| station.cl);
        let turn = a.axis.distance(b.axis);
        let lever = cutter.center_radius + 3.0 * cutter.corner_radius;
        let most = 0.5 * (a.tip.distance(b.tip) + turn * lever);
        let part = Self { ends, middle: *body, most, bent: 0.5 * turn * most };
        Self { middle: part.at(cutter, body, 0.5), ..part }
    }

    /// The cutter a share of the way on.
    fn at(&self, cutter: &Cutter, body: &Body, share: f64) -> Body {
        let [a, b] = [&self.ends[0].cl, &self.ends[1].cl];
        let axis = a.axis.lerp(b.axis, share).normalize_or(a.axis);
        body.moved(cutter, &ClPoint { tip: a.tip.lerp(b.tip, share), axis })
    }

    /// Way of the tip, mm.
    pub(super) fn way(&self) -> f64 {
        self.ends[0].cl.tip.distance(self.ends[1].cl.tip)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Cylinder, Face, Field, Side};
    use crate::math::frame::Frame;
    use crate::strategy::trial::{family, leaning};
    use crate::strategy::walk;

    /// Asked for at once, places near one another are cut by the moves that cut each, whether those are near or far.
    #[test]
    fn near_moves_are_all_that_cut() {
        let frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
        let tube = Cylinder::new(DVec3::ZERO, frame, 6.0, [0.0, 1.5], [0.0, 8.0]).unwrap();
        let family = family(Face::new(tube, Side::Front), &leaning(0.1, 0.0), (Field::U, Field::V));
        let lines = (0..30).flat_map(|k| family.lines_of(0.05 * f64::from(k) + 0.02, false));
        let passes: Vec<Pass> = lines.flat_map(|line| walk::passes(&family.setup, &line, false)).collect();
        let moves = Moves::new(&family.setup, passes.iter());
        let part = |k: usize| moves.all().get(k).filter(|_| !k.is_multiple_of(3));
        let (wide, mut most) = (3.0, 0);
        for group in 0..40_usize {
            let place = |i: usize| {
                let uv = Uv::new(0.1 + 0.03 * group as f64 + 0.01 * i as f64, 1.0 + 0.15 * group as f64);
                let (jet, normal) = family.setup.face.at(uv).unwrap();
                (jet.p, jet.p + normal * 0.01)
            };
            let places: Vec<_> = (0..4).map(place).collect();
            let around = Aabb::around(places.iter().flat_map(|&(point, top)| [point, top]));
            let near = moves.near(around.ball(), wide, part);
            assert!(near.found.len() < moves.all().len() / 2);
            for place in places {
                let [mut one, mut all] = [Vec::new(), Vec::new()];
                near.find(place, part, |k| {
                    one.push(k);
                    false
                });
                moves.find(place, wide, part, |k| {
                    all.push(k);
                    false
                });
                one.sort_unstable();
                all.sort_unstable();
                assert_eq!(one, all);
                most = most.max(all.len());
            }
        }
        assert!(most > 2);
    }

    #[test]
    fn what_is_convex_stays_above_what_three_places_say() {
        for k in 0..200 {
            let (at, steep) = (0.01 * f64::from(k) - 0.5, 0.3 + 0.02 * f64::from(k % 7));
            let smooth = |t: f64| 0.2 + steep * (t - at) * (t - at);
            let kinked = |t: f64| 0.2 + steep * (t - at).abs();
            for told in [&smooth as &dyn Fn(f64) -> f64, &kinked] {
                let lowest = (0..=100).map(|i| told(f64::from(i) / 100.0)).fold(f64::INFINITY, f64::min);
                let bound = least([1.0 / 3.0, 0.5, 2.0 / 3.0].map(told));
                assert!(bound <= lowest + 1e-12, "{bound} {lowest} {at}");
            }
        }
    }
}
