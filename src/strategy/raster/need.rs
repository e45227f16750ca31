//! Which parts of the lines are needed, and what is worth cutting between them.

use super::cut::{Lines, cut_by};
use super::ground::Ground;
use super::line::Drop;
use super::reach::Spot;
use crate::math::order::{rank, sort_by_key};
use crate::monitor::{Cancelled, Stage};
use glam::DVec2;
use std::collections::BTreeMap;

/// A part of a line that may turn out needless.
struct Piece {
    place: u32,
    drops: Vec<Drop>,
    /// Number of drops in the stretch that it is a part of: short stretches go first.
    stretch: usize,
    /// How many pieces lie between it and the middle of its stretch, or the part that stays: the outermost goes first.
    outward: usize,
}

/// The phase's name.
const NEEDLESS: &str = "Leaving out the needless";

/// Most pieces counted that cut the same spot: what is more is surely not needed for it.
const COUNTED: usize = 6;

/// The lines without the parts that are not needed by any patch that is not `out` of reach, nor by `spots`: partial lines, and what of the `first` lines lies beyond the mesh, go
/// where every spot stays as low without them. Passes on the same line whose gap can be cut through on a way of at most
/// `bridge` mm are joined.
pub(super) fn needed(
    lines: &Lines,
    first: impl Fn(u32) -> bool,
    ground: &Ground<'_>,
    (out, spots): (&[Vec<bool>], &[Spot]),
    (piece, bridge): (f64, f64),
    stage: &Stage<'_>,
) -> Result<Lines, Cancelled> {
    let (mut fixed, mut pieces) = (lines.like(), Vec::new());
    for (place, drops) in lines.iter() {
        if first(place) {
            let covered = ground.lowering.mesh.covered(lines.y(place), 0.0);
            split_whole(place, drops, &covered, piece, &mut fixed, &mut pieces);
        } else {
            let parts: Vec<_> = chop(drops, piece).collect();
            let middle = parts.len() / 2;
            pieces.extend(parts.iter().enumerate().map(|(i, part)| Piece {
                place,
                drops: part.to_vec(),
                stretch: drops.len(),
                outward: i.abs_diff(middle),
            }));
        }
    }
    sort_by_key(&mut pieces, |p| (rank(p.drops[0].x), 0));
    sort_by_key(&mut pieces, |p| {
        ((p.stretch as u64) << 32 | u64::from(p.place), u32::MAX - p.outward as u32)
    });
    let coverage = coverage(lines, &fixed, &pieces, ground, (out, spots), &stage.part(NEEDLESS, 0.0, 0.8))?;
    let kept = keep(pieces.len(), &coverage);
    let mut runs: BTreeMap<u32, Vec<Vec<Drop>>> = BTreeMap::new();
    for (place, drops) in fixed.iter() {
        runs.entry(place).or_default().push(drops.clone());
    }
    for (piece, _) in pieces.into_iter().zip(kept).filter(|(_, kept)| *kept) {
        runs.entry(piece.place).or_default().push(piece.drops);
    }
    let runs: Vec<_> = runs.into_iter().collect();
    let whole = stage.part(NEEDLESS, 0.8, 1.0).map(runs.len(), |i| {
        let (place, runs) = &runs[i];
        bridged(runs.clone(), ground, lines.y(*place), bridge)
    })?;
    let mut result = lines.like();
    for ((place, _), list) in runs.iter().zip(whole) {
        list.into_iter().for_each(|drops| result.add(*place, drops));
    }
    Ok(result)
}

/// Divides a whole line: what lies over the mesh stays.
fn split_whole(
    place: u32,
    drops: &[Drop],
    covered: &[(f64, f64)],
    piece: f64,
    fixed: &mut Lines,
    pieces: &mut Vec<Piece>,
) {
    let last = drops.len() - 1;
    let mut free = 0;
    let mut loose = |from: usize, to: usize, outwards: bool| {
        let parts: Vec<_> = chop(&drops[from..=to], piece).collect();
        let count = parts.len();
        pieces.extend(parts.into_iter().enumerate().map(|(i, part)| Piece {
            place,
            drops: part.to_vec(),
            stretch: drops.len(),
            outward: if outwards { i } else { count - i },
        }));
    };
    for &(a, b) in covered {
        let from = drops.partition_point(|d| d.x <= a).saturating_sub(1).max(free);
        let to = drops.partition_point(|d| d.x < b).min(last);
        if from >= to {
            continue;
        }
        if from > free {
            loose(free, from, free > 0);
        }
        fixed.add(place, drops[from..=to].to_vec());
        free = to;
    }
    if free < last {
        loose(free, last, free > 0);
    }
}

/// Parts of about the length `piece` that share their ends.
fn chop(drops: &[Drop], piece: f64) -> impl Iterator<Item = &[Drop]> {
    let mut from = 0;
    std::iter::from_fn(move || {
        let start = drops.get(from)?.x;
        let to = drops.partition_point(|d| d.x < start + piece).max(from + 1).min(drops.len() - 1);
        if to <= from {
            return None;
        }
        let part = &drops[from..=to];
        from = to;
        Some(part)
    })
}

