//! The yaw with the widest strips, smooth over the whole face.

use super::clear::{half_width, least_local};
use super::field::Way;
use super::lattice::{Lattice, Node};
use super::spline::Axis;
use super::{Ground, Limits};
use crate::geometry::FaceGrid;
use crate::monitor::{Cancelled, Stage};
use crate::toolpath::Posture;

/// Yaws that are looked at, from one side to the other.
const YAWS: usize = 13;
/// Distance of the nodes where yaws are chosen, as a share of the cutter's radius: over a radius they hardly change,
/// since that would swing the disc. At most so many cells a side.
const CELL: f64 = 0.6;
const CELLS: [usize; 2] = [8, 47];
/// Rounds over all nodes: what one place wishes spreads by a few nodes in each.
const ROUNDS: usize = 40;
/// The most that a node's yaw changes in a round, radians.
const MOST_MOVE: f64 = 0.2;

/// What a millimetre squared costs at a node, by yaw: the reciprocal of the width of the strip, exact at [`YAWS`] places.
struct Costs(Vec<Option<[f64; YAWS]>>);

/// The yaws at the nodes of `fine` that make the passes shortest.
///
/// They minimise `∬ (1/w) (1 + (R ω′)²/2) dA`, with `w` the exact strip's width, for a part of the cusps' height, at the least lead at which the cutter does not
/// dig in beside its contact, and `R` the cutter's radius: a yaw that changes swings the disc about its contact, which then
/// moves askew by about `R ω′` per unit of feed. Found from the best single yaw by Newton's method, node by node and round
/// by round.
pub(super) fn yaws(
    ground: &Ground,
    limits: &Limits,
    fine: &Lattice,
    reversed: bool,
    stage: &Stage,
) -> Result<Vec<f64>, Cancelled> {
    let most = limits.most_yaw;
    if most <= 0.0 || ground.cutter.center_radius == 0.0 {
        return Ok(vec![0.0; fine.nodes.len()]);
    }
    let radius = ground.cutter.center_radius + ground.cutter.corner_radius;
    let grid = FaceGrid::new(ground.face, CELL * radius, CELLS[0], CELLS[1]);
    let lattice = Lattice::new(ground, &grid, reversed, &stage.part("Choosing postures", 0.0, 0.1))?;
    let at = |k: usize| most * (2.0 * k as f64 / (YAWS - 1) as f64 - 1.0);
    let axis = Axis::new((0..YAWS).map(at).collect(), None);
    let costs = |i: usize| costs(ground, limits, &lattice.nodes[i], &axis);
    let costs = Costs(stage.part("Choosing postures", 0.1, 0.9).map(lattice.nodes.len(), costs)?);
    let mut yaws = vec![axis.node(costs.best_single(&lattice)); lattice.nodes.len()];
    let ties = costs.ties(&lattice, radius);
    for _ in 0..ROUNDS {
        let mut moved = 0.0f64;
        for (i, node) in lattice.nodes.iter().enumerate() {
            let (mut slope, mut bend) = (0.0, 0.0);
            for &(other, weight) in &ties[i] {
                slope += weight * (yaws[i] - yaws[other]);
                bend += weight;
            }
            if let Some(costs) = &costs.0[i] {
                let weights = axis.weights(yaws[i]);
                let sum = |w: [f64; 3]| (0..3).map(|k| w[k] * costs[weights.nodes[k]]).sum::<f64>();
                slope += node.area * sum(weights.slope);
                // Where the cost is not convex the ties alone say how far to go.
                let step = axis.node(1) - axis.node(0);
                bend += node.area * (sum([1.0, -2.0, 1.0]) / (step * step)).max(0.0);
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
    let postures = yaws.into_iter().map(|yaw| Posture { lead: 0.0, yaw }).collect();
    let way = Way { axes: lattice.axes, postures, bounds: Vec::new(), lifts: Vec::new() };
    Ok(fine.nodes.iter().map(|node| way.at(node.uv).0.yaw).collect())
}

/// The costs at `node` for the yaws of `axis`; nothing where no strip lies wholly on the face.
fn costs(ground: &Ground, limits: &Limits, node: &Node, axis: &Axis) -> Option<[f64; YAWS]> {
    let mut costs = [f64::NAN; YAWS];
    let low = Ground { scallop: limits.height * ground.scallop, ..*ground };
    for (k, cost) in costs.iter_mut().enumerate() {
        let yaw = axis.node(k);
        let Some(lead) = least_local(ground, ground.cutter, node, yaw, limits) else { continue };
        *cost = 0.5 / half_width(&low, node, Posture { lead, yaw }, 0.0)?;
    }
    let most = costs.iter().copied().filter(|c| c.is_finite()).fold(0.0, f64::max);
    // What does not fit costs more than whatever does.
    (most > 0.0).then(|| costs.map(|c| if c.is_finite() { c } else { 2.0 * most }))
}

impl Costs {
    /// The place of the yaw that is best if it is the same everywhere; of equals the least.
    fn best_single(&self, lattice: &Lattice) -> usize {
        let total = |k: usize| -> f64 {
            self.0.iter().zip(&lattice.nodes).map(|(c, node)| c.map_or(0.0, |c| c[k] * node.area)).sum()
        };
        let middle = YAWS / 2;
        let mut best = (total(middle), middle);
        for k in (1..=middle).flat_map(|d| [middle + d, middle - d]) {
            let sum = total(k);
            if sum < best.0 {
                best = (sum, k);
            }
        }
        best.1
    }

    /// The neighbours of each node, with the weight of the difference to each.
    fn ties(&self, lattice: &Lattice, radius: f64) -> Vec<Vec<(usize, f64)>> {
        let least = |costs: &[f64; YAWS]| costs.iter().copied().fold(f64::INFINITY, f64::min);
        let weights: Vec<f64> = (lattice.nodes.iter().zip(&self.0))
            .map(|(node, costs)| node.area * costs.as_ref().map_or(0.0, least) * radius * radius)
            .collect();
        let mut ties = vec![Vec::with_capacity(4); lattice.nodes.len()];
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
}
