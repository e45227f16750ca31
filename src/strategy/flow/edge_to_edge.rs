//! Functions whose level lines lie edge to edge from one level line of another function on.

use super::Proposal;
use crate::geometry::{Domain, Face, FaceGrid, Field, Fronts, triangles};
use crate::monitor::{Cancelled, Stage};
use crate::strategy::coarea::expected_length;
use crate::strategy::constant_scallop::away_from;
use crate::strategy::potential::Potential;
use crate::strategy::streamlines::Streamlines;
use glam::DVec3;

/// Where in the range of a function lines to start from are looked for: its ends are borders, or points.
const STARTS: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];
/// Rounds in which directions and widths come to agree.
const ROUNDS: usize = 4;

/// A line from which passes could be offset edge to edge.
#[derive(Debug, Clone)]
pub(super) enum Line {
    /// The one at a level of a function, which another tells places apart on.
    Level { fields: (Field, Field), level: f64 },
    /// The one through these points.
    Through(Vec<DVec3>),
}

/// A face on which lines to start from are looked for.
pub(super) struct Starts<'a> {
    pub(super) face: &'a Face,
    pub(super) grid: &'a FaceGrid,
    pub(super) potential: &'a Potential,
}

impl Starts<'_> {
    /// Level lines of `proposals`, each after how long the passes offset from it should be, mm; none of a function that goes round the
    /// face, whose lines do not divide it.
    pub(super) fn levels(&self, proposals: &[Proposal]) -> Vec<(f64, Line)> {
        let mut found = Vec::new();
        let domain = self.face.domain();
        let goes_round = |field: &Field| match field {
            Field::U => domain.u.periodic,
            Field::V => domain.v.periodic,
            Field::Along(_) | Field::Given(_) => false,
        };
        for Proposal { fields, values, .. } in proposals.iter().filter(|p| !goes_round(&p.fields.0)) {
            let low = values.iter().copied().fold(f64::INFINITY, f64::min);
            let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            for level in STARTS.map(|share| low + (high - low) * share) {
                if let Some(expected) = self.expected(values, level) {
                    found.push((expected, Line::Level { fields: fields.clone(), level }));
                }
            }
        }
        found
    }

    /// Lines along the widest strips, each after how long the passes offset from it should be, mm.
    pub(super) fn streamlines(&self, stage: &Stage) -> Result<Vec<(f64, Line)>, Cancelled> {
        let mut found = Vec::new();
        let lines = Streamlines::new(self.face, self.grid, self.potential).initial(&|_| false);
        let count = lines.len() as f64;
        for (k, line) in lines.into_iter().enumerate() {
            stage.at(k as f64 / count)?;
            let points: Vec<DVec3> = line.points.iter().map(|point| point.p).collect();
            // Lines that wind, or run into themselves, divide nothing.
            let away = away_from(self.face, self.grid, &points);
            if let Some(expected) = away.ok().and_then(|away| self.expected(&away, 0.0)) {
                found.push((expected, Line::Through(points)));
            }
        }
        Ok(found)
    }

    /// How long passes offset from the line of `values` at `level` should be, mm; `None` where it is a point.
    fn expected(&self, values: &[f64], level: f64) -> Option<f64> {
        let domain = self.face.domain();
        let values = offset((self.grid, &domain), self.potential, values, level)?;
        Some(expected_length(self.grid, &domain, self.potential, &values))
    }
}

/// The function that is 0 on the line of `values` at `level` and rises by about one over every strip; `None` where that line is a
/// point.
fn offset(
    (grid, domain): (&FaceGrid, &Domain),
    potential: &Potential,
    values: &[f64],
    level: f64,
) -> Option<Vec<f64>> {
    let fronts = Fronts::new(domain, grid);
    let points = grid.points();
    let away: Vec<f64> = values.iter().map(|value| value - level).collect();
    // How far the line is along the edges that it crosses.
    let crossing = |k: usize| {
        let crossed = fronts.around(k).into_iter().flatten().filter(|&n| away[k] * away[n] <= 0.0);
        let way = |n: usize| match away[k].abs() {
            0.0 => 0.0,
            here => here / (here + away[n].abs()) * points[k].distance(points[n]),
        };
        crossed.map(way).reduce(f64::min).map(|way| (k, way))
    };
    let near: Vec<(usize, f64)> = (0..away.len()).filter_map(crossing).collect();
    let on = || near.iter().filter(|(_, way)| *way <= 0.0).count();
    // At its ends a function is a border, along all of one side, or a point.
    let is_end = away.iter().all(|a| *a <= 0.0) || away.iter().all(|a| *a >= 0.0);
    if is_end && on() < 3 {
        return None;
    }
    let mut offset = away.clone();
    for _ in 0..ROUNDS {
        let slowness: Vec<f64> = widths(grid, potential, &offset).into_iter().map(f64::recip).collect();
        let seeds: Vec<(usize, f64)> = near.iter().map(|&(k, way)| (k, way * slowness[k])).collect();
        let times = fronts.times(&seeds, &slowness);
        offset =
            times.iter().zip(&away).map(|(time, away)| if *away < 0.0 { -time } else { *time }).collect();
    }
    offset.iter().all(|value| value.is_finite()).then_some(offset)
}

/// The widths of strips at the nodes for feed along the level lines of `values`, mm.
fn widths(grid: &FaceGrid, potential: &Potential, values: &[f64]) -> Vec<f64> {
    let mut feeds = vec![DVec3::ZERO; values.len()];
    for triangle in triangles(grid) {
        let feed = triangle.normal.cross(triangle.gradient(values));
        if feed.is_finite() {
            triangle.nodes.iter().for_each(|&k| feeds[k] += feed);
        }
    }
    let widths: Vec<Option<f64>> =
        feeds.iter().enumerate().map(|(k, feed)| potential.width(k, *feed).filter(|w| *w > 0.0)).collect();
    let (sum, count) = widths.iter().flatten().fold((0.0, 0.0), |(sum, count), w| (sum + w, count + 1.0));
    let mean: f64 = if count > 0.0 { sum / count } else { 1.0 };
    widths.into_iter().map(|width| width.unwrap_or(mean)).collect()
}
