//! Passes that follow the widest strips: along the level lines of whichever function of many makes them shortest.
//!
//! Lines of one parameter, parallel sections, and functions bent towards the directions of the widest strips are compared by how
//! long their passes would be ([`super::coarea`]) before any is laid. The best few are laid, and passes offset edge to edge from the best
//! of their lines; and the shortest is taken.

mod bend;
mod edge_to_edge;
mod line_field;

use super::coarea::expected_length;
use super::constant_scallop::offset_passes;
use super::family::{Family, Laid};
use super::iso_planar::mean_normal;
use super::placing::too_many;
use super::potential::Potential;
use super::{Finish, Order, Planned, StrategyError};
use crate::cutter::Tool;
use crate::geometry::{Face, FaceGrid, Field, Table};
use crate::math::frame::Frame;
use crate::math::order::{rank, sort_by_key};
use crate::monitor::Stage;
use crate::posture::Rule;
use bend::{bent, columns};
use edge_to_edge::{Beginning, beginnings};
use glam::DVec3;
use line_field::LineField;
use std::f64::consts::PI;
use std::sync::Arc;

/// Cells of the grid on which functions are compared: in strips on flat ground, and at least and at most so many a side.
const CELL: f64 = 0.7;
const CELLS: [usize; 2] = [24, 56];
/// Directions of parallel sections that are compared.
const SECTIONS: usize = 12;
/// How many functions are bent towards the widest strips, and how much: see [`bent`].
const BENT: usize = 3;
const SOFT: [f64; 3] = [0.2, 1.0, 10.0];
/// Where postures are fixed, a function whose passes should come out longer than the best by more than this share is not laid.
/// Where they are chosen strips keep less to the surface's second order, and all are.
const WORSE: f64 = 1.08;
/// How many lines passes are offset from, edge to edge.
const OFFSET: usize = 2;

/// A function and how long passes along its level lines should be, mm.
struct Proposal {
    /// The function, and one that tells places along its level lines apart.
    fields: (Field, Field),
    values: Vec<f64>,
    expected: f64,
}

/// Passes of `face` along the widest strips, the axis leaning by `rule`.
pub fn flow(
    face: &Face,
    tool: &Tool,
    rule: Rule,
    finish: Finish,
    order: Order,
    stage: &Stage,
) -> Result<Planned, StrategyError> {
    let looking = stage.part("Comparing directions", 0.0, 0.1);
    let cutter = &tool.cutter;
    let flat = Potential::flat(cutter, &rule, &finish);
    let grid = FaceGrid::new(face, CELL * flat, CELLS[0], CELLS[1]);
    let potential = Potential::new((face, &grid), cutter, &rule, &finish, &looking)?;
    let mut proposals = proposals(face, &grid, &potential);
    best_first(&mut proposals);
    if let (Rule::Fixed(_), Some(best)) = (rule, proposals.first()) {
        let most = WORSE * best.expected;
        proposals.retain(|proposal| proposal.expected <= most);
    }
    let domain = face.domain();
    let is_open = !domain.u.periodic && !domain.v.periodic;
    let mut begun = if is_open { beginnings(&proposals, (&grid, &domain), &potential) } else { Vec::new() };
    sort_by_key(&mut begun, |beginning| (rank(beginning.expected), 0));
    begun.truncate(OFFSET);
    let count = proposals.len() + begun.len();
    let part = |k: usize| {
        let at = |t: f64| 0.1 + 0.9 * (k as f64 + t) / count as f64;
        stage.part("Spacing passes", at(0.0), at(1.0))
    };
    let mut best = None;
    for (k, Proposal { fields, .. }) in proposals.iter().enumerate() {
        best = Family::improved((face, tool), &rule, finish, fields.clone(), order, best, &part(k))?;
    }
    let mut best = best.ok_or_else(too_many)?;
    for (k, &Beginning { proposal, level, .. }) in begun.iter().enumerate() {
        let (field, column) = proposals[proposal].fields.clone();
        let (seed, part) = ((field, level, column), part(proposals.len() + k));
        let most = best.planned.length();
        let offset = offset_passes((face, tool), &seed, &best.rule, finish, order, most, &part)?;
        let offset = offset.map(|(planned, is_whole)| Laid { planned, is_whole, rule: best.rule });
        best = offset.filter(|offset| offset.is_better(&best)).unwrap_or(best);
    }
    Ok(best.planned)
}

/// The functions worth laying: the best of each kind.
fn proposals(face: &Face, grid: &FaceGrid, potential: &Potential) -> Vec<Proposal> {
    let (nu, domain) = (grid.size().0, face.domain());
    let proposal = |fields: (Field, Field)| {
        let points = grid.points().iter().enumerate();
        let values: Vec<f64> = points.map(|(k, p)| fields.0.value(grid.uv(k % nu, k / nu), *p)).collect();
        let expected = expected_length(grid, &domain, potential, &values);
        Proposal { fields, values, expected }
    };
    let parameters = [(Field::U, Field::V), (Field::V, Field::U)].map(proposal);
    // Planes cut a face that closes on itself twice, and what is bent over its seam would have to count on beyond it.
    if domain.u.periodic || domain.v.periodic {
        return parameters.into();
    }
    let mut sections: Vec<Proposal> = sections(face).into_iter().map(proposal).collect();
    best_first(&mut sections);
    let lines = LineField::new(face, grid, potential);
    let given = |values: &[f64]| Field::Given(Arc::new(Table::new(domain, grid, values)));
    let bend = |(from, soft): (&Proposal, f64)| {
        let values = bent(grid, potential, &lines, (&from.values, domain), soft);
        proposal((given(&values), given(&columns(grid, &values, domain))))
    };
    let mut plain: Vec<&Proposal> = parameters.iter().chain(&sections).collect();
    sort_by_key(&mut plain, |proposal| (rank(proposal.expected), 0));
    let ways = plain.into_iter().take(BENT).flat_map(|from| SOFT.map(|soft| (from, soft)));
    let mut bent: Vec<Proposal> = ways.map(bend).collect();
    best_first(&mut bent);
    bent.into_iter().take(1).chain(sections.into_iter().take(1)).chain(parameters).collect()
}

fn best_first(proposals: &mut [Proposal]) {
    sort_by_key(proposals, |proposal| (rank(proposal.expected), 0));
}

/// Parallel planes in even steps of direction, each with a function that tells places along its lines apart.
fn sections(face: &Face) -> Vec<(Field, Field)> {
    let up = mean_normal(face);
    let flat = Frame::from_normal(up, DVec3::X).unwrap_or_else(|| Frame::any(up));
    let section = |k: usize| {
        let (s, c) = libm::sincos(PI * k as f64 / SECTIONS as f64);
        let along = flat.f * c + flat.b * s;
        (Field::Along(up.cross(along)), Field::Along(along))
    };
    (0..SECTIONS).map(section).collect()
}
