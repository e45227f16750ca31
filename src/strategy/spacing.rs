//! How far apart two neighbouring passes may lie.

use super::probe::{Probe, Reach};
use crate::math::order::sort_numbers;
use glam::DVec3;

/// The edges of a pass's strips towards one side, as stretches between neighbouring probes.
#[derive(Debug, Clone, Default)]
pub(super) struct Front {
    stretches: Vec<Stretch>,
    /// Period of the column coordinate, where it has one.
    period: Option<f64>,
    /// Where lines may bend so much that edges on the inside cross: which way is out, and how far apart, mm, two pieces abreast
    /// may lie to belong together.
    folds: Option<(Toward, f64)>,
}

/// A piece of a front between neighbouring probes.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    corners: [Corner; 2],
    /// How far the piece counts beyond its ends, as a share of its length: an edge at the very end of a line may lie a
    /// little before or behind the end of its neighbour's.
    overhang: [f64; 2],
}

impl Stretch {
    /// A way, mm, as a share of its length.
    fn share(&self, way: f64) -> f64 {
        let [a, b] = self.corners;
        way / a.point.distance(b.point).max(f64::MIN_POSITIVE)
    }
}

/// Least overhang at the ends of a line.
const END: f64 = 0.5;
/// Overhang of a line that bends freely, in strips.
const BEYOND: f64 = 0.5;

/// A corner of a front.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Corner {
    column: f64,
    level: f64,
    point: DVec3,
}

/// Which edge of a strip.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Toward {
    Higher,
    Lower,
}

impl Probe {
    /// How far the strip reaches to that side; `None` where the cutter cannot go.
    pub(super) fn reach(&self, toward: Toward) -> Option<Reach> {
        match (self, toward) {
            (Self::Strip { up, .. }, Toward::Higher) => Some(*up),
            (Self::Strip { down, .. }, Toward::Lower) => Some(*down),
            (Self::Blocked, _) => None,
        }
    }

    /// How many levels the strip is deep; `None` where not both of its edges are on the face.
    pub(super) fn depth(&self) -> Option<f64> {
        match self {
            Self::Strip { up: Reach::To { level: up, .. }, down: Reach::To { level: down, .. } } => {
                (up > down).then_some(up - down)
            }
            _ => None,
        }
    }
}

impl Front {
    /// The front of the probed lines towards one side, each of which goes on for so far, mm, beyond its first and its last
    /// probe. Where a strip runs over the border the front is infinitely far
    /// out; where the cutter cannot go it has a gap.
    pub(super) fn new(
        lines: &[Vec<Probe>],
        beyond: &[[f64; 2]],
        toward: Toward,
        period: Option<f64>,
    ) -> Self {
        let outside = match toward {
            Toward::Higher => f64::INFINITY,
            Toward::Lower => f64::NEG_INFINITY,
        };
        let corner = |probe: &Probe| match probe.reach(toward)? {
            Reach::To { level, column, point, .. } => Some(Corner { column, level, point }),
            Reach::Border { column, point } => Some(Corner { column, level: outside, point }),
            Reach::Aside => None,
        };
        let stretch = |a: Corner, b: Corner| {
            // Between an edge and the border it runs over, the edge's own level is the safe one.
            let level = |own: f64, other: f64| if own.is_finite() { own } else { other };
            [Corner { level: level(a.level, b.level), ..a }, Corner { level: level(b.level, a.level), ..b }]
        };
        let mut stretches = Vec::new();
        for (line, beyond) in lines.iter().zip(beyond) {
            let is_known = |i: &usize| corner(&line[*i]).is_some() && corner(&line[*i + 1]).is_some();
            let count = line.len().saturating_sub(1);
            let (first, last) = ((0..count).find(is_known), (0..count).rev().find(is_known));
            // Passes run out where they leave a border, and not where the cutter cannot go.
            let runs_out = |probes: &[Probe]| probes.iter().all(|probe| *probe != Probe::Blocked);
            let ends = [first.filter(|&i| runs_out(&line[..i])), last.filter(|&i| runs_out(&line[i + 2..]))];
            for (i, w) in line.windows(2).enumerate() {
                if let (Some(a), Some(b)) = (corner(&w[0]), corner(&w[1])) {
                    let mut stretch = Stretch { corners: stretch(a, b), overhang: [0.0; 2] };
                    for (k, end) in ends.into_iter().enumerate() {
                        if end == Some(i) {
                            stretch.overhang[k] = stretch.share(beyond[k]).max(END);
                        }
                    }
                    stretches.push(stretch);
                }
            }
        }
        Self { stretches, period, folds: None }
    }

    /// The front of lines that bend freely, whose strips on flat ground are so wide, mm: where they bend it folds, and its
    /// outermost piece counts; and at their ends it goes on for a part of a strip, since borders cut lines aslant.
    #[must_use]
    pub(super) fn bending(mut self, toward: Toward, strip: f64) -> Self {
        for stretch in &mut self.stretches {
            let beyond = stretch.share(BEYOND * strip);
            stretch.overhang.iter_mut().filter(|o| **o > 0.0).for_each(|o| *o = o.max(beyond));
        }
        self.folds = Some((toward, strip));
        self
    }

