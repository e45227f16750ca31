//! How far the cutter is lifted to lie on both sides of a hollow, over the whole face.

use super::Ground;
use super::clear::least_lift;
use super::field::Way;
use super::lattice::{Lattice, Node};
use crate::geometry::Uv;
use crate::monitor::{Cancelled, Stage};
use crate::toolpath::Posture;

/// Rounds of raising what is not enough between nodes.
const ROUNDS: usize = 3;
/// What is enough, mm, short of what is needed: less than a node leaves of what the cutter may dig in.
const ENOUGH: f64 = 5e-5;

/// Lifts the cutter in the postures of `way` so far that it does not dig in beside its contact, at nodes and between; nothing
/// where it nowhere needs to be lifted.
///
/// What is needed is convex in the lead, so that means of leads need no more than means of lifts: only where the surface's own
/// bend changes faster than evenly from node to node it is more, and then all nodes around are raised by as much.
pub(super) fn lift(
    ground: &Ground,
    lattice: &Lattice,
    way: &mut Way,
    reversed: bool,
    stage: &Stage,
) -> Result<(), Cancelled> {
    if ground.most_lift[0] <= 0.0 {
        return Ok(());
    }
    let stage = stage.quiet();
    // Where no lift is enough, none helps.
    let needed = |node: &Node, lead, yaw| {
        least_lift(ground, ground.cutter, node, Posture { lead, yaw }).unwrap_or(0.0)
    };
    let lifts = stage
        .map(lattice.nodes.len(), |i| needed(&lattice.nodes[i], way.postures[i].lead, way.postures[i].yaw))?;
    if lifts.iter().all(|lift| *lift <= 0.0) {
        return Ok(());
    }
    way.lifts = lifts;
    let [us, vs] = &lattice.axes;
    let step = |axis: &super::spline::Axis, i: usize| axis.after(i).map_or(0.0, |_| 0.5 * axis.share(i));
    for _ in 0..ROUNDS {
        // At the nodes, where the mean of those around counts, and between.
        let missing = stage.map(2 * lattice.nodes.len(), |k| {
            let (i, j) = ((k / 2) % us.len(), (k / 2) / us.len());
            let half = (k % 2) as f64;
            let uv = Uv::new(us.node(i) + half * step(us, i), vs.node(j) + half * step(vs, j));
            let (posture, _) = way.at(uv);
            let node = Node::new(ground, uv, reversed);
            (uv, needed(&node, posture.lead, posture.yaw) - way.lift(uv))
        })?;
        let mut raised = way.lifts.clone();
        for (uv, missing) in missing.into_iter().filter(|(_, missing)| *missing > ENOUGH) {
            let [wu, wv] = [us.weights(uv.u), vs.weights(uv.v)];
            for (i, j) in wv.nodes.into_iter().flat_map(|j| wu.nodes.map(|i| (i, j))) {
                let k = j * us.len() + i;
                raised[k] = raised[k].max(way.lifts[k] + missing).min(lattice.nodes[k].most_lift);
            }
        }
        if raised == way.lifts {
            break;
        }
        way.lifts = raised;
    }
    Ok(())
}
