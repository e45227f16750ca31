//! Lines along the widest strips of a face, and which of them passes should begin with.
//!
//! Source: H. Liu and M. Liu, Tool path planning for high speed milling of sculpture surface with toroidal cutter, 2013: candidates
//! through sampled points, mean strip (10), efficiency (11) and initial path (12); here with a guard of the length, without
//! which (12) favours stubs.

use super::line_field::LineField;
use super::potential::Potential;
use crate::geometry::{Face, FaceGrid, Uv};
use glam::DVec3;
use std::ops::Range;

/// Places a side from which lines are tried.
const TRIED: usize = 8;
/// A line that runs over less fresh ground than this share of the longest is the last choice: the guard of the length.
const SHORTEST: f64 = 0.6;
/// A step along a line, in strips.
const STEP: f64 = 0.35;
/// Steps at most: a line that winds without coming back to where it began is none.
const STEPS: usize = 3000;
/// The fewest points of a line, and of a piece of one over fresh ground.
const FEWEST: usize = 4;
/// A line that comes back to within so many strips of its beginning is closed,
const CLOSES: f64 = 0.8;
/// where its direction has at least this cosine with the one that it left in,
const ALIKE: f64 = 0.8;
/// and it has made so many steps.
const AWAY: usize = 12;

/// A point of a path, and what its strip is like there.
#[derive(Debug, Clone, Copy)]
pub struct PathPoint {
    /// Parameters.
    pub uv: Uv,
    /// Place, mm.
    pub p: DVec3,
    /// Width of the strip along the path, mm.
    pub width: f64,
    /// Width of the widest strip there, mm.
    pub widest: f64,
}

/// What a path sweeps.
#[derive(Debug, Clone, Copy, Default)]
pub struct Swept {
    /// Length, mm.
    pub length: f64,
    by_width: f64,
    by_widest: f64,
}

impl Swept {
    /// Of the path through these points.
    pub fn of(path: &[PathPoint]) -> Self {
        let mut swept = Self::default();
        path.windows(2).for_each(|pair| swept.add(&pair[0], &pair[1]));
        swept
    }

    /// And of a step from one point to another.
    pub fn add(&mut self, from: &PathPoint, to: &PathPoint) {
        let step = from.p.distance(to.p);
        self.length += step;
        self.by_width += step * 0.5 * (from.width + to.width);
        self.by_widest += step * 0.5 * (from.widest + to.widest);
    }

    /// Mean width of the strip, eq. (10), mm; 0 for a point.
    pub fn average(&self) -> f64 {
        if self.length > 0.0 { self.by_width / self.length } else { 0.0 }
    }

    /// Efficiency, eq. (11): 1 where the path runs along the widest strips everywhere; 0 for a point.
    pub fn efficiency(&self) -> f64 {
        if self.by_widest > 0.0 { self.by_width / self.by_widest } else { 0.0 }
    }
}

/// A line along the widest strips, from border to border or closed.
#[derive(Debug, Clone)]
pub struct Streamline {
    /// Its points; of a closed one the last is the first.
    pub points: Vec<PathPoint>,
    /// Those of its points that lie on fresh ground, about the place that it was begun from; of a closed line, from there on.
    pub fresh: Range<usize>,
}

/// The lines along the widest strips of a face.
pub struct Streamlines<'a> {
    face: &'a Face,
    grid: &'a FaceGrid,
    potential: &'a Potential,
    lines: LineField,
}

impl<'a> Streamlines<'a> {
    /// With the potential at the nodes of a grid of the face.
    pub fn new(face: &'a Face, grid: &'a FaceGrid, potential: &'a Potential) -> Self {
        Self { face, grid, potential, lines: LineField::new(face, grid, potential) }
    }

