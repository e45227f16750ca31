//! The method of the paper of 2013 as it stands there, step by step: a machining potential, the initial path that is best in it, its
//! neighbours edge to edge, and a new initial path where the neighbours have become too bad.
//!
//! To look at and to learn from: nothing is milled by it. Strategies that are shipped keep a scallop limit, which this does not prove.
//!
//! Source: H. Liu and M. Liu, Tool path planning for high speed milling of sculpture surface with toroidal cutter, 2013, eqs. (10) to
//! (12) and Fig. 5; with a guard of the length, without which (12) favours stubs.

use super::place::potential;
use crate::geometry::{Face, FaceGrid, Uv};
use crate::job::error::JobError;
use crate::job::{Shape, Spec};
use crate::monitor::Stage;
use crate::strategy::Potential;
use glam::DVec3;
use serde::Serialize;

/// Cells a side of the potential, of the record of what is done, and of the places from which initial paths are tried.
const CELLS: usize = 32;
const DONE: usize = 96;
const TRIED: usize = 6;
/// Initial paths shorter than this share of the longest candidate are no candidates: the guard of the length.
const SHORTEST: f64 = 0.6;
/// New beginnings at most, and passes of one.
const MOST: [usize; 2] = [12, 400];
/// Share of the surface that may be left at the end.
const LEFT: f64 = 0.004;
/// A step along a path, in strips.
const STEP: f64 = 0.35;

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
        families.push(ground.family(initial, threshold));
    }
    stage.at(1.0)?;
    Ok(Some(Restarts { families, left: ground.left() }))
}

/// A surface with its potential, and what is done of it.
struct Ground<'a> {
    face: &'a Face,
    grid: &'a FaceGrid,
    potential: &'a Potential,
    /// Middles of the cells of the record.
    places: Vec<(Uv, DVec3)>,
    done: Vec<bool>,
}

/// A point of a path and what its strip is like there.
#[derive(Clone, Copy)]
struct Point {
    uv: Uv,
    p: DVec3,
    width: f64,
    widest: f64,
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
        Self { face, grid, potential, done: vec![false; places.len()], places }
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

    /// The nodes of the potential around `uv` and their weights.
    fn around(&self, uv: Uv) -> [(usize, f64); 4] {
        let (i, j) = self.grid.cell_at(uv);
        let (low, high) = (self.grid.uv(i, j), self.grid.uv(i + 1, j + 1));
        let (s, t) = ((uv.u - low.u) / (high.u - low.u), (uv.v - low.v) / (high.v - low.v));
        let nu = self.grid.size().0;
        [
            (j * nu + i, (1.0 - s) * (1.0 - t)),
            (j * nu + i + 1, s * (1.0 - t)),
            ((j + 1) * nu + i, (1.0 - s) * t),
            ((j + 1) * nu + i + 1, s * t),
        ]
    }

    /// The direction of the widest strip at `uv` on the side of `along`: of the corners around it, each turned to that side.
    fn best(&self, uv: Uv, along: DVec3) -> Option<DVec3> {
        let mut sum = DVec3::ZERO;
        for (k, weight) in self.around(uv) {
            if let Some((d, _)) = self.potential.best(k) {
                sum += d * weight * if d.dot(along) < 0.0 { -1.0 } else { 1.0 };
            }
        }
        sum.try_normalize()
    }

    fn point(&self, uv: Uv, feed: DVec3) -> Option<Point> {
        let (mut width, mut widest) = (0.0, 0.0);
        for (k, weight) in self.around(uv) {
            widest += weight * self.potential.best(k)?.1[0];
            width += weight * self.potential.width(k, feed)?;
        }
        Some(Point { uv, p: self.face.surface.point(uv), width, widest })
    }

    /// `uv` moved by `way` (mm, tangent); `None` beyond the border.
    fn moved(&self, uv: Uv, way: DVec3) -> Option<Uv> {
        let (du, dv) = self.face.jet(uv).pull_back(way)?;
        let next = Uv::new(uv.u + du, uv.v + dv);
        self.face.domain().contains(next).then_some(next)
    }

