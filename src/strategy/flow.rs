//! Passes that follow the widest strips: along the level lines of whichever function of many makes them shortest.
//!
//! Lines of one parameter, parallel sections, functions bent towards the directions of the widest strips, and passes offset edge to
//! edge from lines of those and from lines along the widest strips are compared by how long they would be ([`super::coarea`]) before
//! any is laid. The best few are laid, and the shortest is taken.

mod bend;
mod edge_to_edge;

use super::coarea::expected_length;
use super::constant_scallop::{Start, offset_passes, seed};
use super::family::{Family, Laid};
use super::iso_planar::mean_normal;
use super::line_field::LineField;
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
use edge_to_edge::{Line, Starts};
use glam::DVec3;
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
/// Where postures are fixed and some passes leave nothing, others that should come out longer than the shortest by more than this share
/// are not laid, nor more than so many. Where they are chosen strips keep less to the surface's second order, and all are.
const WORSE: f64 = 1.05;
const MOST: usize = 4;
/// Passes are offset from one line of those functions, and from so many along the widest strips: the best, and the best of what
/// should come out longer than the last by this share, since most are neighbours of the best.
const STREAMLINES: usize = 2;
const OTHER: f64 = 1.003;

/// A function and how long passes along its level lines should be, mm.
struct Proposal {
    /// The function, and one that tells places along its level lines apart.
    fields: (Field, Field),
    values: Vec<f64>,
    expected: f64,
}

/// Passes that might be laid.
enum Way {
    /// Along the level lines of a function, told apart by another.
    Levels(Field, Field),
    /// Offset from a line.
    From(Line),
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
    let ways = ways((face, &grid), &potential);
    let (count, shortest) = (ways.len(), ways.first().map_or(0.0, |way| way.0));
    let mut best: Option<Laid> = None;
    for (k, (expected, way)) in ways.into_iter().enumerate() {
        let is_worse = matches!(rule, Rule::Fixed(_)) && (k >= MOST || expected > WORSE * shortest);
        if is_worse && best.as_ref().is_some_and(|best| best.is_whole) {
            break;
        }
        let at = |k: usize| 0.1 + 0.9 * k as f64 / count as f64;
        let part = stage.part("Spacing passes", at(k), at(k + 1));
        let line = match way {
            Way::Levels(field, column) => {
                best = Family::improved((face, tool), &rule, finish, (field, column), order, best, &part)?;
                continue;
            }
            Way::From(line) => line,
        };
        let seed = match line {
            Line::Level { fields, level } => (fields.0, level, fields.1),
            Line::Through(points) => seed(face, &Start::Curve(points), flat)?,
        };
        // By which version of the rule passes are shortest hardly depends on the passes.
        let rules = best.as_ref().map_or_else(|| rule.versions(), |best| vec![best.rule]);
        for rule in rules {
            let most = best.as_ref().map_or(f64::INFINITY, |best| best.planned.length());
            let offset = offset_passes((face, tool), &seed, &rule, finish, order, most, &part)?;
            let offset = offset.map(|(planned, is_whole)| Laid { planned, is_whole, rule });
            best = match (offset, best) {
                (Some(offset), Some(best)) if !offset.is_better(&best) => Some(best),
                (offset, best) => offset.or(best),
            };
        }
    }
    Ok(best.ok_or_else(too_many)?.planned)
}

/// What might be laid and how long it should be, mm; the shortest first.
fn ways((face, grid): (&Face, &FaceGrid), potential: &Potential) -> Vec<(f64, Way)> {
    let proposals = proposals(face, grid, potential);
    let starts = Starts { face, grid, potential };
    let mut ways: Vec<(f64, Way)> = Vec::new();
    let (mut levels, mut streamlines) = (starts.levels(&proposals), starts.streamlines());
    best_first(&mut levels, |start| start.1);
    best_first(&mut streamlines, |start| start.1);
    streamlines.dedup_by(|next, last| next.1 < OTHER * last.1);
    let lines = levels.into_iter().take(1).chain(streamlines.into_iter().take(STREAMLINES));
    ways.extend(lines.map(|(line, expected)| (expected, Way::From(line))));
    for Proposal { fields, expected, .. } in proposals {
        ways.push((expected, Way::Levels(fields.0, fields.1)));
    }
    best_first(&mut ways, |way| way.0);
    ways
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
    best_first(&mut sections, |section| section.expected);
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
    best_first(&mut bent, |bent| bent.expected);
    bent.into_iter().take(1).chain(sections.into_iter().take(1)).chain(parameters).collect()
}

fn best_first<T>(ways: &mut [T], expected: impl Fn(&T) -> f64) {
    sort_by_key(ways, |way| (rank(expected(way)), 0));
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
