//! A start curve through given points: how far from it every place of a face lies, and abreast of what of it.

use super::upwind::Upwind;
use crate::geometry::{Face, FaceGrid, Fronts, Range, Uv};
use glam::DVec3;

/// Why a start curve is none.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum StartError {
    /// All points are one.
    #[error("must be at least two different points")]
    TooFew,
    /// A point that belongs to something else.
    #[error("point {point} is {away:.1} mm away from the face, which is {size:.1} mm large")]
    Far {
        /// Which, from 1.
        point: usize,
        /// Distance from the face, mm.
        away: f64,
        /// The face's size, mm.
        size: f64,
    },
    /// Two pieces cross.
    #[error("must not cross itself, as it does behind points {} and {}", .points[0], .points[1])]
    Crosses {
        /// The points at which the pieces begin, from 1.
        points: [usize; 2],
    },
    /// On a closed face an end that goes round it.
    #[error("must be closed, or turn towards a border at point {point}")]
    Inside {
        /// Which, from 1.
        point: usize,
    },
    /// Both of its sides are one.
    #[error("must divide the face: from border to border, or round more than a strip")]
    Undivided,
}

/// Points nearer to one another than this share of the face's size are one.
const SAME: f64 = 1e-7;
/// How far the curve goes on beyond a border, as a share of the parameter that it runs along: so that it surely crosses the
/// border, and comes to it straight.
const BEYOND: f64 = 0.1;
/// How far corners are moved, as shares of the ranges: so that the curve meets no node of a grid exactly.
const ASIDE: [f64; 2] = [1.3e-10, 0.7e-10];
/// Places nearer to the curve than this, in strips, are on it.
const ON: f64 = 1e-6;
/// Parts in which a piece is looked at, at first: none may go half round a closed face, which would be nowhere.
const PARTS: u32 = 8;
/// Halvings of a part, beyond which it would pass through a node.
const HALVINGS: u32 = 40;

/// A corner of the curve, and the number of the given point that it belongs to, from 1.
#[derive(Clone, Copy)]
struct Corner {
    uv: Uv,
    point: usize,
}

/// The curve and the grid on which it is looked at.
struct Curve<'a> {
    face: &'a Face,
    grid: &'a FaceGrid,
    fronts: Fronts<'a>,
    ranges: [Range; 2],
    /// Straight in parameters from one to the next, which run on over seams.
    corners: Vec<Corner>,
    is_closed: bool,
}

/// What the curve does to the nodes of the grid.
struct Marks {
    /// Whether it crosses, an odd number of times, the edges from a node towards higher u and towards higher v.
    cuts: Vec<[bool; 2]>,
    /// For nodes beside it the distance and how far along it its nearest place lies, mm.
    near: Vec<(f64, f64)>,
    /// Its length up to where it has been looked at, mm.
    along: f64,
}

/// At the nodes of `grid` a function that is 0 on the curve through `points` and changes by one over `strip` (mm), with another sign on
/// either side, and one that tells places along the curve apart: the way along it, mm, carried off it.
///
/// Each point counts by its nearest one on the face. Between them the curve is straight in the parameters; an open one goes on
/// so until it leaves the face, and one whose last point is its first is closed.
pub(super) fn seed(
    face: &Face,
    grid: &FaceGrid,
    points: &[DVec3],
    strip: f64,
) -> Result<(Vec<f64>, Vec<f64>), StartError> {
    let curve = Curve::new(face, grid, points)?;
    let fronts = &curve.fronts;
    let Marks { cuts, near, .. } = curve.marks();
    let sides = sides(fronts, &cuts).ok_or(StartError::Undivided)?;
    let seeds = near.iter().enumerate().filter(|(_, near)| near.0.is_finite());
    let seeds: Vec<(usize, f64)> = seeds.map(|(node, near)| (node, near.0 / strip)).collect();
    let times = fronts.times(&seeds, &vec![1.0 / strip; sides.len()]);
    let upwind = Upwind::new(fronts, grid, &times, 1.0);
    let columns = upwind.carried(|node| Some(near[fronts.first(node)].1).filter(|along| along.is_finite()));
    let away = |(node, time): (usize, &f64)| if *time < ON { 0.0 } else { time * sides[fronts.first(node)] };
    let away: Vec<f64> = times.iter().enumerate().map(away).collect();
    // Along a border all lie on one side.
    if away.iter().all(|x| *x > 0.0) || away.iter().all(|x| *x < 0.0) {
        return Err(StartError::Undivided);
    }
    Ok((away, columns))
}

