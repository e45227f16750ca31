//! About how long the passes of a strategy should be, before any is laid.

use super::coarea::between_borders;
use super::constant_scallop::{Start, away_from, seed};
use super::edge_to_edge::offset;
use super::iso_planar::mean_normal;
use super::potential::Potential;
use super::streamlines::Streamlines;
use super::{Finish, iso_parametric, iso_planar};
use crate::cutter::Cutter;
use crate::geometry::{Along, Face, FaceGrid};
use crate::monitor::{Cancelled, Stage};
use crate::posture::Rule;
use glam::DVec3;

/// Initial paths of the potential field that are looked at: the first does as a rule, and those that wind divide nothing.
const INITIAL: usize = 4;

/// A face on which strategies are compared by the co-area formula, all lengths in mm and without what runs out over borders.
pub struct Promises<'a> {
    face: &'a Face,
    grid: FaceGrid,
    potential: Potential,
    /// About how wide strips are on flat ground.
    flat: f64,
}

impl<'a> Promises<'a> {
    /// For `cutter`, leaning by `rule`.
    pub fn new(
        face: &'a Face,
        cutter: &Cutter,
        rule: &Rule,
        finish: &Finish,
        stage: &Stage,
    ) -> Result<Self, Cancelled> {
        let flat = Potential::flat(cutter, rule, finish);
        let grid = Potential::grid(face, flat);
        let potential = Potential::new((face, &grid), cutter, rule, finish, stage)?;
        Ok(Self { face, grid, potential, flat })
    }

    /// Of [`super::iso_parametric`].
    pub fn iso_parametric(&self, along: Along) -> f64 {
        self.lines(&iso_parametric::fields(along).0.at_nodes(&self.grid))
    }

    /// Of [`super::iso_planar`].
    pub fn iso_planar(&self, angle: f64) -> f64 {
        self.lines(&iso_planar::fields(mean_normal(self.face), angle).0.at_nodes(&self.grid))
    }

    /// Of [`super::constant_scallop`]; `None` from a start that it refuses.
    pub fn constant_scallop(&self, start: &Start) -> Option<f64> {
        let (field, level, _) = seed(self.face, start, self.flat).ok()?;
        let values = field.at_nodes(&self.grid);
        let lines = self.lines(&values);
        Some(self.offset(&values, level).map_or(lines, |offset| offset.min(lines)))
    }

    /// Of [`super::potential_field`], from its initial path over all of the face; `None` where no line divides it.
    pub fn potential_field(&self) -> Option<f64> {
        let lines = Streamlines::new(self.face, &self.grid, &self.potential).initial(&|_| false);
        lines.iter().take(INITIAL).find_map(|line| {
            let points: Vec<DVec3> = line.points.iter().map(|point| point.p).collect();
            let away = away_from(self.face, &self.grid, &points).ok()?;
            self.offset(&away, 0.0)
        })
    }

    fn lines(&self, values: &[f64]) -> f64 {
        between_borders(&self.grid, &self.potential, values)
    }

    fn offset(&self, values: &[f64], level: f64) -> Option<f64> {
        offset((&self.grid, &self.face.domain()), &self.potential, values, level)
            .map(|values| self.lines(&values))
    }
}
