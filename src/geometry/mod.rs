//! Surfaces, meshes and what can be measured on them.
//!
//! A [`Surface`] is evaluated once into a [`Jet`] (point, first and second derivatives); everything else, from
//! normals to curvature, is read off the jet.

mod analytic;
mod cubes;
mod curvature;
mod eikonal;
mod face;
mod field;
mod gradient_fit;
mod grid;
mod height_grid;
mod iso_line;
mod jet;
mod mesh;
mod nearest;
mod nurbs;
mod surface;
mod table;
mod zone;

pub use analytic::{Cone, Cylinder, Plane, Sphere, Torus};
pub use cubes::Cubes;
pub use curvature::{Curvature, Principal};
pub use eikonal::Fronts;
pub use face::{Face, Side};
pub use field::Field;
pub use gradient_fit::{GradientFit, Triangle, Wish, triangles};
pub use grid::FaceGrid;
pub use height_grid::{HeightGrid, HeightGridError};
pub use iso_line::{FieldGrid, IsoLine};
pub use jet::Jet;
pub use mesh::{TriMesh, pieces};
pub use nurbs::{Along, MAX_DEGREE, MAX_POINTS, NurbsError, NurbsSurface};
use nurbs::{Basis, span};
pub use surface::{Domain, Range, Surface, Uv};
pub use table::{Local, Table};
pub use zone::Zone;
