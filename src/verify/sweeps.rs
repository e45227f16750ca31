//! Which moves come near a box.

use super::body::Body;
use super::motion::Motion;
use glam::DVec3;

/// An axis-parallel box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Box3 {
    pub(super) lo: DVec3,
    pub(super) hi: DVec3,
}

impl Box3 {
    pub(super) const EMPTY: Self = Self { lo: DVec3::INFINITY, hi: DVec3::NEG_INFINITY };

    pub(super) fn with(self, p: DVec3) -> Self {
        Self { lo: self.lo.min(p), hi: self.hi.max(p) }
    }

    fn union(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    fn meets(&self, other: &Self) -> bool {
        self.lo.cmple(other.hi).all() && other.lo.cmple(self.hi).all()
    }
}

/// The body in three lengths, since the box of a leaning shank is far wider than its foot.
const SLICES: usize = 3;
/// Moves, or nodes, under one node: moves in order lie side by side, so a tree over their numbers will do.
const FAN: usize = 8;

/// A tree of boxes over what the body sweeps in each move.
#[derive(Debug, Clone)]
pub(super) struct Sweeps {
    /// Level 0 has a node a move, each level above one a `FAN`.
    levels: Vec<Vec<[Box3; SLICES]>>,
}

impl Sweeps {
    pub(super) fn new(body: &Body, motion: &Motion) -> Self {
        let of_move = |i: usize| {
            let pieces = motion.pieces(i as u32);
            pieces.iter().map(|piece| piece.swept(body)).reduce(union).unwrap_or([Box3::EMPTY; SLICES])
        };
        let mut levels = vec![(0..motion.moves().len()).map(of_move).collect::<Vec<_>>()];
        while let Some(last) = levels.last().filter(|level| level.len() > 1) {
            let above = last.chunks(FAN).filter_map(|nodes| nodes.iter().copied().reduce(union)).collect();
            levels.push(above);
        }
        Self { levels }
    }

    /// The numbers of all moves whose swept body may meet `region`, rising.
    pub(super) fn near(&self, region: &Box3, found: &mut Vec<u32>) {
        found.clear();
        self.descend(self.levels.len() - 1, 0, region, found);
    }

    fn descend(&self, level: usize, node: usize, region: &Box3, found: &mut Vec<u32>) {
        let Some(boxes) = self.levels[level].get(node) else { return };
        if !boxes.iter().any(|b| b.meets(region)) {
            return;
        }
        if level == 0 {
            found.push(node as u32);
        } else {
            (node * FAN..(node + 1) * FAN).for_each(|child| self.descend(level - 1, child, region, found));
        }
    }
}

fn union(a: [Box3; SLICES], b: [Box3; SLICES]) -> [Box3; SLICES] {
    std::array::from_fn(|i| a[i].union(b[i]))
}

/// Heights between which the slices lie.
pub(super) fn slices(body: &Body) -> [(f64, f64); SLICES] {
    let top = body.top();
    let low = body.largest_radius().min(top);
    let mid = (4.0 * body.largest_radius()).min(top);
    [(0.0, low), (low, mid), (mid, top)]
}

pub(super) type Slices = [Box3; SLICES];
