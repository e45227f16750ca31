//! Why leads are not less.

use super::lattice::Lattice;
use super::{Ground, Limits};
use crate::contact::matching_lead;
use crate::toolpath::Bound;

/// Leads nearer than this count as the same, radians.
const SAME: f64 = 1e-9;

/// How leads came about, a number a node, radians.
pub(super) struct Leads<'a> {
    /// The yaws that they were found for.
    pub(super) yaws: &'a [f64],
    /// What right beside the contact asks for.
    pub(super) local: &'a [f64],
    /// What the whole cutter asks for, no less than `local`.
    pub(super) floors: &'a [f64],
    /// Whether that is for the holder.
    pub(super) for_holder: &'a [bool],
    /// What they spread to.
    pub(super) chosen: &'a [f64],
    /// The nodes that no lead suits.
    pub(super) misfits: &'a [usize],
}

/// What keeps the lead at each node from being less: its own reason or that of the neighbour that asks for most, or how fast
/// the axis may turn where it has more than any of them asks for.
pub(super) fn bounds(ground: &Ground, limits: &Limits, lattice: &Lattice, leads: &Leads) -> Vec<Bound> {
    let own: Vec<Bound> = (0..leads.chosen.len())
        .map(|i| {
            let matching = || matching_lead(ground.cutter, &lattice.nodes[i].contact?.surface, leads.yaws[i]);
            if leads.floors[i] > leads.local[i] + SAME {
                if leads.for_holder[i] { Bound::Holder } else { Bound::Body }
            } else if leads.local[i] <= limits.least_lead + SAME {
                Bound::Least
            } else if matching().is_some_and(|lead| leads.local[i] <= lead + SAME) {
                Bound::Curvature
            } else {
                Bound::Beside
            }
        })
        .collect();
    let mut bounds = vec![Bound::Turn; own.len()];
    for kind in [Bound::Least, Bound::Curvature, Bound::Beside, Bound::Body, Bound::Holder] {
        let asked = |i: usize| if own[i] == kind { leads.floors[i] } else { f64::NEG_INFINITY };
        let around = lattice.largest_around(&(0..own.len()).map(asked).collect::<Vec<_>>());
        for (i, bound) in bounds.iter_mut().enumerate() {
            if leads.chosen[i] <= around[i] + SAME {
                *bound = kind;
            }
        }
    }
    for &i in leads.misfits {
        bounds[i] = Bound::Misfit;
    }
    bounds
}
