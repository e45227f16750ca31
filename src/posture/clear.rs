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
/// The same where the cutter is lifted: a thousandth of a radian is then a micrometre of lift.
const FINE_HALVINGS: usize = 9;
const FINE_STEP: f64 = 0.0005;
/// Steps to the least lift, and the share of what it may dig in that is aimed at.
const LIFT_STEPS: usize = 2;
const AIM: f64 = 0.8;

/// The strip of `cutter` in `posture` at `node`, lifted by `lift` (mm); nothing where it digs in beside its contact.
fn strip(ground: &Ground, cutter: &Cutter, node: &Node, posture: Posture, lift: f64) -> Option<FaceStrip> {
    let contact = node.contact.as_ref()?;
    let cc = CcPoint { point: node.point + contact.frame.n * lift, frame: contact.frame, posture };
    let spin = contact.frame.f * contact.surface.fb - contact.frame.b * contact.surface.ff;
    let limits = StripLimits { scallop: ground.scallop, gouge: SHARE * ground.gouge };
    let strip = face_strip(ground.face, cutter, &cc, node.uv, spin, limits)?;
    let digs = matches!(strip.left, Edge::Gouge(_)) || matches!(strip.right, Edge::Gouge(_));
    (!digs).then_some(strip)
}

/// The least lift, mm, with which `cutter` in `posture` at `node` does not dig in: 0 where it needs none beside its contact;
/// nothing where all that it may be lifted is not enough.
pub(super) fn least_lift(ground: &Ground, cutter: &Cutter, node: &Node, posture: Posture) -> Option<f64> {
    let lift = lift_beside(ground, cutter, node, posture)?;
    if lift <= 0.0 {
        return Some(0.0);
    }
    // What the envelope does not show, most of all beside borders.
    let frame = node.contact?.frame;
    let cl = cl_of(cutter, &CcPoint { point: node.point + frame.n * lift, frame, posture });
    let depth = ground.obstacle.depth(cutter, &cl, node.point, -node.most_lift);
    let more = if depth < -SHARE * ground.gouge { -depth - AIM * SHARE * ground.gouge } else { 0.0 };
    Some(lift + more).filter(|lift| *lift <= node.most_lift)
}

/// [`least_lift`], as far as the strip shows it.
///
/// Where a border ends the strip before it has shown whether it dips, what a round hollow would ask for counts too: the passes
/// begin there as they go on.
fn lift_beside(ground: &Ground, cutter: &Cutter, node: &Node, posture: Posture) -> Option<f64> {
    let round = round_lift(cutter, node, posture);
    // The search for one contact does not look out for dips where curvatures do not match.
    let unlifted = (node.most_lift <= 0.0 || round <= 0.0).then(|| strip(ground, cutter, node, posture, 0.0));
    if unlifted.flatten().is_some() {
        return Some(0.0);
    }
    if node.most_lift <= 0.0 {
        return None;
    }
    let mut lift = node.most_lift;
    let mut found = strip(ground, cutter, node, posture, lift)?;
    for _ in 0..LIFT_STEPS {
        // Beside the contact the cutter comes down a little less than it is let down.
        let less = (lift - (found.lowest + AIM * SHARE * ground.gouge)).max(0.0);
        match strip(ground, cutter, node, posture, less).filter(|_| less < lift) {
            Some(next) => (lift, found) = (less, next),
            None => break,
        }
    }
    if [found.left, found.right].iter().any(|edge| matches!(edge, Edge::Border(_))) {
        lift = lift.max(round);
    }
    (lift <= node.most_lift).then_some(lift)
}

/// The lift in a hollow that is round across the feed, mm; 0 where curvatures match already.
fn round_lift(cutter: &Cutter, node: &Node, posture: Posture) -> f64 {
    let matching = node.contact.and_then(|contact| matching_lead(cutter, &contact.surface, posture.yaw));
    matching.filter(|matching| *matching > posture.lead).map_or(0.0, |matching| {
        let s = libm::sin(0.5 * (matching - posture.lead));
        2.0 * s * s * cutter.center_radius / libm::sin(matching)
    })
}

/// Half the width of the strip of the ground's cutter at `node`, lifted by `lift` (mm), in mm; nothing where it digs in, or runs
/// over borders on both sides. At one border the strip counts as far as on its other side.
pub(super) fn half_width(ground: &Ground, node: &Node, posture: Posture, lift: f64) -> Option<f64> {
    let b = node.contact?.frame.b;
    let side = |edge| match edge {
        Edge::Reached(uv) => Some((ground.face.surface.point(uv) - node.point).dot(b).abs()),
        Edge::Border(_) | Edge::Gouge(_) => None,
    };
    let found = strip(ground, ground.cutter, node, posture, lift)?;
    match (side(found.left), side(found.right)) {
        (Some(left), Some(right)) => Some(0.5 * (left + right)),
        (one, other) => one.or(other),
    }
}

