//! What is inside a file, for a person who has to choose.

use super::error::JobError;
use crate::import::{self, Summary};
use serde::Serialize;

/// What is inside a file.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Inspection {
    /// The format, recognised by content.
    pub format: String,
    /// The unit that the file names, if it does.
    pub unit: Option<String>,
    /// What was mended, assumed or left out.
    pub warnings: Vec<String>,
    /// The shapes to choose from.
    pub faces: Vec<Inspected>,
}

/// One shape of a file.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Inspected {
    /// Its number, for `source.face`.
    pub index: usize,
    /// What the file calls it.
    pub name: String,
    /// `surface` or `mesh`.
    pub kind: &'static str,
    /// Counts and degrees in words.
    pub detail: String,
    /// Factors that make a handy model of a grid that does not state its spacing, for `source.scale`; otherwise 1.
    pub suggested_scale: [f64; 3],
    /// Lowest and highest coordinates in millimetres; for a file without a unit, in millimetres as assumed.
    pub bounds_mm: [[f64; 3]; 2],
}

impl Inspection {
    /// As JSON text.
    pub fn to_json(&self) -> String {
        // Strings and finite numbers always have a JSON form.
        serde_json::to_string(self).unwrap_or_default()
    }
}

/// What is inside the file `name` with the content `bytes`.
pub fn inspect(name: &str, bytes: &[u8]) -> Result<Inspection, JobError> {
    let part = import::read(name, bytes).map_err(|e| JobError::Import(format!("{name}: {e}")))?;
    let format = part.format.to_string();
    let unit = part.unit.map(|u| u.to_string());
    let warnings = part.warnings.iter().map(ToString::to_string).collect();
    let part = part.in_millimetres(import::Unit::Millimetre);
    let faces = part
        .items
        .iter()
        .enumerate()
        .map(|(index, item)| {
            let (kind, detail, bounds) = describe(&item.summary());
            let bounds_mm = [bounds.0.to_array(), bounds.1.to_array()];
            let suggested_scale = if part.format == import::Format::Table { handy(bounds) } else { [1.0; 3] };
            Inspected { index, name: item.name.clone(), kind, detail, suggested_scale, bounds_mm }
        })
        .collect();
    Ok(Inspection { format, unit, warnings, faces })
}

/// Factors that bring a grid of heights to 100 mm across, with a height of 8 mm. A grid that is not
/// much higher than wide is taken for one in real units.
fn handy((low, high): (glam::DVec3, glam::DVec3)) -> [f64; 3] {
    let size = high - low;
    let across = size.x.max(size.y);
    if !(across > 0.0 && size.z > 2.0 * across) {
        return [1.0; 3];
    }
    // Two digits: a person reads and changes them. Text of a finite number reads back.
    let round = |x: f64| format!("{x:.1e}").parse().unwrap_or(1.0);
    let flat = round(100.0 / across);
    [flat, flat, round(8.0 / size.z)]
}

fn describe(summary: &Summary) -> (&'static str, String, (glam::DVec3, glam::DVec3)) {
    match summary {
        Summary::Mesh { triangles, vertices, bounds, topology } => {
            let mut detail = format!("{triangles} triangles, {vertices} vertices");
            if topology.boundary_edges > 0 {
                detail += &format!(", {} open edges", topology.boundary_edges);
            }
            if topology.non_manifold_edges > 0 {
                detail += &format!(", {} edges with more than two triangles", topology.non_manifold_edges);
            }
            ("mesh", detail, *bounds)
        }
        Summary::Surface { degrees, counts, rational, periodic, bounds } => {
            let kind = if *rational { "rational B-spline" } else { "B-spline" };
            let mut detail = format!(
                "{kind} of degrees {} and {}, {} × {} control points",
                degrees[0], degrees[1], counts[0], counts[1]
            );
            for (closed, name) in periodic.iter().zip(["u", "v"]) {
                if *closed {
                    detail += &format!(", closed in {name}");
                }
            }
            ("surface", detail, *bounds)
        }
    }
}
