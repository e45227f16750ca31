//! From lines to passes: walked along, looked over for what they leave, and cut back at their ends.

use super::family::{Candidate, Family};
use super::glean::Sought;
use super::left::Moves;
use super::{Planned, StrategyError};
use super::{places, trim, unreached, walk};
use crate::geometry::{IsoLine, Uv, Zone};
use crate::math::order::{rank, sort_by_key};
use crate::monitor::{Cancelled, Stage};
use crate::toolpath::Pass;

/// Rounds in which short passes are added where something is left.
const GLEANINGS: usize = 12;
/// Shorter passes are slivers, in strips.
const SLIVER: f64 = 0.1;
/// What a person reads meanwhile.
const FILL: &str = "Filling gaps";

/// Lines of one family that passes follow.
pub(super) struct Part<'a> {
    pub(super) family: Family<'a>,
    pub(super) tracks: Vec<Candidate>,
    /// Levels: what lies between them is this part's, unless one before it has it.
    pub(super) own: [f64; 2],
    /// Only that of it which lies there.
    #[cfg(feature = "flow")]
    pub(super) within: Option<super::region::Region>,
}

/// Parts of a face. Only the strategies that the page's second module brings have more than one: the first need not carry what keeps
/// them apart.
#[cfg(feature = "flow")]
type Parts<'a> = [Part<'a>];
#[cfg(not(feature = "flow"))]
type Parts<'a> = [Part<'a>; 1];

impl<'a> Part<'a> {
    /// All of a face.
    pub(super) fn whole(family: Family<'a>, tracks: Vec<Candidate>) -> Self {
        Self::between([f64::NEG_INFINITY, f64::INFINITY], family, tracks)
    }

    /// What lies between two levels.
    pub(super) fn between(own: [f64; 2], family: Family<'a>, tracks: Vec<Candidate>) -> Self {
        Self {
            family,
            tracks,
            own,
            #[cfg(feature = "flow")]
            within: None,
        }
    }

    /// Whether what is at `uv` lies between its levels.
    pub(super) fn has(&self, uv: Uv) -> bool {
        #[cfg(feature = "flow")]
        if self.within.as_ref().is_some_and(|region| !region.has(uv)) {
            return false;
        }
        let setup = &self.family.setup;
        let level = setup.field.value(uv, setup.face.surface.point(uv));
        (self.own[0]..=self.own[1]).contains(&level)
    }

    /// Leaves of its lines the pieces where something `is_open`, with a node to either side.
    #[cfg(feature = "flow")]
    pub(super) fn clip(&mut self, is_open: &dyn Fn(Uv) -> bool) {
        for track in &mut self.tracks {
            let (mut lines, mut probes) = (Vec::new(), Vec::new());
            for (line, own) in track.lines.iter().zip(&track.probes) {
                let open: Vec<bool> = line.nodes.iter().map(|uv| is_open(*uv)).collect();
                for (place, piece) in line.pieces(&open) {
                    lines.push(piece);
                    probes.push(own[place].to_vec());
                }
            }
            (track.lines, track.probes) = (lines, probes);
        }
        self.tracks.retain(|track| !track.lines.is_empty());
    }
}