/// Whether `cutter` in `posture` at `node` reaches into the face nowhere: not beside its contact, nor with the rear of its
/// bottom or its side, which goes on upwards as the shank; nor does what holds it.
pub(super) fn is_clear(ground: &Ground, cutter: &Cutter, node: &Node, posture: Posture) -> bool {
    let Some(contact) = &node.contact else { return false };
    let allowed = -SHARE * ground.gouge;
    let Some(lift) = least_lift(ground, cutter, node, posture) else { return false };
    let point = node.point + contact.frame.n * lift;
    let cl = cl_of(cutter, &CcPoint { point, frame: contact.frame, posture });
    !ground.obstacle.digs(cutter, &cl, node.point, allowed)
        && !ground.obstacle.digs_beside(cutter, &cl, node.uv, &contact.frame, allowed)
        && ground.holder.is_none_or(|holder| ground.obstacle.clears_holder(&holder, &cl, 0.0))
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
    let fits = |lead: f64| strip(ground, cutter, node, Posture { lead, yaw }, 0.0).is_some();
    if lead > limits.most_lead {
        None
    } else if fits(lead) {
        Some(lead)
    } else {
        least(fits, (lead, FIRST_STEP), limits)
    }
}

/// The lead up to `unlifted` at which the strip of the cutter that is lifted as far as it needs to be is widest, with yaw 0.
///
/// In a round hollow that is the least at which it fits at all. Where the hollow bends more to one side, the lift that the one
/// side needs costs on the other, and there may be none.
pub(super) fn widest_lifted(ground: &Ground, node: &Node, unlifted: f64, limits: &Limits) -> f64 {
    let matching = node.contact.and_then(|contact| matching_lead(ground.cutter, &contact.surface, 0.0));
    let Some(matching) = matching.filter(|m| node.most_lift > 0.0 && *m > limits.least_lead) else {
        return unlifted;
    };
    let posture = |lead| Posture { lead, yaw: 0.0 };
    let lift = |lead| least_lift(ground, ground.cutter, node, posture(lead));
    let fits = |lead| lift_beside(ground, ground.cutter, node, posture(lead)).is_some();
    let Some(low) = least_lifted(fits, ground.cutter, matching, node.most_lift, limits.least_lead) else {
        return unlifted;
    };
    let half_at = |lead| half_width(ground, node, posture(lead), lift(lead)?);
    let (Some(plain), Some(_)) = (half_at(unlifted), half_at(low)) else {
        // Over borders on both sides nothing tells: as in the hollow further on.
        return low.min(unlifted);
    };
    let mut best = (WORTH * plain, unlifted);
    for k in 0..LOOKS {
        let lead = low + (unlifted - low) * f64::from(k) / f64::from(LOOKS);
        if let Some(half) = half_at(lead).filter(|half| *half > best.0) {
            best = (half, lead);
        }
    }
    best.1
}

/// Leads that are looked at between the least and that without lift, and how many times wider a strip is worth a lift.
const LOOKS: u32 = 6;
const WORTH: f64 = 1.01;

/// The least lead found from that of `from` on, which is not clear, at which the cutter is clear with the same yaw; `None`
/// where there is none within the limits.
pub(super) fn least_clear(
    ground: &Ground,
    cutter: &Cutter,
    node: &Node,
    from: Posture,
    limits: &Limits,
) -> Option<f64> {
    let least_posture = Posture { lead: limits.least_lead, ..from };
    let hollow = node.most_lift > 0.0 && round_lift(cutter, node, least_posture) > 0.0;
    let step = if hollow { FINE_STEP } else { FIRST_STEP };
    least(|lead| is_clear(ground, cutter, node, Posture { lead, ..from }), (from.lead, step), limits)
}

/// The least lead below the `matching` one that `fits` with a lift of up to `most`, mm; nothing where that one does not.
///
/// In a round hollow it is less by `arccos(1 − lift/K)`, where `sin λ = R1/K` matches: looked for from a little less on.
fn least_lifted(
    fits: impl Fn(f64) -> bool,
    cutter: &Cutter,
    matching: f64,
    most: f64,
    least_lead: f64,
) -> Option<f64> {
    let room = cutter.center_radius / libm::sin(matching);
    let turn = 2.0 * libm::asin((0.5 * most / room).sqrt().min(1.0));
    let [mut low, likely] = [1.4, 0.8].map(|share| (matching - share * turn).max(least_lead));
    if fits(low) {
        return Some(low);
    }
    let mut high = [likely, matching].into_iter().find(|&lead| fits(lead))?;
    for _ in 0..FINE_HALVINGS {
        let middle = 0.5 * (low + high);
        *(if fits(middle) { &mut high } else { &mut low }) = middle;
    }
    Some(high)
}

/// The least lead found above `low` that `fits`, by steps that grow from `step`.
fn least(fits: impl Fn(f64) -> bool, (mut low, mut step): (f64, f64), limits: &Limits) -> Option<f64> {
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
