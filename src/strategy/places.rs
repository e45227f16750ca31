//! Places on a face where is looked for what passes leave.

use super::family::{Candidate, Family};
use super::probe::{Probe, Reach};
use super::spacing::Toward;
use crate::geometry::{FaceGrid, Uv};
use glam::DVec3;

/// Cells from a border that are looked at more closely, and how many parts a side of each then has.
const RIM: usize = 3;
const FINER: usize = 4;
/// Parts that a side of a cell on a border has: strips that lie aslant leave their smallest spots right there.
const ALONG: usize = 24;
/// Where normals across a cell have a lower cosine than this (11°), it bends much.
const BENT: f64 = 0.98;
/// And lower than this (37°), it is an edge.
const FOLDED: f64 = 0.8;
/// Places between the edges of the strips at neighbouring probes.
const RIDGE: usize = 4;

/// A part of a face between two values of either parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Patch {
    pub(super) low: Uv,
    high: Uv,
}

impl Patch {
    /// The cell `(i, j)` of `grid`.
    fn cell(grid: &FaceGrid, i: usize, j: usize) -> Self {
        Self { low: grid.uv(i, j), high: grid.uv(i + 1, j + 1) }
    }

    /// The place at these shares of its sides.
    pub(super) fn at(&self, u: f64, v: f64) -> Uv {
        let Self { low, high } = self;
        Uv::new(low.u + (high.u - low.u) * u, low.v + (high.v - low.v) * v)
    }

    pub(super) fn corners(&self) -> [Uv; 4] {
        [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)].map(|(u, v)| self.at(u, v))
    }

    pub(super) fn middle(&self) -> Uv {
        self.at(0.5, 0.5)
    }

    /// As many times as many parts of it.
    pub(super) fn parts(self, side: usize) -> impl Iterator<Item = Self> {
        let share = move |k: usize| k as f64 / side as f64;
        (0..side * side).map(move |k| {
            let (i, j) = (k % side, k / side);
            Self { low: self.at(share(i), share(j)), high: self.at(share(i + 1), share(j + 1)) }
        })
    }

    /// The corners of those, row after row.
    pub(super) fn nodes(self, side: usize) -> impl Iterator<Item = Uv> {
        let share = move |k: usize| k as f64 / side as f64;
        (0..(side + 1) * (side + 1)).map(move |k| self.at(share(k % (side + 1)), share(k / (side + 1))))
    }

    /// The middles of as many times as many parts of it.
    pub(super) fn places(self, side: usize) -> impl Iterator<Item = Uv> {
        self.parts(side).map(|part| part.middle())
    }
}

