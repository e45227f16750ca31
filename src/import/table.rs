//! Heights as text: a matrix of heights, or rows of x, y, z over a regular grid.
//!
//! Cells are parted by tabs, semicolons, commas or blanks. Empty lines and lines that begin with `#` are passed over.
//!
//! - **Rows of three cells** are x, y and z, in any order of rows; a header naming `x`, `y` and `z` may exchange the columns.
//! - **Anything wider** is a matrix of heights: a column for each x, a row for each y. A header row of numbers gives the x, a
//!   first column under an empty or worded corner gives the y; without them places are one unit apart.

use super::stl::clipped;
use super::{Format, ImportError, Item, Part, Place, Shape, Warning, text};
use crate::geometry::{HeightGrid, MAX_POINTS};
use crate::math::order::sort_numbers;
use glam::{DVec2, DVec3};
use std::sync::Arc;

pub(super) fn read(name: &str, bytes: &[u8]) -> Result<Part, ImportError> {
    let content = String::from_utf8_lossy(text::without_mark(bytes));
    let rows = rows(&content)?;
    let (header, body) = match rows.split_first() {
        Some((first, body)) if first.cells.iter().any(|cell| cell.parse::<f64>().is_err()) => {
            (Some(first), body)
        }
        _ => (None, rows.as_slice()),
    };
    let width = rows[0].cells.len();
    let mut warnings = Vec::new();
    let grid = if width == 3 && header.is_none_or(|row| !row.cells[0].is_empty()) {
        scattered(header, body)?
    } else {
        matrix(header, body, &mut warnings)?
    };
    let whole = |error: &dyn std::fmt::Display| fault(Place::Whole, error.to_string());
    let surface = grid.surface().map_err(|error| whole(&error))?;
    let item = Item { name: name.to_owned(), shape: Shape::Surface(Arc::new(surface)) };
    Ok(Part { format: Format::Table, unit: None, items: vec![item], warnings })
}

fn fault(place: Place, message: impl Into<String>) -> ImportError {
    ImportError::at(Format::Table, place, message)
}

/// A line that holds cells.
struct Row<'a> {
    line: usize,
    cells: Vec<&'a str>,
}

impl Row<'_> {
    /// The number in `column`, counted from 0.
    fn number(&self, column: usize) -> Result<f64, ImportError> {
        let cell = self.cells[column];
        let place = Place::Cell { line: self.line, column: column + 1 };
        match cell.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ if cell.is_empty() => {
                Err(fault(place, "the cell is empty; every place of the grid needs a height"))
            }
            Ok(_) => Err(fault(
                place,
                format!("`{cell}` is no height; every place of the grid needs a finite one"),
            )),
            Err(_) => Err(fault(place, format!("`{}` is no number", clipped(cell)))),
        }
    }
}

/// The rows of the table, all equally wide.
fn rows(content: &str) -> Result<Vec<Row<'_>>, ImportError> {
    let lines =
        content.lines().enumerate().filter(|(_, l)| !l.trim().is_empty() && !l.trim_start().starts_with('#'));
    let mut rows: Vec<Row<'_>> = Vec::new();
    let mut delimiter = text::Delimiter::Blank;
    let mut trailing = false;
    let mut cells_so_far = 0;
    for (number, line) in lines {
        if rows.is_empty() {
            delimiter = text::Delimiter::of(line);
        }
        let mut cells: Vec<&str> = delimiter.split(line).collect();
        if rows.is_empty() {
            trailing = cells.len() > 1 && cells.last() == Some(&"");
        }
        if trailing && cells.last() == Some(&"") {
            cells.pop();
        }
        let row = Row { line: number + 1, cells };
        if let Some(first) = rows.first().filter(|first| first.cells.len() != row.cells.len()) {
            let message = format!(
                "{} cells, but {} in line {}; all rows must be equally wide",
                row.cells.len(),
                first.cells.len(),
                first.line
            );
            return Err(fault(Place::Line(row.line), message));
        }
        cells_so_far += row.cells.len();
        // Three cells a place at the most.
        if cells_so_far > 3 * MAX_POINTS {
            return Err(fault(Place::Line(row.line), format!("more than {MAX_POINTS} places of the grid")));
        }
        rows.push(row);
    }
    if rows.is_empty() {
        return Err(fault(Place::Whole, "the table has no rows"));
    }
    Ok(rows)
}

/// A grid's places along one axis.
struct Axis {
    lowest: f64,
    spacing: f64,
    falling: bool,
}

/// Deviation from even spacing, over the spacing, that is taken for rounding in the file.
const UNEVEN: f64 = 1e-3;

/// Reads evenly spaced values, rising or falling; `None` where they are not.
fn axis(values: &[f64]) -> Option<Axis> {
    let (first, last) = (*values.first()?, *values.last()?);
    let step = (last - first) / (values.len() - 1) as f64;
    let even =
        values.iter().enumerate().all(|(k, v)| (v - (first + step * k as f64)).abs() <= UNEVEN * step.abs());
    (even && step != 0.0 && step.is_finite()).then(|| Axis {
        lowest: first.min(last),
        spacing: step.abs(),
        falling: step < 0.0,
    })
}

