//! The motion as a table for spreadsheets and scripts, out and in.

use super::scan::check_length;
use super::words::Rounding;
use crate::post::ReadError;
use crate::post::digits::push_fixed;
use crate::post::number::parse;
use crate::toolpath::{AxisPoint, Interpolation, TurningPath};

const HEADER: &str = "time_s,x_mm,z_mm,c_deg,x_mm_per_s,z_mm_per_s,c_deg_per_s";

/// One line a point after a header that states the units: time, position of the nose centre, angle of the tool over the
/// part, and the velocities there.
pub fn write_table(path: &TurningPath, rounding: &Rounding) -> String {
    let mut text = String::with_capacity(path.points.len() * 80 + HEADER.len() + 1);
    text.push_str(HEADER);
    text.push('\n');
    for p in &path.points {
        let [vx, vz, vc] = p.rates;
        let columns = [
            (p.time, 9),
            (p.x, rounding.length),
            (p.z, rounding.length),
            (p.c.to_degrees(), rounding.angle),
            (vx, rounding.length),
            (vz, rounding.length),
            (vc.to_degrees(), rounding.angle),
        ];
        for (i, (value, decimals)) in columns.into_iter().enumerate() {
            if i > 0 {
                text.push(',');
            }
            push_fixed(&mut text, value, decimals);
        }
        text.push('\n');
    }
    text
}

/// The path of a table that [`write_table`] wrote, to be gone through by `interpolation`.
///
/// Errors name the line.
pub fn read_table(text: &str, interpolation: Interpolation) -> Result<TurningPath, ReadError> {
    check_length(text)?;
    let mut points = Vec::new();
    for (number, raw) in (1..).zip(text.lines()).skip(1) {
        let mut cells = raw.split(',').map(parse);
        let mut next = || {
            cells
                .next()
                .flatten()
                .ok_or_else(|| ReadError::statement(number, raw, "must be seven numbers between commas"))
        };
        let (time, x, z, c) = (next()?, next()?, next()?, next()?.to_radians());
        let rates = [next()?, next()?, next()?.to_radians()];
        points.push(AxisPoint { x, z, c, time, rates });
    }
    if points.len() < 2 {
        return Err(ReadError::Missing { what: "the path", example: HEADER });
    }
    Ok(TurningPath { points, interpolation })
}
