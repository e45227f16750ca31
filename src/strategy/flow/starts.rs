//! Lines that passes could be offset from.

use super::Proposal;
use crate::geometry::{Face, FaceGrid, Field};
use crate::monitor::{Cancelled, Stage};
use crate::strategy::coarea::expected_length;
use crate::strategy::constant_scallop::away_from;
use crate::strategy::edge_to_edge::offset;
use crate::strategy::potential::Potential;
use crate::strategy::streamlines::Streamlines;
use glam::DVec3;

/// Where in the range of a function lines to start from are looked for: its ends are borders, or points.
const STARTS: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// A line from which passes could be offset edge to edge.
#[derive(Debug, Clone)]
pub(super) enum Line {
    /// The one at a level of a function, which another tells places apart on.
    Level { fields: (Field, Field), level: f64 },
    /// The one through these points.
    Through(Vec<DVec3>),
}

/// A line to start from, and what passes offset from it should be like.
pub(super) struct Start {
    pub(super) line: Line,
    /// How long they should be, mm.
    pub(super) expected: f64,
    /// At the nodes of the grid, the function whose level lines they are.
    pub(super) offset: Vec<f64>,
}

/// A face on which lines to start from are looked for.
pub(super) struct Starts<'a> {
    pub(super) face: &'a Face,
    pub(super) grid: &'a FaceGrid,
    pub(super) potential: &'a Potential,
}

impl Starts<'_> {
    /// Level lines of `proposals`; none of a function that goes round the face, whose lines do not divide it.
    pub(super) fn levels(&self, proposals: &[Proposal]) -> Vec<Start> {
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
                found.extend(self.start(Line::Level { fields: fields.clone(), level }, values, level));
            }
        }
        found
    }

    /// Lines along the widest strips.
    pub(super) fn streamlines(&self, stage: &Stage) -> Result<Vec<Start>, Cancelled> {
        let mut found = Vec::new();
        let lines = Streamlines::new(self.face, self.grid, self.potential).initial(&|_| false);
        let count = lines.len() as f64;
        for (k, line) in lines.into_iter().enumerate() {
            stage.at(k as f64 / count)?;
            let points: Vec<DVec3> = line.points.iter().map(|point| point.p).collect();
            // Lines that wind, or run into themselves, divide nothing.
            if let Ok(away) = away_from(self.face, self.grid, &points) {
                found.extend(self.start(Line::Through(points), &away, 0.0));
            }
        }
        Ok(found)
    }

    /// From the `line` of `values` at `level`; `None` where it is a point.
    fn start(&self, line: Line, values: &[f64], level: f64) -> Option<Start> {
        let (grid, domain, potential) = (self.grid, self.face.domain(), self.potential);
        let offset = offset((grid, &domain), potential, values, level)?;
        let expected = expected_length(grid, &domain, potential, &offset);
        Some(Start { line, expected, offset })
    }
}
