//! Postures for a whole face at once.

use super::bound::{Leads, bounds};
use super::clear::half_width;
use super::field::Way;
use super::fit::largest_fit;
use super::lattice::Lattice;
use super::lead::{ClearLeads, clear_leads, local_leads, spread};
use super::lift::lift;
use super::yaw::yaws;
use super::{Limits, PostureField, Rule};
use crate::contact::FaceObstacle;
use crate::cutter::{Cutter, Holder};
use crate::geometry::{Face, FaceGrid, Jet, Uv};
use crate::math::frame::Frame;
use crate::monitor::{Cancelled, Stage};
use crate::toolpath::Posture;

/// What postures are chosen for.
pub struct Ground<'a> {
    /// The face.
    pub face: &'a Face,
    /// The same as an obstacle.
    pub obstacle: &'a FaceObstacle,
    /// The cutter.
    pub cutter: &'a Cutter,
    /// What holds it.
    pub holder: Option<Holder>,
    /// Jet and contact frame at a place, for feed the one way or reversed; nothing where the feed has no direction.
    pub feed: &'a (dyn Fn(Uv, bool) -> Option<(Jet, Frame)> + Sync),
    /// Height of the cusps, mm.
    pub scallop: f64,
    /// How deep the cutter may reach into the face before a posture counts as gouging, mm.
    pub gouge: f64,
    /// How far it may be lifted off the middle of a hollow, [`Rule::most_lift`].
    pub most_lift: [f64; 2],
}

/// Distance of the nodes at which postures are chosen, as a share of the cutter's diameter: what the cutter touches
/// changes little over less.
const CELL: f64 = 0.1;
/// Least and most cells a side.
const CELLS: [usize; 2] = [24, 140];

/// The share of the turn asked for that a posture may use where the contact frame turns by all of it and more.
const FLOOR: f64 = 0.1;
/// How far the contact may swing round the cutter, mm for each of travel: the disc then moves askew by as much.
const MOST_SWING: f64 = 0.3;

/// The postures of `rule` on `ground`, for one way of feed or for `both`.
///
/// They are chosen for all of the face at once, at nodes a tenth of the cutter's diameter apart. First the yaws that make the
/// passes shortest, smoothly over the face; then for these the least leads at which curvatures match, the bottom's rear, the
/// side, the shank and the holder clear the whole face, and axes turn no faster than the limits ask. Less lead is a wider strip, and no
/// other leads that keep the limits are lower anywhere.
///
/// The same for any number of workers.
pub fn choose(rule: &Rule, ground: &Ground, both: bool, stage: &Stage) -> Result<PostureField, Cancelled> {
    let limits = match rule.limits() {
        Ok(limits) => limits,
        Err(posture) => return Ok(PostureField::fixed(posture)),
    };
    let radius = ground.cutter.center_radius + ground.cutter.corner_radius;
    let grid = FaceGrid::new(ground.face, 2.0 * CELL * radius, CELLS[0], CELLS[1]);
    let half = if both { 0.5 } else { 1.0 };
    let (lattice, way, misfits) =
        one_way(&limits, ground, &grid, false, &stage.part("Choosing postures", 0.0, half))?;
    let typical = mean(&lattice, &way.postures);
    let fit = largest_fit(ground, &limits, misfits.iter().map(|&i| &lattice.nodes[i]));
    let spots = misfits.iter().map(|&i| lattice.nodes[i].uv).collect();
    let mut ways = vec![way];
    if both {
        ways.push(one_way(&limits, ground, &grid, true, &stage.part("Choosing postures", half, 1.0))?.1);
    }
    Ok(PostureField::chosen(
        typical,
        ways,
        spots,
        fit,
        #[cfg(feature = "flow")]
        matches!(rule, Rule::Widest(_)).then_some(limits),
    ))
}

/// [`any_way`], with lifts where they save enough.
fn one_way(
    limits: &Limits,
    ground: &Ground,
    grid: &FaceGrid,
    reversed: bool,
    stage: &Stage,
) -> Result<(Lattice, Way, Vec<usize>), Cancelled> {
    let lifted = any_way(limits, ground, grid, reversed, stage)?;
    if lifted.1.lifts.is_empty() {
        return Ok(lifted);
    }
    let ground = Ground { most_lift: [0.0; 2], ..*ground };
    let plain = any_way(limits, &ground, grid, reversed, &stage.quiet())?;
    Ok(if saves(&ground, &lifted.0, &lifted.1, &plain.1) { lifted } else { plain })
}