impl<'a> Curve<'a> {
    fn new(face: &'a Face, grid: &'a FaceGrid, points: &[DVec3]) -> Result<Self, StartError> {
        let domain = face.domain();
        let ranges = [domain.u, domain.v];
        let fronts = Fronts::new(&domain, grid);
        let ends = |(lo, hi): (DVec3, DVec3), p: &DVec3| (lo.min(*p), hi.max(*p));
        let (lo, hi) = grid.points().iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), ends);
        let size = lo.distance(hi);
        let mut corners: Vec<Corner> = Vec::new();
        // The first foot and the last.
        let mut feet = [DVec3::INFINITY; 2];
        for (k, &place) in points.iter().enumerate() {
            let uv = face.nearest(grid, place);
            let foot = face.surface.point(uv);
            let (point, away) = (k + 1, foot.distance(place));
            if away > size || !away.is_finite() {
                return Err(StartError::Far { point, away, size });
            }
            if k > 0 && foot.distance(feet[1]) <= SAME * size {
                continue;
            }
            feet = [if k == 0 { foot } else { feet[0] }, foot];
            let uv = Uv::new(uv.u + ASIDE[0] * ranges[0].length(), uv.v + ASIDE[1] * ranges[1].length());
            let last = corners.last().map_or(uv, |last| last.uv);
            let uv = Uv::new(ranges[0].turned(uv.u, last.u), ranges[1].turned(uv.v, last.v));
            corners.push(Corner { uv, point });
        }
        let is_closed = feet[0].distance(feet[1]) <= SAME * size;
        if corners.len() < 2 {
            return Err(StartError::TooFew);
        }
        let mut curve = Self { face, grid, fronts, ranges, corners, is_closed };
        for _ in 0..2 {
            if !is_closed {
                curve.extend()?;
            }
            curve.corners.reverse();
        }
        curve.check()?;
        Ok(curve)
    }

    /// Goes on straight behind the last corner, to a little beyond the border.
    fn extend(&mut self) -> Result<(), StartError> {
        let Some(&[Corner { uv: before, .. }, Corner { uv, point }]) = self.corners.last_chunk() else {
            return Err(StartError::TooFew);
        };
        let (at, way) = ([uv.u, uv.v], [uv.u - before.u, uv.v - before.v]);
        let mut go = f64::INFINITY;
        let mut fastest: f64 = 0.0;
        for (k, range) in self.ranges.iter().enumerate() {
            fastest = fastest.max(way[k].abs() / range.length());
            if !range.periodic && way[k] != 0.0 {
                let end = if way[k] > 0.0 { range.hi } else { range.lo };
                go = go.min(((end - at[k]) / way[k]).max(0.0));
            }
        }
        go += BEYOND / fastest;
        let goes_round = |k: usize| self.ranges[k].periodic && go * way[k].abs() > self.ranges[k].length();
        if !go.is_finite() || goes_round(0) || goes_round(1) {
            return Err(StartError::Inside { point });
        }
        self.corners.push(Corner { uv: Uv::new(at[0] + go * way[0], at[1] + go * way[1]), point });
        Ok(())
    }

    /// Whether pieces cross, over seams too.
    fn check(&self) -> Result<(), StartError> {
        let turns = self.ranges.map(|r| if r.periodic { r.length() } else { 0.0 });
        let pieces = self.corners.len() - 1;
        let piece = |i: usize, k: usize| {
            let (u, v) = (turns[0] * (k / 3) as f64, turns[1] * (k % 3) as f64);
            [i, i + 1].map(|i| Uv::new(self.corners[i].uv.u + u, self.corners[i].uv.v + v))
        };
        for (i, j) in (0..pieces).flat_map(|i| (i + 2..pieces).map(move |j| (i, j))) {
            let are_ends = self.is_closed && i == 0 && j + 1 == pieces;
            if !are_ends && (0..9).any(|k| do_cross(piece(i, 4), piece(j, k))) {
                return Err(StartError::Crosses { points: [i, j].map(|i| self.corners[i].point) });
            }
        }
        Ok(())
    }

    /// The point at `uv`; beyond a border as the tangents there go on.
    fn point(&self, uv: Uv) -> DVec3 {
        let held = self.face.domain().clamp(uv);
        let jet = self.face.jet(held);
        jet.p + jet.du * (uv.u - held.u) + jet.dv * (uv.v - held.v)
    }

    /// The cell that holds `uv`, by its lowest node; beyond a border one less than the first, or one more than the last.
    fn cell(&self, uv: Uv) -> [i64; 2] {
        let (nu, nv) = self.grid.size();
        let (i, j) = self.grid.cell_at(self.face.domain().hold(uv));
        let place = |k: usize, x: f64, cell: usize, count: usize| {
            let range = self.ranges[k];
            if range.contains(x) {
                cell as i64
            } else if x < range.lo {
                -1
            } else {
                count as i64 - 1
            }
        };
        [place(0, uv.u, i, nu), place(1, uv.v, j, nv)]
    }

    fn marks(&self) -> Marks {
        let count = self.grid.points().len();
        let near = vec![(f64::INFINITY, f64::NAN); count];
        let mut marks = Marks { cuts: vec![[false; 2]; count], near, along: 0.0 };
        for piece in self.corners.windows(2) {
            let at = |k: u32| middle(piece[0].uv, piece[1].uv, f64::from(k) / f64::from(PARTS));
            (0..PARTS).for_each(|k| self.mark([at(k), at(k + 1)], HALVINGS, &mut marks));
        }
        marks
    }

    /// Marks what the straight piece does.
    fn mark(&self, ends: [Uv; 2], halvings: u32, marks: &mut Marks) {
        let (nu, nv) = self.grid.size();
        let [from, to] = ends.map(|uv| self.cell(uv));
        let cells = [nu as i64 - 1, nv as i64 - 1];
        let steps = [0, 1].map(|k| {
            let (step, half) = (to[k] - from[k], cells[k] / 2);
            if self.ranges[k].periodic { (step + half).rem_euclid(cells[k]) - half } else { step }
        });
        if steps[0].abs() + steps[1].abs() > 1 && halvings > 0 {
            let half = middle(ends[0], ends[1], 0.5);
            self.mark([ends[0], half], halvings - 1, marks);
            self.mark([half, ends[1]], halvings - 1, marks);
            return;
        }
        // Between neighbouring cells it crosses the line that they share, and no other.
        for k in [0, 1] {
            let other = from[1 - k];
            if steps[k] != 0 && (0..cells[1 - k]).contains(&other) {
                let line = if steps[k] > 0 { to[k] } else { from[k] };
                let (i, j) = if k == 0 { (line, other) } else { (other, line) };
                marks.cuts[self.fronts.first(j as usize * nu + i as usize)][1 - k] ^= true;
            }
        }
        let [a, b] = ends.map(|uv| self.point(uv));
        let way = b - a;
        let (i, j) = self.grid.cell_at(self.face.domain().hold(ends[0]));
        for corner in [0, 1, nu, nu + 1].map(|step| j * nu + i + step) {
            for node in self.fronts.around(corner).into_iter().flatten().map(|n| self.fronts.first(n)) {
                let off = self.grid.points()[node] - a;
                let t = (off.dot(way) / way.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
                let away = (off - way * t).length();
                if away < marks.near[node].0 {
                    marks.near[node] = (away, marks.along + t * way.length());
                }
            }
        }
        marks.along += way.length();
    }
}

