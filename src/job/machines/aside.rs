//! Tilting the tool aside where it would pass a machine's pole, about its own contact with the part.

use super::contacts::Contact;
use crate::cutter::Cutter;
use crate::job::error::JobError;
use crate::toolpath::{ClPoint, Role, Toolpath};
use glam::DVec3;

/// How far a contact may be from the corner that is thought to touch there, mm.
const ON_CORNER: f64 = 0.02;

/// Leads the axis of `path` around the direction `pole` at `angle` (radians) where cuts pass it nearer by: evenly from where they come
/// in to where they go out, so that the rotary axis that is free in the pole turns steadily. Gives the moves that were tilted.
///
/// The cutter turns about the middle of its corner's circle at the contact: it touches the part in the same point with the same normal,
/// and only the strip that it finishes there changes, by what a lead changes it that differs by up to twice the angle. The proof tells by
/// how much. Runs that begin or end a pass, and those whose contact is not on the corner, are left alone.
///
/// Errors: no contacts; a cutter without a corner.
pub(super) fn tilt_aside(
    path: &mut Toolpath,
    cutter: &Cutter,
    contacts: &[Option<Contact>],
    pole: DVec3,
    angle: f64,
) -> Result<Vec<usize>, JobError> {
    let wrong = |why: &str| JobError::field("following.pole", why.into());
    if contacts.len() != path.moves.len() {
        return Err(wrong("to tilt aside takes the table of the path's contacts"));
    }
    if cutter.corner_radius <= 0.0 {
        return Err(wrong("to tilt aside takes a cutter with a rounded corner"));
    }
    let mut tilted = Vec::new();
    let mut at = 1;
    while at + 1 < path.moves.len() {
        let near = |k: usize| {
            let step = &path.moves[k];
            step.role == Role::Cut && contacts[k].is_some() && nearest(pole, step.to.axis).1 < angle
        };
        let count = (at..path.moves.len() - 1).take_while(|k| near(*k)).count();
        if count > 0 && path.moves[at + count].role == Role::Cut {
            let found = around(path, cutter, contacts, (pole, angle), at..at + count);
            for (k, to) in (at..).zip(found.into_iter().flatten()) {
                path.moves[k].to = to;
                tilted.push(k);
            }
        }
        at += count + 1;
    }
    Ok(tilted)
}

/// The end of the line along `pole` that is nearer to `axis`, and the angle to it, radians.
fn nearest(pole: DVec3, axis: DVec3) -> (DVec3, f64) {
    let end = if pole.dot(axis) < 0.0 { -pole } else { pole };
    (end, libm::atan2(end.cross(axis).length(), end.dot(axis)))
}

/// Locations for the moves of `run`; nothing where they cannot be tilted.
fn around(
    path: &Toolpath,
    cutter: &Cutter,
    contacts: &[Option<Contact>],
    (pole, angle): (DVec3, f64),
    run: std::ops::Range<usize>,
) -> Option<Vec<ClPoint>> {
    let moves = &path.moves;
    let (before, after) = (moves[run.start - 1].to.axis, moves[run.end].to.axis);
    let pole = nearest(pole, moves[run.start].to.axis).0;
    let first = (before - pole * before.dot(pole)).try_normalize()?;
    let second = pole.cross(first);
    let turn = libm::atan2(after.dot(second), after.dot(first));
    let way = |k: usize| moves[k].to.tip.distance(moves[k - 1].to.tip);
    let whole: f64 = (run.start..=run.end).map(way).sum();
    let (sine, cosine) = libm::sincos(angle);
    let mut gone = 0.0;
    run.map(|k| {
        gone += way(k);
        let (s, c) = libm::sincos(turn * gone / whole);
        let axis = cosine * pole + sine * (c * first + s * second);
        turned(cutter, &moves[k].to, contacts[k]?.point, axis)
    })
    .collect()
}

/// The cutter with another axis, touching the same point with the same normal.
fn turned(cutter: &Cutter, cl: &ClPoint, contact: DVec3, axis: DVec3) -> Option<ClPoint> {
    let middle = cl.tip + cutter.center_height * cl.axis;
    let out = contact - middle;
    let out = (out - cl.axis * out.dot(cl.axis)).try_normalize()?;
    let corner = middle + cutter.center_radius * out;
    let normal = (corner - contact).try_normalize()?;
    if (corner.distance(contact) - cutter.corner_radius).abs() > ON_CORNER {
        return None;
    }
    let out = (axis * axis.dot(normal) - normal).try_normalize()?;
    let middle = corner - cutter.center_radius * out;
    Some(ClPoint { tip: middle - cutter.center_height * axis, axis })
}
