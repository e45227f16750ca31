//! Where lines must be inserted, and what stays out of reach.

use super::cut::Lines;
use super::line::Lowering;
use super::reach::{Closing, Spot};
use crate::geometry::TriMesh;
use crate::monitor::{Cancelled, Stage};
use glam::{DVec2, DVec3};

/// How finely the mesh is looked at, mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grain {
    /// Along the lines.
    pub along: f64,
    /// Across them.
    pub across: f64,
}

/// Slower than this steep, the normal's z: such facets are walls.
pub(super) const WALL: f64 = 0.02;

/// On steep ground the steps across shrink with the normal's z, down to this.
const STEEPEST_STEP: f64 = 0.2;

/// What must be left below.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    /// What the lines may leave, mm.
    pub lines: f64,
    /// What any single position of the cutter must be able to stay below for a spot to count as within reach, mm.
    pub single: f64,
}

/// A spot that the lines so far leave too high, and where the axis must go for it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wanting {
    pub spot: Spot,
    pub axis: DVec2,
    /// The place across at which a line was last inserted for it.
    pub asked: Option<u32>,
}

/// The spots that the lines leave too high, and those out of reach.
#[derive(Debug, Default)]
pub(super) struct Survey {
    pub wanting: Vec<Wanting>,
    pub unreached: Vec<Spot>,
}

/// What is cut and with what.
#[derive(Clone, Copy)]
pub(super) struct Ground<'a> {
    pub mesh: &'a TriMesh,
    pub lowering: &'a Lowering<'a>,
    pub best: &'a Closing,
}

/// What a look at one spot found.
#[derive(Clone, Copy, PartialEq)]
enum Found {
    Low,
    Wanting(DVec2),
    OutOfReach,
}

/// Looks at all that is seen from above.
pub(super) fn survey(
    ground: &Ground<'_>,
    lines: &Lines,
    grain: Grain,
    limits: Limits,
    stage: &Stage<'_>,
) -> Result<Survey, Cancelled> {
    let Some((lo, hi)) = ground.mesh.bounds() else { return Ok(Survey::default()) };
    let count = ((hi.x - lo.x) / grain.along).ceil().max(1.0) as usize;
    let width = (hi.x - lo.x) / count as f64;
    let slices = stage.map(count, |i| {
        let x = lo.x + width * (i as f64 + 0.5);
        ground.slice(lines, limits, (lo.y, hi.y), x, Grain { along: width, ..grain })
    })?;
    let mut all = Survey::default();
    for slice in slices {
        all.wanting.extend(slice.wanting);
        all.unreached.extend(slice.unreached);
    }
    Ok(all)
}

impl Ground<'_> {
    /// Looks along y. Out of reach the steps are longer; once something within reach follows, what was stepped over is
    /// looked at closely.
    fn slice(&self, lines: &Lines, limits: Limits, (from, to): (f64, f64), x: f64, grain: Grain) -> Survey {
        let mut survey = Survey::default();
        let mut y = from + 0.5 * grain.across;
        // The last spot out of reach, with its short step, if a long one was taken from there.
        let mut strode: Option<(Spot, f64)> = None;
        while y < to {
            let Some(spot) = self.spot(x, y) else {
                if let Some((spot, step)) = strode.take() {
                    survey.note(spot, Found::OutOfReach, grain.along * step);
                    y = spot.point.y + step;
                } else {
                    y += grain.across;
                }
                continue;
            };
            // A step of even length over the ground.
            let rise = spot.normal.y / spot.normal.z;
            let step = grain.across * (1.0 / (1.0 + rise * rise).sqrt()).max(STEEPEST_STEP);
            let found = self.look(lines, limits, &spot);
            if let Some((last, short)) = strode.take() {
                let stride = if found == Found::OutOfReach { spot.point.y - last.point.y } else { short };
                survey.note(last, Found::OutOfReach, grain.along * stride);
                if found != Found::OutOfReach {
                    y = last.point.y + short;
                    // From here on in short steps, until the spot that ended the stride.
                    while y < spot.point.y {
                        if let Some(spot) = self.spot(x, y) {
                            let found = self.look(lines, limits, &spot);
                            survey.note(spot, found, grain.along * short);
                        }
                        y += short;
                    }
                    y = spot.point.y;
                }
            }
            if found == Found::OutOfReach {
                strode = Some((spot, step));
                y += STRIDE * step;
            } else {
                survey.note(spot, found, grain.along * step);
                y += step;
            }
        }
        if let Some((spot, step)) = strode {
            survey.note(spot, Found::OutOfReach, grain.along * step);
        }
        survey
    }

    /// The spot seen at `(x, y)`, its area that of a unit square seen from above; `None` beside the mesh and on walls.
    fn spot(&self, x: f64, y: f64) -> Option<Spot> {
        let (z, triangle) = self.lowering.mesh.top(x, y)?;
        let normal = self.mesh.normal(triangle as usize).filter(|n| n.z > WALL)?;
        Some(Spot { point: DVec3::new(x, y, z), normal, area: 1.0 / normal.z })
    }

    fn look(&self, lines: &Lines, limits: Limits, spot: &Spot) -> Found {
        if is_low(self.lowering, lines, limits, spot, spot.axis(self.lowering)) {
            return Found::Low;
        }
        self.best.reach(self.lowering, spot, limits.single).map_or(Found::OutOfReach, Found::Wanting)
    }
}

impl Survey {
    fn note(&mut self, spot: Spot, found: Found, shadow: f64) {
        let spot = Spot { area: spot.area * shadow, ..spot };
        match found {
            Found::Low => {}
            Found::Wanting(axis) => self.wanting.push(Wanting { spot, axis, asked: None }),
            Found::OutOfReach => self.unreached.push(spot),
        }
    }
}

/// Out of reach one spot in so many is looked at: the zone is kept in cubes of about that size.
const STRIDE: f64 = 4.0;

fn is_low(lowering: &Lowering<'_>, lines: &Lines, limits: Limits, spot: &Spot, axis: DVec2) -> bool {
    lines.cuts(lowering.under, spot.point + limits.lines * spot.normal, axis)
}

/// The spots that are still too high.
pub(super) fn still_wanting(
    wanting: &[Wanting],
    lowering: &Lowering<'_>,
    lines: &Lines,
    limits: Limits,
    stage: &Stage<'_>,
) -> Result<Vec<Wanting>, Cancelled> {
    let chunks: Vec<&[Wanting]> = wanting.chunks(CHUNK).collect();
    let kept = stage.map(chunks.len(), |i| {
        let high = |w: &&Wanting| !is_low(lowering, lines, limits, &w.spot, w.axis);
        chunks[i].iter().filter(high).copied().collect::<Vec<_>>()
    })?;
    Ok(kept.concat())
}

/// Spots a task: milliseconds of work.
const CHUNK: usize = 2000;
