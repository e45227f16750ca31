//! Triangles out of a file into a mesh with shared vertices.

use super::{Place, Warning, topology};
use crate::geometry::TriMesh;
use glam::DVec3;
use std::collections::HashMap;

/// Collects triangles, sharing vertices whose coordinates are the same numbers and leaving out what has no area.
#[derive(Default)]
pub(super) struct MeshBuilder {
    mesh: TriMesh,
    numbers: HashMap<[u64; 3], u32>,
    degenerate: usize,
    not_finite: Option<(usize, Place)>,
}

impl MeshBuilder {
    /// Adds a triangle that stands at `place` of the file.
    pub(super) fn add(&mut self, corners: [DVec3; 3], place: impl FnOnce() -> Place) {
        if !corners.iter().all(|p| p.is_finite()) {
            self.not_finite.get_or_insert_with(|| (0, place())).0 += 1;
            return;
        }
        let [a, b, c] = corners;
        if a == b || b == c || c == a || (b - a).cross(c - a) == DVec3::ZERO {
            self.degenerate += 1;
            return;
        }
        let triangle = corners.map(|p| self.number(p));
        self.mesh.triangles.push(triangle);
    }

    /// Triangles so far, with those left out.
    pub(super) fn seen(&self) -> usize {
        self.mesh.triangles.len() + self.degenerate + self.not_finite.as_ref().map_or(0, |n| n.0)
    }

    fn number(&mut self, p: DVec3) -> u32 {
        // Adding zero turns −0 into 0, so that both are one vertex.
        let p = p + DVec3::ZERO;
        let next = self.mesh.vertices.len() as u32;
        let number = *self.numbers.entry(p.to_array().map(f64::to_bits)).or_insert(next);
        if number == next {
            self.mesh.vertices.push(p);
        }
        number
    }

    /// The mesh, with neighbours turned to one side where they disagreed; `None` without a triangle.
    pub(super) fn finish(self) -> Option<(TriMesh, Vec<Warning>)> {
        let mut mesh = self.mesh;
        if mesh.triangles.is_empty() {
            return None;
        }
        let mut warnings = Vec::new();
        let mut warn = |count: usize, warning: fn(usize) -> Warning| {
            if count > 0 {
                warnings.push(warning(count));
            }
        };
        warn(self.degenerate, |count| Warning::Degenerate { count });
        let mut found = topology::of(&mesh);
        if found.disagreeing_edges > 0 {
            warn(topology::orient(&mut mesh), |count| Warning::Turned { count });
            found = topology::of(&mesh);
        }
        warn(found.disagreeing_edges, |count| Warning::NotOrientable { count });
        warn(found.boundary_edges, |count| Warning::Boundary { count });
        warn(found.non_manifold_edges, |count| Warning::NonManifold { count });
        if found == topology::Topology::default() && topology::is_inside_out(&mesh) {
            warnings.push(Warning::InsideOut);
        }
        warnings.extend(self.not_finite.map(|(count, first)| Warning::NotFinite { count, first }));
        Some((mesh, warnings))
    }
}