/// The passes on the lines of `parts`, and short ones where they leave more than the limit at places all over the face and at
/// `others`; and whether in the end nothing is left there. What no part has is the first one's.
pub(super) fn followed(
    parts: &Parts,
    others: &[Uv],
    stage: &Stage,
) -> Result<(Planned, bool), StrategyError> {
    let count = parts.len() as f64;
    // A stretch of a part's own.
    let share = |name, from: f64, to: f64, k: usize| {
        let at = |k: usize| from + (to - from) * k as f64 / count;
        stage.part(name, at(k), at(k + 1))
    };
    let mut passes = Vec::new();
    // The part and the level of each.
    let mut ways = Vec::new();
    for (k, part) in parts.iter().enumerate() {
        let walked = part.family.walk(&part.tracks, &share("Following the surface", 0.0, 0.5, k))?;
        passes.extend(walked.into_iter().map(|passes| part.family.without_slivers(passes)));
        ways.extend(part.tracks.iter().map(|track| (k, track.level)));
    }
    if passes.iter().all(Vec::is_empty) {
        let why = "it gouges at every point in this posture; try more lead, or a smaller cutter";
        return Err(StrategyError::FitsNowhere(why.into()));
    }
    let Family { setup, .. } = &parts[0].family;
    let owner = |uv: Uv| match parts.len() {
        1 => 0,
        _ => parts.iter().position(|part| part.has(uv)).unwrap_or(0),
    };
    // What each part cannot reach.
    let zone = |k: usize, blocked: &[Uv], stage: &Stage| {
        let part = &parts[k];
        unreached::zone(&part.family.setup, &part.tracks, blocked, &|uv| owner(uv) == k, stage)
    };
    let mut zones = Vec::new();
    for k in 0..parts.len() {
        zones.push(zone(k, &[], &share("Mapping what is unreachable", 0.5, 0.65, k))?);
    }
    let edges = places::edges(parts.iter().flat_map(|part| &part.tracks));
    let ridges = places::ridges(&edges);
    let first = &parts[0].family;
    let (mut is_whole, mut is_trimmed) = (false, false);
    // Gleanings since passes were last cut back.
    let mut gleanings = 0;
    // Passes that are added leave no more than there was: until some are cut back, only there can there be more.
    let mut last: Option<Vec<Uv>> = None;
    for round in 0..=GLEANINGS {
        let at = |t: f64| 0.65 + 0.35 * (round as f64 + t) / (GLEANINGS + 1) as f64;
        let part = |name, from, to| stage.part(name, at(from), at(to));
        let own_share = |from, to, k| share(FILL, at(from), at(to), k);
        let moves = Moves::new(setup, passes.iter().flatten());
        // Whatever stands too high was laid so or cut back to. Strips of chosen postures differ so much from one to the next that three of
        // them may leave a point anywhere: at last all of those are looked for.
        let finely = is_trimmed && !setup.postures.is_fixed();
        let sought = Sought { limit: setup.finish.scallop, finely };
        let looks = match last.take() {
            Some(left) => left,
            None => first.looks(&moves, (others, &ridges), sought, &part(FILL, 0.0, 0.2))?,
        };
        let is_within = |uv: &Uv| {
            let here = setup.face.surface.point(*uv);
            !zones.iter().any(|zone| zone.contains(here))
        };
        let looks: Vec<Uv> = looks.into_iter().filter(is_within).collect();
        // By their parts, where the cutter can go and where it cannot.
        let mut left: Vec<[Vec<Uv>; 2]> = Vec::new();
        for (k, Part { family, .. }) in parts.iter().enumerate() {
            let own: Vec<Uv> = looks.iter().copied().filter(|uv| owner(*uv) == k).collect();
            left.push(family.left(&own, &moves, &own_share(0.2, 0.4, k))?);
        }
        is_whole = left.iter().all(|[open, _]| open.is_empty());
        let is_last = round == GLEANINGS || (is_whole && is_trimmed);
        if is_whole || is_last {
            // What no pass beside it has finished by now none will.
            for (k, [_, blocked]) in left.iter().enumerate() {
                if !blocked.is_empty() {
                    zones[k] = zone(k, blocked, &stage.quiet())?;
                }
            }
        }
        if is_last {
            break;
        }
        if is_whole {
            passes = trim::trimmed(first, &passes, &edges, &part("Cutting passes back", 0.4, 1.0))?;
            is_trimmed = true;
            gleanings = 0;
            continue;
        }
        for (k, (Part { family, .. }, [open, _])) in parts.iter().zip(&left).enumerate() {
            let short = family.short_lines(open, gleanings, &stage.quiet())?;
            passes.extend(family.walk(&short, &own_share(0.4, 1.0, k))?);
            ways.extend(short.iter().map(|track| (k, track.level)));
        }
        gleanings += 1;
        last = Some(left.into_iter().flatten().flatten().collect());
    }
    let mut by_level: Vec<_> = ways.into_iter().zip(passes).collect();
    sort_by_key(&mut by_level, |((_, level), _)| (rank(*level), 0));
    let mut sorted = Vec::new();
    for k in 0..parts.len() {
        let own = by_level.iter_mut().filter(|((part, _), _)| *part == k);
        own.for_each(|(_, passes)| sorted.append(passes));
    }
    let fits = parts.iter().filter_map(|part| part.family.setup.postures.largest_fit());
    let largest_fit = fits.reduce(f64::min);
    let unreached = zones.iter().fold(Zone::empty(), |all, zone| all.joined(zone));
    Ok((Planned { passes: sorted, unreached, unseen: Zone::empty(), largest_fit }, is_whole))
}

