//! The method of the paper of 2013, step by step: a machining potential, the initial path that is best in it, its
//! neighbours edge to edge, and a new initial path where the neighbours have become too bad.
//!
//! To look at and to learn from: nothing is milled by it. Its neighbours lie about edge to edge, by what strips are to second order;
//! [`crate::strategy::potential_field`] lays them exactly and has what they leave cut too.
//!
//! Source: H. Liu and M. Liu, Tool path planning for high speed milling of sculpture surface with toroidal cutter, 2013, Fig. 5.

use super::place::potential;
use crate::geometry::{Face, FaceGrid, Uv};
use crate::job::error::JobError;
use crate::job::{Shape, Spec};
use crate::monitor::Stage;
use crate::strategy::{PathPoint, Potential, Streamlines, Swept};
use glam::DVec3;
use serde::Serialize;

/// Cells a side of the potential, and of the record of what is done.
const CELLS: usize = 32;
const DONE: usize = 96;
/// New beginnings at most, and passes of one.
const MOST: [usize; 2] = [12, 400];
/// Share of the surface that may be left at the end.
const LEFT: f64 = 0.004;

/// Passes that begin with one initial path.
#[derive(Debug, Clone, Serialize)]
pub struct Family {
    /// In the order in which they are made; the first is the initial path.
    pub paths: Vec<StudiedPath>,
}

/// A path over the surface.
#[derive(Debug, Clone, Serialize)]
pub struct StudiedPath {
    /// Parameters `[u, v]` along it.
    pub uv: Vec<[f64; 2]>,
    /// Length, mm.
    pub length_mm: f64,
    /// Mean width of its strip, eq. (10), mm.
    pub average_mm: f64,
    /// Its efficiency, eq. (11): 1 where it runs along the widest strips everywhere.
    pub efficiency: f64,
}

/// What the method makes of a surface.
#[derive(Debug, Clone, Serialize)]
pub struct Restarts {
    /// In the order in which they begin.
    pub families: Vec<Family>,
    /// Share of the surface that is left, 0 to 1.
    pub left: f64,
}

/// Runs the method on the surface of `spec` with its cutter, rule and scallop height; neighbours stop where the efficiency falls below
/// `threshold` (0 to 1). `None` for a mesh.
pub fn restarts(spec: &Spec, threshold: f64, stage: &Stage) -> Result<Option<Restarts>, JobError> {
    let (Shape::Face(face), _) = spec.source.shape(None)? else { return Ok(None) };
    let part = stage.part("Measuring the potential", 0.0, 0.8);
    let (grid, potential) = potential(spec, &face, CELLS, &part)?;
    let mut ground = Ground::new(&face, &grid, &potential);
    let mut families = Vec::new();
    while families.len() < MOST[0] && ground.left() > LEFT {
        stage.at(0.8 + 0.2 * (1.0 - ground.left()))?;
        let Some(initial) = ground.initial() else { break };
        families.push(ground.family(&initial, threshold));
    }
    stage.at(1.0)?;
    Ok(Some(Restarts { families, left: ground.left() }))
}

/// A surface with its potential, and what is done of it.
struct Ground<'a> {
    face: &'a Face,
    lines: Streamlines<'a>,
    /// Middles of the cells of the record.
    places: Vec<(Uv, DVec3)>,
    done: Vec<bool>,
}

impl<'a> Ground<'a> {
    fn new(face: &'a Face, grid: &'a FaceGrid, potential: &'a Potential) -> Self {
        let domain = face.domain();
        let share = |k: usize| (k as f64 + 0.5) / DONE as f64;
        let place = |k: usize| {
            let uv = domain.at(share(k % DONE), share(k / DONE));
            (uv, face.surface.point(uv))
        };
        let places: Vec<_> = (0..DONE * DONE).map(place).collect();
        Self { face, lines: Streamlines::new(face, grid, potential), done: vec![false; places.len()], places }
    }

    fn left(&self) -> f64 {
        self.done.iter().filter(|done| !**done).count() as f64 / self.done.len() as f64
    }

    fn is_done(&self, uv: Uv) -> bool {
        let domain = self.face.domain();
        let cell = |x: f64, range: &crate::geometry::Range| {
            (((x - range.lo) / range.length() * DONE as f64) as usize).min(DONE - 1)
        };
        self.done[cell(uv.v, &domain.v) * DONE + cell(uv.u, &domain.u)]
    }

