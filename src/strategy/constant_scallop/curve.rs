//! A start curve through given points: how far from it every place of a face lies, and abreast of what of it.

use super::offset::grid;
use super::upwind::Upwind;
use crate::geometry::{Face, FaceGrid, Field, Fronts, Range, Table, Uv};
use crate::math::order::{rank, sort_by_key};
use glam::DVec3;
use std::sync::Arc;

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
/// How far the curve goes on beyond a border, as a share of the parameter's range: so that it surely crosses the border.
const BEYOND: f64 = 1e-3;
/// How far the curve is moved, as shares of the ranges, to tell sides: so that it meets no node of a grid exactly.
const ASIDE: [f64; 2] = [1.3e-9, 0.7e-9];
/// Places nearer to the curve than this, in strips, are on it.
const ON: f64 = 1e-6;

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
}

/// A field that is 0 on the curve through `points` and changes by one over `strip` (mm), with another sign on either side, and
/// one that tells places along the curve apart: the way along it, mm, carried off it.
///
/// Each point counts by its nearest one on the face. Between them the curve is straight in the parameters; an open one goes on
/// so until it leaves the face, and one whose last point is its first is closed.
pub(super) fn seed(face: &Face, points: &[DVec3], strip: f64) -> Result<(Field, Field), StartError> {
    let (domain, grid) = (face.domain(), grid(face, strip));
    let curve = Curve::new(face, &grid, points)?;
    let fronts = &curve.fronts;
    let Marks { cuts, near } = curve.marks();
    let sides = sides(fronts, &cuts).ok_or(StartError::Undivided)?;
    let seeds = near.iter().enumerate().filter(|(_, near)| near.0.is_finite());
    let seeds: Vec<(usize, f64)> = seeds.map(|(node, near)| (node, near.0 / strip)).collect();
    let times = fronts.times(&seeds, &vec![1.0 / strip; sides.len()]);
    let upwind = Upwind::new(fronts, &grid, &times, 1.0);
    let columns = upwind.carried(|node| Some(near[fronts.first(node)].1).filter(|along| along.is_finite()));
    let away = |(node, time): (usize, &f64)| if *time < ON { 0.0 } else { time * sides[fronts.first(node)] };
    let away: Vec<f64> = times.iter().enumerate().map(away).collect();
    // Along a border all lie on one side.
    if away.iter().all(|x| *x > 0.0) || away.iter().all(|x| *x < 0.0) {
        return Err(StartError::Undivided);
    }
    let given = |values: &[f64]| Field::Given(Arc::new(Table::new(domain, &grid, values)));
    Ok((given(&away), given(&columns)))
}

