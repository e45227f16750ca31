//! Where a path touches the part, from the table that comes with it.

use crate::job::error::JobError;
use crate::machine::Touching;
use crate::toolpath::{ClPoint, Move, Toolpath};
use glam::DVec3;

/// Where the cutter touches at the end of a move, and how it leans there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// The contact point, mm.
    pub point: DVec3,
    /// Angle between axis and surface normal, radians.
    pub lead: f64,
}

/// Farthest that a tip of the table may be from that of the path, mm: both are rounded.
const SAME: f64 = 1e-3;

/// The contacts of the moves of `path`, from the table (CSV) that was written with it; nothing where the cutter touches nothing.
///
/// Errors name the line: a column that is missing, a number that is none, a table of another path.
pub fn contacts(table: &str, path: &Toolpath) -> Result<Vec<Option<Contact>>, JobError> {
    let wrong = |line: usize, why: &str| JobError::Post(format!("table of contacts: line {line}: {why}"));
    let mut lines = (1..).zip(table.lines());
    let (_, head) = lines.next().ok_or_else(|| wrong(1, "the head is missing"))?;
    let names: Vec<&str> = head.split(',').map(str::trim).collect();
    let column = |name: &str| {
        let found = names.iter().position(|other| *other == name);
        found.ok_or_else(|| wrong(1, &format!("the column {name} is missing")))
    };
    let tip = [column("x_mm")?, column("y_mm")?, column("z_mm")?];
    let point = [column("contact_x_mm")?, column("contact_y_mm")?, column("contact_z_mm")?];
    let lead = column("lead_deg")?;
    let mut found = Vec::with_capacity(path.moves.len());
    for (line, text) in lines.filter(|(_, text)| !text.trim().is_empty()) {
        let cells: Vec<&str> = text.split(',').map(str::trim).collect();
        let number = |at: usize| -> Result<Option<f64>, JobError> {
            match cells.get(at) {
                None | Some(&"") => Ok(None),
                Some(cell) => match cell.parse::<f64>() {
                    Ok(x) if x.is_finite() => Ok(Some(x)),
                    _ => Err(wrong(line, &format!("{}: {cell} is no number", names[at]))),
                },
            }
        };
        let place = |at: [usize; 3]| -> Result<Option<DVec3>, JobError> {
            let [x, y, z] = [number(at[0])?, number(at[1])?, number(at[2])?];
            Ok(x.zip(y).zip(z).map(|((x, y), z)| DVec3::new(x, y, z)))
        };
        let step = path.moves.get(found.len()).zip(place(tip)?);
        if step.is_none_or(|(step, tip)| step.to.tip.distance(tip) > SAME) {
            return Err(wrong(line, "is no move of this path: take the table that was written with it"));
        }
        found.push(
            place(point)?.zip(number(lead)?).map(|(point, lead)| Contact { point, lead: lead.to_radians() }),
        );
    }
    if found.len() != path.moves.len() {
        let why =
            format!("the path has {} moves, and the table ends after {}", path.moves.len(), found.len());
        return Err(wrong(found.len() + 1, &why));
    }
    Ok(found)
}

/// The contacts of the moves of `path` with the normals of the surface, which follow from how the tool leans there.
pub(super) fn touching(path: &Toolpath, contacts: &[Option<Contact>]) -> Vec<Option<Touching>> {
    let touch = |(step, contact): (&Move, &Option<Contact>)| {
        let (Contact { point, lead }, ClPoint { tip, axis }) = ((*contact)?, step.to);
        let (sine, cosine) = libm::sincos(lead);
        // Upright there is no direction to lean to, and none is needed.
        let out = (point - tip) - axis * (point - tip).dot(axis);
        Some(Touching { point, normal: cosine * axis - sine * out.normalize_or_zero() })
    };
    path.moves.iter().zip(contacts).map(touch).collect()
}
