//! Where lines must be inserted, and what stays out of reach.

use super::cut::Lines;
use super::facet::Piece;
use super::ground::{Ground, Patch};
use super::reach::Spot;
use super::rest;
use super::turn::Turn;
use crate::geometry::Cubes;
use crate::monitor::{Cancelled, Stage};
use glam::DVec2;

/// A spot that the lines so far leave too high, and where the axis must go for it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wanting {
    pub spot: Spot,
    pub axis: DVec2,
    pub asked: Asked,
}

/// What was last tried for a spot that is too high.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Asked {
    Nothing,
    /// A line at this place, halfway between two others.
    Halfway(u32),
    /// A line where the axis must go.
    There,
}

/// What a first look at all that is seen from above finds.
#[derive(Debug, Default)]
pub(super) struct Survey {
    pub wanting: Vec<Wanting>,
    /// For every slice and patch whether it is out of reach.
    pub out: Vec<Vec<bool>>,
    /// Area out of reach, mm².
    pub beyond: f64,
}

/// Looks at one spot a patch.
pub(super) fn survey(ground: &Ground<'_>, lines: &Lines, stage: &Stage<'_>) -> Result<Survey, Cancelled> {
    let slices = stage.map(ground.slices().0, |i| {
        let mut survey = Survey::default();
        let patches = ground.patches(i);
        let mut found: Vec<Option<Found>> = vec![None; patches.len()];
        let look = |k: usize| ground.look(lines, &patches[k].spot);
        for k in 0..patches.len() {
            // Between patches out of reach every other one is taken for granted.
            let amid = k >= 2 && found[k - 1] == Some(Found::OutOfReach) && k + 1 < patches.len();
            if amid && found[k - 2] == Some(Found::OutOfReach) && found[k].is_none() {
                let next = look(k + 1);
                found[k + 1] = Some(next);
                found[k] = Some(if next == Found::OutOfReach { next } else { look(k) });
            } else if found[k].is_none() {
                found[k] = Some(look(k));
            }
        }
        let mut out = Vec::with_capacity(patches.len());
        for (patch, found) in patches.iter().zip(found) {
            out.push(found == Some(Found::OutOfReach));
            match found {
                None | Some(Found::Low) => {}
                Some(Found::Wanting(axis)) => {
                    survey.wanting.push(Wanting { spot: patch.spot, axis, asked: Asked::Nothing });
                }
                Some(Found::OutOfReach) => survey.beyond += ground.area(patch),
            }
        }
        survey.out.push(out);
        survey
    })?;
    let mut all = Survey::default();
    for slice in slices {
        all.wanting.extend(slice.wanting);
        all.out.extend(slice.out);
        all.beyond += slice.beyond;
    }
    Ok(all)
}

/// Looks closely wherever a look at one spot a patch was not sure, and collects what is out of reach: `out` tells for
/// every slice and patch whether it is.
pub(super) fn survey_closely(
    ground: &Ground<'_>,
    lines: &Lines,
    out: &[Vec<bool>],
    cubes: &Cubes,
    turn: &Turn,
    stage: &Stage<'_>,
) -> Result<(Vec<Wanting>, Cubes), Cancelled> {
    let slices = stage.map(out.len(), |i| {
        let mut wanting = Vec::new();
        let mut beyond = cubes.clone();
        let mut give_up = |patch: &Patch| {
            let (x, half) = (patch.spot.point.x, 0.5 * ground.slices().1);
            let (low, high) = ([x - half, patch.from], [x + half, patch.to]);
            rest::add_patch(&mut beyond, (patch.spot.point, patch.spot.normal), (low, high), turn);
        };
        for (k, patch) in ground.patches(i).iter().enumerate() {
            if out[i][k] {
                give_up(patch);
                continue;
            }
            let axis = patch.spot.axis(ground.lowering);
            if ground.is_low(lines, ground.limits.strict, &patch.spot, axis) {
                continue;
            }
            for part in ground.closely(patch) {
                match ground.look(lines, &part.spot) {
                    Found::Low => {}
                    Found::Wanting(axis) => {
                        wanting.push(Wanting { spot: part.spot, axis, asked: Asked::Nothing })
                    }
                    Found::OutOfReach => give_up(&part),
                }
            }
        }
        (wanting, beyond)
    })?;
    let (mut wanting, mut beyond) = (Vec::new(), cubes.clone());
    for (w, b) in slices {
        wanting.extend(w);
        beyond.absorb(b);
    }
    Ok((wanting, beyond))
}

/// Looks at pieces of facets, and closer where a look at one spot a piece is not sure. Gives back the spots that are too
/// high and all that are within reach, and adds to `beyond` what is not.
pub(super) fn survey_pieces(
    ground: &Ground<'_>,
    lines: &Lines,
    pieces: &[Piece],
    beyond: &mut Cubes,
    turn: &Turn,
    stage: &Stage<'_>,
) -> Result<(Vec<Wanting>, Vec<Spot>), Cancelled> {
    let look = |piece: &Piece| {
        if piece.covered {
            return vec![(*piece, Found::OutOfReach)];
        }
        let mut found = vec![(*piece, ground.look(lines, &piece.spot))];
        let axis = piece.spot.axis(ground.lowering);
        let sure = ground.is_low(lines, ground.limits.strict, &piece.spot, axis);
        if !sure && found[0].1 != Found::OutOfReach {
            let parts = piece.parts(CLOSER * ground.grain.along);
            found.extend(parts.map(|part| (part, ground.look(lines, &part.spot))));
        }
        found
    };
    let tasks = stage.map(pieces.len().div_ceil(CHUNK), |i| {
        let chunk = &pieces[i * CHUNK..pieces.len().min((i + 1) * CHUNK)];
        chunk.iter().flat_map(look).collect::<Vec<_>>()
    })?;
    let (mut wanting, mut within) = (Vec::new(), Vec::new());
    for (piece, found) in tasks.into_iter().flatten() {
        match found {
            Found::OutOfReach => rest::add_piece(beyond, piece.corners, turn),
            Found::Low => within.push(piece.spot),
            Found::Wanting(axis) => {
                within.push(piece.spot);
                wanting.push(Wanting { spot: piece.spot, axis, asked: Asked::Nothing });
            }
        }
    }
    Ok((wanting, within))
}

/// Length of the parts in a closer look at a piece, in distances of slices.
const CLOSER: f64 = 0.5;

/// What a look at one spot found.
#[derive(Clone, Copy, PartialEq)]
enum Found {
    Low,
    Wanting(DVec2),
    OutOfReach,
}

impl Ground<'_> {
    fn look(&self, lines: &Lines, spot: &Spot) -> Found {
        if self.is_low(lines, self.limits.lines, spot, spot.axis(self.lowering)) {
            return Found::Low;
        }
        self.best.reach(self.lowering, spot, self.limits.single).map_or(Found::OutOfReach, Found::Wanting)
    }
}

/// The spots that are still too high.
pub(super) fn still_wanting(
    wanting: &[Wanting],
    ground: &Ground<'_>,
    lines: &Lines,
    stage: &Stage<'_>,
) -> Result<Vec<Wanting>, Cancelled> {
    let chunks: Vec<&[Wanting]> = wanting.chunks(CHUNK).collect();
    let kept = stage.map(chunks.len(), |i| {
        let high = |w: &&Wanting| !ground.is_low(lines, ground.limits.lines, &w.spot, w.axis);
        chunks[i].iter().filter(high).copied().collect::<Vec<_>>()
    })?;
    Ok(kept.concat())
}

/// Spots a task: milliseconds of work.
const CHUNK: usize = 2000;