    /// Lines through sampled places where nothing `is_done`, the best to begin passes with first: the widest mean strip over fresh
    /// ground, and those that are short last.
    pub fn initial(&self, is_done: &dyn Fn(Uv) -> bool) -> Vec<Streamline> {
        let domain = self.face.domain();
        let share = |k: usize| (k as f64 + 0.5) / TRIED as f64;
        let mut seeds: Vec<Uv> =
            (0..TRIED * TRIED).map(|k| domain.at(share(k % TRIED), share(k / TRIED))).collect();
        seeds.retain(|uv| !is_done(*uv));
        if seeds.is_empty() {
            let nu = self.grid.size().0;
            let nodes = (0..self.grid.points().len()).map(|k| self.grid.uv(k % nu, k / nu));
            seeds.extend(nodes.filter(|uv| !is_done(*uv)).take(1));
        }
        let traced = seeds.into_iter().filter_map(|uv| self.through(uv, is_done));
        let traced = traced.filter(|line| line.fresh.len() >= FEWEST);
        let mut found: Vec<(Swept, Streamline)> =
            traced.map(|line| (Swept::of(&line.points[line.fresh.clone()]), line)).collect();
        let longest = found.iter().map(|(swept, _)| swept.length).fold(0.0, f64::max);
        let is_short = |swept: &Swept| swept.length < SHORTEST * longest;
        // Of equals the first.
        found.sort_by(|(a, _), (b, _)| {
            is_short(a).cmp(&is_short(b)).then(b.average().total_cmp(&a.average()))
        });
        found.into_iter().map(|(_, line)| line).collect()
    }

    /// What a path that runs along `feed` at `uv` is like there; `None` at a pole.
    pub fn point(&self, uv: Uv, feed: DVec3) -> Option<PathPoint> {
        let (mut width, mut widest) = (0.0, 0.0);
        for (k, weight) in self.around(uv) {
            widest += weight * self.potential.best(k)?.1[0];
            width += weight * self.potential.width(k, feed)?;
        }
        Some(PathPoint { uv, p: self.face.surface.point(uv), width, widest: widest.max(width) })
    }

    /// `uv` moved by `way` (mm, tangent); `None` beyond a border.
    pub fn moved(&self, uv: Uv, way: DVec3) -> Option<Uv> {
        let (du, dv) = self.face.jet(uv).pull_back(way)?;
        let (next, domain) = (Uv::new(uv.u + du, uv.v + dv), self.face.domain());
        domain.contains(next).then(|| domain.hold(next))
    }