fn any_way(
    limits: &Limits,
    ground: &Ground,
    grid: &FaceGrid,
    reversed: bool,
    stage: &Stage,
) -> Result<(Lattice, Way, Vec<usize>), Cancelled> {
    let part = |from, to| stage.part("Choosing postures", from, to);
    let lattice = Lattice::new(ground, grid, reversed, &part(0.0, 0.05))?;
    let turns = allowed_turns(limits, &lattice);
    let halves: Vec<f64> = turns.iter().map(|turn| turn * std::f64::consts::FRAC_1_SQRT_2).collect();
    let wished = yaws(ground, limits, &lattice, reversed, &part(0.05, 0.3))?;
    let leads_for = |yaws: &[f64], stage: &Stage| -> Result<_, Cancelled> {
        let floors = local_leads(ground, limits, &lattice, yaws, stage)?;
        let leads = spread(&lattice, &floors, &halves);
        Ok((floors, leads))
    };
    let (mut wished, (mut floors, mut leads)) = {
        let leads = leads_for(&wished, &part(0.3, 0.4))?;
        (wished, leads)
    };
    if limits.most_yaw > 0.0 {
        // Leads spread to places with other yaws; where that costs more than yaw gains, there is none.
        let none = vec![0.0; wished.len()];
        let (plain_floors, plain_leads) = leads_for(&none, &part(0.4, 0.5))?;
        if cost(ground, &lattice, &plain_leads, &none) < cost(ground, &lattice, &leads, &wished) {
            (wished, floors, leads) = (none, plain_floors, plain_leads);
        }
    }
    let yaws = lattice.steadied(&wished, &allowed_yaws(ground, &lattice, &leads, &halves));
    let local = floors.clone();
    let ClearLeads { leads, for_holder, misfits } =
        clear_leads(ground, limits, &lattice, &yaws, &mut floors, &halves, &part(0.5, 1.0))?;
    let told = Leads {
        yaws: &wished,
        local: &local,
        floors: &floors,
        for_holder: &for_holder,
        chosen: &leads,
        misfits: &misfits,
    };
    let bounds = bounds(ground, limits, &lattice, &told);
    // Where clearance took more lead than was thought, the same yaw turns the axis more.
    let yaws = lattice.steadied(&yaws, &allowed_yaws(ground, &lattice, &leads, &halves));
    let postures: Vec<Posture> =
        leads.into_iter().zip(yaws).map(|(lead, yaw)| Posture { lead, yaw }).collect();
    let mut way = Way { axes: lattice.axes.clone(), postures, bounds, lifts: Vec::new() };
    lift(ground, &lattice, &mut way, reversed, stage)?;
    Ok((lattice, way, misfits))
}

/// Whether `lifted` saves [`SAVED`] of the passes of `plain`: strips that are wider in some places than in others do not make
/// whole passes shorter.
fn saves(ground: &Ground, lattice: &Lattice, lifted: &Way, plain: &Way) -> bool {
    let mut costs = [0.0; 2];
    for i in (0..lattice.nodes.len()).step_by(SAMPLED) {
        let half = |way: &Way, lift| half_width(ground, &lattice.nodes[i], way.postures[i], lift);
        if let (Some(with), Some(without)) = (half(lifted, lifted.lifts[i]), half(plain, 0.0)) {
            costs[0] += lattice.nodes[i].area / with;
            costs[1] += lattice.nodes[i].area / without;
        }
    }
    costs[0] < (1.0 - SAVED) * costs[1]
}

/// Share of the passes that lifts have to save.
const SAVED: f64 = 0.03;

/// The area of the face in strips' widths, over some of the nodes: about how long passes are, in mm, where all nodes count.
fn cost(ground: &Ground, lattice: &Lattice, leads: &[f64], yaws: &[f64]) -> f64 {
    let one = |i: usize| {
        let node = &lattice.nodes[i];
        let posture = Posture { lead: leads[i], yaw: yaws[i] };
        // Where the cutter digs in, or the strip runs over borders on both sides, nothing is told.
        half_width(ground, node, posture, 0.0).map_or(0.0, |half| 0.5 * node.area / half)
    };
    (0..leads.len()).step_by(SAMPLED).map(one).sum()
}

/// Every so many nodes are looked at to compare postures; no divisor of a common number of nodes a side.
const SAMPLED: usize = 7;

/// By how much the axes of the neighbours of each pair may differ in their contact frames, radians.
fn allowed_turns(limits: &Limits, lattice: &Lattice) -> Vec<f64> {
    let allowed = |pair: &super::lattice::Pair| {
        let [along, across] = [0, 1].map(|k| limits.most_turn[k] * pair.way[k]);
        let [a, b] = pair.nodes.map(|i| lattice.nodes[i].contact);
        // Only what lies one after the other on a pass turns with its frame.
        let share = pair.way[0] / libm::hypot(pair.way[0], pair.way[1]).max(f64::MIN_POSITIVE);
        let own = match (a, b) {
            (Some(a), Some(b)) => share * rotation(&a.frame, &b.frame),
            _ => 0.0,
        };
        libm::hypot((along - own).max(FLOOR * along), across)
    };
    lattice.pairs.iter().map(allowed).collect()
}

/// By how much the yaws of the neighbours of each pair may differ, radians: half of the turn, squared, is the lead's.
fn allowed_yaws(ground: &Ground, lattice: &Lattice, leads: &[f64], halves: &[f64]) -> Vec<f64> {
    let radius = ground.cutter.center_radius + ground.cutter.corner_radius;
    let allowed = |(pair, half): (&super::lattice::Pair, &f64)| {
        let [a, b] = pair.nodes.map(|i| leads[i]);
        let swing = MOST_SWING * libm::hypot(pair.way[0], pair.way[1]) / radius;
        swing.min(half / libm::sin(a.max(b)))
    };
    lattice.pairs.iter().zip(halves).map(allowed).collect()
}

/// The angle of the rotation that carries one frame into the other: no axis that is fixed in them turns by more.
fn rotation(a: &Frame, b: &Frame) -> f64 {
    let trace = a.f.dot(b.f) + a.b.dot(b.b) + a.n.dot(b.n);
    libm::acos((0.5 * (trace - 1.0)).clamp(-1.0, 1.0))
}

fn mean(lattice: &Lattice, postures: &[Posture]) -> Posture {
    let (mut area, mut sum) = (0.0, Posture::default());
    for (node, posture) in lattice.nodes.iter().zip(postures) {
        area += node.area;
        sum.lead += node.area * posture.lead;
        sum.yaw += node.area * posture.yaw;
    }
    if area > 0.0 { Posture { lead: sum.lead / area, yaw: sum.yaw / area } } else { Posture::default() }
}
