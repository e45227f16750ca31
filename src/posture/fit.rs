//! How large a cutter would fit where this one does not.

use super::clear::{is_clear, least_clear, least_local};
use super::lattice::Node;
use super::{Ground, Limits};
use crate::cutter::Cutter;
use crate::toolpath::Posture;

/// Nodes that are looked at, evenly among all.
const MOST_NODES: usize = 24;
/// Halvings of the share, which is then known to a hundredth.
const HALVINGS: usize = 7;
/// The least share.
const LEAST: f64 = 0.02;

/// How much smaller than the ground's cutter, as a share of it, the largest of the same shape is that fits at all of
/// `nodes` within the limits, with yaw 0; `None` without nodes, or where not even a fiftieth fits.
///
/// Not promised: that what is a little smaller fits too, which a search by halves takes for granted.
pub(super) fn largest_fit<'a>(
    ground: &Ground,
    limits: &Limits,
    nodes: impl ExactSizeIterator<Item = &'a Node>,
) -> Option<f64> {
    let stride = nodes.len().div_ceil(MOST_NODES).max(1);
    let mut largest: Option<f64> = None;
    for node in nodes.step_by(stride) {
        let most = largest.unwrap_or(1.0);
        let fits = |share: f64| fits(ground, limits, node, &scaled(ground.cutter, share));
        if !fits(LEAST) {
            return None;
        }
        let (mut low, mut high) = (LEAST, most);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            *(if fits(middle) { &mut low } else { &mut high }) = middle;
        }
        largest = Some(low);
    }
    largest
}

fn fits(ground: &Ground, limits: &Limits, node: &Node, cutter: &Cutter) -> bool {
    least_local(ground, cutter, node, 0.0, limits).is_some_and(|lead| {
        let posture = Posture { lead, yaw: 0.0 };
        is_clear(ground, cutter, node, posture)
            || least_clear(ground, cutter, node, posture, limits).is_some()
    })
}

/// The cutter with every length multiplied by `share`.
fn scaled(cutter: &Cutter, share: f64) -> Cutter {
    Cutter {
        diameter: cutter.diameter * share,
        corner_radius: cutter.corner_radius * share,
        center_radius: cutter.center_radius * share,
        center_height: cutter.center_height * share,
        height: cutter.height * share,
        ..*cutter
    }
}
