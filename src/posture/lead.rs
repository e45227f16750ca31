//! The least leads at which the cutter digs in nowhere, over the whole face.

use super::clear::{is_clear, least_clear, least_local, widest_lifted};
use super::lattice::Lattice;
use super::{Ground, Limits};
use crate::monitor::{Cancelled, Stage};
use crate::toolpath::Posture;

/// Rounds of raising what is not clear; what is raised last is not tested again, but more lead seldom digs in.
const ROUNDS: usize = 4;

/// The least leads at which the cutter does not dig in right beside its contact; the least of all where it does whatever
/// its lead, since nothing is gained by more.
pub(super) fn local_leads(
    ground: &Ground,
    limits: &Limits,
    lattice: &Lattice,
    yaws: &[f64],
    stage: &Stage,
) -> Result<Vec<f64>, Cancelled> {
    stage.map(yaws.len(), |i| {
        let node = &lattice.nodes[i];
        let unlifted = least_local(ground, ground.cutter, node, yaws[i], limits).unwrap_or(limits.least_lead);
        widest_lifted(ground, node, unlifted, limits)
    })
}

/// The least leads that nodes and places between them need, no less than `floors`, and no two neighbours' farther apart
/// than `allowed`: for given floors no other choice has less lead anywhere.
///
/// Between nodes leads are means of the nine around: each is therefore no less than what any of its neighbours needs.
pub(super) fn spread(lattice: &Lattice, floors: &[f64], allowed: &[f64]) -> Vec<f64> {
    lattice.raised(lattice.largest_around(floors), allowed)
}

/// The leads at which the cutter is clear.
pub(super) struct ClearLeads {
    pub(super) leads: Vec<f64>,
    /// Whether it was the holder that asked for more, a flag a node.
    pub(super) for_holder: Vec<bool>,
    /// The nodes at which it fits in no way.
    pub(super) misfits: Vec<usize>,
}

/// Raises `floors` until the cutter is clear of the face at every node with the leads that they [`spread`] to.
pub(super) fn clear_leads(
    ground: &Ground,
    limits: &Limits,
    lattice: &Lattice,
    yaws: &[f64],
    floors: &mut [f64],
    allowed: &[f64],
    stage: &Stage,
) -> Result<ClearLeads, Cancelled> {
    let bare = Ground { holder: None, ..*ground };
    let mut leads = spread(lattice, floors, allowed);
    let mut tested = vec![f64::NAN; leads.len()];
    let mut fits = vec![true; leads.len()];
    let mut for_holder = vec![false; leads.len()];
    for round in 0..ROUNDS {
        let part =
            stage.part("Choosing postures", round as f64 / ROUNDS as f64, (round + 1) as f64 / ROUNDS as f64);
        let open: Vec<usize> = (0..leads.len())
            .filter(|&i| leads[i] != tested[i] && lattice.nodes[i].contact.is_some())
            .collect();
        // What is asked for each: nothing if clear, else the lead that is, and whether without the holder less would do.
        let found = part.map(open.len(), |k| {
            let i = open[k];
            let posture = Posture { lead: leads[i], yaw: yaws[i] };
            let node = &lattice.nodes[i];
            if is_clear(ground, ground.cutter, node, posture) {
                return None;
            }
            let lead = least_clear(ground, ground.cutter, node, posture, limits);
            let is_less = |lead: f64| {
                is_clear(&bare, ground.cutter, node, posture)
                    || least_clear(&bare, ground.cutter, node, posture, limits)
                        .is_some_and(|less| less < lead)
            };
            Some(lead.map(|lead| (lead, ground.holder.is_some() && is_less(lead))))
        })?;
        let mut raised = false;
        for (&i, found) in open.iter().zip(&found) {
            tested[i] = leads[i];
            match found {
                None => {}
                Some(Some((lead, is_for_holder))) => {
                    (floors[i], for_holder[i]) = (*lead, *is_for_holder);
                    raised = true;
                }
                Some(None) => fits[i] = false,
            }
        }
        if !raised {
            break;
        }
        leads = spread(lattice, floors, allowed);
    }
    let misfits = (0..fits.len()).filter(|&i| !fits[i]).collect();
    Ok(ClearLeads { leads, for_holder, misfits })
}
