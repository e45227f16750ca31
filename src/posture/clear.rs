//! Whether the whole cutter clears the face, and the least lead at which it does.

use super::lattice::Node;
use super::{Ground, Limits};
use crate::contact::{Edge, StripLimits, cl_of, face_strip};
use crate::cutter::Cutter;
use crate::toolpath::{CcPoint, Posture};

/// Share of the allowance that a node may use up, so that places between nodes have the rest.
const SHARE: f64 = 0.4;
/// Steps of the search for a clear lead: the first, and how each grows, radians.
const FIRST_STEP: f64 = 0.01;
const GROWTH: f64 = 1.4;
/// Halvings between a lead that is clear and one that is not.
const HALVINGS: usize = 4;

/// Whether `cutter` in `posture` at `node` reaches into the face nowhere: not beside its contact, nor with the rear of its
/// bottom or its side, which goes on upwards as the shank.
pub(super) fn is_clear(ground: &Ground, cutter: &Cutter, node: &Node, posture: Posture) -> bool {
    let Some(contact) = &node.contact else { return false };
    let allowed = -SHARE * ground.gouge;
    let cc = CcPoint { point: node.point, frame: contact.frame, posture };
    let cl = cl_of(cutter, &cc);
    // Cheapest first.
    let spin = contact.frame.f * contact.surface.fb - contact.frame.b * contact.surface.ff;
    let limits = StripLimits { scallop: ground.scallop, gouge: -allowed };
    let strip = face_strip(ground.face, cutter, &cc, node.uv, spin, limits);
    strip.is_some_and(|s| !matches!(s.left, Edge::Gouge(_)) && !matches!(s.right, Edge::Gouge(_)))
        && ground.obstacle.depth_beside(cutter, &cl, node.uv, &contact.frame) >= allowed
        && ground.obstacle.depth(cutter, &cl, node.point, allowed) >= allowed
}

/// The least lead found from that of `from` on, which is not clear, at which the cutter is clear with the same yaw; `None`
/// where there is none within the limits.
pub(super) fn least_clear(
    ground: &Ground,
    cutter: &Cutter,
    node: &Node,
    from: Posture,
    limits: &Limits,
) -> Option<f64> {
    let clear = |lead: f64| is_clear(ground, cutter, node, Posture { lead, ..from });
    let (mut low, mut step) = (from.lead, FIRST_STEP);
    let mut high = loop {
        if low >= limits.most_lead {
            return None;
        }
        let next = (low + step).min(limits.most_lead);
        if clear(next) {
            break next;
        }
        (low, step) = (next, step * GROWTH);
    };
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        *(if clear(middle) { &mut high } else { &mut low }) = middle;
    }
    Some(high)
}
