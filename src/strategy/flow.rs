//! Passes that follow the widest strips: along the level lines of whichever function of many makes them shortest.
//!
//! Lines of one parameter, parallel sections, functions bent towards the directions of the widest strips, and passes offset from lines
//! of those and from lines along the widest strips (edge to edge, or by widths evened out where postures are chosen), one family all
//! over the face or several that divide it, are compared by how long they would be ([`super::coarea`]) before any is laid. The best few
//! are laid, and the shortest is taken.

mod bend;
mod divide;
mod starts;

use super::coarea::{expected_length, shares};
use super::constant_scallop::{self, evened_passes, offset_lines, offset_passes, seed};
use super::family::Family;
use super::follow::Part;
use super::iso_planar::{self, mean_normal};
use super::laid::Laid;
use super::line_field::LineField;
use super::placing::too_many;
use super::potential::Potential;
use super::region::Region;
use super::{Finish, Order, Planned, StrategyError};
use crate::cutter::Tool;
use crate::geometry::{Domain, Face, FaceGrid, Field, Table};
use crate::math::order::{rank, sort_by_key};
use crate::monitor::{Cancelled, Stage};
use crate::posture::Rule;
use bend::{bent, columns};
use starts::{Line, Start, Starts};
use std::f64::consts::PI;
use std::sync::Arc;

/// Directions of parallel sections that are compared.
const SECTIONS: usize = 12;
/// How many functions are bent towards the widest strips, and how much: see [`bent`].
const BENT: usize = 3;
const SOFT: [f64; 3] = [0.2, 1.0, 10.0];
/// Once some passes leave nothing, others that should come out longer than the shortest by more than this share are not laid, nor more
/// than so many: where postures are fixed; and where they are chosen, since strips keep less to the surface's second order then. With
/// yaws that are chosen too, hardly at all: everything is laid.
const WORSE: [f64; 2] = [1.05, 1.3];
const MOST: usize = 4;
/// Of what should be as long to this share, parameters and planes are laid first: what is expected is no more exact.
const STRAIGHT: f64 = 0.99;
/// Where postures are chosen, passes offset from a line along the widest strips must promise to be this share of any others.
const BENDS: f64 = 0.9;
/// Places a side of a cell that are looked at where regions meet.
const CLOSE: usize = 32;
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
    /// Offset from several lines, each within its region.
    Divided(Vec<(Line, Region)>),
}

/// Passes that might be laid, and whether only where all others leave something.
struct Rated {
    way: Way,
    is_spare: bool,
}

impl Proposal {
    /// The border that its lines begin at, where they are a parameter's.
    fn border(&self, domain: &Domain) -> Option<Line> {
        let range = match self.fields.0 {
            Field::U => domain.u,
            Field::V => domain.v,
            Field::Along(_) | Field::Given(_) => return None,
        };
        (!range.periodic).then(|| Line::Level { fields: self.fields.clone(), level: range.lo })
    }

    fn way(self) -> (f64, Way) {
        (self.expected, Way::Levels(self.fields.0, self.fields.1))
    }
}

/// How many families passes may be of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Families {
    /// One: links are few.
    One,
    /// As many as make the cuts shortest: passes end where families meet, and links are many.
    Several,
}

/// Passes of `face` along the widest strips, the axis leaning by `rule`.
///
/// Several families are looked for at fixed postures, on faces that do not close on themselves, and only where they should save 1 %.
pub fn flow(
    face: &Face,
    tool: &Tool,
    families: Families,
    rule: Rule,
    finish: Finish,
    order: Order,
    stage: &Stage,
) -> Result<Planned, StrategyError> {
    let looking = |from, to| stage.part("Comparing directions", from, to);
    let cutter = &tool.cutter;
    let flat = Potential::flat(cutter, &rule, &finish);
    let grid = Potential::grid(face, flat);
    let measured = |rule, stage: &Stage| Potential::new((face, &grid), cutter, &rule, &finish, stage);
    let mut ways =
        ways((face, &grid), &measured(rule, &looking(0.0, 0.04))?, (&rule, families), &looking(0.04, 0.07))?;
    if let Rule::Widest(limits) = rule {
        // Yaws that make a strip wide at a place may not be those of its neighbours: directions without any are tried too.
        let straight = proposals(face, &grid, &measured(Rule::Matched(limits), &looking(0.07, 0.1))?);
        let own = straight.into_iter().filter(|way| !matches!(way.fields.0, Field::U | Field::V));
        ways.extend(rated(own.map(Proposal::way).collect(), WORSE[1]));
    }
    let (spare, ways): (Vec<Rated>, Vec<Rated>) = ways.into_iter().partition(|way| way.is_spare);
    let count = ways.len() + spare.len();
    let planner = Planner { face, tool, rule, finish, order, flat };
    let mut best: Option<Laid> = None;
    let mut why = None;
    for (k, Rated { way, is_spare }) in ways.into_iter().chain(spare).enumerate() {
        if is_spare && best.as_ref().is_some_and(|best| best.is_whole) {
            break;
        }
        let at = |k: usize| 0.1 + 0.85 * k as f64 / count as f64;
        match planner.better(way, best.as_ref(), &stage.part("Spacing passes", at(k), at(k + 1))) {
            Ok(better) => best = better.or(best),
            Err(StrategyError::Cancelled(cancelled)) => return Err(cancelled.into()),
            // Another way may do.
            Err(other) => why = Some(other),
        }
    }
    let best = best.ok_or_else(|| why.unwrap_or_else(too_many))?;
    best.eased(&stage.part("Easing postures", 0.95, 1.0))
}

