//! Passes along parallel plane sections.

use super::family::Family;
use super::{Finish, Order, Planned, StrategyError};
use crate::cutter::Tool;
use crate::geometry::{Face, FaceGrid, Field};
use crate::math::frame::Frame;
use crate::monitor::Stage;
use crate::posture::Rule;
use glam::DVec3;

/// Passes along sections of `face` by parallel planes that hold the face's mean normal, turned about it by `angle`
/// (radians; 0 is along the x axis as seen along the mean normal), the axis
/// leaning by `rule`.
///
/// Each pass lies as far from the last as lets their strips meet everywhere.
pub fn iso_planar(
    face: &Face,
    tool: &Tool,
    angle: f64,
    rule: Rule,
    finish: Finish,
    order: Order,
    stage: &Stage,
) -> Result<Planned, StrategyError> {
    Family::of_rule(face, tool, &rule, finish, fields(mean_normal(face), angle), order, stage)
}

/// The function whose level lines are the sections turned by `angle` about `up`, and one that tells places along them apart; both are
/// lengths, mm.
pub(super) fn fields(up: DVec3, angle: f64) -> (Field, Field) {
    let flat = Frame::from_normal(up, DVec3::X).unwrap_or_else(|| Frame::any(up));
    let (s, c) = libm::sincos(angle);
    let along = flat.f * c + flat.b * s;
    (Field::Along(up.cross(along)), Field::Along(along))
}

/// The unit mean of the face's normals, weighted by area; `+z` for a face that closes on itself and has none.
pub(super) fn mean_normal(face: &Face) -> DVec3 {
    // The direction only fixes the planes, so a coarse sum does.
    let grid = FaceGrid::new(face, f64::INFINITY, 64, 64);
    let (nu, nv) = grid.size();
    let mut sum = DVec3::ZERO;
    for j in 0..nv - 1 {
        for i in 0..nu - 1 {
            let a = grid.uv(i, j);
            let b = grid.uv(i + 1, j + 1);
            let middle = crate::geometry::Uv::new(0.5 * (a.u + b.u), 0.5 * (a.v + b.v));
            if let Some((_, n)) = face.at(middle) {
                sum += n * grid.cell_area(i, j);
            }
        }
    }
    sum.try_normalize().unwrap_or(DVec3::Z)
}