    /// The best path to begin with: over ground that is not done, eq. (12) with a guard.
    fn initial(&self) -> Option<Vec<PathPoint>> {
        let best = self.lines.initial(&|uv| self.is_done(uv)).into_iter().next()?;
        Some(best.points[best.fresh].to_vec())
    }

    /// Marks what the strip of `path` covers.
    fn cover(&mut self, path: &[PathPoint]) {
        for ((_, place), done) in self.places.iter().zip(&mut self.done) {
            *done = *done || path.iter().any(|point| point.p.distance(*place) < 0.55 * point.width);
        }
    }

    /// The neighbour of `path` to one side, edge to edge; what of it lies beyond the border or is done is left out.
    fn neighbour(&self, path: &[PathPoint], sign: f64) -> Vec<PathPoint> {
        let mut next: Vec<PathPoint> = Vec::new();
        for (k, point) in path.iter().enumerate() {
            let feed = path[(k + 1).min(path.len() - 1)].p - path[k.saturating_sub(1)].p;
            let across = |uv: Uv| {
                let (_, n) = self.face.at(uv)?;
                n.cross(feed).try_normalize().map(|b| b * sign)
            };
            // Half of the own strip and half of the neighbour's, which is about as wide.
            let step = |uv: Uv, way: f64| self.lines.moved(uv, across(uv)? * way);
            let there = || {
                let middle = step(point.uv, 0.5 * point.width)?;
                let width = self.lines.point(middle, feed)?.width;
                let end = step(middle, 0.5 * width)?;
                self.lines.point(end, feed)
            };
            // Where the path bends to that side by more than it is offset, it would run back.
            let goes_on =
                |point: &PathPoint| next.last().is_none_or(|last| (point.p - last.p).dot(feed) > 0.0);
            next.extend(there().filter(|point| !self.is_done(point.uv)).filter(goes_on));
        }
        next
    }

    fn family(&mut self, initial: &[PathPoint], threshold: f64) -> Family {
        self.cover(initial);
        let mut paths = vec![studied(initial)];
        for sign in [1.0, -1.0] {
            let mut front = initial.to_vec();
            while paths.len() < MOST[1] {
                front = self.neighbour(&front, sign);
                let path = studied(&front);
                // A stub at a corner says nothing about the direction.
                if front.len() < 4 || path.efficiency < threshold {
                    break;
                }
                self.cover(&front);
                paths.push(path);
            }
        }
        Family { paths }
    }
}

fn studied(path: &[PathPoint]) -> StudiedPath {
    let swept = Swept::of(path);
    StudiedPath {
        uv: path.iter().map(|point| [point.uv.u, point.uv.v]).collect(),
        length_mm: swept.length,
        average_mm: swept.average(),
        efficiency: swept.efficiency(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_saddle_is_covered_along_its_widest_strips() {
        let points: Vec<[f64; 3]> = (0..9)
            .map(|k| (f64::from(k / 3) - 1.0, f64::from(k % 3) - 1.0))
            .map(|(x, y)| [20.0 * x, 20.0 * y, 4.0 * (x * x - y * y)])
            .collect();
        let text = format!(
            r#"{{"source": {{"kind": "nurbs", "degrees": [2, 2], "knots_u": [0,0,0,1,1,1], "knots_v": [0,0,0,1,1,1],
                "points_mm": {points:?}}}, "cutter": {{"kind": "bull_nose", "diameter_mm": 10, "corner_radius_mm": 2}},
                "strategy": {{"kind": "flow", "rule": "matched"}}, "tolerance": {{"scallop_mm": 0.05}}}}"#
        );
        let spec = Spec::from_json(&text).unwrap();
        let found = restarts(&spec, 0.9, &Stage::silent()).unwrap().unwrap();
        assert!(found.left < 0.05 && !found.families.is_empty(), "{}", found.left);
        for family in &found.families {
            assert!(family.paths[0].efficiency > 0.97, "{}", family.paths[0].efficiency);
            assert!(family.paths.iter().skip(1).all(|path| path.efficiency >= 0.9));
        }
        // Whoever asks for more has to begin anew more often.
        let strict = restarts(&spec, 0.995, &Stage::silent()).unwrap().unwrap();
        assert!(strict.families.len() >= found.families.len());
    }
}
