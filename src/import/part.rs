//! What a file holds.

use super::{Format, Topology, Unit, Warning, topology};
use crate::geometry::{Along, NurbsSurface, Surface, TriMesh};
use glam::DVec3;
use std::sync::Arc;

/// What a file holds, in the file's unit.
#[derive(Debug, Clone)]
pub struct Part {
    /// The format it came in.
    pub format: Format,
    /// The unit of all coordinates; `None` where the format has none.
    pub unit: Option<Unit>,
    /// At least one mesh or surface.
    pub items: Vec<Item>,
    /// What was mended, assumed or left out.
    pub warnings: Vec<Warning>,
}

/// One mesh or surface of a file.
#[derive(Debug, Clone)]
pub struct Item {
    /// What the file calls it, or the file's own name.
    pub name: String,
    /// Its geometry.
    pub shape: Shape,
}

/// Geometry of an item.
#[derive(Debug, Clone)]
pub enum Shape {
    /// A triangle mesh.
    Mesh(Arc<TriMesh>),
    /// A spline surface; it coerces to `Arc<dyn Surface>`.
    Surface(Arc<NurbsSurface>),
}

/// What a person wants to know about an item.
#[derive(Debug, Clone, PartialEq)]
pub enum Summary {
    /// Of a mesh.
    Mesh {
        /// Number of triangles.
        triangles: usize,
        /// Number of vertices.
        vertices: usize,
        /// Lowest and highest coordinates, in the part's unit.
        bounds: (DVec3, DVec3),
        /// How the triangles hang together.
        topology: Topology,
    },
    /// Of a spline surface.
    Surface {
        /// Degrees in u and v.
        degrees: [usize; 2],
        /// Control points in u and v.
        counts: [usize; 2],
        /// Whether weights differ.
        rational: bool,
        /// Whether the surface closes smoothly in u and v.
        periodic: [bool; 2],
        /// Lowest and highest coordinates of points on the surface, in the part's unit, sampled as [`NurbsSurface::bounds`] says.
        bounds: (DVec3, DVec3),
    },
}

/// Samples a knot span for the bounds: for a cubic of which a span turns by 60° the bulge missed is under 2 % of the span.
const BOUND_SAMPLES: usize = 4;

impl Part {
    /// The part with every coordinate multiplied by `factor`. Surfaces are scaled by their control points, which is exact; their
    /// parameters stay.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Self {
        for item in &mut self.items {
            item.shape = item.shape.scaled(factor);
        }
        self
    }

    /// The part in millimetres, from its own unit or, where it has none, from `assumed`.
    #[must_use]
    pub fn in_millimetres(self, assumed: Unit) -> Self {
        let unit = self.unit.unwrap_or(assumed);
        let scaled = if unit == Unit::Millimetre { self } else { self.scaled(unit.millimetres()) };
        Self { unit: Some(Unit::Millimetre), ..scaled }
    }
}

impl Shape {
    fn scaled(&self, factor: f64) -> Self {
        match self {
            Shape::Mesh(mesh) => Shape::Mesh(Arc::new(TriMesh {
                vertices: mesh.vertices.iter().map(|&p| p * factor).collect(),
                triangles: mesh.triangles.clone(),
            })),
            Shape::Surface(surface) => Shape::Surface(Arc::new(surface.scaled(factor))),
        }
    }
}

impl Item {
    /// Counts, bounds and topology.
    pub fn summary(&self) -> Summary {
        match &self.shape {
            Shape::Mesh(mesh) => Summary::Mesh {
                triangles: mesh.triangles.len(),
                vertices: mesh.vertices.len(),
                bounds: mesh.bounds().unwrap_or_default(),
                topology: topology::of(mesh),
            },
            Shape::Surface(surface) => Summary::Surface {
                degrees: [Along::U, Along::V].map(|along| surface.degree(along)),
                counts: [Along::U, Along::V].map(|along| surface.count(along)),
                rational: surface.is_rational(),
                periodic: [surface.domain().u.periodic, surface.domain().v.periodic],
                bounds: surface.bounds(BOUND_SAMPLES),
            },
        }
    }
}
