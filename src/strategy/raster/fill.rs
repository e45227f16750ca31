//! Lines, and the partial lines that go between them.

use super::across::{Asked, Wanting, still_wanting};
use super::cut::Lines;
use super::ground::Ground;
use crate::math::order::sort_numbers;
use crate::monitor::{Cancelled, Stage};
use std::collections::BTreeMap;

/// The phase's name.
const FILLING: &str = "Filling in";

/// A stretch of a line: its place and its ends along x.
pub(super) type Stretch = (u32, f64, f64);

/// Lowers the cutter over stretches.
pub(super) fn cut(
    stretches: &[Stretch],
    ground: &Ground<'_>,
    lines: &mut Lines,
    stage: &Stage<'_>,
) -> Result<(), Cancelled> {
    let drops = stage.map(stretches.len(), |i| {
        let (place, from, to) = stretches[i];
        ground.lowering.along(lines.y(place), from, to)
    })?;
    for ((place, ..), drops) in stretches.iter().zip(drops) {
        lines.add(*place, drops);
    }
    Ok(())
}

/// Inserts partial lines until no spot is wanting; gives back those that lines where the axis must go do not help.
pub(super) fn fill(
    mut wanting: Vec<Wanting>,
    ground: &Ground<'_>,
    lines: &mut Lines,
    cusp: f64,
    stage: &Stage<'_>,
) -> Result<Vec<Wanting>, Cancelled> {
    let mut hopeless = Vec::new();
    let mut done = 0.0;
    while !wanting.is_empty() {
        let mut places: BTreeMap<u32, Vec<f64>> = BTreeMap::new();
        let mut left = Vec::new();
        for w in wanting {
            // Halfway there may be no mesh below, near an oblique border: then the line goes where the axis must.
            let halfway = lines.between(w.axis).filter(|&p| w.asked != Asked::Halfway(p));
            match (w.asked, halfway) {
                (Asked::Nothing | Asked::Halfway(_), Some(place)) => {
                    places.entry(place).or_default().push(w.axis.x);
                    left.push(Wanting { asked: Asked::Halfway(place), ..w });
                }
                (Asked::Nothing | Asked::Halfway(_), None) => {
                    places.entry(lines.nearest(w.axis.y)).or_default().push(w.axis.x);
                    left.push(Wanting { asked: Asked::There, ..w });
                }
                // A line runs where the axis must go and yet it was not enough.
                (Asked::There, _) => hopeless.push(w),
            }
        }
        let stretches: Vec<_> = places
            .into_iter()
            .flat_map(|(place, at)| {
                let covered = ground.lowering.covered(lines.y(place));
                joined(at, cusp, &covered).into_iter().map(move |(from, to)| (place, from, to))
            })
            .collect();
        let next = 0.5 * (1.0 + done);
        let half = 0.5 * (done + next);
        cut(&stretches, ground, lines, &stage.part(FILLING, done, half))?;
        wanting = still_wanting(&left, ground, lines, &stage.part(FILLING, half, next))?;
        done = next;
    }
    stage.at(1.0)?;
    Ok(hopeless)
}

/// Stretches around the places `at`, within the stretches `covered`: each place with a little on either side, and
/// joined where the gap is short.
fn joined(mut at: Vec<f64>, cusp: f64, covered: &[(f64, f64)]) -> Vec<(f64, f64)> {
    sort_numbers(&mut at);
    let (margin, gap) = (MARGIN * cusp, JOINED * cusp);
    let mut stretches: Vec<(f64, f64)> = Vec::new();
    for x in at {
        match stretches.last_mut() {
            Some(last) if x - margin <= last.1 + gap => last.1 = x + margin,
            _ => stretches.push((x - margin, x + margin)),
        }
    }
    let clip = |&(from, to): &(f64, f64)| {
        covered.iter().map(move |c| (from.max(c.0), to.min(c.1))).filter(|(from, to)| from < to)
    };
    stretches.iter().flat_map(clip).collect()
}

/// What a partial line extends beyond the spots it is for, in widths of a level cusp: more than the distance of spots.
const MARGIN: f64 = 0.25;
/// Gaps up to so many widths are cut through.
const JOINED: f64 = 2.0;
