//! Tables of heights.

use super::spec::{ApertureSpec, GivenSpec, SurfaceSpec, TurningSpec};
use crate::job::error::JobError;

/// Heights in rows of equal length, parted by commas, semicolons or blanks, and how many make a row.
pub(super) fn table(bytes: &[u8]) -> Result<(Vec<f64>, usize), String> {
    let text = std::str::from_utf8(bytes).map_err(|_| "is not text".to_string())?;
    let (mut numbers, mut columns) = (Vec::new(), 0);
    for (line, raw) in (1..).zip(text.lines()).filter(|(_, raw)| !raw.trim().is_empty()) {
        let before = numbers.len();
        let cells = raw.split(|c: char| c == ',' || c == ';' || c.is_whitespace());
        for cell in cells.filter(|cell| !cell.is_empty()) {
            let number = cell.parse::<f64>().ok().filter(|z| z.is_finite());
            numbers.push(number.ok_or_else(|| format!("line {line}: `{cell}` is no number"))?);
        }
        let found = numbers.len() - before;
        if columns != 0 && found != columns {
            return Err(format!("line {line}: {found} numbers, but the first row has {columns}"));
        }
        columns = found;
    }
    Ok((numbers, columns))
}

impl TurningSpec {
    /// The specification with the heights of a file in itself, as a map with the spacing that it states already; an aperture that goes
    /// beyond the map becomes the largest round one on it.
    ///
    /// Errors say which line of the file is wrong.
    pub fn with_table(&self, bytes: &[u8]) -> Result<Self, JobError> {
        let (numbers, columns) = table(bytes).map_err(JobError::Import)?;
        let (given, [dx, dy]) = match self.surface {
            SurfaceSpec::Grid { given, spacing_x_mm, spacing_y_mm, .. } => {
                (given, [spacing_x_mm, spacing_y_mm])
            }
            _ => (GivenSpec::Heights, [1.0; 2]),
        };
        let rows = numbers.len().checked_div(columns).unwrap_or(0);
        let mut spec = self.clone();
        let ([shift_x_mm, shift_y_mm], angle) = self.surface.held();
        spec.surface = SurfaceSpec::Grid {
            given,
            columns: columns as f64,
            spacing_x_mm: dx,
            spacing_y_mm: dy,
            heights_mm: numbers,
            path: String::new(),
            shift_x_mm,
            shift_y_mm,
            turn_deg: angle.to_degrees(),
        };
        let part = spec.part(None)?;
        if spec.aperture().largest_share(|[x, y]| part.reaches(x, y)) < 1.0 {
            let half = 0.5 * f64::min(dx * (columns - 1) as f64, dy * (rows - 1) as f64);
            spec.aperture = ApertureSpec::Round {
                radius_mm: half,
                center_x_mm: shift_x_mm,
                center_y_mm: shift_y_mm,
                turn_deg: 0.0,
            };
        }
        Ok(spec)
    }
}
