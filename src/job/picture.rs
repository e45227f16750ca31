//! The shape as triangles to draw, in single precision.

use super::error::JobError;
use super::shape::Shape;
use crate::geometry::FaceGrid;
use crate::verify::Samples;

/// Triangles to draw.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Picture {
    /// x, y, z of each vertex, mm.
    pub positions: Vec<f32>,
    /// Unit outward normal of each vertex; zero where there is none.
    pub normals: Vec<f32>,
    /// Three vertex numbers a triangle.
    pub indices: Vec<u32>,
    /// Excess at each vertex, mm; not a number where the path left it uncut. Empty where nothing was verified.
    pub excess: Vec<f32>,
}

/// Vertices of a picture that shows what is left between passes, about: what a phone draws without effort.
const VERTICES: f64 = 40_000.0;

/// Vertices of a picture that shows the shape alone, about. Shading hides its facets, and it is drawn while the path is
/// still being planned.
const PREVIEW_VERTICES: f64 = 8_000.0;

/// A spacing larger than any part, mm.
const BEYOND: f64 = 1e6;

impl Shape {
    /// Samples of the shape that make a picture of what is left on it.
    pub(super) fn picture_samples(&self) -> Result<Samples, JobError> {
        self.about(VERTICES)
    }

    /// Samples of the shape that make a picture of it alone.
    pub(super) fn preview_samples(&self) -> Result<Samples, JobError> {
        self.about(PREVIEW_VERTICES)
    }

    /// About `count` samples of a surface, or a mesh as it is.
    fn about(&self, count: f64) -> Result<Samples, JobError> {
        match self {
            Self::Face(face) => {
                // The area to a few percent tells the spacing.
                let grid = FaceGrid::new(face, f64::INFINITY, 48, 48);
                let (nu, nv) = grid.size();
                let cells = (0..nv - 1).flat_map(|j| (0..nu - 1).map(move |i| (i, j)));
                let area: f64 = cells.map(|(i, j)| grid.cell_area(i, j)).sum();
                self.samples((area / count).sqrt())
            }
            // A mesh is its own picture: no triangle needs cutting up.
            Self::Mesh(_) => self.samples(BEYOND),
        }
    }

    /// Samples at most `spacing` mm apart.
    pub(super) fn samples(&self, spacing: f64) -> Result<Samples, JobError> {
        match self {
            Self::Face(face) => Samples::of_face(face, spacing),
            Self::Mesh(mesh) => Samples::of_mesh(mesh, spacing),
        }
        .map_err(|e| JobError::field("verify.spacing_mm", e.to_string()))
    }
}

impl Picture {
    /// The picture of `samples`, with the excess of each if there is any.
    pub(super) fn new(samples: &Samples, excess: &[f64]) -> Self {
        let flat = |v: glam::DVec3| v.as_vec3().to_array();
        Self {
            positions: samples.samples.iter().flat_map(|s| flat(s.point)).collect(),
            normals: samples.samples.iter().flat_map(|s| flat(s.normal)).collect(),
            indices: samples.triangles.iter().flatten().copied().collect(),
            excess: excess.iter().map(|&e| if e.is_finite() { e as f32 } else { f32::NAN }).collect(),
        }
    }
}
