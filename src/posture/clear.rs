//! Whether the whole cutter clears the face, and the least lead at which it does.

use super::lattice::Node;
use super::{Ground, Limits};
use crate::contact::{Edge, FaceStrip, StripLimits, cl_of, face_strip, matching_lead};
use crate::cutter::Cutter;
use crate::toolpath::{CcPoint, Posture};

/// Share of the allowance that a node may use up, so that places between nodes have the rest.
const SHARE: f64 = 0.4;
/// Steps of the search for a lead: the first, and how each grows, radians.
const FIRST_STEP: f64 = 0.008;
const GROWTH: f64 = 1.6;
/// Halvings between a lead that does and one that does not.
const HALVINGS: usize = 3;

/// The strip of `cutter` in `posture` at `node`; nothing where it digs in beside its contact.
pub(super) fn strip(ground: &Ground, cutter: &Cutter, node: &Node, posture: Posture) -> Option<FaceStrip> {
    let contact = node.contact.as_ref()?;
    let cc = CcPoint { point: node.point, frame: contact.frame, posture };
    let spin = contact.frame.f * contact.surface.fb - contact.frame.b * contact.surface.ff;
    let limits = StripLimits { scallop: ground.scallop, gouge: SHARE * ground.gouge };
    let strip = face_strip(ground.face, cutter, &cc, node.uv, spin, limits)?;
    let digs = matches!(strip.left, Edge::Gouge(_)) || matches!(strip.right, Edge::Gouge(_));
    (!digs).then_some(strip)
}

/// Half the width of the strip of the ground's cutter at `node`, mm; nothing where it digs in, or runs over borders on both
/// sides. At one border the strip counts as far as on its other side.
pub(super) fn half_width(ground: &Ground, node: &Node, posture: Posture) -> Option<f64> {
    let b = node.contact?.frame.b;
    let side = |edge| match edge {
        Edge::Reached(uv) => Some((ground.face.surface.point(uv) - node.point).dot(b).abs()),
        Edge::Border(_) | Edge::Gouge(_) => None,
    };
    let found = strip(ground, ground.cutter, node, posture)?;
    match (side(found.left), side(found.right)) {
        (Some(left), Some(right)) => Some(0.5 * (left + right)),
        (one, other) => one.or(other),
    }
}

/// Whether `cutter` in `posture` at `node` reaches into the face nowhere: not beside its contact, nor with the rear of its
/// bottom or its side, which goes on upwards as the shank.
pub(super) fn is_clear(ground: &Ground, cutter: &Cutter, node: &Node, posture: Posture) -> bool {
    let Some(contact) = &node.contact else { return false };
    let allowed = -SHARE * ground.gouge;
    let cl = cl_of(cutter, &CcPoint { point: node.point, frame: contact.frame, posture });
    // Cheapest first.
    strip(ground, cutter, node, posture).is_some()
        && ground.obstacle.depth(cutter, &cl, node.point, allowed) >= allowed
        && ground.obstacle.depth_beside(cutter, &cl, node.uv, &contact.frame) >= allowed
}

/// The least lead within the limits at which curvatures match with this yaw and the `cutter` does not dig in beside its
/// contact; `None` where there is none.
pub(super) fn least_local(
    ground: &Ground,
    cutter: &Cutter,
    node: &Node,
    yaw: f64,
    limits: &Limits,
) -> Option<f64> {
    let contact = node.contact.as_ref()?;
    let lead = matching_lead(cutter, &contact.surface, yaw)?.max(limits.least_lead);
    let fits = |lead: f64| strip(ground, cutter, node, Posture { lead, yaw }).is_some();
    if lead > limits.most_lead {
        None
    } else if fits(lead) {
        Some(lead)
    } else {
        least(fits, lead, limits)
    }
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
    least(|lead| is_clear(ground, cutter, node, Posture { lead, ..from }), from.lead, limits)
}

/// The least lead found above `low` that `fits`.
fn least(fits: impl Fn(f64) -> bool, mut low: f64, limits: &Limits) -> Option<f64> {
    let mut step = FIRST_STEP;
    let mut high = loop {
        if low >= limits.most_lead {
            return None;
        }
        let next = (low + step).min(limits.most_lead);
        if fits(next) {
            break next;
        }
        (low, step) = (next, step * GROWTH);
    };
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        *(if fits(middle) { &mut high } else { &mut low }) = middle;
    }
    Some(high)
}
