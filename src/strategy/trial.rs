//! What tests of strategies are tried on: a cutter of 10 mm with corners of 2 mm, and cusps of 10 µm.

use super::family::Family;
use super::{Finish, Order};
use crate::cutter::{Cutter, Tool};
use crate::geometry::{Face, Field, Plane, Range, Side};
use crate::math::frame::Frame;
use crate::monitor::Stage;
use crate::posture::Rule;
use crate::toolpath::Posture;
use glam::DVec3;

pub(super) const FINISH: Finish = Finish { scallop: 0.01, chord: 0.001 };

/// A flat face between these millimetres along x and y.
pub(super) fn flat(x: [f64; 2], y: [f64; 2]) -> Face {
    let frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
    let (u, v) = (Range::open(x[0], x[1]), Range::open(y[0], y[1]));
    Face::new(Plane { origin: DVec3::ZERO, frame, u, v }, Side::Front)
}

/// A cutter that leans by so much, radians.
pub(super) fn leaning(lead: f64, yaw: f64) -> Rule {
    Rule::Fixed(Posture { lead, yaw })
}

/// The lines of a field, told apart along them by another, all one way; face and cutter stay for as long as tests run.
pub(super) fn family(face: Face, rule: &Rule, fields: (Field, Field)) -> Family<'static> {
    let tool = Tool { cutter: Cutter::bull_nose(10.0, 2.0, 40.0).unwrap(), holder: None };
    let (face, tool) = (Box::leak(Box::new(face)), Box::leak(Box::new(tool)));
    Family::new(face, tool, rule, FINISH, fields, Order::Zig, &Stage::silent()).unwrap()
}
