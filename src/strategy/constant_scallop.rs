//! Passes offset from a start curve, edge to edge, each everywhere as far from the last as its own strip is wide.
//!
//! Such passes are the level lines of a function that rises by one over a strip, `|∇φ| w = 1`: an eikonal equation whose
//! speed is the width of the strip for a feed along the level line. A front that runs out from the start curve gives it
//! roughly, wherever fronts meet too; strips measured on its own level lines then tell by how much it is off.

mod crest;
mod curve;
mod even;
mod fit;
mod known;
mod march;
mod offset;
mod strips;
mod upwind;

use super::family::{Candidate, Family};
use super::fill;
use super::follow::Part;
use super::iso_planar::{self, mean_normal};
use super::laid::Laid;
use super::placing::too_many;
use super::probe::Setup;
use super::{Finish, Order, Planned, StrategyError};
use crate::cutter::Tool;
use crate::geometry::{Along, Face, Field, Table, Uv};
use crate::monitor::Stage;
use crate::posture::Rule;
use crate::toolpath::Posture;
pub use curve::StartError;
pub(super) use even::passes as evened_passes;
use fit::Fit;
use glam::DVec3;
use march::March;
use offset::{Offset, flat_strip};
use std::sync::Arc;

/// Where constant-scallop passes start from.
#[derive(Debug, Clone, PartialEq)]
pub enum Start {
    /// A line of one parameter: it runs along `along` where the other parameter is at the fraction `at` of its range. At 0
    /// and 1 that is a border.
    Line {
        /// Which parameter the line runs along.
        along: Along,
        /// Where across, 0 to 1.
        at: f64,
    },
    /// The section by the plane through the middle of the face that holds its mean normal, turned about it by this
    /// angle, radians (0 is along the x axis as seen along the mean normal).
    Section(f64),
    /// The curve through these points, mm, at least two: each counts by its nearest one on the face, and between them the curve
    /// is straight in the face's parameters. It goes on so at both ends until it leaves the face; one whose last point is its
    /// first is closed. It must divide the face and not cross itself.
    Curve(Vec<DVec3>),
}

/// What a person reads meanwhile.
const TILT: &str = "Choosing postures";
const SOLVE: &str = "Offsetting the start curve";
const PLACE: &str = "Spacing passes";
const FILL: &str = "Filling gaps";
/// Levels, in strips, that count as none.
const ROUNDING: f64 = 1e-9;
/// The lead for which strips are as wide as chosen postures make them, roughly, radians.
const CHOSEN: f64 = 0.2;
/// Rounds in which the spacing is measured and mended.
const ROUNDS: usize = 4;

/// A way to lay passes offset from the line of a field, no longer than so many mm.
type OffsetPasses<'a> = fn(
    (&'a Face, &'a Tool),
    &(Field, f64, Field),
    &Rule,
    Finish,
    Order,
    f64,
    &Stage,
) -> Result<Option<Laid<'a>>, StrategyError>;

/// Passes of `face` offset from `start` to both sides, edge to edge, the axis leaning by `rule`.
///
/// Passes that the border cuts off go on as pieces, fronts that meet end on one another, and where a pass would leave more
/// than the limit between it and its neighbour, partial passes fill in. On a closed face cut from a line across it fronts
/// run round to both sides, the start curve between the first two passes, and meet.
///
/// Strips can be of such different widths that passes offset from one another bend more than they gain: where passes along
/// the level lines that the start curve is one of come out shorter, or the others leave something, it is those. Where postures are
/// chosen it may be passes whose strips' widths are evened out, too.
pub fn constant_scallop(
    face: &Face,
    tool: &Tool,
    start: &Start,
    rule: Rule,
    finish: Finish,
    order: Order,
    stage: &Stage,
) -> Result<Planned, StrategyError> {
    let posture = if let Rule::Fixed(posture) = rule { posture } else { Posture { lead: CHOSEN, yaw: 0.0 } };
    let seed = seed(face, start, flat_strip(&tool.cutter, posture, &finish))?;
    // The level lines of a distance are what is offset already, and a curve that was given is to be the first pass.
    if matches!((start, rule), (Start::Curve(_), Rule::Fixed(_))) {
        let even = offset_passes((face, tool), &seed, &rule, finish, order, f64::INFINITY, stage)?;
        return even.map(|even| even.planned).ok_or_else(too_many);
    }
    let (from, _, column) = seed.clone();
    let (part, rest) = ((face, tool), stage.part(SOLVE, 0.2, 0.95));
    let laying = stage.part(PLACE, 0.0, 0.2);
    let mut best = Family::shortest(part, &rule, finish, (from, column), order, &laying)?;
    let ways: &[OffsetPasses<'_>] = match rule {
        Rule::Fixed(_) => &[offset_passes],
        _ => &[evened_passes as OffsetPasses<'_>, offset_passes as OffsetPasses<'_>],
    };
    for (k, passes) in ways.iter().enumerate() {
        let at = |k: usize| k as f64 / ways.len() as f64;
        let laying = rest.part(SOLVE, at(k), at(k + 1));
        match passes(part, &seed, &best.rule, finish, order, best.most(), &laying) {
            Ok(laid) => best = laid.filter(|laid| laid.is_better(&best)).unwrap_or(best),
            Err(StrategyError::Cancelled(cancelled)) => return Err(cancelled.into()),
            // There are passes already.
            Err(_) => {}
        }
    }
    best.eased(&stage.part("Easing postures", 0.95, 1.0))
}

