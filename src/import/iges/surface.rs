//! Entities 128 (rational B-spline surface), 126 (rational B-spline curve) and 124 (transformation matrix).

use super::file::{Entry, File, Record};
use super::{ImportError, fault};
use crate::geometry::{NurbsSurface, Range, Surface};
use glam::{DAffine3, DMat3, DVec3};

/// The surface of an entity 128, transformed, and whether the entity uses only a part of it.
pub(super) fn read(file: &File, entry: &Entry) -> Result<(NurbsSurface, bool), ImportError> {
    let record = file.record(entry)?;
    let [nu, nv] = [plus_one(&record, 1)?, plus_one(&record, 2)?];
    let [pu, pv] = [record.count(3)?, record.count(4)?];
    let [knots_u, knots_v] =
        [nu.saturating_add(pu).saturating_add(1), nv.saturating_add(pv).saturating_add(1)];
    let start_v = 10usize.saturating_add(knots_u);
    let start_weights = start_v.saturating_add(knots_v);
    let points = nu.saturating_mul(nv);
    let start_points = start_weights.saturating_add(points);
    let knots = [record.numbers(10, knots_u)?, record.numbers(start_v, knots_v)?];
    let weights = record.numbers(start_weights, points)?;
    let coordinates = record.numbers(start_points, points.saturating_mul(3))?;
    // The file runs through u first, the surface through v.
    let order = (0..nu).flat_map(|i| (0..nv).map(move |j| j * nu + i));
    let (points, weights): (Vec<_>, Vec<_>) =
        order.map(|k| (DVec3::from_slice(&coordinates[3 * k..]), weights[k])).unzip();
    let surface = NurbsSurface::new([pu, pv], knots, &points, Some(&weights))
        .map_err(|error| fault(entry, error.to_string()))?;
    // Some writers leave these four out.
    let used = record.numbers(start_points + coordinates.len(), 4).ok();
    let partly = used.is_some_and(|used| is_partial(&surface, &used));
    let surface = match placement(file, entry)? {
        Some(map) => surface.transformed(&map),
        None => surface,
    };
    Ok((surface, partly))
}

/// Whether the intervals `used`, of u and then v, leave out more of the domain than rounding in the file does.
fn is_partial(surface: &NurbsSurface, used: &[f64]) -> bool {
    const ROUNDING: f64 = 1e-6;
    let domain = surface.domain();
    let inside = |range: Range, used: &[f64]| {
        (used[0] - range.lo).max(range.hi - used[1]) > ROUNDING * range.length() && used[0] < used[1]
    };
    inside(domain.u, &used[..2]) || inside(domain.v, &used[2..])
}

/// A count that is stored less one.
fn plus_one(record: &Record<'_>, index: usize) -> Result<usize, ImportError> {
    record.count(index).map(|count| count.saturating_add(1))
}

/// The transformation of `entry`; `None` where it has none.
pub(super) fn placement(file: &File, entry: &Entry) -> Result<Option<DAffine3>, ImportError> {
    // A matrix may be transformed by another; longer chains than this go in a circle.
    const LONGEST: usize = 16;
    let mut map: Option<DAffine3> = None;
    let mut number = entry.matrix;
    for _ in 0..LONGEST {
        if number == 0 {
            return Ok(map);
        }
        let matrix = file.entry(number).filter(|matrix| matrix.kind == 124);
        let matrix =
            matrix.ok_or_else(|| fault(entry, format!("D{number} is no transformation matrix (124)")))?;
        let m = file.record(matrix)?.numbers(1, 12)?;
        let rows = DMat3::from_cols_array(&[m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]]);
        let own = DAffine3 { matrix3: rows.transpose(), translation: DVec3::new(m[3], m[7], m[11]) };
        map = Some(map.map_or(own, |inner| own * inner));
        number = matrix.matrix;
    }
    Err(fault(entry, "its transformation matrices refer to one another in a circle"))
}

/// The curve of an entity 126 as a surface without width, so that one evaluation serves both, and its interval.
pub(super) fn curve(file: &File, entry: &Entry) -> Result<(NurbsSurface, [f64; 2]), ImportError> {
    let record = file.record(entry)?;
    let (count, degree) = (plus_one(&record, 1)?, record.count(2)?);
    let knot_count = count.saturating_add(degree).saturating_add(1);
    let start_weights = 7usize.saturating_add(knot_count);
    let start_points = start_weights.saturating_add(count);
    let end = start_points.saturating_add(count.saturating_mul(3));
    let knots = record.numbers(7, knot_count)?;
    let weights: Vec<f64> = record.numbers(start_weights, count)?.iter().flat_map(|&w| [w, w]).collect();
    let coordinates = record.numbers(start_points, count.saturating_mul(3))?;
    let interval = record.numbers(end, 2)?;
    let points: Vec<DVec3> =
        coordinates.chunks_exact(3).map(DVec3::from_slice).flat_map(|p| [p, p]).collect();
    let knots = [knots, vec![0.0, 0.0, 1.0, 1.0]];
    let curve = NurbsSurface::new([degree, 1], knots, &points, Some(&weights))
        .map_err(|error| fault(entry, error.to_string()))?;
    Ok((curve, [interval[0], interval[1]]))
}