    /// The nodes of the grid around `uv` and their weights.
    fn around(&self, uv: Uv) -> [(usize, f64); 4] {
        let uv = self.face.domain().hold(uv);
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

    /// The unit direction of the line at `uv`, on the side of `toward`.
    fn along(&self, uv: Uv, toward: DVec3) -> Option<DVec3> {
        let (_, n) = self.face.at(uv)?;
        let side = (toward - n * toward.dot(n)).try_normalize()?;
        let aside = n.cross(side);
        let (shares, _) = self.lines.along(&self.around(uv), side, aside);
        Some(side * shares.x + aside * shares.y)
    }

    /// The line through `from` both ways.
    fn through(&self, from: Uv, is_done: &dyn Fn(Uv) -> bool) -> Option<Streamline> {
        let start = self.along(from, self.face.jet(from).du)?;
        let (mut points, closes) = self.traced(from, start);
        let mut begin = 0;
        if !closes {
            let (back, _) = self.traced(from, -start);
            begin = back.len().saturating_sub(1);
            points = back.into_iter().skip(1).rev().chain(points).collect();
        }
        // A line that ends by its count of steps has no end.
        if points.len() < FEWEST || points.len() > STEPS {
            return None;
        }
        let is_fresh = |point: &PathPoint| !is_done(point.uv);
        let (before, behind) = points.split_at(begin);
        let first = begin - before.iter().rev().take_while(|point| is_fresh(point)).count();
        let last = begin + behind.iter().take_while(|point| is_fresh(point)).count();
        Some(Streamline { points, fresh: first..last })
    }

    /// The points from `from` on, which is the first; and whether they come back to it.
    fn traced(&self, from: Uv, start: DVec3) -> (Vec<PathPoint>, bool) {
        let (mut uv, mut along) = (from, start);
        let mut points: Vec<PathPoint> = Vec::new();
        while points.len() <= STEPS {
            let Some(here) = self.along(uv, along) else { break };
            let Some(point) = self.point(uv, here) else { break };
            points.push(point);
            let first = points[0];
            let is_back = points.len() > AWAY
                && point.p.distance(first.p) < CLOSES * point.width
                && here.dot(start) > ALIKE;
            if is_back {
                self.close(&mut points);
                return (points, true);
            }
            // The direction half a step on leads there.
            let step = STEP * point.width;
            let half = self.moved(uv, here * (0.5 * step)).and_then(|middle| self.along(middle, here));
            along = half.unwrap_or(here);
            let Some(next) = self.moved(uv, along * step) else { break };
            uv = next;
        }
        (points, false)
    }

    /// Has the last of `points` be the first, and what it was off shared out over all the way, lest there be a kink.
    fn close(&self, points: &mut [PathPoint]) {
        let last = points.len() - 1;
        let before = points.to_vec();
        // Along the line and aside of it, which turn on the way.
        let ways = |k: usize| {
            let (_, n) = self.face.at(before[k].uv)?;
            let along = (before[(k + 1).min(last)].p - before[k - 1].p).try_normalize()?;
            Some((along, n.cross(along)))
        };
        let off = points[0].p - points[last].p;
        let off = ways(last).map_or([0.0; 2], |(along, aside)| [off.dot(along), off.dot(aside)]);
        for (k, place) in points.iter_mut().enumerate().take(last).skip(1) {
            let Some((along, aside)) = ways(k) else { continue };
            let way = (along * off[0] + aside * off[1]) * (k as f64 / last as f64);
            if let Some(point) = self.moved(place.uv, way).and_then(|uv| self.point(uv, along)) {
                *place = point;
            }
        }
        points[last] = points[0];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cutter::Cutter;
    use crate::geometry::{Cylinder, Side};
    use crate::math::frame::Frame;
    use crate::monitor::Stage;
    use crate::posture::{Limits, Rule};
    use crate::strategy::Finish;

    const WORLD: Frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };

    fn on_rod(turn: f64, look: impl Fn(&Streamlines)) {
        let rod = Cylinder::new(DVec3::ZERO, WORLD, 20.0, [0.0, turn], [0.0, 60.0]).unwrap();
        let face = Face::new(rod, Side::Front);
        let grid = FaceGrid::new(&face, 1.0, 8, 60);
        let cutter = Cutter::bull_nose(10.0, 2.0, 40.0).unwrap();
        let (finish, rule) = (Finish { scallop: 0.01, chord: 0.0002 }, Rule::Matched(Limits::default()));
        let potential = Potential::new((&face, &grid), &cutter, &rule, &finish, &Stage::silent()).unwrap();
        look(&Streamlines::new(&face, &grid, &potential));
    }

    #[test]
    fn on_half_a_rod_they_run_round_from_border_to_border() {
        on_rod(2.0, |lines| {
            let found = lines.initial(&|_| false);
            assert_eq!(found.len(), TRIED * TRIED);
            for line in &found {
                let swept = Swept::of(&line.points);
                assert!(swept.length > 38.0 && swept.efficiency() > 0.999, "{swept:?}");
                assert_eq!(line.fresh, 0..line.points.len());
            }
        });
    }

    #[test]
    fn round_a_rod_they_close_and_what_is_done_does_not_count() {
        on_rod(2.0 * std::f64::consts::PI, |lines| {
            for line in lines.initial(&|_| false) {
                let ends = [line.points[0].p, line.points[line.points.len() - 1].p];
                assert!(ends[0].distance(ends[1]) < 1e-9);
                let round = Swept::of(&line.points).length / 20.0;
                assert!((round - 2.0 * std::f64::consts::PI).abs() < 0.01, "{round}");
            }
            let half = lines.initial(&|uv| uv.u > 3.0);
            let length = |line: &Streamline| Swept::of(&line.points[line.fresh.clone()]).length;
            assert!(half.iter().all(|line| length(line) < 61.0), "{}", length(&half[0]));
        });
    }
}
