//! Triangle meshes.

use glam::DVec3;

/// Triangles over shared vertices; counter-clockwise seen from outside the material.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TriMesh {
    /// Vertices, millimetres.
    pub vertices: Vec<DVec3>,
    /// Three vertex numbers a triangle.
    pub triangles: Vec<[u32; 3]>,
}

impl TriMesh {
    /// The corners of triangle `i`.
    pub fn corners(&self, i: usize) -> [DVec3; 3] {
        self.triangles[i].map(|v| self.vertices[v as usize])
    }

    /// The unit normal of triangle `i`; `None` where it has no area.
    pub fn normal(&self, i: usize) -> Option<DVec3> {
        let [a, b, c] = self.corners(i);
        (b - a).cross(c - a).try_normalize()
    }

    /// The area of triangle `i`, square millimetres.
    pub fn area(&self, i: usize) -> f64 {
        let [a, b, c] = self.corners(i);
        0.5 * (b - a).cross(c - a).length()
    }

    /// Lowest and highest coordinates over all vertices; `None` for a mesh without vertices.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let first = *self.vertices.first()?;
        Some(self.vertices.iter().fold((first, first), |(lo, hi), &p| (lo.min(p), hi.max(p))))
    }
}
