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

/// The triangle with these corners, halved along its longest side until no side is longer than `longest` (mm, above 0).
pub fn pieces(corners: [DVec3; 3], longest: f64) -> Vec<[DVec3; 3]> {
    let (mut open, mut small) = (vec![corners], Vec::new());
    while let Some([a, b, c]) = open.pop() {
        let sides = [a.distance(b), b.distance(c), c.distance(a)];
        let side = sides[0].max(sides[1]).max(sides[2]);
        if side <= longest {
            small.push([a, b, c]);
            continue;
        }
        let [a, b, c] = match sides.iter().position(|s| *s == side) {
            Some(1) => [b, c, a],
            Some(2) => [c, a, b],
            _ => [a, b, c],
        };
        let middle = 0.5 * (a + b);
        open.extend([[a, middle, c], [middle, b, c]]);
    }
    small
}
