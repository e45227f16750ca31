//! From lowered cutters to passes.

use super::line::Drop;
use super::turn::Turn;
use crate::math::frame::Frame;
use crate::toolpath::{CcPoint, ClPoint, Pass, Posture, Station, Work};
use glam::DVec3;

/// The pass over these drops on the line at `y`.
pub(super) fn pass(drops: &[Drop], y: f64, turn: &Turn) -> Pass {
    let tip = |d: &Drop| DVec3::new(d.x, y, d.tip);
    let last = drops.len() - 1;
    let station = |(i, d): (usize, &Drop)| {
        let toward = tip(&drops[(i + 1).min(last)]) - tip(&drops[i.saturating_sub(1)]);
        let n = d.normal;
        let frame = Frame::from_normal(n, toward).or_else(|| Frame::from_normal(n, DVec3::X));
        let frame = frame.unwrap_or_else(|| Frame::any(n));
        let lean = frame.to_local(DVec3::Z);
        let posture = Posture {
            lead: libm::acos(lean.z.clamp(-1.0, 1.0)),
            yaw: if lean.truncate().length() > 1e-12 { libm::atan2(lean.y, lean.x) } else { 0.0 },
        };
        let frame = Frame { f: turn.to_world(frame.f), b: turn.to_world(frame.b), n: turn.to_world(frame.n) };
        Station {
            cc: CcPoint { point: turn.to_world(d.point), frame, posture },
            cl: ClPoint { tip: turn.to_world(tip(d)), axis: DVec3::Z },
            work: Work::default(),
        }
    };
    Pass { stations: drops.iter().enumerate().map(station).collect() }
}
