//! What a front carries along as it runs over a grid.

use crate::geometry::{FaceGrid, Fronts};
use crate::math::order::{rank, sort_by_key};

/// Where the front came from to each node of a grid.
pub(super) struct Upwind {
    /// Nodes in the order in which the front passes them.
    order: Vec<usize>,
    /// The two nodes between which it came, and the share of the second; nothing where it begins.
    from: Vec<Option<(usize, usize, f64)>>,
}

impl Upwind {
    /// For a front that passes the nodes of `grid`, over which `fronts` run, at the times `values`, times `sign`.
    pub(super) fn new(fronts: &Fronts, grid: &FaceGrid, values: &[f64], sign: f64) -> Self {
        let mut order: Vec<usize> = (0..values.len()).collect();
        sort_by_key(&mut order, |&node| (rank(sign * values[node]), 0));
        let points = grid.points();
        let before = |node: usize, other: usize| sign * (values[node] - values[other]);
        let from = (0..values.len()).map(|node| {
            let ring = fronts.around(node);
            let fall = |k: usize| {
                let other = ring[k % 8]?;
                let way = points[other].distance(points[node]);
                let fall = before(node, other);
                (fall > 0.0 && way > 0.0).then_some((other, fall, way))
            };
            // The two neighbours, side by side, between which it falls fastest.
            let mut best: Option<(f64, (usize, usize, f64))> = None;
            for k in 0..8 {
                let Some((a, fall_a, way_a)) = fall(k) else { continue };
                let steep = fall_a / way_a;
                if best.is_none_or(|(s, _)| steep > s) {
                    best = Some((steep, (a, a, 0.0)));
                }
                let Some((b, fall_b, _)) = fall(k + 1) else { continue };
                let (da, db) = (points[a] - points[node], points[b] - points[node]);
                // Gradient in the plane of the three.
                let (aa, ab, bb) = (da.dot(da), da.dot(db), db.dot(db));
                let det = aa * bb - ab * ab;
                if det <= 0.0 {
                    continue;
                }
                let (x, y) = ((bb * fall_a - ab * fall_b) / det, (aa * fall_b - ab * fall_a) / det);
                if x > 0.0 && y > 0.0 {
                    let steep = (da * x + db * y).length();
                    if best.is_none_or(|(s, _)| steep > s) {
                        best = Some((steep, (a, b, y / (x + y))));
                    }
                }
            }
            best.map(|(_, from)| from)
        });
        Self { from: from.collect(), order }
    }

    /// The numbers that `given` tells for nodes, carried on to those for which it tells none.
    pub(super) fn carried(&self, given: impl Fn(usize) -> Option<f64>) -> Vec<f64> {
        let mut carried = vec![0.0; self.order.len()];
        for &node in &self.order {
            carried[node] = given(node).unwrap_or_else(|| {
                self.from[node].map_or(0.0, |(a, b, share)| carried[a] + (carried[b] - carried[a]) * share)
            });
        }
        carried
    }
}
