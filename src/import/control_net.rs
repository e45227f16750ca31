//! Control nets as text: a line for each row of points, `x,y,z;x,y,z;…`, as NURBS-Python (geomdl) writes them.

use super::{Format, ImportError, Item, Part, Place, Shape, Warning, text};
use crate::geometry::{MAX_POINTS, NurbsSurface};
use glam::DVec3;
use std::sync::Arc;

/// The degree that such nets are mostly drawn for; the file does not say.
const ASSUMED_DEGREE: usize = 3;

pub(super) fn read(name: &str, bytes: &[u8]) -> Result<Part, ImportError> {
    let format = Format::ControlNet;
    let content = String::from_utf8_lossy(text::without_mark(bytes));
    let mut points = Vec::new();
    let mut counts = [0, 0];
    for (number, line) in content.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        let before = points.len();
        for (column, point) in line.split(';').enumerate().filter(|(_, point)| !point.trim().is_empty()) {
            let place = Place::Cell { line: number + 1, column: column + 1 };
            points.push(read_point(point).map_err(|message| ImportError::at(format, place, message))?);
        }
        let found = points.len() - before;
        let error = |message: String| Err(ImportError::at(format, Place::Line(number + 1), message));
        if counts[0] > 0 && found != counts[1] {
            return error(format!("all rows must have as many points: {} before, here {found}", counts[1]));
        }
        if points.len() > MAX_POINTS {
            return error(format!("more than {MAX_POINTS} control points"));
        }
        counts = [counts[0] + 1, found];
    }
    let degrees = counts.map(|count| ASSUMED_DEGREE.min(count.saturating_sub(1)));
    let knots = [0, 1].map(|a| clamped_uniform(degrees[a], counts[a]));
    let surface = NurbsSurface::new(degrees, knots, &points, None)
        .map_err(|error| ImportError::at(format, Place::Whole, error.to_string()))?;
    let assumption = format!(
        "degrees {} and {} and evenly spaced knots were assumed, since a net names none",
        degrees[0], degrees[1]
    );
    Ok(Part {
        format,
        unit: None,
        items: vec![Item { name: name.to_owned(), shape: Shape::Surface(Arc::new(surface)) }],
        warnings: vec![Warning::Assumed { place: Place::Whole, assumption }],
    })
}

fn read_point(text: &str) -> Result<DVec3, String> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|n| n.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x, y, z]) => Ok(DVec3::new(x, y, z)),
        Some([_, _, _, _]) => Err(
            "points with weights need the degrees and knots that they were made for, which a net does not hold; \
             write the surface as JSON with its degrees and knots"
                .into(),
        ),
        _ => Err("a control point is three numbers parted by commas".into()),
    }
}

fn clamped_uniform(degree: usize, count: usize) -> Vec<f64> {
    let spans = count.saturating_sub(degree).max(1);
    let inner = (1..spans).map(|k| k as f64 / spans as f64);
    let ends = |x| std::iter::repeat_n(x, degree + 1);
    ends(0.0).chain(inner).chain(ends(1.0)).collect()
}
