//! Partial passes between whole ones, where those leave a gap.

use super::family::{Candidate, Family};
use super::probe::{Probe, Reach};
use super::spacing::{Front, Toward};
use crate::geometry::{Field, IsoLine, Uv};
use crate::math::order::{rank, sort_by_key};
use crate::monitor::{Cancelled, Stage};
use glam::DVec3;

/// Partings between two whole passes: each at least halves what lies between two passes.
const DEPTH: usize = 6;
/// Partings towards the rim of what the cutter cannot reach; a quarter of a step is left beside it, which the zone takes in.
const RIM_DEPTH: usize = 2;
/// What of a strip may be missing beyond a whole number of them.
const SLACK: f64 = 0.02;
/// Most passes between two others at once.
const MOST: f64 = 64.0;
/// Nodes to either side that have as many passes as the one among them that needs most.
const AROUND: usize = 3;
/// Shorter pieces of lines that bend freely are no partial passes, in strips: hardly more than their run-outs.
const SHORT: f64 = 0.3;

/// Columns between two neighbouring probes of a line that partial passes must cover.
#[derive(Debug, Clone, Copy)]
struct Need {
    columns: (f64, f64),
    point: DVec3,
    /// How many strips are missing there.
    strips: f64,
}

impl Need {
    /// So many strips in the columns between two neighbouring nodes of a line.
    fn between(family: &Family, [first, second]: [Uv; 2], strips: f64) -> Self {
        let ((a, point), (b, _)) = (column(family, first), column(family, second));
        Self { columns: (a.min(b), a.max(b)), point, strips }
    }
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
        insert(family, [&placed[i], &placed[i + 1]], None, &mut out, &stage.quiet())?;
        sort_by_key(&mut out, |track: &Candidate| (rank(track.level), 0));
        Ok(out)
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

/// Appends the partial passes between `lower` and `upper`, in any order: in all columns, or in those of `within`.
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
    let most = needs.iter().map(|need| count(need.strips)).fold(1, usize::max);
    // Lines are traced only for numbers of passes that some columns need.
    let is_needed = |passes: &usize| needs.iter().any(|need| count(need.strips) == *passes);
    for passes in (1..=most).filter(is_needed) {
        let level = first_of(passes, [lower.level, upper.level]);
        let lines = family.lines_of(level, lower.reversed);
        let lines = lines.iter().flat_map(|line| pieces(family, line, &needs, passes));
        let lines: Vec<IsoLine> = lines.filter(|line| is_worth(family, line)).collect();
        if lines.is_empty() {
            continue;
        }
        let own: Vec<Need> = lines.iter().flat_map(|line| columns_of(family, line)).collect();
        // One thread: the pairs of passes already share the workers out.
        let middle = family.probed(level, lines, lower.reversed, &stage.alone())?;
        // Where nothing is cut on it, it tells where the cutter cannot go.
        if middle.probes.iter().flatten().any(|p| *p != Probe::Blocked) {
            let within = Some((&own[..], depth));
            insert(family, [lower, &middle], within, out, stage)?;
            insert(family, [&middle, upper], within, out, stage)?;
        }
        out.push(middle);
    }
    Ok(())
}

/// The level of that one of so many `passes` between two levels which has as many below it as above, or one less: steps are equal then.
fn first_of(passes: usize, [lower, upper]: [f64; 2]) -> f64 {
    let below = passes.div_ceil(2);
    lower + (upper - lower) * below as f64 / (passes + 1) as f64
}

/// Whether a piece of a line is worth a partial pass: where lines bend freely, what the shortest ones are for is looked for afterwards.
fn is_worth(family: &Family, line: &IsoLine) -> bool {
    !matches!(family.setup.field, Field::Given(_))
        || line.length(family.setup.face) >= SHORT * family.setup.strip
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
            let rim = rim.then_some(depth);
            let open =
                |i: usize| inside(i).then(|| missing(&probes[i], [&mine, &front], toward, rim)).flatten();
            let open: Vec<Option<f64>> = (0..probes.len()).map(open).collect();
            for i in 0..open.len().saturating_sub(1) {
                if let Some(strips) = open[i].into_iter().chain(open[i + 1]).reduce(f64::max) {
                    found.push(Need::between(family, [line.nodes[i], line.nodes[i + 1]], strips));
                }
            }
        }
    }
    found
}

