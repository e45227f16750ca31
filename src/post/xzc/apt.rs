//! The motion as an APT cutter-location program: where the tool is over the part.

use super::XzcProgram;
use crate::cutter::{Cutter, CutterError};
use crate::post::{Program, Unit};
use crate::toolpath::{ClPoint, Move, Nose, Rate, Role, Toolpath};
use glam::DVec3;

/// The moves of `program` in the part's own coordinates, for [`apt::write`](crate::post::apt::write): the lowest point of the
/// nose and the axis (0, 0, 1). APT has straight moves: a post-processor for X, Z and C takes the points and leaves what lies between them
/// to the control. An insert is stated as a ball of its radius, and the part's name says so.
///
/// Errors: a radius with which there is no cutter.
pub fn apt_program(program: &XzcProgram) -> Result<Program, CutterError> {
    let radius = program.nose.radius();
    let place = |x: f64, z: f64, c: f64| {
        let (sin, cos) = libm::sincos(c);
        ClPoint { tip: DVec3::new(x * cos, x * sin, z - radius), axis: DVec3::Z }
    };
    let points = &program.path.points;
    let highest = points.iter().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max) + program.clearance;
    let mut moves = Vec::with_capacity(points.len() + 2);
    if let Some(p) = points.first() {
        moves.push(Move { to: place(p.x, highest, p.c), rate: Rate::Rapid, role: Role::Link });
        moves.push(Move { to: place(p.x, p.z, p.c), rate: Rate::Feed(program.approach), role: Role::Link });
    }
    for pair in points.windows(2) {
        let (from, to) = (place(pair[0].x, pair[0].z, pair[0].c), place(pair[1].x, pair[1].z, pair[1].c));
        let feed = 60.0 * from.tip.distance(to.tip) / (pair[1].time - pair[0].time);
        moves.push(Move { to, rate: Rate::Feed(feed.max(1e-3)), role: Role::Cut });
    }
    if let Some(p) = points.last() {
        moves.push(Move { to: place(p.x, highest, p.c), rate: Rate::Rapid, role: Role::Link });
    }
    let note = match program.nose {
        Nose::Ball(_) => "",
        Nose::Insert(_) => " - ROUND-NOSE INSERT IN THE X-Z PLANE",
    };
    Ok(Program {
        part: format!("{}{note}", program.part),
        unit: Unit::Mm,
        cutter: Cutter::ball(2.0 * radius, 4.0 * radius)?,
        tool: program.tool,
        spindle_rpm: program.spindle_rpm,
        toolpath: Toolpath { moves },
    })
}
