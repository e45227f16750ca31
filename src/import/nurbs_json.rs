//! Spline surfaces as JSON.
//!
//! ```json
//! {
//!   "unit": "mm",
//!   "degree_u": 3, "degree_v": 2,
//!   "knots_u": [0, 0, 0, 0, 1, 1, 1, 1],
//!   "knots_v": [0, 0, 0, 1, 1, 1],
//!   "control_points": [[[0, 0, 0], [0, 5, 1], [0, 10, 0]], …],
//!   "weights": [[1, 0.7, 1], …]
//! }
//! ```
//!
//! `control_points[i][j]` is the point numbered `i` along u and `j` along v, not multiplied by its weight. `unit` (as
//! [`Unit::named`](super::Unit::named) reads it), `weights` and `name` may be missing. A list of such objects, or an object with the list
//! under `surfaces`, gives several surfaces.
//!
//! The trimmed surfaces of curvo (`{"surface": {"control_points", "u_degree", …}, "exterior", "interiors"}`) are read too: there a point is
//! `[w x, w y, w z, w]`. Their trimming curves are not applied.

use super::{Format, ImportError, Item, Part, Place, Shape, Unit, Warning, text};
use crate::geometry::{MAX_POINTS, NurbsSurface};
use glam::DVec3;
use serde_json::Value;
use std::sync::Arc;

/// Largest JSON read, 64 MiB: a parsed number takes 32 bytes against two or more in the file, so that this may grow to a gigabyte.
pub const MAX_BYTES: usize = 64 << 20;

pub(super) fn read(stem: &str, bytes: &[u8]) -> Result<Part, ImportError> {
    if bytes.len() > MAX_BYTES {
        let message = format!("{} bytes; of JSON at most {MAX_BYTES} are read", bytes.len());
        return Err(ImportError::at(Format::Json, Place::Whole, message));
    }
    let root: Value = serde_json::from_slice(text::without_mark(bytes)).map_err(|error| {
        let place = Place::Cell { line: error.line(), column: error.column() };
        ImportError::at(Format::Json, place, error.to_string())
    })?;
    let mut part = Part { format: Format::Json, unit: None, items: Vec::new(), warnings: Vec::new() };
    let list = root.as_array().or_else(|| root.get("surfaces").and_then(Value::as_array));
    let outer = unit(&root, "")?;
    for (k, value) in list.map_or(std::slice::from_ref(&root), Vec::as_slice).iter().enumerate() {
        let path = if list.is_some() { format!("surface {k}: ") } else { String::new() };
        let own = unit(value, &path)?.or(outer);
        if k > 0 && own != part.unit {
            return Err(error(&path, "unit", "all surfaces of a file must have one unit"));
        }
        part.unit = own;
        let fallback = if list.is_some() { format!("{stem} {}", k + 1) } else { stem.to_owned() };
        let name = value.get("name").and_then(Value::as_str).map_or(fallback, str::to_owned);
        if value.get("exterior").is_some_and(|e| !e.is_null()) || has_entries(value.get("interiors")) {
            let why = "it is trimmed by `exterior` or `interiors`".to_owned();
            part.warnings.push(Warning::Trimmed { face: name.clone(), why });
        }
        part.items.push(Item { name, shape: Shape::Surface(Arc::new(surface(value, &path)?)) });
    }
    if part.items.is_empty() {
        return Err(error("", "surfaces", "the list is empty; at least one surface is needed"));
    }
    Ok(part)
}

fn error(path: &str, field: &str, message: impl Into<String>) -> ImportError {
    ImportError::at(Format::Json, Place::Field(format!("{path}`{field}`")), message)
}

fn has_entries(value: Option<&Value>) -> bool {
    value.and_then(Value::as_array).is_some_and(|list| !list.is_empty())
}

fn unit(value: &Value, path: &str) -> Result<Option<Unit>, ImportError> {
    match value.get("unit") {
        None | Some(Value::Null) => Ok(None),
        Some(given) => match given.as_str().and_then(Unit::named) {
            Some(unit) => Ok(Some(unit)),
            None => Err(error(
                path,
                "unit",
                format!("{given} is no unit known; write mm, cm, m, µm, in, mil or ft"),
            )),
        },
    }
}