    /// The front with every level raised by `by`.
    #[must_use]
    pub(super) fn raised(&self, by: f64) -> Self {
        let mut raised = self.clone();
        for corner in raised.stretches.iter_mut().flat_map(|s| &mut s.corners) {
            corner.level += by;
        }
        raised
    }

    /// The level of the front abreast of `corner`, on the stretch nearest to it in space; or, where the front folds, the
    /// outermost one there.
    fn level_abreast(&self, corner: &Corner) -> Option<f64> {
        let mut nearest: Option<(f64, f64)> = None;
        self.each_abreast(corner, |away, level| {
            if nearest.is_none_or(|(d, _)| away < d) {
                nearest = Some((away, level));
            }
        });
        let (Some((toward, reach)), Some((away, level))) = (self.folds, nearest) else {
            return nearest.map(|(_, level)| level);
        };
        let limit = (away.sqrt() + reach) * (away.sqrt() + reach);
        let mut outermost = level;
        self.each_abreast(corner, |away, level| {
            if away <= limit {
                outermost =
                    if toward == Toward::Higher { outermost.max(level) } else { outermost.min(level) };
            }
        });
        Some(outermost)
    }

    /// Tells square of the distance and level of every stretch abreast of `corner`.
    fn each_abreast(&self, corner: &Corner, mut tell: impl FnMut(f64, f64)) {
        let images = match self.period {
            Some(period) => [corner.column, corner.column - period, corner.column + period],
            None => [corner.column; 3],
        };
        for column in &images[..if self.period.is_some() { 3 } else { 1 }] {
            for Stretch { corners: [a, b], overhang } in &self.stretches {
                let width = b.column - a.column;
                let t = (column - a.column) / width;
                if width == 0.0 || !(-overhang[0]..=1.0 + overhang[1]).contains(&t) {
                    continue;
                }
                let away = a.point.lerp(b.point, t).distance_squared(corner.point);
                // Beyond an end of its line a strip is about as wide as at it.
                let t = t.clamp(0.0, 1.0);
                let level = if a.level == b.level { a.level } else { a.level + (b.level - a.level) * t };
                tell(away, level);
            }
        }
    }

    /// Whether another piece of the front lies farther out abreast of the point with this level and column.
    pub(super) fn is_behind(&self, level: f64, column: f64, point: DVec3) -> bool {
        let Some((toward, _)) = self.folds else { return false };
        let outermost = self.level_abreast(&Corner { column, level, point });
        outermost.is_some_and(|out| if toward == Toward::Higher { out > level } else { out < level })
    }

    /// The level of the front abreast of the point with this level and column.
    pub(super) fn abreast(&self, level: f64, column: f64, point: DVec3) -> Option<f64> {
        self.level_abreast(&Corner { column, level, point })
    }

    /// The gaps between this front, towards higher levels, and the front `upper` towards lower levels of the next pass.
    pub(super) fn gaps(&self, upper: &Self) -> Gaps {
        let from_above = upper
            .stretches
            .iter()
            .flat_map(|s| &s.corners)
            .filter(|c| c.level.is_finite() && !upper.is_behind(c.level, c.column, c.point))
            .filter_map(|c| self.level_abreast(c).map(|level| c.level - level));
        let from_below = self
            .stretches
            .iter()
            .flat_map(|s| &s.corners)
            .filter(|c| c.level.is_finite() && !self.is_behind(c.level, c.column, c.point))
            .filter_map(|c| upper.level_abreast(c).map(|level| level - c.level));
        let mut sorted: Vec<f64> = from_above.chain(from_below).collect();
        sort_numbers(&mut sorted);
        Gaps { sorted }
    }
}

/// The gaps between the strips of two neighbouring passes, column by column, in units of the field; negative where
/// they overlap.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Gaps {
    sorted: Vec<f64>,
}

impl Gaps {
    /// All of them, the widest last; of fronts that were given the wrong way round with the `sign` −1.
    #[cfg(feature = "flow")]
    pub(super) fn sorted(&self, sign: f64) -> Vec<f64> {
        let mut sorted: Vec<f64> = self.sorted.iter().map(|gap| sign * gap).collect();
        sort_numbers(&mut sorted);
        sorted
    }

    /// The gap that all but the share `open` of the columns keep below; `None` where nothing lies abreast. Columns where a strip runs over
    /// a border count only where all do: they overlap without end, and tell nothing of the others.
    pub(super) fn all_but(&self, open: f64) -> Option<f64> {
        let last = self.sorted.len().checked_sub(1)?;
        let first = self.sorted.partition_point(|gap| *gap == f64::NEG_INFINITY).min(last);
        Some(self.sorted[first + ((1.0 - open) * (last - first) as f64).floor() as usize])
    }
}