/// What ways are laid with.
struct Planner<'a> {
    face: &'a Face,
    tool: &'a Tool,
    rule: Rule,
    finish: Finish,
    order: Order,
    /// About how wide strips are on flat ground, mm.
    flat: f64,
}

impl<'a> Planner<'a> {
    /// The passes of `way` where they are better than `best`.
    fn better(
        &self,
        way: Way,
        best: Option<&Laid<'a>>,
        stage: &Stage,
    ) -> Result<Option<Laid<'a>>, StrategyError> {
        let (part, finish, order) = ((self.face, self.tool), self.finish, self.order);
        let seed = match way {
            Way::Levels(field, column) => {
                return Family::improved(part, &self.rule, finish, (field, column), order, best, stage);
            }
            Way::From(line) => self.seed(line)?,
            Way::Divided(pieces) => return self.divided(pieces, best, stage),
        };
        // By which version of the rule passes are shortest hardly depends on the passes.
        let rules = best.map_or_else(|| self.rule.versions(), |best| vec![best.rule]);
        let mut found: Option<Laid> = None;
        for (k, &rule) in rules.iter().enumerate() {
            let best = found.as_ref().or(best);
            let most = best.map_or(f64::INFINITY, Laid::most);
            let at = |k: usize| k as f64 / rules.len() as f64;
            let spacing = stage.part("Spacing passes", at(k), at(k + 1));
            let passes = if matches!(rule, Rule::Fixed(_)) { offset_passes } else { evened_passes };
            let laid = passes(part, &seed, &rule, finish, order, most, &spacing)?;
            found = laid.filter(|laid| best.is_none_or(|best| laid.is_better(best))).or(found);
        }
        Ok(found)
    }

    /// A function and level whose line it is, and a function that tells places along it apart.
    fn seed(&self, line: Line) -> Result<(Field, f64, Field), StrategyError> {
        Ok(match line {
            Line::Level { fields, level } => (fields.0, level, fields.1),
            Line::Through(points) => seed(self.face, &constant_scallop::Start::Curve(points), self.flat)?,
        })
    }

    /// The passes offset from several lines, each within its region, where they are better than `best`.
    fn divided(
        &self,
        pieces: Vec<(Line, Region)>,
        best: Option<&Laid<'a>>,
        stage: &Stage,
    ) -> Result<Option<Laid<'a>>, StrategyError> {
        let (mut parts, mut places) = (Vec::new(), Vec::new());
        let count = pieces.len() as f64;
        for (k, (line, region)) in pieces.into_iter().enumerate() {
            let at = |k: usize| 0.6 * k as f64 / count;
            let part = stage.part("Spacing passes", at(k), at(k + 1));
            let (whole, seed) = ((self.face, self.tool), self.seed(line)?);
            let lines = offset_lines(whole, &seed, &self.rule, self.finish, self.order, &|_, _| true, &part)?;
            let mut part = Part { within: Some(region.clone()), ..lines.0 };
            part.clip(&|uv| region.has(uv));
            parts.push(part);
            places.extend(lines.1.into_iter().filter(|uv| region.has(*uv)));
            places.extend(region.meeting(CLOSE));
        }
        let following = stage.part("Following the surface", 0.6, 1.0);
        let laid = Laid::of_several(self.rule, parts, places, &following)?;
        Ok(Some(laid).filter(|laid| best.is_none_or(|best| laid.is_better(best))))
    }
}

