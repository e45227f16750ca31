//! A cutter with an upright axis, lowered on a mesh until it touches.
//!
//! The tip comes to rest at the highest `z − height(ρ)` over all points of the mesh under the cutter, `ρ` being their
//! distance from the axis. The underside is convex, so over a triangle this is concave: it has one maximum, inside the
//! triangle, or else on an edge, where again it has one. Every APT cutter is treated alike and exactly.

mod above;
mod edge;
mod lid;
mod underside;

use crate::geometry::TriMesh;
use crate::math::bvh::{Aabb, Bvh};
use edge::{EdgeTouch, Spot, touch_edge};
use glam::{DVec2, DVec3};
use lid::Lids;
use std::ops::Range;
pub use underside::Underside;

/// What of the mesh a lowered cutter touches, by the mesh's own numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Feature {
    /// The inside of a triangle.
    Facet(u32),
    /// The inside of the edge between two vertices.
    Edge(u32, u32),
    /// A vertex.
    Vertex(u32),
}

/// A cutter at rest on a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// Height of the tip, mm.
    pub tip_z: f64,
    /// Where the cutter touches.
    pub point: DVec3,
    /// The common unit normal there, from the material to the cutter: the facet's, or the underside's where an edge
    /// or a vertex is touched. Where a sharp corner of the cutter sits on a vertex, the lowest of those possible.
    pub normal: DVec3,
    /// What is touched.
    pub feature: Feature,
}

/// A triangle. Its gradient is worked out anew where it is needed: a search waits longer for memory.
#[derive(Debug, Clone, Copy)]
struct Facet {
    corners: [DVec3; 3],
}

/// A triangle whose normal is this close to level is upright: its shadow is thinner than rounding.
const UPRIGHT: f64 = 1e-12;

impl Facet {
    /// The gradient of the triangle's plane; `None` for an upright or collapsed triangle, of which only the edges count.
    fn gradient(&self) -> Option<DVec2> {
        let [a, b, c] = self.corners;
        let n = (b - a).cross(c - a);
        let upright = n.z.abs() <= UPRIGHT * n.length();
        (!upright).then(|| -n.truncate() / n.z)
    }
}

/// A mesh made ready for lowering cutters on it.
#[derive(Debug, Clone)]
pub struct DropMesh {
    tree: Bvh,
    lids: Lids,
    /// By place in the tree's order, as all below.
    facets: Vec<Facet>,
    vertices: Vec<[u32; 3]>,
}

/// Triangles a leaf. Of 1, 2, 4 and 8, four was the fastest on meshes of 5,000 and 500,000 triangles.
const LEAF: usize = 4;

impl DropMesh {
    /// Prepares `mesh`. Which way its triangles face does not matter.
    pub fn new(mesh: &TriMesh) -> Self {
        let boxes: Vec<Aabb> = (0..mesh.triangles.len()).map(|i| Aabb::around(mesh.corners(i))).collect();
        let tree = Bvh::new(&boxes, LEAF);
        let corners: Vec<_> = tree.order().iter().map(|&i| mesh.corners(i as usize)).collect();
        Self {
            lids: lid::lids(&tree, &corners),
            vertices: tree.order().iter().map(|&i| mesh.triangles[i as usize]).collect(),
            facets: corners.into_iter().map(|corners| Facet { corners }).collect(),
            tree,
        }
    }

    /// The tree over the triangles.
    pub fn tree(&self) -> &Bvh {
        &self.tree
    }
}

/// The cutter with its axis at `(x, y)`, pointing up, lowered on `mesh` until it touches; `None` where its shadow meets
/// no triangle.
///
/// Exact to rounding, about 1e-10 mm: never lower than the mesh allows by more. Of several contacts at the same height
/// one is named. The time does not grow with the number of triangles under the cutter.
pub fn drop_cutter(mesh: &DropMesh, under: &Underside, x: f64, y: f64) -> Option<Touch> {
    drop_cutter_above(mesh, under, x, y, f64::NEG_INFINITY)
}

/// As [`drop_cutter`], but `None` also where the tip would come to rest at `floor` or lower: that is found out sooner
/// than where it rests.
pub fn drop_cutter_above(mesh: &DropMesh, under: &Underside, x: f64, y: f64, floor: f64) -> Option<Touch> {
    let axis = DVec2::new(x, y);
    let mut rest: Option<Rest> = None;
    let bound = |node: usize| mesh.lids.bound(node, under, axis);
    mesh.tree.highest(floor, bound, |places, mut best| {
        let bounds = bounds(mesh, under, axis, &places);
        for (place, bound) in places.zip(bounds) {
            if bound > best
                && let Some(found) = touch_triangle(mesh, under, axis, place, best)
            {
                best = found.tip();
                rest = Some(found);
            }
        }
        best
    });
    rest.map(|rest| rest.touch(mesh, under, axis))
}

