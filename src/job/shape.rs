//! From a specification's source to the shape that is cut.

use super::error::JobError;
use super::spec::{SideSpec, SourceSpec};
use crate::geometry::{Cone, Cylinder, Face, NurbsSurface, Plane, Range, Side, Sphere, Torus, TriMesh};
use crate::import::{self, Unit};
use crate::math::frame::Frame;
use glam::{DAffine3, DVec3};
use std::sync::Arc;

/// What is cut: a side of a surface, or the outside of a mesh.
#[derive(Debug, Clone)]
pub enum Shape {
    /// A side of a surface.
    Face(Face),
    /// A mesh, its triangles turned so that they are counter-clockwise seen from the cutter.
    Mesh(Arc<TriMesh>),
}

/// The axes of the built-in surfaces: turned about x, y or z so that their middle points to +z.
const ABOUT_X: Frame = Frame { f: DVec3::Z, b: DVec3::NEG_Y, n: DVec3::X };
const ABOUT_Y: Frame = Frame { f: DVec3::Z, b: DVec3::X, n: DVec3::Y };
const FLAT: Frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };

impl SourceSpec {
    /// The shape in millimetres, and what had to be mended or assumed on the way. `bytes` is the content of the file, for a
    /// source that is one.
    ///
    /// Errors name the setting, or say where in the file the trouble is.
    pub fn shape(&self, bytes: Option<&[u8]>) -> Result<(Shape, Vec<String>), JobError> {
        let wrong = |field: &str, message: &str| JobError::field(&format!("source.{field}"), message.into());
        let face = |surface: Option<Arc<dyn crate::geometry::Surface>>, side: &SideSpec, field, message| {
            let surface = surface.ok_or_else(|| wrong(field, message))?;
            Ok((Shape::Face(Face { surface, side: side.side() }), Vec::new()))
        };
        match self {
            Self::File { path, face, unit, scale, side } => {
                from_file(path, bytes, *face, unit.as_deref(), *scale, *side)
            }
            Self::Plane { size_mm: [x, y], side } => {
                let valid = *x > 0.0 && *y > 0.0 && x.is_finite() && y.is_finite();
                let plane = valid.then(|| {
                    let (u, v) = (Range::open(-0.5 * x, 0.5 * x), Range::open(-0.5 * y, 0.5 * y));
                    Arc::new(Plane { origin: DVec3::ZERO, frame: FLAT, u, v }) as _
                });
                face(plane, side, "size_mm", "both must be above 0 mm")
            }
            Self::Cylinder { radius_mm, angle_deg, length_mm, side } => {
                let ends = [-0.5 * length_mm, 0.5 * length_mm];
                let made = Cylinder::new(DVec3::ZERO, ABOUT_X, *radius_mm, half_angles(*angle_deg), ends);
                let message = "radius, angle and length must be above 0";
                face(made.map(|s| Arc::new(s) as _), side, "radius_mm", message)
            }
            Self::Cone { radius_start_mm, radius_end_mm, angle_deg, length_mm, side } => {
                let ends = [-0.5 * length_mm, 0.5 * length_mm];
                let slope = (radius_end_mm - radius_start_mm) / length_mm;
                let middle = 0.5 * (radius_start_mm + radius_end_mm);
                let made = Cone::new(DVec3::ZERO, ABOUT_X, middle, slope, half_angles(*angle_deg), ends);
                let message = "radii must be 0 or more, angle and length above 0";
                face(made.map(|s| Arc::new(s) as _), side, "radius_start_mm", message)
            }
            Self::Sphere { radius_mm, angle_deg: [x, y], side } => {
                let made = Sphere::new(DVec3::ZERO, ABOUT_Y, *radius_mm, half_angles(*x), half_angles(*y));
                let message =
                    "the radius must be above 0, the angles above 0, at most 360° along x and 180° along y";
                face(made.map(|s| Arc::new(s) as _), side, "radius_mm", message)
            }
            Self::Torus { major_mm, minor_mm, angle_deg: [x, y], side } => {
                let (x, y) = (half_angles(*x), half_angles(*y));
                let made = Torus::new(DVec3::ZERO, ABOUT_Y, *major_mm, *minor_mm, x, y);
                let message = "the tube and the angles must be above 0, the centre circle 0 or more";
                face(made.map(|s| Arc::new(s) as _), side, "minor_mm", message)
            }
            Self::Nurbs { degrees, knots_u, knots_v, points_mm, weights, side } => {
                let points: Vec<DVec3> = points_mm.iter().map(|p| DVec3::from_array(*p)).collect();
                let knots = [knots_u.clone(), knots_v.clone()];
                let surface = NurbsSurface::new(*degrees, knots, &points, weights.as_deref())
                    .map_err(|e| JobError::field("source", e.to_string()))?;
                Ok((Shape::Face(Face::new(surface, side.side())), Vec::new()))
            }
        }
    }
}

impl SideSpec {
    fn side(self) -> Side {
        match self {
            Self::Front => Side::Front,
            Self::Back => Side::Back,
        }
    }
}

fn half_angles(degrees: f64) -> [f64; 2] {
    let half = 0.5 * degrees.to_radians();
    [-half, half]
}

fn from_file(
    path: &str,
    bytes: Option<&[u8]>,
    face: usize,
    unit: Option<&str>,
    scale: [f64; 3],
    side: SideSpec,
) -> Result<(Shape, Vec<String>), JobError> {
    let Some(bytes) = bytes else {
        return Err(JobError::field("source.path", format!("the file {path} is not there")));
    };
    let part = import::read(path, bytes).map_err(|e| JobError::Import(format!("{path}: {e}")))?;
    let mut notes: Vec<String> = part.warnings.iter().map(ToString::to_string).collect();
    let stated = match unit {
        None => None,
        Some(name) => Some(Unit::named(name).ok_or_else(|| {
            JobError::field("source.unit", "must be a unit of length such as mm, cm, m or inch".into())
        })?),
    };
    if !scale.iter().all(|s| *s > 0.0 && s.is_finite()) {
        return Err(JobError::field("source.scale", "must be three factors above 0".into()));
    }
    let scale = DVec3::from_array(scale);
    let count = part.items.len();
    let part = match (stated, part.unit) {
        // A unit that the person states wins over the file's own.
        (Some(unit), _) => import::Part { unit: Some(unit), ..part }.in_millimetres(unit),
        (None, Some(unit)) => part.in_millimetres(unit),
        (None, None) => {
            notes.push("the file does not name its unit; millimetres are assumed".into());
            part.in_millimetres(Unit::Millimetre)
        }
    };
    let Some(item) = part.items.into_iter().nth(face) else {
        return Err(JobError::field("source.face", format!("must be from 0 to {}", count.saturating_sub(1))));
    };
    let shape = match item.shape {
        import::Shape::Surface(surface) => {
            let surface = if scale == DVec3::ONE {
                surface
            } else {
                Arc::new(surface.transformed(&DAffine3::from_scale(scale)))
            };
            Shape::Face(Face { surface, side: side.side() })
        }
        import::Shape::Mesh(mesh) => {
            let vertices = mesh.vertices.iter().map(|&v| v * scale).collect();
            let turned =
                |[a, b, c]: &[u32; 3]| if side == SideSpec::Front { [*a, *b, *c] } else { [*a, *c, *b] };
            Shape::Mesh(Arc::new(TriMesh {
                vertices,
                triangles: mesh.triangles.iter().map(turned).collect(),
            }))
        }
    };
    Ok((shape, notes))
}