impl<'a> Curve<'a> {
    fn new(face: &'a Face, grid: &'a FaceGrid, points: &[DVec3]) -> Result<Self, StartError> {
        let domain = face.domain();
        let ends = |(lo, hi): (DVec3, DVec3), p: &DVec3| (lo.min(*p), hi.max(*p));
        let (lo, hi) = grid.points().iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), ends);
        let size = lo.distance(hi);
        let is_same = |a: Uv, b: Uv| face.surface.point(a).distance(face.surface.point(b)) <= SAME * size;
        let mut corners: Vec<Corner> = Vec::new();
        for (k, &place) in points.iter().enumerate() {
            let mut uv = face.nearest(grid, place);
            let (point, away) = (k + 1, face.surface.point(uv).distance(place));
            if away > size || !away.is_finite() {
                return Err(StartError::Far { point, away, size });
            }
            if let Some(last) = corners.last() {
                if is_same(last.uv, uv) {
                    continue;
                }
                uv = Uv::new(domain.u.turned(uv.u, last.uv.u), domain.v.turned(uv.v, last.uv.v));
            }
            corners.push(Corner { uv, point });
        }
        let [Corner { uv: first, .. }, .., Corner { uv: last, .. }] = corners[..] else {
            return Err(StartError::TooFew);
        };
        let is_closed = is_same(first, last);
        let fronts = Fronts::new(&domain, grid);
        let mut curve = Self { face, grid, fronts, corners, is_closed };
        if !is_closed {
            for _ in 0..2 {
                curve.extend()?;
                curve.corners.reverse();
            }
        }
        curve.check()?;
        Ok(curve)
    }

    fn ranges(&self) -> [Range; 2] {
        let domain = self.face.domain();
        [domain.u, domain.v]
    }

    /// Goes on straight behind the last corner to the border.
    fn extend(&mut self) -> Result<(), StartError> {
        let [.., Corner { uv: before, .. }, Corner { uv, point }] = self.corners[..] else {
            return Err(StartError::TooFew);
        };
        let (at, way) = ([uv.u, uv.v], [uv.u - before.u, uv.v - before.v]);
        let ranges = self.ranges();
        let out = [0, 1].map(|k| {
            let end = if way[k] > 0.0 { ranges[k].hi } else { ranges[k].lo };
            let is_open = !ranges[k].periodic && way[k] != 0.0;
            if is_open { ((end - at[k]) / way[k]).max(0.0) } else { f64::INFINITY }
        });
        let go = out[0].min(out[1]);
        let goes_round = |k: usize| ranges[k].periodic && (go * way[k]).abs() > ranges[k].length();
        if !go.is_finite() || goes_round(0) || goes_round(1) {
            return Err(StartError::Inside { point });
        }
        self.corners.push(Corner { uv: Uv::new(at[0] + go * way[0], at[1] + go * way[1]), point });
        Ok(())
    }

    /// Whether pieces cross.
    fn check(&self) -> Result<(), StartError> {
        let turns = self.ranges().map(|r| if r.periodic { [-r.length(), 0.0, r.length()] } else { [0.0; 3] });
        let pieces: Vec<&[Corner]> = self.corners.windows(2).collect();
        for (i, a) in pieces.iter().enumerate() {
            for (j, b) in pieces.iter().enumerate().skip(i + 2) {
                if self.is_closed && i == 0 && j + 1 == pieces.len() {
                    continue;
                }
                let moved = |c: Corner, k: usize| Uv::new(c.uv.u + turns[0][k / 3], c.uv.v + turns[1][k % 3]);
                if (0..9).any(|k| do_cross([a[0].uv, a[1].uv], [moved(b[0], k), moved(b[1], k)])) {
                    return Err(StartError::Crosses { points: [a[0].point, b[0].point] });
                }
            }
        }
        Ok(())
    }

    fn marks(&self) -> Marks {
        let count = self.grid.points().len();
        let mut marks = Marks { cuts: vec![[false; 2]; count], near: vec![(f64::INFINITY, f64::NAN); count] };
        let mut along = Some(0.0);
        let pieces = self.corners.windows(2);
        let last = pieces.len() - 1;
        for (i, piece) in pieces.enumerate() {
            let is_end = [i == 0, i == last].map(|is| is && !self.is_closed);
            self.mark([piece[0].uv, piece[1].uv], is_end, &mut along, &mut marks);
        }
        if let ([first, .., last], false) = (&self.corners[..], self.is_closed) {
            for end in [first.uv, last.uv] {
                self.mark([end, self.beyond(end)], [false; 2], &mut None, &mut marks);
            }
        }
        marks
    }

    /// A place outside the face beside `end`, which lies on a border.
    fn beyond(&self, end: Uv) -> Uv {
        let mut at = [end.u, end.v];
        let inside = |k: usize, x: f64| {
            let range = self.ranges()[k];
            if range.periodic { f64::INFINITY } else { (x - range.lo).min(range.hi - x) / range.length() }
        };
        let k = usize::from(inside(1, at[1]) < inside(0, at[0]));
        let range = self.ranges()[k];
        at[k] += BEYOND * range.length() * if at[k] > range.at(0.5) { 1.0 } else { -1.0 };
        Uv::new(at[0], at[1])
    }

    /// Marks what the straight piece does, which begins so far `along` the curve and may be an end of it to either side; nothing
    /// is beside one that is not along it.
    fn mark(&self, [from, to]: [Uv; 2], is_end: [bool; 2], along: &mut Option<f64>, marks: &mut Marks) {
        let (nu, nv) = self.grid.size();
        let ranges = self.ranges();
        let at = |t: f64| Uv::new(from.u + (to.u - from.u) * t, from.v + (to.v - from.v) * t);
        let aside = |uv: Uv| [uv.u + ASIDE[0] * ranges[0].length(), uv.v + ASIDE[1] * ranges[1].length()];
        let (a, b) = (aside(from), aside(to));
        // Where it crosses which line of the grid.
        let mut crossings: Vec<(f64, usize, usize)> = vec![(1.0, 2, 0)];
        for (k, range) in ranges.iter().enumerate() {
            let (low, high) = (a[k].min(b[k]), a[k].max(b[k]));
            let turn =
                |x: f64| if range.periodic { ((x - range.lo) / range.length()).floor() as i64 } else { 0 };
            let lines = [nu, nv][k] - usize::from(range.periodic);
            for (turn, line) in (turn(low)..=turn(high)).flat_map(|turn| (0..lines).map(move |l| (turn, l))) {
                let node = if k == 0 { self.grid.uv(line, 0).u } else { self.grid.uv(0, line).v };
                let x = node + turn as f64 * range.length();
                if (low..high).contains(&x) {
                    crossings.push(((x - a[k]) / (b[k] - a[k]), k, line));
                }
            }
        }
        sort_by_key(&mut crossings, |(t, ..)| (rank(*t), 0));
        let mut last = 0.0;
        for (t, k, line) in crossings {
            if let Some(along) = along {
                // At a border it would go on.
                let low = if is_end[0] && last == 0.0 { f64::NEG_INFINITY } else { 0.0 };
                let high = if is_end[1] && t == 1.0 { f64::INFINITY } else { 1.0 };
                self.mark_near([last, t].map(at), (low, high), along, &mut marks.near);
            }
            last = t;
            let [u, v] = aside(at(t));
            let uv = self.face.domain().hold(Uv::new(u, v));
            let (i, j) = self.grid.cell_at(uv);
            let (node, is_inside) = match k {
                0 => (j * nu + line, ranges[1].contains(v)),
                1 => (line * nu + i, ranges[0].contains(u)),
                _ => continue,
            };
            if is_inside {
                marks.cuts[self.fronts.first(node)][1 - k] ^= true;
            }
        }
    }

    /// Marks the nodes around the cell that the piece with these ends lies in, of whose line the shares from `low` to `high`
    /// count.
    fn mark_near(&self, ends: [Uv; 2], (low, high): (f64, f64), along: &mut f64, near: &mut [(f64, f64)]) {
        let [a, b] = ends.map(|uv| self.face.surface.point(uv));
        let middle = Uv::new(0.5 * (ends[0].u + ends[1].u), 0.5 * (ends[0].v + ends[1].v));
        let (i, j) = self.grid.cell_at(self.face.domain().hold(middle));
        let nu = self.grid.size().0;
        for corner in [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)] {
            for node in self.fronts.around(corner.1 * nu + corner.0).into_iter().flatten() {
                let node = self.fronts.first(node);
                let (way, off) = (b - a, self.grid.points()[node] - a);
                let t = (off.dot(way) / way.length_squared().max(f64::MIN_POSITIVE)).clamp(low, high);
                let away = (off - way * t).length();
                if away < near[node].0 {
                    near[node] = (away, *along + t * way.length());
                }
            }
        }
        *along += a.distance(b);
    }
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