impl Family<'_> {
    /// Parts of the face all over it, half a strip large, and smaller beside its borders and where it bends much: the latter
    /// apart.
    pub(super) fn patches(&self) -> [Vec<Patch>; 2] {
        let grid = self.lines.grid();
        let ((nu, nv), domain) = (grid.size(), self.setup.face.domain());
        let is_rim = |k: usize, count: usize, periodic: bool| !periodic && (k < RIM || k + 1 + RIM >= count);
        let [mut plain, mut close] = [Vec::new(), Vec::new()];
        for (i, j) in (0..nv - 1).flat_map(|j| (0..nu - 1).map(move |i| (i, j))) {
            let cell = Patch::cell(grid, i, j);
            let rim = is_rim(i, nu, domain.u.periodic) || is_rim(j, nv, domain.v.periodic);
            if rim || self.turns(&cell, BENT) {
                close.extend(cell.parts(FINER));
            } else {
                plain.push(cell);
            }
        }
        [plain, close]
    }

    /// Whether normals across a patch have a lower cosine than that.
    fn turns(&self, patch: &Patch, cosine: f64) -> bool {
        let [a, b, c, d] = patch.corners().map(|uv| self.setup.face.at(uv).map(|(_, normal)| normal));
        let turns = |a: Option<DVec3>, b| a.zip(b).is_none_or(|(a, b): (DVec3, _)| a.dot(b) < cosine);
        turns(a, d) || turns(b, c)
    }

    /// Parts of a patch that bends much, and parts of those that still do: round the edge of a blade normals turn half about within
    /// one cell.
    fn flat_parts(&self, patch: Patch) -> impl Iterator<Item = Patch> {
        patch.parts(FINER).flat_map(|part| part.parts(if self.turns(&part, BENT) { FINER } else { 1 }))
    }

    /// Ends of short pieces of the borders of the face.
    pub(super) fn border(&self) -> Vec<[Uv; 2]> {
        let (nu, nv) = self.lines.grid().size();
        let cells = (0..nv - 1).flat_map(|j| (0..nu - 1).map(move |i| (i, j)));
        cells.flat_map(|cell| self.pieces_of_border(cell, ALONG)).collect()
    }

    /// The ends of so many `parts` of each side of the cell `(i, j)` of the grid that lies on a border of the face.
    fn pieces_of_border(&self, cell: (usize, usize), parts: usize) -> impl Iterator<Item = [Uv; 2]> {
        let ends = move |a: Uv, b: Uv, k: usize| [k, k + 1].map(|k| between(a, b, k, parts));
        self.sides(cell).flat_map(move |[a, b]| (0..parts).map(move |k| ends(a, b, k)))
    }

    /// The sides of the cell `(i, j)` of the grid that lie on borders of the face.
    fn sides(&self, (i, j): (usize, usize)) -> impl Iterator<Item = [Uv; 2]> {
        let grid = self.lines.grid();
        let ((nu, nv), domain) = (grid.size(), self.setup.face.domain());
        let sides = [
            (!domain.v.periodic && j == 0, [(0, 0), (1, 0)]),
            (!domain.v.periodic && j + 2 == nv, [(0, 1), (1, 1)]),
            (!domain.u.periodic && i == 0, [(0, 0), (0, 1)]),
            (!domain.u.periodic && i + 2 == nu, [(1, 0), (1, 1)]),
        ];
        sides
            .into_iter()
            .filter(|(is_border, _)| *is_border)
            .map(move |(_, ends)| ends.map(|(p, q)| grid.uv(i + p, j + q)))
    }

    /// Places in the cell `(i, j)` of the grid, whose sides have so many `parts`, and so many more where they lie on borders.
    pub(super) fn places_in(&self, (i, j): (usize, usize), [parts, border]: [usize; 2]) -> Vec<Uv> {
        let cell = Patch::cell(self.lines.grid(), i, j);
        let (flat, parts): (Vec<Patch>, _) = if self.turns(&cell, FOLDED) {
            (self.flat_parts(cell).collect(), parts / 2)
        } else {
            (vec![cell], parts)
        };
        let inside = flat.into_iter().flat_map(move |part| part.places(parts));
        let sides = self.sides((i, j)).flat_map(|[a, b]| (0..=border).map(move |k| between(a, b, k, border)));
        inside.chain(sides).collect()
    }

    /// Places so many `times` closer together than those, about each of them that `is_picked`, and once more about each of these that
    /// `is_picked_again`.
    pub(super) fn places_about(
        &self,
        cell: (usize, usize),
        [parts, border]: [usize; 2],
        times: usize,
        [is_picked, is_picked_again]: [&dyn Fn(Uv) -> bool; 2],
    ) -> Vec<Uv> {
        let parts = Patch::cell(self.lines.grid(), cell.0, cell.1).parts(parts);
        let closer = parts.filter(|part| is_picked(part.middle())).flat_map(|part| part.parts(times));
        let inside =
            closer.flat_map(|part| part.places(if is_picked_again(part.middle()) { times } else { 1 }));
        let pieces = self.pieces_of_border(cell, border).filter(|ends| ends.iter().any(|uv| is_picked(*uv)));
        let beside = pieces.flat_map(|[a, b]| (0..=times).map(move |k| between(a, b, k, times)));
        inside.chain(beside).collect()
    }
}

/// Pieces of the edges of the strips on `tracks`, where cusps are highest, between neighbouring probes.
pub(super) fn edges<'a>(tracks: impl Iterator<Item = &'a Candidate>) -> Vec<[Uv; 2]> {
    let edge = |probe: &Probe, toward| match probe.reach(toward) {
        Some(Reach::To { uv, .. }) => Some(uv),
        _ => None,
    };
    let mut edges = Vec::new();
    for probes in tracks.flat_map(|track| &track.probes) {
        for toward in [Toward::Higher, Toward::Lower] {
            let pieces = probes.windows(2);
            edges.extend(pieces.filter_map(|w| Some([edge(&w[0], toward)?, edge(&w[1], toward)?])));
        }
    }
    edges
}

/// Places on those.
pub(super) fn ridges(edges: &[[Uv; 2]]) -> Vec<Uv> {
    edges.iter().flat_map(|&[a, b]| (0..RIDGE).map(move |k| between(a, b, k, RIDGE))).collect()
}

/// The place `k` of `count` equal steps from `a` to `b`.
pub(super) fn between(a: Uv, b: Uv, k: usize, count: usize) -> Uv {
    a.lerp(b, k as f64 / count as f64)
}
