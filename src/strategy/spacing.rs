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
}

/// A piece of a front between neighbouring probes.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    corners: [Corner; 2],
    /// How far the piece counts beyond its ends, as a share of its length: an edge at the very end of a line may lie a
    /// little before or behind the end of its neighbour's.
    overhang: [f64; 2],
}

/// Overhang at the ends of a line.
const END: f64 = 0.5;

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
}

impl Front {
    /// The front of the probed lines towards one side. Where a strip runs over the border the front is infinitely far
    /// out; where the cutter cannot go it has a gap.
    pub(super) fn new(lines: &[Vec<Probe>], toward: Toward, period: Option<f64>) -> Self {
        let outside = match toward {
            Toward::Higher => f64::INFINITY,
            Toward::Lower => f64::NEG_INFINITY,
        };
        let corner = |probe: &Probe| {
            Some(match probe.reach(toward)? {
                Reach::To { level, column, point } => Corner { column, level, point },
                Reach::Border { column, point } => Corner { column, level: outside, point },
            })
        };
        let stretch = |a: Corner, b: Corner| {
            // Between an edge and the border it runs over, the edge's own level is the safe one.
            let level = |own: f64, other: f64| if own.is_finite() { own } else { other };
            [Corner { level: level(a.level, b.level), ..a }, Corner { level: level(b.level, a.level), ..b }]
        };
        let mut stretches = Vec::new();
        for line in lines {
            let last = line.len().saturating_sub(2);
            for (i, w) in line.windows(2).enumerate() {
                if let (Some(a), Some(b)) = (corner(&w[0]), corner(&w[1])) {
                    let overhang = [i == 0, i == last].map(|end| if end { END } else { 0.0 });
                    stretches.push(Stretch { corners: stretch(a, b), overhang });
                }
            }
        }
        Self { stretches, period }
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

    /// The level of the front abreast of `corner`, on the stretch nearest to it in space.
    fn level_abreast(&self, corner: &Corner) -> Option<f64> {
        let mut nearest: Option<(f64, f64)> = None;
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
                if nearest.is_none_or(|(d, _)| away < d) {
                    let level = if a.level == b.level { a.level } else { a.level + (b.level - a.level) * t };
                    nearest = Some((away, level));
                }
            }
        }
        nearest.map(|(_, level)| level)
    }

    /// The gaps between this front, towards higher levels, and the front `upper` towards lower levels of the next pass.
    pub(super) fn gaps(&self, upper: &Self) -> Gaps {
        let from_above = upper
            .stretches
            .iter()
            .flat_map(|s| &s.corners)
            .filter(|c| c.level.is_finite())
            .filter_map(|c| self.level_abreast(c).map(|level| c.level - level));
        let from_below = self
            .stretches
            .iter()
            .flat_map(|s| &s.corners)
            .filter(|c| c.level.is_finite())
            .filter_map(|c| upper.level_abreast(c).map(|level| level - c.level));
        let mut sorted: Vec<f64> = from_above.chain(from_below).collect();
        sort_numbers(&mut sorted);
        Gaps { sorted }
    }

    /// Whether the front is abreast of the point with this level and column, and then reaches it or beyond.
    pub(super) fn meets(&self, level: f64, column: f64, point: DVec3, toward: Toward) -> Option<bool> {
        let abreast = self.level_abreast(&Corner { column, level, point })?;
        Some(match toward {
            Toward::Higher => abreast >= level,
            Toward::Lower => abreast <= level,
        })
    }
}

/// The gaps between the strips of two neighbouring passes, column by column, in units of the field; negative where
/// they overlap.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Gaps {
    sorted: Vec<f64>,
}

impl Gaps {
    /// The gap that all but the share `open` of the columns keep below; `None` where nothing lies abreast.
    pub(super) fn all_but(&self, open: f64) -> Option<f64> {
        let last = self.sorted.len().checked_sub(1)?;
        Some(self.sorted[((1.0 - open) * last as f64).floor() as usize])
    }
}
