//! How far places lie from a start curve, in strips, by a front that runs out from it.

use crate::contact::{matching_lead, model_strip, second_order_strip_width};
use crate::cutter::Cutter;
use crate::geometry::{Curvature, Domain, Face, FaceGrid, Field, Fronts, Table, Uv};
use crate::monitor::{Cancelled, Stage};
use crate::strategy::Finish;
use crate::strategy::probe::{Setup, contact_frame};
use crate::toolpath::Posture;
use std::sync::Arc;

/// Cells along either parameter on which the passes' spacing is solved for.
const LEAST: usize = 48;
const MOST: usize = 600;
/// Strips a cell.
const CELL: f64 = 0.35;
/// Rounds in which direction and width come to agree.
const AGREE: usize = 4;
/// The widest and narrowest strips that are believed, in strips on flat ground: where the cutter cannot stand, or fits like
/// a stamp, the field must still go on.
const WIDEST: f64 = 4.0;
const NARROWEST: f64 = 0.1;

/// A grid over a face and where the start curve runs through it.
pub(super) struct Offset {
    pub(super) grid: FaceGrid,
    pub(super) domain: Domain,
    /// On which side of the start curve the nodes lie, 1 or −1.
    sides: Vec<f64>,
    /// Whether fronts run round the face to both sides and meet: then the function rises to either.
    pub(super) is_round: bool,
    /// Nodes on the start curve or beside it, and how far from it they are, mm.
    pub(super) near: Vec<(usize, f64)>,
    /// Width on flat ground, mm.
    flat: f64,
}

/// The width of a strip on flat ground, mm.
pub(super) fn flat_strip(cutter: &Cutter, posture: Posture, finish: &Finish) -> f64 {
    second_order_strip_width(cutter, posture, &Curvature::default(), finish.scallop)
}

/// The grid on which passes are spaced whose strips on flat ground are so wide, mm.
pub(super) fn grid(face: &Face, flat: f64) -> FaceGrid {
    FaceGrid::new(face, CELL * flat, LEAST, MOST)
}

/// The period of `from`, if it is a parameter of `face` that has one: then fronts run round to both sides and meet.
pub(super) fn period(face: &Face, from: &Field) -> Option<f64> {
    let domain = face.domain();
    match from {
        Field::U if domain.u.periodic => Some(domain.u.length()),
        Field::V if domain.v.periodic => Some(domain.v.length()),
        _ => None,
    }
}

impl Offset {
    /// For the start curve at `level` of `from`.
    pub(super) fn new(setup: &Setup, from: &Field, level: f64) -> Self {
        let (face, domain) = (setup.face, setup.face.domain());
        let flat = flat_strip(setup.cutter, setup.postures.typical(), &setup.finish);
        let grid = grid(face, flat);
        let (nu, nv) = grid.size();
        let uv = |k: usize| grid.uv(k % nu, k / nu);
        let points = grid.points().iter().enumerate();
        // Across a period there are two ways from one place to another: the shorter counts.
        let period = period(face, from);
        let shorter = |x: f64| period.map_or(x, |p| x - (x / p).round() * p);
        let away: Vec<f64> = points.map(|(k, p)| shorter(from.value(uv(k), *p) - level)).collect();
        let fronts = Fronts::new(&domain, &grid);
        let far = period.map_or(f64::INFINITY, |p| 0.5 * p);
        let parted = |k: usize, n: usize| away[n] * away[k] <= 0.0 && (away[n] - away[k]).abs() < far;
        let beside = |k: &usize| fronts.around(*k).into_iter().flatten().any(|n| parted(*k, n));
        let distance = |k: usize| {
            let rise = from.surface_gradient(uv(k), &face.jet(uv(k))).length();
            if rise > 0.0 && rise.is_finite() { away[k].abs() / rise } else { 0.0 }
        };
        let near = (0..nu * nv).filter(beside).map(|k| (k, distance(k))).collect();
        // From a border there is one way only; and where both ways lead to the same place neither is up.
        let one_way = away.iter().all(|away| *away <= 0.0);
        let sides = if period.is_some() || one_way {
            vec![1.0; away.len()]
        } else {
            away.iter().map(|away| if *away < 0.0 { -1.0 } else { 1.0 }).collect()
        };
        Self { grid, domain, sides, is_round: period.is_some(), near, flat }
    }

    /// `field` at the nodes.
    pub(super) fn values(&self, field: &Field) -> Vec<f64> {
        field.at_nodes(&self.grid)
    }

    pub(super) fn uv(&self, node: usize) -> Uv {
        let nu = self.grid.size().0;
        self.grid.uv(node % nu, node / nu)
    }

    /// The function that is 0 on the start curve and rises by about one over every strip.
    pub(super) fn solve(&self, setup: &Setup, stage: &Stage) -> Result<Table, Cancelled> {
        let fronts = Fronts::new(&self.domain, &self.grid);
        let count = self.sides.len();
        let mut direction = setup.field.clone();
        let mut table = Table::new(self.domain, &self.grid, &self.sides);
        for _ in 0..AGREE {
            let slowness = stage.quiet().map(count, |k| 1.0 / self.width(setup, k, &direction))?;
            table = self.arrivals(&fronts, &slowness);
            direction = Field::Given(Arc::new(table.clone()));
        }
        Ok(table)
    }

    /// When a front of this slowness at the nodes (strips per mm), which leaves the start curve, arrives; below 0 on its one side.
    pub(super) fn arrivals(&self, fronts: &Fronts, slowness: &[f64]) -> Table {
        let seeds: Vec<(usize, f64)> = self.near.iter().map(|&(k, d)| (k, d * slowness[k])).collect();
        let times = fronts.times(&seeds, slowness);
        let longest = times.iter().copied().filter(|t| t.is_finite()).fold(0.0, f64::max);
        let signed: Vec<f64> = times.iter().zip(&self.sides).map(|(t, side)| t.min(longest) * side).collect();
        Table::new(self.domain, &self.grid, &signed)
    }

    /// About how wide the strip at a node is, mm, for a feed along the level line of `direction`.
    pub(super) fn width(&self, setup: &Setup, node: usize, direction: &Field) -> f64 {
        let uv = self.uv(node);
        let wide = || {
            let (jet, frame) = contact_frame(setup.face, direction, uv, false)?;
            let curvature = Curvature::of(&jet, &frame)?;
            let (mut posture, lift) = (setup.postures.at(uv, false), setup.postures.lift(uv, false));
            // On both sides of a hollow the square of the width grows evenly with the root of the lift, from what it is where
            // curvatures match.
            let wider = (1.0 + (lift / setup.finish.scallop).sqrt()).sqrt();
            if lift > 0.0 {
                posture.lead = matching_lead(setup.cutter, &curvature, posture.yaw)?.max(posture.lead);
            }
            let strip = model_strip(setup.cutter, posture, &curvature, setup.finish.scallop);
            let (left, right) = strip.half_widths()?;
            Some((left + right) * wider)
        };
        let width = wide().filter(|w| w.is_finite()).unwrap_or(self.flat);
        width.clamp(NARROWEST * self.flat, WIDEST * self.flat)
    }
}
