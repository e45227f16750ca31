//! What is out of reach, as a zone.

use super::Turn;
use super::across::WALL;
use super::line::Lowering;
use super::reach::Spot;
use crate::geometry::{TriMesh, Zone};
use glam::DVec3;

/// The zone of the `spots`, looked at in slices `along` apart, and of what no upright cutter sees, in cubes of edge
/// `cell`. A cube is in the zone if it holds a part of what a sample stands for, not only the sample.
pub(super) fn zone(
    mesh: &TriMesh,
    lowering: &Lowering<'_>,
    spots: &[Spot],
    (along, cell): (f64, f64),
    turn: &Turn,
) -> Zone {
    let mut samples = hidden(mesh, lowering, cell, turn);
    for spot in spots {
        let n = spot.normal;
        let across = spot.area * n.z / along;
        let (u, v) =
            (DVec3::new(along, 0.0, -along * n.x / n.z), DVec3::new(0.0, across, -across * n.y / n.z));
        let pieces = |w: DVec3| (2.0 * w.length() / cell).ceil().max(1.0);
        let (nu, nv) = (pieces(u), pieces(v));
        for i in 0..nu as u32 {
            for j in 0..nv as u32 {
                let at = |i: u32, n: f64| (f64::from(i) + 0.5) / n - 0.5;
                let p = spot.point + u * at(i, nu) + v * at(j, nv);
                spread(turn.to_world(p), spot.area / (nu * nv), cell, 0.25 * cell, &mut samples);
            }
        }
    }
    Zone::from_samples(cell, samples)
}

/// Adds a sample, and one without area in each further cube that the box of half width `half` around it meets.
fn spread(p: DVec3, area: f64, cell: f64, half: f64, samples: &mut Vec<(DVec3, f64)>) {
    samples.push((p, area));
    let (lo, hi) = ((p - half) / cell, (p + half) / cell);
    let splits = lo.floor().cmpne(hi.floor());
    for corner in 1..8u32 {
        let high = glam::BVec3::new(corner & 1 != 0, corner & 2 != 0, corner & 4 != 0);
        // Along an axis with both ends in one cube, one of them will do.
        if (high & !splits).any() {
            continue;
        }
        samples.push((DVec3::select(high, p + half, p - half), 0.0));
    }
    if splits.any() {
        samples.push((p - half, 0.0));
    }
}

/// Samples of the facets that no upright cutter sees: walls, undersides, and what lies below other facets.
fn hidden(mesh: &TriMesh, lowering: &Lowering<'_>, cell: f64, turn: &Turn) -> Vec<(DVec3, f64)> {
    let mut samples = Vec::new();
    for i in 0..mesh.triangles.len() {
        let Some(normal) = mesh.normal(i) else { continue };
        let [a, b, c] = mesh.corners(i);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let n = (longest / cell).ceil().max(1.0) as usize;
        let area = mesh.area(i) / (n * n) as f64;
        for s in 0..n {
            for t in 0..2 * (n - s) - 1 {
                // Centres of the upright and upside-down small triangles of row s, in turn.
                let third = if t % 2 == 0 { 1.0 / 3.0 } else { 2.0 / 3.0 };
                let (u, v) = ((s as f64 + third) / n as f64, ((t / 2) as f64 + third) / n as f64);
                let p = a + (b - a) * u + (c - a) * v;
                let covered = || lowering.mesh.top(p.x, p.y).is_some_and(|(z, _)| z > p.z + COVERED);
                if normal.z <= WALL || covered() {
                    spread(turn.to_world(p), area, cell, 0.5 * cell, &mut samples);
                }
            }
        }
    }
    samples
}

/// What lies deeper than this below the top, mm, is another layer and not rounding.
const COVERED: f64 = 1e-4;
