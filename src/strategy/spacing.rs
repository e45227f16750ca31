//! How far apart two neighbouring passes may lie.

use super::probe::{Probe, Reach};
use glam::DVec3;

/// The edges of a pass's strips towards one side, as stretches between neighbouring probes.
#[derive(Debug, Clone, Default)]
pub(super) struct Front {
    stretches: Vec<[Corner; 2]>,
    /// Period of the column coordinate, where it has one.
    period: Option<f64>,
}

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
    fn reach(&self, toward: Toward) -> Option<Reach> {
        match (self, toward) {
            (Self::Strip { up, .. }, Toward::Higher) => Some(*up),
            (Self::Strip { down, .. }, Toward::Lower) => Some(*down),
            (Self::Blocked, _) => None,
        }
    }
}

impl Front {
    /// The front of the probed lines towards one side. Where a strip runs over the border or the cutter cannot go the
    /// front has a gap: nothing is asked of a neighbour there.
    pub(super) fn new(lines: &[Vec<Probe>], toward: Toward, period: Option<f64>) -> Self {
        let corner = |probe: &Probe| match probe.reach(toward) {
            Some(Reach::To { level, column, point }) => Some(Corner { column, level, point }),
            Some(Reach::Border) | None => None,
        };
        let stretches = lines
            .iter()
            .flat_map(|line| line.windows(2))
            .filter_map(|w| Some([corner(&w[0])?, corner(&w[1])?]))
            .collect();
        Self { stretches, period }
    }

    /// Whether the front asks nothing of a neighbour.
    pub(super) fn is_empty(&self) -> bool {
        self.stretches.is_empty()
    }

    /// The front with every level raised by `by`.
    #[must_use]
    pub(super) fn raised(&self, by: f64) -> Self {
        let mut raised = self.clone();
        for corner in raised.stretches.iter_mut().flatten() {
            corner.level += by;
        }
        raised
    }

    /// Lowest level of the front.
    pub(super) fn lowest(&self) -> f64 {
        self.stretches.iter().flatten().map(|c| c.level).fold(f64::INFINITY, f64::min)
    }

    /// The level of the front abreast of `corner`, on the stretch nearest to it in space.
    fn level_abreast(&self, corner: &Corner) -> Option<f64> {
        let mut nearest: Option<(f64, f64)> = None;
        let images = match self.period {
            Some(period) => [corner.column, corner.column - period, corner.column + period],
            None => [corner.column; 3],
        };
        for column in &images[..if self.period.is_some() { 3 } else { 1 }] {
            for [a, b] in &self.stretches {
                let width = b.column - a.column;
                let t = (column - a.column) / width;
                if width == 0.0 || !(0.0..=1.0).contains(&t) {
                    continue;
                }
                let away = a.point.lerp(b.point, t).distance_squared(corner.point);
                if nearest.is_none_or(|(d, _)| away < d) {
                    nearest = Some((away, a.level + (b.level - a.level) * t));
                }
            }
        }
        nearest.map(|(_, level)| level)
    }

    /// The widest gap between this front, towards higher levels, and the front `upper` towards lower levels of the next
    /// pass, in units of the field; negative where they overlap everywhere, `None` where they nowhere lie abreast.
    pub(super) fn gap(&self, upper: &Self) -> Option<f64> {
        let from_above = upper
            .stretches
            .iter()
            .flatten()
            .filter_map(|c| self.level_abreast(c).map(|level| c.level - level));
        let from_below = self
            .stretches
            .iter()
            .flatten()
            .filter_map(|c| upper.level_abreast(c).map(|level| level - c.level));
        from_above.chain(from_below).reduce(f64::max)
    }
}
