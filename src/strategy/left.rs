//! What passes leave at given places, measured by the cutter's own places on their moves.

use super::probe::Setup;
use crate::contact::Body;
use crate::geometry::Uv;
use crate::math::bvh::{Aabb, Bvh};
use crate::toolpath::{ClPoint, Pass, Station};
use glam::DVec3;
use std::ops::Range;

/// Moves in a leaf of the tree.
const LEAF: usize = 4;
/// The share of the scallop that the search along a move for the place where it comes nearest may miss.
const MISS: f64 = 0.005;
/// Steps of that search at most, each to two thirds of the last.
const THIRDS: usize = 40;

/// The moves of passes, found by the places beside them.
pub(super) struct Moves<'a> {
    setup: &'a Setup<'a>,
    moves: Vec<[Station; 2]>,
    tree: Bvh,
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
        Self { setup, moves, tree }
    }

    /// All moves, pass after pass.
    pub(super) fn all(&self) -> &[[Station; 2]] {
        &self.moves
    }

    /// Whether more than `limit` (mm, along the normal) is left at `uv`; where there is no normal, nothing is.
    pub(super) fn leave(&self, uv: Uv, limit: f64) -> bool {
        let Some((jet, n)) = self.setup.face.at(uv) else { return false };
        // What a cutter cuts is no farther from where it touches.
        let wide = 2.0 * self.setup.cutter.largest_radius();
        !self.cut((jet.p, jet.p + n * limit), wide, |k| self.moves.get(k))
    }

    /// Whether what `part` has of one of the moves, by its number, takes away `top`, which stands above `point` on the face. Moves
    /// that touch farther than `wide` (mm) from there are not looked at.
    pub(super) fn cut<'p>(
        &self,
        place: (DVec3, DVec3),
        wide: f64,
        part: impl Fn(usize) -> Option<&'p [Station; 2]>,
    ) -> bool {
        self.find(place, wide, part, |_| true)
    }

    /// The same, until `is_enough` says so of the number of a move whose part takes it away; whether it did.
    pub(super) fn find<'p>(
        &self,
        (point, top): (DVec3, DVec3),
        wide: f64,
        part: impl Fn(usize) -> Option<&'p [Station; 2]>,
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

    /// Whether the cutter takes `point` away on its way from one station to the next.
    pub(super) fn cuts(&self, [a, b]: &[Station; 2], point: DVec3) -> bool {
        let cutter = self.setup.cutter;
        let away = |t: f64| {
            let axis = a.cl.axis.lerp(b.cl.axis, t).normalize_or(a.cl.axis);
            Body::new(cutter, &ClPoint { tip: a.cl.tip.lerp(b.cl.tip, t), axis }).distance(point)
        };
        // Nothing near the bottom moves farther than this from where it is half way.
        let turn = a.cl.axis.distance(b.cl.axis);
        let lever = cutter.center_radius + 3.0 * cutter.corner_radius;
        let most = 0.5 * (a.cl.tip.distance(b.cl.tip) + turn * lever);
        let middle = away(0.5);
        if middle <= 0.0 || middle > most {
            return middle <= 0.0;
        }
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
            *(if at_one < at_two { &mut high } else { &mut low }) = if at_one < at_two { two } else { one };
        }
        away(0.0) <= 0.0 || away(1.0) <= 0.0
    }
}
