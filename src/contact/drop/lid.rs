//! Planes that lie on top of parts of a mesh.

use super::Underside;
use crate::math::bvh::{Aabb, Bvh};
use glam::{DVec2, DVec3};

/// A plane above everything in a node of the tree, over the node's rectangle.
///
/// A box's top exceeds a sloping surface by the slope times the box's side; a plane fitted to the surface only by what
/// curvature and roughness leave, so the search for a contact ends after a few leaves however fine the mesh is.
///
/// Single precision, rounded so that it stays above: the search waits for memory more than for arithmetic, and two lids
/// fill a cache line where doubles would fill two.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C, align(32))]
pub(super) struct Lid {
    center: [f32; 2],
    half: [f32; 2],
    gradient: [f32; 2],
    /// Height over the centre.
    height: f32,
}

fn double([x, y]: [f32; 2]) -> DVec2 {
    DVec2::new(f64::from(x), f64::from(y))
}

fn single(v: DVec2) -> [f32; 2] {
    [v.x as f32, v.y as f32]
}

fn single_above(x: f64) -> f32 {
    let near = x as f32;
    if f64::from(near) < x { near.next_up() } else { near }
}

/// The underside's tangent is taken no steeper than this: towards the rim it would become infinite, and with it the
/// bound over a rectangle that reaches across the rim.
const STEEPEST: f64 = 4.0;

impl Lid {
    /// The bound for everything under the lid: no point of it lifts the tip of a cutter at `axis` higher.
    /// Minus infinity where the cutter's shadow misses the rectangle.
    ///
    /// The underside is convex, hence above any of its tangent planes; the lid less a tangent plane is affine, and its
    /// maximum over the rectangle is at a corner. The tangent is taken where the underside would touch the lid, or as
    /// near to that as the rectangle allows: there the bound is all but the exact maximum.
    pub(super) fn bound(&self, under: &Underside, axis: DVec2) -> f64 {
        let (at, half) = (double(self.center) - axis, double(self.half));
        let outside = (at.abs() - half).max(DVec2::ZERO);
        if outside.length_squared() > under.reach * under.reach {
            return f64::NEG_INFINITY;
        }
        let gradient = double(self.gradient);
        let p = under.touch_plane(gradient).clamp(at - half, at + half);
        let (level, tangent) = under.tangent(p, gradient);
        f64::from(self.height) - level - tangent.dot(at - p) + (gradient - tangent).abs().dot(half)
    }
}

impl Underside {
    /// The height at `at` (from the axis) and the gradient of a plane that lies nowhere above the underside and touches
    /// it near `at`, or at the rim for places beyond. Where several do, at a sharp rim, the one that follows `rise`,
    /// the gradient of what is to be bounded.
    pub(super) fn tangent(&self, at: DVec2, rise: DVec2) -> (f64, DVec2) {
        let radius = at.length();
        if radius == 0.0 || (self.bottom == 0.0 && radius <= self.start && radius < self.reach) {
            return (0.0, DVec2::ZERO);
        }
        let outward = at / radius;
        let (foot, slope) = self.foot(radius, rise.dot(outward));
        (self.height(foot) + slope * (radius - foot), outward * slope)
    }

    /// The radius at which the tangent for `radius` touches, and its slope.
    fn foot(&self, radius: f64, rise: f64) -> (f64, f64) {
        if self.corner > 0.0 {
            let steepest = STEEPEST.min(self.side);
            // Radius at which the corner has that slope.
            let limit = self.center_radius + self.corner * steepest / (1.0 + steepest * steepest).sqrt();
            if radius < limit { (radius, self.slope(radius)) } else { (limit, steepest.max(self.bottom)) }
        } else if radius < self.start {
            (radius, self.bottom)
        } else {
            (self.start, rise.max(self.bottom).min(self.side))
        }
    }

    /// The highest that any point of the triangle may lift the tip of a cutter at `axis`: the triangle less a tangent
    /// plane is highest at a corner.
    pub(super) fn bound_triangle(&self, corners: &[DVec3; 3], gradient: DVec2, axis: DVec2) -> f64 {
        let [a, b, c] = corners.map(|p| p - axis.extend(0.0));
        let middle = (a + b + c).truncate() / 3.0;
        let (level, tangent) = self.tangent(middle, gradient);
        let over = |p: DVec3| p.z - tangent.dot(p.truncate() - middle);
        over(a).max(over(b)).max(over(c)) - level
    }
}

/// Sums over points, for a plane fitted by least squares.
#[derive(Clone, Copy, Default)]
struct Moments {
    count: f64,
    sum: DVec3,
    xx: f64,
    xy: f64,
    yy: f64,
    xz: f64,
    yz: f64,
}

impl Moments {
    fn add(&mut self, p: DVec3) {
        self.count += 1.0;
        self.sum += p;
        self.xx += p.x * p.x;
        self.xy += p.x * p.y;
        self.yy += p.y * p.y;
        self.xz += p.x * p.z;
        self.yz += p.y * p.z;
    }

    /// The fitted plane's gradient; zero where the points stand on a line or over one another.
    fn gradient(&self) -> DVec2 {
        let n = self.count;
        let DVec3 { x, y, z } = self.sum / n;
        let (xx, xy, yy) = (self.xx / n - x * x, self.xy / n - x * y, self.yy / n - y * y);
        let (xz, yz) = (self.xz / n - x * z, self.yz / n - y * z);
        let det = xx * yy - xy * xy;
        // Upright walls give a plane so steep that it bounds nothing.
        if det <= 1e-6 * (xx + yy) * (xx + yy) {
            return DVec2::ZERO;
        }
        DVec2::new(yy * xz - xy * yz, xx * yz - xy * xz) / det
    }
}

/// A lid for each node of the tree over triangles with these `corners`, given in the order of the tree's leaves.
pub(super) fn lids(tree: &Bvh, corners: &[[DVec3; 3]]) -> Vec<Lid> {
    let mut lids = Vec::with_capacity(tree.boxes().len());
    if corners.is_empty() {
        return lids;
    }
    // The corners below a node are contiguous: leaves were numbered depth first.
    let mut spans = vec![0..0; tree.boxes().len()];
    for node in (0..spans.len()).rev() {
        spans[node] = match (tree.leaf(node), tree.children(node)) {
            (Some(places), _) => places,
            (None, Some([a, b])) => spans[a].start..spans[b].end,
            (None, None) => 0..0,
        };
    }
    for (bounds, span) in tree.boxes().iter().zip(spans) {
        lids.push(lid(bounds, &corners[span]));
    }
    lids
}

fn lid(bounds: &Aabb, corners: &[[DVec3; 3]]) -> Lid {
    let middle = bounds.center();
    let mut moments = Moments::default();
    corners.iter().flatten().for_each(|&p| moments.add(p - middle));
    // What is stored decides; height and extent follow from that.
    let center = single(middle.truncate());
    let gradient = single(moments.gradient());
    let from = |p: DVec3| p.truncate() - double(center);
    let above = |p: &DVec3| p.z - double(gradient).dot(from(*p));
    let height = corners.iter().flatten().map(above).fold(f64::NEG_INFINITY, f64::max);
    let half = from(bounds.lo).abs().max(from(bounds.hi).abs());
    let half = [single_above(half.x), single_above(half.y)];
    Lid { center, half, gradient, height: single_above(height) }
}
