//! Short passes for what all others leave: beside borders that lines run into aslant, and along edges that bend much tighter
//! than strips are wide.

use super::family::{Candidate, Family};
use super::left::Moves;
use super::probe::Probe;
use crate::geometry::{IsoLine, Uv, Zone};
use crate::monitor::{Cancelled, Stage};
use crate::toolpath::Pass;
use glam::DVec3;

/// What may be left above the limit, as a share of it, before a pass is worth it: passes are spaced to just the limit.
const ABOVE: f64 = 0.01;
/// Cells from a border that are looked at more closely, and how many parts a side of each then has.
const RIM: usize = 3;
const FINER: usize = 4;
/// Where normals across a cell have a lower cosine than this (11°), it bends much.
const BENT: f64 = 0.98;
/// Places nearer to each other than this belong together, in strips.
const TOGETHER: f64 = 0.55;
/// How far a short pass goes beyond what it is for, in strips.
const LONGER: f64 = 0.7;
/// Levels, in strips of the family, that one short pass takes care of.
const DEEP: f64 = 0.8;
/// Levels beside that of a spot, in the same, at which a line is looked for if it has none there: in a corner it is a point.
const ASIDE: [f64; 7] = [0.0, 0.1, -0.1, 0.2, -0.2, 0.35, -0.35];

impl Family<'_> {
    /// The places all over the face, and those of `others`, where `passes` leave more than the limit, outside of `beyond`.
    pub(super) fn left<'p>(
        &self,
        passes: impl Iterator<Item = &'p Pass>,
        others: &[Uv],
        beyond: &Zone,
        stage: &Stage,
    ) -> Result<Vec<Uv>, Cancelled> {
        let moves = Moves::new(&self.setup, passes);
        let limit = (1.0 + ABOVE) * self.setup.finish.scallop;
        let places = [self.places(), others.to_vec()].concat();
        let is_left = |uv: Uv| {
            !beyond.contains(self.setup.face.surface.point(uv))
                && moves.leave(uv, limit)
                && self.setup.probe(uv, false) != Probe::Blocked
        };
        let left = stage.map(places.len(), |k| is_left(places[k]))?;
        Ok(places.iter().zip(left).filter(|(_, left)| *left).map(|(&uv, _)| uv).collect())
    }

    /// Short lines, with what the cutter does on them, through the places `left`.
    pub(super) fn short_lines(&self, left: Vec<Uv>, stage: &Stage) -> Result<Vec<Candidate>, Cancelled> {
        let mut found = Vec::new();
        for spot in self.spots(left) {
            self.add_lines(&spot, &mut found, stage)?;
        }
        Ok(found)
    }

    /// Places all over the face, half a strip apart, and closer beside its borders and where it bends much.
    fn places(&self) -> Vec<Uv> {
        let grid = self.lines.grid();
        let ((nu, nv), domain) = (grid.size(), self.setup.face.domain());
        let is_rim = |k: usize, count: usize, periodic: bool| !periodic && (k < RIM || k + 1 + RIM >= count);
        let normals: Vec<Option<DVec3>> = (0..nu * nv)
            .map(|k| self.setup.face.at(grid.uv(k % nu, k / nu)).map(|(_, normal)| normal))
            .collect();
        let is_bent = |i: usize, j: usize| {
            let [a, b, c, d] = [(0, 0), (1, 1), (1, 0), (0, 1)].map(|(p, q)| normals[(j + q) * nu + i + p]);
            let turns = |a: Option<DVec3>, b| a.zip(b).is_none_or(|(a, b): (DVec3, _)| a.dot(b) < BENT);
            turns(a, b) || turns(c, d)
        };
        let mut places = Vec::new();
        for j in 0..nv - 1 {
            for i in 0..nu - 1 {
                let rim = is_rim(i, nu, domain.u.periodic) || is_rim(j, nv, domain.v.periodic);
                let parts = if rim || is_bent(i, j) { FINER } else { 1 };
                let (low, high) = (grid.uv(i, j), grid.uv(i + 1, j + 1));
                let at = |a: f64, b: f64, k: usize| a + (b - a) * k as f64 / parts as f64;
                // Cells share their corners.
                let side = if i + 2 == nu || j + 2 == nv { parts + 1 } else { parts };
                places.extend(
                    (0..side * side)
                        .map(|k| Uv::new(at(low.u, high.u, k % side), at(low.v, high.v, k / side))),
                );
            }
        }
        places
    }

    /// The places in groups that hang together, with their points.
    fn spots(&self, left: Vec<Uv>) -> Vec<Vec<(Uv, DVec3)>> {
        let near = TOGETHER * self.setup.strip;
        let mut open: Vec<(Uv, DVec3)> =
            left.into_iter().map(|uv| (uv, self.setup.face.surface.point(uv))).collect();
        let mut spots = Vec::new();
        while let Some(first) = open.pop() {
            let mut spot = vec![first];
            let mut next = 0;
            while next < spot.len() {
                let here: DVec3 = spot[next].1;
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

    /// Appends pieces of lines through `spot`, as many as its levels need.
    fn add_lines(
        &self,
        spot: &[(Uv, DVec3)],
        found: &mut Vec<Candidate>,
        stage: &Stage,
    ) -> Result<(), Cancelled> {
        let levels = || spot.iter().map(|&(uv, p)| self.setup.field.value(uv, p));
        let low = levels().fold(f64::INFINITY, f64::min);
        let high = levels().fold(f64::NEG_INFINITY, f64::max);
        let count = ((high - low) / (DEEP * self.nominal)).floor() + 1.0;
        for i in 0..count as usize {
            let level = low + (high - low) * (i as f64 + 0.5) / count;
            let pieces = ASIDE
                .into_iter()
                .map(|aside| self.pieces(level + aside * self.nominal, spot))
                .find(|pieces| !pieces.is_empty());
            if let Some(pieces) = pieces {
                let level = pieces[0].level;
                found.push(self.probed(level, pieces, false, &stage.quiet())?);
            }
        }
        Ok(())
    }

    /// The pieces of the lines of `level` beside some place of the `spot`.
    fn pieces(&self, level: f64, spot: &[(Uv, DVec3)]) -> Vec<IsoLine> {
        let near = LONGER * self.setup.strip;
        let is_near = |uv: &Uv| {
            let here = self.setup.face.surface.point(*uv);
            spot.iter().any(|(_, p)| p.distance_squared(here) < near * near)
        };
        let mut pieces = Vec::new();
        let (low, high) = self.lines.range();
        if !(low..=high).contains(&level) {
            return Vec::new();
        }
        for line in self.lines.lines(level) {
            for run in line.nodes.chunk_by(|a, b| is_near(a) && is_near(b)) {
                if run.len() > 1 {
                    pieces.push(IsoLine { level: line.level, nodes: run.to_vec(), closed: false });
                }
            }
        }
        pieces
    }
}
