//! Where lines must be inserted, and what stays out of reach.

use super::cut::Lines;
use super::line::Lowering;
use super::reach::Spot;
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
    pub unreached: Vec<(DVec3, f64)>,
}

/// Looks at all that is seen from above.
pub(super) fn survey(
    mesh: &TriMesh,
    lowering: &Lowering<'_>,
    lines: &Lines,
    grain: Grain,
    limits: Limits,
    stage: &Stage<'_>,
) -> Result<Survey, Cancelled> {
    let Some((lo, hi)) = mesh.bounds() else { return Ok(Survey::default()) };
    let count = ((hi.x - lo.x) / grain.along).ceil().max(1.0) as usize;
    let width = (hi.x - lo.x) / count as f64;
    let slices = stage.map(count, |i| {
        let x = lo.x + width * (i as f64 + 0.5);
        let mut survey = Survey::default();
        let mut y = lo.y + 0.5 * grain.across;
        while y < hi.y {
            let mut step = grain.across;
            let seen = lowering.mesh.top(x, y);
            let normal = seen.and_then(|(_, triangle)| mesh.normal(triangle as usize));
            if let (Some((z, _)), Some(normal)) = (seen, normal) {
                step *= normal.z.clamp(STEEPEST_STEP, 1.0);
                let point = DVec3::new(x, y, z);
                if normal.z > WALL {
                    let spot = Spot { point, normal, area: width * step / normal.z };
                    look(lowering, lines, limits, spot, &mut survey);
                }
            }
            y += step;
        }
        survey
    })?;
    let mut all = Survey::default();
    for slice in slices {
        all.wanting.extend(slice.wanting);
        all.unreached.extend(slice.unreached);
    }
    Ok(all)
}

fn look(lowering: &Lowering<'_>, lines: &Lines, limits: Limits, spot: Spot, survey: &mut Survey) {
    if is_low(lowering, lines, limits, &spot, spot.axis(lowering)) {
        return;
    }
    match lowering.reach(&spot, limits.single) {
        Some(axis) => survey.wanting.push(Wanting { spot, axis, asked: None }),
        None => survey.unreached.push((spot.point, spot.area)),
    }
}

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

/// Samples of the facets that no upright cutter sees: walls, undersides, and what lies below other facets.
pub(super) fn hidden(mesh: &TriMesh, lowering: &Lowering<'_>, cell: f64) -> Vec<(DVec3, f64)> {
    let mut samples = Vec::new();
    for i in 0..mesh.triangles.len() {
        let Some(normal) = mesh.normal(i) else { continue };
        let [a, b, c] = mesh.corners(i);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let n = (longest / cell).ceil().max(1.0) as usize;
        let area = mesh.area(i) / (n * n) as f64;
        for s in 0..n {
            for t in 0..2 * (n - s) - 1 {
                // Centres of the upward and downward small triangles of row s, in turn.
                let third = if t % 2 == 0 { 1.0 / 3.0 } else { 2.0 / 3.0 };
                let (u, v) = ((s as f64 + third) / n as f64, ((t / 2) as f64 + third) / n as f64);
                let p = a + (b - a) * u + (c - a) * v;
                let covered = || lowering.mesh.top(p.x, p.y).is_some_and(|(z, _)| z > p.z + COVERED);
                if normal.z <= WALL || covered() {
                    samples.push((p, area));
                }
            }
        }
    }
    samples
}

/// What lies deeper than this below the top, mm, is another layer and not rounding.
const COVERED: f64 = 1e-4;