/// The place at the share `t` of the way.
fn middle(from: Uv, to: Uv, t: f64) -> Uv {
    Uv::new(from.u + (to.u - from.u) * t, from.v + (to.v - from.v) * t)
}

/// Whether two straight pieces cross inside both.
fn do_cross([a, b]: [Uv; 2], [c, d]: [Uv; 2]) -> bool {
    let apart = |a: f64, b: f64, c: f64, d: f64| a.max(b) < c.min(d) || c.max(d) < a.min(b);
    let side = |p: Uv, q: Uv, r: Uv| (q.u - p.u) * (r.v - p.v) - (q.v - p.v) * (r.u - p.u);
    // Of pieces on one line rounding alone would decide.
    !apart(a.u, b.u, c.u, d.u)
        && !apart(a.v, b.v, c.v, d.v)
        && side(a, b, c) * side(a, b, d) < 0.0
        && side(c, d, a) * side(c, d, b) < 0.0
}

/// On which side of the `cuts` nodes lie, 1 or −1, the first one at −1; `None` where both sides are one.
fn sides(fronts: &Fronts, cuts: &[[bool; 2]]) -> Option<Vec<f64>> {
    let mut sides = vec![0.0; cuts.len()];
    sides[0] = -1.0;
    let mut open = vec![0];
    while let Some(node) = open.pop() {
        let around = fronts.around(node);
        // Every other neighbour lies over a corner.
        for (k, next) in [0, 2, 4, 6].into_iter().filter_map(|k| around[k].map(|n| (k, fronts.first(n)))) {
            let is_cut = if k < 4 { cuts[node][k / 2] } else { cuts[next][k / 2 - 2] };
            let side: f64 = if is_cut { -sides[node] } else { sides[node] };
            if sides[next] == 0.0 {
                sides[next] = side;
                open.push(next);
            } else if sides[next] != side {
                return None;
            }
        }
    }
    Some(sides)
}
