//! Partial passes between whole ones, where those leave a gap.

use super::family::{Candidate, Family};
use super::probe::{Probe, Reach};
use super::spacing::{Front, Toward};
use crate::geometry::{Field, IsoLine, Uv};
use crate::monitor::{Cancelled, Stage};
use glam::DVec3;

/// Halvings between two whole passes: at the last, partial passes lie a sixty-fourth of a step apart.
const DEPTH: usize = 6;
/// Halvings towards the rim of what the cutter cannot reach; a quarter of a step is left beside it, which the zone takes in.
const RIM_DEPTH: usize = 2;

/// Columns between two neighbouring probes of a line that a partial pass must cover.
#[derive(Debug, Clone, Copy)]
struct Need {
    columns: (f64, f64),
    point: DVec3,
}

/// `placed` with partial passes put between neighbours, in the order of their levels.
pub(super) fn tracks(
    family: &Family,
    placed: Vec<Candidate>,
    stage: &Stage,
) -> Result<Vec<Candidate>, Cancelled> {
    let count = placed.len();
    let between = stage.map(count.saturating_sub(1), |i| {
        let mut out = Vec::new();
        insert(family, [&placed[i], &placed[i + 1]], None, &mut out, &stage.quiet()).map(|()| out)
    })?;
    let mut between = between.into_iter();
    let mut all = Vec::new();
    for candidate in placed {
        all.push(candidate);
        if let Some(partial) = between.next() {
            all.extend(partial?);
        }
    }
    Ok(all)
}

/// Appends the partial passes between `lower` and `upper`, lowest first: in all columns, or in those of `within`.
fn insert(
    family: &Family,
    [lower, upper]: [&Candidate; 2],
    within: Option<(&[Need], usize)>,
    out: &mut Vec<Candidate>,
    stage: &Stage,
) -> Result<(), Cancelled> {
    let depth = within.map_or(1, |(_, depth)| depth + 1);
    if depth > DEPTH {
        return Ok(());
    }
    let needs = needs(family, [lower, upper], within.map(|(needs, _)| needs), depth);
    if needs.is_empty() {
        return Ok(());
    }
    let level = 0.5 * (lower.level + upper.level);
    let lines: Vec<IsoLine> =
        family.lines_of(level, lower.reversed).iter().flat_map(|line| pieces(family, line, &needs)).collect();
    // One thread: the pairs of passes already share the workers out.
    let middle = family.probed(level, lines, lower.reversed, &stage.alone())?;
    if middle.probes.iter().flatten().all(|p| *p == Probe::Blocked) {
        // Nothing is cut on it, but it tells where the cutter cannot go.
        out.push(middle);
        return Ok(());
    }
    let within = Some((&needs[..], depth));
    insert(family, [lower, &middle], within, out, stage)?;
    let mut above = Vec::new();
    insert(family, [&middle, upper], within, &mut above, stage)?;
    out.push(middle);
    out.extend(above);
    Ok(())
}

/// Where the strips of `lower` and `upper` do not meet, within the given columns.
fn needs(
    family: &Family,
    [lower, upper]: [&Candidate; 2],
    within: Option<&[Need]>,
    depth: usize,
) -> Vec<Need> {
    // Lines that bend freely end anywhere, and what is left beside their ends is looked for afterwards.
    let rim = !matches!(family.setup.field, Field::Given(_));
    let mut found = Vec::new();
    for (own, other, toward, back) in
        [(lower, upper, Toward::Higher, Toward::Lower), (upper, lower, Toward::Lower, Toward::Higher)]
    {
        let (front, mine) = (family.front(other, back), family.front(own, toward));
        for (line, probes) in own.lines.iter().zip(&own.probes) {
            let inside = |i: usize| within.is_none_or(|needs| covers(family, needs, line.nodes[i]));
            let open: Vec<bool> = (0..probes.len())
                .map(|i| {
                    inside(i) && is_open(&probes[i], [&mine, &front], (toward, back), rim.then_some(depth))
                })
                .collect();
            for i in 0..open.len().saturating_sub(1) {
                if open[i] || open[i + 1] {
                    let (a, point) = column(family, line.nodes[i]);
                    let (b, _) = column(family, line.nodes[i + 1]);
                    found.push(Need { columns: (a.min(b), a.max(b)), point });
                }
            }
        }
    }
    found
}

/// Whether something is left between the strip of `probe`, one of those with the front `mine`, and the neighbour's `front`.
fn is_open(
    probe: &Probe,
    [mine, front]: [&Front; 2],
    (toward, back): (Toward, Toward),
    rim: Option<usize>,
) -> bool {
    match probe.reach(toward) {
        // What is abreast must come at least as far as the strip. Nothing abreast is the rim of what can be reached.
        Some(Reach::To { level, column, point, .. }) if mine.is_behind(level, column, point) => false,
        Some(Reach::To { level, column, point, .. }) => front
            .meets(level, column, point, back)
            .map_or(rim.is_some_and(|depth| depth <= RIM_DEPTH), |met| !met),
        Some(Reach::Border { .. } | Reach::Aside) | None => false,
    }
}

fn column(family: &Family, uv: Uv) -> (f64, DVec3) {
    let point = family.setup.face.surface.point(uv);
    (family.setup.column.value(uv, point), point)
}

/// Whether the point at `uv` lies in one of the columns of `needs`.
fn covers(family: &Family, needs: &[Need], uv: Uv) -> bool {
    let (column, point) = column(family, uv);
    // What is abreast lies within a few steps in space; another sheet of a folded face does not.
    let near = 4.0 * family.setup.strip;
    needs.iter().any(|need| {
        let middle = 0.5 * (need.columns.0 + need.columns.1);
        let turns = family.column_period.map_or(0.0, |p| ((middle - column) / p).round() * p);
        (need.columns.0..=need.columns.1).contains(&(column + turns))
            && need.point.distance_squared(point) < near * near
    })
}

/// The pieces of `line` that lie in the columns of `needs`, with a node to either side.
fn pieces(family: &Family, line: &IsoLine, needs: &[Need]) -> impl Iterator<Item = IsoLine> + use<> {
    let wanted: Vec<bool> = line.nodes.iter().map(|&uv| covers(family, needs, uv)).collect();
    line.pieces(&wanted).into_iter().map(|(_, piece)| piece)
}