fn matrix(
    header: Option<&Row>,
    body: &[Row],
    warnings: &mut Vec<Warning>,
) -> Result<HeightGrid, ImportError> {
    let corner = header.is_some_and(|row| row.cells[0].parse::<f64>().is_err());
    let named = header.is_some_and(|row| row.cells[1..].iter().any(|cell| cell.parse::<f64>().is_err()));
    // A worded corner over worded columns is a column's name like the others.
    let index = corner && (!named || header.is_some_and(|row| row.cells[0].is_empty()));
    let first = usize::from(index);
    let unit = |along: &str| {
        let assumption =
            format!("places along {along} were taken to be one unit apart, since the table says nothing");
        Warning::Assumed { place: Place::Whole, assumption }
    };
    let unit_axis = Axis { lowest: 0.0, spacing: 1.0, falling: false };
    let x = match header.filter(|_| !named) {
        Some(row) => {
            let values = (first..row.cells.len()).map(|k| row.number(k)).collect::<Result<Vec<_>, _>>()?;
            axis(&values).ok_or_else(|| fault(Place::Line(row.line), uneven("x, in the header,")))?
        }
        None => {
            warnings.push(unit("x"));
            Axis { ..unit_axis }
        }
    };
    let y = if index {
        let values = body.iter().map(|row| row.number(0)).collect::<Result<Vec<_>, _>>()?;
        axis(&values).ok_or_else(|| fault(Place::Whole, uneven("y, in the first column,")))?
    } else {
        warnings.push(unit("y"));
        unit_axis
    };
    let counts = [body.first().map_or(0, |row| row.cells.len() - first), body.len()];
    let mut heights = vec![0.0; counts[0] * counts[1]];
    for (j, row) in body.iter().enumerate() {
        for i in 0..counts[0] {
            let turned = |k: usize, a: usize, falling: bool| if falling { counts[a] - 1 - k } else { k };
            heights[turned(i, 0, x.falling) * counts[1] + turned(j, 1, y.falling)] = row.number(first + i)?;
        }
    }
    grid(x, y, counts, heights)
}

fn uneven(what: &str) -> String {
    format!("the values of {what} are not evenly spaced; only regular grids are read")
}

fn grid(x: Axis, y: Axis, counts: [usize; 2], heights: Vec<f64>) -> Result<HeightGrid, ImportError> {
    let (origin, spacing) = (DVec2::new(x.lowest, y.lowest), DVec2::new(x.spacing, y.spacing));
    HeightGrid::new(origin, spacing, counts, heights).map_err(|error| fault(Place::Whole, error.to_string()))
}

/// The grid of points in rows of x, y and z.
fn scattered(header: Option<&Row>, body: &[Row]) -> Result<HeightGrid, ImportError> {
    let named = |name: &str| header?.cells.iter().position(|cell| cell.eq_ignore_ascii_case(name));
    let columns = match (named("x"), named("y"), named("z")) {
        (Some(x), Some(y), Some(z)) => [x, y, z],
        _ => [0, 1, 2],
    };
    let point =
        |row: &Row| Ok(DVec3::new(row.number(columns[0])?, row.number(columns[1])?, row.number(columns[2])?));
    let points = body.iter().map(point).collect::<Result<Vec<DVec3>, ImportError>>()?;
    let (x, nx) = levels("x", points.iter().map(|p| p.x).collect())?;
    let (y, ny) = levels("y", points.iter().map(|p| p.y).collect())?;
    if nx.checked_mul(ny) != Some(points.len()) {
        let message = format!(
            "{} points with {nx} different x and {ny} different y are no regular grid, which would need {nx} × {ny} points",
            points.len()
        );
        return Err(fault(Place::Whole, message));
    }
    let mut heights = vec![f64::NAN; nx * ny];
    for (p, row) in points.iter().zip(body) {
        let number = |v: f64, axis: &Axis, count: usize| {
            (((v - axis.lowest) / axis.spacing).round() as usize).min(count - 1)
        };
        let place = &mut heights[number(p.x, &x, nx) * ny + number(p.y, &y, ny)];
        if !place.is_nan() {
            return Err(fault(
                Place::Line(row.line),
                format!("the place x = {}, y = {} stands twice", p.x, p.y),
            ));
        }
        *place = p.z;
    }
    grid(x, y, [nx, ny], heights)
}

/// The evenly spaced levels among `values`, and how many there are.
fn levels(name: &str, mut values: Vec<f64>) -> Result<(Axis, usize), ImportError> {
    sort_numbers(&mut values);
    let range = values.last().zip(values.first()).map_or(0.0, |(hi, lo)| hi - lo);
    // Equal levels may differ by rounding; the finest grid read has far fewer than 1e7 levels.
    values.dedup_by(|next, level| *next - *level <= 1e-7 * range);
    let axis = axis(&values).ok_or_else(|| fault(Place::Whole, uneven(name)))?;
    Ok((axis, values.len()))
}