impl Family<'_> {
    /// `line`, a piece of one of its level's, with as much more at its ends as the strips there lie aslant: where postures are
    /// chosen, strips are wide, and what a partial pass is for would lie beside its end.
    fn extended(&self, line: &IsoLine, reversed: bool) -> IsoLine {
        let mut nodes = line.nodes.clone();
        let last = nodes.len() - 1;
        let place = |whole: &IsoLine| whole.nodes.windows(nodes.len()).position(|w| w[0] == nodes[0]);
        let found =
            || self.lines_of(line.level, reversed).into_iter().find_map(|l| place(&l).map(|at| (l, at)));
        if self.setup.postures.is_fixed() || line.closed {
            return line.clone();
        }
        let Some((whole, at)) = found() else { return line.clone() };
        let point = |uv: Uv| self.setup.face.surface.point(uv);
        let along = point(nodes[last]) - point(nodes[last - 1]);
        let forwards =
            self.setup.frame(nodes[last], reversed).is_some_and(|(_, frame)| frame.f.dot(along) > 0.0);
        let ways = |uv| self.setup.ways_across(uv, reversed, 0.0);
        let mut way = [ways(nodes[0])[usize::from(!forwards)], ways(nodes[last])[usize::from(forwards)]];
        let (mut first, mut end) = (at, at + last);
        while first > 0 && way[0] > 0.0 {
            way[0] -= point(whole.nodes[first]).distance(point(whole.nodes[first - 1]));
            first -= 1;
        }
        while end + 1 < whole.nodes.len() && way[1] > 0.0 {
            way[1] -= point(whole.nodes[end]).distance(point(whole.nodes[end + 1]));
            end += 1;
        }
        nodes = whole.nodes[first..=end].to_vec();
        IsoLine { nodes, ..*line }
    }

    /// `passes` without those that are hardly more than a place, where postures are chosen: beside what the cutter can just not reach
    /// they come by the thousand, and what they would cut is looked for afterwards.
    fn without_slivers(&self, mut passes: Vec<Pass>) -> Vec<Pass> {
        if !self.setup.postures.is_fixed() {
            passes.retain(|pass| pass.length() > SLIVER * self.setup.strip);
        }
        passes
    }

    /// The passes on the lines of each of `tracks`.
    fn walk(&self, tracks: &[Candidate], stage: &Stage) -> Result<Vec<Vec<Pass>>, Cancelled> {
        stage.map(tracks.len(), |i| {
            let track = &tracks[i];
            let pass = |line: &IsoLine| {
                walk::passes(&self.setup, &self.extended(line, track.reversed), track.reversed)
            };
            if track.reversed {
                track.lines.iter().rev().flat_map(pass).collect::<Vec<_>>()
            } else {
                track.lines.iter().flat_map(pass).collect()
            }
        })
    }
}