    /// Along the widest strips from `from` both ways, to the borders or to what is done.
    fn traced(&self, from: Uv) -> Option<Vec<Point>> {
        let (nearest, _) =
            self.around(from).into_iter().fold((0, -1.0), |a, b| if b.1 > a.1 { b } else { a });
        let (start, _) = self.potential.best(nearest)?;
        let half = |sign: f64| {
            let (mut uv, mut along) = (from, start * sign);
            let mut points = Vec::new();
            while points.len() < 2000 {
                let Some(next) = self.best(uv, along) else { break };
                along = next;
                let Some(point) = self.point(uv, along) else { break };
                points.push(point);
                let Some(next) = self.moved(uv, along * STEP * point.width) else { break };
                if self.is_done(next) {
                    break;
                }
                uv = next;
            }
            points
        };
        let mut all = half(-1.0);
        all.reverse();
        all.extend(half(1.0).into_iter().skip(1));
        (all.len() > 3).then_some(all)
    }

    /// The candidate with the widest mean strip among those that are not short: eq. (12) with a guard.
    fn initial(&self) -> Option<(StudiedPath, Vec<Point>)> {
        let domain = self.face.domain();
        let share = |k: usize| (k as f64 + 0.5) / TRIED as f64;
        let mut seeds: Vec<Uv> =
            (0..TRIED * TRIED).map(|k| domain.at(share(k % TRIED), share(k / TRIED))).collect();
        seeds.retain(|uv| !self.is_done(*uv));
        if seeds.is_empty() {
            seeds.extend(
                self.places.iter().zip(&self.done).find(|(_, done)| !**done).map(|(place, _)| place.0),
            );
        }
        let traced = seeds.into_iter().filter_map(|uv| self.traced(uv));
        let candidates: Vec<_> = traced.map(|path| (measured(&path), path)).collect();
        let longest = candidates.iter().map(|(path, _)| path.length_mm).fold(0.0, f64::max);
        let long = candidates.into_iter().filter(|(path, _)| path.length_mm >= SHORTEST * longest);
        // Of equals the first.
        long.reduce(|best, next| if next.0.average_mm > best.0.average_mm { next } else { best })
    }

    /// Marks what the strip of `path` covers.
    fn cover(&mut self, path: &[Point]) {
        for ((_, place), done) in self.places.iter().zip(&mut self.done) {
            *done = *done || path.iter().any(|point| point.p.distance(*place) < 0.55 * point.width);
        }
    }

    /// The neighbour of `path` to one side, edge to edge; what of it lies beyond the border or is done is left out.
    fn neighbour(&self, path: &[Point], sign: f64) -> Vec<Point> {
        let mut next: Vec<Point> = Vec::new();
        for (k, point) in path.iter().enumerate() {
            let feed = path[(k + 1).min(path.len() - 1)].p - path[k.saturating_sub(1)].p;
            let across = |uv: Uv| {
                let (_, n) = self.face.at(uv)?;
                n.cross(feed).try_normalize().map(|b| b * sign)
            };
            // Half of the own strip and half of the neighbour's, which is about as wide.
            let step = |uv: Uv, way: f64| self.moved(uv, across(uv)? * way);
            let there = || {
                let middle = step(point.uv, 0.5 * point.width)?;
                let width = self.point(middle, feed)?.width;
                let end = step(middle, 0.5 * width)?;
                self.point(end, feed)
            };
            // Where the path bends to that side by more than it is offset, it would run back.
            let goes_on = |point: &Point| next.last().is_none_or(|last| (point.p - last.p).dot(feed) > 0.0);
            next.extend(there().filter(|point| !self.is_done(point.uv)).filter(goes_on));
        }
        next
    }

    fn family(&mut self, (path, initial): (StudiedPath, Vec<Point>), threshold: f64) -> Family {
        self.cover(&initial);
        let mut paths = vec![path];
        for sign in [1.0, -1.0] {
            let mut front = initial.clone();
            while paths.len() < MOST[1] {
                front = self.neighbour(&front, sign);
                let path = measured(&front);
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

/// Eqs. (10) and (11), over the steps between the points.
fn measured(path: &[Point]) -> StudiedPath {
    let (mut length, mut by_width, mut by_widest) = (0.0, 0.0, 0.0);
    for pair in path.windows(2) {
        let step = pair[0].p.distance(pair[1].p);
        length += step;
        by_width += step * 0.5 * (pair[0].width + pair[1].width);
        by_widest += step * 0.5 * (pair[0].widest + pair[1].widest);
    }
    StudiedPath {
        uv: path.iter().map(|point| [point.uv.u, point.uv.v]).collect(),
        length_mm: length,
        average_mm: if length > 0.0 { by_width / length } else { 0.0 },
        efficiency: if by_widest > 0.0 { by_width / by_widest } else { 0.0 },
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
