//! The yaw with the widest strips, smooth over the whole face.

use super::lattice::{Contact, Lattice};
use super::width::{estimated_width, matching_lead};
use super::{Ground, Limits};
use crate::toolpath::Posture;

/// Yaws that are tried for the whole face, to either side of 0.
const STARTS: i32 = 8;
/// Rounds over all nodes: what one place wishes spreads by a few nodes in each.
const ROUNDS: usize = 24;
/// Step for differences of the cost, and the most that a node's yaw changes in a round, radians.
const STEP: f64 = 0.02;
const MOST_MOVE: f64 = 0.2;

/// What a pass costs at the node's contact, per mm²: the reciprocal of its strip's width at the least lead that the yaw
/// needs there, no less than `floor`.
fn cost(ground: &Ground, limits: &Limits, contact: &Contact, floor: f64, yaw: f64) -> f64 {
    let least = matching_lead(ground.cutter, &contact.surface, yaw).unwrap_or(limits.most_lead);
    let lead = least.max(floor).min(limits.most_lead);
    let posture = Posture { lead, yaw };
    1.0 / estimated_width(ground.cutter, posture, &contact.surface, ground.scallop)
}

/// The yaws at the nodes that make the passes shortest, where `floors` are the least leads.
///
/// They minimise `∬ (1/w) (1 + (R ω′)²/2) dA`, with `R` the cutter's radius: a yaw that changes swings the disc about its
/// contact, which then moves askew by about `R ω′` per unit of feed. Found from the best single yaw by Newton's method,
/// node by node and round by round.
pub(super) fn yaws(ground: &Ground, limits: &Limits, lattice: &Lattice, floors: &[f64]) -> Vec<f64> {
    let most = limits.most_yaw;
    if most <= 0.0 || ground.cutter.center_radius == 0.0 {
        return vec![0.0; lattice.nodes.len()];
    }
    let start = best_single(ground, limits, lattice, floors);
    let mut yaws = vec![start; lattice.nodes.len()];
    let ties = ties(ground, lattice, floors, limits, start);
    for _ in 0..ROUNDS {
        let mut moved = 0.0f64;
        for (i, node) in lattice.nodes.iter().enumerate() {
            let (mut slope, mut bend) = (0.0, 0.0);
            for &(other, weight) in &ties[i] {
                slope += weight * (yaws[i] - yaws[other]);
                bend += weight;
            }
            if let Some(contact) = &node.contact {
                let at = |yaw| cost(ground, limits, contact, floors[i], yaw);
                let [low, here, high] = [-STEP, 0.0, STEP].map(|step| at(yaws[i] + step));
                slope += node.area * (high - low) / (2.0 * STEP);
                // Where the cost is not convex the ties alone say how far to go.
                bend += node.area * ((high - 2.0 * here + low) / (STEP * STEP)).max(0.0);
            }
            if bend > 0.0 {
                let next = (yaws[i] - (slope / bend).clamp(-MOST_MOVE, MOST_MOVE)).clamp(-most, most);
                moved = moved.max((next - yaws[i]).abs());
                yaws[i] = next;
            }
        }
        // A thousandth of a radian is nothing in a width.
        if moved < 1e-3 {
            break;
        }
    }
    yaws
}

/// The neighbours of each node, with the weight of the difference to each.
fn ties(
    ground: &Ground,
    lattice: &Lattice,
    floors: &[f64],
    limits: &Limits,
    yaw: f64,
) -> Vec<Vec<(usize, f64)>> {
    let radius = ground.cutter.center_radius + ground.cutter.corner_radius;
    let mut ties = vec![Vec::with_capacity(4); lattice.nodes.len()];
    let weights: Vec<f64> = (lattice.nodes.iter().zip(floors))
        .map(|(node, &floor)| {
            let cost = node.contact.map_or(0.0, |contact| cost(ground, limits, &contact, floor, yaw));
            node.area * cost * radius * radius
        })
        .collect();
    for pair in &lattice.pairs {
        let [a, b] = pair.nodes;
        let square = pair.way[0] * pair.way[0] + pair.way[1] * pair.way[1];
        if square > 0.0 {
            let weight = 0.5 * (weights[a] + weights[b]) / square;
            ties[a].push((b, weight));
            ties[b].push((a, weight));
        }
    }
    ties
}

/// The yaw that is best if it is the same everywhere.
fn best_single(ground: &Ground, limits: &Limits, lattice: &Lattice, floors: &[f64]) -> f64 {
    let total = |yaw: f64| -> f64 {
        let one = |(i, node): (usize, &super::lattice::Node)| {
            node.area * node.contact.map_or(0.0, |contact| cost(ground, limits, &contact, floors[i], yaw))
        };
        // A few hundred nodes tell which single one is best.
        let stride = lattice.nodes.len() / 400 + 1;
        lattice.nodes.iter().enumerate().step_by(stride).map(one).sum()
    };
    let mut best = (f64::INFINITY, 0.0);
    // From the middle outwards, so that of equals the smaller one is kept.
    for k in 0..=STARTS {
        for side in [1.0, -1.0] {
            let yaw = side * limits.most_yaw * f64::from(k) / f64::from(STARTS);
            let sum = total(yaw);
            if sum < best.0 {
                best = (sum, yaw);
            }
        }
    }
    best.1
}