/// How a file spells the fields of a surface and what its points are.
struct Dialect {
    degrees: [&'static str; 2],
    knots: [&'static str; 2],
    homogeneous: bool,
}

const OWN: Dialect =
    Dialect { degrees: ["degree_u", "degree_v"], knots: ["knots_u", "knots_v"], homogeneous: false };
const CURVO: Dialect =
    Dialect { degrees: ["u_degree", "v_degree"], knots: ["u_knots", "v_knots"], homogeneous: true };

fn surface(value: &Value, path: &str) -> Result<NurbsSurface, ImportError> {
    let body = value.get("surface").unwrap_or(value);
    let dialect = if body.get("u_degree").is_some() { CURVO } else { OWN };
    let degree = |field: &str| {
        let number = body.get(field).and_then(Value::as_u64).and_then(|n| usize::try_from(n).ok());
        number.ok_or_else(|| error(path, field, "must be there as a whole number"))
    };
    let knots = |field: &str| {
        let list = body.get(field).and_then(Value::as_array);
        let numbers = list.and_then(|list| list.iter().map(Value::as_f64).collect::<Option<Vec<_>>>());
        numbers.ok_or_else(|| error(path, field, "must be there as a list of numbers"))
    };
    let rows = matrix(body, "control_points", path)?;
    let (mut points, mut weights) = (Vec::new(), Vec::new());
    for (i, row) in rows.iter().enumerate() {
        for (j, cell) in row.iter().enumerate() {
            let (point, weight) = point(cell, dialect.homogeneous)
                .map_err(|message| error(path, &format!("control_points[{i}][{j}]"), message))?;
            points.push(point);
            weights.extend(weight);
        }
    }
    if let Some(given) = body.get("weights").filter(|given| !given.is_null() && !dialect.homogeneous) {
        let message = "must be rows of numbers like the control points";
        weights = flat_numbers(given).ok_or_else(|| error(path, "weights", message))?;
    } else if !dialect.homogeneous {
        weights.clear();
    }
    let degrees = [degree(dialect.degrees[0])?, degree(dialect.degrees[1])?];
    let knots = [knots(dialect.knots[0])?, knots(dialect.knots[1])?];
    let expected = [0, 1].map(|a| knots[a].len().saturating_sub(degrees[a].saturating_add(1)));
    let found = [rows.len(), rows.first().map_or(0, |row| row.len())];
    if found != expected {
        let message = format!(
            "knots and degrees ask for {} rows of {} points, found {} rows of {}",
            expected[0], expected[1], found[0], found[1]
        );
        return Err(error(path, "control_points", message));
    }
    NurbsSurface::new(degrees, knots, &points, (!weights.is_empty()).then_some(&weights))
        .map_err(|fault| error(path, "surface", fault.to_string()))
}

/// The rows under `field`, all equally long.
fn matrix<'a>(body: &'a Value, field: &str, path: &str) -> Result<Vec<&'a [Value]>, ImportError> {
    let rows = body.get(field).and_then(Value::as_array);
    let rows = rows.and_then(|rows| {
        rows.iter().map(|row| row.as_array().map(Vec::as_slice)).collect::<Option<Vec<_>>>()
    });
    let rows = rows.ok_or_else(|| error(path, field, "must be there as a list of rows"))?;
    if rows.iter().any(|row| row.len() != rows[0].len()) {
        return Err(error(path, field, "all rows must have as many points"));
    }
    if rows.iter().map(|row| row.len()).sum::<usize>() > MAX_POINTS {
        return Err(error(path, field, format!("at most {MAX_POINTS} points are read")));
    }
    Ok(rows)
}

/// A control point in millimetres, and its weight where it brings one.
fn point(cell: &Value, homogeneous: bool) -> Result<(DVec3, Option<f64>), String> {
    let numbers: Option<Vec<f64>> = cell.as_array().and_then(|list| list.iter().map(Value::as_f64).collect());
    match (numbers.as_deref(), homogeneous) {
        (Some(&[x, y, z]), false) => Ok((DVec3::new(x, y, z), None)),
        (Some(&[x, y, z, w]), true) if w > 0.0 => Ok((DVec3::new(x, y, z) / w, Some(w))),
        (Some([_, _, _, w]), true) => Err(format!("the weight must be above 0, found {w}")),
        (_, false) => Err("must be three numbers".into()),
        (_, true) => Err("must be four numbers, `[w x, w y, w z, w]`".into()),
    }
}

/// The numbers of a list, or of rows of them, in order.
fn flat_numbers(value: &Value) -> Option<Vec<f64>> {
    let mut numbers = Vec::new();
    for entry in value.as_array()? {
        match entry.as_array() {
            Some(row) => numbers.extend(row.iter().map(Value::as_f64).collect::<Option<Vec<_>>>()?),
            None => numbers.push(entry.as_f64()?),
        }
    }
    Some(numbers)
}
