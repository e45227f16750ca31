//! What of a mesh is seen from above.

use super::{DropMesh, holds};
use crate::math::bvh::Aabb;
use crate::math::order::{rank, sort_by_key};
use glam::{DVec2, DVec3};

impl DropMesh {
    /// The highest point of the mesh on the vertical line through `(x, y)` and the triangle it is on; `None` beside the
    /// mesh. Upright triangles are not seen.
    pub fn top(&self, x: f64, y: f64) -> Option<(f64, u32)> {
        let at = DVec2::new(x, y);
        let mut seen = None;
        let bound = |node: usize| {
            let Aabb { lo, hi } = self.tree.boxes()[node];
            let inside = lo.x <= x && x <= hi.x && lo.y <= y && y <= hi.y;
            if inside { hi.z } else { f64::NEG_INFINITY }
        };
        self.tree.highest(f64::NEG_INFINITY, bound, |places, mut best| {
            for place in places {
                let facet = &self.facets[place];
                if !holds(&facet.corners, at) {
                    continue;
                }
                let Some(gradient) = facet.gradient() else { continue };
                let z = facet.corners[0].z + gradient.dot(at - facet.corners[0].truncate());
                if z > best {
                    best = z;
                    seen = Some((z, self.tree.order()[place]));
                }
            }
            best
        });
        seen
    }

    /// The stretches of x, in rising order, over which a level disc of radius `beyond` (mm, 0 or more) around a point of
    /// the line along x at `y` has mesh above or below it.
    pub fn covered(&self, y: f64, beyond: f64) -> Vec<(f64, f64)> {
        let mut spans = Vec::new();
        let slab = Aabb {
            lo: DVec3::new(f64::NEG_INFINITY, y - beyond, f64::NEG_INFINITY),
            hi: DVec3::new(f64::INFINITY, y + beyond, f64::INFINITY),
        };
        self.tree.visit_places(
            |b| b.meets(&slab),
            |place| {
                let corners = &self.facets[place].corners;
                let mut span = (f64::INFINITY, f64::NEG_INFINITY);
                for i in 0..3 {
                    let (a, b) = (corners[i].truncate(), corners[(i + 1) % 3].truncate());
                    round_edge(a, b, y, beyond, &mut span);
                }
                if span.0 < span.1 {
                    spans.push(span);
                }
            },
        );
        sort_by_key(&mut spans, |span| (rank(span.0), 0));
        let mut merged: Vec<(f64, f64)> = Vec::new();
        for (from, to) in spans {
            match merged.last_mut() {
                Some(last) if from <= last.1 + GAP => last.1 = last.1.max(to),
                _ => merged.push((from, to)),
            }
        }
        merged
    }
}

/// Widens `span` by the x at which points at `y` are no farther than `beyond` from the edge from `a` to `b`. What lies
/// between the edges of one triangle need not be asked for: of a convex shape's neighbourhood a line meets one stretch.
fn round_edge(a: DVec2, b: DVec2, y: f64, beyond: f64, span: &mut (f64, f64)) {
    let mut widen = |x: f64| *span = (span.0.min(x), span.1.max(x));
    let off = a.y - y;
    let half = beyond * beyond - off * off;
    if half >= 0.0 {
        widen(a.x - half.sqrt());
        widen(a.x + half.sqrt());
    }
    let side = (b - a).normalize_or_zero().perp() * beyond;
    for (a, b) in [(a - side, b - side), (a + side, b + side)] {
        if (a.y - y) * (b.y - y) <= 0.0 {
            let t = if a.y == b.y { 0.0 } else { (y - a.y) / (b.y - a.y) };
            widen(a.x + (b.x - a.x) * t);
        }
    }
}

/// Neighbouring triangles may fall apart by rounding: gaps up to this, mm, are none.
const GAP: f64 = 1e-6;