/// Whether a cutter with its axis upright and its tip at `tip` has some of the mesh inside: whether it would come to
/// rest higher.
pub fn is_in_mesh(mesh: &DropMesh, under: &Underside, tip: DVec3) -> bool {
    let axis = tip.truncate();
    let bound = |node: usize| mesh.lids.bound(node, under, axis);
    // Infinity, once something is found, leaves nothing to look for.
    let found = mesh.tree.highest(tip.z, bound, |places, best| {
        let bounds = bounds(mesh, under, axis, &places);
        let inside = places
            .zip(bounds)
            .any(|(place, bound)| bound > best && touch_triangle(mesh, under, axis, place, best).is_some());
        if inside { f64::INFINITY } else { best }
    });
    found == f64::INFINITY
}

/// The best contact so far.
enum Rest {
    Facet { place: usize, tip: f64, point: DVec3 },
    Edge { place: usize, side: usize, on: EdgeTouch },
}

/// How high the triangles of a leaf may lift the tip. All before one is looked at closely, so that they are waited for
/// together.
fn bounds(mesh: &DropMesh, under: &Underside, axis: DVec2, places: &Range<usize>) -> [f64; LEAF] {
    let mut bounds = [f64::NEG_INFINITY; LEAF];
    for (bound, facet) in bounds.iter_mut().zip(&mesh.facets[places.clone()]) {
        let gradient = || facet.gradient().unwrap_or_default();
        *bound = under.bound_triangle(&facet.corners, gradient, axis);
    }
    bounds
}

/// The cutter on the triangle at `place`, if that is higher than `floor`.
fn touch_triangle(mesh: &DropMesh, under: &Underside, axis: DVec2, place: usize, floor: f64) -> Option<Rest> {
    let facet = &mesh.facets[place];
    let corners = &facet.corners;
    if let Some(gradient) = facet.gradient() {
        let offset = under.touch_plane(gradient);
        let at = axis + offset;
        if holds(corners, at) {
            let z = corners[0].z + gradient.dot(at - corners[0].truncate());
            // Extrapolation over a steep sliver may overshoot.
            let z = z.min(corners[0].z.max(corners[1].z).max(corners[2].z));
            let tip = z - under.height(offset.length().min(under.reach));
            return (tip > floor).then_some(Rest::Facet { place, tip, point: at.extend(z) });
        }
    }
    let mut best = floor;
    let mut rest = None;
    for side in 0..3 {
        if let Some(on) = touch_edge(under, axis, (corners[side], corners[(side + 1) % 3]), best) {
            best = on.tip;
            rest = Some(Rest::Edge { place, side, on });
        }
    }
    rest
}

/// Whether the shadow of the triangle holds `p`.
fn holds(corners: &[DVec3; 3], p: DVec2) -> bool {
    let [a, b, c] = corners.map(|q| q.truncate() - p);
    let turns = [a.perp_dot(b), b.perp_dot(c), c.perp_dot(a)];
    turns.iter().all(|t| *t >= 0.0) || turns.iter().all(|t| *t <= 0.0)
}

impl Rest {
    fn tip(&self) -> f64 {
        match self {
            Self::Facet { tip, .. } => *tip,
            Self::Edge { on, .. } => on.tip,
        }
    }

    fn touch(&self, mesh: &DropMesh, under: &Underside, axis: DVec2) -> Touch {
        let outward = |point: DVec3| (point.truncate() - axis).normalize_or_zero();
        // Where the underside rises outwards by `slope`, its normal into the cutter leans to the axis.
        let normal = |point: DVec3, slope: f64| {
            let flat = -outward(point);
            if slope < f64::INFINITY { (flat * slope).extend(1.0).normalize() } else { flat.extend(0.0) }
        };
        match *self {
            Self::Facet { place, tip, point } => Touch {
                tip_z: tip,
                point,
                normal: (-mesh.facets[place].gradient().unwrap_or_default()).extend(1.0).normalize(),
                feature: Feature::Facet(mesh.tree.order()[place]),
            },
            Self::Edge { place, side, on } => {
                let ends = [mesh.vertices[place][side], mesh.vertices[place][(side + 1) % 3]];
                let (slope, feature) = match on.spot {
                    Spot::Between(slope) => (slope, Feature::Edge(ends[0], ends[1])),
                    Spot::Corner(i) => {
                        let radius = (on.point.truncate() - axis).length();
                        (under.slope(radius), Feature::Vertex(ends[i]))
                    }
                };
                Touch { tip_z: on.tip, point: on.point, normal: normal(on.point, slope), feature }
            }
        }
    }
}
