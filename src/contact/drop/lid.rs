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
struct Lid {
    center: [f32; 2],
    gradient: [f32; 2],
    /// Height over the centre.
    height: f32,
    /// Half the sides, the upper halves of two floats.
    half: [u16; 2],
    /// One over the gradient's length (0 for a level lid), and the upright part of the unit normal: they only choose
    /// where a tangent is taken, so rounding does no harm.
    run: f32,
    upright: f32,
}

/// The lids of all nodes of a tree.
#[derive(Debug, Clone)]
pub(super) struct Lids(Vec<Twins>);

/// The lids of an inner node's children, which are always looked at together; alone in their cache line.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
struct Twins([Lid; 2]);

impl Lids {
    /// The bound for everything below `node`: see [`Lid::bound`].
    pub(super) fn bound(&self, node: usize, under: &Underside, axis: DVec2) -> f64 {
        // The root, which has no twin, stands second among the first two.
        self.0[node.div_ceil(2)].0[(node + 1) % 2].bound(under, axis)
    }
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

/// The upper half of the smallest float that is not below `x`, which is 0 or more, and has nothing in its lower half.
fn upper_half_above(x: f64) -> u16 {
    (single_above(x).to_bits().div_ceil(1 << 16)) as u16
}

fn of_upper_half(half: u16) -> f64 {
    f64::from(f32::from_bits(u32::from(half) << 16))
}

impl Lid {
    /// The bound for everything under the lid: no point of it lifts the tip of a cutter at `axis` higher.
    /// Minus infinity where the cutter's shadow misses the rectangle.
    ///
    /// The underside is convex, hence above any of its tangent planes; the lid less a tangent plane is affine, and its
    /// maximum over the rectangle is at a corner. The tangent is taken where the underside would touch the lid, or as
    /// near to that as the rectangle allows: there the bound is all but the exact maximum.
    fn bound(&self, under: &Underside, axis: DVec2) -> f64 {
        let at = double(self.center) - axis;
        let half = DVec2::new(of_upper_half(self.half[0]), of_upper_half(self.half[1]));
        let outside = (at.abs() - half).max(DVec2::ZERO);
        if outside.length_squared() > under.reach * under.reach {
            return f64::NEG_INFINITY;
        }
        let gradient = double(self.gradient);
        let (run, upright) = (f64::from(self.run), f64::from(self.upright));
        let level = gradient.length_squared() <= under.bottom * under.bottom;
        let out = if level { 0.0 } else { under.center_radius * run + under.corner * upright };
        let p = (gradient * out).clamp(at - half, at + half);
        let (level, tangent) = under.tangent(p, || gradient);
        f64::from(self.height) - level - tangent.dot(at - p) + (gradient - tangent).abs().dot(half)
    }
}

impl Underside {
    /// The height at `at` (from the axis) and the gradient of a plane that lies nowhere above the underside and touches
    /// it near `at`, or at the rim for places beyond. Where several do, at a sharp rim, the one that follows `rise`,
    /// the gradient of what is to be bounded.
    pub(super) fn tangent(&self, at: DVec2, rise: impl FnOnce() -> DVec2) -> (f64, DVec2) {
        let radius = at.length();
        if radius == 0.0 || (self.bottom == 0.0 && radius <= self.start && radius < self.reach) {
            return (0.0, DVec2::ZERO);
        }
        if radius > self.start && radius < self.tangent_end {
            let y = self.arc_height(radius);
            return (self.center_height - y, at * ((radius - self.center_radius) / (y * radius)));
        }
        let outward = at / radius;
        let (foot, slope) = self.foot(radius, || rise().dot(outward));
        (self.height(foot) + slope * (radius - foot), outward * slope)
    }

    /// The radius at which the tangent for `radius` touches, and its slope.
    fn foot(&self, radius: f64, rise: impl FnOnce() -> f64) -> (f64, f64) {
        if self.corner > 0.0 {
            let limit = self.tangent_end;
            if radius < limit {
                (radius, self.slope(radius))
            } else {
                (limit, self.steepest.max(self.bottom))
            }
        } else if radius < self.start {
            (radius, self.bottom)
        } else {
            (self.start, rise().max(self.bottom).min(self.side))
        }
    }

    /// The highest that any point of the triangle may lift the tip of a cutter at `axis`: the triangle less a tangent
    /// plane is highest at a corner.
    pub(super) fn bound_triangle(
        &self,
        corners: &[DVec3; 3],
        gradient: impl FnOnce() -> DVec2,
        axis: DVec2,
    ) -> f64 {
        let [a, b, c] = corners.map(|p| p - axis.extend(0.0));
        let middle = (a + b + c).truncate() * (1.0 / 3.0);
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
pub(super) fn lids(tree: &Bvh, corners: &[[DVec3; 3]]) -> Lids {
    let nothing = Twins([lid(&Aabb::EMPTY, &[]); 2]);
    let mut lids = vec![nothing; tree.boxes().len().div_ceil(2)];
    if corners.is_empty() {
        return Lids(lids);
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
    for (node, (bounds, span)) in tree.boxes().iter().zip(spans).enumerate() {
        lids[node.div_ceil(2)].0[(node + 1) % 2] = lid(bounds, &corners[span]);
    }
    Lids(lids)
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
    let square = double(gradient).length_squared();
    Lid {
        center,
        gradient,
        height: single_above(height),
        half: [upper_half_above(half.x), upper_half_above(half.y)],
        run: if square > 0.0 { (1.0 / square.sqrt()) as f32 } else { 0.0 },
        upright: (1.0 / (1.0 + square).sqrt()) as f32,
    }
}