/// How many strips as wide as that of `probe`, one of those with the front `mine`, fit between it and the neighbour's `front`; `None`
/// where nothing is left there.
fn missing(probe: &Probe, [mine, front]: [&Front; 2], toward: Toward, rim: Option<usize>) -> Option<f64> {
    let Some(Reach::To { level, column, point, .. }) = probe.reach(toward) else { return None };
    if mine.is_behind(level, column, point) {
        return None;
    }
    let away = if toward == Toward::Higher { 1.0 } else { -1.0 };
    match front.abreast(level, column, point) {
        // What is abreast must come at least as far as the strip.
        Some(abreast) => {
            let gap = away * (abreast - level);
            (gap > 0.0).then(|| probe.depth().map_or(1.0, |depth| gap / depth))
        }
        // Nothing abreast is the rim of what can be reached.
        None => rim.is_some_and(|depth| depth <= RIM_DEPTH).then_some(1.0),
    }
}

/// How many passes close a gap of so many strips.
fn count(strips: f64) -> usize {
    if strips.is_finite() { (strips - SLACK).ceil().clamp(1.0, MOST) as usize } else { 1 }
}

fn column(family: &Family, uv: Uv) -> (f64, DVec3) {
    let point = family.setup.face.surface.point(uv);
    (family.setup.column.value(uv, point), point)
}

/// The columns of `line`.
fn columns_of(family: &Family, line: &IsoLine) -> impl Iterator<Item = Need> {
    line.nodes.windows(2).map(|w| Need::between(family, [w[0], w[1]], 1.0))
}

/// Whether the point at `uv` lies in one of the columns of `needs`.
fn covers(family: &Family, needs: &[Need], uv: Uv) -> bool {
    most_missing(family, needs, uv).is_some()
}

/// How many strips are missing at `uv` by those of `needs` in whose columns it lies.
fn most_missing(family: &Family, needs: &[Need], uv: Uv) -> Option<f64> {
    let (column, point) = column(family, uv);
    // What is abreast lies within a few steps in space; another sheet of a folded face does not.
    let near = 4.0 * family.setup.strip;
    let is_here = |need: &&Need| {
        let middle = 0.5 * (need.columns.0 + need.columns.1);
        let turns = family.column_period.map_or(0.0, |p| ((middle - column) / p).round() * p);
        (need.columns.0..=need.columns.1).contains(&(column + turns))
            && need.point.distance_squared(point) < near * near
    };
    needs.iter().filter(is_here).map(|need| need.strips).reduce(f64::max)
}

/// The pieces of `line` that lie in the columns of `needs` where so many `passes` close the gap, with a node to either side.
fn pieces(
    family: &Family,
    line: &IsoLine,
    needs: &[Need],
    passes: usize,
) -> impl Iterator<Item = IsoLine> + use<> {
    let passes_at = |uv: &Uv| most_missing(family, needs, *uv).map_or(0, count);
    let counts: Vec<usize> = line.nodes.iter().map(passes_at).collect();
    let around = |i: usize| i.saturating_sub(AROUND)..(i + AROUND + 1).min(counts.len());
    let is_wanted = |i: usize| counts[i] > 0 && counts[around(i)].iter().max() == Some(&passes);
    let wanted: Vec<bool> = (0..counts.len()).map(is_wanted).collect();
    line.pieces(&wanted).into_iter().map(|(_, piece)| piece)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::strategy::family::Detail;
    use crate::strategy::trial::{family, flat, leaning};

    /// Steps of 0.98 strips between two lines as many apart: with halvings there would be one, three or seven passes.
    #[test]
    fn as_many_passes_close_a_gap_as_it_has_strips() {
        let stage = Stage::silent();
        let family = family(flat([0.0, 20.0], [0.0, 40.0]), &leaning(0.3, 0.0), (Field::V, Field::U));
        let line = |level: f64| family.candidate(level, 0, Detail::Full, &stage).unwrap();
        let strip = line(10.0).probes[0][3].depth().unwrap();
        for passes in 0..8_u32 {
            let apart = 0.98 * strip * f64::from(passes + 1);
            let levels: Vec<f64> = tracks(&family, vec![line(10.0), line(10.0 + apart)], &stage)
                .unwrap()
                .iter()
                .map(|track| track.level)
                .collect();
            assert_eq!(levels.len(), passes as usize + 2);
            for step in levels.windows(2).map(|w| w[1] - w[0]) {
                assert!((step - 0.98 * strip).abs() < 1e-9, "{step} {strip}");
            }
        }
    }
}