/// The passes edge to edge; none where they come out longer than `most` (mm).
pub(super) fn offset_passes<'a>(
    part: (&'a Face, &'a Tool),
    seed: &(Field, f64, Field),
    rule: &Rule,
    finish: Finish,
    order: Order,
    most: f64,
    stage: &Stage,
) -> Result<Option<Laid<'a>>, StrategyError> {
    let spacing = stage.part(PLACE, 0.0, 0.75);
    let (lines, crests) = offset_lines(part, seed, rule, finish, order, &|_, _| true, &spacing)?;
    let tracks = lines.tracks.iter().flat_map(|track| &track.lines);
    if tracks.map(|line| line.length(part.0)).sum::<f64>() > most {
        return Ok(None);
    }
    let following = stage.part("Following the surface", 0.75, 1.0);
    Laid::of(*rule, lines, crests, &following).map(Some)
}

/// The lines offset edge to edge from that of `seed`, to either side as long as each `goes_on`; and where they bend much or fronts meet.
pub(super) fn offset_lines<'a>(
    (face, tool): (&'a Face, &'a Tool),
    (from, level, column): &(Field, f64, Field),
    rule: &Rule,
    finish: Finish,
    order: Order,
    goes_on: &dyn Fn(&Family, &Candidate) -> bool,
    stage: &Stage,
) -> Result<(Part<'a>, Vec<Uv>), StrategyError> {
    let finish = finish.with_fine_chords();
    let fields = (from.clone(), column.clone());
    let mut setup = Setup::new(face, tool, rule, finish, fields, order, &stage.part(TILT, 0.0, 0.07))?;
    let offset = Offset::new(&setup, from, *level);
    let first = offset.solve(&setup, &stage.part(SOLVE, 0.07, 0.13))?;
    setup = Setup { field: Field::Given(Arc::new(first)), ..setup };
    for round in 0..ROUNDS {
        let part = |from: f64, to: f64| {
            let at = |t: f64| 0.13 + 0.53 * (round as f64 + t) / ROUNDS as f64;
            stage.part(SOLVE, at(from), at(to))
        };
        // Postures follow the passes' direction, which is about right from here on.
        if round + 2 >= ROUNDS {
            setup.choose(rule, order, &part(0.0, 0.3))?;
        }
        let mended = Fit::new(&setup, &offset, order).mended(&part(0.3, 1.0))?;
        setup = Setup { field: Field::Given(Arc::new(mended)), ..setup };
    }
    setup.choose(rule, order, &stage.part(TILT, 0.66, 0.69))?;
    let values = offset.values(&setup.field);
    let is_border = values.iter().copied().fold(f64::INFINITY, f64::min) >= -ROUNDING;
    let family = Family::on_grid(setup, order, offset.grid.clone());
    let (family, placed, own) =
        March::new(family, &offset, values).laid(is_border, goes_on, &stage.part(PLACE, 0.69, 0.93))?;
    let tracks = fill::tracks(&family, placed, &stage.part(FILL, 0.93, 1.0))?;
    let crests = crest::places(&family, &offset);
    Ok((Part::between(own, family, tracks), crests))
}

/// At the nodes of `grid`, how far places are from the curve through `points` (mm), with another sign on either side.
pub(super) fn away_from(
    face: &Face,
    grid: &crate::geometry::FaceGrid,
    points: &[DVec3],
) -> Result<Vec<f64>, StartError> {
    curve::seed(face, grid, points, 1.0).map(|(away, _)| away)
}

/// A field and level whose line is the start curve, and a field that tells places along it apart, for strips that are so wide
/// on flat ground, mm.
pub(super) fn seed(face: &Face, start: &Start, strip: f64) -> Result<(Field, f64, Field), StartError> {
    let domain = face.domain();
    Ok(match *start {
        Start::Line { along: Along::V, at } => (Field::U, domain.u.at(at), Field::V),
        Start::Line { along: Along::U, at } => (Field::V, domain.v.at(at), Field::U),
        Start::Section(angle) => {
            let middle = domain.at(0.5, 0.5);
            let (across, along) = iso_planar::fields(mean_normal(face), angle);
            let level = across.value(middle, face.surface.point(middle));
            (across, level, along)
        }
        Start::Curve(ref points) => {
            let grid = offset::grid(face, strip);
            let (away, along) = curve::seed(face, &grid, points, strip)?;
            let given = |values: &[f64]| Field::Given(Arc::new(Table::new(domain, &grid, values)));
            (given(&away), 0.0, given(&along))
        }
    })
}
