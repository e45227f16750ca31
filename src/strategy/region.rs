//! A piece of a face, told node by node of a grid.

use crate::geometry::{FaceGrid, Uv};
use std::sync::Arc;

/// The places nearest to the nodes with one label.
#[derive(Debug, Clone)]
pub(super) struct Region {
    grid: Arc<FaceGrid>,
    /// For every node of the grid.
    labels: Arc<Vec<usize>>,
    label: usize,
}

impl Region {
    /// The pieces that `labels` divide a face into, one for each up to `count`.
    pub(super) fn all(grid: FaceGrid, labels: Vec<usize>, count: usize) -> Vec<Self> {
        let (grid, labels) = (Arc::new(grid), Arc::new(labels));
        (0..count).map(|label| Self { grid: grid.clone(), labels: labels.clone(), label }).collect()
    }

    /// Places along where it meets those of higher labels, so many to a side of each cell there.
    pub(super) fn meeting(&self, parts: usize) -> Vec<Uv> {
        let (nu, nv) = self.grid.size();
        let label = |i: usize, j: usize| self.labels[j * nu + i];
        let is_mixed = |&(i, j): &(usize, usize)| {
            let around = [label(i, j), label(i + 1, j), label(i, j + 1), label(i + 1, j + 1)];
            around.contains(&self.label)
                && around.iter().all(|label| *label >= self.label)
                && around.iter().any(|label| *label > self.label)
        };
        let cells = (0..nv - 1).flat_map(|j| (0..nu - 1).map(move |i| (i, j))).filter(is_mixed);
        let inside = |(i, j): (usize, usize)| {
            let (low, high) = (self.grid.uv(i, j), self.grid.uv(i + 1, j + 1));
            let share = move |k: usize| (k as f64 + 0.5) / parts as f64;
            (0..parts * parts).map(move |k| {
                let (s, t) = (share(k % parts), share(k / parts));
                Uv::new(low.u + (high.u - low.u) * s, low.v + (high.v - low.v) * t)
            })
        };
        cells.flat_map(inside).collect()
    }

    /// Whether the place at `uv` is one of them.
    pub(super) fn has(&self, uv: Uv) -> bool {
        let (i, j) = self.grid.cell_at(uv);
        let (low, high) = (self.grid.uv(i, j), self.grid.uv(i + 1, j + 1));
        let beyond = |x: f64, low: f64, high: f64| usize::from(x - low > high - x);
        let (i, j) = (i + beyond(uv.u, low.u, high.u), j + beyond(uv.v, low.v, high.v));
        self.labels[j * self.grid.size().0 + i] == self.label
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Face, Plane, Range, Side};
    use crate::math::frame::Frame;
    use glam::DVec3;

    #[test]
    fn places_belong_to_the_nearest_node_and_meet_between() {
        let frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
        let (u, v) = (Range::open(0.0, 10.0), Range::open(0.0, 6.0));
        let face = Face::new(Plane { origin: DVec3::ZERO, frame, u, v }, Side::Front);
        let grid = FaceGrid::new(&face, 1.0, 4, 100);
        let labels = grid.points().iter().map(|p| usize::from(p.x > 4.5)).collect();
        let regions = Region::all(grid, labels, 2);
        for (x, label) in [(0.0, 0), (4.4, 0), (4.6, 1), (10.0, 1)] {
            for y in [0.0, 2.4, 6.0] {
                assert!(
                    regions[label].has(Uv::new(x, y)) && !regions[1 - label].has(Uv::new(x, y)),
                    "{x} {y}"
                );
            }
        }
        let meeting = regions[0].meeting(4);
        assert_eq!((meeting.len(), regions[1].meeting(4).len()), (6 * 16, 0));
        assert!(meeting.iter().all(|uv| (4.0..5.0).contains(&uv.u)));
    }
}