/// What might be laid, what should come out shortest first.
fn ways(
    (face, grid): (&Face, &FaceGrid),
    potential: &Potential,
    (rule, families): (&Rule, Families),
    stage: &Stage,
) -> Result<Vec<Rated>, Cancelled> {
    let proposals = proposals(face, grid, potential);
    let starts = Starts { face, grid, potential };
    let mut streamlines = starts.streamlines(stage)?;
    let shortest_first = |starts: &mut [Start]| sort_by_key(starts, |start| (rank(start.expected), 0));
    let lines = |lines: Vec<Start>, most| {
        lines.into_iter().take(most).map(|start| (start.expected, Way::From(start.line)))
    };
    if let Rule::Fixed(_) = rule {
        let mut levels = starts.levels(&proposals);
        let several = families == Families::Several;
        let divided = several.then(|| {
            divided((face, grid), potential, &levels.iter().chain(&streamlines).collect::<Vec<_>>())
        });
        let divided = divided.flatten().map(|way| Rated { way, is_spare: false });
        shortest_first(&mut levels);
        shortest_first(&mut streamlines);
        streamlines.dedup_by(|next, last| next.expected < OTHER * last.expected);
        let mut ways: Vec<(f64, Way)> = lines(levels, 1).chain(lines(streamlines, STREAMLINES)).collect();
        ways.extend(proposals.into_iter().map(Proposal::way));
        // How long they should be is counted in another way: one family may be shorter.
        return Ok(divided.into_iter().chain(rated(ways, WORSE[0])).collect());
    }
    shortest_first(&mut streamlines);
    let shortest = proposals.iter().map(|way| way.expected).fold(f64::INFINITY, f64::min);
    // Widths that are evened out tell more than what is expected: passes from borders are asked for last.
    let borders: Vec<Rated> = proposals
        .iter()
        .filter(|way| way.expected < WORSE[1] * shortest)
        .filter_map(|way| way.border(&face.domain()))
        .map(|line| Rated { way: Way::From(line), is_spare: false })
        .collect();
    let mut ways: Vec<(f64, Way)> = proposals.into_iter().map(Proposal::way).collect();
    // What is offset from a line bends more, and postures that are chosen keep up with that less.
    streamlines.retain(|start| start.expected < BENDS * shortest);
    ways.extend(lines(streamlines, 1));
    let worse = if matches!(rule, Rule::Widest(_)) { f64::INFINITY } else { WORSE[1] };
    let (spare, ways): (Vec<Rated>, Vec<Rated>) =
        rated(ways, worse).into_iter().partition(|way| way.is_spare);
    Ok(ways.into_iter().chain(borders).chain(spare).collect())
}

/// Several families that divide the face, where that saves enough.
fn divided((face, grid): (&Face, &FaceGrid), potential: &Potential, starts: &[&Start]) -> Option<Way> {
    let domain = face.domain();
    // Over a seam neighbours are not looked for.
    if domain.u.periodic || domain.v.periodic {
        return None;
    }
    let shares: Vec<Vec<f64>> =
        starts.iter().map(|start| shares(grid, &domain, potential, &start.offset)).collect();
    let division = divide::divided(grid, &shares)?;
    let lines = division.families.iter().map(|&k| starts[k].line.clone());
    let regions = Region::all(grid.clone(), division.labels, division.families.len());
    Some(Way::Divided(lines.zip(regions).collect()))
}

/// `ways` with how long they should be, mm: the shortest first, and spare those that should be so much longer.
fn rated(mut ways: Vec<(f64, Way)>, worse: f64) -> Vec<Rated> {
    let is_straight = |way: &Way| matches!(way, Way::Levels(Field::U | Field::V | Field::Along(_), _));
    sort_by_key(&mut ways, |(expected, way)| {
        (rank(if is_straight(way) { *expected } else { expected / STRAIGHT }), 0)
    });
    let most = ways.first().map_or(0.0, |way| worse * way.0);
    let rated = ways.into_iter().enumerate();
    rated
        .map(|(k, (expected, way))| Rated {
            way,
            is_spare: expected > most || (k >= MOST && most.is_finite()),
        })
        .collect()
}

/// The functions worth laying: the best of each kind.
fn proposals(face: &Face, grid: &FaceGrid, potential: &Potential) -> Vec<Proposal> {
    let domain = face.domain();
    let proposal = |fields: (Field, Field)| {
        let values = fields.0.at_nodes(grid);
        let expected = expected_length(grid, &domain, potential, &values);
        Proposal { fields, values, expected }
    };
    let parameters = [(Field::U, Field::V), (Field::V, Field::U)].map(proposal);
    // Planes cut a face that closes on itself twice, and what is bent over its seam would have to count on beyond it.
    if domain.u.periodic || domain.v.periodic {
        return parameters.into();
    }
    let mut sections: Vec<Proposal> = sections(face).into_iter().map(proposal).collect();
    sort_by_key(&mut sections, |section| (rank(section.expected), 0));
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
    sort_by_key(&mut bent, |bent| (rank(bent.expected), 0));
    bent.into_iter().take(1).chain(sections.into_iter().take(1)).chain(parameters).collect()
}

/// Parallel planes in even steps of direction, each with a function that tells places along its lines apart.
fn sections(face: &Face) -> Vec<(Field, Field)> {
    let up = mean_normal(face);
    (0..SECTIONS).map(|k| iso_planar::fields(up, PI * k as f64 / SECTIONS as f64)).collect()
}