/// For every spot that needs one of the pieces, which of them cut it.
fn coverage(
    lines: &Lines,
    fixed: &Lines,
    pieces: &[Piece],
    ground: &Ground<'_>,
    (out, spots): (&[Vec<bool>], &[Spot]),
    stage: &Stage<'_>,
) -> Result<Vec<Vec<u32>>, Cancelled> {
    let mut places: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for (i, piece) in pieces.iter().enumerate() {
        places.entry(piece.place).or_default().push(i as u32);
    }
    let under = ground.lowering.under;
    let cutting = |spot: &Spot, limit: f64, axis: DVec2| {
        let p = spot.point + limit * spot.normal;
        let mut found = Vec::new();
        for (&place, list) in places.range(lines.places_near(p.y, under.reach())) {
            let across = lines.y(place) - p.y;
            let width = (under.reach() * under.reach() - across * across).max(0.0).sqrt();
            for &i in list {
                let drops = &pieces[i as usize].drops;
                let near = drops[0].x <= p.x + width && drops[drops.len() - 1].x >= p.x - width;
                if near && cut_by(under, drops, p, across, width, axis.x) {
                    found.push(i);
                    if found.len() == COUNTED {
                        return found;
                    }
                }
            }
        }
        found
    };
    let limits = ground.limits;
    let slices = stage.map(out.len(), |i| {
        let mut list = Vec::new();
        for (k, patch) in ground.patches(i).iter().enumerate() {
            let axis = patch.spot.axis(ground.lowering);
            if out[i][k] || ground.is_low(fixed, limits.strict, &patch.spot, axis) {
                continue;
            }
            let found = cutting(&patch.spot, limits.strict, axis);
            if !found.is_empty() {
                list.push(found);
                continue;
            }
            for part in ground.closely(patch) {
                let axis = part.spot.axis(ground.lowering);
                if !ground.is_low(fixed, limits.lines, &part.spot, axis) {
                    list.push(cutting(&part.spot, limits.lines, axis));
                }
            }
        }
        list
    })?;
    let mut all = slices.concat();
    for spot in spots {
        let axis = spot.axis(ground.lowering);
        if !ground.is_low(fixed, limits.lines, spot, axis) {
            all.push(cutting(spot, limits.lines, axis));
        }
    }
    all.retain(|found| !found.is_empty());
    Ok(all)
}

/// Which pieces stay: one after the other goes, if every spot that it cuts is cut by another one that is still there.
fn keep(count: usize, coverage: &[Vec<u32>]) -> Vec<bool> {
    let mut spots: Vec<Vec<u32>> = vec![Vec::new(); count];
    for (spot, pieces) in coverage.iter().enumerate() {
        pieces.iter().for_each(|&piece| spots[piece as usize].push(spot as u32));
    }
    let mut left: Vec<u8> = coverage.iter().map(|pieces| pieces.len() as u8).collect();
    let stays = |spots: &Vec<u32>| {
        let needed = spots.iter().any(|&spot| left[spot as usize] < 2);
        if !needed {
            spots.iter().for_each(|&spot| left[spot as usize] -= 1);
        }
        needed
    };
    spots.iter().map(stays).collect()
}

/// Runs on one line, those joined that touch, or whose gap can be cut through on a way of at most `bridge`.
fn bridged(mut runs: Vec<Vec<Drop>>, ground: &Ground<'_>, y: f64, bridge: f64) -> Vec<Vec<Drop>> {
    sort_by_key(&mut runs, |run| (rank(run[0].x), 0));
    let covered = ground.lowering.covered(y);
    let mut joined: Vec<Vec<Drop>> = Vec::new();
    for run in runs {
        let Some(last) = joined.last_mut() else {
            joined.push(run);
            continue;
        };
        let (from, to) = (last[last.len() - 1].x, run[0].x);
        if from == to {
            // Parts of one stretch share the drop between them.
            last.extend(run.into_iter().skip(1));
            continue;
        }
        let meets = from < to && covered.iter().any(|c| c.0 <= from && to <= c.1);
        let length = |way: &[Drop]| -> f64 {
            way.windows(2).map(|w| DVec2::new(w[1].x - w[0].x, w[1].tip - w[0].tip).length()).sum()
        };
        let ends = [last[last.len() - 1], run[0]];
        // A look tells most of the gaps that are too deep.
        let look = || {
            let middle = ground.lowering.at(0.5 * (from + to), y);
            middle.is_some_and(|middle| length(&[ends[0], middle, ends[1]]) <= bridge)
        };
        if meets && length(&ends) <= bridge && look() {
            let way = ground.lowering.along(y, from, to);
            if length(&way) <= bridge {
                last.extend(way);
                last.extend(run);
                continue;
            }
        }
        joined.push(run);
    }
    joined
}
